#include "studies/exchange/rexs/rexs_load.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/rexs_torque_flow.hpp"

namespace flankwright::studies::rexs {

namespace {

int sign_of(double torque) { return torque > 0.0 ? 1 : torque < 0.0 ? -1 : 0; }

/// A flank as the stage's data name it, seen from the pinion's datum face; nothing where they do not.
std::optional<WorkingFlank> flank_of_word(const std::string& word, const StageParts& parts) {
  if (word != "left" && word != "right") return std::nullopt;
  return (word == "right") == parts[Member::Pinion].datum_at_low_z ? WorkingFlank::Right : WorkingFlank::Left;
}

/// A size of the torque on the pinion that the file states.
struct Statement {
  double torque{0.0};  ///< [N mm]
  std::string source{};
  bool of_case{false};  ///< by the load case, not by the model
};

std::string in_words(const Condition& condition) { return condition.name().empty() ? "" : condition.name() + ": "; }

/// The first by the load case, else the first by the model, that is not 0. Others of the same origin that contradict it are warned of.
Statement first_of(const Condition& condition, std::vector<Statement> statements) {
  std::erase_if(statements, [](const Statement& statement) { return statement.torque == 0.0; });
  if (statements.empty()) return {};
  std::ranges::stable_partition(statements, &Statement::of_case);
  const Statement& first = statements.front();
  for (const Statement& other : statements) {
    if (other.of_case != first.of_case || std::abs(other.torque - first.torque) <= largest_loss * std::max(other.torque, first.torque)) continue;
    condition.reading().warn(fmt::format("{}the torque on the pinion is {:.6g} N m by {}, but {:.6g} N m by {}: the first is taken",
                                         in_words(condition), first.torque / units::newton_metre, first.source, other.torque / units::newton_metre,
                                         other.source));
  }
  return first;
}

/// Size and signs. The flank only where the load case itself names it.
ImportedTorque torque_in(const Condition& condition, const StageParts& parts) {
  ImportedTorque found{.name = condition.name(), .load_case = condition.load_case()};
  std::vector<Statement> statements;
  // Of the stage's own data first: a gear of several stages says there what it takes in this one.
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const auto torque = condition.number(parts[m].data, "torque", Dimension::Torque);
    if (!torque) continue;
    found.signs.data[m] = sign_of(torque->value);
    const double share = m == Member::Pinion ? 1.0 : static_cast<double>(parts.teeth[0]) / parts.teeth[1];
    statements.push_back({std::abs(torque->value) * share, torque->source + (m == Member::Pinion ? "" : ", through the teeth"),
                          condition.changes(*parts[m].data, "torque")});
  }
  const Component& pinion = *parts[Member::Pinion].gear;
  const TorqueFlow flow(condition, u_axis(condition.reading(), pinion));
  if (const auto torque = flow.on(pinion, *parts.stage)) {
    found.signs.loads = sign_of(torque->torque);
    if (torque->has_size) statements.push_back({std::abs(torque->torque), torque->source, condition.changes_loads()});
  }
  const Statement taken = first_of(condition, std::move(statements));
  found.torque = taken.torque;
  found.source = taken.source;
  for (const std::string& contradiction : flow.contradictions()) condition.reading().warn(in_words(condition) + contradiction);
  const Component* data = parts[Member::Pinion].data;
  if (const auto flank = flank_of_word(condition.word_of_case(data, "loaded_tooth_flank"), parts)) {
    found.flank = *flank;
    found.flank_origin = FlankOrigin::Stated;
    found.flank_source = Reading::name_of(*data) + " loaded_tooth_flank of " + found.name;
  }
  return found;
}

/// The flank of the reference, where its load case does not name it.
void settle_reference(Reading& reading, const StageParts& parts, ImportedTorque& reference) {
  if (reference.flank_origin == FlankOrigin::Stated) return;
  const Component* data = parts[Member::Pinion].data;
  if (const auto flank = flank_of_word(reading.word(data, "loaded_tooth_flank"), parts)) {
    reference.flank = *flank;
    reference.flank_origin = FlankOrigin::Stated;
    reference.flank_source = Reading::name_of(*data) + " loaded_tooth_flank";
  } else if (reference.signs.loads != 0) {
    reference.flank = reference.signs.loads > 0 ? WorkingFlank::Right : WorkingFlank::Left;
    reference.flank_origin = FlankOrigin::Loads;
    reference.flank_source = "by the torques of external loads";
  } else {
    reference.flank = WorkingFlank::Right;
    reference.flank_source = "not in the file";
  }
}

/// The flank of another condition, where its load case does not name it.
void settle_flank(const ImportedTorque& reference, ImportedTorque& torque) {
  if (torque.flank_origin == FlankOrigin::Stated) return;
  const bool changes = torque.signs.are_opposite_to(reference.signs);
  torque.flank = changes ? opposite(reference.flank) : reference.flank;
  torque.flank_origin = reference.flank_origin;
  torque.flank_source = changes ? "its torque has the other sign than that of " + reference.name : reference.flank_source;
}

}  // namespace

bool TorqueSigns::are_opposite_to(const TorqueSigns& other) const {
  return data.pinion * other.data.pinion < 0 || data.wheel * other.data.wheel < 0 || loads * other.loads < 0;
}

const ImportedTorque& reference_of(const std::vector<ImportedTorque>& torques) {
  const auto loaded = std::ranges::find_if(torques, [](const ImportedTorque& torque) { return torque.torque > 0.0; });
  return loaded == torques.end() ? torques.front() : *loaded;
}

ImportedTorque read_torque(const Condition& condition, const StageParts& parts) {
  ImportedTorque torque = torque_in(condition, parts);
  settle_reference(condition.reading(), parts, torque);
  return torque;
}

std::vector<ImportedTorque> read_torques(Reading& reading, const StageParts& parts) {
  std::vector<ImportedTorque> torques;
  for (const Condition& condition : conditions_of(reading)) torques.push_back(torque_in(condition, parts));
  reading.word(parts[Member::Wheel].data, "loaded_tooth_flank");  // that of the pinion once more
  ImportedTorque reference = reference_of(torques);
  settle_reference(reading, parts, reference);
  for (ImportedTorque& torque : torques) {
    if (torque.load_case == reference.load_case) {
      torque = reference;
    } else {
      settle_flank(reference, torque);
    }
  }
  return torques;
}

}  // namespace flankwright::studies::rexs
