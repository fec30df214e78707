#include "studies/exchange/rexs/rexs_defects.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "studies/exchange/rexs/rexs_stage.hpp"

namespace flankwright::studies::rexs {

namespace {

constexpr double coincident = 1e-6;  ///< of bearings on a shaft, and of ends [mm]

/// A place along a shaft that something takes [mm].
struct Place {
  const Component* component;
  std::string attribute;
  double position, width;
};

class Checking {
 public:
  Checking(const Reading& reading, const UnitPart& part) : reading_(reading.model(), reading.file()), part_(part) {}

  std::vector<StudyProblem> run() {
    if (is_planetary()) return {};
    check_gears();
    has_bearings_ = std::ranges::any_of(part_.shafts, [this](int shaft) { return holds_of(component(shaft)) > 0; });
    for (const int id : part_.shafts) {
      const Component& shaft = component(id);
      find_ends(shaft);
      check_bearings(shaft, "inner_part", "u_coordinate_on_shaft_inner_side");
      check_bearings(shaft, "outer_part", "u_coordinate_on_shaft_outer_side");
      check_supports(shaft);
      check_overlap(shaft);
    }
    return std::move(problems_);
  }

 private:
  const Component& component(int id) const { return *reading_.model().find(id); }

  bool is_planetary() const {
    return std::ranges::any_of(reading_.model().components, [](const Component& c) { return c.type == "planetary_stage"; }) ||
           std::ranges::any_of(part_.gears, [this](int gear) { return component(gear).type == "ring_gear"; });
  }

  void add(const Component& of, const std::string& attribute, const std::string& value, const std::string& allowed) {
    const Attribute* found = of.find(attribute);
    const int line = found != nullptr ? found->line : of.line;
    problems_.push_back(
        {reading_.file(), line, line > 0 ? 1 : 0, full_name(of) + (found != nullptr ? " " + attribute : ""), value, "allowed is " + allowed});
  }

  void check_gears() {
    const auto is_bare = [this](int gear) { return reading_.related(component(gear), {"shaft"}).empty(); };
    if (stages_of(reading_).size() < 2 || std::ranges::all_of(part_.gears, is_bare)) return;
    for (const int gear : part_.gears) {
      if (is_bare(gear)) add(component(gear), "", "on no shaft", "a relation \"assembly\" that puts it on a shaft, as other gears of the unit have");
    }
  }

  void find_ends(const Component& shaft) {
    start_ = end_ = not_given;
    for (const Component* section : reading_.related(shaft, {"shaft_section"})) {
      const auto from = reading_.number(section, "u_coordinate_on_shaft", Dimension::Length),
                 length = reading_.number(section, "length", Dimension::Length);
      if (!from || !length) continue;
      start_ = std::fmin(start_, from->value);
      end_ = std::fmax(end_, from->value + length->value);
    }
  }

  /// What holds a shaft in a role, bearings and couplings.
  std::vector<const Component*> holding(const Component& shaft, const char* role, std::string_view kind) const {
    std::vector<const Component*> found;
    for (const Relation& relation : reading_.model().relations) {
      const auto assembly = relation.role("assembly");
      const Component* holder = assembly && relation.role(role) == shaft.id ? reading_.model().find(*assembly) : nullptr;
      if (holder != nullptr && holder->type.find(kind) != std::string::npos) found.push_back(holder);
    }
    return found;
  }
  std::vector<const Component*> bearings_of(const Component& shaft, const char* role) {
    std::vector<const Component*> bearings = holding(shaft, role, "bearing");
    std::erase_if(bearings, [this](const Component* bearing) { return reading_.word(bearing, "radial_force_absorption") == "false"; });
    return bearings;
  }
  std::size_t holds_of(const Component& shaft) { return bearings_of(shaft, "inner_part").size() + bearings_of(shaft, "outer_part").size(); }

