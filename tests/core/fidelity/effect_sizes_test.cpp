#include "core/fidelity/effect_sizes.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

/// Slices `scale` times as soft as they are, tied together by a share of their own compliance, so that teeth move each other.
class TiedSlices final : public PairCompliance {
 public:
  TiedSlices(const GearPair& pair, double share, double scale = 1.0) : slices_(ThinSlice(pair, {}, {})), share_(share), scale_(scale) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override {
    const Eigen::MatrixXd own = scale_ * slices_.influence(points, axial_offset);
    return own + Eigen::MatrixXd::Constant(own.rows(), own.cols(), share_ * own.diagonal().minCoeff());
  }

 private:
  ThinSlicePair slices_;
  double share_, scale_;
};

/// Slices on bodies that move as one under whatever acts on them.
class SlicesOnBodies final : public PairCompliance {
 public:
  /// @param body  [mm/N]
  SlicesOnBodies(const GearPair& pair, double body) : slices_(ThinSlice(pair, {}, {})), body_(body) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double axial_offset) const override {
    return influence_on_rigid_bodies(points, axial_offset).array() + body_;
  }
  Eigen::MatrixXd influence_on_rigid_bodies(const std::vector<ContactPoint>& points, double axial_offset) const override {
    return slices_.influence(points, axial_offset);
  }

 private:
  ThinSlicePair slices_;
  double body_;
};

/// Yields to the load's moment about mid face.
class Tilting final : public PairCompliance {
 public:
  explicit Tilting(double compliance) : compliance_(compliance) {}
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double) const override {
    Eigen::VectorXd z(std::ssize(points));
    for (Eigen::Index i = 0; i < z.size(); ++i) z[i] = points[static_cast<std::size_t>(i)].z;
    return compliance_ * z * z.transpose();
  }

 private:
  double compliance_;
};

GearPair helical_pair() { return mesh_cases::pair(20, 31, 15, 5, 40); }

EffectScene scene(double torque) {
  return {.pair = helical_pair(),
          .material = {},
          .resolution = {{QuadratureRule::Gauss2, 8}, equally_spaced_phases(12)},
          .condition = {},
          .pinion_torque = torque};
}

EffectDecisions decisions_of(const EffectScene& s, bool whole_surface = false) {
  return decide_effects({.loaded = true,
                         .conditions = {s.condition},
                         .coupled_teeth = s.structure != nullptr,
                         .gear_bodies = s.structure != nullptr,
                         .shafts = s.shafts != nullptr,
                         .whole_surface = whole_surface});
}

EstimatedSize estimated(const EffectScene& s, const EffectDecisions& decisions, const std::string& name, const SizeOptions& options = {}) {
  for (const EstimatedSize& size : estimate_effect_sizes(s, decisions, options)) {
    if (size.size.name == name) return size;
  }
  FAIL("no size of " << name);
  return {};
}

}  // namespace

