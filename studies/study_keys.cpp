#include <string_view>

#include "optimize/solver.hpp"
#include "studies/study_schema.hpp"

/// The table of keys. One row says everything about a key; a row "gear.x" stands for "pinion.x" and "wheel.x".
namespace flankwright::studies {

namespace {

GearData& gear(Draft& draft, Member m) {
  return m == Member::Pinion ? draft.study.pair.pinion : draft.study.pair.wheel;
}
Modification& modification(Draft& draft, Member m) {
  return m == Member::Pinion ? draft.study.pinion_modification : draft.study.wheel_modification;
}
Material& material(Draft& draft, Member m) {
  return m == Member::Pinion ? draft.study.pinion_material : draft.study.wheel_material;
}
ManufacturingError& error(Scene& scene, Member m) {
  return m == Member::Pinion ? scene.pinion_error : scene.wheel_error;
}

constexpr Range above_zero(double high) {
  return {.low = 0.0, .high = high, .low_open = true};
}
constexpr Range from_zero(double high) {
  return {.low = 0.0, .high = high};
}
constexpr Range within(double magnitude) {
  return {.low = -magnitude, .high = magnitude};
}

constexpr Range removal = within(1000.0);                      // um: beyond a millimetre it is no micro-geometry
constexpr Range misalignment_angle = within(60.0);             // arcmin: a degree, far beyond any housing
constexpr Range any_length = {.low = 0.001, .high = 10000.0};  // mm: from watches to girth gears
constexpr Range relief_extent = from_zero(10000.0);            // mm; 0 is "not given"

using enum ValueKind;
using MP = ModificationParameter;

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> geometry_rows() {
  return {
      {.path = "title", .kind = Text, .fallback = "(the file's name)", .meaning = "heads the report",
       .store = [](Draft& d, Member, const Value& v) { d.study.title = v.text; }},
      {.path = "task", .kind = Word, .words = {"analyse", "optimise"}, .later = {"sweep", "accuracy", "fit"},
       .fallback = "\"analyse\"", .meaning = "what `run` does",
       .store = [](Draft& d, Member, const Value& v) { d.study.task = static_cast<Task>(v.integer); }},
      {.path = "pair.normal_module", .quantity = Quantity::Length, .range = {.low = 0.001, .high = 1000.0},
       .fallback = "(required, or normal_diametral_pitch)", .meaning = "m_n",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.normal_module = v.number; }},
      {.path = "pair.normal_diametral_pitch", .quantity = Quantity::DiametralPitch,
       .range = {.low = 0.0254, .high = 25400.0}, .fallback = "(from normal_module)",
       .meaning = "instead of the module",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.normal_module = 1.0 / v.number; }},
      {.path = "pair.pressure_angle", .quantity = Quantity::Angle, .range = {.low = 10.0, .high = 35.0},
       .fallback = "20", .meaning = "alpha_n, normal section",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.pressure_angle = v.number; }},
      {.path = "pair.helix_angle", .quantity = Quantity::Angle, .range = from_zero(45.0), .fallback = "0",
       .meaning = "beta at the reference cylinder; 0 is a spur gear",
       .hint = "the hand says the direction: pinion.hand",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.helix_angle = v.number; }},
      {.path = "pair.centre_distance", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(without backlash)", .meaning = "a_w; by default from the profile shifts",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.centre_distance = v.number; }},
      {.path = "pair.driver", .kind = Word, .words = {"pinion", "wheel"}, .fallback = "\"pinion\"",
       .meaning = "which gear drives",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.driver = static_cast<Member>(v.integer); }},
      {.path = "pair.working_flank", .kind = Word, .words = {"right", "left"}, .fallback = "\"right\"",
       .meaning = "flank of the pinion that carries; left is the coast side",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.pair.working_flank = static_cast<WorkingFlank>(v.integer);
       }},

      {.path = "gear.teeth", .kind = Integer, .range = {.low = 5, .high = 1000}, .fallback = "(required)",
       .meaning = "z",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).teeth = static_cast<int>(v.integer); }},
      {.path = "gear.face_width", .quantity = Quantity::Length, .range = any_length, .fallback = "(required)",
       .meaning = "b; both gears are centred on z = 0",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).face_width = v.number; }},
      {.path = "pinion.hand", .kind = Word, .words = {"right", "left"}, .fallback = "\"right\"",
       .meaning = "hand of helix: right turns counter-clockwise with growing z",
       .store = [](Draft& d, Member, const Value& v) { d.study.pair.pinion_hand = static_cast<Hand>(v.integer); }},
      {.path = "wheel.hand", .kind = Word, .words = {"right", "left"}, .fallback = "(the opposite of the pinion's)",
       .meaning = "may be said, must be the opposite",
       .store = [](Draft& d, Member, const Value& v) { d.wheel_hand = static_cast<Hand>(v.integer); }},
      {.path = "gear.profile_shift", .range = within(2.0), .fallback = "0",
       .meaning = "x, in normal modules; + outwards",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).profile_shift = v.number; }},
      {.path = "gear.tip_diameter", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(from rack and profile shift)", .meaning = "d_a",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).tip_diameter = v.number; }},
      {.path = "gear.rack.addendum", .range = above_zero(2.0), .fallback = "1", .meaning = "h_aP, in normal modules",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).rack.addendum = v.number; }},
      {.path = "gear.rack.dedendum", .range = above_zero(2.5), .fallback = "1.25", .meaning = "h_fP, in normal modules",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).rack.dedendum = v.number; }},
      {.path = "gear.rack.root_radius", .range = from_zero(2.0), .fallback = "0.39",
       .meaning = "rho_fP, in normal modules; at most the full rounding of the tool's tip",
       .store = [](Draft& d, Member m, const Value& v) { gear(d, m).rack.root_radius = v.number; }},
      {.path = "gear.generation", .kind = Later, .fallback = "\"rack\"", .meaning = "how the flank is generated"},
  };
}

