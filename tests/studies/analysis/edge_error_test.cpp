#include <catch2/catch.hpp>
#include <cmath>

#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/studies/study_texts.hpp"

using namespace flankwright;
using namespace flankwright::studies;
using study_texts::results_of;

namespace {

/// A misaligned spur pair with little relief: its tip edges carry a short contact that half the intervals hardly meet.
const std::string on_its_edges = "task = \"analyse\"\n" + small::spur_pair() + R"(
[pinion.modification]
tip_relief = { amount = 6, height = 1.0 }
lead_crowning = 4
[wheel.modification]
tip_relief = { amount = 6, height = 1.0 }
[misalignment]
mesh_misalignment = 8
[load]
torque = [60, 100, 200]
[fidelity]
effect_sizes = "off"
compliance = "thin_slice"
)";

}  // namespace

TEST_CASE("An analysis knows the load on a tip edge to within 2 per cent of the whole, and the error it states holds", "[studies][analysis][edge]") {
  const Json shown = results_of(on_its_edges);
  const Json finer = results_of(on_its_edges, {{"fidelity.quadrature", "{ rule = \"graded\", intervals = 48 }"}, {"cycle.positions", "128"}});
  REQUIRE(shown.at("loaded").size() == 3);
  for (std::size_t i = 0; i < 3; ++i) {
    const Json &ours = shown.at("loaded")[i].at("summary"), &theirs = finer.at("loaded")[i].at("summary");
    const double share = ours.at("tip_edge_share"), error = ours.at("tip_edge_share_error");
    CAPTURE(i, share, error);
    CHECK(share > 0.03);
    CHECK(error < 0.02);  // twice the accuracy that an analysis is refined for
    CHECK(std::abs(share - theirs.at("tip_edge_share").get<double>()) <= error + theirs.at("tip_edge_share_error").get<double>());
  }
}

TEST_CASE("Edges of the same flanks are reached at the same torque whatever the load beyond", "[studies][edge]") {
  const Json results = results_of(on_its_edges);
  const auto start = [](const Json& loaded) { return loaded.at("summary").at("edge_contact").at("begins_at_torque_Nm").get<double>(); };
  const double torque = start(results.at("loaded")[0]);
  CHECK(torque < 60.0);
  for (const Json& loaded : results.at("loaded")) CHECK(start(loaded) == torque);
  // Alone, the largest torque finds it to two thousandths of itself.
  const Json alone = results_of(on_its_edges, {{"load.torque", "200"}});
  CHECK(start(alone.at("loaded")[0]) == Approx(torque).margin(2.0 * 2e-3 * 200.0));
}

TEST_CASE("The torque at which an edge is reached is that of many positions, whichever gear's edge comes first", "[studies][edge]") {
  // At few positions the wheel's edge seems to come first; the pinion's is reached earlier, between two of them.
  const auto start = [&](const char* positions) {
    const std::vector<Override> wider{{"pinion.face_width", "30"}, {"wheel.face_width", "32"},     {"wheel.modification.profile_slope", "3"},
                                      {"load.torque", "300"},      {"cycle.peaks", "\"sampled\""}, {"cycle.positions", positions}};
    return run_study(parse_study(small::tilted_spur_pair(), "spur.toml", wider)).loaded.at(0).edge_contact.value();
  };
  const EdgeContactStart few = start("32"), many = start("256");
  CHECK(few.gear == Member::Pinion);
  CHECK(many.gear == Member::Pinion);
  constexpr double sought = 2e-3 * 300e3;  // each to so much of the torque
  CHECK(std::abs(few.torque - many.torque) <= 2.0 * sought);
}
