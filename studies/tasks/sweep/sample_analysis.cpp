#include "studies/tasks/sweep/sample_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/contact/unloaded/transmission_error.hpp"
#include "core/gear/both_gears.hpp"
#include "core/rating/shaft_misalignment.hpp"
#include "studies/analysis/case_life.hpp"
#include "studies/analysis/film_readings.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/base/json_format.hpp"
#include "studies/study_file/scene_placement.hpp"
#include "studies/study_file/study_life.hpp"
#include "studies/tasks/sweep/sweep_table.hpp"
#include "studies/analysis/rims.hpp"

namespace flankwright::studies {

namespace {

/// Thrown inside a sample that has no outputs; the reason goes into its result.
struct SampleFailure {
  std::string reason;
};

/// Outputs of a sample beside the entries of cycle_quantities().
struct IsoOutput {
  const char* name;
  double (*value)(const IsoLoadFactors&);
};
constexpr std::array iso_outputs{IsoOutput{"iso6336_K_Hbeta", [](const IsoLoadFactors& iso) { return iso.lead; }},
                                 IsoOutput{"iso6336_K_Halpha", [](const IsoLoadFactors& iso) { return iso.profile; }}};

/// Largest damage of a gear over a whole spectrum.
/// @param of_roots  else of its flanks
double largest_damage(const MeshModel& model, const LoadSpectrum& spectrum, const LifeModel& life, bool of_roots, Member member) {
  const FatigueStrength& strength = life.strength[member];
  if (of_roots) return root_damage(model, spectrum, member, *strength.root, fillet_points(model, member)).maxCoeff();
  double largest = 0.0;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Eigen::VectorXd damage = contact_damage(model, spectrum, member, *strength.contact, i);
    if (damage.size() > 0) largest = std::max(largest, damage.maxCoeff());
  }
  return largest;
}

}  // namespace

/// One load case of a sample, solved.
struct SampleAnalysis::SampleCase {
  LoadedResult loaded{};
  const MeshModel* model{nullptr};
};

SampleAnalysis::SampleAnalysis(const StudyResults& nominal) : nominal_(nominal), life_(life_model(nominal.study)) {
  if (!is_loaded()) {
    outputs_ = {{"peak_to_peak_arcsec", "arcsec"}, {"peak_to_peak_um", "um"}};
    for (std::size_t k = 1; k <= nominal.unloaded.front().mesh.harmonics.size(); ++k) {
      outputs_.push_back({"te_harmonic_" + std::to_string(k) + "_arcsec", "arcsec"});
    }
    return;
  }
  for (const CycleEntry& entry : cycle_entries()) {
    if (std::isnan(entry.value(nominal.loaded.front().summary))) continue;  // root stress that nobody asked for, harmonics of given phases
    entries_.push_back(entry);
    outputs_.push_back({entry.key(), entry.quantity->unit.empty() ? "-" : std::string(entry.quantity->unit), entry.quantity->smaller_is_worse});
  }
  for (const IsoOutput& iso : iso_outputs) outputs_.push_back({iso.name, "-"});
  if (life_ == nullptr) return;
  const CaseLife of_nominal = case_life(nominal.models.front(), *life_, nominal.loaded.front());
  for (const LifeQuantity& quantity : life_quantities()) {
    if (!quantity.is_sampled || std::isnan(quantity.worst(of_nominal))) continue;
    life_outputs_.push_back(&quantity);
    outputs_.push_back({std::string(quantity.key), std::string(quantity.unit()), quantity.smaller_is_worse});
  }
  if (!nominal.life || nominal.life->spectra.empty()) return;
  for (const LifeQuantity& quantity : life_quantities()) {
    if (quantity.of_spectrum == nullptr) continue;
    for (const Member m : both_gears) {
      if (!(nominal.life->spectra.front().*quantity.of_spectrum)[m]) continue;
      damages_.push_back({quantity.of_spectrum == &SpectrumLife::root, m});
      outputs_.push_back({std::string(name_of(m)) + "_" + std::string(quantity.key), "-"});
    }
  }
}

SampleResult SampleAnalysis::analyse(const std::vector<double>& values) const {
  const Study& study = nominal_.study;
  try {
    SweptCondition swept = SweptCondition::of(study);
    for (std::size_t j = 0; j < values.size(); ++j) set_swept(swept, study.table<SweepTable>().parameters[j], values[j]);
    if (const auto problems = placement_problems(nominal_.pair, swept.scene.misalignment); !problems.empty()) {
      throw SampleFailure{problems.front().key + ": allowed is " + problems.front().allowed};
    }
    return {"", is_loaded() ? loaded_outputs(swept) : unloaded_outputs(apply_effects(nominal_.effects, swept.flanks()))};
  } catch (const InvalidInput& problem) {
    return {problem.field() + ": allowed is " + problem.allowed(), {}};  // without the value, which the sample has
  } catch (const SampleFailure& failure) {
    return {failure.reason, {}};
  }
}

