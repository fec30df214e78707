#include "studies/tasks/accuracy/accuracy_tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "studies/base/csv.hpp"
#include "studies/results/used_json.hpp"

namespace flankwright::studies {

namespace {

/// Figures that are shown beside an outside curve.
constexpr std::array outside_shown{Figure::TeMean, Figure::TePeakToPeak, Figure::TeHarmonic1};

double of(const PerFigure& figures, Figure f) { return figures[static_cast<std::size_t>(f)]; }

std::string levels_csv(const FidelityHierarchy& hierarchy) {
  std::string csv = "rung,axis,varies,compliance,gap,rule,intervals,positions,peaks,left_out,seconds,first_run_seconds,pareto_best";
  for (int i = 0; i < figure_count; ++i) csv += fmt::format(",{}_error_percent", name_of(static_cast<Figure>(i)));
  csv += ",worst_error_percent";
  for (const Figure f : outside_shown) csv += hierarchy.outside ? fmt::format(",{}_from_outside_percent", name_of(f)) : "";
  csv += "\n";
  for (const HierarchyStep* step : all_steps(hierarchy)) {
    const FidelityLevel& r = step->result.level;
    const Json quadrature = quadrature_json(r.quadrature);
    csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{}", csv_field(r.name), r.axis, to_string(r.kind), to_string(r.compliance),
                       to_string(r.gap), quadrature.at("rule").get<std::string>(), r.quadrature.intervals, r.positions,
                       r.located_peaks ? "refined" : "sampled", fmt::join(r.left_out, " "), step->result.seconds, step->first_seconds, step->best);
    for (double share : step->error) csv += fmt::format(",{}", percent * share);
    csv += fmt::format(",{}", percent * largest(step->error));
    for (const Figure f : outside_shown) csv += hierarchy.outside ? fmt::format(",{}", percent * of(step->from_outside, f)) : "";
    csv += "\n";
  }
  return csv;
}

std::string orders_csv(const FidelityHierarchy& hierarchy) {
  std::string csv = "axis,levels,figure,order\n";
  for (const AxisOrder& axis : hierarchy.orders) {
    const std::string levels = fmt::format("{} {} {}", axis.levels[0], axis.levels[1], axis.levels[2]);
    for (std::size_t i = 0; i < axis.order.size(); ++i) {
      const std::string order = std::isfinite(axis.order[i]) ? fmt::format("{}", axis.order[i]) : std::string("not regular");
      csv += fmt::format("{},{},{},{}\n", axis.axis, levels, name_of(static_cast<Figure>(i)), order);
    }
  }
  return csv;
}

}  // namespace

std::vector<NamedText> hierarchy_tables(const FidelityHierarchy& hierarchy) {
  return {{"accuracy.csv", levels_csv(hierarchy)}, {"accuracy_orders.csv", orders_csv(hierarchy)}};
}

std::string hierarchy_summary(const FidelityHierarchy& hierarchy) {
  const auto share = [](const PerFigure& error, Figure f) { return percent * of(error, f); };
  std::string out = fmt::format("{:<24}  {:<18}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>9}", "level", "axis", "seconds", "TE mean", "TE p-p", "TE 1st",
                                "sigma", "worst, %");
  if (hierarchy.outside) out += "  | from outside: TE mean, p-p, 1st, %";
  out += "\n";
  for (const HierarchyStep* step : all_steps(hierarchy)) {
    const PerFigure& e = step->error;
    out += fmt::format("{:<24}  {:<18}  {:>9.3g}  {:>9.2g}  {:>9.2g}  {:>9.2g}  {:>9.2g}  {:>9.2g}", step->result.level.name, step->result.level.axis,
                       step->result.seconds, share(e, Figure::TeMean), share(e, Figure::TePeakToPeak), share(e, Figure::TeHarmonic1),
                       share(e, Figure::PeakContactStress), percent * largest(e));
    if (hierarchy.outside) {
      out += "  |";
      for (const Figure f : outside_shown) out += fmt::format("  {:>+9.2g}", share(step->from_outside, f));
    }
    out += step->best ? "  *\n" : "\n";
  }
  if (hierarchy.outside) out += fmt::format("outside: {}, at {} positions\n", hierarchy.outside->name, hierarchy.outside->positions);
  return out +
         "* Pareto-best: no other level is both as fast and as accurate; errors in per cent of the finest level, worst over the scenes; seconds of one thread, influence values known\n";
}

}  // namespace flankwright::studies
