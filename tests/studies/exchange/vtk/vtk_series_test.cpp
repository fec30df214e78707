#include "studies/exchange/vtk/vtk_series.hpp"

#include <algorithm>
#include <bit>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <pugixml.hpp>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/flank/flank.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/results_json.hpp"
#include "studies/exchange/rexs/rexs_model.hpp"
#include "studies/analysis/run_study.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/studies/small_studies.hpp"
#include "tests/common/about.hpp"

using namespace flankwright;
using namespace flankwright::studies;

namespace {

/// Numbers of a packed array, after the count of bytes before them was checked.
std::vector<double> numbers(const pugi::xml_node& array) {
  CHECK(std::string(array.attribute("format").value()) == "binary");
  const bool whole = std::string(array.attribute("type").value()) == "Int32";
  // The count, a UInt32, and the numbers are one stream of bytes: the same length of base64 as 4 + n width bytes have.
  const auto words = rexs::unpacked(array.text().get(), "int32");
  REQUIRE(words);
  const std::size_t bytes = std::stoul(words->front());
  REQUIRE(bytes + 4 == 4 * words->size());
  std::vector<double> values;
  for (std::size_t at = 1; at < words->size(); at += whole ? 1 : 2) {
    const auto word = [&](std::size_t k) { return static_cast<std::uint64_t>(static_cast<std::uint32_t>(std::stol((*words)[k]))); };
    values.push_back(whole ? std::stod((*words)[at]) : std::bit_cast<double>(word(at) | word(at + 1) << 32));
  }
  return values;
}

constexpr double vtk_round_off = 1e-12;

/// A PolyData file as a reader of VTK sees it, after its counts were checked against each other.
struct Piece {
  std::vector<double> points;
  std::map<std::string, std::vector<double>> fields;
  std::vector<double> connectivity, offsets, teeth;
};

Piece read_piece(const std::string& xml, const char* cells) {
  pugi::xml_document document;
  REQUIRE(document.load_string(xml.c_str()));
  const pugi::xml_node root = document.child("VTKFile");
  CHECK(std::string(root.attribute("type").value()) == "PolyData");
  const pugi::xml_node node = root.child("PolyData").child("Piece");
  const std::size_t count = node.attribute("NumberOfPoints").as_uint();
  Piece piece{.points = numbers(node.child("Points").child("DataArray")), .fields = {}, .connectivity = {}, .offsets = {}, .teeth = {}};
  CHECK(piece.points.size() == 3 * count);
  for (const pugi::xml_node array : node.child("PointData").children("DataArray")) {
    piece.fields[array.attribute("Name").value()] = numbers(array);
    CHECK(piece.fields[array.attribute("Name").value()].size() == count);
  }
  for (const pugi::xml_node array : node.child(cells).children("DataArray")) {
    (std::string(array.attribute("Name").value()) == "offsets" ? piece.offsets : piece.connectivity) = numbers(array);
  }
  piece.teeth = numbers(node.child("CellData").child("DataArray"));
  CHECK(piece.offsets.size() == node.attribute((std::string("NumberOf") + cells).c_str()).as_uint());
  CHECK(piece.teeth.size() == piece.offsets.size());
  CHECK((piece.offsets.empty() ? 0.0 : piece.offsets.back()) == static_cast<double>(piece.connectivity.size()));
  for (const double index : piece.connectivity) CHECK((index >= 0.0 && index < static_cast<double>(count)));
  return piece;
}

}  // namespace

