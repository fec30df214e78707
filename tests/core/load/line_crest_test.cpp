#include "core/load/cycle/line_crest.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <memory>
#include <utility>

#include "core/load/cycle/contact_stress.hpp"
#include "tests/core/load/mesh_cases.hpp"

using namespace flankwright;

namespace {

constexpr double crest_torque = 120e3;

GearPair relieved_pair() { return make_gear_pair(mesh_cases::pair_data(23, 67, 28, 1.75, 28)); }

FlankCondition with_reliefs(ReliefShape shape = ReliefShape::Linear) {
  FlankCondition condition;
  condition.modification.pinion.lead_crowning = 8 * units::um;
  condition.modification.pinion.tip_relief = condition.modification.wheel.tip_relief = {14 * units::um, 0.9, shape};
  return condition;
}

MeshModel by_graded(const GearPair& gears, int intervals, int positions = 16, const PairCompliance* structure = nullptr) {
  return make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{QuadratureRule::Graded, intervals}, equally_spaced_phases(positions)}, {},
                         {}, {structure});
}

/// Teeth that yield over a few millimetres around a load, with contact that yields beside it as well.
class SoftTeeth final : public PairCompliance {
 public:
  Eigen::MatrixXd influence(const std::vector<ContactPoint>& points, double /*axial_offset*/) const override {
    constexpr double most = 4e-6, reach = 4.0;  // mm/N, mm
    const auto n = std::ssize(points);
    Eigen::MatrixXd K = Eigen::MatrixXd::Zero(n, n);
    for (Eigen::Index i = 0; i < n; ++i) {
      for (Eigen::Index j = 0; j < n; ++j) {
        const ContactPoint &p = points[static_cast<std::size_t>(i)], &q = points[static_cast<std::size_t>(j)];
        if (p.tooth == q.tooth) K(i, j) = most * std::exp(-std::pow((p.z - q.z) / reach, 2));
      }
    }
    return K;
  }
  HalfSpaceCorrections half_space_corrections() const override {
    const auto none = std::make_shared<const HalfSpaceCorrection>(1.0, 2.0, std::vector{0.0, 1.0}, std::vector{0.0, 0.0});
    return {none, none};
  }
};

/// Crests of every position of a cycle.
std::vector<std::vector<LineCrest>> crests_of(const MeshModel& model, const FlankCondition& condition) {
  const LoadedCycle cycle = analyse_cycle(model, condition, crest_torque);
  const ConditionGap gaps(model.pair, model.placement.gap, condition);
  const PairReliefStarts starts = relief_starts(model.pair, condition);
  std::vector<std::vector<LineCrest>> all;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const LoadedPosition& loaded = cycle.positions[i];
    const MeshPosition& at = model.positions[i];
    all.push_back(line_crests({model, at, gaps, starts, loaded.gap, cycle.force, at.laws, loaded.load.line_load, loaded.load.structural_deflection}));
  }
  return all;
}

/// The largest load of a line among its points from one z to another.
double largest_load(const MeshPosition& at, const LoadedPosition& loaded, int tooth, double from, double to) {
  double largest = 0.0;
  for (std::size_t k = 0; k < at.points.size(); ++k) {
    if (at.points[k].tooth == tooth && at.points[k].z >= from && at.points[k].z <= to)
      largest = std::max(largest, loaded.load.line_load[static_cast<Eigen::Index>(k)]);
  }
  return largest;
}

/// Errors of the largest load between the points beside a crest, as shares of the largest load of the position.
struct CrestErrors {
  double by_points{0.0}, by_crests{0.0};  ///< the largest
  double rms_by_points{0.0}, rms_by_crests{0.0};
};

CrestErrors crest_errors(const MeshModel& model, const MeshModel& fine, const FlankCondition& condition) {
  const LoadedCycle cycle = analyse_cycle(model, condition, crest_torque), truth = analyse_cycle(fine, condition, crest_torque);
  const std::vector<std::vector<LineCrest>> crests = crests_of(model, condition);
  CrestErrors errors;
  int count = 0;
  for (std::size_t i = 0; i < crests.size(); ++i) {
    const double largest = truth.positions[i].load.line_load.maxCoeff();
    for (const LineCrest& crest : crests[i]) {
      const auto before = static_cast<std::size_t>(crest.before);
      const double from = model.positions[i].points[before].z, to = model.positions[i].points[before + 1].z;
      const double load = largest_load(fine.positions[i], truth.positions[i], crest.place.tooth, from, to);
      const double by_points = largest_load(model.positions[i], cycle.positions[i], crest.place.tooth, from, to);
      const double by_crests = std::max(by_points, load_on_crest(model.positions[i].laws, crest).line_load);
      const double of_points = std::abs(by_points - load) / largest, of_crests = std::abs(by_crests - load) / largest;
      errors.by_points = std::max(errors.by_points, of_points);
      errors.by_crests = std::max(errors.by_crests, of_crests);
      errors.rms_by_points += of_points * of_points;
      errors.rms_by_crests += of_crests * of_crests;
      ++count;
    }
  }
  for (double* sum : {&errors.rms_by_points, &errors.rms_by_crests}) *sum = std::sqrt(*sum / count);
  return errors;
}

}  // namespace

