#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "core/compliance/local/hertz_line.hpp"
#include "tests/hard_cases/hard_case.hpp"

using namespace flankwright;
using namespace flankwright::hard_cases;
using units::deg;

namespace {

constexpr double kAngleRoundOff = 1e-12;  // rad

const studies::Override sampled{"cycle.peaks", "sampled"};

/// The field that a study is refused for; empty where it is not.
std::string refused(const std::string& name, const Settings& settings) {
  try {
    study(name, settings);
  } catch (const studies::StudyErrors& errors) {
    return errors.field();
  }
  return {};
}

/// The value between two at which a study turns from refused to accepted, to the last digits: { refused, accepted }.
std::pair<double, double> border(const std::string& name, const std::string& key, double refused_at, double accepted_at) {
  REQUIRE_FALSE(refused(name, {{key, in_digits(refused_at)}}).empty());
  REQUIRE(refused(name, {{key, in_digits(accepted_at)}}).empty());
  while (std::abs(accepted_at - refused_at) > 1e-13 * std::abs(accepted_at)) {
    const double middle = 0.5 * (refused_at + accepted_at);
    (refused(name, {{key, in_digits(middle)}}).empty() ? accepted_at : refused_at) = middle;
  }
  return {refused_at, accepted_at};
}

double largest_te_change(const LoadedCycle& a, const LoadedCycle& b) {
  return (a.transmission_error() - b.transmission_error()).cwiseAbs().maxCoeff();
}

void check_aligned(const studies::StudyResults& results) {
  CHECK(results.unloaded.front().mesh.missing == 0);
  CHECK(results.unloaded.front().mesh.peak_to_peak <= kAngleRoundOff);
  check_balances(results);
}

}  // namespace

TEST_CASE("Hard: a contact ratio of one is where a pair is accepted", "[hard_cases]") {
  const auto [short_tip, long_tip] = border("contact_ratio_of_one", "wheel.tip_diameter", 156.0, 158.0);
  CHECK(refused("contact_ratio_of_one", {{"wheel.tip_diameter", in_digits(short_tip)}}) == "pair.centre_distance");
  for (const std::string& tip : {in_digits(long_tip), std::string("156.5399431")}) {
    const auto results = run("contact_ratio_of_one", {{"wheel.tip_diameter", tip}, sampled});
    CAPTURE(tip);
    CHECK(results.pair.transverse_contact_ratio >= 1.0);
    CHECK(results.pair.transverse_contact_ratio <= 1.0 + 1e-9);
    check_aligned(results);
  }
  // Without the tip edges one tooth has everything, at the very point where the next one enters two.
  const auto alone = run("contact_ratio_of_one", {{"fidelity.effects", R"(["bending", "hertzian_contact"])"}, sampled});
  check_balances(alone);
  for (std::size_t i = 0; i < alone.models.front().positions.size(); ++i) {
    const std::vector<double> all = shares(alone.models.front(), alone.loaded.front().cycle, i);
    CHECK(all.size() == 1);
  }
}

TEST_CASE("Hard: more than three pairs share the load of a high contact ratio", "[hard_cases]") {
  const auto results = run("contact_ratio_above_three", {sampled});
  REQUIRE(results.pair.total_contact_ratio() > 3.0);
  check_aligned(results);
  const MeshModel& model = results.models.front();
  const LoadedCycle& cycle = results.loaded.front().cycle;
  double length = 0.0;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const std::vector<double> all = shares(model, cycle, i);
    CHECK(std::ranges::count_if(all, [](double share) { return share > 0.0; }) >= 3);
    for (const ContactPoint& point : model.positions[i].points) length += point.clearance == 0.0 ? point.weight : 0.0;
  }
  // Contact lines on the path of contact are eps_alpha b / cos(beta_b) long in the mean.
  constexpr double kDiscretisation = 0.05;  // of whole quadrature points at line ends
  const double mean = results.pair.transverse_contact_ratio * results.pair.face_width / std::cos(results.pair.base_helix_angle);
  CHECK(length / static_cast<double>(model.positions.size()) == Approx(mean).epsilon(kDiscretisation));
}

