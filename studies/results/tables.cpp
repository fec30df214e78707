#include "studies/base/csv.hpp"
#include "studies/results/tables.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "core/fidelity/cycle_quantities.hpp"
#include "studies/results/accuracy_tables.hpp"
#include "studies/results/fit_tables.hpp"
#include "studies/base/json_format.hpp"
#include "studies/results/load_rating_tables.hpp"
#include "studies/results/proof_tables.hpp"
#include "studies/base/plain_names.hpp"
#include "studies/tasks/sweep/sweep_tables.hpp"
#include "studies/results/unloaded_tables.hpp"

namespace flankwright::studies {

namespace {

double in_Nm(double torque) { return torque / units::newton_metre; }

/// Empty where there is no root stress.
std::string root_field(const RootStressPeak& peak) {
  return std::isnan(peak.stress) ? std::string() : fmt::format("{}", peak.stress);
}

std::string cycle_csv(const StudyResults& results) {
  std::string csv = "scene,torque_Nm,design,phase,te_um,te_base_tangent_um,stiffness_N_per_mm_um,kkt_residual,"
                    "pinion_root_stress_MPa,wheel_root_stress_MPa\n";
  const double cos_base_helix = std::cos(results.pair.base_helix_angle);
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    for (std::size_t k = 0; k < loaded.cycle.positions.size(); ++k) {
      const LoadedPosition& p = loaded.cycle.positions[k];
      const double te = in_um(p.load.transmission_error);
      csv += fmt::format("{},{},{},{},{},{},{},{},{},{}\n", csv_field(loaded.scene), in_Nm(loaded.torque), loaded.design,
                         p.phase, te, te / cos_base_helix, p.stiffness, p.load.kkt_residual,
                         root_field(root_stress_peak(model.positions[k], p, Member::Pinion)),
                         root_field(root_stress_peak(model.positions[k], p, Member::Wheel)));
    }
  }
  return csv;
}

std::string points_csv(const StudyResults& results) {
  std::string csv =
      "scene,torque_Nm,design,phase,tooth,z_mm,pinion_radius_mm,wheel_radius_mm,load_N_per_mm,contact_stress_MPa,"
      "contact_deflection_um,structural_deflection_um,gap_um,error_um\n";
  for (const LoadedResult& loaded : results.loaded) {
    const MeshModel& model = results.models[loaded.model];
    for (std::size_t k = 0; k < loaded.cycle.positions.size(); ++k) {
      const LoadedPosition& p = loaded.cycle.positions[k];
      if (!p.load.usable()) continue;
      for (std::size_t j = 0; j < model.positions[k].points.size(); ++j) {
        const ContactPoint& c = model.positions[k].points[j];
        const auto i = static_cast<Eigen::Index>(j);
        csv += fmt::format("{},{},{},{},{},{},{},{},{},{},{},{},{},{}\n", csv_field(loaded.scene), in_Nm(loaded.torque),
                           loaded.design, p.phase, c.tooth, c.z, c.pinion_radius, c.wheel_radius, p.load.line_load[i],
                           p.contact_stress[i], in_um(p.load.contact_deflection[i]), in_um(p.load.structural_deflection[i]),
                           in_um(p.gap.total[i]), in_um(p.gap.error[i]));
      }
    }
  }
  return csv;
}

std::string scenes_csv(const StudyResults& results) {
  std::string csv = "scene,torque_Nm,weight,before,after\n";
  for (std::size_t s = 0; s < results.design_task->scenes.size(); ++s) {
    const DesignScene& scene = results.design_task->scenes[s];
    csv += fmt::format("{},{},{},{},{}\n", csv_field(scene.name), in_Nm(scene.torque), scene.weight,
                       results.design->before.scene_measures[s], results.design->after.scene_measures[s]);
  }
  return csv;
}

std::string history_csv(const DesignResult& design) {
  std::string csv = "evaluation,objective,constraint_violation\n";
  for (const SolverStep& step : design.history) {
    csv += fmt::format("{},{},{}\n", step.evaluation, step.objective, step.constraint_violation);
  }
  return csv;
}

std::string pareto_csv(const ParetoFront& front, const DesignTask& task) {
  std::string csv;
  for (const Goal& goal : front.goals) csv += csv_field(goal.name() + " [" + goal.unit() + "]") + ",";
  for (const DesignVariable& v : task.variables) csv += csv_field(v.path + " [" + v.unit() + "]") + ",";
  csv += "status,dominated\n";
  for (const ParetoPoint& point : front.points) {
    for (double value : point.values) csv += fmt::format("{},", value);
    for (std::size_t i = 0; i < task.variables.size(); ++i) {
      const DesignVariable& v = task.variables[i];
      csv += fmt::format("{},", v.unscaled(point.x[static_cast<Eigen::Index>(i)]) * v.outside_factor());
    }
    csv += fmt::format("{},{}\n", to_string(point.status), point.dominated ? "yes" : "no");
  }
  return csv;
}

std::size_t widest(const std::vector<std::string>& names, std::size_t least) {
  std::size_t width = least;
  for (const std::string& name : names) width = std::max(width, name.size());
  return width;
}

std::string change(double before, double after) {
  return before != 0.0 ? fmt::format("{:+.1f} %", 100.0 * (after / before - 1.0)) : std::string("-");
}

/// "± 0.012", two digits; empty where no error was estimated.
std::string known_to(double error) { return std::isnan(error) ? std::string() : fmt::format("± {:.2g}", error); }

/// A line below a row of figures: how far they are from those of infinitely many points and positions.
std::string error_row(std::size_t width, double before, double after) {
  if (std::isnan(before) && std::isnan(after)) return {};
  return fmt::format("{:<{}}  {:>12}  {:>12}\n", "  known to", width, known_to(before), known_to(after));
}

std::string design_table(const StudyResults& results) {
  const DesignTask& task = *results.design_task;
  const DesignResult& design = *results.design;
  std::vector<std::string> names;
  for (const DesignVariable& v : task.variables) names.push_back(plain_name(v.path));
  std::set<double> torques;
  for (const DesignScene& s : task.scenes) torques.insert(s.torque);
  const auto label = [&](const DesignScene& s) {
    return torques.size() > 1 ? fmt::format("{}, {:.5g} N·m", s.name, in_Nm(s.torque)) : s.name;
  };
  for (const DesignScene& s : task.scenes) names.push_back(label(s));
  const std::size_t width = widest(names, 24);

  std::string out = fmt::format("{:<{}}  {:>12}  {:>12}  {:>9}\n", "", width, "before", "after", "change");
  for (std::size_t i = 0; i < task.variables.size(); ++i) {
    const DesignVariable& v = task.variables[i];
    out += fmt::format("{:<{}}  {:>12.2f}  {:>12.2f}  {:>9}\n", plain_name(v.path), width, design.before.variables[i] * v.outside_factor(),
                       design.after.variables[i] * v.outside_factor(), v.unit());
  }
  out += fmt::format("\n{} [{}]\n", plain_name(task.objective_name()), task.objective_unit());
  for (std::size_t s = 0; s < task.scenes.size(); ++s) {
    const double before = design.before.scene_measures[s], after = design.after.scene_measures[s];
    out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n", label(task.scenes[s]), width, before, after, change(before, after));
  }
  out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n", "over the scenes", width, design.before.objective,
                     design.after.objective, change(design.before.objective, design.after.objective));
  out += error_row(width, results.before_errors.objective, results.after_errors.objective);
  for (std::size_t c = 0; c < task.constraints.size(); ++c) {
    const ObjectiveTerm& output = task.constraints[c].output;
    const OutputConstraint& bound = task.constraints[c];
    out += fmt::format("{:<{}}  {:>12.5g}  {:>12.5g}  {:>9}\n",
                       fmt::format("{} {} {:.5g} {}", plain_name(output.name), bound.is_least() ? ">=" : "<=", bound.limit() * output.outside_factor(), output.unit()),
                       width, design.before.constraint_values[c] * output.outside_factor(),
                       design.after.constraint_values[c] * output.outside_factor(), "");
    if (c < results.after_errors.constraint_values.size()) {
      out += error_row(width, results.before_errors.constraint_values[c] * output.outside_factor(),
                       results.after_errors.constraint_values[c] * output.outside_factor());
    }
  }
  out += fmt::format("\n{}: {} after {} analyses of {} scenes in {:.1f} s\n", design.solver, to_string(design.status),
                     design.evaluations, task.scenes.size(), design.seconds);
  if (results.search_work) {
    const SearchWork& work = *results.search_work;
    const auto level = [&](const LevelWork& w) {
      const double cycles = static_cast<double>(w.analyses) * static_cast<double>(task.scenes.size());
      return fmt::format("{:.0f} cycles of {} intervals and {} positions, {:.2g} ms each", cycles, w.resolution.quadrature.intervals,
                         w.resolution.phases.size(), 1e3 * w.seconds / cycles);
    };
    const bool two = work.search.resolution.quadrature.intervals != work.fine.resolution.quadrature.intervals;
    out += two ? fmt::format("searched by {}; finished by {}\n", level(work.search), level(work.fine)) : level(work.fine) + "\n";
  }
  // Other designs are judged at the positions: so is, beside them, the optimum.
  const double compared = results.search_work ? results.search_work->objective_at_positions : design.after.objective;
  return results.proof ? out + proof_summary(*results.proof, task, compared) : out;
}

