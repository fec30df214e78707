#include "core/compliance/shaft/shaft_data.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

#include "core/base/findings.hpp"
#include "core/base/positive_definite.hpp"
#include "core/base/units.hpp"

namespace flankwright {

namespace {

std::string element(const char* list, std::size_t i) { return std::string(list) + "." + std::to_string(i) + "."; }

void check_sections(const ShaftData& shaft, Findings& findings) {
  findings.require(!shaft.sections.empty(), "sections", "none", "at least one section");
  for (std::size_t i = 0; i < shaft.sections.size(); ++i) {
    const ShaftSection& section = shaft.sections[i];
    const std::string name = element("sections", i);
    findings.require(section.length > 0.0, name + "length", section.length, "above 0 mm");
    findings.require(section.outer_diameter > 0.0, name + "outer_diameter", section.outer_diameter, "above 0 mm");
    findings.require(section.inner_diameter >= 0.0 && !(section.inner_diameter >= section.outer_diameter), name + "inner_diameter",
                     section.inner_diameter, "0 mm or more, and below the outer diameter");
  }
}

void check_bearings(const ShaftData& shaft, bool alone, Findings& findings) {
  bool holds_axially = false, holds_tilt = false;
  std::vector<double> positions;
  std::vector<std::string> names;
  for (std::size_t i = 0; i < shaft.bearings.size(); ++i) {
    const ShaftBearing& bearing = shaft.bearings[i];
    const std::string name = element("bearings", i);
    findings.require(bearing.position >= 0.0 && bearing.position <= shaft.length(), name + "position", bearing.position,
                     "on the shaft, 0 .. " + std::to_string(shaft.length()) + " mm");
    findings.require(std::ranges::find(positions, bearing.position) == positions.end(), name + "position", bearing.position, "a position of its own");
    findings.require(std::ranges::find(names, bearing.name) == names.end(), name + "name", bearing.name,
                     "a name of its own: another bearing of this shaft has this one");
    if (!bearing.name.empty()) names.push_back(bearing.name);
    findings.require(bearing.radial_stiffness > 0.0, name + "radial_stiffness", bearing.radial_stiffness, "above 0");
    findings.require(bearing.axial_stiffness >= 0.0, name + "axial_stiffness", bearing.axial_stiffness, "0 or more");
    findings.require(bearing.tilting_stiffness >= 0.0, name + "tilting_stiffness", bearing.tilting_stiffness, "0 or more");
    findings.require(bearing.radial_clearance >= 0.0 && std::isfinite(bearing.radial_clearance), name + "radial_clearance", bearing.radial_clearance,
                     "0 mm or more");
    for (const InvalidInput& problem : find_yielding_problems(bearing)) findings.add({name + problem.field(), problem.value(), problem.allowed()});
    positions.push_back(bearing.position);
    const std::array<bool, 5> holds = bearing.holds();
    holds_axially = holds_axially || holds[2];
    holds_tilt = holds_tilt || (holds[3] && holds[4]);
  }
  if (!alone) return;
  findings.require(positions.size() >= 2 || (positions.size() == 1 && holds_tilt), "bearings", std::to_string(positions.size()),
                   "at least two, or one that holds against tilting");
  findings.require(holds_axially, "bearings", "no axial_stiffness", "at least one that holds the shaft axially");
}

}  // namespace

std::array<bool, 5> ShaftBearing::holds() const {
  if (!has_matrix()) return {radial_stiffness > 0.0, radial_stiffness > 0.0, axial_stiffness > 0.0, tilting_stiffness > 0.0, tilting_stiffness > 0.0};
  std::array<bool, 5> held{};
  for (Eigen::Index i = 0; i < std::min<Eigen::Index>(5, stiffness_matrix.rows()); ++i)
    held[static_cast<std::size_t>(i)] = !stiffness_matrix.row(i).isZero(0.0);
  return held;
}

namespace {

std::optional<InvalidInput> find_matrix_problem(const ShaftBearing& bearing) {
  const auto problem = [](const std::string& value, const std::string& allowed) { return InvalidInput("stiffness_matrix", value, allowed); };
  const Eigen::MatrixXd& k = bearing.stiffness_matrix;
  if (k.rows() != 5 || k.cols() != 5) {
    return problem(std::to_string(k.size()) + " numbers",
                   "25 numbers, row by row: forces x, y, z and moments about x and y by displacements x, y, z and turns about x and y");
  }
  if (bearing.depends_on_load() || std::isfinite(bearing.radial_stiffness) || bearing.axial_stiffness > 0.0 || bearing.tilting_stiffness > 0.0) {
    return problem("beside another stiffness or a clearance", "a matrix alone, which says all of how the bearing yields");
  }
  constexpr double round_off = 1e-6;  // |k_ij - k_ji| at most this part of sqrt(k_ii k_jj): matrices come rounded
  std::vector<Eigen::Index> held;
  for (Eigen::Index i = 0; i < 5; ++i) {
    if (bearing.holds()[static_cast<std::size_t>(i)]) held.push_back(i);
    for (Eigen::Index j = 0; j < i; ++j) {
      if (!(std::abs(k(i, j) - k(j, i)) <= round_off * std::sqrt(std::abs(k(i, i) * k(j, j))))) return problem("not symmetric", "a symmetric matrix");
    }
  }
  const bool across = bearing.holds()[0] && bearing.holds()[1];
  if (!across) return problem("no stiffness across the shaft", "one that holds the shaft along x and y");
  if (!is_positive_definite(k(held, held))) {
    return problem(
        "not positive definite",
        "a matrix that is positive definite, to the seventh digit, where its rows are not 0: no motion without force. A bearing that does not "
        "resist tilting is given at the centre of its tilting, with rows of 0 for the moments");
  }
  return std::nullopt;
}

}  // namespace

std::vector<InvalidInput> find_yielding_problems(const ShaftBearing& bearing) {
  std::vector<InvalidInput> problems = find_problems(bearing.law);
  if (bearing.has_matrix()) {
    if (const std::optional<InvalidInput> problem = find_matrix_problem(bearing)) problems.push_back(*problem);
    return problems;
  }
  if (bearing.law.given() && std::isfinite(bearing.radial_stiffness)) {
    problems.emplace_back("radial_stiffness", in_words(bearing.radial_stiffness * units::um) + " N/um",
                          "none beside a table or a type, which say how the bearing yields");
  }
  return problems;
}

double ShaftData::length() const {
  double sum = 0.0;
  for (const ShaftSection& section : sections) sum += section.length;
  return sum;
}

namespace {

/// @param alone  the shaft must be held by its own bearings, and its torque leave at one place
std::vector<InvalidInput> find_shaft_problems(const ShaftData& shaft, double face_width, bool alone) {
  Findings findings;
  findings.require(shaft.material.youngs_modulus > 0.0, "material.youngs_modulus", shaft.material.youngs_modulus, "above 0 MPa");
  findings.require(shaft.material.poissons_ratio >= 0.0 && shaft.material.poissons_ratio < 0.5, "material.poissons_ratio",
                   shaft.material.poissons_ratio, "0 .. below 0.5");
  check_sections(shaft, findings);
  if (!findings.empty()) return findings.take();
  check_bearings(shaft, alone, findings);
  const double length = shaft.length(), half = 0.5 * face_width;
  const double round_off = 1e-9 * length;  // ends are sums of lengths: a position within it of an end is on the shaft
  const bool has_gear = alone || face_width > 0.0;
  findings.require(!has_gear || (shaft.gear_position >= half - round_off && shaft.gear_position <= length - half + round_off), "gear_position",
                   shaft.gear_position,
                   "one that has the whole face on the shaft, " + std::to_string(half) + " .. " + std::to_string(length - half) + " mm");
  const bool has_coupling = alone || !std::isnan(shaft.torque_position);
  const bool in_face = has_gear && std::abs(shaft.torque_position - shaft.gear_position) < half - round_off;
  findings.require(!has_coupling || (shaft.torque_position >= 0.0 && shaft.torque_position <= length + round_off && !in_face), "torque_position",
                   shaft.torque_position, has_gear ? "on the shaft and not within the gear's face" : "on the shaft");
  return findings.take();
}

}  // namespace

std::vector<InvalidInput> find_problems(const ShaftData& shaft, double face_width) { return find_shaft_problems(shaft, face_width, true); }

std::vector<InvalidInput> find_problems_in_unit(const ShaftData& shaft, double face_width) { return find_shaft_problems(shaft, face_width, false); }

}  // namespace flankwright