std::vector<SchemaKey> flank_rows() {
  return {
      {.path = "gear.modification.lead_crowning", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "C_beta, removed at both face ends, parabola over z", .store = MP::LeadCrowning},
      {.path = "gear.modification.lead_slope", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "C_Hbeta over the face width; + removes at z = +b/2, zero at mid face", .store = MP::LeadSlope},
      {.path = "gear.modification.profile_crowning", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "C_alpha: addendum and dedendum crowning at once", .store = MP::ProfileCrowning},
      {.path = "gear.modification.addendum_crowning", .quantity = Quantity::Deviation, .range = removal,
       .fallback = "0", .meaning = "removed at the tip, parabola from the pitch point up",
       .store = MP::AddendumCrowning},
      {.path = "gear.modification.dedendum_crowning", .quantity = Quantity::Deviation, .range = removal,
       .fallback = "0", .meaning = "removed at the start of active profile, parabola from the pitch point down",
       .store = MP::DedendumCrowning},
      {.path = "gear.modification.profile_slope", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "C_Halpha over the active profile height; + removes at the tip, zero at the pitch point",
       .store = MP::ProfileSlope},
      {.path = "gear.modification.tip_relief.amount", .quantity = Quantity::Deviation, .range = removal,
       .fallback = "0", .meaning = "C_alpha_a, removed at the tip", .store = MP::TipReliefAmount},
      {.path = "gear.modification.tip_relief.height", .quantity = Quantity::Length, .range = relief_extent,
       .fallback = "0", .meaning = "radial, from the tip down; above 0 where there is an amount",
       .store = MP::TipReliefHeight},
      {.path = "gear.modification.tip_relief.shape", .kind = Word, .words = {"linear", "parabolic"},
       .fallback = "\"linear\"", .meaning = "between its start and the tip",
       .store = [](Draft& d, Member m, const Value& v) {
         modification(d, m).tip_relief.shape = static_cast<ReliefShape>(v.integer);
       }},
      {.path = "gear.modification.root_relief.amount", .quantity = Quantity::Deviation, .range = removal,
       .fallback = "0", .meaning = "C_alpha_f, removed at the start of active profile", .store = MP::RootReliefAmount},
      {.path = "gear.modification.root_relief.height", .quantity = Quantity::Length, .range = relief_extent,
       .fallback = "0", .meaning = "radial, from the start of active profile up; above 0 where there is an amount",
       .store = MP::RootReliefHeight},
      {.path = "gear.modification.root_relief.shape", .kind = Word, .words = {"linear", "parabolic"},
       .fallback = "\"linear\"", .meaning = "between its start and the start of active profile",
       .store = [](Draft& d, Member m, const Value& v) {
         modification(d, m).root_relief.shape = static_cast<ReliefShape>(v.integer);
       }},
      {.path = "gear.modification.end_relief.amount", .quantity = Quantity::Deviation, .range = removal,
       .fallback = "0", .meaning = "removed at both face ends, linear", .store = MP::EndReliefAmount},
      {.path = "gear.modification.end_relief.length", .quantity = Quantity::Length, .range = relief_extent,
       .fallback = "0", .meaning = "axial, from each face end; above 0 where there is an amount",
       .store = MP::EndReliefLength},
      {.path = "gear.modification.twist", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "removed twist * (y / h_active) * (z / b); + removes at the tip at z = +b/2", .store = MP::Twist},
      {.path = "gear.modification.parabolic_te", .kind = Later, .fallback = "0",
       .meaning = "predesigned parabolic transmission error, arcsec/deg^2"},
      {.path = "gear.modification.grid", .kind = Later, .fallback = "(none)", .meaning = "measured flank, a CSV file"},

      {.path = "gear.error.helix_slope", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "f_Hbeta over the face width, metal added; + adds at z = +b/2, zero at mid face",
       .store = [](Scene& s, Member m, const Value& v) { error(s, m).helix_slope = v.number; }},
      {.path = "gear.error.profile_slope", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "f_Halpha, metal added; + adds at the tip, zero at the reference circle",
       .store = [](Scene& s, Member m, const Value& v) { error(s, m).profile_slope = v.number; }},
      {.path = "gear.error.pitch", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal,
       .fallback = "0",
       .meaning = "adjacent pitch error, adds up from tooth to tooth; a list: cumulative deviation of each tooth",
       .store = [](Scene& s, Member m, const Value& v) {
         error(s, m).pitch_step = v.is_list ? 0.0 : v.numbers.front();
         error(s, m).cumulative_pitch = v.is_list ? v.numbers : std::vector<double>{};
       }},
      {.path = "gear.error.twist", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "added twist * (y / h_active) * (z / b); + adds at the tip at z = +b/2",
       .store = [](Scene& s, Member m, const Value& v) { error(s, m).twist = v.number; }},
  };
}

