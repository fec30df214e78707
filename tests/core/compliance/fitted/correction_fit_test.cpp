#include "core/compliance/fitted/correction_fit.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <cmath>
#include <limits>
#include <memory>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/compliance/fitted/corrected_compliance.hpp"
#include "core/compliance/tooth/flank_stations.hpp"
#include "tests/common/random.hpp"
#include "tests/core/compliance/fitted/random_gear.hpp"
#include "tests/core/compliance/fitted/synthetic_gear.hpp"

using namespace flankwright;
using namespace flankwright::testing;
using units::deg;

namespace {

/// Influence values between stations of one tooth by the default mesh, E = 1, nu = 0.3.
InfluenceSample element_sample(const GearProportions& gear, const std::vector<FlankStation>& stations, const ReferenceProfile& profile) {
  const InfluenceModel model(standard_gear(gear, profile), {1.0, 0.3}, {});
  const ToothForm& form = model.mesh().form;
  std::vector<FlankPoint> points;
  for (const FlankStation& station : stations) {
    points.push_back({station.tooth, flank_radius(form, station.u), station.zeta - gear.relative_face / 2});
  }
  return {gear, stations, model.influence(points).compliance};
}

std::shared_ptr<const CorrectedCompliance> refined(const GearProportions& gear, const ReferenceProfile& profile = {}) {
  InfluenceTableTask task{.gear = standard_gear(gear, profile), .mesh = coarse_mesh(), .grid = station_grid(gear.relative_face)};
  const InfluenceTableRun run = solve_influence_table(task, std::numeric_limits<double>::infinity());
  REQUIRE(run.table);
  CHECK(run.table->projection().added < 1e-4);  // discretisation: unlike meshes of neighbouring teeth
  return std::make_shared<const CorrectedCompliance>(std::make_shared<const InfluenceTable>(*run.table), gear,
                                                     CorrectionLibrary::shipped().coefficients(gear, profile));
}

/// The places of tooth 0, the only one that the fine mesh has finely: what it says of a neighbour's own values is no truth.
InfluenceSample on_fine_tooth(const InfluenceSample& sample) {
  InfluenceSample own{sample.gear, {}, {}};
  std::vector<std::size_t> chosen;
  for (std::size_t i = 0; i < sample.points.size(); ++i) {
    if (sample.points[i].tooth != 0) continue;
    chosen.push_back(i);
    own.points.push_back(sample.points[i]);
  }
  own.compliance = sample.compliance(chosen, chosen);
  return own;
}

/// Places that neither the grid of the table nor the library has.
std::vector<FlankStation> test_stations(double face) {
  std::vector<FlankStation> stations;
  for (int tooth = 0; tooth <= 2; ++tooth) {
    for (const double u : tooth == 0 ? std::vector{-0.9, -0.55, -0.15, 0.2, 0.55, 0.95} : std::vector{-0.8, 0.1, 0.9}) {
      for (const double from_end : {0.07, 0.2, 0.5, 0.95, 1.7}) {
        stations.push_back({tooth, u, from_end});
        stations.push_back({tooth, u, face - from_end - 0.04});
      }
      for (const double share : {0.41, 0.5, 0.63}) stations.push_back({tooth, u, share * face});
    }
  }
  return stations;
}

}  // namespace

TEST_CASE("A fit adds to given values exactly what they lack", "[core][compliance][fitted]") {
  const GearProportions gear = helical_gear();
  const SyntheticGear truth(gear);
  const KernelForm form = KernelForm::correction();
  tests::Random32 random(5);
  std::vector<double> missing = random_coefficients(form, random, 0.1);
  CorrectionSamples samples{truth.sample(truth.grid(4, 9)), truth.sample(truth.grid(3, 7))};
  for (InfluenceSample* sample : {&samples.fitted, &samples.unseen}) {
    sample->given = sample->compliance;
    sample->compliance += 0.1 * FittedCompliance(form, gear, missing, {}).evaluate(sample->points);
  }
  const CorrectionEntry entry = fit_correction(samples, {});
  REQUIRE(!entry.coefficients.empty());
  CHECK(entry.gear == gear);
  // Discretisation: how far the solver has come against the ridge; without a fit 95 % are up to some percent off.
  CHECK(entry.fitted.share_95 < 1e-3);
  CHECK(entry.unseen.share_95 < 2e-3);
  CHECK(entry.unseen.worst < 1e-2);
}

