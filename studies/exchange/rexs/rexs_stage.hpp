#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/gear/gear_data.hpp"
#include "studies/exchange/rexs/rexs_reading.hpp"

namespace flankwright::studies::rexs {

/// The components of a model that belong to one gear of a stage.
struct GearParts {
  const Component* gear{nullptr};
  const Component* data{nullptr};  ///< what the stage says of this gear; null where nothing
  const Component* shaft{nullptr};
  // By take_flank():
  const Component* flank{nullptr};        ///< the working one; null where the file has none
  const Component* other_flank{nullptr};  ///< the one at the back
  const Component* tool{nullptr};         ///< rack that generates it; null where none is named
  const Component* settings{nullptr};     ///< of the last manufacturing step; null where there is none
  const Component* material{nullptr};
  /// The datum face is the end of lowest z, seen from where left and right are named; z runs along the pinion's u axis.
  bool datum_at_low_z{true};
  bool shaft_against_z{false};  ///< the shaft's u axis runs the other way
};

/// A cylindrical stage of a model. The pinion is the gear with fewer teeth, gear_1 where both have the same.
struct StageParts {
  const Component* stage{nullptr};
  std::array<GearParts, 2> gears{};  ///< pinion, wheel
  std::array<int, 2> teeth{};
  WorkingFlank working_flank{WorkingFlank::Right};  ///< of the pinion, as a study names it: seen from the end of lowest z
  std::string flank_source{};                       ///< what the working flank came from; empty before take_flank()

  GearParts& operator[](Member m) { return gears[m == Member::Pinion ? 0 : 1]; }
  const GearParts& operator[](Member m) const { return gears[m == Member::Pinion ? 0 : 1]; }
};

/// Direction of a component's u axis, (1, 0, 0) where it is not said.
std::array<double, 3> u_axis(Reading& reading, const Component& component);

/// Whether two axes point to opposite sides.
bool runs_against(const std::array<double, 3>& one, const std::array<double, 3>& two);

/// The relations of external cylindrical stages, in the order of --stage; of rings and planet carriers by themselves there is nothing to import.
std::vector<const Relation*> stages_of(const Reading& reading);

/// A cylindrical stage with both gears and their teeth: "cylindrical_stage 10: cylindrical_gear 6 with 19 teeth, cylindrical_gear 8 with 47 teeth".
std::string stage_in_words(const Reading& reading, const Relation& stage);

/// In how many stages of the file a gear takes part.
std::ptrdiff_t meshes_of(const Reading& reading, const Component& gear);

/// The components of the stage of a relation, without what belongs to a flank, see take_flank().
/// @throws StudyErrors with one problem: internal gears, numbers of teeth, references to nothing
StageParts parts_of(Reading& reading, const Relation& stage);

/// The stage that is asked for, as parts_of().
///
/// @param number  of the stage among those of the file, counted from 1, or else the id of its component; empty: the only one
/// @throws StudyErrors as parts_of(), and where there is no cylindrical stage, or several and none is chosen
StageParts find_stage(Reading& reading, std::optional<int> number);

/// Sets the working flank of the pinion and finds the flanks, tools, manufacturing settings and materials of both gears.
/// @param source  what the flank came from
void take_flank(Reading& reading, StageParts& parts, WorkingFlank flank, std::string source);

}  // namespace flankwright::studies::rexs
