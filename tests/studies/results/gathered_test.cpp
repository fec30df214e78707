#include <catch2/catch.hpp>

#include "core/base/error.hpp"
#include "studies/results/gathered.hpp"

namespace flankwright::studies {

using Catch::Contains;

TEST_CASE("A name gathers what every entry of a list has, and an index picks one", "[studies]") {
  const Json results{{"loaded", {{{"summary", {{"te_mean_um", 1.5}}}}, {{"summary", {{"te_mean_um", 2.5}, {"edge", 3}}}}}},
                     {"optimise", {{"after", {{"variables", {{"pinion.modification.lead_crowning", 7.0}}}}}}}};
  CHECK(gathered(results, "loaded.summary.te_mean_um") == Json::array({1.5, 2.5}));
  CHECK(gathered(results, "loaded.1.summary.te_mean_um") == 2.5);
  CHECK(gathered(results, "loaded.summary.edge") == Json::array({nullptr, 3}));
  CHECK(gathered(results, "optimise.after.variables.pinion.modification.lead_crowning") == 7.0);  // a name with dots in it
  CHECK_THROWS_WITH(gathered(results, "loaded.summary.te_meen_um"), Contains("did you mean loaded.summary.te_mean_um?"));
  for (const char* wrong : {"loaded.7.summary", "loaded.summary.te_mean_um.x", "nothing"}) CHECK_THROWS_AS(gathered(results, wrong), InvalidInput);
}

}  // namespace flankwright::studies
