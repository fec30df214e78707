#include <catch2/catch.hpp>
#include <cmath>
#include <string>

#include "core/flank/natural_twist.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/analysis/study_notes.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using namespace flankwright::studies::study_texts;
using Catch::Contains;

namespace {

const std::vector<Override> generated{{"pinion.process", "generating_grinding"}};

double number(const Json& results, const std::string& name) { return results["loaded"][1]["summary"][name].get<double>(); }

const Json& effect(const Json& results, const std::string& name) {
  for (const Json& one : results["effects"]) {
    if (one["name"] == name) return one;
  }
  FAIL("no effect " << name);
  return results["effects"];
}

std::string notes_of(const std::string& text, const std::vector<Override>& overrides = {}) {
  const Study study = parse_study(text, "study", overrides);
  std::string all;
  for (const std::string& note : study_notes(study, make_gear_pair(study.pair))) all += note + "\n";
  return all;
}

}  // namespace

TEST_CASE("A study says what finishes its flanks", "[studies][grinding]") {
  const Study given = parse_study(small::analysis(), "study", {});
  CHECK(given.modification.pinion.process == GrindingProcess{});
  const Study study = parse_study(small::analysis(), "study",
                                  {{"pinion.process", "form_grinding"},
                                   {"pinion.twist_compensation", "0.25"},
                                   {"pinion.grinding_wheel_diameter", "0.2 m"},
                                   {"wheel.process", "topological"}});
  CHECK(study.modification.pinion.process == GrindingProcess{GrindingKind::FormGrinding, 0.25, 200.0});
  CHECK(study.modification.wheel.process.kind == GrindingKind::Topological);
  const Json used = results_of(small::analysis(), {{"pinion.process", "form_grinding"}, {"fidelity.compliance", "rigid"}})["used"]["pair"];
  CHECK(used["pinion"]["process"] == Json({{"kind", "form_grinding"}, {"twist_compensation", 0.0}, {"grinding_wheel_diameter_mm", 300.0}}));
  CHECK(used["wheel"]["process"] == Json({{"kind", "none"}}));
}

TEST_CASE("Bad words and numbers of a process are refused", "[studies][grinding][input]") {
  CHECK_THAT(problem_of("[pinion.error]\n[wheel.error]\n", {{"pinion.process", "hobbing"}}).allowed, Contains("generating_grinding"));
  CHECK(problem_of("", {{"wheel.twist_compensation", "1.1"}}).key == "wheel.twist_compensation");
  CHECK(problem_of("", {{"wheel.grinding_wheel_diameter", "0"}}).key == "wheel.grinding_wheel_diameter");
  // A wheel of a radius below the depth of a tooth would have its axis within the gear.
  CHECK_THAT(problem_of("", {{"pinion.process", "form_grinding"}, {"pinion.grinding_wheel_diameter", "2"}}).allowed,
             Contains("twice the depth of a tooth"));
}

TEST_CASE("Without a process a note says how much grinding would twist the lead", "[studies][grinding]") {
  Study study = parse_study(small::analysis(), "study", {});
  const GearPair pair = make_gear_pair(study.pair);
  study.modification.pinion.process.kind = GrindingKind::GeneratingGrinding;
  const std::string twist = std::to_string(natural_twist(pair, Member::Pinion, study.modification.pinion) / units::um).substr(0, 4);
  CHECK_THAT(notes_of(small::analysis()), Contains("generating grinding would twist it by " + twist + " um"));
  CHECK_THAT(notes_of(small::optimisation()), Contains("generating grinding would twist 1 um of lead crowning by"));
  for (const std::string word : {"generating_grinding", "form_grinding", "topological"}) {
    CHECK_THAT(notes_of(small::analysis(), {{"pinion.process", word}}), !Contains("would twist"));
  }
  CHECK_THAT(notes_of(small::analysis(), {{"pair.helix_angle", "0"}}), !Contains("would twist"));
  CHECK_THAT(notes_of(small::analysis(), {{"pinion.modification.lead_crowning", "0"}}), !Contains("would twist"));
  CHECK_THAT(notes_of(small::analysis(), {{"pinion.process", "topological"}, {"pinion.twist_compensation", "0.5"}}),
             Contains("pinion.twist_compensation is not used"));
}

TEST_CASE("A lead too steep for the tool to follow is said, with what it takes more", "[studies][grinding]") {
  const auto relief = [](const char* amount) {
    return std::vector<Override>{generated.front(), {"pinion.modification.end_relief", std::string("{ amount = ") + amount + ", length = 4 }"}};
  };
  // 0.4 m (12 um / 4 mm)^2 / 2 and 0.4 m (4 um / 4 mm)^2 / 2, and the crowning's slope beside it.
  CHECK_THAT(notes_of(small::analysis(), relief("12")), Contains("um/mm: a grinding tool of usual size removes up to 2"));
  CHECK_THAT(notes_of(small::analysis(), relief("4")), !Contains("of usual size"));
  CHECK_THAT(notes_of(small::analysis(), {relief("12").back()}), !Contains("of usual size"));
}

