#include "tests/benchmarks/contact_truth/own_answer.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compliance/local/hertz_line.hpp"
#include "core/rating/load_sharing.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright::contact_truth {

double OwnAnswer::share(int tooth) const {
  for (const ToothShare& s : load_sharing(model.positions.front(), loaded)) {
    if (s.tooth == tooth) return s.share;
  }
  return 0;
}

double OwnAnswer::face_load(int tooth, double z) const {
  std::vector<std::pair<double, double>> along;
  const auto& points = model.positions.front().points;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].tooth == tooth) along.emplace_back(points[i].z, loaded.load.line_load[static_cast<Eigen::Index>(i)]);
  }
  if (along.empty()) return 0;
  std::sort(along.begin(), along.end());
  const auto above = std::upper_bound(along.begin(), along.end(), std::pair{z, 0.0});
  const double slant = std::cos(model.pair.base_helix_angle);
  if (above == along.begin()) return above->second / slant;
  if (above == along.end()) return along.back().second / slant;
  const auto below = above - 1;
  return (below->second + (above->second - below->second) * (z - below->first) / (above->first - below->first)) / slant;
}

double OwnAnswer::mean_face_load(int tooth, double begin, double end) const {
  constexpr int samples = 16;
  double sum = 0;
  for (int i = 0; i < samples; ++i) sum += face_load(tooth, begin + (end - begin) * (i + 0.5) / samples);
  return sum / samples;
}

double OwnAnswer::tangent_stress(Member member, int tooth, double z) const {
  const auto& stations = model.positions.front().root_stress.stations;
  double peak = 0;
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const RootStation& s = stations[i];
    if (s.member != member || s.tooth != tooth || !s.tangent || (!std::isnan(z) && s.z != z)) continue;
    peak = std::max(peak, loaded.root_stress[static_cast<Eigen::Index>(i)]);
  }
  return peak;
}

std::vector<double> OwnAnswer::root_places(Member member, int tooth) const {
  std::vector<double> places;
  for (const RootStation& s : model.positions.front().root_stress.stations) {
    if (s.member == member && s.tooth == tooth && s.tangent) places.push_back(s.z);
  }
  return places;
}

double OwnAnswer::peak_stress() const {
  double peak = 0;
  for (Eigen::Index i = 0; i < loaded.contact_stress.size(); ++i) {
    if (loaded.edge_stress.size() == 0 || loaded.edge_stress[i] == 0) peak = std::max(peak, loaded.contact_stress[i]);
  }
  return peak;
}

double OwnAnswer::peak_stress(int tooth) const {
  const auto& points = model.positions.front().points;
  double peak = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].tooth == tooth) peak = std::max(peak, loaded.contact_stress[static_cast<Eigen::Index>(i)]);
  }
  return peak;
}

double OwnAnswer::peak_stress(int tooth, double begin, double end, double times) const {
  const MeshPosition& at = model.positions.front();
  double peak = 0;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    const ContactPoint& point = at.points[i];
    if (point.tooth != tooth || point.z < begin || point.z >= end) continue;
    peak = std::max(peak, at.laws[i].peak_pressure(times * loaded.load.line_load[static_cast<Eigen::Index>(i)]).highest.pressure);
  }
  return peak;
}

OwnAnswer own_answer(const ContactTask& task, double torque, const PairCompliance* structure, const PairRootStress* root_stress) {
  constexpr int intervals = 12;  // of a line; another eight move the transmission error by less than 0.1 %
  OwnAnswer answer{
      make_mesh_model(make_gear_pair(task.pair), {task.material, task.material}, {{QuadratureRule::Graded, intervals}, {task.phase}},
                      task.plane_strain ? MeshEffects::all_but({"free_ends"}) : MeshEffects{},
                      MeshPlacement::of(GapModel::PlaneOfAction, task.condition.misalignment), {.structure = structure, .root_stress = root_stress}),
      {}};
  answer.loaded = analyse_cycle(answer.model, task.condition, torque).positions.front();
  return answer;
}

double hertzian_stress(const ContactTask& task, const LayerLoad& layer) {
  const GearPair pair = make_gear_pair(task.pair);
  const PathOfContact path(pair);
  const auto point = contact_point(pair, path, task.phase, layer.tooth, (layer.begin + layer.end) / 2, true);
  if (!point) return 0;
  const double line_load = layer.force / (layer.end - layer.begin) * std::cos(pair.base_helix_angle);
  return hertz_line(line_load, point->relative_radius, contact_modulus(task.material, task.material)).peak_pressure;
}

double hertzian_peak(const ContactTask& task, const ContactAnswer& answer) {
  double peak = 0;
  for (const LayerLoad& layer : answer.layers) peak = std::max(peak, hertzian_stress(task, layer));
  return peak;
}

}  // namespace flankwright::contact_truth
