#pragma once

#include <optional>
#include <string>
#include <vector>

#include "optimize/sampling/distribution.hpp"
#include "optimize/sampling/drawn_pitch.hpp"
#include "optimize/sampling/sample_design.hpp"

/// [sweep]: samples of a parameter space. Read by sweep_reading.hpp.
namespace flankwright::studies {

/// A key of the study that scatters.
struct SweepParameter {
  std::string path;                       ///< as the study names it: "misalignment.mesh_misalignment"
  std::string unit;                       ///< of a bare number of that key
  Distribution distribution;              ///< of the value in that unit
  std::string in_words;                   ///< "normal, mean 0, deviation 6"
  std::optional<PitchTolerance> pitch{};  ///< then the value is the number of a draw, and every tooth has a deviation of its own
};

struct SweepTable {
  Sampler sampler{Sampler::Sobol};
  long long samples{1000};  ///< of a grid: all combinations of its levels
  unsigned long seed{1};
  bool indices{true};  ///< samples are laid out in blocks for Sobol indices; never in a grid
  std::vector<SweepParameter> parameters;
};

}  // namespace flankwright::studies