/// The entries of cycle_quantities() that have a column, as far as any load case has them; below each case how well it is known.
std::string loaded_table(const std::vector<LoadedResult>& cases, std::size_t width) {
  std::vector<CycleEntry> columns;
  for (const CycleEntry& entry : cycle_entries()) {
    const bool is_known = std::ranges::any_of(cases, [&](const LoadedResult& l) { return !std::isnan(entry.value(l.summary)); });
    if (!entry.quantity->heading.empty() && entry.order <= 1 && is_known) columns.push_back(entry);
  }
  const auto line = [&](const std::string& name, const std::string& torque, const auto& cell) {
    std::string text = fmt::format("{:<{}}  {:>10}", name, width, torque);
    for (const CycleEntry& column : columns) text += fmt::format("  {:>10}", cell(column));
    return text + "\n";
  };
  std::string out = line("loaded", "torque", [](const CycleEntry& column) { return std::string(column.quantity->heading); }) +
                    line("", "N·m", [](const CycleEntry& column) { return std::string(column.quantity->unit); });
  for (const LoadedResult& l : cases) {
    out += line(l.scene, fmt::format("{:.6g}", in_Nm(l.torque)),
                [&](const CycleEntry& column) { return fmt::format("{:.{}f}", column.value(l.summary), column.quantity->decimals); });
    const CycleErrors& errors = l.resolved.errors;
    if (std::isnan(errors.te_peak_to_peak)) continue;
    out += line("  known to", "", [&](const CycleEntry& column) { return known_to(column.error(errors)); });
  }
  return out;
}

