#include <catch2/catch.hpp>
#include <set>
#include <string>

#include "core/contact/gap/misalignment_gap.hpp"
#include "core/flank/modifications/modification.hpp"
#include "optimize/design/outputs/design_output.hpp"
#include "studies/base/plain_names.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

bool reads_like_a_key(const std::string& name) {
  return name.find('.') != std::string::npos || name.find(" modification") != std::string::npos || name.find("amount") != std::string::npos;
}

}  // namespace

TEST_CASE("Every modification, misalignment and output has a name that a person writes", "[studies][report]") {
  std::set<std::string> known;
  for (const PlainName& name : plain_names()) {
    CAPTURE(name.key, name.name);
    CHECK(known.insert(name.key).second);
    CHECK_FALSE(reads_like_a_key(name.name));
    CHECK(plain_name(name.key) == name.name);
  }
  for_each_modification_key([&](const auto& row) {
    for (const std::string gear : {"pinion", "wheel"}) CHECK(known.count(gear + ".modification." + std::string(row.key)) == 1);
  });
  for (const NamedMisalignmentParameter& parameter : misalignment_parameters) CHECK(known.count("misalignment." + std::string(parameter.name)) == 1);
  for (const std::string& output : term_names()) CHECK(known.count(output) == 1);
}

TEST_CASE("The remark on a relief is beside its amount", "[studies][report][modification]") {
  // The table of what to grind leaves out the extent and the choices of a relief that is none: it looks for "amount" beside them.
  std::set<std::string> amounts;
  for (const ModificationDescriptor& d : modification_parameters) {
    if (d.extent.empty()) continue;
    const std::string relief(d.key.substr(0, d.key.find('.')));
    CAPTURE(relief);
    CHECK(d.key == relief + ".amount");
    CHECK((d.extent == relief + ".height" || d.extent == relief + ".length"));
    amounts.insert(relief);
  }
  for (const ModificationChoice& c : modification_choices) CHECK(amounts.count(std::string(c.key.substr(0, c.key.find(".shape")))) == 1);
}

TEST_CASE("Different modifications have different names", "[studies][report]") {
  std::set<std::string> names;
  std::size_t modifications = 0;
  for (const PlainName& name : plain_names()) {
    if (name.key.find(".modification.") == std::string::npos) continue;
    names.insert(name.name);
    ++modifications;
  }
  CHECK(names.size() == modifications);
}

TEST_CASE("Keys become words, alone, in sums and where they are not known", "[studies][report]") {
  CHECK(plain_name("pinion.modification.lead_crowning") == "pinion lead crowning");
  CHECK(plain_name("wheel.modification.tip_relief.amount") == "wheel tip relief");
  CHECK(plain_name("wheel.modification.tip_relief.height") == "wheel tip relief height");
  CHECK(plain_name("te_harmonic_1") == "first harmonic of TE");
  CHECK(plain_name("2 * pinion.modification.lead_crowning - 0.5 * wheel.modification.twist") == "2 * pinion lead crowning - 0.5 * wheel twist");
  CHECK(plain_name("peak_contact_stress + te_peak_to_peak") == "peak contact stress + peak-to-peak TE");
  CHECK(plain_name("shafts.pinion.outer_diameter") == "shafts pinion outer diameter");
  CHECK(plain_name("").empty());
}
