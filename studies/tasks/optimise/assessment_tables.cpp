#include "studies/base/csv.hpp"
#include "studies/tasks/optimise/assessment_tables.hpp"
#include "studies/base/plain_names.hpp"

#include <fmt/format.h>

namespace flankwright::studies {

namespace {

std::string comparison_csv(const Assessment& assessment) {
  std::string csv = "design,objective,constraint_violation,failure,basis\n";
  const auto add = [&](const ComparedDesign& d, const std::string& name) {
    csv += fmt::format("{},{},{},{},{}\n", csv_field(name), d.objective, d.constraint_violation, csv_field(d.failure), csv_field(d.design.basis));
  };
  for (const ComparedDesign& rule : assessment.rules) add(rule, rule.design.name);
  for (const VariantSearch& search : assessment.variants) {
    if (search.x.size() > 0) add(search.best, fmt::format("best of {} variants, {}", search.tried, to_string(search.placement)));
  }
  return csv;
}

std::string sensitivity_csv(const std::vector<Sensitivity>& sensitivities) {
  std::string csv = "quantity,step,unit,less,more,more_optimised_anew,intervals\n";
  for (const Sensitivity& s : sensitivities) {
    const std::string anew = s.parameter.variable < 0 ? fmt::format("{}", s.optimised_anew) : "";
    csv += fmt::format("{},{},{},{},{},{},{}\n", csv_field(s.parameter.name), s.parameter.step, s.parameter.unit, s.less, s.more, anew, s.intervals);
  }
  return csv;
}

std::string validation_csv(const Validation& validation) {
  std::string csv = "draw";
  for (const ValidatedDesign& design : validation.designs) csv += fmt::format(",{}", csv_field(design.name));
  csv += "\n";
  for (std::size_t i = 0; i < validation.draws.size(); ++i) {
    csv += csv_field(validation.draws[i]);
    for (const ValidatedDesign& design : validation.designs) csv += fmt::format(",{}", design.measures[i]);
    csv += "\n";
  }
  return csv;
}

}  // namespace

std::vector<NamedText> assessment_tables(const Assessment& assessment) {
  std::vector<NamedText> tables;
  if (!assessment.rules.empty() || !assessment.variants.empty()) tables.push_back({"comparison.csv", comparison_csv(assessment)});
  if (assessment.optimum) tables.push_back({"sensitivity.csv", sensitivity_csv(assessment.sensitivities)});
  if (assessment.validation) tables.push_back({"validation.csv", validation_csv(*assessment.validation)});
  return tables;
}

std::string assessment_summary(const Assessment& assessment, const DesignTask& task, double optimum) {
  const std::string validation = assessment.validation ? validation_in_words(*assessment.validation, task) + "\n" : "";
  const std::string is_of = assessed_design_in_words(assessment.is_of);
  // The listed scenes did not choose a design over draws: rules of thumb are held against their own optimum.
  const bool is_of_listed = assessment.is_of == AssessedDesign::WithoutScatter;
  const std::string heading = is_of.empty() ? "" : "of " + is_of + ":\n";
  std::string out = is_of_listed ? validation + heading : "";
  const std::string of_list = task.later_objectives.empty() ? "" : plain_name(task.objective_name()) + " ";  // it is the first that is compared
  const auto beside = [&](const std::string& what, double value) {
    if (!(optimum > 0.0)) {
      out += fmt::format("{}: {}{:.5g}{}\n", what, of_list, value, behind_number(task.objective_unit()));
      return;
    }
    const double times = value / optimum;
    out += fmt::format("{}: {}{:.5g}{} ({})\n", what, of_list, value, behind_number(task.objective_unit()),
                       times < 10.0 ? fmt::format("{:+.1f} %", 100.0 * (times - 1.0)) : fmt::format("{:.3g} times the optimum", times));
  };
  if (const ComparedDesign* best = best_of(assessment.rules)) {
    beside("best rule of thumb, " + best->design.name, best->objective);
    constexpr double better = 0.99;  // of the optimum: less is within what steps and resolution change
    if (best->objective < better * optimum) {
      // A search goes on from the rules that its variables reach, see OptimiseSearch::take_better_rule().
      out += assessment.out_of_reach.empty()
                 ? "that rule of thumb is better than the design found, which is a local optimum: more optimise.starts may find a better one\n"
                 : fmt::format("that rule of thumb is better than the design found; it has what the variables do not reach: {}\n",
                               fmt::join(assessment.out_of_reach, ", "));
    }
  } else if (!assessment.rules.empty()) {
    out += no_rule_in_words(assessment.rules) + "\n";
  }
  for (const VariantSearch& search : assessment.variants) {
    const std::string name = fmt::format("best of {} variants, {}", search.tried, to_string(search.placement));
    if (search.x.size() > 0) beside(name, search.best.objective);
  }
  if (!is_of_listed) out += validation;
  if (assessment.relaxation) {
    out += "no feasible design found:\n";
    for (const std::string& sentence : relaxation_in_words(*assessment.relaxation, task)) out += sentence + "\n";
  }
  if (!assessment.optimum) return out;
  const std::vector<std::string> sentences = optimum_in_words(*assessment.optimum, *assessment.judged);
  if (!is_of_listed && (!sentences.empty() || assessment.usual)) out += heading;
  for (const std::string& sentence : sentences) out += sentence + "\n";
  if (assessment.usual) out += usual_signs_in_words(*assessment.usual, *assessment.judged) + "\n";
  return out;
}

}  // namespace flankwright::studies
