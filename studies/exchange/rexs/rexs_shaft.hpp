#pragma once

#include <optional>
#include <string>

#include "core/compliance/shaft/shaft_data.hpp"
#include "studies/exchange/rexs/rexs_pair.hpp"

namespace flankwright::studies::rexs {

/// The shaft of one gear with its bearings.
struct ImportedShaft {
  ShaftData data;
  Remarks remarks;  ///< by key below [pinion.shaft]
};

/// Reads the shaft that carries a gear. A study knows one gear on a shaft, bearings in a housing that gives nowhere, and one place where the
/// torque enters; a shaft that is otherwise is left out with a warning that says why. Without shaft or sections nothing is said.
///
/// Positions become those along z, see ShaftData. Bearings without radial_stiffness are rigid, cones cylinders of their mean diameters:
/// both are reported.
/// @throws StudyErrors where an attribute is no number or of a wrong unit
std::optional<ImportedShaft> read_shaft(Reading& reading, const GearParts& parts, double face_width);

/// [pinion.shaft] or [wheel.shaft] of a study.
void write_shaft(const ImportedShaft& shaft, Member member, StudyText& text);

}  // namespace flankwright::studies::rexs