std::string analysis_table(const StudyResults& results) {
  std::string out;
  std::vector<std::string> names;
  for (const LoadedResult& l : results.loaded) names.push_back(l.scene);
  for (const UnloadedResult& u : results.unloaded) names.push_back(u.scene);
  const std::size_t width = widest(names, 12);
  if (!results.loaded.empty()) out += loaded_table(results.loaded, width);
  return out + load_factors_table(results, width) + unloaded_summary(results, width);
}

}  // namespace

std::vector<NamedText> csv_tables(const StudyResults& results) {
  std::vector<NamedText> tables;
  if (!results.loaded.empty()) {
    tables.push_back({"cycle.csv", cycle_csv(results)});
    tables.push_back({"points.csv", points_csv(results)});
    tables.push_back({"load_factors.csv", load_factors_csv(results)});
    tables.push_back({"load_sharing.csv", load_sharing_csv(results)});
  }
  if (!results.unloaded.empty()) {
    tables.push_back({"unloaded.csv", unloaded_csv(results)});
    tables.push_back({"transfers.csv", transfers_csv(results)});
    tables.push_back({"bearing_pattern.csv", bearing_pattern_csv(results)});
  }
  if (results.design) {
    tables.push_back({"scenes.csv", scenes_csv(results)});
    tables.push_back({"history.csv", history_csv(*results.design)});
    if (results.front) tables.push_back({"pareto.csv", pareto_csv(*results.front, *results.design_task)});
  }
  if (results.proof) {
    for (NamedText& table : proof_tables(*results.proof)) tables.push_back(std::move(table));
  }
  if (results.ladder) {
    for (NamedText& table : ladder_tables(*results.ladder)) tables.push_back(std::move(table));
  }
  for (NamedText& table : sweep_tables(results)) tables.push_back(std::move(table));
  for (NamedText& table : fit_tables(results.fits)) tables.push_back(std::move(table));
  return tables;
}

std::string summary_table(const StudyResults& results) {
  if (!results.fits.empty()) return fit_summary(results.fits);
  if (results.sweep) return "nominal sample\n" + analysis_table(results) + "\n" + sweep_summary(results);
  if (results.ladder) return ladder_summary(*results.ladder);
  const std::string chosen = results.fidelity_choice ? fidelity_choice_summary(*results.fidelity_choice) : std::string();
  return chosen + (results.design ? design_table(results) : analysis_table(results));
}

}  // namespace flankwright::studies
