#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

namespace {

Modification& modification(Draft& draft, Member m) {
  return m == Member::Pinion ? draft.study.pinion_modification : draft.study.wheel_modification;
}
FlankGrid& grid(Draft& draft, Member m) {
  return m == Member::Pinion ? draft.study.pinion_grid : draft.study.wheel_grid;
}
std::vector<std::string>& tooth_grids(Draft& draft, Member m) {
  return m == Member::Pinion ? draft.study.pinion_tooth_grids : draft.study.wheel_tooth_grids;
}
ManufacturingError& error(Scene& scene, Member m) {
  return m == Member::Pinion ? scene.pinion_error : scene.wheel_error;
}

/// One number for all teeth, or one for each.
void store(const Value& v, double& of_all, std::vector<double>& of_each) {
  of_all = v.is_list ? 0.0 : v.numbers.front();
  of_each = v.is_list ? v.numbers : std::vector<double>{};
}

constexpr Range relief_extent = from_zero(10000.0);  // mm; 0 is "not given"

using enum ValueKind;
using MP = ModificationParameter;

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> flank_rows() {
  return {
      {.path = "gear.modification.lead_crowning", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "C_beta, removed at both face ends, parabola over z", .store = MP::LeadCrowning},
      {.path = "gear.modification.lead_slope", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "C_Hbeta over the face width; + removes at z = +b/2, zero at mid face", .store = MP::LeadSlope},
      {.path = "gear.modification.profile_crowning", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "C_alpha: addendum and dedendum crowning at once", .store = MP::ProfileCrowning},
      {.path = "gear.modification.addendum_crowning", .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0", .meaning = "removed at the tip, parabola from the pitch point up",
       .store = MP::AddendumCrowning},
      {.path = "gear.modification.dedendum_crowning", .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0", .meaning = "removed at the start of active profile, parabola from the pitch point down",
       .store = MP::DedendumCrowning},
      {.path = "gear.modification.profile_slope", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "C_Halpha over the active profile height; + removes at the tip, zero at the pitch point",
       .store = MP::ProfileSlope},
      {.path = "gear.modification.tip_relief.amount", .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0", .meaning = "C_alpha_a, removed at the tip", .store = MP::TipReliefAmount},
      {.path = "gear.modification.tip_relief.height", .quantity = Quantity::Length, .range = relief_extent,
       .fallback = "0", .meaning = "radial, from the tip down; above 0 where there is an amount",
       .store = MP::TipReliefHeight},
      {.path = "gear.modification.tip_relief.shape", .kind = Word, .words = {"linear", "parabolic"},
       .fallback = "\"linear\"", .meaning = "between its start and the tip",
       .store = [](Draft& d, Member m, const Value& v) {
         modification(d, m).tip_relief.shape = static_cast<ReliefShape>(v.integer);
       }},
      {.path = "gear.modification.root_relief.amount", .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0", .meaning = "C_alpha_f, removed at the start of active profile", .store = MP::RootReliefAmount},
      {.path = "gear.modification.root_relief.height", .quantity = Quantity::Length, .range = relief_extent,
       .fallback = "0", .meaning = "radial, from the start of active profile up; above 0 where there is an amount",
       .store = MP::RootReliefHeight},
      {.path = "gear.modification.root_relief.shape", .kind = Word, .words = {"linear", "parabolic"},
       .fallback = "\"linear\"", .meaning = "between its start and the start of active profile",
       .store = [](Draft& d, Member m, const Value& v) {
         modification(d, m).root_relief.shape = static_cast<ReliefShape>(v.integer);
       }},
      {.path = "gear.modification.end_relief.amount", .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0", .meaning = "removed at both face ends, linear", .store = MP::EndReliefAmount},
      {.path = "gear.modification.end_relief.length", .quantity = Quantity::Length, .range = relief_extent,
       .fallback = "0", .meaning = "axial, from each face end; above 0 where there is an amount",
       .store = MP::EndReliefLength},
      {.path = "gear.modification.twist", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "removed twist * (y / h_active) * (z / b); + removes at the tip at z = +b/2", .store = MP::Twist},
      {.path = "gear.modification.parabolic_te", .quantity = Quantity::ParabolicTe, .range = from_zero(1000.0),
       .fallback = "0",
       .meaning = "a of the predesigned transmission error -a phi1^2: removed along the contact line of pinion angle phi1",
       .store = MP::ParabolicTe},
      {.path = "gear.modification.topography.face_2", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "removed c P_0(profile) P_2(face): Legendre polynomials, -1 at the start of active profile and z = -b/2 .. 1 at the tip and z = +b/2", .store = MP::TopographyFace2},
      {.path = "gear.modification.topography.profile_2", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_2(profile) P_0(face)", .store = MP::TopographyProfile2},
      {.path = "gear.modification.topography.face_3", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_0(profile) P_3(face)", .store = MP::TopographyFace3},
      {.path = "gear.modification.topography.profile_3", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_3(profile) P_0(face)", .store = MP::TopographyProfile3},
      {.path = "gear.modification.topography.profile_1_face_2", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_1(profile) P_2(face)", .store = MP::TopographyProfile1Face2},
      {.path = "gear.modification.topography.profile_2_face_1", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_2(profile) P_1(face)", .store = MP::TopographyProfile2Face1},
      {.path = "gear.modification.topography.face_4", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_0(profile) P_4(face)", .store = MP::TopographyFace4},
      {.path = "gear.modification.topography.profile_4", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_4(profile) P_0(face)", .store = MP::TopographyProfile4},
      {.path = "gear.modification.topography.profile_1_face_3", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_1(profile) P_3(face)", .store = MP::TopographyProfile1Face3},
      {.path = "gear.modification.topography.profile_3_face_1", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_3(profile) P_1(face)", .store = MP::TopographyProfile3Face1},
      {.path = "gear.modification.topography.profile_2_face_2", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "the same with P_2(profile) P_2(face)", .store = MP::TopographyProfile2Face2},
      {.path = "gear.modification.grid", .kind = Text, .fallback = "(none)",
       .meaning = "CSV file, beside the study unless its path says otherwise: measured or topological deviation, "
                  "columns radius_mm, z_mm, deviation_um (+ = metal added, normal to the flank)",
       .store = [](Draft& d, Member m, const Value& v) { grid(d, m).file = v.text; }},
      {.path = "gear.modification.grid_smoothing.profile_pieces", .kind = Integer, .range = {.low = 1, .high = 1000},
       .fallback = "(through every point)",
       .meaning = "cubic pieces of the surface along the profile; the fewer, the smoother, fitted by least squares",
       .store = [](Draft& d, Member m, const Value& v) { grid(d, m).profile_pieces = static_cast<int>(v.integer); }},
      {.path = "gear.modification.grid_smoothing.face_pieces", .kind = Integer, .range = {.low = 1, .high = 1000},
       .fallback = "(through every point)", .meaning = "the same along the face",
       .store = [](Draft& d, Member m, const Value& v) { grid(d, m).face_pieces = static_cast<int>(v.integer); }},

      {.path = "gear.error.helix_slope", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "f_Hbeta over the face width, metal added; + adds at z = +b/2, zero at mid face; a list: of each tooth",
       .store = [](Scene& s, Member m, const Value& v) { store(v, error(s, m).helix_slope, error(s, m).helix_slopes); }},
      {.path = "gear.error.profile_slope", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "f_Halpha, metal added; + adds at the tip, zero at the reference circle; a list: of each tooth",
       .store = [](Scene& s, Member m, const Value& v) { store(v, error(s, m).profile_slope, error(s, m).profile_slopes); }},
      {.path = "gear.error.pitch", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range,
       .fallback = "0",
       .meaning = "adjacent pitch error, adds up from tooth to tooth; a list: cumulative deviation of each tooth",
       .store = [](Scene& s, Member m, const Value& v) {
         store(v, error(s, m).pitch_step, error(s, m).cumulative_pitch);
       }},
      {.path = "gear.error.grids", .kind = TextList, .fallback = "(none)",
       .meaning = "CSV files as modification.grid, one for each tooth, \"\" for none; on top of all else",
       .store = [](Draft& d, Member m, const Value& v) { tooth_grids(d, m) = v.words; }},
      {.path = "gear.error.twist", .kind = NumberOrList, .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "added twist * (y / h_active) * (z / b); + adds at the tip at z = +b/2; a list: of each tooth",
       .store = [](Scene& s, Member m, const Value& v) { store(v, error(s, m).twist, error(s, m).twists); }},
  };
}

// clang-format on

}  // namespace flankwright::studies
