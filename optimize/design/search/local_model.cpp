#include "optimize/design/search/local_model.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace flankwright {

namespace {

constexpr std::size_t most_candidates = 400;  // of one peak

AssessedParameter of_error(Member member, const char* name, ModificationParameter removed) {
  return {name_of(member) + std::string(".error.") + name, 1.0, "um", GearParameter{member, removed}, -units::um};
}

/// One step of a parameter in one scene, in internal units.
double step_in(const DesignScene& scene, const AssessedParameter& p) {
  return std::holds_alternative<PinionTorque>(p.parameter) ? p.inside * scene.torque : p.inside;
}

/// Whether the task asks for a sum over load spectra, whose parts are one step of a parameter each: a per cent of the torque differs between load cases.
bool sums_over_spectra(const DesignTask& task) {
  const auto over_spectrum = [](const OutputConstraint& bound) { return design_output(bound.output.output).over_spectrum; };
  const auto is_sum = [](const auto& of) { return of.objective.over_spectrum(); };
  return task.combined_objective().over_spectrum() || std::ranges::any_of(task.constraints, over_spectrum) ||
         std::ranges::any_of(task.objective_bounds, is_sum) || std::ranges::any_of(task.scalarisation, is_sum);
}

/// Multiplies the derivatives of a cycle, a column for each parameter.
void scale_derivatives(LoadedCycle& cycle, const Eigen::VectorXd& by) {
  const auto scale = [&](auto& derivative) {
    if (derivative.cols() == by.size()) derivative = (derivative * by.asDiagonal()).eval();
  };
  scale(cycle.force_derivative);
  for (LoadedPosition& position : cycle.positions) {
    scale(position.gap_derivative);
    scale(position.line_load_derivative);
    scale(position.contact_stress_derivative);
    scale(position.peak_load_derivative);
    scale(position.edge_stress_derivative);
    scale(position.tip_edge_share_derivative);
    scale(position.transmission_error_derivative);
    scale(position.approach_derivative);
    scale(position.root_influence_derivative);
  }
  scale(cycle.face_width_change);
}

}  // namespace

const ObjectiveTerm& term_of(const EpigraphRow& row, const DesignTask& task) {
  const auto index = static_cast<std::size_t>(row.index);
  if (row.kind == EpigraphRow::Kind::OutputBound) return task.constraints[index].output;
  const std::size_t minimised = std::max<std::size_t>(1, task.scalarisation.size()), block = static_cast<std::size_t>(row.objective);
  if (block >= minimised) return task.objective_bounds[block - minimised].objective.terms[index];
  return task.scalarisation.empty() ? task.objective[index] : task.scalarisation[block].objective.terms[index];
}

AssessedParameter parameter_of_variable(const DesignTask& task, int variable, double step) {
  const DesignVariable& v = task.variables[static_cast<std::size_t>(variable)];
  return {v.path, step, v.unit(), GearParameter{v.member, v.parameter}, step / v.outside_factor(), variable};
}

double assessment_step(const std::string& unit) { return unit == "um" ? 1.0 : unit == "mm" ? 0.1 : 0.01; }

std::vector<AssessedParameter> variable_parameters(const DesignTask& task) {
  std::vector<AssessedParameter> parameters;
  for (int i = 0; i < std::ssize(task.variables); ++i) {
    parameters.push_back(parameter_of_variable(task, i, assessment_step(task.variables[static_cast<std::size_t>(i)].unit())));
  }
  return parameters;
}

std::vector<AssessedParameter> tolerance_parameters() {
  std::vector<AssessedParameter> parameters;
  const auto misalignment = [&](const char* name, double step, const char* unit, MisalignmentParameter parameter, double inside) {
    parameters.push_back({std::string("misalignment.") + name, step, unit, parameter, inside});
  };
  misalignment("mesh_misalignment", 1.0, "um", &Misalignment::mesh_misalignment, units::um);
  misalignment("crossing", 0.1, "arcmin", &Misalignment::crossing, 0.1 * units::arcmin);
  misalignment("intersecting", 0.1, "arcmin", &Misalignment::intersecting, 0.1 * units::arcmin);
  misalignment("centre_distance", 0.01, "mm", &Misalignment::centre_distance, 0.01);
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    parameters.push_back(of_error(member, "helix_slope", parameter_of("lead_slope")));
    parameters.push_back(of_error(member, "profile_slope", parameter_of("profile_slope")));
  }
  parameters.push_back({"load.torque", 1.0, "%", PinionTorque{}, 0.01});
  return parameters;
}

std::vector<AssessedParameter> assessed_parameters(const DesignTask& task) {
  std::vector<AssessedParameter> parameters = variable_parameters(task);
  for (AssessedParameter& tolerance : tolerance_parameters()) parameters.push_back(std::move(tolerance));
  return parameters;
}

double LocalModel::Candidate::at(const Eigen::VectorXd& steps) const {
  const double change = slope.dot(steps);
  if (growth == 1.0 || value == 0.0) return value + change;
  return value * std::pow(std::max(0.0, 1.0 + change / (growth * value)), growth);
}

double LocalModel::Peak::at(const Eigen::VectorXd& steps) const {
  if (is_phasor) return sign * std::hypot(candidates[0].at(steps), candidates[1].at(steps)) - limit;
  double largest = -INFINITY;
  for (const Candidate& c : candidates) largest = std::max(largest, c.at(steps));
  return largest - limit;
}

