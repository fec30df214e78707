#pragma once

#include <string>
#include <vector>

namespace flankwright::studies::rexs {

/// Warnings of components, "shaft 4: its ends are cones", with those that say the same joined under all their components: "shaft 4, 5, gear 7: its ends are cones". Each
/// stands where the first of its kind did. What does not begin with the name of a component or load case stays as it is.
std::vector<std::string> grouped_by_component(const std::vector<std::string>& warnings);

/// Warnings of one stage of a unit.
struct StageWarnings {
  int number;  ///< of the stage
  std::vector<std::string> warnings;
};

/// The warnings of all stages, each once: "stage 1, 2: shaft 4: ...", and without a stage where every one of several has it.
std::vector<std::string> grouped_by_stage(const std::vector<StageWarnings>& stages);

}  // namespace flankwright::studies::rexs