std::vector<SchemaKey> working_condition_rows() {
  return {
      {.path = "misalignment.crossing", .quantity = Quantity::SmallAngle, .range = misalignment_angle, .fallback = "0",
       .meaning = "f_Sigma_beta, about the line of centres, out of plane; + closes the mesh at +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.crossing = v.number; }},
      {.path = "misalignment.intersecting", .quantity = Quantity::SmallAngle, .range = misalignment_angle,
       .fallback = "0", .meaning = "f_Sigma_delta, in the plane of the axes; + opens the mesh at +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.intersecting = v.number; }},
      {.path = "misalignment.centre_distance", .quantity = Quantity::Length, .range = within(100.0), .fallback = "0",
       .meaning = "delta E, added to the pair's; + apart",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.centre_distance = v.number; }},
      {.path = "misalignment.axial_offset", .quantity = Quantity::Length, .range = within(1000.0), .fallback = "0",
       .meaning = "wheel towards +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.axial_offset = v.number; }},
      {.path = "misalignment.pinion_lead_angle", .quantity = Quantity::SmallAngle, .range = misalignment_angle,
       .fallback = "0", .meaning = "delta lambda_p1 of the pinion, Litvin's appendix 2 in full",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.pinion_lead_angle = v.number; }},
      {.path = "misalignment.pinion_pressure_angle", .quantity = Quantity::SmallAngle, .range = misalignment_angle,
       .fallback = "0", .meaning = "delta alpha_n1 of the pinion",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.pinion_pressure_angle = v.number; }},
      {.path = "misalignment.mesh_misalignment", .quantity = Quantity::Deviation, .range = removal, .fallback = "0",
       .meaning = "F_beta_y over the common face width, transverse base tangent; + opens at +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.mesh_misalignment = v.number; }},

      {.path = "material.youngs_modulus", .quantity = Quantity::Stress, .range = above_zero(1e7), .fallback = "206000",
       .meaning = "E of both gears",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.pinion_material.youngs_modulus = d.study.wheel_material.youngs_modulus = v.number;
       }},
      {.path = "material.poissons_ratio", .range = {.low = 0.0, .high = 0.5, .high_open = true}, .fallback = "0.3",
       .meaning = "nu of both gears",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.pinion_material.poissons_ratio = d.study.wheel_material.poissons_ratio = v.number;
       }},
      {.path = "gear.material.youngs_modulus", .quantity = Quantity::Stress, .range = above_zero(1e7),
       .fallback = "(as [material])", .meaning = "E of this gear",
       .store = [](Draft& d, Member m, const Value& v) { material(d, m).youngs_modulus = v.number; }},
      {.path = "gear.material.poissons_ratio", .range = {.low = 0.0, .high = 0.5, .high_open = true},
       .fallback = "(as [material])", .meaning = "nu of this gear",
       .store = [](Draft& d, Member m, const Value& v) { material(d, m).poissons_ratio = v.number; }},

      {.path = "load.torque", .kind = NumberOrList, .quantity = Quantity::Torque, .range = from_zero(1e9),
       .fallback = "0", .meaning = "on the pinion; a list runs each, 0 is unloaded",
       .hint = "for torque the other way round write pair.working_flank = \"left\"",
       .store = [](Scene& s, Member, const Value& v) { s.torques = v.numbers; }},
      {.path = "cycle.positions", .kind = Integer, .range = {.low = 1, .high = 4096}, .fallback = "32",
       .meaning = "mesh positions over one base pitch",
       .store = [](Draft& d, Member, const Value& v) { d.study.cycle.positions = static_cast<int>(v.integer); }},
      {.path = "cycle.phases", .kind = NumberList, .range = within(100.0), .fallback = "(evenly spaced positions)",
       .meaning = "explicit phases of the reference tooth pair, in base pitches; 0 where its contact line enters",
       .store = [](Draft& d, Member, const Value& v) { d.study.cycle.phases = v.numbers; }},

      {.path = "fidelity.compliance", .kind = Word, .words = {"rigid", "thin_slice"}, .later = {"fitted", "fe"},
       .fallback = "\"thin_slice\"", .meaning = "rung of the ladder of compliance models",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.fidelity.compliance = static_cast<ComplianceModel>(v.integer);
       }},
      {.path = "fidelity.gap", .kind = Word, .words = {"plane_of_action"}, .later = {"whole_surface"},
       .fallback = "\"plane_of_action\"", .meaning = "where contact is sought"},
      {.path = "fidelity.quadrature.rule", .kind = Word, .words = {"gauss2", "gauss3", "midpoint"},
       .fallback = "\"gauss2\"", .meaning = "points in each interval of a contact line",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.fidelity.quadrature.rule = static_cast<QuadratureRule>(v.integer);
       }},
      {.path = "fidelity.quadrature.intervals", .kind = Integer, .range = {.low = 1, .high = 500}, .fallback = "5",
       .meaning = "intervals of a full contact line",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.fidelity.quadrature.intervals = static_cast<int>(v.integer);
       }},
      {.path = "fidelity.effects", .kind = WordList,
       .words = {"bending", "hertzian_contact", "tip_corner", "extended_contact_region", "misalignment",
                 "modifications", "manufacturing_errors"},
       .later = {"gear_body_compliance", "adjacent_teeth", "shaft_deflection"}, .fallback = "\"auto\"",
       .meaning = "what enters the run; auto decides from the study, a list switches by hand",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.fidelity.automatic_effects = !v.is_list;
         d.study.fidelity.effects = v.words;
       }},
      {.path = "fidelity.accuracy", .kind = Later, .fallback = "(none)",
       .meaning = "the cheapest rung that keeps this"},
  };
}

