#include "studies/exchange/rexs/modification_list.hpp"

#include <array>

namespace flankwright::studies::rexs {

namespace {

constexpr std::array<std::string_view, 12> modification_types{"tip_relief",
                                                              "root_relief",
                                                              "profile_slope",
                                                              "profile_crowning",
                                                              "helix_slope",
                                                              "helix_crowning",
                                                              "profile_twist",
                                                              "end_relief_datum_face",
                                                              "end_relief_non_datum_face",
                                                              "triangular_tip_relief",
                                                              "triangular_root_relief",
                                                              "topographical_modification"};

}  // namespace

std::vector<const Component*> modifications_of(const Reading& reading, const Component& flank) {
  std::vector<const Component*> found;
  for (const std::string_view type : modification_types) {
    for (const Component* component : reading.related(flank, {type})) found.push_back(component);
  }
  return found;
}

}  // namespace flankwright::studies::rexs
