#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

namespace {

GearData& gear(StudyBuilder& builder, Member m) { return builder.study.pair[m]; }
GenerationKeys& generation(StudyBuilder& builder, Member m) { return builder.generation[m]; }
GrindingProcess& process(StudyBuilder& builder, Member m) { return builder.study.modification[m].process; }

constexpr const char* usual_edge = "(0.05 m_n, at most a quarter of the tooth thickness at the tip)";

std::vector<std::string> task_names() {
  std::vector<std::string> names;
  for (const Task* task : registered_tasks()) names.emplace_back(task->name);
  return names;
}

using enum ValueKind;

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> geometry_rows() {
  return {
      {.path = "title", .kind = Text, .fallback = "(the file's name)", .meaning = "heads the report",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.title = v.text; }},
      {.path = "task", .kind = Word, .words = task_names(),
       .fallback = "\"analyse\"", .meaning = "what `run` does",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.task = registered_tasks()[static_cast<std::size_t>(v.integer)]; }},
      {.path = "pair.normal_module", .quantity = Quantity::Length, .range = {.low = 0.001, .high = 1000.0},
       .fallback = "(required, or normal_diametral_pitch)", .meaning = "m_n",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.normal_module = v.number; }},
      {.path = "pair.normal_diametral_pitch", .quantity = Quantity::DiametralPitch,
       .range = {.low = 0.0254, .high = 25400.0}, .fallback = "(from normal_module)",
       .meaning = "instead of the module",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.normal_module = 1.0 / v.number; }},
      {.path = "pair.pressure_angle", .quantity = Quantity::Angle, .range = {.low = 10.0, .high = 35.0},
       .fallback = "20", .meaning = "alpha_n, normal section",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.pressure_angle = v.number; }},
      {.path = "pair.helix_angle", .quantity = Quantity::Angle, .range = from_zero(45.0), .fallback = "0",
       .meaning = "beta at the reference cylinder; 0 is a spur gear",
       .hint = "the hand says the direction: pinion.hand",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.helix_angle = v.number; }},
      {.path = "pair.centre_distance", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(without backlash)", .meaning = "a_w; by default from the profile shifts",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.centre_distance = v.number; }},
      {.path = "pair.driver", .kind = Word, .words = {"pinion", "wheel"}, .fallback = "\"pinion\"",
       .meaning = "which gear drives",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.driver = static_cast<Member>(v.integer); }},
      {.path = "pair.working_flank", .kind = Word, .words = {"right", "left"}, .fallback = "\"right\"",
       .meaning = "flank of the pinion that carries; left is the coast side",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.pair.working_flank = static_cast<WorkingFlank>(v.integer);
       }},

      {.path = "gear.teeth", .kind = Integer, .range = {.low = 5, .high = 1000}, .fallback = "(required)",
       .meaning = "z",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).teeth = static_cast<int>(v.integer); }},
      {.path = "gear.face_width", .quantity = Quantity::Length, .range = any_length, .fallback = "(required)",
       .meaning = "b; both gears are centred on z = 0",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).face_width = v.number; }},
      {.path = "pinion.hand", .kind = Word, .words = {"right", "left"}, .fallback = "\"right\"",
       .meaning = "hand of helix: right turns counter-clockwise with growing z",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.pair.pinion_hand = static_cast<Hand>(v.integer); }},
      {.path = "wheel.hand", .kind = Word, .words = {"right", "left"}, .fallback = "(the opposite of the pinion's)",
       .meaning = "may be said, must be the opposite",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.wheel_hand = static_cast<Hand>(v.integer); }},
      {.path = "gear.profile_shift", .range = within(2.0), .fallback = "0",
       .meaning = "x, in normal modules; + outwards",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).profile_shift = v.number; }},
      {.path = "gear.tooth_thickness_allowance", .quantity = Quantity::Deviation, .range = {.low = -10000.0, .high = 0.0}, .fallback = "0",
       .meaning = "E_sn: normal tooth thickness at the reference cylinder less that of the profile shift; the rack stands deeper, tip diameter and "
                  "default centre distance stay",
       .hint = "a thicker tooth is one of larger profile shift",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).tooth_thickness_allowance = v.number; }},
      {.path = "gear.tip_diameter", .quantity = Quantity::Length, .range = any_length,
       .fallback = "(from rack and profile shift)", .meaning = "d_a",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).tip_diameter = v.number; }},
      {.path = "gear.edges.tip_rounding", .quantity = Quantity::Length, .range = from_zero(100.0), .fallback = usual_edge,
       .meaning = "radius of the edge between flank and tip, across the edge; 0 is sharp: it carries load, but its pressure has no bound and is left out of the stress",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).tip_rounding = v.number; }},
      {.path = "gear.edges.tip_chamfer.amount", .quantity = Quantity::Length, .range = from_zero(100.0), .fallback = "0",
       .meaning = "h_K: how far below the tip circle the chamfer begins, radially; instead of tip_rounding",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).tip_chamfer.amount = v.number; }},
      {.path = "gear.edges.tip_chamfer.angle", .quantity = Quantity::Angle, .range = {.low = 1.0, .high = 89.0}, .fallback = "45",
       .meaning = "between chamfer and tip cylinder, across the edge",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).tip_chamfer.angle = v.number; }},
      {.path = "gear.edges.tip_chamfer.radius", .quantity = Quantity::Length, .range = from_zero(100.0), .fallback = usual_edge,
       .meaning = "of the edge between flank and chamfer, as tip_rounding",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).tip_chamfer.radius = v.number; }},
      {.path = "gear.edges.end_rounding", .quantity = Quantity::Length, .range = from_zero(100.0), .fallback = usual_edge,
       .meaning = "radius of the edges between flank and end faces, across the edge; what it takes off the face width carries nothing",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).end_rounding = v.number; }},
      {.path = "gear.edges.end_chamfer.amount", .quantity = Quantity::Length, .range = from_zero(1000.0), .fallback = "0",
       .meaning = "how far from the end face the chamfer begins, along the axis; instead of end_rounding",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).end_chamfer.amount = v.number; }},
      {.path = "gear.edges.end_chamfer.angle", .quantity = Quantity::Angle, .range = {.low = 1.0, .high = 89.0}, .fallback = "45",
       .meaning = "between chamfer and end face, across the edge",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).end_chamfer.angle = v.number; }},
      {.path = "gear.edges.end_chamfer.radius", .quantity = Quantity::Length, .range = from_zero(100.0), .fallback = usual_edge,
       .meaning = "of the edge between flank and chamfer, as end_rounding",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).end_chamfer.radius = v.number; }},
      {.path = "gear.rack.addendum", .range = above_zero(2.0), .fallback = "1", .meaning = "h_aP, in normal modules",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).rack.addendum = v.number; }},
      {.path = "gear.rack.dedendum", .range = above_zero(2.5), .fallback = "1.25", .meaning = "h_fP, in normal modules",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).rack.dedendum = v.number; }},
      {.path = "gear.rack.root_radius", .range = from_zero(2.0), .fallback = "(0.39, or the full rounding where that is less)",
       .meaning = "rho_fP, in normal modules; at most the full rounding of the tool's tip",
       .store = [](StudyBuilder& d, Member m, const Value& v) { gear(d, m).rack.root_radius = v.number; }},
      {.path = "gear.process", .kind = WordOrTable, .words = {grinding_kind_names.begin(), grinding_kind_names.end()}, .fallback = "\"none\"",
       .meaning = "what finishes the flank: generating_grinding and form_grinding twist a lead modification of helical teeth; topological grinds every "
                  "point as asked; none is computed as topological, and the notes say what twist it leaves out",
       .store = [](StudyBuilder& d, Member m, const Value& v) { if (!v.text.empty()) process(d, m).kind = static_cast<GrindingKind>(v.integer); }},
      {.path = "gear.process.kind", .kind = Word, .words = {grinding_kind_names.begin(), grinding_kind_names.end()}, .fallback = "(none)",
       .meaning = "the same, of a process that is written as a table",
       .store = [](StudyBuilder& d, Member m, const Value& v) { process(d, m).kind = static_cast<GrindingKind>(v.integer); }},
      {.path = "gear.twist_compensation", .range = from_zero(1.0), .fallback = "0",
       .meaning = std::string(describe(parameter_of("twist_compensation")).meaning), .store = parameter_of("twist_compensation")},
      {.path = "gear.grinding_wheel_diameter", .quantity = Quantity::Length, .range = {.low = 1.0, .high = 2000.0}, .fallback = "300",
       .meaning = "of the wheel of form_grinding; a larger one twists more",
       .store = [](StudyBuilder& d, Member m, const Value& v) { process(d, m).wheel_diameter = v.number; }},
      {.path = "gear.generation", .kind = WordOrTable, .words = {"rack"}, .fallback = "\"rack\"",
       .meaning = "tool that generates the flank; \"rack\" is the straight one: the involute",
       .store = [](StudyBuilder& d, Member m, const Value& v) { generation(d, m).kind = v.text; }},
      {.path = "gear.generation.kind", .kind = Word, .words = {"rack", "parabolic_rack", "revolution"},
       .fallback = "(none)",
       .meaning = "parabolic_rack needs coefficient [TM-107451]; revolution, spur gears only, needs half_apex and distance "
                  "[TM-100260]",
       .store = [](StudyBuilder& d, Member m, const Value& v) { generation(d, m).kind = v.text; }},
      {.path = "gear.generation.coefficient", .quantity = Quantity::Curvature, .range = from_zero(1000.0),
       .fallback = "(none)", .meaning = "a_c: the rack's normal profile deviates by a_c u^2 from the straight line",
       .store = [](StudyBuilder& d, Member m, const Value& v) { generation(d, m).coefficient = v.number; }},
      {.path = "gear.generation.half_apex", .quantity = Quantity::Angle,
       .range = {.low = 0.0, .high = 90.0, .low_open = true, .high_open = true}, .fallback = "(none)",
       .meaning = "alpha: half apex angle of the tool's cone",
       .store = [](StudyBuilder& d, Member m, const Value& v) { generation(d, m).half_apex = v.number; }},
      {.path = "gear.generation.distance", .quantity = Quantity::Length, .range = any_length, .fallback = "(none)",
       .meaning = "d: height of the tool's cone",
       .store = [](StudyBuilder& d, Member m, const Value& v) { generation(d, m).distance = v.number; }},
      {.path = "gear.generation.arc_radius", .quantity = Quantity::Length, .range = above_zero(1e9),
       .fallback = "(a cone)", .meaning = "rho: radius of the tool's axial section; left out, the section is straight",
       .store = [](StudyBuilder& d, Member m, const Value& v) { generation(d, m).arc_radius = v.number; }},
  };
}

// clang-format on

}  // namespace flankwright::studies
