#include <catch2/catch.hpp>
#include <cmath>
#include <map>
#include <memory>

#include "core/compliance/plate/cantilever_plate.hpp"
#include "core/rating/load_factors.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/core/load/mesh_cases.hpp"
#include "tests/common/about.hpp"

/// What chapters 3 and 4 of C. D. Haddad's thesis (1991) say about loads and load distribution factors in words, where teeth as slices
/// or plates already show it; haddad_trends.md has the figures, with finite elements beside them.
using namespace flankwright;

namespace {

/// A pair of the thesis under 100 N per mm of face width, as sections 3.4 and 4.1 load it.
struct Mesh {
  GearPair pair;
  std::shared_ptr<const PairCompliance> structure{};  ///< null: thin slices
  MeshEffects effects{};
  Quadrature quadrature{QuadratureRule::Graded, 4};

  double torque() const { return 100 * pair.face_width * pair.pinion.base_radius * std::cos(pair.base_helix_angle); }
  ContactPeaks peaks(const FlankCondition& condition) const {
    const MeshAt mesh_at = [this](const std::vector<double>& phases) {
      return make_mesh_model(pair, {mesh_cases::steel, mesh_cases::steel}, {quadrature, phases}, effects, {}, {.structure = structure.get()});
    };
    return locate_peaks(mesh_at, condition, torque());
  }
  LoadFactors factors(const FlankCondition& c) const {
    return load_factors(peaks(perfect_part(c)), peaks(lead_part(c)), peaks(profile_part(c)), peaks(c));
  }
};

GearPair helical_18_54() { return mesh_cases::pair(18, 54, 30, 10, 120); }

/// Both gears' teeth as cantilever plates: slices that hold on to each other.
std::shared_ptr<const PairCompliance> plates(const GearPair& pair, double poissons_ratio = mesh_cases::steel.poissons_ratio) {
  const auto plate = [&](Member m) {
    return GearStructure{std::make_shared<CantileverPlate>(tooth_form(pair, m), pair.data.normal_module, pair.face_width, poissons_ratio),
                         mesh_cases::steel.youngs_modulus};
  };
  return std::make_shared<StructuralPair>(pair, plate(Member::Pinion), plate(Member::Wheel));
}

FlankCondition lead_error(double helix_slope, double crowning = 0.0) {
  FlankCondition condition;
  condition.error.pinion.helix_slope = helix_slope * units::um;
  condition.modification.pinion.lead_crowning = crowning * units::um;
  return condition;
}

/// Where a table has its smallest value.
double lowest_at(const std::map<double, double>& values) {
  return std::min_element(values.begin(), values.end(), [](const auto& a, const auto& b) { return a.second < b.second; })->first;
}

}  // namespace

TEST_CASE("Coupled helical teeth have load spikes at the start and the end of contact", "[reference][haddad][load-factors][slow]") {
  const GearPair pair = helical_18_54();
  const PathOfContact path(pair);
  const double start = PathOfContact::extension, end = path.last_line_phase() - PathOfContact::extension;
  const ContactPeaks plate = Mesh{pair, plates(pair)}.peaks({}), slices = Mesh{pair}.peaks({});
  // Section 3.5.1: loads are comparable at both ends, largest often at the end of contact; stress at its start, where flanks are most
  // curved. A line there is a face corner.
  const LinePeak &stress = plate.with_spikes.contact_stress, &load = plate.with_spikes.line_load;
  CAPTURE(stress.value, plate.without_spikes.contact_stress.value, slices.with_spikes.contact_stress.value);
  // The corner itself is softer than what lies next to it, as one gear's edge is sharp there: 2 to 3 mm of line, 0.05 base pitches.
  CHECK(stress.phase + stress.tooth == tests::about(start, 0.07));
  CHECK(std::abs(stress.z) > 57);
  CHECK(std::min(std::abs(load.phase + load.tooth - end), std::abs(load.phase + load.tooth - start)) < 0.07);
  CHECK(stress.value > 1.25 * plate.without_spikes.contact_stress.value);
  // Slices that nobody props up have none.
  CHECK(slices.with_spikes.contact_stress.value < 1.05 * slices.without_spikes.contact_stress.value);
}

