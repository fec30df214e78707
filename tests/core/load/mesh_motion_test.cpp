#include "core/load/cycle/mesh_motion.hpp"

#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "core/load/cycle/cycle_gradient.hpp"
#include "core/rating/peak_gradient.hpp"
#include "core/rating/position_gradient.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/core/load/synthetic_root_stress.hpp"
#include "core/gear/gear_pair.hpp"

using namespace flankwright;
using mesh_cases::steel;
using mesh_cases::torque_for;

namespace {

const std::vector<MeshParameter> offset_and_torque{&Misalignment::axial_offset, PinionTorque{}};

/// A pair whose mesh a number of its misalignment moves.
struct MotionCase {
  GearPair gears;
  FlankCondition condition{};
  MeshResolution resolution{};
  GapModel gap{GapModel::PlaneOfAction};
  MeshEffects effects{};
  const PairRootStress* root_stress{nullptr};
  MisalignmentParameter by{&Misalignment::axial_offset};

  FlankCondition at(double value) const {
    FlankCondition moved = condition;
    moved.misalignment.*by = value;
    return moved;
  }
  /// With what derivatives need.
  MeshModel mesh(double value, const MeshResolution& resolved) const {
    const MeshPlaced placed = [&](const MeshPlacement& placement) { return alone(placement, resolved); };
    return with_perturbed_meshes(alone(value, resolved), placed, {by});
  }
  MeshModel alone(double value, const MeshResolution& resolved) const { return alone(MeshPlacement::of(gap, at(value).misalignment), resolved); }
  MeshModel alone(const MeshPlacement& placement, const MeshResolution& resolved) const {
    return make_mesh_model(gears, {steel, steel}, resolved, effects, placement, {.root_stress = root_stress});
  }
  LoadedCycle solved(double value, const MeshModel& model, const std::vector<MeshParameter>& parameters = {}) const {
    return analyse_cycle(model, at(value), torque_for(gears, 150), parameters);
  }
};

/// What position_gradient() has the derivatives of.
struct ReadPosition {
  Eigen::VectorXd point_force, gap, error, structural_deflection, contact_deflection;
  std::vector<LineEnd> ends;
  std::vector<ToothShare> shares;

  ReadPosition(const MeshModel& mesh, const FlankCondition& condition, const LoadedCycle& cycle, std::size_t p) {
    const MeshPosition& at = mesh.positions[p];
    const LoadedPosition& loaded = cycle.positions[p];
    point_force = at.weight.cwiseProduct(loaded.load.line_load);
    gap = loaded.gap.total;
    error = loaded.gap.error;
    structural_deflection = loaded.load.structural_deflection;
    contact_deflection = loaded.load.contact_deflection;
    ends = line_ends(mesh, at, loaded, condition);
    shares = load_sharing(at, loaded);
  }
};

MotionCase unequal_faces(double helix_deg, double pinion_face, double wheel_face) {
  PairData data = mesh_cases::pair_data(19, 41, helix_deg, 5, pinion_face);
  data.wheel.face_width = wheel_face;
  return {make_gear_pair(data)};
}

}  // namespace