std::vector<double> SampleAnalysis::loaded_outputs(const SweptCondition& swept) const {
  std::vector<std::vector<double>> of_cases;
  std::vector<SampleCase> cases;
  std::vector<std::unique_ptr<MeshModel>> meshes;
  if (nominal_.study.spectrum.empty()) {
    const double torque = swept.scene.torques.front();
    if (!(torque > 0.0)) throw SampleFailure{"load.torque is 0: without load there are no loaded outputs"};
    SampleCase& only = cases.emplace_back();
    only.loaded.torque = torque;
    only.loaded.operation = nominal_.loaded.front().operation;
    only.loaded.operation.speed = swept.scene.speed;
    of_cases.push_back(case_outputs(only, swept, meshes));
  } else {
    for (const LoadedResult& nominal : nominal_.loaded) {
      const SpectrumBin& bin = nominal_.study.spectrum[static_cast<std::size_t>(nominal.bin)];
      SweptCondition there = swept;
      there.scene = under_load(swept.scene, bin);
      SampleCase& load_case = cases.emplace_back();
      load_case.loaded.torque = nominal.torque;
      load_case.loaded.operation = nominal.operation;
      of_cases.push_back(case_outputs(load_case, there, meshes));
    }
  }
  std::vector<double> values = of_cases.front();
  for (std::size_t k = 0; k < values.size(); ++k) {
    for (const std::vector<double>& of_case : of_cases) {
      values[k] = outputs_[k].smaller_is_worse ? std::fmin(values[k], of_case[k]) : std::fmax(values[k], of_case[k]);
    }
  }
  LoadSpectrum spectrum;
  for (const SampleCase& load_case : cases) spectrum.push_back({&load_case.loaded.cycle, load_case.loaded.operation});
  for (const auto& [of_roots, member] : damages_) values.push_back(largest_damage(*cases.front().model, spectrum, *life_, of_roots, member));
  return values;
}

std::vector<double> SampleAnalysis::case_outputs(SampleCase& of, const SweptCondition& swept, std::vector<std::unique_ptr<MeshModel>>& meshes) const {
  const Study& study = nominal_.study;
  LoadedResult& loaded = of.loaded;
  const double torque = loaded.torque;
  const FlankCondition condition = apply_effects(nominal_.effects, swept.flanks());
  const MeshPlacement placement = placement_of(gap_model(nominal_.effects), condition, nominal_.shafts.get(), torque);
  const bool is_nominal = placement == nominal_.models.front().placement;
  of.model = &nominal_.models.front();
  if (!is_nominal) {
    auto made = std::ranges::find_if(meshes, [&](const auto& mesh) { return mesh->placement == placement; });
    if (made == meshes.end()) {
      made = meshes.insert(
          made,
          std::make_unique<MeshModel>(make_mesh_model(
              nominal_.pair, study.material, {study.fidelity.quadrature, nominal_.phases}, nominal_.mesh_effects, placement,
              {.structure = nominal_.structures.pair.get(), .root_stress = nominal_.structures.root_stress.get(), .shafts = nominal_.shafts.get()})));
    }
    of.model = made->get();
  }
  const MeshModel& model = *of.model;
  loaded.cycle = analyse_cycle(model, condition, torque);
  if (!loaded.cycle.usable()) {
    throw SampleFailure{"the load distribution did not converge at " + std::to_string(loaded.cycle.failures) + " mesh positions"};
  }
  const MeshAt made_at = [&](const std::vector<double>& phases) {
    return make_mesh_model(nominal_.pair, study.material, {study.fidelity.quadrature, phases}, nominal_.mesh_effects, placement,
                           {.structure = nominal_.structures.pair.get(), .shafts = nominal_.shafts.get()});
  };
  const MeshAt mesh_at = is_nominal ? memory_.remembering(made_at) : made_at;
  const MeshWithParameters at = [&](const std::vector<double>& phases, const std::vector<MeshParameter>&) { return mesh_at(phases); };
  CycleResolving resolving{.seek_extremes = seeks_extremes(study)};
  if (life_ != nullptr) resolving.further = film_readings(model, *life_, loaded.operation, loaded.cycle.force);
  loaded.resolved = resolve_cycle(model, loaded.cycle, at, condition, torque, resolving);
  loaded.summary = loaded.resolved.summary;
  if (nominal_.shafts) loaded.shaft_motions = shaft_motions(shafts_under(*nominal_.shafts, model, torque), model, loaded.cycle);
  const double by_shafts = nominal_.shafts ? shaft_misalignment(*nominal_.shafts, loaded.shaft_motions) : 0.0;
  const IsoDeviations deviations = iso_deviations(model.pair, condition, by_shafts + rim_opening(nominal_, model, torque));
  loaded.iso = iso_load_factors(model.pair, model.iso, deviations, torque, model.face_width);
  std::vector<double> values;
  for (const CycleEntry& entry : entries_) values.push_back(entry.value(loaded.summary));
  for (const IsoOutput& output : iso_outputs) values.push_back(output.value(loaded.iso));
  if (life_ == nullptr) return values;
  const CaseLife life = case_life(model, *life_, loaded);
  for (const LifeQuantity* quantity : life_outputs_) values.push_back(quantity->worst(life));
  return values;
}

std::vector<double> SampleAnalysis::unloaded_outputs(const FlankCondition& condition) const {
  const FlankAssembly scene = assemble_flanks(nominal_.pair, condition);
  const UnloadedMesh mesh = analyse_unloaded_mesh(nominal_.pair, scene, nominal_.study.cycle.positions);
  if (mesh.missing > 0) throw SampleFailure{"no tooth pair touches at " + std::to_string(mesh.missing) + " of the mesh positions"};
  std::vector<double> values{in_arcsec(mesh.peak_to_peak), in_um(mesh.peak_to_peak * nominal_.pair.wheel.base_radius)};
  for (const double amplitude : mesh.harmonics) values.push_back(in_arcsec(amplitude));
  return values;
}

}  // namespace flankwright::studies