TEST_CASE("Hard: a vanishing helix is a spur gear", "[hard_cases]") {
  // Points at fixed places are the same for both; graded ones are divided after where a line ends, which a spur line does at the faces only.
  const studies::Override fixed{"fidelity.quadrature", "{ rule = \"gauss2\", intervals = 5 }"};
  const auto results_at = [&](const std::string& helix) { return run("helix_to_zero", {{"pair.helix_angle", helix}, sampled, fixed}); };
  const auto spur = results_at("0");
  check_balances(spur);
  for (const char* helix : {"1e-12", "1e-6"}) {
    const auto results = results_at(helix);
    check_balances(results);
    CAPTURE(helix);
    // First order in the angle over the face: 30 mm * 1e-6 deg is 0.5 nm of 9 mm of base pitch.
    const double share = 2.0 * std::stod(helix) * deg * 30.0 / 9.0;
    CHECK(largest_te_change(results.loaded.front().cycle, spur.loaded.front().cycle) <= 10.0 * share * spur.loaded.front().summary.te_mean + 1e-14);
    CHECK(results.loaded.front().summary.peak_contact_stress ==
          Approx(spur.loaded.front().summary.peak_contact_stress).epsilon(10.0 * share + 1e-11));
    for (std::size_t i = 0; i < spur.unloaded.front().mesh.transmission_error.size(); ++i) {
      CHECK(std::abs(results.unloaded.front().mesh.transmission_error[i] - spur.unloaded.front().mesh.transmission_error[i]) <=
            share * 5e-3 / spur.pair.wheel.base_radius + kAngleRoundOff);
    }
  }
  const auto steep = results_at("45");
  check_balances(steep);
  CHECK(refused("helix_to_zero", {{"pair.helix_angle", "45.0001"}}) == "pair.helix_angle");
}

TEST_CASE("Hard: per millimetre a wide face does what a narrow one does", "[hard_cases]") {
  const auto wide = [](double width) {
    return run("any_face_width", {{"pinion.face_width", in_digits(width)},
                                  {"wheel.face_width", in_digits(width)},
                                  {"load.torque", "[0, " + in_digits(10.0 * width) + "]"},
                                  sampled});
  };
  const auto narrow = wide(1.5);
  check_aligned(narrow);
  for (const double width : {15.0, 180.0}) {
    const auto results = wide(width);
    CAPTURE(width);
    check_aligned(results);
    const studies::LoadedResult &a = results.loaded.front(), &b = narrow.loaded.front();
    CHECK(largest_te_change(a.cycle, b.cycle) <= 1e-11 * b.summary.te_mean);
    CHECK(a.summary.peak_line_load == Approx(b.summary.peak_line_load).epsilon(1e-10));
  }
}

TEST_CASE("Hard: eight and five hundred teeth run in line contact", "[hard_cases]") {
  const auto [pinion, wheel] = GENERATE(std::pair{"8", "8"}, std::pair{"8", "500"}, std::pair{"500", "500"});
  Settings settings{{"pinion.teeth", pinion}, {"wheel.teeth", wheel}, sampled};
  if (std::string(wheel) == "8") settings.push_back({"wheel.profile_shift", "0.5"});
  if (std::string(pinion) == "500") settings.push_back({"pinion.profile_shift", "0"});
  CAPTURE(pinion, wheel);
  check_aligned(run("few_and_many_teeth", settings));
}

TEST_CASE("Hard: undercut teeth touch on their involute alone, pointed ones are refused", "[hard_cases]") {
  const auto results = run("undercut_and_pointed", {sampled});
  check_aligned(results);
  CHECK(results.pair.pinion.undercut);
  for (const MeshPosition& at : results.models.front().positions) {
    for (const ContactPoint& point : at.points) CHECK(point.pinion_radius >= results.pair.pinion.form_radius);
  }
  const auto [pointed, blunt] = border("undercut_and_pointed", "pinion.profile_shift", 1.5, 0.3);
  CHECK(refused("undercut_and_pointed", {{"pinion.profile_shift", in_digits(pointed)}}) == "pinion.profile_shift");
  const auto sharpest = run("undercut_and_pointed", {{"pinion.profile_shift", in_digits(blunt)}, sampled});
  CHECK(sharpest.pair.pinion.tip_thickness >= 0.0);
  CHECK(sharpest.pair.pinion.tip_thickness <= 1e-10);  // mm
  check_aligned(sharpest);
}