TEST_CASE("Loaded contact changes with what moves the mesh as meshes made and solved again say", "[core][load][gradient]") {
  // Step^2 of the differences against changes over `change`, and what the solver leaves of loads, 1e-10, over the step; of a peak its
  // own size over that change.
  constexpr double kDifference = 2e-5;
  struct Motion {
    double helix;
    QuadratureRule rule;
    GapModel gap;
    MisalignmentParameter by;
    double value, change;  ///< a change of loads by much of themselves
  };
  using enum QuadratureRule;
  using enum GapModel;
  const Motion motion = GENERATE(
      Motion{0, Gauss2, PlaneOfAction, &Misalignment::axial_offset, -1.3, 40}, Motion{0, Gauss2, PlaneOfAction, &Misalignment::axial_offset, 2.1, 40},
      Motion{25, Graded, PlaneOfAction, &Misalignment::axial_offset, 2.1, 40},
      Motion{25, Gauss2, WholeSurface, &Misalignment::axial_offset, -1.3, 40}, Motion{12, Graded, WholeSurface, &Misalignment::axial_offset, 2.1, 40},
      Motion{25, Graded, WholeSurface, &Misalignment::crossing, 3e-4, 3e-4}, Motion{0, Gauss2, WholeSurface, &Misalignment::crossing, -2e-4, 3e-4},
      Motion{25, Gauss2, WholeSurface, &Misalignment::intersecting, -8e-4, 8e-4},
      Motion{25, Graded, WholeSurface, &Misalignment::centre_distance, 0.2, 1},
      Motion{0, Graded, WholeSurface, &Misalignment::centre_distance, -0.1, 1},
      Motion{25, Graded, WholeSurface, &Misalignment::pinion_lead_angle, 1e-4, 3e-4},
      Motion{25, Gauss2, WholeSurface, &Misalignment::pinion_pressure_angle, 2e-4, 1e-3},
      Motion{25, Graded, WholeSurface, &Misalignment::mesh_misalignment, 0.012, 0.02});
  const double helix = motion.helix, value = motion.value, change = motion.change, step = 5e-5 * change;
  MotionCase of = unequal_faces(helix, 40, 40);
  const mesh_cases::SyntheticRootStress roots(of.gears);
  of.root_stress = &roots;
  of.condition = mesh_cases::worked_condition();
  of.gap = motion.gap;
  of.by = motion.by;
  of.resolution = {{motion.rule, 3}, of.gap == WholeSurface ? std::vector{0.11, 0.72} : std::vector{0.11, 0.35, 0.72, 0.9}};
  const std::vector<MeshParameter> by{of.by, PinionTorque{}};
  const MeshModel model = of.mesh(value, of.resolution), above = of.alone(value + step, of.resolution), below = of.alone(value - step, of.resolution);
  const LoadedCycle here = of.solved(value, model, by), up = of.solved(value + step, above), down = of.solved(value - step, below);
  REQUIRE(here.usable());
  const auto check = [&](double exact, double high, double low, double size) {
    CHECK(std::abs(exact - (high - low) / (2 * step)) <= kDifference * std::max(size / change, std::abs(exact)));
  };
  for (std::size_t p = 0; p < here.positions.size(); ++p) {
    const LoadedPosition &at = here.positions[p], &high = up.positions[p], &low = down.positions[p];
    CAPTURE(helix, name_of(of.by), value, at.phase);
    check(at.transmission_error_derivative[0], high.load.transmission_error, low.load.transmission_error, at.load.transmission_error);
    check(stiffness_derivative(here, at)[0], high.stiffness, low.stiffness, at.stiffness);
    const auto same_high = same_points(model.positions[p], above.positions[p]), same_low = same_points(model.positions[p], below.positions[p]);
    for (Eigen::Index i = 0; i < at.load.line_load.size(); ++i) {
      const Eigen::Index h = same_high[static_cast<std::size_t>(i)], l = same_low[static_cast<std::size_t>(i)];
      if (h < 0 || l < 0) continue;
      check(at.line_load_derivative(i, 0), high.load.line_load[h], low.load.line_load[l], at.load.line_load.maxCoeff());
      // Stress goes with the root of the load, which a step must not change by much.
      if (std::abs(at.line_load_derivative(i, 0)) * step > 0.01 * at.load.line_load[i]) continue;
      check(at.contact_stress_derivative(i, 0), high.contact_stress[h], low.contact_stress[l], at.contact_stress.maxCoeff());
    }
    for (Eigen::Index i = 0; i < at.root_stress.size(); ++i) {
      check(root_stress_derivative(model.positions[p], at, i)[0], high.root_stress[i], low.root_stress[i], at.root_stress.maxCoeff());
    }
  }
  for (std::size_t p = 0; p < here.positions.size(); ++p) {
    const auto at = [&](const MeshModel& mesh, const LoadedCycle& cycle, double moved) { return ReadPosition(mesh, of.at(moved), cycle, p); };
    const ReadPosition read = at(model, here, value), high = at(above, up, value + step), low = at(below, down, value - step);
    const PositionGradient gradient = position_gradient(model, of.at(value), here, p, read.ends, by);
    CAPTURE(helix, name_of(of.by), value, p);
    const auto same_high = same_points(model.positions[p], above.positions[p]), same_low = same_points(model.positions[p], below.positions[p]);
    for (const auto& [exact, values] :
         {std::pair{&gradient.point_force, &ReadPosition::point_force}, std::pair{&gradient.gap, &ReadPosition::gap},
          std::pair{&gradient.error, &ReadPosition::error}, std::pair{&gradient.structural_deflection, &ReadPosition::structural_deflection},
          std::pair{&gradient.contact_deflection, &ReadPosition::contact_deflection}}) {
      const double size = std::max((read.*values).cwiseAbs().maxCoeff(), gradient.gap.col(0).cwiseAbs().maxCoeff() * change);
      for (Eigen::Index i = 0; i < exact->rows(); ++i) {
        const Eigen::Index h = same_high[static_cast<std::size_t>(i)], l = same_low[static_cast<std::size_t>(i)];
        if (h >= 0 && l >= 0)
          check((*exact)(i, 0), (high.*values)[h], (low.*values)[l], values == &ReadPosition::point_force ? (read.*values).maxCoeff() : size);
      }
    }
    REQUIRE(read.ends.size() == high.ends.size());
    REQUIRE(read.shares.size() == high.shares.size());
    for (std::size_t e = 0; e < read.ends.size(); ++e) {
      const auto row = static_cast<Eigen::Index>(e);
      check(gradient.line_end_load(row, 0), high.ends[e].line_load, low.ends[e].line_load, here.positions[p].load.line_load.maxCoeff());
      if (std::abs(gradient.line_end_load(row, 0)) * step > 0.01 * read.ends[e].line_load) continue;
      check(gradient.line_end_stress(row, 0), high.ends[e].contact_stress, low.ends[e].contact_stress, here.positions[p].contact_stress.maxCoeff());
    }
    for (std::size_t t = 0; t < read.shares.size(); ++t) {
      check(gradient.shares(static_cast<Eigen::Index>(t), 0), high.shares[t].share, low.shares[t].share, 1.0);
    }
    CHECK(gradient.shares.colwise().sum().cwiseAbs().maxCoeff() <= 1e-12);  // round-off
    CHECK(std::abs(gradient.point_force.col(0).sum()) <= kDifference * here.force / change);
  }
  const CycleSummary summary = summarise(model, here);
  const CycleGradient gradient = summary_gradient(model, here, summary);
  check(gradient.load_factor[0], summarise(above, up).load_factor, summarise(below, down).load_factor, summary.load_factor);
  check(gradient.mean_stiffness[0], summarise(above, up).mean_stiffness, summarise(below, down).mean_stiffness, summary.mean_stiffness);
}

