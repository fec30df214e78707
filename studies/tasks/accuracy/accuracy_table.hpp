#pragma once

#include <string>
#include <vector>

#include "core/compliance/model/compliance_model.hpp"
#include "core/load/cycle/mesh_parameter.hpp"

namespace flankwright::studies {

/// [accuracy.outside]: the transmission error of the same pair from elsewhere: a test rig, another program.
struct OutsideCurve {
  std::string name{"outside"};
  std::vector<double> transmission_error;  ///< at evenly spaced positions over one pitch, the first at phase 0; at least 3 [mm]
};

/// [accuracy]: the finest fidelity level, which all others are compared with; graded quadrature, refined peaks.
struct AccuracyTable {
  ComplianceModel compliance{ComplianceModel::Fitted};
  GapModel gap{GapModel::WholeSurface};
  int intervals{16};       ///< >= 8
  int positions{64};       ///< >= 16
  OutsideCurve outside{};  ///< without values: none; the study then has one load case
};

}  // namespace flankwright::studies