  void check_bearings(const Component& shaft, const char* role, const char* side) {
    std::vector<Place> taken;
    for (const Component* bearing : bearings_of(shaft, role)) {
      const std::string attribute = bearing->find(side) != nullptr ? side : "u_coordinate_on_shaft";
      const auto at = reading_.number(bearing, attribute, Dimension::Length);
      if (!at) continue;
      const std::string value = fmt::format("{:.6g} mm", at->value);
      if (at->value < start_ - coincident || at->value > end_ + coincident) {
        add(*bearing, attribute, value, fmt::format("a place on {}, {:.6g} .. {:.6g} mm", full_name(shaft), start_, end_));
      }
      for (const Place& other : taken) {
        if (std::abs(other.position - at->value) > coincident) continue;
        add(*bearing, attribute, value, fmt::format("a place on {} of its own, {} is there", full_name(shaft), full_name(*other.component)));
      }
      taken.push_back({bearing, attribute, at->value, 0.0});
    }
  }

  void check_supports(const Component& shaft) {
    const bool carries_gear =
        std::ranges::any_of(part_.gears, [&](int gear) { return std::ranges::count(reading_.related(component(gear), {"shaft"}), &shaft) > 0; });
    if (!carries_gear || !has_bearings_ || std::isnan(start_)) return;
    std::vector<std::string> names;
    for (const char* role : {"inner_part", "outer_part"}) {
      if (!holding(shaft, role, "coupling").empty()) return;
      for (const Component* bearing : bearings_of(shaft, role)) {
        const auto bending = reading_.number(bearing, "bending_stiffness", Dimension::TiltingStiffness);
        if (bending && bending->value > 0.0) return;
        names.push_back(full_name(*bearing));
      }
    }
    if (names.size() > 1) return;
    add(shaft, "", names.empty() ? "on no bearing" : fmt::format("on {} alone", names.front()),
        "at least two bearings, or one with a bending_stiffness: this shaft can move as a rigid body");
  }

  void check_overlap(const Component& shaft) {
    if (std::isnan(start_)) return;  // nobody asks for places on a shaft without sections
    std::vector<Place> taken;
    for (const int id : part_.gears) {
      const Component& gear = component(id);
      if (gear.type != "cylindrical_gear" || std::ranges::count(reading_.related(gear, {"shaft"}), &shaft) == 0) continue;
      const auto at = reading_.number(&gear, "u_coordinate_on_shaft", Dimension::Length),
                 width = reading_.number(&gear, "face_width", Dimension::Length);
      if (!at || !width) continue;
      for (const Place& other : taken) {
        if (std::abs(at->value - other.position) >= 0.5 * (width->value + other.width) - coincident) continue;
        add(gear, "u_coordinate_on_shaft", fmt::format("{:.6g} mm", at->value),
            fmt::format("a place on {} beside {}, which takes {:.6g} .. {:.6g} mm", full_name(shaft), full_name(*other.component),
                        other.position - 0.5 * other.width, other.position + 0.5 * other.width));
      }
      taken.push_back({&gear, "u_coordinate_on_shaft", at->value, width->value});
    }
  }

  Reading reading_;  ///< of its own: what is only checked does not count as taken
  const UnitPart& part_;
  bool has_bearings_{false};
  double start_{not_given}, end_{not_given};  ///< u coordinates of the ends of the shaft at hand [mm]; not given: it has no sections
  std::vector<StudyProblem> problems_;
};

}  // namespace

std::vector<StudyProblem> find_defects(const Reading& reading, const UnitPart& part) { return Checking(reading, part).run(); }

std::vector<StudyProblem> find_defects(const Reading& reading) {
  std::vector<StudyProblem> all;
  for (const Relation* stage : stages_of(reading)) {
    for (StudyProblem& defect : find_defects(reading, part_around(reading, reading.in_role(*stage, "stage")))) {
      if (std::ranges::find(all, to_string(defect), to_string) == all.end()) all.push_back(std::move(defect));
    }
  }
  return all;
}

}  // namespace flankwright::studies::rexs