TEST_CASE("Differences of solved cycles close in with the square of their step on derivatives by what moves the mesh", "[core][load][gradient]") {
  // A misaligned helical pair. What differences over h and h/2 extrapolate to, (4 D(h/2) - D(h))/3, is left with their fourth order, a small part of
  // what they differ by; beside it the round-off of places over the meshes' step, 1e-10 mm over 1e-4 mm, relative to a change that a parameter gives.
  constexpr double kFourthOrder = 0.01, kMeshes = 1e-6;
  struct Motion {
    MisalignmentParameter by;
    double change, h;
  };
  const Motion motion = GENERATE(Motion{&Misalignment::crossing, 3e-4, 1e-5}, Motion{&Misalignment::intersecting, 8e-4, 1e-5},
                                 Motion{&Misalignment::centre_distance, 1, 5e-3}, Motion{&Misalignment::axial_offset, 40, 5e-3},
                                 Motion{&Misalignment::pinion_lead_angle, 3e-4, 1e-5}, Motion{&Misalignment::pinion_pressure_angle, 1e-3, 1e-5},
                                 Motion{&Misalignment::mesh_misalignment, 0.02, 2e-4});
  MotionCase of = unequal_faces(25, 40, 38);
  const mesh_cases::SyntheticRootStress roots(of.gears);
  of.root_stress = &roots;
  of.gap = GapModel::WholeSurface;
  of.by = motion.by;
  of.condition.modification.pinion.lead_crowning = 6 * units::um;
  of.condition.modification.wheel.addendum_crowning = 8 * units::um;
  of.condition.misalignment = {
      .crossing = 3e-4, .intersecting = -8e-4, .centre_distance = 0.2, .axial_offset = 2.1, .mesh_misalignment = 4 * units::um};
  of.resolution = {{QuadratureRule::Graded, 3}, equally_spaced_phases(3)};
  const double value = of.condition.misalignment.*of.by, h = motion.h;
  const MeshModel model = of.mesh(value, of.resolution);
  const LoadedCycle cycle = of.solved(value, model, {of.by});
  const CycleSummary here = summarise(model, cycle);
  const CycleGradient gradient = summary_gradient(model, cycle, here);
  const auto moved = [&](double by) {
    const MeshModel mesh = of.alone(value + by, of.resolution);
    return summarise(mesh, of.solved(value + by, mesh));
  };
  const double deflection = cycle.positions.front().load.structural_deflection.maxCoeff();
  const CycleSummary far_up = moved(h), up = moved(h / 2), down = moved(-h / 2), far_down = moved(-h);
  for (const auto& [exact, output] :
       {std::pair{&CycleGradient::te_mean, &CycleSummary::te_mean}, std::pair{&CycleGradient::te_peak_to_peak, &CycleSummary::te_peak_to_peak},
        std::pair{&CycleGradient::peak_contact_stress, &CycleSummary::peak_contact_stress},
        std::pair{&CycleGradient::peak_line_load, &CycleSummary::peak_line_load}, std::pair{&CycleGradient::load_factor, &CycleSummary::load_factor},
        std::pair{&CycleGradient::mean_stiffness, &CycleSummary::mean_stiffness},
        std::pair{&CycleGradient::peak_root_stress, &CycleSummary::peak_root_stress}}) {
    const double wide = (far_up.*output - far_down.*output) / (2 * h), narrow = (up.*output - down.*output) / h;
    const double extrapolated = (4 * narrow - wide) / 3, found = (gradient.*exact)[0];
    const double size = output == &CycleSummary::te_peak_to_peak ? deflection : here.*output;  // peak to peak: of what is taken off each other
    CAPTURE(name_of(of.by), here.*output, found, wide, narrow, (found - extrapolated) / extrapolated);
    CHECK(std::abs(found - extrapolated) <= kFourthOrder * std::abs(wide - narrow) + kMeshes * std::max(std::abs(found), size / motion.change));
  }
}

