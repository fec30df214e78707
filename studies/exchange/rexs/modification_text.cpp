#include "studies/exchange/rexs/modification_text.hpp"

#include <fmt/format.h>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

namespace {

std::string um_text(double mm) { return number_text(mm / units::um); }

std::string relief_text(const ProfileRelief& relief) {
  return fmt::format("{{ amount = {}, height = {}{} }}", um_text(relief.amount), difference_text(relief.height),
                     relief.shape == ReliefShape::Parabolic ? ", shape = \"parabolic\"" : "");
}

}  // namespace

void write_modification(const ImportedModification& imported, Member member, const std::string& grid_file, StudyText& text) {
  const Modification& m = imported.modification;
  const Remarks& remarks = imported.remarks;
  if (remarks.empty()) return;
  text.table(member == Member::Pinion ? "pinion.modification" : "wheel.modification");
  const auto key = [&](const std::string& name, const std::string& value) {
    if (remarks.contains(name)) text.key(name, value, remarks.at(name));
  };
  key("lead_crowning", um_text(m.lead_crowning));
  key("lead_slope", um_text(m.lead_slope));
  key("addendum_crowning", um_text(m.addendum_crowning));
  key("dedendum_crowning", um_text(m.dedendum_crowning));
  key("profile_slope", um_text(m.profile_slope));
  key("tip_relief", relief_text(m.tip_relief));
  key("root_relief", relief_text(m.root_relief));
  key("end_relief", fmt::format("{{ amount = {}, length = {} }}", um_text(m.end_relief.amount), number_text(m.end_relief.length)));
  key("triangular_tip_relief", relief_text(m.triangular_tip_relief));
  key("triangular_root_relief", relief_text(m.triangular_root_relief));
  key("twist", um_text(m.twist));
  key("grid", quoted(grid_file));
}

}  // namespace flankwright::studies::rexs
