#include <catch2/catch.hpp>

#include "studies/study_file/given_units.hpp"

using namespace flankwright::studies;

TEST_CASE("A bare number of a study is shown with the unit of its key", "[studies][results]") {
  CHECK(unit_of_given({"pair.normal_module", "3"}) == "mm");
  CHECK(unit_of_given({"load.torque", "[100, 200]"}) == "N·m");
  CHECK(unit_of_given({"pinion.modification.tip_relief.amount", "10"}) == "um");
  CHECK(unit_of_given({"scenes.1.misalignment.crossing", "2"}) == "arcmin");
  CHECK(unit_of_given({"load.spectrum.12.torque", "500"}) == "N·m");
  CHECK(unit_of_given({"unit.loads.0.force_x", "300"}) == "N");
  CHECK(unit_of_given({"pinion.shaft.bearings.1.axial_stiffness", "250"}) == "N/um");
  CHECK(unit_of_given({"optimise.variables.pinion.modification.lead_crowning", "[0, 30]"}) == "um");
  CHECK(unit_of_given({"optimise.variables.pinion.modification.tip_relief.height.range", "[1, 8]"}) == "mm");
  CHECK(unit_of_given({"sweep.parameters.load.torque.truncated_normal", "[300, 10, 250, 350]"}) == "N·m");
}

TEST_CASE("Values with their own unit, or without one, are shown without unit", "[studies][results]") {
  CHECK(unit_of_given({"misalignment.crossing", "\"3 arcsec\""}).empty());
  CHECK(unit_of_given({"pinion.teeth", "25"}).empty());
  CHECK(unit_of_given({"pinion.profile_shift", "0.2"}).empty());
  CHECK(unit_of_given({"sweep.parameters.pinion.error.helix_slope.iso_1328_class", "6"}).empty());
  CHECK(unit_of_given({"scenes.0.name", "\"aligned\""}).empty());
  CHECK(unit_of_given({"scenes.", "1"}).empty());
  CHECK(unit_of_given({"", ""}).empty());
}
