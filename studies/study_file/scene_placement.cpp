#include "studies/study_file/scene_placement.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace flankwright::studies {

namespace {

/// The total contact ratio of a pair whose axes are further apart; 0 where the tips do not reach each other.
/// @param centre_distance  [mm]
double contact_ratio_at(const GearPair& pair, double centre_distance) {
  PairData apart = pair.data;
  apart.centre_distance = centre_distance;
  try {
    return make_gear_pair(apart).total_contact_ratio();
  } catch (const InvalidInput&) {
    return 0.0;
  }
}

}  // namespace

std::vector<PlacementProblem> placement_problems(const GearPair& pair, const Misalignment& misalignment) {
  std::vector<PlacementProblem> problems;
  const double moved = misalignment.centre_distance;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const Gear& mate = m == Member::Pinion ? pair.wheel : pair.pinion;
    const double least = pair[m].tip_radius + mate.root_radius - pair.centre_distance;
    if (moved > least) continue;
    problems.push_back(
        {"misalignment.centre_distance", moved, "above " + in_words(least) + " mm, where the " + name_of(m) + "'s tip meets the mate's root circle"});
    break;
  }
  if (moved > 0.0 && contact_ratio_at(pair, pair.centre_distance + moved) < 1.0) {
    problems.push_back({"misalignment.centre_distance", moved,
                        "one that leaves a total contact ratio of at least 1 (without it, it is " + in_words(pair.total_contact_ratio()) + " at " +
                            in_words(pair.centre_distance) + " mm)"});
  }
  constexpr double least_share = 0.01;  // of the narrower face, which both have in common
  const FaceRange &one = pair.pinion.face, &other = pair.wheel.face;
  const double common = std::min(one.end, misalignment.axial_offset + other.end) - std::max(one.begin, misalignment.axial_offset + other.begin);
  const double least = least_share * std::min(one.end - one.begin, other.end - other.begin);
  if (common < least) {
    problems.push_back({"misalignment.axial_offset", misalignment.axial_offset,
                        "one that leaves at least " + in_words(least) + " mm of face in common, 1 % of the narrower one"});
  }
  return problems;
}

}  // namespace flankwright::studies
