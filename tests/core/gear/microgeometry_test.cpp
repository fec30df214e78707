#include "core/gear/microgeometry.hpp"

#include <catch2/catch.hpp>
#include <set>
#include <string>

using namespace flankwright;

TEST_CASE("Every modification parameter is read back as set and leaves the others alone", "[core][gear]") {
  std::set<std::string> names;
  for (const NamedModificationParameter& changed : modification_parameters) {
    Modification m;
    double value = 1.0;
    for (const NamedModificationParameter& p : modification_parameters) set(m, p.parameter, value++);
    const Modification before = m;
    set(m, changed.parameter, -7.5);
    CHECK(get(m, changed.parameter) == -7.5);
    for (const NamedModificationParameter& other : modification_parameters) {
      const auto is_profile = [](ModificationParameter p) {
        return p == ModificationParameter::ProfileCrowning || p == ModificationParameter::AddendumCrowning ||
               p == ModificationParameter::DedendumCrowning;
      };
      if (other.parameter == changed.parameter || (is_profile(other.parameter) && is_profile(changed.parameter)))
        continue;
      CAPTURE(std::string(changed.name), std::string(other.name));
      CHECK(get(m, other.parameter) == get(before, other.parameter));
    }
    names.insert(std::string(changed.name));
  }
  CHECK(names.size() == modification_parameters.size());
}

TEST_CASE("Profile crowning stands for both halves and reads their mean", "[core][gear]") {
  Modification m;
  set(m, ModificationParameter::ProfileCrowning, 6.0);
  CHECK(m.addendum_crowning == 6.0);
  CHECK(m.dedendum_crowning == 6.0);
  set(m, ModificationParameter::AddendumCrowning, 2.0);
  CHECK(get(m, ModificationParameter::ProfileCrowning) == 4.0);
}
