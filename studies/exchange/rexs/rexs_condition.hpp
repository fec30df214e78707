#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "studies/exchange/rexs/rexs_reading.hpp"

namespace flankwright::studies::rexs {

/// One condition of a file: the model with what a load case changes.
class Condition {
 public:
  /// @param load_case  null: the model alone
  Condition(Reading& reading, const LoadCase* load_case) : reading_(&reading), load_case_(load_case) {}

  Reading& reading() const { return *reading_; }
  const LoadCase* load_case() const { return load_case_; }
  /// "load case 3"; empty: the model alone.
  std::string name() const;

  /// As Reading::number(): of the load case, else of the model.
  std::optional<Taken> number(const Component* component, std::string_view attribute, Dimension dimension) const;
  /// As Reading::word(): of the load case, else of the model.
  std::string word(const Component* component, std::string_view attribute) const;
  /// As Reading::word(), of the load case alone; empty for the model alone.
  std::string word_of_case(const Component* component, std::string_view attribute) const;

  /// Whether the load case has an attribute of a component.
  bool changes(const Component& component, std::string_view attribute) const;
  /// Whether the load case has something of an external load.
  bool changes_loads() const;

  /// Torque of an external load on its shaft about the shaft's u axis [N mm], with its sign: torque_around_u_axis, else power over rotational_speed of
  /// the shaft. What the load case says of the load replaces what the model says.
  /// @return  nullopt where it is 0 or not in the file
  std::optional<Taken> torque_of(const Component& load, const Component& shaft) const;

 private:
  /// What the load case changes of a component; null: nothing.
  const Component* varied(const Component& component) const;

  Reading* reading_;
  const LoadCase* load_case_;
};

/// One condition for each load case; a file without any has one.
std::vector<Condition> conditions_of(Reading& reading);

/// Whether torque enters or leaves a shaft at an external load: the load says so, or has a torque in some condition.
bool carries_torque(Reading& reading, const Component& load, const Component& shaft);

}  // namespace flankwright::studies::rexs