std::vector<SchemaKey> task_rows() {
  return {
      {.path = "scenes", .kind = Scenes, .fallback = "(one scene, nominal)",
       .meaning = "working conditions; each overrides `misalignment.*`, `load.torque` or either gear's `error.*`"},
      {.path = "scenes[].name", .kind = Text, .fallback = "(scene 1, scene 2 ...)",
       .meaning = "names the scene in results",
       .store = [](Scene& s, Member, const Value& v) { s.name = v.text; }},
      {.path = "scenes[].weight", .range = above_zero(1e9), .fallback = "1",
       .meaning = "its share in mean and mean+2sigma",
       .store = [](Scene& s, Member, const Value& v) { s.weight = v.number; }},

      {.path = "optimise.objective", .kind = Objective, .fallback = "\"peak_contact_stress\"",
       .meaning = "minimised; a table of names and weights minimises the sum of weight * value (um, MPa, N/mm)"},
      {.path = "optimise.over", .kind = Word, .words = {"nominal", "worst", "mean", "mean+2sigma"},
       .fallback = "\"worst\"", .meaning = "of the scenes; nominal is the first",
       .store = [](Draft& d, Member, const Value& v) { d.study.optimise.over = static_cast<Aggregate>(v.integer); }},
      {.path = "optimise.solver", .kind = Word, .words = solver_names(), .fallback = "\"ipopt\"",
       .meaning = "the optimiser",
       .store = [](Draft& d, Member, const Value& v) { d.study.optimise.solver = v.text; }},
      {.path = "optimise.variables", .kind = Variables, .fallback = "(none)",
       .meaning = "\"pinion.modification.lead_crowning\" = [0, 40]: what may change, in the unit of its key"},
      {.path = "optimise.constraints", .kind = Constraints, .fallback = "(none)",
       .meaning = "\"te_peak_to_peak\" = { max = 1.5 }: transmission error in um, stress in MPa, line load in N/mm"},
      {.path = "optimise.max_evaluations", .kind = Integer, .range = {.low = 1, .high = 10'000'000}, .fallback = "2000",
       .meaning = "then an orderly stop with the best so far",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.optimise.max_evaluations = static_cast<int>(v.integer);
       }},
      {.path = "optimise.max_seconds", .quantity = Quantity::Time, .range = above_zero(1e8), .fallback = "(no limit)",
       .meaning = "then an orderly stop with the best so far",
       .store = [](Draft& d, Member, const Value& v) { d.study.optimise.max_seconds = v.number; }},
      {.path = "optimise.seed", .kind = Integer, .range = {.low = 0, .high = 2147483647}, .fallback = "1",
       .meaning = "of the stochastic solvers",
       .store = [](Draft& d, Member, const Value& v) {
         d.study.optimise.seed = static_cast<unsigned long>(v.integer);
       }},

      {.path = "expect", .kind = Expectations, .fallback = "(none)",
       .meaning = "\"loaded.summary.te_peak_to_peak_um\" = { max = 3 }: what results.json must say"},
      {.path = "sweep", .kind = Later, .fallback = "(none)", .meaning = "samples of a parameter space"},
  };
}