TEST_CASE("A VTK series is valid, complete and lies on the plane of action and the flanks", "[studies][vtk]") {
  const std::string hand = GENERATE("right", "left"), flank = GENERATE("right", "left");
  CAPTURE(hand, flank);
  const StudyResults results = run_study(parse_study(
      small::analysis(), "a", {{"pinion.hand", hand}, {"pair.working_flank", flank}, {"cycle.positions", "3"}, {"cycle.peaks", "sampled"}}));
  const Json json = results_document(results);
  std::map<std::string, std::string> files;
  for (const NamedText& file : vtk_series(json, "a")) files[file.name] = file.text;
  REQUIRE(files.size() == 2 * (1 + 3 * 3));  // two scenes, three positions, three parts

  pugi::xml_document collection;
  REQUIRE(collection.load_string(files.at("contact-1.pvd").c_str()));
  int sets = 0;
  for (const pugi::xml_node set : collection.child("VTKFile").child("Collection").children("DataSet")) {
    CHECK(files.contains(set.attribute("file").value()));
    CHECK(set.attribute("timestep").as_double() ==
          Approx(json["loaded"][0]["cycle"][static_cast<std::size_t>(sets++ / 3)]["phase"].get<double>()).epsilon(5e-9));  // written with nine digits
  }
  CHECK(sets == 9);

  const Piece lines = read_piece(files.at("contact-2/lines-0001.vtp"), "Lines");
  const Json& position = json["loaded"][1]["cycle"][1];
  std::size_t at = 0, on_line = 0;
  const double angle = results.pair.working_transverse_pressure_angle, mirror = flank == "right" ? 1.0 : -1.0;
  for (const Json& tooth : position["teeth"]) {
    for (const Json& point : tooth["points"]) {
      CHECK(lines.fields.at("load_N_per_mm")[at] == point["load_N_per_mm"].get<double>());
      CHECK(lines.fields.at("contact_stress_MPa")[at] == point["contact_stress_MPa"].get<double>());
      CHECK(lines.fields.at("gap_um")[at] == point["gap_um"].get<double>());
      const double x = lines.points[3 * at], y = mirror * lines.points[3 * at + 1], a = results.pair.centre_distance;
      // On the pinion, on the wheel, and, unless a tip edge touches, on the line of action.
      CHECK(std::hypot(x, y) == Approx(point["pinion_radius_mm"].get<double>()).epsilon(vtk_round_off));
      CHECK(std::hypot(a - x, y) == Approx(point["wheel_radius_mm"].get<double>()).epsilon(vtk_round_off));
      const double distance = std::abs((x - results.pair.pinion.working_pitch_radius) * std::cos(angle) - y * std::sin(angle));
      const double rolls =
          results.pair.pinion.roll_length_at(point["pinion_radius_mm"]) + results.pair.wheel.roll_length_at(point["wheel_radius_mm"]);
      if (std::abs(rolls - results.pair.path_length) < 1e-6) CHECK(distance < 1e-6);
      on_line += distance < 1e-6 ? 1 : 0;
      CHECK(lines.points[3 * at + 2] == point["z_mm"].get<double>());
      ++at;
    }
  }
  CHECK(at == lines.points.size() / 3);
  CHECK(on_line > at / 3);

  for (const std::string gear : {"pinion", "wheel"}) {
    const Piece surface = read_piece(files.at("contact-2/" + gear + "-0001.vtp"), "Polys");
    CHECK(surface.teeth.size() % 64 == 0);
    CHECK(surface.teeth.size() >= 128);
    const double centre = gear == "pinion" ? 0.0 : results.pair.centre_distance;
    for (std::size_t i = 0; i < surface.points.size() / 3; ++i) {
      CHECK(std::hypot(surface.points[3 * i] - centre, surface.points[3 * i + 1]) ==
            Approx(surface.fields.at("radius_mm")[i]).epsilon(vtk_round_off));
    }
    const double largest = *std::max_element(surface.fields.at("removal_um").begin(), surface.fields.at("removal_um").end());
    CHECK((largest > 1.0) == (gear == "pinion"));
  }
}

