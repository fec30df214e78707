#pragma once

#include <optional>
#include <string>

#include "core/compliance/shaft/shaft_data.hpp"
#include "studies/exchange/rexs/rexs_pair.hpp"

namespace flankwright::studies::rexs {

/// Why a shaft is not taken.
struct LeftOut {
  std::string why;
};

/// A bearing that joins a shaft to another one, as the shaft has it.
struct BareJoint {
  const Component* bearing{nullptr};
  const Component* mate{nullptr};  ///< the other shaft
  bool is_inner{true};             ///< this shaft is the inner one
  ShaftBearing held;               ///< its position is that on this shaft
};

/// Sections, bearings and material of a shaft of which nothing is asked but itself, along z.
struct BareShaft {
  ShaftData data;
  Remarks remarks;
  std::vector<BareJoint> joints;
  double start{0.0}, end{0.0};  ///< u coordinates of its ends [mm]
  bool against_z{false};

  /// Position along z of a place on its u axis [mm].
  double place(double u) const { return against_z ? end - u : u - start; }
};

/// @param notes  what it is taken as is added
/// @throws LeftOut
BareShaft read_bare_shaft(Reading& reading, const Component& shaft, bool against_z, std::vector<std::string>& notes);

/// Sections and bearings as a study's text has them.
std::string sections_text(const ShaftData& shaft);
std::string bearings_text(const ShaftData& shaft);
/// What a bearing's table holds beside its position: ", radial_stiffness = 300".
std::string stiffness_text(const ShaftBearing& bearing);

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