TEST_CASE("Hard: stress and deflection stay finite at either end of Poisson's ratio", "[hard_cases]") {
  const auto results_at = [](const std::string& nu) { return run("poisson_limits", {{"material.poissons_ratio", nu}, sampled}); };
  for (const char* nu : {"0", "0.3", "0.499", "0.499999999"}) {
    CAPTURE(nu);
    const auto results = results_at(nu);
    check_balances(results);
    const double value = std::stod(nu);
    const LoadedCycle& cycle = results.loaded.front().cycle;
    for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
      const auto& points = results.models.front().positions[i].points;
      for (std::size_t j = 0; j < points.size(); ++j) {
        const auto row = static_cast<Eigen::Index>(j);
        const double stress =
            std::sqrt(cycle.positions[i].load.line_load[row] * 206000.0 / (2.0 * units::pi * (1.0 - value * value) * points[j].relative_radius));
        CHECK(std::abs(cycle.positions[i].contact_stress[row] - stress) <= 1e-12 * stress);
      }
    }
  }
  const auto limit = results_at("0.499999999"), near = results_at("0.4999");
  CHECK(limit.loaded.front().summary.te_mean == Approx(near.loaded.front().summary.te_mean).epsilon(1e-3));
  CHECK(refused("poisson_limits", {{"material.poissons_ratio", "0.5"}}) == "material.poissons_ratio");
}

TEST_CASE("Hard: units and size change nothing but the scale", "[hard_cases]") {
  // Slices are calibrated to ISO 6336-1's c' under 300 N/mm, a load with a scale of its own: similar are flanks that yield locally alone.
  const studies::Override local{"fidelity.effects",
                                R"(["hertzian_contact", "tip_corner", "extended_contact_region", "modifications", "misalignment"])"};
  const bool bends = GENERATE(true, false);
  const auto inches = bends ? run("extreme_units", {sampled}) : run("extreme_units", {sampled, local});
  check_balances(inches);
  // The same shape in millimetres, `scale` times as large.
  const auto scaled = [&](double scale) {
    const double um = 25.4e3 * scale, mm = 25.4 * scale;
    Settings settings{{"pair.normal_module", in_digits(mm / 8)},
                      sampled,
                      {"pinion.face_width", in_digits(1.2 * mm)},
                      {"wheel.face_width", in_digits(1.2 * mm)},
                      {"pinion.modification.lead_crowning", in_digits(0.0003 * um)},
                      {"pinion.modification.profile_crowning", in_digits(0.0002 * um)},
                      {"load.torque", "[0, " + in_digits(1800 * 0.45359237 * 9.80665 * 0.0254 * scale * scale * scale) + "]"}};
    if (!bends) settings.push_back(local);
    return run("extreme_units", settings);
  };
  for (const double scale : bends ? std::vector{1.0} : std::vector{1.0, 0.001, 0.01, 100.0}) {
    CAPTURE(bends, scale);
    const auto results = scaled(scale);
    check_balances(results);
    const studies::LoadedResult &a = results.loaded.front(), &b = inches.loaded.front();
    CHECK((a.cycle.transmission_error() - scale * b.cycle.transmission_error()).cwiseAbs().maxCoeff() <= 1e-10 * scale * b.summary.te_mean);
    CHECK(a.summary.peak_contact_stress == Approx(b.summary.peak_contact_stress).epsilon(1e-10));
    const UnloadedMesh &u = results.unloaded.front().mesh, &v = inches.unloaded.front().mesh;
    for (std::size_t i = 0; i < u.transmission_error.size(); ++i) {
      CHECK(std::abs(u.transmission_error[i] - v.transmission_error[i]) <= kAngleRoundOff);
    }
  }
}