TEST_CASE("A scene on the other flank is drawn on that flank, with what the tool removes there", "[studies][vtk][other-flank]") {
  const auto pieces = [](const std::vector<Override>& overrides) {
    std::vector<Override> all{{"cycle.positions", "2"}, {"cycle.peaks", "sampled"}};
    all.insert(all.end(), overrides.begin(), overrides.end());
    const StudyResults results = run_study(parse_study(small::analysis(), "a", all));
    std::map<std::string, std::string> files;
    for (const NamedText& file : vtk_series(results_document(results), "a")) files[file.name] = file.text;
    return std::pair{read_piece(files.at("contact-2/lines-0000.vtp"), "Lines"), read_piece(files.at("contact-2/pinion-0000.vtp"), "Polys")};
  };
  const auto [lines, flank] = pieces({{"scenes.1.working_flank", "left"}, {"pinion.modification.lead_slope", "6"}});
  const auto [lines_alone, flank_alone] = pieces({{"pair.working_flank", "left"}, {"pinion.modification.lead_slope", "-6"}});
  constexpr double round_off = 1e-6;  // of the search for a touch
  REQUIRE(lines.points.size() == lines_alone.points.size());
  for (std::size_t i = 0; i < lines.points.size(); ++i) CHECK(lines.points[i] == tests::about(lines_alone.points[i], round_off));
  REQUIRE(flank.points.size() == flank_alone.points.size());
  for (std::size_t i = 0; i < flank.points.size(); ++i) CHECK(flank.points[i] == tests::about(flank_alone.points[i], round_off));
  const std::vector<double>&removed = flank.fields.at("removal_um"), &removed_alone = flank_alone.fields.at("removal_um");
  for (std::size_t i = 0; i < removed.size(); ++i) CHECK(removed[i] == tests::about(removed_alone[i], round_off));
}

TEST_CASE("The drawn flanks are the involutes through their contact lines", "[studies][vtk]") {
  const std::string flank = GENERATE("right", "left"), offset = GENERATE("0", "5");
  const StudyResults results = run_study(parse_study(
      small::analysis(), "a",
      {{"pair.working_flank", flank}, {"scenes.0.misalignment.axial_offset", offset}, {"cycle.positions", "2"}, {"cycle.peaks", "sampled"}}));
  const GearPair& pair = results.pair;
  std::map<std::string, std::string> files;
  for (const NamedText& file : vtk_series(results_document(results), "a")) files[file.name] = file.text;
  const Piece lines = read_piece(files.at("contact-1/lines-0000.vtp"), "Lines");
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const Gear& gear = pair[m];
    // Of one flank this is the same everywhere: polar angle of the involute's start in the section z = 0.
    const auto start = [&](const std::vector<double>& points, std::size_t i) {
      const double sense = m == Member::Pinion ? 1.0 : -1.0, mirror = flank == "right" ? 1.0 : -1.0;
      const double x = m == Member::Pinion ? points[3 * i] : pair.centre_distance - points[3 * i], y = mirror * sense * points[3 * i + 1];
      const double alpha = std::acos(std::min(1.0, gear.base_radius / std::hypot(x, y)));
      return std::atan2(y, x) + std::tan(alpha) - alpha - sense * pair.contact_line_sense() * gear.helix_rate * points[3 * i + 2];
    };
    const Piece surface = read_piece(files.at(std::string("contact-1/") + name_of(m) + "-0000.vtp"), "Polys");
    const double mid = m == Member::Wheel ? std::stod(offset) : 0.0;
    for (std::size_t i = 2; i < surface.points.size(); i += 3) CHECK(std::abs(surface.points[i] - mid) <= 60.0 + 1e-9);  // round-off
    // Points on the line of action lie on the flank of their tooth; those of tip edges lie elsewhere.
    std::size_t line = 0, compared = 0;
    for (std::size_t cell = 0; cell < lines.offsets.size(); ++cell) {
      const auto drawn = std::find(surface.teeth.begin(), surface.teeth.end(), lines.teeth[cell]);
      CHECK(drawn != surface.teeth.end());  // also of teeth that touch by a tip edge only
      const auto tooth = static_cast<std::size_t>(drawn - surface.teeth.begin()) / 64;
      for (; line < static_cast<std::size_t>(lines.offsets[cell]); ++line) {
        const double x = lines.points[3 * line], y = lines.points[3 * line + 1];
        const double rolls = pair.pinion.roll_length_at(std::hypot(x, y)) + pair.wheel.roll_length_at(std::hypot(pair.centre_distance - x, y));
        if (drawn == surface.teeth.end() || std::abs(rolls - pair.path_length) > 1e-5) continue;
        for (std::size_t i = 81 * tooth; i < 81 * (tooth + 1); i += 10) {
          CHECK(start(lines.points, line) == tests::about(start(surface.points, i), 1e-9));  // round-off
        }
        ++compared;
      }
    }
    CHECK(compared > 5);
  }
}

