#include "studies/tasks/sweep/sample_analysis.hpp"

#include <cmath>

#include "core/contact/unloaded/transmission_error.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

namespace {

/// Thrown inside a sample that has no outputs; the reason goes into its result.
struct SampleFailure {
  std::string reason;
};

void add_harmonics(std::vector<SweepOutput>& outputs, const std::string& unit, std::size_t count) {
  for (std::size_t order = 1; order <= count; ++order) outputs.push_back({"te_harmonic_" + std::to_string(order) + "_" + unit, unit});
}

void add_harmonics(std::vector<double>& values, const std::vector<double>& amplitudes, double (*in_unit)(double)) {
  for (const double amplitude : amplitudes) values.push_back(in_unit(amplitude));
}

bool has_root_stress(const StudyResults& nominal) { return !std::isnan(nominal.loaded.front().summary.peak_root_stress); }

}  // namespace

SampleAnalysis::SampleAnalysis(const StudyResults& nominal) : nominal_(nominal) {
  for (const SweepParameter& p : nominal.study.sweep.parameters) keys_.push_back(study_keys().at(p.path));
  if (!is_loaded()) {
    outputs_ = {{"peak_to_peak_arcsec", "arcsec"}, {"peak_to_peak_um", "um"}};
    add_harmonics(outputs_, "arcsec", nominal.unloaded.front().mesh.harmonics.size());
    return;
  }
  outputs_ = {{"te_peak_to_peak_um", "um"}, {"te_mean_um", "um"}};
  add_harmonics(outputs_, "um", nominal.loaded.front().summary.te_harmonics.size());
  outputs_.insert(outputs_.end(), {{"peak_load_N_per_mm", "N/mm"}, {"peak_contact_stress_MPa", "MPa"}});
  if (has_root_stress(nominal)) {
    outputs_.insert(outputs_.end(), {{"peak_root_stress_MPa", "MPa"}, {"pinion_root_stress_MPa", "MPa"}, {"wheel_root_stress_MPa", "MPa"}});
  }
  outputs_.insert(outputs_.end(), {{"mean_stiffness_N_per_mm_um", "N/(mm um)", true},
                                   {"least_stiffness_N_per_mm_um", "N/(mm um)", true},
                                   {"largest_stiffness_N_per_mm_um", "N/(mm um)", true},
                                   {"load_factor", "-"},
                                   {"iso6336_K_Hbeta", "-"},
                                   {"iso6336_K_Halpha", "-"}});
}

SampleResult SampleAnalysis::analyse(const std::vector<double>& values) const {
  const Study& study = nominal_.study;
  try {
    SweptCondition swept = SweptCondition::of(study);
    for (std::size_t j = 0; j < keys_.size(); ++j) set_swept(swept, *keys_[j], values[j]);
    const FlankCondition condition = apply_effects(nominal_.effects, swept.flanks());
    return {"", is_loaded() ? loaded_outputs(condition, swept.scene.torques.front()) : unloaded_outputs(condition)};
  } catch (const InvalidInput& problem) {
    return {problem.field() + ": allowed is " + problem.allowed(), {}};  // without the value, which stands in the sample
  } catch (const SampleFailure& failure) {
    return {failure.reason, {}};
  }
}

std::vector<double> SampleAnalysis::loaded_outputs(const FlankCondition& condition, double torque) const {
  if (!(torque > 0.0)) throw SampleFailure{"load.torque is 0: without load there are no loaded outputs"};
  const Study& study = nominal_.study;
  const MeshPlacement placement = MeshPlacement::of(gap_model(nominal_.effects), condition.misalignment);
  const MeshModel* model = &nominal_.models.front();
  std::optional<MeshModel> own;
  if (placement != model->placement) {
    own = make_mesh_model(nominal_.pair, study.pinion_material, study.wheel_material, {study.fidelity.quadrature, nominal_.phases},
                          nominal_.mesh_effects, placement, nominal_.structures.pair.get(),
                          nominal_.structures.root_stress.get(), nominal_.shafts.get());
    model = &*own;
  }
  const LoadedCycle cycle = analyse_cycle(*model, condition, torque);
  if (!cycle.usable()) {
    throw SampleFailure{"the load distribution did not converge at " + std::to_string(cycle.failures) + " mesh positions"};
  }
  const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) {
    return make_mesh_model(nominal_.pair, study.pinion_material, study.wheel_material, {study.fidelity.quadrature, phases}, nominal_.mesh_effects,
                           placement, nominal_.structures.pair.get(), nullptr, nominal_.shafts.get());
  };
  const CycleSummary summary = resolve_cycle(*model, cycle, at, condition, torque, {.seek_extremes = seeks_extremes(study)}).summary;
  const IsoLoadFactors iso = iso_load_factors(model->pair, model->iso, iso_deviations(model->pair, condition), torque, model->face_width);
  std::vector<double> values{in_um(summary.te_peak_to_peak), in_um(summary.te_mean)};
  add_harmonics(values, summary.te_harmonics, in_um);
  values.insert(values.end(), {summary.peak_line_load, summary.peak_contact_stress});
  if (has_root_stress(nominal_)) {
    values.insert(values.end(), {summary.peak_root_stress, summary.pinion_root_stress.stress, summary.wheel_root_stress.stress});
  }
  values.insert(values.end(), {summary.mean_stiffness, summary.least_stiffness, summary.largest_stiffness, summary.load_factor, iso.lead,
                               iso.profile});
  return values;
}

std::vector<double> SampleAnalysis::unloaded_outputs(const FlankCondition& condition) const {
  const MeshScene scene = make_mesh_scene(nominal_.pair, condition.misalignment, condition.pinion_modification,
                                          condition.wheel_modification, condition.pinion_error, condition.wheel_error);
  const UnloadedMesh mesh = analyse_unloaded_mesh(nominal_.pair, scene, nominal_.study.cycle.positions);
  if (mesh.missing > 0) throw SampleFailure{"no tooth pair touches at " + std::to_string(mesh.missing) + " of the mesh positions"};
  std::vector<double> values{in_arcsec(mesh.peak_to_peak), in_um(mesh.peak_to_peak * nominal_.pair.wheel.base_radius)};
  add_harmonics(values, mesh.harmonics, in_arcsec);
  return values;
}

}  // namespace flankwright::studies
