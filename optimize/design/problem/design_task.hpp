#pragma once

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "core/contact/assembly/flank_condition.hpp"
#include "core/contact/gap/gap_model.hpp"
#include "core/load/cycle/mesh_cycle.hpp"
#include "core/load/cycle/mesh_model.hpp"
#include "optimize/design/outputs/aggregate.hpp"
#include "optimize/design/outputs/design_output.hpp"
#include "optimize/design/problem/mesh_store.hpp"

namespace flankwright {

/// A parameter of a modification or of its process that the optimiser may choose.
struct DesignVariable {
  std::string path;  ///< as the study names it: "pinion.modification.lead_crowning"
  Member member{Member::Pinion};
  ModificationParameter parameter{};
  double lower{0.0}, upper{0.0};  ///< [mm; parabolic_te 1/rad; twist_compensation -], lower < upper
  double step{0.0};               ///< the grinder can set multiples of this, unit as the bounds; 0: any value

  /// Value scaled to the range: 0 at the lower bound, 1 at the upper [-].
  double scaled(double value) const { return (value - lower) / (upper - lower); }
  double unscaled(double x) const { return lower + x * (upper - lower); }
  /// Whether it is this parameter of this gear, a half of it, or the whole that it is a half of.
  bool touches(Member of, ModificationParameter other) const;
  /// Factor from the inside unit to that of reports: um, but mm for the extent of a relief, arcsec/deg^2 for parabolic_te.
  double outside_factor() const;
  const char* unit() const;
  /// A value in that unit, without the round-off of the conversion: 6 um, where 0.006 mm times 1000 is 5.999999999999999.
  double outside(double value) const;
};

/// A modification parameter that follows a variable: factor * variable + offset.
struct LinkingConstraint {
  DesignVariable linked;  ///< bounds as the variable's give them; no step
  std::size_t as{0};      ///< index of the variable
  double factor{1.0};     ///< between the inside units [-]
  double offset{0.0};     ///< [mm; parabolic_te 1/rad]
};

/// A bound on an output, to hold in every scene: one of the two is finite and not 0.
struct OutputConstraint {
  ObjectiveTerm output;
  double maximum{std::numeric_limits<double>::infinity()};   ///< inside unit
  double minimum{-std::numeric_limits<double>::infinity()};  ///< inside unit

  bool is_least() const { return minimum > -std::numeric_limits<double>::infinity(); }
  /// Whether the bound is kept where one of the output's smooth functions keeps it: a least value of what is the largest of them, or the
  /// other way round. Else all must.
  bool one_suffices() const { return is_least() != design_output(output.output).is_least; }
  double limit() const { return is_least() ? minimum : maximum; }
  /// Relative distance beyond the bound, below 0 where it is kept [-].
  double excess(double value) const { return (is_least() ? limit() - value : value - limit()) / std::abs(limit()); }
  /// Whether the excess is the largest of smooth functions, so that it can be minimised: of an upper bound, or of a lower one on a positive output that
  /// has_reciprocal().
  bool has_smooth_excess() const { return !is_least() || (minimum > 0.0 && has_reciprocal(design_output(output.output))); }
};

/// What a bound on modifications is for, where a limit of the grinding asks for it.
enum class GrindingLimit { None, Amount, Slope };

/// A bound on a sum of modifications: minimum <= sum of factor * value <= maximum [mm; all of one unit].
struct ModificationConstraint {
  struct Term {
    Member member{Member::Pinion};
    ModificationParameter parameter{};
    double factor{1.0};
  };
  std::string name;  ///< as the study writes it: "pinion.modification.lead_crowning + wheel.modification.lead_crowning"
  std::vector<Term> terms;
  double maximum{std::numeric_limits<double>::infinity()};
  double minimum{-std::numeric_limits<double>::infinity()};
  GrindingLimit grinding{GrindingLimit::None};  ///< Slope: terms are an amount and its extent

  double value(const PerGear<Modification>& modification) const;
  /// As DesignVariable has them, of the first term.
  double outside_factor() const;
  const char* unit() const;
};

/// Two modifications of one gear that a process cannot grind at once.
struct ExcludedPair {
  Member member{Member::Pinion};
  ModificationParameter one{}, other{};
};

/// What cannot be ground whatever its value: designs that no search over continuous values can avoid. See design_to_grind().
struct GrindableAmounts {
  double smallest{0.0};  ///< every varied amount, and every one tied to it, is 0 or at least this either way [mm], >= 0; 0: no limit
  std::vector<ExcludedPair> not_together;

  bool any() const { return smallest > 0.0 || !not_together.empty(); }
};

/// One number that a design is judged by: outputs weighted and summed in each scene, aggregated over the scenes.
struct Objective {
  std::vector<ObjectiveTerm> terms;
  Aggregation over;

