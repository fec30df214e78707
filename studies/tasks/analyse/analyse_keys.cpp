#include "studies/tasks/analyse/analyse_keys.hpp"

#include <algorithm>

#include "studies/study_file/key_rows.hpp"
#include "studies/study_file/left_out_effects.hpp"

namespace flankwright::studies {

namespace {

/// What a key is to a loaded mesh; nothing where there is no derivative with respect to it.
std::optional<MeshParameter> mesh_parameter(const SchemaKey& key) {
  if (const auto* modification = std::get_if<ModificationParameter>(&key.store)) return GearParameter{key.member, *modification};
  for (const NamedMisalignmentParameter& p : misalignment_parameters) {
    if (key.path == "misalignment." + std::string(p.name)) return p.parameter;
  }
  if (key.path == "load.torque") return PinionTorque{};
  return std::nullopt;
}

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> analyse_keys() {
  using enum ValueKind;
  return {
      {.path = "analyse.gradients", .kind = Free, .allowed = "a list of keys below pinion.modification, wheel.modification or misalignment, twist_compensation of either gear, and load.torque",
       .fallback = "(none)",
       .meaning = "derivatives of every loaded output by these keys, each per its unit: `loaded[].gradients`; task \"analyse\""},
  };
}

// clang-format on

void read_gradients(StudyReading& reading) {
  const Match* match = reading.find("analyse.gradients");
  if (match == nullptr) return;
  const toml::array* keys = match->node->as_array();
  if (keys == nullptr) return reading.refuse(match->position, match->path, match->node, "allowed is " + allowed_values(*match->key));
  for (const toml::node& node : *keys) {
    const auto known = study_keys().find(node.value_or(std::string()));
    const auto parameter = known == study_keys().end() ? std::nullopt : mesh_parameter(*known->second);
    if (!parameter) {
      const std::string hint = known == study_keys().end() ? nearest_key_hint(study_keys(), node.value_or(std::string())) : "";
      reading.refuse(match->position, match->path, &node, "allowed is " + allowed_values(*match->key) + hint);
      continue;
    }
    const Quantity quantity = known->second->quantity;
    reading.builder.study.gradients.push_back({known->first, *parameter, std::string(default_unit(quantity)), internal_value(1.0, quantity)});
  }
}

void check_gradients(StudyReading& reading) {
  const Study& study = reading.builder.study;
  for (const GradientParameter& p : study.gradients) require_effect_of(reading, "analyse.gradients", p.path);
  const auto is_torque = [](const GradientParameter& p) { return p.path == "load.torque"; };
  if (std::ranges::any_of(study.gradients, is_torque) && ShaftsOfPair{study.shaft, study.unit}.depends_on_load()) {
    reading.refuse_key(
        "analyse.gradients",
        "none by load.torque with a bearing whose stiffness depends on the load or that has a clearance: it yields in another way at each torque, "
        "which the derivative would leave out. Two analyses at torques that differ by a few per cent show the change");
  }
  if (!study.gradients.empty() && study.fidelity.compliance == ComplianceModel::Rigid) {
    reading.refuse_key("analyse.gradients",
                       "none with a rigid compliance, which has no loaded contact: allowed is \"thin_slice\", \"fitted\" or \"fe\"");
  }
}

}  // namespace flankwright::studies