TEST_CASE("The size of each effect where it matters and where it does not", "[core][load][effects]") {
  struct Row {
    const char* name;
    EffectScene matters, does_not;
    double at_least, at_most;  ///< shares, exact
  };
  const GearPair pair = helical_pair();
  const TiedSlices tied(pair, 0.3), loose(pair, 1e-4), stiff_teeth(pair, 0.0, 1e-4), soft_teeth(pair, 0.0, 1e4);
  const Tilting soft(1e-7), stiff(1e-14);
  const SlicesOnBodies soft_bodies(pair, 1e-7), stiff_bodies(pair, 1e-13);
  std::vector<Row> rows;
  const auto row = [&](const char* name, double at_least, double at_most, auto change, auto hardly) {
    Row made{name, scene(3e5), scene(3e5), at_least, at_most};
    change(made.matters);
    hardly(made.does_not);
    rows.push_back(made);
  };
  row(
      "misalignment", 0.2, 1e-3, [](EffectScene& s) { s.condition.misalignment.mesh_misalignment = 15 * units::um; },
      [](EffectScene& s) { s.condition.misalignment.mesh_misalignment = 5e-4 * units::um; });
  row(
      "modifications", 0.1, 1e-3, [](EffectScene& s) { s.condition.modification.pinion.lead_crowning = 10 * units::um; },
      [](EffectScene& s) { s.condition.modification.pinion.lead_crowning = 1e-3 * units::um; });
  row(
      "manufacturing_errors", 0.1, 1e-3, [](EffectScene& s) { s.condition.error.wheel.helix_slope = 10 * units::um; },
      [](EffectScene& s) { s.condition.error.wheel.helix_slope = 1e-3 * units::um; });
  row(
      "bending", 0.5, 1e-2, [](EffectScene&) {}, [&](EffectScene& s) { s.structure = &stiff_teeth; });
  row(
      "adjacent_teeth", 0.05, 1e-3, [&](EffectScene& s) { s.structure = &tied; }, [&](EffectScene& s) { s.structure = &loose; });
  row(
      "gear_body_compliance", 0.05, 1e-3, [&](EffectScene& s) { s.structure = &soft_bodies; }, [&](EffectScene& s) { s.structure = &stiff_bodies; });
  row(
      "shafts", 0.02, 1e-3,
      [&](EffectScene& s) {
        s.shafts = &soft;
        s.condition.misalignment.mesh_misalignment = 5 * units::um;
      },
      [&](EffectScene& s) { s.shafts = &stiff; });
  row(
      "hertzian_contact", 0.2, 1e-2, [](EffectScene&) {}, [&](EffectScene& s) { s.structure = &soft_teeth; });
  row(
      "tip_corner", 1e-3, 1e-4, [](EffectScene&) {},
      [](EffectScene& s) {
        s.condition.modification.pinion.tip_relief = {200 * units::um, 3.0};
        s.condition.modification.wheel.tip_relief = {200 * units::um, 3.0};
      });
  // What remains without Poisson's ratio is the bending of sharp edges.
  row(
      "free_ends", 5e-3, 2e-3, [](EffectScene&) {}, [](EffectScene& s) { s.material.pinion.poissons_ratio = s.material.wheel.poissons_ratio = 0; });
  row(
      "extended_contact_region", 1e-3, 1e-9, [](EffectScene& s) { s.pinion_torque = 3e6; }, [](EffectScene& s) { s.pinion_torque = 1.0; });
  for (const Row& r : rows) {
    CAPTURE(r.name);
    for (const bool matters : {true, false}) {
      const EffectScene& s = matters ? r.matters : r.does_not;
      const EffectDecisions decisions = decisions_of(s);
      const EffectInfluence exact = exact_influence(s, decisions, r.name);
      const EstimatedSize estimate = estimated(s, decisions, r.name);
      UNSCOPED_INFO(r.name << (matters ? " matters: " : " does not: ") << 100 * exact.share << " % of " << exact.largest_in << "; estimate "
                           << 100 * estimate.size.influence.share << " % with " << estimate.solved_again << " of " << estimate.positions
                           << " solved again");
      if (matters) CHECK(exact.share >= r.at_least);
      if (!matters) CHECK(exact.share <= r.at_most);
      constexpr double first_order = 0.15;  // what the second order leaves of a size
      constexpr double negligible = 2e-4;   // of shares: below it a size is small, whatever its digits
      CHECK(estimate.size.influence.share == Approx(exact.share).epsilon(first_order).margin(negligible));
      CHECK(estimate.size.influence.te_mean == Approx(exact.te_mean).epsilon(first_order).margin(1e-3 * units::um));
    }
  }
  SUCCEED();
}

TEST_CASE("The error of first order falls as the square of the effect", "[core][load][effects]") {
  const auto error = [](double misalignment) {
    EffectScene s = scene(3e5);
    s.condition.misalignment.mesh_misalignment = misalignment;
    s.condition.modification.pinion.lead_crowning = 4 * units::um;
    // Between A and E all points stay loaded; beyond, some are always about to lose contact.
    const EffectDecisions decisions = without(decisions_of(s), "extended_contact_region", "left out");
    const EffectInfluence exact = exact_influence(s, decisions, "misalignment");
    const EstimatedSize estimate = estimated(s, decisions, "misalignment", {.trust = std::numeric_limits<double>::infinity()});
    CHECK(estimate.solved_again == 0);  // no point leaves contact here
    return std::abs(estimate.size.influence.te_mean - exact.te_mean);
  };
  const double coarse = error(0.8 * units::um), fine = error(0.4 * units::um);
  CHECK(std::log2(coarse / fine) > 1.8);
}