TEST_CASE("The load along a spur tooth turns two modules from its ends, by Poisson's effect", "[reference][haddad]") {
  // Section 3.4 has a crest there, 6 to 11 % above mid face, and 4 to 12 % less than mid face at the ends. The turn is there; but a
  // cantilever plate under a uniform load bends back at its free ends (anticlastic), so that these carry more and the turn is a trough.
  // Finite elements say the same; see haddad_trends.md.
  const GearPair pair = mesh_cases::pair(18, 72, 0, 10, 120);
  const double phase = (pair.pitch_point - pair.path_start) / pair.transverse_base_pitch + PathOfContact::extension;
  const auto along_face = [&](double poissons_ratio, const MeshEffects& effects) {  // of the pair that carries all, by distance from the end [m_n]
    const auto structure = plates(pair, poissons_ratio);
    const MeshModel model = make_mesh_model(pair, {mesh_cases::steel, mesh_cases::steel}, {{QuadratureRule::Graded, 16}, {phase}}, effects, {},
                                            {.structure = structure.get()});
    const LoadedCycle cycle = analyse_cycle(model, {}, Mesh{pair}.torque());
    std::map<double, double> loads;
    for (std::size_t i = 0; i < model.positions[0].points.size(); ++i) {
      const double load = cycle.positions[0].load.line_load[static_cast<Eigen::Index>(i)];
      if (load > 0) loads[6 - std::abs(model.positions[0].points[i].z) / 10] = load;
    }
    return loads;
  };
  const MeshEffects bent_only = MeshEffects::all_but({"free_ends"});
  const std::map<double, double> steel = along_face(0.3, bent_only), without = along_face(0, bent_only);
  const double middle = steel.rbegin()->second, end = steel.begin()->second;
  CHECK(lowest_at(steel) == tests::about(2.2, 0.4));
  CHECK(end / middle == tests::about(1.07, 0.02));
  CHECK(without.begin()->second / without.rbegin()->second == tests::about(1, 0.02));
  // What the thesis says of the ends themselves: contact is softer there, and outweighs the plate.
  const std::map<double, double> with_ends = along_face(0.3, {});
  CHECK(lowest_at(with_ends) == with_ends.begin()->first);
  CHECK(with_ends.begin()->second / with_ends.rbegin()->second == tests::about(0.92, 0.04));  // model: 0.88 to 0.96
}

TEST_CASE("Full contact under a misalignment is best crowned by sqrt(3)/4 of it", "[reference][haddad][load-factors]") {
  // Two-dimensional theory: w = mean + c (f u/2 - C (u^2 - 1/3)), u = 2z/b; its largest value over |u| <= 1 is least where C = sqrt(3)/4 f
  // (Myers, quoted in section 4.2.4: 0.426 f). One pair of teeth, bending slices: stress^2 is proportional to w.
  const GearPair pair = mesh_cases::pair(18, 72, 0, 10, 120);
  const double phase = (pair.pitch_point - pair.path_start) / pair.transverse_base_pitch + PathOfContact::extension;
  const MeshModel model =
      mesh_cases::model(pair, {{QuadratureRule::Midpoint, 240}, {phase}}, MeshEffects::all_but({"hertzian_contact", "extended_contact_region"}));
  const auto peak = [&](double misalignment, double crowning) {
    const LoadedCycle cycle = analyse_cycle(model, lead_error(misalignment, crowning), Mesh{pair}.torque());
    const double stress = peaks_at(model, model.positions[0], cycle.positions[0]).without_spikes.contact_stress.value;
    return stress * stress;
  };
  const double misalignment = 4;  // um: no slice loses contact
  std::map<double, double> by_crowning;
  for (double share = 0.2; share < 0.7; share += 0.01) by_crowning[share] = peak(misalignment, share * misalignment);
  CHECK(lowest_at(by_crowning) == tests::about(std::sqrt(3) / 4, 0.011));  // discretisation: the step
}

