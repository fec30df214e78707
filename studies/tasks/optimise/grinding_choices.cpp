#include "studies/tasks/optimise/grinding_choices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "optimize/design/search/design_log.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {

namespace {

constexpr const char* smallest_name = "optimise.grinding.smallest_amount";
constexpr const char* pairs_name = "optimise.grinding.not_together";

std::string key_of(Member member, ModificationParameter parameter) {
  return std::string(name_of(member)) + ".modification." + std::string(describe(parameter).key);
}

/// A value that a parameter is reported with.
double outside(ModificationParameter parameter, double value) { return value * outside_factor(describe(parameter).kind); }
const char* unit(ModificationParameter parameter) { return unit_of(describe(parameter).kind); }

/// Whether a variable or a tie sets a parameter.
bool is_varied(const OptimiseTable& optimise, Member member, ModificationParameter parameter) {
  const auto touches = [&](const DesignVariable& v) { return v.touches(member, parameter); };
  return std::ranges::any_of(optimise.variables, touches) || std::ranges::any_of(optimise.links, touches, &LinkingConstraint::linked);
}

/// Whether the search can hold a parameter at 0: variables and ties set it, and all of them reach 0.
bool can_be_zero(const OptimiseTable& optimise, Member member, ModificationParameter parameter) {
  const auto keeps_off = [&](const DesignVariable& v) { return v.touches(member, parameter) && (v.lower > 0.0 || v.upper < 0.0); };
  return is_varied(optimise, member, parameter) && std::ranges::none_of(optimise.variables, keeps_off) &&
         std::ranges::none_of(optimise.links, keeps_off, &LinkingConstraint::linked);
}

/// The key of an amount, which may be named with or without ".amount"; null where a text is none, which becomes a problem.
const SchemaKey* key_of_pair(StudyReading& reading, const Match& match, const toml::node* node) {
  const std::string name = node == nullptr ? std::string() : node->value_or(std::string());
  auto known = study_keys().find(name);
  if (known == study_keys().end()) known = study_keys().find(name + ".amount");
  const auto* parameter = known == study_keys().end() ? nullptr : std::get_if<ModificationParameter>(&known->second->store);
  if (parameter != nullptr && of_process(*parameter) == nullptr && describe(*parameter).kind != ParameterKind::Extent) return known->second;
  const std::string hint = known == study_keys().end() ? nearest_key_hint(study_keys(), name) : "";
  reading.refuse(match.position, match.path, node, "allowed is " + allowed_values(*match.key) + ", amounts and no heights or lengths" + hint);
  return nullptr;
}

void read_pair(StudyReading& reading, const Match& match, const toml::node& node) {
  OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const auto refuse = [&](const std::string& allowed) { reading.refuse(match.position, match.path, &node, allowed); };
  const toml::array* names = node.as_array();
  if (names == nullptr || names->size() != 2) return refuse("allowed is " + allowed_values(*match.key));
  const SchemaKey *one = key_of_pair(reading, match, names->get(0)), *other = key_of_pair(reading, match, names->get(1));
  if (one == nullptr || other == nullptr) return;
  if (one->member != other->member) return refuse("is of two gears: allowed are two modifications of one gear");
  const ExcludedPair pair{one->member, std::get<ModificationParameter>(one->store), std::get<ModificationParameter>(other->store)};
  if (DesignVariable{{}, pair.member, pair.one}.touches(pair.member, pair.other)) {
    return refuse("names the same modification twice: allowed are two that can be ground apart");
  }
  if (!can_be_zero(optimise, pair.member, pair.one) && !can_be_zero(optimise, pair.member, pair.other)) {
    return refuse("allowed is a pair of which optimise.variables can hold one at 0");
  }
  optimise.grindable.not_together.push_back(pair);
}

/// Every varied amount must be able to be 0 or the smallest.
void check_smallest(StudyReading& reading) {
  const OptimiseTable& optimise = reading.builder.study.table<OptimiseTable>();
  const double smallest = optimise.grindable.smallest;
  if (smallest == 0.0) return;
  if (optimise.largest_amount && smallest > *optimise.largest_amount) {
    return reading.refuse_key(smallest_name, "is above optimise.grinding.largest_amount: allowed is at most that");
  }
  const std::string reach = fmt::format("with {} = {:.4g} um allowed is a range that holds 0 or reaches that amount", smallest_name, in_um(smallest));
  const auto is_closed = [&](const DesignVariable& v) {
    return describe(v.parameter).kind == ParameterKind::Amount && (v.lower > 0.0 || v.upper < 0.0) && std::max(v.upper, -v.lower) < smallest;
  };
  for (const DesignVariable& v : optimise.variables) {
    if (is_closed(v)) reading.refuse_key("optimise.variables." + v.path, reach);
  }
  for (const LinkingConstraint& link : optimise.links) {
    if (describe(link.linked.parameter).kind != ParameterKind::Amount) continue;
    const std::string key = "optimise.ties." + link.linked.path;
    if (link.offset != 0.0) {
      reading.refuse_key(key, std::string("with ") + smallest_name + " a tied amount must be 0 with its variable: allowed is offset = 0");
    } else if (is_closed(link.linked)) {
      reading.refuse_key(key, reach);
    }
  }
}

const char* words_of(HeldAmount held) { return held == HeldAmount::AtZero ? "at zero" : held == HeldAmount::AtLeast ? "at least" : "at most"; }

/// What an alternative holds: "0", "at least 3 um", "without tip relief".
std::string alternative_in_words(const GrindingChoice& choice, const GrindingAlternative& tried) {
  const GrindingChoice::Amount& held = choice.amounts[tried.amount];
  if (choice.is_of_pair()) return "without " + std::string(describe(held.parameter).name);
  if (tried.held == HeldAmount::AtZero) return "0";
  return fmt::format("{} {:.4g} {}", words_of(tried.held), outside(held.parameter, tried.limit), unit(held.parameter));
}

std::string choice_in_words(const GrindingChoice& choice, const DesignTask& task, const std::string& statistic) {
  const auto amount = [&](const GrindingChoice::Amount& of) {
    return fmt::format("{}, {:.3g} {}", plain_name(key_of(of.member, of.parameter)), outside(of.parameter, of.found), unit(of.parameter));
  };
  // An amount that is large enough may have no step of its variable between itself and the next limit.
  const auto on_steps = [&](const GrindingChoice::Amount& of) { return std::abs(of.found) >= task.grindable.smallest ? " on its steps" : ""; };
  std::string words = choice.is_of_pair() ? fmt::format("{}, and {}, are not ground together", amount(choice.amounts[0]), amount(choice.amounts[1]))
                                          : fmt::format("{}, is below the smallest amount{}", amount(choice.amounts[0]), on_steps(choice.amounts[0]));
  // Of a list alternatives are judged by the last objective.
  const Objective judged = task.later_objectives.empty() ? task.combined_objective() : task.later_objectives.back();
  const std::string name = !statistic.empty() ? "a " + statistic + " of " : task.later_objectives.empty() ? "" : plain_name(judged.name()) + " ";
  for (std::size_t i = 0; i < choice.tried.size(); ++i) {
    const GrindingAlternative& tried = choice.tried[i];
    const std::string gives =
        std::isnan(tried.objective) ? "cannot be analysed" : fmt::format("gives {}{:.5g}{}", name, tried.objective, behind_number(judged.unit()));
    const bool breaks = tried.constraint_violation > DesignLog::tolerance;
    words += fmt::format("{} {} {}{}{}", i == 0 ? ":" : ",", alternative_in_words(choice, tried), gives,
                         breaks ? " and does not keep the constraints" : "", i == choice.taken ? " (taken)" : "");
  }
  return words;
}

}  // namespace

