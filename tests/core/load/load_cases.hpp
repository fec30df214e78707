#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/compliance/local/hertz_line.hpp"
#include "core/load/solve/load_problem.hpp"
#include "tests/common/random.hpp"

/// Load problems for tests: steel contacts, influence matrices of every kind, and what proves a solution.
namespace flankwright::load_cases {

inline const Material steel{};

using tests::Random;

/// Contact of two steel teeth: radius R and depths in mm.
inline ContactLaw steel_law(double relative_radius = 12.0, double depth_1 = 8.0, double depth_2 = 9.0,
                            double tip_distance = std::numeric_limits<double>::infinity()) {
  return {ContactSide::of(steel, depth_1, tip_distance), ContactSide::of(steel, depth_2), relative_radius, contact_modulus(steel, steel)};
}

/// Structural influence, as it may come from any compliance model [mm/N].
enum class Structure {
  Slices,          ///< diagonal: no coupling
  DecayingKernel,  ///< exp(-distance), positive everywhere
  LowRank,         ///< random Gram matrix of rank max(1, n/4), entries of either sign
  WholeBody,       ///< all points move together: rank 1
  Rigid            ///< zero
};

Eigen::MatrixXd influence(Structure structure, Eigen::Index n, double compliance, Random& random);

std::vector<ContactLaw> random_laws(Eigen::Index n, Random& random);

/// A problem of n points anywhere between a watch and a mill: mean line load 1e-3 .. 1e6 N/mm, gaps 0 .. 1 mm, lines of
/// 0.01 .. 10 mm a point, structure of any kind, Hertzian contact in seven of eight and a nearly singular structure in
/// the others.
LoadProblem random_problem(int n, Random& random);

/// How far given loads and approach are from optimal, computed from the statement of the problem alone, each part
/// relative to what it stands beside: the force, and the largest sum of deflections of a loaded point.
struct Optimality {
  double balance{0.0};   ///< |sum a w - F| / F
  double loaded{0.0};    ///< largest |deflection + gap - f| where w > 0
  double unloaded{0.0};  ///< largest penetration where w = 0
  bool non_negative{true};
  double worst() const { return non_negative ? std::max({balance, loaded, unloaded}) : not_given; }
};

Optimality optimality(const LoadProblem& problem, const Eigen::VectorXd& w, double f);

}  // namespace flankwright::load_cases
