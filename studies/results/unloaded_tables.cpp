#include "studies/base/csv.hpp"
#include "studies/results/unloaded_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

namespace {

/// Empty as well where a number is infinite, such as the ellipse of contact along a line.
std::string cell(double value) { return std::isfinite(value) ? csv_field(value) : std::string(); }

double largest_jump(const UnloadedMesh& mesh) {
  double largest = 0.0;
  for (const Transfer& transfer : mesh.transfers) largest = std::max(largest, std::abs(transfer.slope_jump()));
  return largest;
}

std::string parabola_line(const ParabolaCheck& check) {
  const std::string found =
      fmt::format("a = {:.4g} of {:.4g} arcsec/deg^2 wanted, vertex at {:+.3g} deg, within {:.3g} arcsec", in_arcsec_per_deg2(check.found),
                  in_arcsec_per_deg2(check.wanted), in_deg(check.shift), in_arcsec(check.residual));
  return check.holds ? "holds: " + found : "does not hold: " + check.why;
}

}  // namespace

std::string unloaded_csv(const StudyResults& results) {
  std::string csv =
      "scene,tooth,phi1_deg,phi2_deg,te_arcsec,contact,pinion_radius_mm,pinion_z_mm,wheel_radius_mm,wheel_z_mm,"
      "te_slope_arcsec_per_deg,carries,semi_major_mm,semi_minor_mm\n";
  for (const UnloadedResult& unloaded : results.unloaded) {
    for (std::size_t i = 0; i < unloaded.mesh.pairs.size(); ++i) {
      const PairCurve& curve = unloaded.mesh.pairs[i];
      for (std::size_t j = 0; j < curve.positions.size(); ++j) {
        const ToothContact& c = curve.positions[j];
        const ContactMark& mark = unloaded.marks[i][j];
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(unloaded.scene), curve.tooth, in_deg(c.phi1), in_deg(c.phi2),
                           in_arcsec(c.transmission_error), to_string(c.kind), c.pinion_radius, c.pinion_z, c.wheel_radius, c.wheel_z,
                           cell(in_arcsec_per_deg(c.slope)), mark.carries ? 1 : 0, cell(mark.ellipse.semi_major), cell(mark.ellipse.semi_minor));
      }
    }
  }
  return csv;
}

std::string transfers_csv(const StudyResults& results) {
  std::string csv =
      "scene,phi1_deg,te_arcsec,from_tooth,to_tooth,slope_before_arcsec_per_deg,slope_after_arcsec_per_deg,"
      "slope_jump_arcsec_per_deg\n";
  for (const UnloadedResult& unloaded : results.unloaded) {
    for (const Transfer& t : unloaded.mesh.transfers) {
      csv += fmt::format("{},{},{},{},{},{},{},{}\n", csv_field(unloaded.scene), in_deg(t.phi1), in_arcsec(t.transmission_error), t.from_tooth,
                         t.to_tooth, cell(in_arcsec_per_deg(t.slope_before)), cell(in_arcsec_per_deg(t.slope_after)),
                         cell(in_arcsec_per_deg(t.slope_jump())));
    }
  }
  return csv;
}

std::string bearing_pattern_csv(const StudyResults& results) {
  std::string csv = "scene,gear,radius_mm,z_mm,separation_um\n";
  for (const UnloadedResult& unloaded : results.unloaded) {
    for (const auto& [gear, pattern] : {std::pair{"pinion", &unloaded.pinion_pattern}, std::pair{"wheel", &unloaded.wheel_pattern}}) {
      for (Eigen::Index row = 0; row < pattern->separation.rows(); ++row) {
        for (Eigen::Index column = 0; column < pattern->separation.cols(); ++column) {
          csv += fmt::format("{},{},{},{},{}\n", csv_field(unloaded.scene), gear, pattern->radius[static_cast<std::size_t>(row)],
                             pattern->z[static_cast<std::size_t>(column)], cell(in_um(pattern->separation(row, column))));
        }
      }
    }
  }
  return csv;
}

std::string unloaded_summary(const StudyResults& results, std::size_t width) {
  if (results.unloaded.empty()) return "";
  constexpr const char* row = "{:<{}}  {:>10}  {:>10}  {:>10}  {:>11}  {}\n";
  std::string out =
      fmt::format(fmt::runtime(row), "unloaded", width, "TE p-p", "TE 1st", "transfers", "slope jump", "contact of a pair, from entry to exit");
  out += fmt::format(fmt::runtime(row), "", width, "arcsec", "arcsec", "", "arcsec/deg", "");
  const int teeth = results.pair.data.pinion.teeth;
  for (const UnloadedResult& u : results.unloaded) {
    const double first = u.mesh.harmonics.empty() ? not_given : u.mesh.harmonics.front();
    const std::string in_table = std::isnan(first) ? "-" : fmt::format("{:.5g}", in_arcsec(first));  // too few positions for a harmonic
    out += fmt::format("{:<{}}  {:>10.5g}  {:>10}  {:>10}  {:>11.4g}  {}\n", u.scene, width, in_arcsec(u.mesh.peak_to_peak), in_table,
                       u.mesh.transfers.size(), in_arcsec_per_deg(largest_jump(u.mesh)), whole_sequence(u, teeth, false));
    out += fmt::format("{:<{}}  carrying: {}\n", "", width, whole_sequence(u, teeth, true));
    if (u.parabola) out += fmt::format("{:<{}}  parabola {}\n", "", width, parabola_line(*u.parabola));
  }
  return out;
}

}  // namespace flankwright::studies