TEST_CASE("Even teeth that lose face to an offset carry what more torque would give them", "[core][load][gradient][closed-form]") {
  // Aligned spur teeth without free ends know load per face width only: by F/(b - s), d/ds = F/b d/dF.
  MotionCase of{mesh_cases::pair(20, 33, 0, 4, 30)};
  of.effects = MeshEffects::all_but({"free_ends"});
  of.condition.modification.pinion.tip_relief = {8 * units::um, 2, ReliefShape::Linear};
  const MeshModel model = of.mesh(0.0, {{QuadratureRule::Gauss3, 4}, equally_spaced_phases(6)});
  const LoadedCycle cycle = of.solved(0.0, model, offset_and_torque);
  const double torque_over_face = torque_for(of.gears, 150) / of.gears.face_width;
  constexpr double kOffset = 1e-6;  // mesh_step^2, and round-off over it
  for (const LoadedPosition& at : cycle.positions) {
    CHECK(at.transmission_error_derivative[0] == Approx(torque_over_face * at.transmission_error_derivative[1]).epsilon(kOffset));
    for (Eigen::Index i = 0; i < at.load.line_load.size(); ++i) {
      CAPTURE(at.phase, i);
      CHECK(at.line_load_derivative(i, 0) == Approx(torque_over_face * at.line_load_derivative(i, 1)).epsilon(kOffset).margin(1e-5));
      CHECK(at.contact_stress_derivative(i, 0) == Approx(torque_over_face * at.contact_stress_derivative(i, 1)).epsilon(kOffset).margin(1e-5));
    }
  }
}

TEST_CASE("Within a wider mate's face a wheel's offset turns it along its helix, and no more", "[core][load][gradient][closed-form]") {
  // Flanks that are alike all along know of the offset by their phase and by the wheel's lag on its helix; the pinion's ends are far away.
  const double helix = GENERATE(0.0, 20.0);
  MotionCase of = unequal_faces(helix, 60, 30);
  of.effects = MeshEffects::all_but({"free_ends"});
  of.condition.modification.wheel.tip_relief = {8 * units::um, 2, ReliefShape::Linear};
  const double offset = 4, step = 1e-5;
  const auto mesh = [&](double phase) { return of.mesh(offset, {{QuadratureRule::Graded, 4}, {phase}}); };
  const PathOfContact path(of.gears);
  for (const double phase : {0.07, 0.4, 0.81}) {
    const LoadedCycle cycle = of.solved(offset, mesh(phase), offset_and_torque);
    const auto te = [&](double at) { return of.solved(offset, mesh(at)).positions[0].load.transmission_error; };
    const double by_phase = (te(phase + step) - te(phase - step)) / (2 * step);
    const double along_helix = -of.gears.contact_line_sense() * std::sin(of.gears.base_helix_angle);
    CAPTURE(helix, phase);
    CHECK(cycle.positions[0].transmission_error_derivative[0] == Approx(along_helix + path.slope * by_phase).epsilon(1e-6).margin(1e-9));
    CHECK(cycle.face_width_change[0] == 0.0);
  }
}