  /// Whether its outputs are sums over a load spectrum; all of them are, or none.
  bool over_spectrum() const;
  /// The largest DesignOutput::growth of its outputs.
  double growth() const;
  std::string name() const;  ///< "te_harmonic_1 + te_harmonic_2"
  const char* unit() const;  ///< of its values outside; "weighted sum" of several terms
};

/// An objective that may not exceed a limit.
struct ObjectiveBound {
  Objective objective;
  double limit{std::numeric_limits<double>::infinity()};  ///< outside unit, > 0
};

/// A constraint on an output as a bound on its aggregate: for a lower limit on that of the reciprocal, which is large where the output is too small.
ObjectiveBound bound_on(const OutputConstraint& constraint, const Aggregation& over);

/// An objective's part in a scalarisation: the largest part of all is minimised.
///
///     part = (value - origin) / range,   or, of an objective that is a reciprocal 1/f under a limit 1/m = origin,   1 - origin / value = (m - f) / m
struct ScalarisedObjective {
  Objective objective;
  double origin{0.0};         ///< outside unit
  double range{1.0};          ///< outside unit, > 0
  bool of_reciprocal{false};  ///< the second formula; the value and the origin are > 0

  double part(double value) const { return of_reciprocal ? 1.0 - origin / value : (value - origin) / range; }
  /// Change of the value by that of the part there [outside unit], > 0.
  double range_at(double value) const { return of_reciprocal ? value * value / origin : range; }
};

/// A deviation as far as it can be ground: amounts and extents of a relief do not fall below 0.
/// @param design, deviation  of the parameter [mm or as it is kept]
double allowed_deviation(const ParameterDescription& parameter, double design, double deviation);

/// By how much a gear as it is made differs from the design in one parameter.
struct ModificationDeviation {
  Member member{Member::Pinion};
  ModificationParameter parameter{};
  double value{0.0};  ///< added to the design's [mm; parabolic_te 1/rad]

  /// Adds it, as far as allowed_deviation() has it; a profile crowning is added to both halves, whether or not they are alike.
  void add_to(PerGear<Modification>& modification) const;
  /// Whether a gear of this design has less of it than the whole, so that what it has there does not change with the design.
  bool is_cut(const PerGear<Modification>& design) const;
};

/// One working condition at one torque. Modifications inside `condition` are replaced by the design's, and what the gears differ from it by is added.
struct DesignScene {
  std::string name;
  double weight{1.0};  ///< > 0, of mean and mean + 2 sigma
  double torque{0.0};  ///< on the pinion [N mm], > 0
  FlankCondition condition;
  Operation operation{};  ///< under this torque
  int spectrum{-1};       ///< load cases of the same number make up one load spectrum; -1: of none
  int bin{-1};            ///< which of the spectrum's, as its list counts them
  int spectrum_loads{0};  ///< load cases of that spectrum
  std::vector<ModificationDeviation> deviations{};
  int draw{-1};  ///< load cases of the same number are one draw: the same gears in the same housing; -1: of none

  /// The scene with a design and with what its gears differ from that by, both on the flank that it loads.
  FlankCondition with_design(PerGear<Modification> design) const;
};

/// The variables of a design, its objectives and its constraints.
struct DesignTask {
  GearPair pair;
  PerGear<Material> material;
  MeshResolution resolution;
  MeshEffects effects;
  GapModel gap{GapModel::PlaneOfAction};
  std::shared_ptr<const PairCompliance> structure;           ///< null: thin slices
  std::shared_ptr<const PairCompliance> search_structure{};  ///< cheaper and nearly the same, to search by before `structure`; null: none
  std::shared_ptr<const PairRootStress> root_stress;         ///< null: none
  std::shared_ptr<const PairCompliance> shafts;              ///< null: rigid
  std::shared_ptr<MeshStore> meshes{};                       ///< of the same pair and materials, to share with others; null: none
  PerGear<Modification> modification;                        ///< values of parameters that are not varied, and the start of those that are
  std::shared_ptr<const LifeModel> life{};                   ///< of the outputs that need it; null: none
  std::vector<DesignScene> scenes;                           ///< the first is the nominal one
  std::vector<DesignVariable> variables;
  std::vector<ObjectiveTerm> objective;
  Aggregation over;
  Aggregation within_draw;  ///< of the load cases of one draw, where the scenes are draws; constraints have the worst
  std::vector<OutputConstraint> constraints;
  std::vector<LinkingConstraint> links;
  std::vector<ModificationConstraint> modification_constraints;
  GrindableAmounts grindable;  ///< of the design to grind, chosen after the search
  std::vector<ObjectiveBound> objective_bounds;
  std::vector<ScalarisedObjective> scalarisation;  ///< minimised instead of the objective where not empty
  /// Minimised after the objective in lexicographic order, each while those before it stay within
  /// lexicographic_tolerance of their least values.
  std::vector<Objective> later_objectives;
  double lexicographic_tolerance{0.01};  ///< value <= (1 + tolerance) least [-], > 0
  /// A search near its optimum needs only candidates within this share below a peak [-], > 0; fewer rows, but more rounds from far away.
  double leading_share{1.0};

  Objective combined_objective() const { return {objective, over}; }
  std::string objective_name() const { return combined_objective().name(); }
  const char* objective_unit() const { return combined_objective().unit(); }
};

}  // namespace flankwright