TEST_CASE("What is removed is drawn where it is removed, and normals point out of the tooth", "[studies][vtk]") {
  const std::string flank = GENERATE("right", "left");
  CAPTURE(flank);
  const StudyResults results = run_study(parse_study(small::analysis(), "a",
                                                     {{"pair.working_flank", flank},
                                                      {"pinion.edges.tip_chamfer.amount", "2"},
                                                      {"pinion.modification.tip_relief.amount", "30"},
                                                      {"pinion.modification.tip_relief.height", "8"},
                                                      {"cycle.positions", "2"},
                                                      {"cycle.peaks", "sampled"}}));
  const GearPair& pair = results.pair;
  std::map<std::string, std::string> files;
  for (const NamedText& file : vtk_series(results_document(results), "a")) files[file.name] = file.text;
  const Piece surface = read_piece(files.at("contact-1/pinion-0000.vtp"), "Polys");
  const Flank drawn = make_flank(pair, Member::Pinion, results.loaded.front().condition.modification.pinion, {});
  const std::vector<double>&removed = surface.fields.at("removal_um"), &radius = surface.fields.at("radius_mm");
  constexpr double round_off = 1e-9;
  for (std::size_t i = 0; i < removed.size(); ++i) {
    CHECK(radius[i] <= pair.pinion.tip_form_radius * (1.0 + round_off));
    CHECK(removed[i] == tests::about(drawn.deviation(drawn.roll_at(radius[i]), surface.points[3 * i + 2], 0) / units::um, 1e-6));  // um
  }
  CHECK(*std::ranges::max_element(removed) > 10.0);
  for (std::size_t c = 0; c < surface.offsets.size(); ++c) {
    const auto corner = [&](std::size_t k) {
      return Eigen::Vector3d::Map(&surface.points[3 * static_cast<std::size_t>(surface.connectivity[4 * c + k])]);
    };
    // Out of the tooth, the right flank faces counterclockwise about z, the left one clockwise.
    const Eigen::Vector3d normal = (corner(1) - corner(0)).cross(corner(3) - corner(0)), around(-corner(0).y(), corner(0).x(), 0.0);
    CHECK((normal.dot(around) > 0.0) == (flank == "right"));
  }
}

TEST_CASE("A value that was not computed is NaN, and the following points keep their values", "[studies][vtk]") {
  Json json = Json::parse(results_json(run_study(parse_study(small::analysis(), "a", {{"cycle.positions", "2"}, {"cycle.peaks", "sampled"}}))));
  Json& points = json["loaded"][0]["cycle"][0]["teeth"][0]["points"];
  REQUIRE(points.size() > 2);
  points[1]["gap_um"] = nullptr;
  std::map<std::string, std::string> files;
  for (const NamedText& file : vtk_series(json, "a")) files[file.name] = file.text;
  const std::vector<double> gaps = read_piece(files.at("contact-1/lines-0000.vtp"), "Lines").fields.at("gap_um");
  CHECK(std::isnan(gaps[1]));
  CHECK(gaps[0] == points[0]["gap_um"].get<double>());
  CHECK(gaps[2] == points[2]["gap_um"].get<double>());
}

TEST_CASE("Results without loaded contact have no series", "[studies][vtk][errors]") {
  const Json unloaded = results_document(run_study(parse_study(small::analysis(), "a", {{"load.torque", "0"}})));
  CHECK_THROWS_AS(vtk_series(unloaded, "a"), InvalidInput);
  CHECK_THROWS_AS(vtk_series(Json::object(), "a"), InvalidInput);
}