TEST_CASE("The lead of the design found is looked at as that of the design given", "[studies][grinding][optimise]") {
  const auto notes_after = [](const char* slopes) {
    std::string all;
    const Json results = results_of(small::optimisation(), {generated.front(), {"optimise.variables.pinion.modification.lead_slope", slopes}});
    for (const Json& note : results["notes"]) all += note.get<std::string>() + "\n";
    return all;
  };
  CHECK_THAT(notes_after("[150, 151]"), Contains("of the design found, the pinion's lead has a slope of"));
  CHECK_THAT(notes_after("[0, 1]"), !Contains("of usual size"));
}

TEST_CASE("The natural twist is in loads, topography and effects, and off it is in none", "[studies][grinding]") {
  const Json none = results_of(small::analysis()), ground = results_of(small::analysis(), generated);
  const Study study = parse_study(small::analysis(), "study", generated);
  const GearPair pair = make_gear_pair(study.pair);
  CHECK(std::abs(number(ground, "peak_contact_stress_MPa") / number(none, "peak_contact_stress_MPa") - 1.0) > 1e-3);
  const Json& map = ground["modifications"][0];
  constexpr double round_off = 1e-12;
  CHECK(map["process"] == "generating_grinding");
  CHECK(map["natural_twist_um"].get<double>() ==
        Approx(natural_twist(pair, Member::Pinion, study.modification.pinion) / units::um).epsilon(round_off));
  CHECK(map["contact_shift_mm"].get<double>() ==
        Approx(contact_shift_over_profile(pair, Member::Pinion, study.modification.pinion.process)).epsilon(round_off));
  // The map is the sum of both: its corners have the twist.
  const auto twist_of = [](const Json& rows) {
    const auto at = [&](std::size_t radius, std::size_t z) { return rows[radius][z].get<double>(); };
    const std::size_t r = rows.size() - 1, z = rows[0].size() - 1;
    return (at(r, z) - at(0, z)) - (at(r, 0) - at(0, 0));
  };
  CHECK(twist_of(map["removal_um"]) == Approx(map["natural_twist_um"].get<double>()).epsilon(1e-9));
  CHECK(std::abs(twist_of(none["modifications"][0]["removal_um"])) < 1e-9);
  CHECK(effect(ground, "natural_twist")["on"] == true);
  CHECK(effect(ground, "natural_twist")["estimate"]["share_percent"].get<double>() > 0.1);
  CHECK(effect(none, "natural_twist")["on"] == false);
  // A list without it leaves the lead as drawn, to the last bit.
  std::string list;
  for (const EffectDecision& decision : study_effects(study)) {
    if (decision.on && decision.name != "natural_twist" && decision.name != "unloaded_contact")
      list += (list.empty() ? "[\"" : ", \"") + decision.name + "\"";
  }
  const Json off = results_of(small::analysis(), {generated.front(), {"fidelity.effects", list + "]"}});
  CHECK(off["loaded"][1]["cycle"] == none["loaded"][1]["cycle"]);
  CHECK(off["modifications"] == none["modifications"]);
}

TEST_CASE("What a machine compensates, and a topological machine, grind as without a process", "[studies][grinding]") {
  const Json none = results_of(small::analysis());
  for (const std::vector<Override>& as_drawn :
       {std::vector<Override>{{"pinion.process", "topological"}}, {generated.front(), {"pinion.twist_compensation", "1"}}}) {
    const Json ground = results_of(small::analysis(), as_drawn);
    CHECK(ground["loaded"][1]["cycle"] == none["loaded"][1]["cycle"]);
    CHECK(ground["modifications"][0]["removal_um"] == none["modifications"][0]["removal_um"]);
  }
}

TEST_CASE("An optimisation that knows the process finds what an analysis of it confirms", "[studies][grinding][optimise]") {
  const Json found = results_of(small::optimisation(), generated)["optimise"];
  CHECK(found["status"] == "converged");
  std::vector<Override> design = generated;
  for (const auto& [key, value] : found["after"]["variables"].items()) design.emplace_back(key, value.dump());
  design.emplace_back("task", "analyse");
  std::string text = small::optimisation();
  text.erase(text.find("[optimise]"));
  const Json again = results_of(replaced(text, "task = \"optimise\"", ""), {design.begin(), design.end() - 1});
  double worst = 0.0;
  for (const Json& loaded : again["loaded"]) worst = std::max(worst, loaded["summary"]["peak_contact_stress_MPa"].get<double>());
  constexpr double written_digits = 1e-9, positions = 1e-6;  // the same analysis, at the same positions
  CHECK(worst == Approx(found["after"]["objective"].get<double>()).epsilon(written_digits + positions));
}
