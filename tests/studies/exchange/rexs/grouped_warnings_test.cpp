#include "studies/exchange/rexs/grouped_warnings.hpp"

#include <catch2/catch.hpp>

namespace flankwright::studies::rexs {
namespace {

using Texts = std::vector<std::string>;

}  // namespace

TEST_CASE("What a REXS import says of several components is said once, with all of their names", "[studies][rexs][import]") {
  const Texts warnings{"concept_bearing 27: rigid", "the unit around the stage: not taken, shaft 4 has no bearings",
                       "rolling_bearing 24: rigid", "concept_bearing 28: rigid",
                       "concept_bearing 28: loose", "load case 2: scaled",
                       "load case 3: scaled",       "cylindrical_gear 7 tip_diameter = 1 mm: not taken"};
  CHECK(grouped_by_component(warnings) == Texts{"concept_bearing 27, 28, rolling_bearing 24: rigid",
                                                "the unit around the stage: not taken, shaft 4 has no bearings", "concept_bearing 28: loose",
                                                "load case 2, 3: scaled", "cylindrical_gear 7 tip_diameter = 1 mm: not taken"});
  CHECK(grouped_by_component({}).empty());
}

TEST_CASE("What a REXS import says of all stages of a unit is said once", "[studies][rexs][import][unit]") {
  CHECK(grouped_by_stage({{1, {"shaft 4: loose", "lubricant 9: thin"}}, {3, {"lubricant 9: thin", "shaft 5: loose"}}}) ==
        Texts{"stage 1: shaft 4: loose", "lubricant 9: thin", "stage 3: shaft 5: loose"});
  CHECK(grouped_by_stage({{1, {"a"}}, {2, {"a", "b"}}, {3, {"b"}}}) == Texts{"stage 1, 2: a", "stage 2, 3: b"});
}

}  // namespace flankwright::studies::rexs
