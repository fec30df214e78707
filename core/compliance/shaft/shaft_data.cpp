#include "core/compliance/shaft/shaft_data.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/findings.hpp"

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
  for (std::size_t i = 0; i < shaft.bearings.size(); ++i) {
    const ShaftBearing& bearing = shaft.bearings[i];
    const std::string name = element("bearings", i);
    findings.require(bearing.position >= 0.0 && bearing.position <= shaft.length(), name + "position", bearing.position,
                     "on the shaft, 0 .. " + std::to_string(shaft.length()) + " mm");
    findings.require(std::ranges::find(positions, bearing.position) == positions.end(), name + "position", bearing.position, "a position of its own");
    findings.require(bearing.radial_stiffness > 0.0, name + "radial_stiffness", bearing.radial_stiffness, "above 0");
    findings.require(bearing.axial_stiffness >= 0.0, name + "axial_stiffness", bearing.axial_stiffness, "0 or more");
    findings.require(bearing.tilting_stiffness >= 0.0, name + "tilting_stiffness", bearing.tilting_stiffness, "0 or more");
    findings.require(bearing.radial_clearance >= 0.0 && std::isfinite(bearing.radial_clearance), name + "radial_clearance", bearing.radial_clearance,
                     "0 mm or more");
    for (const InvalidInput& problem : find_law_problems(bearing)) findings.add({name + problem.field(), problem.value(), problem.allowed()});
    positions.push_back(bearing.position);
    holds_axially = holds_axially || bearing.axial_stiffness > 0.0;
    holds_tilt = holds_tilt || bearing.tilting_stiffness > 0.0;
  }
  if (!alone) return;
  findings.require(positions.size() >= 2 || (positions.size() == 1 && holds_tilt), "bearings", std::to_string(positions.size()),
                   "at least two, or one that holds against tilting");
  findings.require(holds_axially, "bearings", "no axial_stiffness", "at least one that holds the shaft axially");
}

}  // namespace

std::vector<InvalidInput> find_law_problems(const ShaftBearing& bearing) {
  std::vector<InvalidInput> problems = find_problems(bearing.law);
  if (bearing.law.given() && std::isfinite(bearing.radial_stiffness)) {
    problems.emplace_back("radial_stiffness", in_words(bearing.radial_stiffness) + " N/mm",
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