// clang-format on

/// Appends the rows, a gear's once for each gear.
void append(std::vector<SchemaKey>& schema, const std::vector<SchemaKey>& rows) {
  constexpr std::string_view any_gear = "gear.";
  for (const SchemaKey& row : rows) {
    schema.push_back(row);
    if (!row.path.starts_with(any_gear)) continue;
    schema.push_back(row);
    const std::string rest = row.path.substr(any_gear.size());
    SchemaKey& of_pinion = schema[schema.size() - 2];
    SchemaKey& of_wheel = schema.back();
    of_pinion.path = "pinion." + rest;
    of_wheel.path = "wheel." + rest;
    of_wheel.member = Member::Wheel;
  }
}

std::vector<SchemaKey> make_schema() {
  std::vector<SchemaKey> schema;
  for (const auto& rows : {geometry_rows(), flank_rows(), working_condition_rows(), task_rows()}) append(schema, rows);
  return schema;
}

}  // namespace

const std::vector<SchemaKey>& study_schema() {
  static const std::vector<SchemaKey> schema = make_schema();
  return schema;
}

const std::vector<ExclusiveKeys>& exclusive_keys() {
  static const std::vector<ExclusiveKeys> pairs{
      {"pair.normal_module", "pair.normal_diametral_pitch"},
      {"cycle.positions", "cycle.phases"},
      {"pinion.modification.profile_crowning", "pinion.modification.addendum_crowning"},
      {"pinion.modification.profile_crowning", "pinion.modification.dedendum_crowning"},
      {"wheel.modification.profile_crowning", "wheel.modification.addendum_crowning"},
      {"wheel.modification.profile_crowning", "wheel.modification.dedendum_crowning"},
  };
  return pairs;
}

}  // namespace flankwright::studies
