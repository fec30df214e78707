#include <algorithm>
#include <cmath>
#include <type_traits>

#include "studies/study_file/shaft_part_keys.hpp"
#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

namespace {

UnitData& unit(StudyBuilder& builder) { return builder.study.unit; }
ShaftData& shaft(StudyBuilder& builder) { return unit(builder).shafts.back(); }
UnitMesh& mesh(StudyBuilder& builder) { return unit(builder).meshes.back(); }
UnitLoad& load(StudyBuilder& builder) { return unit(builder).loads.back(); }
ShaftJoint& joint(StudyBuilder& builder) { return unit(builder).joints.back(); }

constexpr Range any_force = within(1e9), any_torque = within(1e9);

using enum ValueKind;

ShaftData& shaft_of(StudyBuilder& builder, Member /*member*/) { return shaft(builder); }
ShaftBearing& of_shaft(StudyBuilder& builder, Member /*member*/) { return shaft(builder).bearings.back(); }
ShaftBearing& of_joint(StudyBuilder& builder, Member /*member*/) { return joint(builder).bearing; }

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> unit_rows() {
  std::vector<SchemaKey> rows{
      {.path = "unit.reference_torque", .quantity = Quantity::Torque, .range = {.low = 1e-6, .high = 1e9}, .fallback = "(the largest torque of [load] above 0)",
       .meaning = "on the pinion, at which the loads and torques of the unit are meant; they all scale with the torque",
       .store = [](StudyBuilder& d, Member, const Value& v) { unit(d).reference_torque = v.number; }},
      {.path = "unit.shafts", .kind = TableList, .fallback = "(none)", .meaning = "shafts that carry no gear of the pair; those that do are pinion.shaft and wheel.shaft",
       .store = [](StudyBuilder& d, Member, const Value&) { unit(d).shafts.push_back({.material = {not_given, not_given}}); }},
      {.path = "unit.shafts[].name", .kind = Text, .fallback = "(required)", .meaning = "by which meshes, loads and joints refer to it",
       .store = [](StudyBuilder& d, Member, const Value& v) { shaft(d).name = v.text; }},
      {.path = "unit.shafts[].sections", .kind = TableList, .fallback = "(required)", .meaning = "as pinion.shaft.sections",
       .store = [](StudyBuilder& d, Member, const Value&) { shaft(d).sections.emplace_back(); }},
      {.path = "unit.shafts[].bearings", .kind = TableList, .fallback = "(none)", .meaning = "in the housing",
       .store = [](StudyBuilder& d, Member, const Value&) { shaft(d).bearings.emplace_back(); }},
      {.path = "unit.shafts[].bearings[].position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)",
       .meaning = "from the shaft's end of lowest z",
       .store = [](StudyBuilder& d, Member m, const Value& v) { of_shaft(d, m).position = v.number; }},
      {.path = "unit.shafts[].torque_position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(none: no coupling)",
       .meaning = "of the coupling, where the torque that the gears leave over enters or leaves",
       .store = [](StudyBuilder& d, Member, const Value& v) { shaft(d).torque_position = v.number; }},
      {.path = "unit.meshes", .kind = TableList, .fallback = "(none)", .meaning = "external cylindrical meshes beside the pair; they act with mean forces, at mid face without a stiffness",
       .store = [](StudyBuilder& d, Member, const Value&) { unit(d).meshes.emplace_back(); }},
      {.path = "unit.meshes[].name", .kind = Text, .fallback = "(mesh and a number)", .meaning = "for results",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).name = v.text; }},
  };
  const auto add_gear = [&]<std::size_t g>(std::integral_constant<std::size_t, g>) {
    const std::string number = g == 0 ? "_1" : "_2", which = g == 0 ? "first" : "second";
    rows.insert(rows.end(), {
      {.path = "unit.meshes[].shaft" + number, .kind = Text, .fallback = "(required)", .meaning = "of the " + which + " gear: \"pinion\", \"wheel\" or a name of unit.shafts",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).gears[g].shaft = v.text; }},
      {.path = "unit.meshes[].position" + number, .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)",
       .meaning = "of the " + which + " gear's mid face on its shaft",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).gears[g].position = v.number; }},
      {.path = "unit.meshes[].teeth" + number, .kind = Integer, .range = {.low = 5, .high = 1000}, .fallback = "(required)", .meaning = "of the " + which + " gear",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).gears[g].teeth = static_cast<int>(v.integer); }},
      {.path = "unit.meshes[].face_width" + number, .quantity = Quantity::Length, .range = any_length, .fallback = "(0: the shaft's own section)",
       .meaning = "of the " + which + " gear, which is one with the shaft over it, as thick as the root of the basic rack (bending: mean of tip and root)",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).gears[g].face_width = v.number; }},
    });
  };
  add_gear(std::integral_constant<std::size_t, 0>{});
  add_gear(std::integral_constant<std::size_t, 1>{});
  rows.insert(rows.end(), {
      {.path = "unit.meshes[].normal_module", .quantity = Quantity::Length, .range = {.low = 0.05, .high = 100.0}, .fallback = "(required)", .meaning = "m_n",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).normal_module = v.number; }},
      {.path = "unit.meshes[].pressure_angle", .quantity = Quantity::Angle, .range = {.low = 10.0, .high = 35.0}, .fallback = "(20)", .meaning = "normal section",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).pressure_angle = v.number; }},
      {.path = "unit.meshes[].helix_angle", .quantity = Quantity::Angle, .range = {.low = 0.0, .high = 45.0}, .fallback = "(0)", .meaning = "at the reference cylinder",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).helix_angle = v.number; }},
      {.path = "unit.meshes[].hand_1", .kind = Word, .words = {"right", "left"}, .fallback = "(\"right\")", .meaning = "of the first gear; the second one's is the opposite",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).hand = v.integer == 0 ? Hand::Right : Hand::Left; }},
      {.path = "unit.meshes[].centre_distance", .quantity = Quantity::Length, .range = any_length, .fallback = "(of the reference circles)", .meaning = "a_w",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).centre_distance = v.number; }},
      {.path = "unit.meshes[].angle", .quantity = Quantity::Angle, .range = within(360.0), .fallback = "(required)",
       .meaning = "where the second axis lies, seen from the first: from x, the direction from pinion to wheel, towards y",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).angle = v.number; }},
      {.path = "unit.meshes[].torque_1", .quantity = Quantity::Torque, .range = any_torque, .fallback = "(what the balance of the shafts leaves)",
       .meaning = "on the first gear by its shaft, about z, at reference_torque; for shafts that share their torque",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).torque = v.number; }},
      {.path = "unit.meshes[].stiffness", .quantity = Quantity::MeshStiffness, .range = above_zero(1000.0), .fallback = "(none: the force stays at mid face)",
       .meaning = "c_gamma per face width, usually 20 of steel: the teeth hold both shafts against tilting towards each other",
       .store = [](StudyBuilder& d, Member, const Value& v) { mesh(d).stiffness = v.number; }},
      {.path = "unit.loads", .kind = TableList, .fallback = "(none)", .meaning = "forces and moments from outside at reference_torque",
       .store = [](StudyBuilder& d, Member, const Value&) { unit(d).loads.emplace_back(); }},
      {.path = "unit.loads[].shaft", .kind = Text, .fallback = "(required)", .meaning = "\"pinion\", \"wheel\" or a name of unit.shafts",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).shaft = v.text; }},
      {.path = "unit.loads[].position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)", .meaning = "on the shaft",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).position = v.number; }},
      {.path = "unit.loads[].force_x", .quantity = Quantity::Force, .range = any_force, .fallback = "(0)", .meaning = "from pinion to wheel",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).force.x() = v.number; }},
      {.path = "unit.loads[].force_y", .quantity = Quantity::Force, .range = any_force, .fallback = "(0)", .meaning = "z x x",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).force.y() = v.number; }},
      {.path = "unit.loads[].force_z", .quantity = Quantity::Force, .range = any_force, .fallback = "(0)", .meaning = "along the shafts",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).force.z() = v.number; }},
      {.path = "unit.loads[].moment_x", .quantity = Quantity::Torque, .range = any_torque, .fallback = "(0)", .meaning = "about x",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).moment.x() = v.number; }},
      {.path = "unit.loads[].moment_y", .quantity = Quantity::Torque, .range = any_torque, .fallback = "(0)", .meaning = "about y",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).moment.y() = v.number; }},
      {.path = "unit.loads[].torque", .quantity = Quantity::Torque, .range = any_torque, .fallback = "(0)",
       .meaning = "about z; the pinion's is positive where it works on its right flank, negative on the left one",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).moment.z() = v.number; }},
      {.path = "unit.loads[].constant", .kind = Word, .words = {"yes", "no"}, .fallback = "(\"no\")",
       .meaning = "yes: the same at every torque, as a weight or the pull of a belt; no: in proportion to the torque",
       .store = [](StudyBuilder& d, Member, const Value& v) { load(d).constant = v.integer == 0; }},
      {.path = "unit.joints", .kind = TableList, .fallback = "(none)", .meaning = "bearings between two shafts on one axis",
       .store = [](StudyBuilder& d, Member, const Value&) { unit(d).joints.emplace_back(); }},
      {.path = "unit.joints[].shaft", .kind = Text, .fallback = "(required)", .meaning = "the inner one",
       .store = [](StudyBuilder& d, Member, const Value& v) { joint(d).shaft = v.text; }},
      {.path = "unit.joints[].position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)", .meaning = "on the inner shaft",
       .store = [](StudyBuilder& d, Member m, const Value& v) { of_joint(d, m).position = v.number; }},
      {.path = "unit.joints[].outer_shaft", .kind = Text, .fallback = "(required)", .meaning = "in which the inner one runs",
       .store = [](StudyBuilder& d, Member, const Value& v) { joint(d).outer_shaft = v.text; }},
      {.path = "unit.joints[].outer_position", .quantity = Quantity::Length, .range = on_shaft, .fallback = "(required)", .meaning = "on the outer shaft",
       .store = [](StudyBuilder& d, Member, const Value& v) { joint(d).outer_position = v.number; }},
      {.path = "unit.housing.seats", .kind = TextList, .fallback = "(none: a rigid housing)", .meaning = "names of bearings whose seats yield, in the order of the stiffness",
       .store = [](StudyBuilder& d, Member, const Value& v) { unit(d).housing.seats = v.words; }},
      {.path = "unit.housing.stiffness", .kind = NumberList, .quantity = Quantity::Stiffness, .range = within(1e9), .fallback = "(none: a rigid housing)",
       .meaning = "between the seats' displacements x, y, z of each: the matrix row by row, symmetric and positive definite",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         const auto size = static_cast<Eigen::Index>(std::lround(std::sqrt(static_cast<double>(v.numbers.size()))));
         Eigen::MatrixXd& stiffness = unit(d).housing.stiffness;
         stiffness = Eigen::Map<const Eigen::VectorXd>(v.numbers.data(), std::ssize(v.numbers));
         if (size * size == std::ssize(v.numbers)) stiffness.resize(size, size);
       }},
  });
  const auto insert = [&](std::vector<SchemaKey>::const_iterator before, const std::vector<SchemaKey>& more) {
    rows.insert(before, more.begin(), more.end());
  };
  insert(std::ranges::find(rows, "unit.shafts[].bearings", &SchemaKey::path), shaft_section_rows<shaft_of>("unit.shafts[]"));
  insert(std::ranges::find(rows, "unit.meshes", &SchemaKey::path), shaft_material_rows<shaft_of>("unit.shafts[]", "(as the pinion's)"));
  constexpr const char* name = "(its shaft and a number)";
  insert(rows.end(), bearing_rows<of_shaft>("unit.shafts[].bearings[]", {.axial = held_by_first, .name = name}));
  insert(rows.end(), bearing_rows<of_joint>("unit.joints[]", {.axial = "(0: slides)", .name = name}));
  return rows;
}

// clang-format on

}  // namespace flankwright::studies
