#include <catch2/catch.hpp>
#include <string>

#include "core/flank/modifications/modification.hpp"
#include "studies/study_file/study_file.hpp"
#include "studies/study_file/study_schema.hpp"
#include "studies/study_file/sweep_value.hpp"
#include "tests/studies/study_texts.hpp"
#include "studies/tasks/optimise/optimise_table.hpp"

namespace flankwright::studies {
namespace {

using study_texts::read;
using study_texts::small_study;

/// A number that every parameter may have, in the unit of its key.
constexpr double value_outside = 0.5;

/// "tip_relief.height = 0.5", and what the key needs beside it.
std::string with_value(const ModificationDescriptor& d) {
  std::string text = std::string(d.key) + " = 0.5\n";
  if (!d.extent.empty()) text += std::string(d.extent) + " = 0.7\n";
  return text;
}

}  // namespace

TEST_CASE("Every modification parameter is read from a study file, in the unit of its kind", "[studies][study-file][modification]") {
  for (const ModificationDescriptor& d : modification_parameters) {
    for (const std::string gear : {"pinion", "wheel"}) {
      CAPTURE(gear, std::string(d.key));
      const Study study = read("[" + gear + ".modification]\n" + with_value(d));
      const Modification& changed = gear == "pinion" ? study.modification.pinion : study.modification.wheel;
      const Modification& other = gear == "pinion" ? study.modification.wheel : study.modification.pinion;
      CHECK(d.get(changed) * outside_factor(d.kind) == Approx(value_outside).epsilon(1e-14));
      CHECK((other == Modification{}));
      const SchemaKey& key = *study_keys().at(gear + ".modification." + std::string(d.key));
      CHECK(default_unit(key.quantity) == unit_of(d.kind));
      CHECK(key.meaning == d.meaning);
      CHECK(is_sweepable(key));
    }
  }
}

TEST_CASE("Every modification's choice is read from a study file", "[studies][study-file][modification]") {
  for (const ModificationChoice& c : modification_choices) {
    CAPTURE(std::string(c.key));
    const auto with_word = [&](std::string_view word) {
      return read("[wheel.modification]\n" + std::string(c.key) + " = \"" + std::string(word) + "\"\n").modification.wheel;
    };
    CHECK((with_word(c.words[0]) == Modification{}));
    CHECK((with_word(c.words[1]) != Modification{}));
  }
}

TEST_CASE("Every modification parameter may be a design variable, in the unit of its kind", "[studies][study-file][modification]") {
  for (const ModificationDescriptor& d : modification_parameters) {
    CAPTURE(std::string(d.key));
    std::string beside = with_value(d);
    for (const ModificationDescriptor& amount : modification_parameters) {
      if (amount.extent == d.key) beside = with_value(amount);  // an extent is varied with an amount beside it
    }
    const std::string path = "pinion.modification." + std::string(d.key);
    const Study study = parse_study("task = \"optimise\"\n" + small_study + "[load]\ntorque = 100\n[pinion.modification]\n" + beside +
                                        "[optimise.variables]\n\"" + path + "\" = [0.25, 0.7]\n",
                                    "small.toml");
    REQUIRE(study.table<OptimiseTable>().variables.size() == 1);
    const DesignVariable& v = study.table<OptimiseTable>().variables.front();
    CHECK(v.path == path);
    CHECK(v.parameter == d.parameter);
    CHECK(v.upper * v.outside_factor() == Approx(0.7).epsilon(1e-14));
    CHECK(std::string(v.unit()) == unit_of(d.kind));
  }
}

}  // namespace flankwright::studies