TEST_CASE("A refinement's samples lie on the whole flank of any face, and are what two compliances make of it", "[core][compliance][fitted]") {
  constexpr double round_off = 1e-14;
  for (const double face : {2.0, 8.0, 12.0, 30.0}) {
    CAPTURE(face);
    const GearProportions gear{20, 0, face, 0};
    const KernelForm form = KernelForm::one_tooth();
    tests::Random32 random(5);
    const FittedCompliance fine(form, gear, random_coefficients(form, random, 0.1), {}),
        coarse(form, gear, random_coefficients(form, random, 0.1), {});
    const CorrectionSamples samples = correction_samples(gear, fine, coarse);
    const auto& stations = samples.fitted.points;
    const std::size_t axial = stations.size() / 6;
    CHECK(std::abs(static_cast<double>(axial) - (9 + 0.9 * face)) < 3);  // as the header says
    CHECK(stations.front().zeta == 0);
    CHECK(stations.back().zeta == face);
    for (std::size_t i = 0; i < axial; ++i) CHECK(stations[i].zeta + stations[axial - 1 - i].zeta == Approx(face).epsilon(round_off));
    for (const FlankStation& unseen : samples.unseen.points) CHECK(std::ranges::find(stations, unseen) == stations.end());
    CHECK(samples.fitted.compliance == fine.evaluate(stations));
    CHECK(samples.fitted.given == coarse.evaluate(stations));
    CHECK_NOTHROW(samples.unseen.validate());
  }
}

TEST_CASE("Layers of the coarse mesh are about as long as the largest distance of stations of a table", "[core][compliance][fitted]") {
  for (const double face : {3.0, 8.0, 12.0, 25.0}) {
    const std::vector<double> planes = gear_mesh(standard_gear({20, 20 * deg, face, 0}), coarse_mesh()).planes;
    double longest = 0;
    for (std::size_t i = 1; i < planes.size(); ++i) longest = std::max(longest, planes[i] - planes[i - 1]);
    CAPTURE(face, longest);
    CHECK(longest < 1.2 * AxialSteps{}.largest);  // a whole number of them is stretched over half the face
  }
}

TEST_CASE("Body and fillets of the coarse mesh are the fine one's", "[core][compliance][fitted]") {
  // What both are to give alike, gear body and root stress, is meshed alike.
  const GearMeshOptions coarse = coarse_mesh(), fine;
  CHECK(coarse.body_growth == fine.body_growth);
  CHECK(coarse.shaft_elements == fine.shaft_elements);
  CHECK(coarse.fillet_elements == fine.fillet_elements);
  CHECK(coarse.half_thickness_elements == fine.half_thickness_elements);
}

TEST_CASE("The coarse mesh takes gears of the whole range, pointed ones apart", "[core][compliance][fitted]") {
  tests::Random32 random(4);
  int meshed = 0;
  for (int i = 0; i < 12; ++i) {
    GearToMesh gear = standard_gear({static_cast<int>(1 / random(1 / 170.0, 1 / 10.0)), random(0, 40) * deg, random(2, 4), random(-0.5, 0.8)});
    gear.pressure_angle = random(15, 25) * deg;
    if (i % 2 == 1) gear.gear.rack = {1.1, 1.4, 0.2};
    CAPTURE(gear.gear.teeth, gear.helix_angle / deg, gear.gear.profile_shift, gear.pressure_angle / deg);
    try {
      gear_mesh(gear, coarse_mesh());
      ++meshed;
    } catch (const InvalidInput& problem) {
      CHECK(problem.field() == "tip_diameter");
    }
  }
  CHECK(meshed >= 10);
}

