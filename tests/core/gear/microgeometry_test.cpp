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

TEST_CASE("A tooth's errors are those of all teeth and its own, lists going round the gear", "[core][gear]") {
  ManufacturingError error;
  error.helix_slope = 1.0;
  error.twist = -2.0;
  error.helix_slopes = {0.0, 0.5, -4.0};
  error.profile_slopes = {7.0, 8.0, 9.0};
  CHECK(tooth_error(error, 0).helix_slope == 1.0);
  CHECK(tooth_error(error, 2).helix_slope == -3.0);
  for (int tooth = -7; tooth < 7; ++tooth) {
    const ToothError here = tooth_error(error, tooth);
    CHECK(here.helix_slope == tooth_error(error, tooth + 3).helix_slope);
    CHECK(here.profile_slope == 7.0 + (tooth + 9) % 3);
    CHECK(here.twist == -2.0);
  }
}
