#pragma once

#include <string>
#include <vector>

#include "core/compliance/shaft/shaft_data.hpp"

namespace flankwright::beam_truth {

/// A solid shaft on supports that hold its axis across and let it swivel, under one force across.
struct BeamCase {
  std::string name;
  ShaftData shaft;               ///< its sections and material
  std::vector<double> supports;  ///< z [mm]
  double force_position;         ///< z [mm]
  double force;                  ///< along x [N]
  std::vector<double> stations;  ///< z where deflections are compared [mm]
};

inline std::vector<BeamCase> beam_cases() {
  const auto shaft = [](std::vector<ShaftSection> sections) { return ShaftData{.sections = std::move(sections), .material = {206000.0, 0.3}}; };
  return {
      {"stepped, two supports", shaft({{200, 40}, {400, 50}, {200, 40}}), {20, 780}, 300, 5000, {100, 300, 400, 650, 790}},
      {"stepped, three supports", shaft({{200, 40}, {300, 50}, {300, 45}, {200, 40}}), {20, 500, 980}, 230, 8000, {100, 230, 400, 650, 800, 990}},
      {"one diameter, two supports", shaft({{800, 45}}), {20, 780}, 300, 5000, {100, 300, 400, 650, 790}},
  };
}

}  // namespace flankwright::beam_truth
