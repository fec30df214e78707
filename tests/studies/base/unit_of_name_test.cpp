#include <catch2/catch.hpp>
#include <utility>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/base/unit_of_name.hpp"

namespace flankwright::studies {

TEST_CASE("The end of a name says the unit that the table of quantities has", "[studies]") {
  for (const CycleEntry& entry : cycle_entries()) {
    const std::string unit(entry.quantity->unit.empty() ? "-" : entry.quantity->unit);
    CAPTURE(entry.key());
    CHECK(unit_of_name(entry.key()) == unit);
    CHECK(unit_of_name(entry.quantity->key) == unit);
    CHECK(unit_of_name(std::string(entry.quantity->key) + "_error") == unit);
    CHECK(unit_of_name("loaded.0.summary." + std::string(entry.quantity->key) + ".3") == unit);
  }
}

TEST_CASE("Names of life, unit and shafts say their units", "[studies]") {
  using Row = std::pair<const char*, const char*>;
  for (const auto& [name, unit] : {Row{"life.cases.0.loss_power_W", "W"}, Row{"life.cases.0.speed_rpm", "rpm"}, Row{"life.signal.idle_hours", "h"},
                                   Row{"life.cases.0.contact_temperature_degC_error", "degC"}, Row{"loaded.0.shafts.0.pinion.turn_x_urad", "urad"},
                                   Row{"used.unit.shafts.0.bearings.0.tilting_stiffness_Nm_per_rad", "N·m/rad"},
                                   Row{"optimise.assessment.search.milliseconds_per_cycle", "ms"}}) {
    CAPTURE(name);
    CHECK(unit_of_name(name) == unit);
  }
}

TEST_CASE("A name without a unit is that of a plain number", "[studies]") {
  for (const char* name : {"", "0", ".1", "teeth", "load_factor", "title", "geometry.pinion.teeth"}) CHECK(unit_of_name(name) == "-");
  CHECK(unit_of_name("wanted_arcsec_per_deg2") == "arcsec/deg^2");
}

}  // namespace flankwright::studies
