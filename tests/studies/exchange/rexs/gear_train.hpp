#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "studies/exchange/rexs/rexs_model.hpp"

/// REXS files of gear trains, put together for a test.
namespace flankwright::studies::gear_trains {

using Attributes = std::vector<rexs::Attribute>;

rexs::Attribute number(const std::string& id, double value, const std::string& unit = "none");
rexs::Attribute word(const std::string& id, const std::string& value);

/// Shafts and gears along x, with w axes along z. Components are numbered from 1, the casing; what adds one returns its id.
class GearTrain {
 public:
  explicit GearTrain(const std::string& version = "1.6");

  /// A shaft of 300 mm and constant diameter with bearings at 20 and 280 mm.
  int shaft(double y, double z);
  /// The same without sections and bearings, so that nothing describes how it bends.
  int bare_shaft(double y, double z);
  /// A shaft of 300 mm with bearings at these places.
  int shaft_on(double y, double z, const std::vector<double>& bearings);
  /// A gear that no shaft carries, see gear().
  int loose_gear(double at, int teeth, double module, std::optional<double> helix_deg);
  /// The unit that the parts belong to, whose times a load case states.
  int unit(const Attributes& attributes = {});
  int casing() const { return casing_; }
  /// An oil in the casing.
  int lubricant(const Attributes& attributes);
  /// Id of the component of a type that was added last.
  int last(const std::string& type) const;
  int load(int shaft, double at, const Attributes& attributes);
  /// Face widths are 40 mm.
  /// @param helix_deg  + is right-handed; nothing: not in the file
  int gear(int shaft, double at, int teeth, double module, std::optional<double> helix_deg, const Attributes& more = {});
  /// Two flanks with the same attributes.
  /// @param type  as the version of the format calls a flank
  void flanks(int gear, const std::string& type, const Attributes& attributes);
  void tool(int gear, const Attributes& attributes);
  int stage(int gear_1, int gear_2);
  /// What a stage says of one of its gears.
  int stage_data(int stage, int gear, const Attributes& attributes);
  /// Adds a load case, with the attributes that it changes by component.
  void load_case(const std::vector<std::pair<int, Attributes>>& changed);
  /// Adds or replaces an attribute.
  void set(int component, const rexs::Attribute& attribute);

  std::string text() const { return rexs::model_text(model_, rexs::Form::Xml); }

 private:
  int add(const std::string& type, const Attributes& attributes = {});
  void relate(const std::string& type, const std::vector<std::pair<int, std::string>>& roles);

  rexs::Model model_;
  int casing_{0};
};

/// Distance of the axes of two gears that touch at their reference circles [mm].
double reference_distance(int teeth_1, int teeth_2, double module, double helix_deg);

}  // namespace flankwright::studies::gear_trains
