#pragma once

#include <optional>
#include <string>

/// The commands that exchange data with other programs; exit codes as those of commands.hpp.
namespace flankwright::studies {

struct ImportCommand {
  std::string file;                    ///< REXS, XML or JSON
  std::string study;                   ///< file to write; empty: stdout
  std::optional<int> stage;            ///< of several
  std::optional<double> hours;         ///< life of the unit [h]
  std::string slope_end{"non-datum"};  ///< or "datum": face end at which a positive helix_slope removes
};

/// Makes a study of a stage of a REXS file; grids go beside it. Differences between study and file are reported on stderr too.
int import_command(const ImportCommand& options);

struct ExportCommand {
  std::string results;  ///< folder with results.json
  std::string folder;   ///< for the files; empty: the same
  bool rexs{false}, rexsj{false}, grid{false}, vtk{false}, dynamics{false};
  std::string rexs_version{"1.7"};
  std::string grid_points{"9x15"};  ///< along the profile x along the face
  double grid_margin{0.0};          ///< share of the active flank that is left out at each border
  bool given{false};                ///< flanks of the study file also where an optimisation has changed them
};

/// Writes the contents of a results folder in the requested formats, at least one.
int export_command(const ExportCommand& options);

}  // namespace flankwright::studies