TEST_CASE("Located peaks and K_Hbeta follow what moves the mesh to where they are found again", "[core][load][peaks][gradient]") {
  constexpr double kLocated = 2e-3, phase_tolerance = 2e-6;  // to which both peaks of a difference are located [base pitches]
  struct Motion {
    double helix;
    GapModel gap;
    MisalignmentParameter by;
    double value, change;  ///< a change of loads by much of themselves
  };
  const Motion motion = GENERATE(Motion{0, GapModel::PlaneOfAction, &Misalignment::axial_offset, 2, 40},
                                 Motion{25, GapModel::PlaneOfAction, &Misalignment::axial_offset, 2, 40},
                                 Motion{25, GapModel::WholeSurface, &Misalignment::crossing, 2e-4, 3e-4},
                                 Motion{25, GapModel::WholeSurface, &Misalignment::centre_distance, 0.2, 1});
  const double value = motion.value, step = 1e-4 * motion.change;
  MotionCase of = unequal_faces(motion.helix, 40, 40);
  of.gap = motion.gap;
  of.by = motion.by;
  of.condition.modification.pinion.lead_crowning = 5 * units::um;
  of.condition.misalignment.mesh_misalignment = 6 * units::um;
  const double torque = torque_for(of.gears, 150);
  const auto resolved = [](const std::vector<double>& phases) { return MeshResolution{{QuadratureRule::Graded, 5}, phases}; };
  const auto peaks = [&](const FlankCondition& condition) {
    const auto mesh = [&](const std::vector<double>& phases) {
      return of.alone(MeshPlacement::of(of.gap, condition.misalignment), resolved(phases));
    };
    return locate_peaks(mesh, condition, torque, {.phase_tolerance = phase_tolerance, .value_tolerance = 0.0});
  };
  const ContactPeaks here = peaks(of.at(value)), up = peaks(of.at(value + step)), down = peaks(of.at(value - step));
  const MeshAt mesh_at = [&](const std::vector<double>& phases) { return of.mesh(value, resolved(phases)); };
  const PeakGradients gradients = peak_gradients(mesh_at, of.at(value), torque, here, {of.by, PinionTorque{}});
  const auto check = [&](const Eigen::RowVectorXd& exact, const LinePeak& at, const LinePeak& high, const LinePeak& low) {
    CAPTURE(motion.helix, name_of(of.by), at.value, at.phase, at.tooth, at.z, high.phase, high.z, low.phase, low.z);
    const double difference = (high.value - low.value) / (2 * step);
    CHECK(std::abs(exact[0] - difference) <= kLocated * (std::abs(difference) + at.value / motion.change));
  };
  check(gradients.with_spikes.contact_stress, here.with_spikes.contact_stress, up.with_spikes.contact_stress, down.with_spikes.contact_stress);
  check(gradients.with_spikes.line_load, here.with_spikes.line_load, up.with_spikes.line_load, down.with_spikes.line_load);
  check(gradients.without_spikes.contact_stress, here.without_spikes.contact_stress, up.without_spikes.contact_stress,
        down.without_spikes.contact_stress);
  check(gradients.without_spikes.line_load, here.without_spikes.line_load, up.without_spikes.line_load, down.without_spikes.line_load);
  if (!acts(of.by, lead_part) || acts(of.by, perfect_part)) return;
  // Nothing but leads: all of it is the part that K_Hbeta counts, and the perfect pair is not moved.
  REQUIRE(lead_part(of.at(value)) == of.at(value));
  const ContactPeaks perfect = peaks(perfect_part(of.at(value)));
  const MeshAt aligned_at = [&](const std::vector<double>& phases) { return of.alone(MeshPlacement::of(of.gap, {}), resolved(phases)); };
  const RatedPeaks rated{here, gradients},
      unmoved{perfect, peak_gradients_of_part(aligned_at, of.at(value), perfect_part, torque, perfect, {of.by, PinionTorque{}})};
  const auto factor = [&](const ContactPeaks& found) { return load_factors(perfect, found, perfect, found).without_spikes.lead; };
  const double difference = (factor(up) - factor(down)) / (2 * step);
  CHECK(std::abs(load_factor_gradients(unmoved, rated, unmoved, rated).without_spikes.lead[0] - difference) <=
        kLocated * (std::abs(difference) + 1 / motion.change));
}

TEST_CASE("A mesh without perturbed meshes refuses derivatives by parameters that move it", "[core][load][gradient][input]") {
  const GearPair gears = mesh_cases::pair(20, 40, 0, 4, 30);
  const MeshModel model = mesh_cases::model(gears, {{}, {0.5}});
  CHECK_THROWS_AS(analyse_cycle(model, {}, torque_for(gears, 100), offset_and_torque), InvalidInput);
}
