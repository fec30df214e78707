#include "studies/analysis/spectrum_life.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "core/gear/both_gears.hpp"
#include "core/rating/sliding_loss.hpp"
#include "studies/study_file/study_life.hpp"

namespace flankwright::studies {

namespace {

/// How far the largest contact stress of the mesh positions, which damage is made of, may be below that of the whole cycle and its error [-].
double contact_stress_error(const LoadedResult& loaded) {
  double of_positions = 0.0;
  for (const LoadedPosition& position : loaded.cycle.positions) of_positions = std::max(of_positions, position.contact_stress.maxCoeff());
  return (loaded.summary.peak_contact_stress + loaded.resolved.errors.peak_contact_stress) / of_positions - 1.0;
}

double root_stress_error(const LoadedResult& loaded) { return loaded.resolved.errors.peak_root_stress / loaded.summary.peak_root_stress; }

/// Of one point of the fillet, over the cycle [MPa].
double largest_root_stress(const LoadedCycle& cycle, const FilletPoints& points, Eigen::Index point) {
  double largest = 0.0;
  for (const FilletPoints::Pass& pass : points.passes) {
    largest = std::max(largest, cycle.positions[pass.position].root_stress[pass.begin + point]);
  }
  return largest;
}

/// One spectrum of the results while its damage is found.
class SpectrumRating {
 public:
  SpectrumRating(const StudyResults& results, const LifeModel& life, std::vector<CaseLife>& cases, SpectrumLife& spectrum)
      : results_(results), life_(life), cases_(cases), spectrum_(spectrum), model_(results.models[loaded(0).model]) {
    for (std::size_t k = 0; k < spectrum.cases.size(); ++k) loads_.push_back({&loaded(k).cycle, loaded(k).operation});
  }

  void rate() {
    for (const Member m : both_gears) {
      if (life_.strength[m].contact) rate_flank(m, *life_.strength[m].contact);
      if (life_.strength[m].root && has_root_stress()) rate_root(m, *life_.strength[m].root);
    }
  }

 private:
  const LoadedResult& loaded(std::size_t k) const { return results_.loaded[cases_[spectrum_.cases[k]].loaded]; }

  bool has_root_stress() const {
    return std::ranges::all_of(loads_, [](const SpectrumCase& c) { return c.cycle->positions.front().root_stress.size() > 0; });
  }

  /// Damage of one load case at a stress that is larger by its relative error, less that at the stress.
  double added_damage(Member m, std::size_t k, const SnCurve& curve, double stress, double relative_error) const {
    if (std::isnan(relative_error)) return not_given;
    const double cycles = load_cycles(model_.pair, m, loads_[k].operation);
    return cycles * (curve.damage(stress * (1.0 + relative_error)).value - curve.damage(stress).value);
  }

  void rate_flank(Member m, const SnCurve& curve) {
    DamagedPoint worst;
    std::size_t at_position = 0, entry = 0;
    Eigen::Index at_point = 0;
    const bool is_new = spectrum_.map.empty();
    for (std::size_t i = 0; i < model_.positions.size(); ++i) {
      const Eigen::VectorXd damage = contact_damage(model_, loads_, m, curve, i);
      for (Eigen::Index j = 0; j < damage.size(); ++j, ++entry) {
        const ContactPoint& point = model_.positions[i].points[static_cast<std::size_t>(j)];
        if (is_new) spectrum_.map.push_back({point.z, point.pinion_radius, point.wheel_radius, model_.positions[i].phase, point.tooth});
        spectrum_.map[entry].damage[m] = damage[j];
        if (!(damage[j] > worst.damage)) continue;
        worst.damage = damage[j];
        worst.z = point.z;
        worst.radius = m == Member::Pinion ? point.pinion_radius : point.wheel_radius;
        at_position = i;
        at_point = j;
      }
    }
    worst.gradient = contact_damage_at(model_, loads_, m, curve, at_position, at_point).gradient;
    worst.damage_error = 0.0;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      cases_[spectrum_.cases[k]].contact_damage[m] = contact_damage_at(model_, {loads_[k]}, m, curve, at_position, at_point).value;
      const SnCurve of_case = curve.of_stress_times(loads_[k].operation.contact_overload());
      const double stress = loads_[k].cycle->positions[at_position].contact_stress[at_point];
      worst.damage_error += added_damage(m, k, of_case, stress, contact_stress_error(loaded(k)));
      worst.exceeds_static_limit = worst.exceeds_static_limit || loaded(k).summary.peak_contact_stress > of_case.static_limit;
    }
    spectrum_.contact[m] = worst;
  }