TEST_CASE("A crest has the load that only many more points come near", "[core][load][crest][slow]") {
  const GearPair gears = relieved_pair();
  const CrestErrors errors = crest_errors(by_graded(gears, 6), by_graded(gears, 192), with_reliefs());
  CAPTURE(errors.by_points, errors.by_crests);
  CHECK(errors.by_points > 0.01);  // there is something to see
  // Discretisation: f_t of six intervals, the structure between points, and the rounding of the kink over R h' along the profile.
  CHECK(errors.by_crests < 0.25 * errors.by_points);
}

TEST_CASE("So has a crest beside which contact yields too", "[core][load][crest][slow]") {
  const GearPair gears = relieved_pair();
  const SoftTeeth structure;
  const int intervals = GENERATE(6, 12);
  const CrestErrors errors = crest_errors(by_graded(gears, intervals, 8, &structure), by_graded(gears, 96, 8, &structure), with_reliefs());
  CAPTURE(intervals, errors.rms_by_points, errors.rms_by_crests);
  CHECK(errors.rms_by_points > 0.02);
  // As above. If contact took nothing back of the load on a crest, the crest would be as far off as the points.
  CHECK(errors.rms_by_crests < 0.55 * errors.rms_by_points);
}

TEST_CASE("Crests lie where reliefs begin: on their circles or at their distance from the face ends", "[core][load][crest]") {
  constexpr double kRoundOff = 1e-9;  // mm
  const GearPair gears = relieved_pair();
  FlankCondition condition = with_reliefs();
  condition.modification.wheel.end_relief = {5 * units::um, 4.0};
  condition.misalignment.axial_offset = 0.5;
  const auto tip_start = [&](Member m) { return gears.flank_frame(m).tip_radius - condition.modification[m].tip_relief.height; };
  const double end_start = 0.5 * gears.flank_frame(Member::Wheel).face_width - 4.0;
  std::array<int, 3> found{};
  MeshModel model = make_mesh_model(gears, {mesh_cases::steel, mesh_cases::steel}, {{QuadratureRule::Graded, 8}, equally_spaced_phases(16)}, {},
                                    placement_of(GapModel::PlaneOfAction, condition, nullptr, crest_torque));
  for (const std::vector<LineCrest>& at_position : crests_of(model, condition)) {
    for (const LineCrest& crest : at_position) {
      const double z = crest.place.z - (crest.gear == Member::Wheel ? 0.5 : 0.0);
      const double radius = crest.gear == Member::Pinion ? crest.place.pinion_radius : crest.place.wheel_radius;
      const bool on_circle = std::abs(radius - tip_start(crest.gear)) < kRoundOff;
      const bool near_end = crest.gear == Member::Wheel && std::abs(std::abs(z) - end_start) < kRoundOff;
      CHECK((on_circle || near_end));
      ++found[near_end ? 2 : static_cast<std::size_t>(crest.gear)];
    }
  }
  for (const int count : found) CHECK(count > 0);
}

TEST_CASE("Parabolic reliefs and flanks without relief have no crests", "[core][load][crest]") {
  const GearPair gears = relieved_pair();
  const MeshModel model = by_graded(gears, 6, 4);
  FlankCondition crowned;
  crowned.modification.pinion.lead_crowning = 8 * units::um;
  for (const FlankCondition& condition : {with_reliefs(ReliefShape::Parabolic), crowned}) {
    for (const auto& at_position : crests_of(model, condition)) CHECK(at_position.empty());
  }
}

