#pragma once

#include <Eigen/Core>
#include <functional>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"
#include "optimize/solvers/solver_options.hpp"

namespace flankwright {

/// What an amount is held to.
enum class HeldAmount {
  AtZero,   ///< it is not ground
  AtLeast,  ///< it is the smallest amount or more
  AtMost    ///< the same of a negative amount: minus the smallest or less
};

/// One of the ways to make a design grindable: the best design found with it.
struct GrindingAlternative {
  std::size_t amount{0};  ///< which of GrindingChoice::amounts is held
  HeldAmount held{HeldAmount::AtZero};
  double limit{0.0};                         ///< that it is held to [mm]; 0 of AtZero
  double value{not_given};                   ///< of that amount in this design [mm; parabolic_te 1/rad]
  double objective{not_given};               ///< outside units; NaN where no design could be analysed
  double constraint_violation{not_given};    ///< [-]
  double modification_violation{not_given};  ///< its part by limits on modifications [-]
};

/// Something of a design that cannot be ground, and how that was settled.
struct GrindingChoice {
  struct Amount {
    Member member{Member::Pinion};
    ModificationParameter parameter{};
    double found{not_given};  ///< as the search left it [mm; parabolic_te 1/rad]
  };
  std::vector<Amount> amounts;             ///< one: it is below the smallest amount; two: they are not ground together
  std::vector<GrindingAlternative> tried;  ///< at least one
  std::size_t taken{0};                    ///< of those tried

  bool is_of_pair() const { return amounts.size() == 2; }
};

/// A design that can be ground.
struct DesignToGrind {
  Eigen::VectorXd x;  ///< scaled
  std::vector<GrindingChoice> choices;
  bool is_changed{false};  ///< a choice was made or there are steps: x may differ from the design that was given
  int analyses{0};         ///< of the whole scene set, see RoundedDesign::analyses
  int choice_analyses{0};  ///< those of them that choices took
  int failures{0};         ///< analyses that did not converge; survived
};

/// The best design found in a part of 0 .. 1.
struct HeldDesign {
  Eigen::VectorXd x;                       ///< scaled
  double objective{not_given};             ///< outside units; NaN where no design could be analysed
  double constraint_violation{not_given};  ///< [-]
};

/// A search from `start`, which may lie outside, in the part lower <= x <= upper of 0 .. 1.
using HeldSearch = std::function<HeldDesign(const Eigen::VectorXd& lower, const Eigen::VectorXd& upper, const Eigen::VectorXd& start)>;

/// A design whose amounts can be ground, and the part of 0 .. 1 in which every design keeps to what was decided.
struct SettledAmounts {
  Eigen::VectorXd x, lower, upper;  ///< scaled
  std::vector<GrindingChoice> choices;
};

/// Decides on amounts below the smallest and on pairs that are not ground together, as design_to_grind() says, by any search.
/// @throws InvalidInput "optimise.grinding" where the variables' ranges leave no alternative
SettledAmounts settle_amounts(const DesignProblem& problem, const Eigen::VectorXd& x, const HeldSearch& search);

/// Makes a design grindable, in this order:
///
/// - Of a pair that is not ground together (GrindableAmounts::not_together) each of the two is held at zero in turn, where the variables can hold it
///   there, and the search goes on from the design with the other variables free.
/// - An amount below the smallest (GrindableAmounts::smallest, raised to a step of the variable) is held at zero, and at the smallest amount or more with the sign that it has, likewise.
///   Amounts are taken up one after the other, the one that is the smallest part of what it should be first.
/// - round_design() with what was decided held.
///
/// Of two alternatives the one that keeps the limits on modifications is taken: a design that exceeds them cannot be ground, whatever its outputs are. Then
/// the one that keeps the other constraints, then that of the lower objective, then the first. Decisions are not taken back, so that
/// the best of all combinations may be missed where several amounts are too small.
/// @param problem  its box is back at what it was afterwards
/// @param options  of the search that goes on; max_evaluations of all together
/// @throws InvalidInput "optimise.grinding" where the variables' ranges leave no alternative
DesignToGrind design_to_grind(DesignProblem& problem, const Eigen::VectorXd& x, const SolverOptions& options);

}  // namespace flankwright
