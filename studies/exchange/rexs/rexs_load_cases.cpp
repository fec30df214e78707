#include "studies/exchange/rexs/rexs_load_cases.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/base/units.hpp"

namespace flankwright::studies::rexs {

namespace {

std::string newton_metres(double torque) { return number_text(torque / units::newton_metre); }
std::string micrometres(double length) { return fmt::format("{:.4g}", length / units::um); }

}  // namespace

LoadCases::LoadCases(Reading& reading, const StageParts& parts, std::vector<ImportedTorque> torques, std::optional<double> hours)
    : reading_(reading), torques_(std::move(torques)), total_(total_hours(reading)) {
  for (const ImportedTorque& torque : torques_) operations_.push_back(read_operation(Condition(reading, torque.load_case), parts));
  if (hours) total_ = Taken{*hours, "--hours"};
  check_shares();
}

const std::optional<Taken>& LoadCases::temperature() const {
  const auto index = static_cast<std::size_t>(&reference() - torques_.data());
  return operations_[index].temperature;
}

void LoadCases::check_shares() {
  double sum = 0.0;
  for (const OperatingCondition& operation : operations_) sum += operation.share ? operation.share->value : 0.0;
  constexpr double rounded = 1e-3;  // shares of all cases exceed 1 by at most this: they come rounded
  if (sum > 1.0 + rounded) reading_.warn(fmt::format("the shares of time of the load cases add up to {:.6g} %, more than all the time", 100.0 * sum));
}

std::vector<LoadCases::Case> LoadCases::loaded(const std::string& one_sided) {
  std::vector<Case> cases;
  if (!(reference().torque > 0.0)) return cases;
  for (std::size_t i = 0; i < torques_.size(); ++i) {
    const ImportedTorque& torque = torques_[i];
    if (!(torque.torque > 0.0)) {
      reading_.warn(torque.name + ": left out, the file gives no torque on the pinion");
    } else if (torque.flank != reference().flank && !one_sided.empty()) {
      reading_.warn(fmt::format("{}: left out, its {:.6g} N m load the {} flank, and {} allows the {} flank alone: analyse it in a study of its own",
                                torque.name, torque.torque / units::newton_metre, name_of(torque.flank), one_sided, name_of(reference().flank)));
    } else {
      cases.push_back({.torque = &torque, .operation = &operations_[i]});
    }
  }
  return cases;
}

void LoadCases::settle_times(std::vector<Case>& cases) {
  if (cases.empty()) return;
  const bool is_alone = reading_.model().load_cases.empty();
  for (Case& c : cases) {
    const OperatingCondition& operation = *c.operation;
    if (operation.hours)
      c.hours = operation.hours->value;
    else if (operation.share && total_)
      c.hours = operation.share->value * total_->value;
    else if (is_alone && total_)
      c.hours = total_->value;
    c.weight = operation.share ? operation.share->value : c.hours;
  }
  const auto has_hours = [](const Case& c) { return !std::isnan(c.hours); };
  const auto has_share = [](const Case& c) { return c.operation->share.has_value(); };
  if (std::ranges::all_of(cases, has_hours)) {
    for (Case& c : cases) c.weight = std::ranges::all_of(cases, has_share) ? c.weight : c.hours;
  } else if (!std::ranges::all_of(cases, has_share)) {
    const bool some = std::ranges::any_of(cases, [](const Case& c) { return !std::isnan(c.weight); });
    for (Case& c : cases) {
      if (some && std::isnan(c.weight))
        reading_.warn(c.torque->name + ": the file does not say how long it lasts, so all load cases have the same weight");
    }
    for (Case& c : cases) c.weight = c.hours = not_given;
    return;
  }
  if (std::ranges::none_of(cases, [](const Case& c) { return c.weight > 0.0; })) {
    if (!is_alone) reading_.warn("the load cases take no time by the file, so all of them have the same weight");
    for (Case& c : cases) c.weight = c.hours = not_given;
    return;
  }
  std::erase_if(cases, [this](const Case& c) {
    if (c.weight > 0.0) return false;
    reading_.warn(fmt::format("{}: left out, its {:.6g} N m take 0 % of the time: analyse it in a study of its own", c.torque->name,
                              c.torque->torque / units::newton_metre));
    return true;
  });
}

bool LoadCases::are_spectrum(const std::vector<Case>& cases) const {
  return std::ranges::all_of(cases, [this](const Case& c) { return c.hours > 0.0 && c.operation->speed && c.torque->flank == reference().flank; });
}

void LoadCases::write_spectrum(const std::vector<Case>& cases, StudyText& text) const {
  const Case& first = cases.front();
  const std::string time = first.operation->hours   ? first.operation->hours->source
                           : first.operation->share ? first.operation->share->source + " of " + total_->source
                                                    : total_->source;
  text.comment(fmt::format("Torque: {}; speed: {}; hours: {}{}.", first.torque->source, first.operation->speed->source, time,
                           first.operation->temperature ? "; temperature: " + first.operation->temperature->source : ""));
  std::string list = "[";
  for (const Case& c : cases) {
    list += fmt::format("\n  {{ torque = {}, speed = {}, hours = {}", newton_metres(c.torque->torque), number_text(c.operation->speed->value),
                        number_text(c.hours));
    if (c.operation->temperature) list += ", temperature = " + number_text(c.operation->temperature->value);
    if (c.misalignment != 0.0) list += ", mesh_misalignment = " + micrometres(c.misalignment);
    list += " }," + (c.torque->name.empty() ? "" : "  # " + c.torque->name);
  }
  text.key("spectrum", list + "\n]");
}

void LoadCases::write_scenes(const std::vector<Case>& cases, StudyText& text) {
  const Case& front = cases.front();
  const bool all_turn = std::ranges::all_of(cases, [](const Case& c) { return c.operation->speed.has_value(); });
  text.key("torque", newton_metres(front.torque->torque), front.torque->source);
  if (all_turn) text.key("speed", number_text(front.operation->speed->value), front.operation->speed->source);
  if (cases.size() == 1) return;
  const bool lacks_hours = all_turn && std::ranges::all_of(cases, [this](const Case& c) {
                             return c.weight > 0.0 && std::isnan(c.hours) && c.torque->flank == reference().flank;
                           });
  if (lacks_hours) {
    text.comment("The file has shares of time, but no operating_time: they are weights of scenes. With --hours, the life in hours, import makes a");
    text.comment("load spectrum of them.");
  }
  for (const Case& c : cases) {
    const ImportedTorque& torque = *c.torque;
    text.scene();
    text.key("name", quoted(torque.name));
    if (torque.flank != reference().flank) text.key("working_flank", quoted(name_of(torque.flank)), torque.flank_source);
    text.key("load.torque", newton_metres(torque.torque), torque.source);
    if (c.operation->speed) text.key("load.speed", number_text(c.operation->speed->value), c.operation->speed->source);
    if (c.weight > 0.0) text.key("weight", number_text(c.weight), (c.operation->share ? c.operation->share : c.operation->hours)->source);
    if (c.misalignment != 0.0) {
      text.key("misalignment.mesh_misalignment", micrometres(c.misalignment),
               "by its loads from outside, beside those of " + reference().name + " scaled with the torque");
    }
    const std::optional<Taken>&own = c.operation->temperature, &taken = temperature();
    if (own && taken && !agree(own->value, taken->value)) {
      reading_.warn(fmt::format("{}: the {:.6g} deg C of its oil are not taken, scenes have one temperature, the {:.6g} deg C of {}", torque.name,
                                own->value, taken->value, reference().name));
    }
  }
}

void LoadCases::write(const std::string& one_sided, const std::map<const LoadCase*, double>& misalignment, StudyText& text) {
  std::vector<Case> cases = loaded(one_sided);
  settle_times(cases);
  for (Case& c : cases) {
    const auto found = misalignment.find(c.torque->load_case);
    if (found != misalignment.end()) c.misalignment = found->second;
  }
  text.table("load");
  if (cases.empty()) {
    text.key("torque", "0", "the file does not give the torque on the pinion");
  } else if (are_spectrum(cases)) {
    write_spectrum(cases, text);
  } else {
    write_scenes(cases, text);
  }
}

}  // namespace flankwright::studies::rexs
