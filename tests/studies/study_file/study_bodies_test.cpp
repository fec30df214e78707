#include "studies/study_file/study_bodies.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "core/gear/gear_pair.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/analysis/study_notes.hpp"
#include "studies/base/json_format.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/results/bodies_json.hpp"
#include "studies/results/results_json.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/command_line.hpp"

namespace flankwright::studies {
namespace {

using json = Json;

/// A narrow spur pair: small finite-element runs.
const std::string body_pair = R"([pair]
normal_module = 4
[pinion]
teeth = 17
profile_shift = 0.2
face_width = 10
[wheel]
teeth = 40
face_width = 10
[load]
torque = 60
[cycle]
positions = 4
peaks = "sampled"
[fidelity]
compliance = "fe"
effect_sizes = "off"
[wheel.body]
bore_diameter = 40
hold = "rigid_bore"
)";

const std::string web_text = "rim_thickness = 12\nweb_thickness = 3\nweb_offset = 2.5\nhub_diameter = 60\n";

Study read_bodies(const std::string& text, const std::vector<Override>& overrides = {}) { return parse_study(text, "body.toml", overrides); }

/// The first problem of a study; empty fields where it has none.
StudyProblem body_problem(const std::string& text, const std::vector<Override>& overrides = {}) {
  try {
    read_bodies(text, overrides);
  } catch (const StudyErrors& errors) {
    return errors.problems().front();
  }
  return {};
}

class BodyCache {
 public:
  BodyCache() { ::setenv("FLANKWRIGHT_CACHE", folder_.path().c_str(), 1); }
  ~BodyCache() { ::unsetenv("FLANKWRIGHT_CACHE"); }
  BodyCache(const BodyCache&) = delete;
  BodyCache& operator=(const BodyCache&) = delete;

 private:
  command_line::ScratchFolder folder_;
};

json run_bodies(const std::string& text, const std::vector<Override>& overrides = {}) {
  return json::parse(results_json(run_study(read_bodies(text, overrides))));
}

const json& source_of(const json& results, const char* gear) { return results.at("compliance").at(gear).at("source"); }

}  // namespace

TEST_CASE("A gear's body is read, and its offset turned into the frame of its finite elements", "[studies][body]") {
  const Study study = read_bodies(body_pair + web_text + "hole_count = 6\nhole_diameter = \"1 cm\"\nhub_width = 14\n");
  const GearBody& body = study.body.wheel;
  REQUIRE(body.web);
  CHECK(body.hold == BodyHold::RigidBore);
  CHECK(body.web->rim_thickness == 12);
  CHECK(body.web->web_offset == 2.5);
  CHECK(body.web->hub_width == 14);
  CHECK(body.web->holes.count == 6);
  CHECK(body.web->holes.diameter == 10);
  CHECK_FALSE(study.body.pinion.web);
  const GearPair pair = make_gear_pair(study.pair);
  const InfluenceTableTask task = influence_table_task(compliance_task(study, pair), Member::Wheel);
  CHECK(task.gear.body.web->web_offset == -2.5 * pair.acute_end(Member::Wheel));
  CHECK(task.removed == RemovedRigidMotion::None);
  CHECK(task.gear.body.web->holes.circle_diameter == Approx(0.5 * (60 + 2 * (pair.wheel.root_radius - 12))).epsilon(1e-12));  // round-off
}

TEST_CASE("Bodies that cannot be are refused by their key, whatever the compliance", "[studies][body]") {
  const char* compliance = GENERATE("fe", "thin_slice");
  const auto problem = [&](const std::string& text, std::vector<Override> overrides = {}) {
    overrides.push_back({"fidelity.compliance", compliance});
    return body_problem(body_pair + text, overrides);
  };
  CHECK(problem(web_text).key.empty());
  struct Case {
    const char *key, *value;
  };
  for (const auto& [key, value] :
       {Case{"rim_thickness", "52"}, Case{"rim_thickness", "1.9"}, Case{"web_thickness", "10.5"}, Case{"web_offset", "3.6"},
        Case{"web_offset", "-3.6"}, Case{"hub_diameter", "41"}, Case{"hub_diameter", "130"}, Case{"bore_diameter", "200"}, Case{"hub_width", "6"}}) {
    const std::string path = std::string("wheel.body.") + key;
    const StudyProblem found = problem(web_text, {{path, value}});
    CAPTURE(key, value, found.key, found.value, found.allowed);
    // A hub that is too narrow shows by the web that leaves it.
    CHECK(found.key == (std::string(key) == "hub_width" ? "wheel.body.web_offset" : path));
    CHECK(found.allowed.starts_with("allowed is "));
  }
  CHECK(problem("web_offset = 1\n").key == "wheel.body.rim_thickness");
  CHECK(problem("rim_thickness = 12\n").key == "wheel.body.web_thickness");
  CHECK(problem(web_text + "hole_count = 5\n").key == "wheel.body.hole_diameter");
  CHECK(problem(web_text + "hole_diameter = 5\n").key == "wheel.body.hole_diameter");
  CHECK(problem(web_text + "hole_count = 5\nhole_diameter = 50\n").key == "wheel.body.hole_diameter");
  CHECK(problem("shaft_diameter = 30\n").key == "wheel.body.shaft_diameter");
  CHECK(problem("shaft_overhang = 30\n").key == "wheel.body.shaft_overhang");
  CHECK(problem(web_text, {{"wheel.body.hold", "glue"}}).key == "wheel.body.hold");
}

