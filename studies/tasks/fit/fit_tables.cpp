#include "studies/tasks/fit/fit_tables.hpp"

#include <fmt/format.h>

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

namespace {

std::string coefficients_csv(const FittedCompliance& fit) {
  const FitTable table = fit.to_table();
  std::string csv = "name,value\n";
  for (std::size_t i = 0; i < table.names.size(); ++i) csv += fmt::format("{},{}\n", table.names[i], table.values[i]);
  return csv;
}

/// Calls visit(form, points, distribution) for every line of a table of residuals.
template <class Visit>
void for_each_distribution(const GearFitResult& result, Visit&& visit) {
  for (const FormResiduals& form : result.residuals) {
    for (const ResidualDistribution& d : form.fitted) visit(form.form, "fitted", d);
    for (const ResidualDistribution& d : form.unseen) visit(form.form, "unseen", d);
  }
}

std::string residuals_csv(const std::vector<GearFit>& fits) {
  std::string csv = "gear,form,points,teeth_apart,pairs,median_percent,share_95_percent,worst_percent,worst_percent_of_own\n";
  for (const GearFit& fit : fits) {
    for_each_distribution(fit.result, [&](const std::string& form, const char* points, const ResidualDistribution& d) {
      csv += fmt::format("{},{},{},{},{},{},{},{},{}\n", name_of(fit.member), form, points, d.teeth_apart, d.pairs, percent * d.median(),
                         percent * d.share_95(), percent * d.worst(), percent * d.worst_of_own);
    });
  }
  return csv;
}

std::string curves_csv(const std::vector<GearFit>& fits) {
  std::string csv = "gear,model,load_u,load_zeta,tooth,zeta,value\n";
  for (const GearFit& fit : fits) {
    for (const DeflectionCurve& curve : fit.result.curves) {
      for (std::size_t i = 0; i < curve.zeta.size(); ++i) {
        csv += fmt::format("{},{},{},{},{},{},{}\n", name_of(fit.member), curve.model, curve.load.u, curve.load.zeta, curve.tooth, curve.zeta[i],
                           curve.value[i]);
      }
    }
  }
  return csv;
}

}  // namespace

std::vector<NamedText> fit_tables(const std::vector<GearFit>& fits) {
  std::vector<NamedText> tables;
  for (const GearFit& fit : fits) {
    if (!fit.result.fit.fit) continue;
    tables.push_back({fmt::format("fit_{}.csv", name_of(fit.member)), coefficients_csv(*fit.result.fit.fit)});
  }
  if (fits.empty()) return tables;
  tables.push_back({"fit_residuals.csv", residuals_csv(fits)});
  tables.push_back({"deflection_curves.csv", curves_csv(fits)});
  return tables;
}

std::string fit_summary(const std::vector<GearFit>& fits) {
  std::string out;
  for (const GearFit& fit : fits) {
    const GearFitResult& result = fit.result;
    out += fmt::format("{}: {} after {} steps, {} pairs; {} unknowns, {} loads, {:.0f} s\n", name_of(fit.member), to_string(result.fit.status),
                       result.fit.iterations, result.fit.pairs, result.finite_elements.unknowns, result.loads, fit.seconds);
    out += fmt::format("{:<18}  {:<7}  {:>11}  {:>8}  {:>9}  {:>9}  {:>9}  {:>9}\n", "residuals", "points", "teeth apart", "pairs", "median", "95 %",
                       "worst", "of own");
    for_each_distribution(result, [&](const std::string& form, const char* points, const ResidualDistribution& d) {
      out += fmt::format("{:<18}  {:<7}  {:>11}  {:>8}  {:>7.2f} %  {:>7.2f} %  {:>7.2f} %  {:>7.2f} %\n", form, points, d.teeth_apart, d.pairs,
                         percent * d.median(), percent * d.share_95(), percent * d.worst(), percent * d.worst_of_own);
    });
    out += fmt::format("lowest eigenvalue over {} teeth: {:.2g} of the largest\n", result.eigenvalue_teeth, result.lowest_eigenvalue);
  }
  return out;
}

}  // namespace flankwright::studies