TEST_CASE("Without trust in first order sizes are exact", "[core][load][effects]") {
  EffectScene s = scene(3e5);
  s.condition.misalignment.mesh_misalignment = 6 * units::um;
  s.condition.modification.wheel.lead_crowning = 5 * units::um;
  const EffectDecisions decisions = decisions_of(s);
  constexpr double solver = 1e-9;  // both are solutions of one convex programme, from different starts
  for (const EstimatedSize& size : estimate_effect_sizes(s, decisions, {.trust = 0.0})) {
    CAPTURE(size.size.name);
    const EffectInfluence exact = exact_influence(s, decisions, size.size.name);
    CHECK(size.solved_again == size.positions);
    CHECK(size.size.influence.te_mean == Approx(exact.te_mean).epsilon(solver).margin(1e-12));
    CHECK(size.size.influence.peak_contact_stress == Approx(exact.peak_contact_stress).epsilon(solver).margin(1e-6));
  }
}

TEST_CASE("Contact off the plane of action has a size where flanks are relieved and none where they are not", "[core][load][effects]") {
  EffectScene s = scene(3e5);
  s.resolution.phases = equally_spaced_phases(4);
  const EffectDecisions aligned = decisions_of(s, true);
  CHECK(exact_influence(s, aligned, "whole_surface_gap").share < 5e-3);  // before A the clearances differ, see SurfaceGap
  s.condition.modification.pinion.tip_relief = {60 * units::um, 4.0};
  s.condition.misalignment.centre_distance = 0.3;
  const EffectDecisions relieved = decisions_of(s, true);
  const EffectInfluence exact = exact_influence(s, relieved, "whole_surface_gap");
  CHECK(exact.share > 5e-3);
  CHECK(estimated(s, relieved, "whole_surface_gap").size.influence.share == Approx(exact.share).epsilon(0.15));
}

TEST_CASE("An effect without which nothing would yield has no size", "[core][load][effects]") {
  const EffectScene s = scene(3e5);
  const EffectDecisions bending_only = without(decisions_of(s), "hertzian_contact", "left out");
  CHECK(std::isnan(exact_influence(s, bending_only, "bending").share));
  CHECK(std::isnan(estimated(s, bending_only, "bending").size.influence.share));
}

TEST_CASE("Effects below a budget are dropped and what is lost keeps it", "[core][load][effects]") {
  EffectScene s = scene(3e5);
  const TiedSlices tied(s.pair, 0.002);
  const Tilting stiff(1e-12);
  s.structure = &tied;
  s.shafts = &stiff;
  s.condition.misalignment.mesh_misalignment = 5 * units::um;
  const EffectDecisions decisions = decisions_of(s);
  std::vector<EffectSize> sizes;
  for (const EstimatedSize& size : estimate_effect_sizes(s, decisions)) sizes.push_back(size.size);
  const CycleOutputs all = outputs_with(s, decisions);
  int most_dropped = 0;
  for (const double budget : {1e-5, 1e-3, 1e-2, 0.1}) {
    CAPTURE(budget);
    const EffectDecisions kept = within_budget(decisions, sizes, budget);
    int dropped = 0;
    for (std::size_t i = 0; i < kept.size(); ++i) {
      if (kept[i].on == decisions[i].on) continue;
      ++dropped;
      CHECK(kept[i].why.find("below the budget of") != std::string::npos);
    }
    CHECK(dropped >= most_dropped);
    most_dropped = dropped;
    CHECK(is_on(kept, "misalignment"));   // costs nothing
    constexpr double second_order = 1.2;  // of several at once
    CHECK(EffectInfluence::between(all, outputs_with(s, kept)).share <= second_order * budget);
  }
  CHECK(most_dropped >= 2);
  CHECK(is_on(within_budget(decisions, sizes, 1e9), "bending") != is_on(within_budget(decisions, sizes, 1e9), "hertzian_contact"));
}
