#pragma once

#include <optional>
#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_modification.hpp"

namespace flankwright::studies::rexs {

struct RexsImportOptions {
  std::optional<int> stage{};                  ///< which of the file's stages, see find_stage()
  SlopeEnd slope_end{SlopeEnd::NonDatumFace};  ///< where a positive helix_slope removes
  std::optional<double> hours{};               ///< life of the unit [h], > 0, instead of the file's operating_time
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
  std::string not_taken;              ///< every attribute that was not taken, by component: a file beside the study, whose comment sums it up
};

/// The name of the file of ImportedStudy::not_taken.
std::string not_taken_name(const std::string& grid_stem);

/// One of several stages of a file.
struct ImportedOfUnit {
  int number{0};  ///< as --stage counts
  ImportedStudy study;
};
struct UnitImport {
  std::vector<ImportedOfUnit> stages;
  std::vector<std::string> left_out;  ///< stages that a study cannot be made of, each with its reason
};

/// All external cylindrical stages of a file, each as a study on the common unit. Gears of several meshes, as of planetary stages, are left out: by
/// themselves they may be imported. Grids and lists are named by the stem and the stage, "unit-stage-2-pinion.csv", where there is more than one stage.
/// @throws StudyErrors  as import_stage(), where no stage can be imported; and with all defects of the unit, see find_defects(), where no stage is chosen
UnitImport import_unit(const std::string& text, const std::string& name, const RexsImportOptions& options);
/// "unit-stage-2"
std::string stem_of_stage(const std::string& stem, int number);

/// A stage of a REXS file as a study of task "analyse".
///
/// @param text  of the file
/// @param name  stands for it in messages and comments
/// @throws StudyErrors with one problem where the file is damaged, or has no stage that a study could describe; with all defects of the part of the unit
/// that turns with the stage, see find_defects(). Those of other parts are warned of.
ImportedStudy import_stage(const std::string& text, const std::string& name, const RexsImportOptions& options);

}  // namespace flankwright::studies::rexs