TEST_CASE("Thin slices say that they do not know of a body", "[studies][body]") {
  const Study study = read_bodies(body_pair + web_text, {{"fidelity.compliance", "thin_slice"}});
  const std::vector<std::string> notes = study_notes(study, make_gear_pair(study.pair));
  CHECK(std::ranges::any_of(notes, [](const std::string& note) { return note.find("a gear's body is given") == 0; }));
}

TEST_CASE("A web's tilt acts in the loaded contact and is in the results, its run is kept by its measures", "[studies][body][fe][slow]") {
  const BodyCache cache;
  const json offset = run_bodies(body_pair + web_text);
  const json again = run_bodies(body_pair + web_text);
  const json mirrored = run_bodies(body_pair + web_text, {{"wheel.body.web_offset", "-2.5"}});
  const json centred = run_bodies(body_pair + web_text, {{"wheel.body.web_offset", "0"}});
  CHECK(source_of(offset, "wheel") == "solved");
  CHECK(source_of(again, "wheel") == "cache");
  CHECK(again.at("loaded") == offset.at("loaded"));  // to the last bit
  CHECK(source_of(mirrored, "wheel") == "solved");
  CHECK(source_of(mirrored, "pinion") == "cache");

  const auto rim = [](const json& results, const char* name) {
    return results.at("loaded")[0].at("summary").at("rims").at("wheel").at(name).at("mean").get<double>();
  };
  CHECK(offset.at("loaded")[0].at("summary").at("rims").at("pinion").is_null());
  CHECK(offset.at("loaded")[0].at("rims").size() == 4);
  CHECK(offset.at("used").at("pair").at("wheel").at("body").at("web").at("web_offset_mm") == 2.5);
  CHECK(rim(offset, "misalignment_um") < -0.5);                                                      // carried at +z, pushed away from the mate at -z
  CHECK(rim(mirrored, "misalignment_um") == Approx(-rim(offset, "misalignment_um")).epsilon(0.01));  // the pinion is twisted from one end
  CHECK(std::abs(rim(centred, "misalignment_um")) < 0.01 * std::abs(rim(offset, "misalignment_um")));  // likewise
  CHECK(rim(centred, "radial_um") > 0);
  // It is a misalignment of ISO 6336-1 as well: F_beta_y is what opens at the teeth under an even load. The load that leans to the carried end opens less.
  const auto F_beta_y = [](const json& results) { return results.at("loaded")[0].at("summary").at("iso6336").at("F_beta_y_um").get<double>(); };
  const double leaning = std::abs(rim(offset, "misalignment_at_teeth_um"));
  CHECK(F_beta_y(offset) > leaning);
  CHECK(F_beta_y(offset) < 2.0 * leaning);
  CHECK(F_beta_y(centred) < 0.05 * F_beta_y(offset));
  // The load follows the end that is carried.
  const auto leans = [](const json& results) {
    double sum = 0;
    for (const json& tooth : results.at("loaded")[0].at("cycle")[0].at("teeth")) {
      for (const json& point : tooth.at("points")) sum += point.at("z_mm").get<double>() * point.at("load_N_per_mm").get<double>();
    }
    return sum;
  };
  CHECK(leans(offset) > 0);
  CHECK(leans(mirrored) < 0);
  CHECK(std::abs(leans(centred)) < 0.05 * leans(offset));
}

TEST_CASE("A solid gear on its shaft is stored as it was before bodies had keys", "[studies][body][fe]") {
  const BodyCache cache;
  const std::string solid = body_pair.substr(0, body_pair.find("[wheel.body]"));
  const json plain = run_bodies(solid);
  const json said = run_bodies(solid, {{"wheel.body.hold", "shaft"}, {"pinion.body.hold", "shaft"}});
  CHECK(source_of(said, "wheel") == "cache");
  CHECK(source_of(said, "pinion") == "cache");
  CHECK(said.at("loaded") == plain.at("loaded"));
  CHECK_FALSE(plain.at("loaded")[0].contains("rims"));
  CHECK_FALSE(plain.at("used").at("pair").at("wheel").at("body").contains("hold"));
}

}  // namespace flankwright::studies
