#pragma once

#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_model.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies::rexs {

struct RexsExportOptions {
  std::string version{"1.7"};  ///< "1.0" .. "1.7", "2.0": names and units are those of that version
  std::string date;            ///< "2026-11-21T19:00:00+00:00"
};

/// A study as a REXS model, and the parts that the format cannot hold.
struct ExportedStage {
  Model model;
  std::vector<std::string> notes;
};

/// The pair of a study as one cylindrical stage, with the modifications of its working flanks, materials and torques; several torques
/// are load cases. What no other component says (grids, generation, a predesigned transmission error) becomes a
/// topographical_modification, point by point. Datum faces are at the end of lowest z; amounts are those of Modification.
///
/// @throws InvalidInput for a version that is none
ExportedStage export_stage(const Study& study, const RexsExportOptions& options);

}  // namespace flankwright::studies::rexs