TEST_CASE("Crowning a misaligned helical pair first lowers K_Hbeta, then raises it", "[reference][haddad][load-factors]") {
  const Mesh mesh{helical_18_54()};
  const ContactPeaks perfect = mesh.peaks({});
  const auto factor = [&](double misalignment, double crowning) {
    const ContactPeaks peaks = mesh.peaks(lead_error(misalignment, crowning));
    return load_factors(perfect, peaks, perfect, peaks).without_spikes.lead;
  };
  // Section 4.2.4: 8 um; optimum near half of it. Metal added at the end of contact, where it costs slices most.
  std::map<double, double> by_crowning;
  for (const double crowning : {0.0, 2.0, 4.0, 6.0, 10.0, 16.0}) by_crowning[crowning] = factor(-8, crowning);
  CAPTURE(by_crowning[0], by_crowning[2], by_crowning[4], by_crowning[6], by_crowning[10], by_crowning[16]);
  CHECK(lowest_at(by_crowning) == 4);
  CHECK(by_crowning[0] > 1.1 * by_crowning[4]);
  CHECK(by_crowning[16] > 1.1 * by_crowning[4]);
  // Section 4.2.3: without misalignment it only harms.
  double last = 1;
  for (const double crowning : {4.0, 8.0, 16.0}) {
    const double now = factor(0, crowning);
    CHECK(now > last);
    last = now;
  }
  // Section 4.2.2: more misalignment, more stress.
  CHECK(factor(-16, 0) > by_crowning[0]);
  CHECK(factor(-4, 0) < by_crowning[0]);
}

TEST_CASE("Lead and profile errors together cost less than the product of their factors", "[reference][haddad][load-factors]") {
  // Section 4.4: in every case, F_beta_y = 8 um with f_Halpha up to 15 um; metal added where stress peaks, at the pinion's roots.
  const Mesh mesh{helical_18_54()};
  FlankCondition both = lead_error(8);
  both.error.pinion.profile_slope = GENERATE(-4, -15) * units::um;
  const LoadFactors factors = mesh.factors(both);
  for (const LoadFactors::Triple& k : {factors.without_spikes, factors.with_spikes}) {
    CAPTURE(k.lead, k.profile, k.combined);
    CHECK(k.lead > 1.1);
    CHECK(k.profile > 1.1);
    CHECK(k.combined < 0.97 * k.product());
    CHECK(k.combined > std::max(k.lead, k.profile));
  }
}

TEST_CASE("ISO's mesh stiffness depends neither on the face width nor on the wheel's body", "[reference][haddad][iso]") {
  // Section 3.3, figs 3.12, 3.15 and 3.17: by the standard the larger wheel is the stiffer one, and width has no influence.
  const auto c_gamma = [](int wheel_teeth, double face_width) {
    return iso_stiffness(mesh_cases::pair(18, wheel_teeth, 30, 10, face_width), {}, {}).c_gamma;
  };
  CHECK(c_gamma(18, 120) < c_gamma(54, 120));
  CHECK(c_gamma(54, 120) < c_gamma(100, 120));
  CHECK(c_gamma(54, 20) == c_gamma(54, 120));
}

TEST_CASE("Finite elements yield more the larger the wheel is and the wider a spur pair", "[.soak][reference][haddad][fe]") {
  // Section 3.3; the same specific load throughout. A helical pair's narrow disc tilts under the axial load: haddad_trends.md.
  const auto stiffness = [](double helix_angle, int wheel_teeth, double face_width) {
    const auto text = [](const auto& value) { return std::to_string(value); };
    const std::string study = "[pair]\nnormal_module = 10\nhelix_angle = " + text(helix_angle) +
                              "\n[pinion]\nteeth = 18\nface_width = " + text(face_width) + "\n[wheel]\nteeth = " + text(wheel_teeth) +
                              "\nface_width = " + text(face_width) + "\n[load]\ntorque = " + text(8.457 * face_width) +
                              "\n[cycle]\npositions = 16\npeaks = \"sampled\"\n[fidelity]\ncompliance = \"fitted\"\n";
    return studies::run_study(studies::parse_study(study, "trend.toml")).loaded.front().summary.mean_stiffness;
  };
  const double small = stiffness(30, 18, 120), middle = stiffness(30, 54, 120), large = stiffness(30, 100, 120);
  CAPTURE(small, middle, large);
  CHECK(middle < 0.9 * small);
  CHECK(large < 0.6 * middle);
  const double narrow = stiffness(0, 54, 20), wide = stiffness(0, 54, 120);
  CAPTURE(narrow, wide);
  CHECK(wide < 0.9 * narrow);
}