LocalModel::LocalModel(const DesignProblem& problem, const PerGear<Modification>& modification, const std::vector<AssessedParameter>& parameters,
                       const std::vector<ActiveBound>& active)
    : task_(problem.task()),
      parameters_(static_cast<int>(parameters.size())),
      measures_(task_.scenes.size()),
      constraints_(task_.constraints.size(), std::vector<Peak>(task_.scenes.size())),
      multipliers_(std::ssize(active)),
      active_slopes_(Eigen::MatrixXd::Zero(std::ssize(active), parameters_)) {
  for (Eigen::Index a = 0; a < std::ssize(active); ++a) multipliers_[a] = active[static_cast<std::size_t>(a)].multiplier;
  std::vector<MeshParameter> of_mesh;
  for (const AssessedParameter& p : parameters) of_mesh.push_back(p.parameter);
  for (const LinkingConstraint& link : task_.links) of_mesh.push_back(GearParameter{link.linked.member, link.linked.parameter});
  const bool over_spectra = sums_over_spectra(task_);
  DesignAnalysis analysis{modification, std::vector<LoadedCycle>(over_spectra ? task_.scenes.size() : 0)};
  if (over_spectra) {
    tbb::parallel_for(0, problem.scenes(), [&](int s) {
      const auto at = static_cast<std::size_t>(s);
      Eigen::VectorXd steps = Eigen::VectorXd::Ones(std::ssize(of_mesh));
      for (int i = 0; i < parameters_; ++i) steps[i] = step_in(task_.scenes[at], parameters[static_cast<std::size_t>(i)]);
      analysis.cycles[at] = problem.analyse_scene(s, modification, of_mesh);
      scale_derivatives(analysis.cycles[at], steps);
    });
  }
  tbb::parallel_for(0, problem.scenes(), [&](int s) {
    const LoadedCycle alone = over_spectra ? LoadedCycle() : problem.analyse_scene(s, modification, of_mesh);
    const LoadedScene scene = over_spectra ? problem.scene(analysis, s) : problem.scene_of(alone, s);
    const auto slope_of = [&](const Eigen::VectorXd& gradient) {
      Eigen::VectorXd slope = gradient.head(parameters_);
      for (int i = 0; i < parameters_; ++i) {
        const AssessedParameter& p = parameters[static_cast<std::size_t>(i)];
        for (std::size_t t = 0; t < task_.links.size(); ++t) {
          const bool follows = p.variable >= 0 && task_.links[t].as == static_cast<std::size_t>(p.variable);
          if (follows) slope[i] += task_.links[t].factor * gradient[parameters_ + static_cast<Eigen::Index>(t)];
        }
        if (!over_spectra) slope[i] *= step_in(task_.scenes[static_cast<std::size_t>(s)], p);
      }
      return slope;
    };
    const auto peak_of = [&](const ObjectiveTerm& term, double factor, double limit) {
      const DesignOutput& output = design_output(term.output);
      Peak peak{.candidates = {}, .is_phasor = output.has_orders && !term.reciprocal, .sign = factor < 0.0 ? -1.0 : 1.0, .limit = limit};
      constexpr int right_angle = harmonic_directions / 4;
      const std::vector<PeakCandidate> components{{-1, 0}, {-1, right_angle}};
      const double within = 1.0 - std::pow(1.0 - reach, output.growth);  // `reach` of the stress
      for (const PeakCandidate& candidate : peak.is_phasor ? components : leading_candidates(term, scene, within, most_candidates)) {
        const SmoothValue found = candidate_value(term, candidate, scene);
        peak.candidates.push_back({factor * found.value, factor * slope_of(found.gradient), output.load_growth});
      }
      return peak;
    };
    for (const ObjectiveTerm& term : task_.objective) {
      measures_[static_cast<std::size_t>(s)].push_back(peak_of(term, term.weight * term.outside_factor(), 0.0));
    }
    for (std::size_t c = 0; c < task_.constraints.size(); ++c) {
      const OutputConstraint& bound = task_.constraints[c];
      const double sign = bound.is_least() ? -1.0 : 1.0, size = std::abs(bound.limit());
      Peak& peak = constraints_[c][static_cast<std::size_t>(s)];
      peak = peak_of(bound.output, sign / size, sign * bound.limit() / size);
      if (bound.one_suffices() && !peak.is_phasor) peak.candidates.resize(1);  // the leading one is the output: the others are below it, not above
    }
    for (Eigen::Index a = 0; a < std::ssize(active); ++a) {
      const ActiveBound& felt = active[static_cast<std::size_t>(a)];
      if (felt.row.scene != s || felt.by_output == 0.0) continue;
      const SmoothValue found = candidate_value(term_of(felt.row, task_), felt.row.candidate, scene);
      active_slopes_.row(a) = felt.by_output * slope_of(found.gradient).transpose();
    }
  });
}

std::vector<double> LocalModel::scene_measures(const Eigen::VectorXd& steps) const {
  std::vector<double> measures;
  for (const std::vector<Peak>& of_scene : measures_) {
    double sum = 0.0;
    for (const Peak& peak : of_scene) sum += peak.at(steps);
    measures.push_back(sum);
  }
  return measures;
}

double LocalModel::objective(const Eigen::VectorXd& steps) const {
  std::vector<double> weights;
  for (const DesignScene& scene : task_.scenes) weights.push_back(scene.weight);
  return aggregate(task_.over, scene_measures(steps), weights);
}

double LocalModel::violation(const Eigen::VectorXd& steps) const {
  double worst = 0.0;
  for (const std::vector<Peak>& of_output : constraints_) {
    for (const Peak& peak : of_output) worst = std::max(worst, peak.at(steps));
  }
  return worst;
}

}  // namespace flankwright
