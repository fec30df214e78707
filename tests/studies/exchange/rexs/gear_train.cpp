#include "tests/studies/exchange/rexs/gear_train.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/units.hpp"

namespace flankwright::studies::gear_trains {

namespace {

rexs::Attribute vector(const std::string& id, double x, double y, double z) {
  return {id, "mm", rexs::ValueType::NumberArray, "", {fmt::format("{}", x), fmt::format("{}", y), fmt::format("{}", z)}};
}

constexpr double shaft_length = 300.0;  // mm

}  // namespace

rexs::Attribute number(const std::string& id, double value, const std::string& unit) {
  return {id, unit, rexs::ValueType::Number, fmt::format("{}", value)};
}

rexs::Attribute word(const std::string& id, const std::string& value) { return {id, "none", rexs::ValueType::Word, value}; }

GearTrain::GearTrain(const std::string& version) {
  model_.version = version;
  casing_ = add("gear_casing");
}

int GearTrain::add(const std::string& type, const Attributes& attributes) {
  const int id = static_cast<int>(model_.components.size()) + 1;
  model_.components.push_back({.id = id, .type = type, .attributes = attributes});
  return id;
}

void GearTrain::relate(const std::string& type, const std::vector<std::pair<int, std::string>>& roles) {
  rexs::Relation relation{.id = static_cast<int>(model_.relations.size()) + 1, .type = type};
  for (const auto& [id, role] : roles) relation.refs.push_back({id, role});
  model_.relations.push_back(relation);
}

int GearTrain::bare_shaft(double y, double z) {
  return add("shaft", {vector("u_axis_vector", 1, 0, 0), vector("w_axis_vector", 0, 0, 1), vector("support_vector", 0, y, z)});
}

int GearTrain::shaft(double y, double z) { return shaft_on(y, z, {20.0, 280.0}); }

int GearTrain::shaft_on(double y, double z, const std::vector<double>& bearings) {
  const int shaft = bare_shaft(y, z);
  relate("assembly", {{shaft, "assembly"},
                      {add("shaft_section", {number("u_coordinate_on_shaft", 0, "mm"), number("length", shaft_length, "mm"),
                                             number("outer_diameter_begin", 50, "mm"), number("outer_diameter_end", 50, "mm")}),
                       "part"}});
  for (const double at : bearings) {
    Attributes bearing{number("u_coordinate_on_shaft_inner_side", at, "mm"), number("radial_stiffness", 8e8, "N / m")};
    if (at < 100.0) bearing.push_back(number("axial_stiffness", 3e8, "N / m"));
    relate("side", {{add("concept_bearing", bearing), "assembly"}, {shaft, "inner_part"}, {casing_, "outer_part"}});
  }
  return shaft;
}

int GearTrain::unit(const Attributes& attributes) { return add("gear_unit", attributes); }

int GearTrain::lubricant(const Attributes& attributes) {
  const int oil = add("lubricant", attributes);
  relate("reference", {{casing_, "origin"}, {oil, "referenced"}});
  return oil;
}

int GearTrain::last(const std::string& type) const {
  const auto found = std::ranges::find(model_.components.rbegin(), model_.components.rend(), type, &rexs::Component::type);
  return found->id;
}

int GearTrain::load(int shaft, double at, const Attributes& attributes) {
  Attributes all{number("u_coordinate_on_shaft", at, "mm")};
  all.insert(all.end(), attributes.begin(), attributes.end());
  const int load = add("external_load", all);
  relate("assembly", {{shaft, "assembly"}, {load, "part"}});
  return load;
}

int GearTrain::gear(int shaft, double at, int teeth, double module, std::optional<double> helix_deg, const Attributes& more) {
  const int gear = loose_gear(at, teeth, module, helix_deg);
  for (const rexs::Attribute& attribute : more) set(gear, attribute);
  relate("assembly", {{shaft, "assembly"}, {gear, "part"}});
  return gear;
}

int GearTrain::loose_gear(double at, int teeth, double module, std::optional<double> helix_deg) {
  Attributes all{number("number_of_teeth", teeth), number("normal_module", module, "mm"), number("face_width", 40, "mm"),
                 number("u_coordinate_on_shaft", at, "mm")};
  if (helix_deg) all.push_back(number("helix_angle_reference_diameter", *helix_deg, "deg"));
  return add("cylindrical_gear", all);
}

void GearTrain::flanks(int gear, const std::string& type, const Attributes& attributes) {
  const int left = add(type, attributes), right = add(type, attributes);
  relate("flank", {{gear, "gear"}, {left, "left"}, {right, "right"}});
}

void GearTrain::tool(int gear, const Attributes& attributes) {
  relate("manufacturing_step", {{gear, "workpiece"}, {add("rack_shaped_tool", attributes), "tool"}});
}

int GearTrain::stage(int gear_1, int gear_2) {
  const int stage = add("cylindrical_stage");
  relate("stage", {{stage, "stage"}, {gear_1, "gear_1"}, {gear_2, "gear_2"}});
  return stage;
}

int GearTrain::stage_data(int stage, int gear, const Attributes& attributes) {
  const int data = add("cylindrical_stage_gear_data", attributes);
  relate("stage_gear_data", {{stage, "stage"}, {gear, "gear"}, {data, "stage_gear_data"}});
  return data;
}

void GearTrain::load_case(const std::vector<std::pair<int, Attributes>>& changed) {
  rexs::LoadCase& load_case = model_.load_cases.emplace_back();
  load_case.id = static_cast<int>(model_.load_cases.size());
  for (const auto& [id, attributes] : changed) load_case.components.push_back({.id = id, .type = model_.find(id)->type, .attributes = attributes});
}

void GearTrain::set(int component, const rexs::Attribute& attribute) {
  Attributes& attributes = model_.components.at(static_cast<std::size_t>(component) - 1).attributes;
  const auto found = std::ranges::find(attributes, attribute.id, &rexs::Attribute::id);
  if (found == attributes.end()) {
    attributes.push_back(attribute);
  } else {
    *found = attribute;
  }
}

double reference_distance(int teeth_1, int teeth_2, double module, double helix_deg) {
  return 0.5 * module * (teeth_1 + teeth_2) / std::cos(helix_deg * units::deg);
}

}  // namespace flankwright::studies::gear_trains
