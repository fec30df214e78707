#include "studies/tasks/optimise/edge_advice.hpp"

#include <catch2/catch.hpp>

using namespace flankwright;
using namespace flankwright::studies;

namespace {

LoadedResult load_case(const std::string& design, double stress, double on_edge) {
  LoadedResult loaded;
  loaded.scene = "nominal";
  loaded.torque = 250e3;
  loaded.design = design;
  loaded.summary.peak_contact_stress = stress;
  loaded.summary.edge_stress = on_edge;
  return loaded;
}

ObjectiveTerm term(Output output) {
  ObjectiveTerm of;
  of.output = output;
  return of;
}

}  // namespace

TEST_CASE("A search without contact stress that loads an edge most is told what to ask for", "[studies][optimise]") {
  OptimiseTable asked;
  asked.objective = {term(Output::TePeakToPeak)};
  const std::vector<LoadedResult> on_edge{load_case("before", 1200.0, 0.0), load_case("after", 1300.0, 0.0), load_case("after", 2889.0, 2889.0)};
  const std::optional<std::string> advice = edge_advice(asked, on_edge);
  REQUIRE(advice.has_value());
  CHECK_THAT(*advice, Catch::Contains("2889 MPa") && Catch::Contains("250 N·m") && Catch::Contains("edge_stress"));

  SECTION("not where a flank has more, or the design before alone") {
    CHECK_FALSE(edge_advice(asked, {load_case("after", 1300.0, 900.0), load_case("after", 1100.0, 1100.0)}).has_value());
    CHECK_FALSE(edge_advice(asked, {load_case("before", 2889.0, 2889.0), load_case("after", 1300.0, 0.0)}).has_value());
  }
  SECTION("nor where an objective or a constraint has contact stress in it") {
    const Output output = GENERATE(Output::PeakContactStress, Output::EdgeStress, Output::ContactUtilisation);
    OptimiseTable by_objective = asked, by_constraint = asked;
    by_objective.objective.push_back(term(output));
    by_constraint.constraints.push_back({.output = term(output), .maximum = 3000.0});
    CHECK_FALSE(edge_advice(by_objective, on_edge).has_value());
    CHECK_FALSE(edge_advice(by_constraint, on_edge).has_value());
  }
}