TEST_CASE("Fitted gears that the library has not seen come close to finite elements", "[.soak][core][compliance][fitted]") {
  using Gear = std::pair<GearProportions, ReferenceProfile>;
  const auto [gear, profile] = GENERATE(values<Gear>({
      {{24, 25 * deg, 12, 0.2}, {}},
      {{43, 10 * deg, 12, -0.2}, {}},
      {{90, 30 * deg, 12, 0}, {}},
      {{15, 20 * deg, 12, 0.4}, {}},
      {{30, 20 * deg, 6, 0}, {}},
      {{30, 20 * deg, 25, 0}, {}},
      {{18, 30 * deg, 12, 0}, {}},
      {{20, 15 * deg, 3, 0}, {}},
      {{12, 5 * deg, 10, -0.3}, {}},
      {{23, 28 * deg, 12, 0.25}, {.rack = {1.25, 1.6, 0.25}}},
      {{67, 28 * deg, 12, 0.05}, {.rack = {1.25, 1.6, 0.25}}},
      {{18, 12 * deg, 10, 0.3}, {.rack = {1.1, 1.4, 0.2}}},
      {{40, 20 * deg, 10, -0.2}, {.rack = {1.4, 1.6, 0.2}, .pressure_angle = 17.5 * deg}},
      {{30, 15 * deg, 10, 0.2}, {.rack = {1, 1.25, 0.3}, .pressure_angle = 22.5 * deg}},
      {{14, 5 * deg, 8, 0.4}, {.rack = {1, 1.25, 0.25}, .pressure_angle = 19 * deg}},
  }));
  const auto stations = test_stations(gear.relative_face);
  const InfluenceSample fine = element_sample(gear, stations, profile);
  const auto model = refined(gear, profile);
  const InfluenceSample own = on_fine_tooth(fine);
  auto errors = residual_statistics(*model, {&fine, 1}, kScaleFloor);
  auto coarse = residual_statistics(model->coarse(), {&fine, 1}, kScaleFloor);
  errors[0] = residual_statistics(*model, {&own, 1}, kScaleFloor).front();
  coarse[0] = residual_statistics(model->coarse(), {&own, 1}, kScaleFloor).front();
  for (std::size_t m = 0; m < errors.size(); ++m) {
    WARN("Z " << gear.teeth << " beta " << gear.helix_angle / deg << " x " << gear.profile_shift << " b " << gear.relative_face << " rack "
              << profile.rack.addendum << " / " << profile.rack.dedendum << " / " << profile.rack.root_radius << " at "
              << profile.pressure_angle / deg << " deg"
              << ", " << m << " apart: " << 100 * errors[m].median << " / " << 100 * errors[m].share_95 << " / " << 100 * errors[m].worst
              << " %, coarse alone " << 100 * coarse[m].median << " / " << 100 * coarse[m].share_95 << " / " << 100 * coarse[m].worst);
  }
  REQUIRE(errors.size() == 3);
  // Model, as asked of gears between the library's.
  CHECK(errors[0].median < 0.01);
  CHECK(errors[0].share_95 < 0.04);
  for (const std::size_t apart : {1, 2}) {
    CHECK(errors[apart].median < 0.015);
    CHECK(errors[apart].share_95 < 0.07);
  }
}

TEST_CASE("A fit made on a narrower face serves a wide one", "[.soak][core][compliance][fitted]") {
  const double face = GENERATE(18.0, 30.0);
  GearToMesh gear = standard_gear({24, 20 * deg, face, 0.1});
  gear.pressure_angle = 22 * deg;
  gear.gear.rack.root_radius = 0.25;
  const auto table = [](GearToMesh on, double width, const GearMeshOptions& mesh) {
    on.gear.face_width = width;
    const InfluenceTableTask task{.gear = on, .mesh = mesh, .grid = station_grid(width)};
    return std::make_shared<const InfluenceTable>(*solve_influence_table(task, std::numeric_limits<double>::infinity()).table);
  };
  GearProportions facts = facts_of(gear);
  const auto coarse = table(gear, face, coarse_mesh()), fine = table(gear, face, {});
  facts.relative_face = widest_own_fit;
  const CorrectionLibrary& library = CorrectionLibrary::shipped();
  const CorrectionEntry narrow =
      fit_correction(correction_samples(facts, *table(gear, widest_own_fit, {}), *table(gear, widest_own_fit, coarse_mesh())),
                     library.coefficients(facts, profile_of(gear)));
  REQUIRE(narrow.status == FitStatus::Converged);
  facts.relative_face = face;
  const CorrectedCompliance compliance(coarse, facts, narrow.coefficients);
  InfluenceSample sample{facts, test_stations(face), {}};
  sample.compliance = fine->evaluate(sample.points);
  sample = on_fine_tooth(sample);
  const ResidualStatistics found = residual_statistics(compliance, {&sample, 1}, kScaleFloor).front();
  const ResidualStatistics without = residual_statistics(*coarse, {&sample, 1}, kScaleFloor).front();
  WARN("face " << face << ": " << 100 * found.median << " / " << 100 * found.share_95 << " / " << 100 * found.worst << " %, coarse mesh alone "
               << 100 * without.median << " / " << 100 * without.share_95 << " / " << 100 * without.worst);
  // Model: as asked of gears between the library's.
  CHECK(found.median < 0.01);
  CHECK(found.share_95 < 0.04);
}

TEST_CASE("Time of evaluating a fitted gear", "[.soak][core][compliance][fitted]") {
  const GearProportions gear{24, 20 * deg, 12, 0};
  const auto model = refined(gear);
  tests::Random32 random(2);
  const auto stations = random_stations(100, gear.relative_face, 0, 2, random);
  constexpr int kRepeats = 200;
  const auto start = std::chrono::steady_clock::now();
  double sum = 0;
  for (int i = 0; i < kRepeats; ++i) sum += model->evaluate(stations)(0, 0);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  WARN("100 places: " << 1e3 * seconds / kRepeats << " ms");
  CHECK(sum > 0);
}
