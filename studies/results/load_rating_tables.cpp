#include "studies/base/json_format.hpp"
#include "studies/base/csv.hpp"
#include "studies/results/load_case_fields.hpp"
#include "studies/results/load_rating_tables.hpp"
#include "studies/base/json_format.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "core/rating/load_sharing.hpp"

namespace flankwright::studies {

namespace {

/// One way to define the factors; NaN where a case has no value by it.
struct Definition {
  const char* name;
  const char* label;
  std::array<double, 4> (*values)(const LoadedResult&);  ///< K_Hbeta, K_Halpha, K_H, the product of the first two
};

std::array<double, 4> values_of(const std::optional<LoadRating>& rating, LoadFactors::Triple LoadFactors::*which) {
  const LoadFactors::Triple factors = rating ? rating->factors.*which : LoadFactors::Triple{};
  return {factors.lead, factors.profile, factors.combined, factors.product()};
}

constexpr std::array<Definition, 4> definitions{{
    {"without_spikes", "without spikes", [](const LoadedResult& l) { return values_of(l.rating, &LoadFactors::without_spikes); }},
    {"with_spikes", "with spikes", [](const LoadedResult& l) { return values_of(l.rating, &LoadFactors::with_spikes); }},
    {"line_load", "line load", [](const LoadedResult& l) { return values_of(l.rating, &LoadFactors::line_load); }},
    {"iso6336", "ISO 6336",
     [](const LoadedResult& l) {
       return std::array{l.iso.lead, l.iso.profile, l.iso.combined(), l.iso.combined()};
     }},
}};

}  // namespace

std::string load_factors_csv(const StudyResults& results) {
  std::string csv = std::string(load_case_columns) + ",definition,K_Hbeta,K_Halpha,K_H,K_Hbeta_times_K_Halpha\n";
  for (const LoadedResult& loaded : results.loaded) {
    for (const Definition& definition : definitions) {
      const auto k = definition.values(loaded);
      csv += fmt::format("{},{},{},{},{},{}\n", load_case_fields(loaded), definition.name, csv_field(k[0]), csv_field(k[1]), csv_field(k[2]),
                         csv_field(k[3]));
    }
  }
  return csv;
}

std::string load_sharing_csv(const StudyResults& results) {
  std::string csv = std::string(load_case_columns) + ",phase,tooth,line_phase,share\n";
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    const std::string load_case = load_case_fields(loaded);
    for (std::size_t k = 0; k < loaded.cycle.positions.size(); ++k) {
      const double phase = loaded.cycle.positions[k].phase;
      for (const ToothShare& tooth : load_sharing(model.positions[k], loaded.cycle.positions[k])) {
        csv += fmt::format("{},{},{},{},{}\n", load_case, phase, tooth.tooth, phase + tooth.tooth, tooth.share);
      }
    }
  }
  return csv;
}

std::string load_factors_table(const StudyResults& results, std::size_t width) {
  if (std::ranges::none_of(results.loaded, [](const LoadedResult& l) { return l.rating.has_value(); })) return {};
  std::string out = fmt::format("\n{:<{}}  {:>10}  {:<14}  {:>8}  {:>8}  {:>8}  {:>15}\n", "load factors", width, "torque", "by", "K_Hbeta",
                                "K_Halpha", "K_H", "K_Hbeta*K_Halpha") +
                    fmt::format("{:<{}}  {:>10}\n", "", width, "N·m");
  for (const LoadedResult& loaded : results.loaded) {
    for (const Definition& definition : definitions) {
      const auto k = definition.values(loaded);
      const auto shown = [](double factor) { return std::isnan(factor) ? std::string("-") : fmt::format("{:.3f}", factor); };
      out += fmt::format("{:<{}}  {:>10.6g}  {:<14}  {:>8}  {:>8}  {:>8}  {:>15}\n", loaded.scene, width, in_Nm(loaded.torque), definition.label,
                         shown(k[0]), shown(k[1]), shown(k[2]), shown(k[3]));
    }
  }
  return out;
}

}  // namespace flankwright::studies
