#include "studies/tasks/sweep/sample_analysis.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

#include "core/contact/unloaded/transmission_error.hpp"
#include "core/rating/shaft_misalignment.hpp"
#include "studies/analysis/case_life.hpp"
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

/// Outputs of unloaded contact, in arcsec.
void add_harmonics(std::vector<double>& values, const std::vector<double>& amplitudes) {
  for (const double amplitude : amplitudes) values.push_back(in_arcsec(amplitude));
}

/// Outputs of a sample beside the entries of cycle_quantities().
struct IsoOutput {
  const char* name;
  double (*value)(const IsoLoadFactors&);
};
constexpr std::array iso_outputs{IsoOutput{"iso6336_K_Hbeta", [](const IsoLoadFactors& iso) { return iso.lead; }},
                                 IsoOutput{"iso6336_K_Halpha", [](const IsoLoadFactors& iso) { return iso.profile; }}};

/// Outputs of life, each where the nominal load case has it. Safeties are those of the more endangered gear by the local stress.
struct LifeOutput {
  const char* name;
  const char* unit;
  double (*value)(const CaseLife&);
  bool smaller_is_worse{true};
};
double least(const PerGear<double>& safety) { return std::fmin(safety.pinion, safety.wheel); }
constexpr std::array life_outputs{
    LifeOutput{"loss_factor", "-", [](const CaseLife& c) { return c.loss_factor; }, false},
    LifeOutput{"loss_power_W", "W", [](const CaseLife& c) { return c.loss_power; }, false},
    LifeOutput{"specific_film_thickness", "-", [](const CaseLife& c) { return c.film; }},
    LifeOutput{"micropitting_safety", "-", [](const CaseLife& c) { return c.micropitting_safety; }},
    LifeOutput{"flash_temperature_K", "K", [](const CaseLife& c) { return c.flash_temperature; }, false},
    LifeOutput{"contact_temperature_degC", "degC", [](const CaseLife& c) { return c.contact_temperature; }, false},
    LifeOutput{"scuffing_safety", "-", [](const CaseLife& c) { return c.scuffing_safety; }},
    LifeOutput{"contact_safety", "-", [](const CaseLife& c) { return least(c.contact_safety); }},
    LifeOutput{"root_safety", "-", [](const CaseLife& c) { return least(c.root_safety); }},
};

/// Largest damage over both kinds of points of a gear, of a whole spectrum.
struct DamageOutput {
  const char* name;
  bool (*of_spectrum)(const SpectrumLife&);  ///< whether the nominal sample has it
  double (*value)(const MeshModel&, const LoadSpectrum&, const LifeModel&);
};

template <Member member>
bool has_contact_damage(const SpectrumLife& spectrum) {
  return spectrum.contact[member].has_value();
}

template <Member member>
bool has_root_damage(const SpectrumLife& spectrum) {
  return spectrum.root[member].has_value();
}

template <Member member>
double largest_contact_damage(const MeshModel& model, const LoadSpectrum& spectrum, const LifeModel& life) {
  double largest = 0.0;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const Eigen::VectorXd damage = contact_damage(model, spectrum, member, *life.strength[member].contact, i);
    if (damage.size() > 0) largest = std::max(largest, damage.maxCoeff());
  }
  return largest;
}

template <Member member>
double largest_root_damage(const MeshModel& model, const LoadSpectrum& spectrum, const LifeModel& life) {
  return root_damage(model, spectrum, member, *life.strength[member].root, fillet_points(model, member)).maxCoeff();
}

constexpr std::array damage_outputs{
    DamageOutput{"pinion_contact_damage", has_contact_damage<Member::Pinion>, largest_contact_damage<Member::Pinion>},
    DamageOutput{"wheel_contact_damage", has_contact_damage<Member::Wheel>, largest_contact_damage<Member::Wheel>},
    DamageOutput{"pinion_root_damage", has_root_damage<Member::Pinion>, largest_root_damage<Member::Pinion>},
    DamageOutput{"wheel_root_damage", has_root_damage<Member::Wheel>, largest_root_damage<Member::Wheel>},
};

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
  for (const LifeOutput& life : life_outputs) {
    has_life_output_.push_back(!std::isnan(life.value(of_nominal)));
    if (has_life_output_.back()) outputs_.push_back({life.name, life.unit, life.smaller_is_worse});
  }
  for (const DamageOutput& damage : damage_outputs) {
    has_damage_.push_back(nominal.life && !nominal.life->spectra.empty() && damage.of_spectrum(nominal.life->spectra.front()));
    if (has_damage_.back()) outputs_.push_back({damage.name, "-"});
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
  for (std::size_t k = 0; k < has_damage_.size(); ++k) {
    if (has_damage_[k]) values.push_back(damage_outputs[k].value(*cases.front().model, spectrum, *life_));
  }
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
  loaded.summary = resolve_cycle(model, loaded.cycle, at, condition, torque, {.seek_extremes = seeks_extremes(study)}).summary;
  const double by_shafts = nominal_.shafts ? shaft_misalignment(shafts_under(*nominal_.shafts, model, torque), model, loaded.cycle) : 0.0;
  const IsoDeviations deviations = iso_deviations(model.pair, condition, by_shafts + rim_opening(nominal_, model, torque));
  loaded.iso = iso_load_factors(model.pair, model.iso, deviations, torque, model.face_width);
  std::vector<double> values;
  for (const CycleEntry& entry : entries_) values.push_back(entry.value(loaded.summary));
  for (const IsoOutput& output : iso_outputs) values.push_back(output.value(loaded.iso));
  if (life_ == nullptr) return values;
  const CaseLife life = case_life(model, *life_, loaded);
  for (std::size_t k = 0; k < life_outputs.size(); ++k) {
    if (has_life_output_[k]) values.push_back(life_outputs[k].value(life));
  }
  return values;
}

std::vector<double> SampleAnalysis::unloaded_outputs(const FlankCondition& condition) const {
  const FlankAssembly scene = assemble_flanks(nominal_.pair, condition);
  const UnloadedMesh mesh = analyse_unloaded_mesh(nominal_.pair, scene, nominal_.study.cycle.positions);
  if (mesh.missing > 0) throw SampleFailure{"no tooth pair touches at " + std::to_string(mesh.missing) + " of the mesh positions"};
  std::vector<double> values{in_arcsec(mesh.peak_to_peak), in_um(mesh.peak_to_peak * nominal_.pair.wheel.base_radius)};
  add_harmonics(values, mesh.harmonics);
  return values;
}

}  // namespace flankwright::studies
