#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_modification.hpp"

namespace flankwright::studies::rexs {

struct RexsImportOptions {
  std::optional<int> stage{};                  ///< which of the file's stages, see find_stage()
  SlopeEnd slope_end{SlopeEnd::NonDatumFace};  ///< where a positive helix_slope removes
  std::string grid_stem{};                     ///< grids are called stem + "-pinion.csv", "-wheel.csv"
};

/// A file that goes beside the study.
struct ImportedGrid {
  std::string name, text;
};

struct ImportedStudy {
  std::string text;                   ///< a study file; comments say where each value came from and what was not taken
  std::vector<ImportedGrid> grids;    ///< measurement grids that it names
  std::vector<std::string> warnings;  ///< what the study says otherwise than the file, or not at all; each is a comment too
};

/// A stage of a REXS file as a study of task "analyse".
///
/// @param text  of the file
/// @param name  stands for it in messages and comments
/// @throws StudyErrors with one problem where the file is damaged, or has no stage that a study could describe
ImportedStudy import_stage(const std::string& text, const std::string& name, const RexsImportOptions& options);

}  // namespace flankwright::studies::rexs
