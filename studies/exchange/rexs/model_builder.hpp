#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/rexs_model.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

/// Builds a model component by component, in the words of a version of the format. Attributes go to the component that was added last.
class ModelBuilder {
 public:
  explicit ModelBuilder(const std::string& version) : version_(version) { model_.version = version; }

  bool before(std::string_view version) const { return version_ < version; }

  int add(const std::string& type, const std::string& name = {}) {
    const int id = static_cast<int>(model_.components.size()) + 1;
    model_.components.push_back({.id = id, .type = type, .name = name});
    return id;
  }
  void attribute(const std::string& id, const std::string& unit, ValueType type, std::string text) {
    model_.components.back().attributes.push_back({id, unit, type, std::move(text)});
  }
  void length(const std::string& id, double mm) { attribute(id, "mm", ValueType::Number, number_text(mm)); }
  void number(const std::string& id, double value) { attribute(id, "none", ValueType::Number, number_text(value)); }
  void word(const std::string& id, const std::string& value) { attribute(id, "none", ValueType::Word, value); }
  void flag(const std::string& id, bool value) { attribute(id, "none", ValueType::Boolean, value ? "true" : "false"); }
  void angle(const std::string& id, double rad) {
    attribute(id, before("1.4") ? "\xc2\xb0" : "deg", ValueType::Number, number_text(rad / units::deg));
  }
  void torque(const std::string& id, double newton_mm) { attribute(id, "N m", ValueType::Number, number_text(newton_mm / units::newton_metre)); }
  void lengths(const std::string& id, const std::vector<double>& mm) {
    Attribute array{.id = id, .unit = "mm", .type = ValueType::NumberArray};
    for (const double value : mm) array.array.push_back(number_text(value));
    model_.components.back().attributes.push_back(std::move(array));
  }
  void relate(const std::string& type, std::vector<Reference> refs, std::optional<int> order = {}) {
    const int id = static_cast<int>(model_.relations.size()) + 1;
    model_.relations.push_back({.id = id, .type = type, .order = order, .refs = std::move(refs)});
  }

  Model& model() { return model_; }

 private:
  Model model_;
  std::string version_;
};

}  // namespace flankwright::studies::rexs