  void rate_root(Member m, const SnCurve& curve) {
    const FilletPoints points = fillet_points(model_, m);
    if (points.count == 0) return;
    const Eigen::VectorXd damage = root_damage(model_, loads_, m, curve, points);
    Eigen::Index at = 0;
    DamagedPoint worst;
    worst.damage = damage.maxCoeff(&at);
    const FilletPoints::Pass& pass = points.passes.front();
    const RootStation& station = model_.positions[pass.position].root_stress.stations[static_cast<std::size_t>(pass.begin + at)];
    worst.z = station.z;
    worst.along = station.along;
    worst.gradient = root_damage_at(model_, loads_, m, curve, points, at).gradient;
    worst.damage_error = 0.0;
    for (std::size_t k = 0; k < loads_.size(); ++k) {
      cases_[spectrum_.cases[k]].root_damage[m] = root_damage(model_, {loads_[k]}, m, curve, points)[at];
      const CycleSummary& summary = loaded(k).summary;
      const SnCurve of_case = curve.of_stress_times(loads_[k].operation.overload());
      worst.damage_error += added_damage(m, k, of_case, largest_root_stress(*loads_[k].cycle, points, at), root_stress_error(loaded(k)));
      const RootStressPeak& root = m == Member::Pinion ? summary.pinion_root_stress : summary.wheel_root_stress;
      worst.exceeds_static_limit = worst.exceeds_static_limit || root.stress > of_case.static_limit;
    }
    spectrum_.root[m] = worst;
  }

  const StudyResults& results_;
  const LifeModel& life_;
  std::vector<CaseLife>& cases_;
  SpectrumLife& spectrum_;
  const MeshModel& model_;
  LoadSpectrum loads_;
};

/// Load cases of one scene and design, in their order.
std::vector<SpectrumLife> spectra_of(const StudyResults& results, const std::vector<CaseLife>& cases) {
  std::vector<SpectrumLife> spectra;
  for (std::size_t c = 0; c < cases.size(); ++c) {
    const LoadedResult& loaded = results.loaded[cases[c].loaded];
    if (loaded.bin < 0) continue;
    const auto same = [&](const SpectrumLife& s) { return s.scene == loaded.scene && s.design == loaded.design; };
    auto found = std::ranges::find_if(spectra, same);
    if (found == spectra.end()) found = spectra.insert(spectra.end(), {loaded.scene, loaded.design, {}, {}, {}, {}});
    found->cases.push_back(c);
  }
  return spectra;
}

/// Whether the points of two meshes are the same points of the flanks. They are where only the shafts lie differently under each load.
bool have_same_points(const MeshModel& one, const MeshModel& other) {
  const auto same = [](const ContactPoint& a, const ContactPoint& b) {
    return a.tooth == b.tooth && a.z == b.z && a.pinion_radius == b.pinion_radius;
  };
  return &one == &other || std::ranges::equal(one.positions, other.positions, [&](const MeshPosition& a, const MeshPosition& b) {
    return std::ranges::equal(a.points, b.points, same) && a.root_stress.stations.size() == b.root_stress.stations.size();
  });
}

/// Why the damage of a spectrum has no sum; nothing where it has: all load cases were solved, and their meshes have the same points.
std::optional<std::string> why_not_summed(const StudyResults& results, const std::vector<CaseLife>& cases, const SpectrumLife& spectrum) {
  const auto model_of = [&](std::size_t c) -> const MeshModel& { return results.models[results.loaded[cases[c].loaded].model]; };
  if (std::ssize(spectrum.cases) != results.loaded[cases[spectrum.cases.front()].loaded].spectrum_loads)
    return "not all of its load cases were solved";
  const MeshModel& first = model_of(spectrum.cases.front());
  if (std::ranges::all_of(spectrum.cases, [&](std::size_t c) { return have_same_points(model_of(c), first); })) return std::nullopt;
  return "its load cases move the points of contact on the flanks, as fidelity.gap = \"whole_surface\" follows them";
}

}  // namespace

std::optional<StudyLife> study_life(const StudyResults& results, const CoarseCycleOf& coarse_of) {
  const std::shared_ptr<const LifeModel> life = life_model(results.study);
  if (life == nullptr || results.loaded.empty()) return std::nullopt;
  StudyLife found;
  found.ohlendorf = ohlendorf_loss_factor(results.pair);
  for (std::size_t i = 0; i < results.loaded.size(); ++i) {
    if (results.loaded[i].cycle.usable()) found.cases.emplace_back().loaded = i;
  }
  tbb::parallel_for(std::size_t{0}, found.cases.size(), [&](std::size_t c) {
    const std::size_t number = found.cases[c].loaded;
    const LoadedResult& loaded = results.loaded[number];
    const std::optional<CoarseCycle> coarse = coarse_of ? coarse_of(loaded) : std::nullopt;
    found.cases[c] = case_life(results.models[loaded.model], *life, loaded, coarse ? &*coarse : nullptr);
    found.cases[c].loaded = number;
  });
  found.spectra = spectra_of(results, found.cases);
  std::erase_if(found.spectra, [&](const SpectrumLife& spectrum) {
    const std::optional<std::string> why = why_not_summed(results, found.cases, spectrum);
    if (why) found.not_summed.insert("the damage of the load spectrum in the scene \"" + spectrum.scene + "\" is not summed: " + *why);
    return why.has_value();
  });
  for (SpectrumLife& spectrum : found.spectra) SpectrumRating(results, *life, found.cases, spectrum).rate();
  return found;
}

}  // namespace flankwright::studies