TEST_CASE("The load on a crest is continuous where the relief's start passes a point", "[core][load][crest]") {
  constexpr double kClose = 1e-4;  // of the way between two points
  const GearPair gears = relieved_pair();
  const MeshModel model = by_graded(gears, 6, 4);
  FlankCondition condition = with_reliefs();
  // The circle of a loaded point of the pinion.
  const ContactPoint* chosen = nullptr;
  const double from = gears.pinion.tip_radius - 1.0;
  for (const ContactPoint& point : model.positions[1].points) {
    if (point.pinion_radius > from && point.pinion_radius < from + 0.5 && std::abs(point.z) < 6.0) chosen = &point;
  }
  REQUIRE(chosen != nullptr);
  const auto load_at = [&](double beyond) {
    condition.modification.pinion.tip_relief.height = gears.pinion.tip_radius - chosen->pinion_radius - beyond;
    condition.modification.wheel.tip_relief.amount = 0.0;
    const LoadedPosition loaded = analyse_cycle(model, condition, crest_torque).positions[1];
    return loaded.peak_load[chosen - model.positions[1].points.data()];
  };
  const double here = load_at(0.0);
  CHECK(load_at(kClose) == Approx(here).epsilon(1e-3));
  CHECK(load_at(-kClose) == Approx(here).epsilon(1e-3));
}

namespace {

/// Compares slopes on crests with central differences, and tells how many.
int check_slopes_on_crests(const FlankCondition& condition, const std::vector<GearParameter>& parameters) {
  const GearPair gears = relieved_pair();
  const MeshModel model = by_graded(gears, 6);
  const LoadedCycle cycle = analyse_cycle(model, condition, crest_torque, {parameters.begin(), parameters.end()});
  int on_crests = 0;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    const ParameterKind kind = describe(parameters[p].parameter).kind;
    const double step = kind == ParameterKind::Amount ? 1e-7 : 1e-5;  // mm, of a compensation a fraction
    const LoadedCycle up = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], step), crest_torque);
    const LoadedCycle down = analyse_cycle(model, mesh_cases::moved(condition, parameters[p], -step), crest_torque);
    const auto column = static_cast<Eigen::Index>(p);
    for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
      const LoadedPosition &here = cycle.positions[i], &more = up.positions[i], &less = down.positions[i];
      const double largest = here.peak_load_derivative.col(column).lpNorm<Eigen::Infinity>();
      for (Eigen::Index k = 0; k < here.peak_load.size(); ++k) {
        if (!(here.peak_load[k] > here.load.line_load[k])) continue;
        const double load = (more.peak_load[k] - less.peak_load[k]) / (2.0 * step);
        const double stress = (more.contact_stress[k] - less.contact_stress[k]) / (2.0 * step);
        const double forward = (more.peak_load[k] - here.peak_load[k]) / step, back = (here.peak_load[k] - less.peak_load[k]) / step;
        if (std::abs(forward - back) > 1e-2 * largest) continue;  // another place takes over within the step
        CAPTURE(std::string(describe(parameters[p].parameter).key), i, k);
        // Round-off of differences of loads solved to 1e-12; of extents the difference along the line as well.
        CHECK(here.peak_load_derivative(k, column) == Approx(load).epsilon(2e-3).margin(2e-3 * largest));
        CHECK(here.contact_stress_derivative(k, column) ==
              Approx(stress).epsilon(2e-3).margin(2e-3 * here.contact_stress_derivative.col(column).lpNorm<Eigen::Infinity>()));
        ++on_crests;
      }
    }
  }
  return on_crests;
}

}  // namespace

TEST_CASE("Loads and stresses on crests have the slopes of differences, by what moves the start too", "[core][load][crest][gradient]") {
  CHECK(check_slopes_on_crests(with_reliefs(), {{Member::Pinion, parameter_of("tip_relief.amount")},
                                                {Member::Pinion, parameter_of("tip_relief.height")},
                                                {Member::Wheel, parameter_of("tip_relief.height")},
                                                {Member::Pinion, parameter_of("lead_crowning")}}) > 20);
}

TEST_CASE("A crest of an end relief goes where the compensation of its twist moves it", "[core][load][crest][gradient]") {
  FlankCondition condition;
  condition.modification.wheel.end_relief = {6 * units::um, 8.0};
  condition.modification.wheel.process = {GrindingKind::GeneratingGrinding, GENERATE(0.0, 0.4)};
  condition.modification.pinion.lead_crowning = 8 * units::um;
  CHECK(check_slopes_on_crests(condition, {{Member::Wheel, parameter_of("twist_compensation")}, {Member::Wheel, parameter_of("end_relief.length")}}) >
        10);
}