void read_grinding_choices(StudyReading& reading) {
  if (const Match* match = reading.find(pairs_name)) {
    const toml::array* pairs = match->node->as_array();
    if (pairs == nullptr || pairs->empty()) {
      reading.refuse(match->position, match->path, match->node, "allowed is " + allowed_values(*match->key));
    } else {
      for (const toml::node& pair : *pairs) read_pair(reading, *match, pair);
    }
  }
  check_smallest(reading);
}

Json grinding_choices_json(const DesignResult& design, const DesignTask& task, const std::string& statistic) {
  return list(design.choices, [&](const GrindingChoice& choice) -> Json {
    Json amounts = list(choice.amounts, [](const GrindingChoice::Amount& of) -> Json {
      return {{"key", key_of(of.member, of.parameter)}, {"found", outside(of.parameter, of.found)}, {"unit", unit(of.parameter)}};
    });
    Json tried = Json::array();
    for (std::size_t i = 0; i < choice.tried.size(); ++i) {
      const GrindingAlternative& of = choice.tried[i];
      const GrindingChoice::Amount& held = choice.amounts[of.amount];
      tried.push_back({{"key", key_of(held.member, held.parameter)},
                       {"held", words_of(of.held)},
                       {"limit", outside(held.parameter, of.limit)},
                       {"value", outside(held.parameter, of.value)},
                       {"objective", of.objective},
                       {"constraint_violation", of.constraint_violation},
                       {"taken", i == choice.taken}});
    }
    Json json{{"rule", choice.is_of_pair() ? "not_together" : "smallest_amount"},
              {"amounts", std::move(amounts)},
              {"tried", std::move(tried)},
              {"words", choice_in_words(choice, task, statistic)}};
    if (!statistic.empty()) json["statistic_in_words"] = statistic;
    return json;
  });
}

std::vector<std::string> grinding_choices_in_words(const DesignResult& design, const DesignTask& task, const std::string& statistic) {
  std::vector<std::string> sentences;
  for (const GrindingChoice& choice : design.choices) sentences.push_back(choice_in_words(choice, task, statistic));
  return sentences;
}

}  // namespace flankwright::studies
