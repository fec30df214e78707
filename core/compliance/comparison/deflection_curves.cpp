#include "core/compliance/comparison/deflection_curves.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "core/compliance/tooth/station_grid.hpp"

namespace flankwright {
namespace {

/// The nodes and points between them, at most kCurveStep apart: a curve to draw. Mid face is among the points.
std::vector<double> subdivided(const std::vector<double>& nodes) {
  constexpr double kCurveStep = 0.25;  // [m_n]
  std::vector<double> stations;
  for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
    const double step = nodes[i + 1] - nodes[i];
    const int pieces = 2 * static_cast<int>(std::ceil(0.5 * step / kCurveStep));
    for (int k = 0; k < pieces; ++k) stations.push_back(nodes[i] + step * k / pieces);
  }
  stations.push_back(nodes.back());
  return stations;
}

}  // namespace

NamedModel named_model(std::string name, int teeth_apart, const FlankCompliance& compliance) {
  return {std::move(name), teeth_apart, [&compliance](std::span<const FlankStation> stations, std::span<const FlankStation> loads) {
            const auto columns = static_cast<Eigen::Index>(loads.size());
            Eigen::MatrixXd result(static_cast<Eigen::Index>(stations.size()), columns);
            // Tooth by tooth: teeth on either side of the load are further apart than a model needs to cover.
            for (auto first = stations.begin(); first != stations.end();) {
              const auto last = std::find_if(first, stations.end(), [&](const FlankStation& station) { return station.tooth != first->tooth; });
              std::vector<FlankStation> all(first, last);
              all.insert(all.end(), loads.begin(), loads.end());
              const Eigen::Index rows = last - first;
              result.middleRows(first - stations.begin(), rows) = compliance.evaluate(all).topRightCorner(rows, columns);
              first = last;
            }
            return result;
          }};
}

std::vector<DeflectionCurve> deflection_curves(std::span<const NamedModel> models, const std::vector<double>& us,
                                               const std::vector<double>& load_zetas, const std::vector<double>& zetas, int teeth_apart) {
  std::vector<DeflectionCurve> curves;
  for (const double u : us) {
    std::vector<FlankStation> loads;
    for (const double zeta : load_zetas) loads.push_back({0, u, zeta});
    std::vector<std::vector<DeflectionCurve>> by_load(loads.size());
    for (const NamedModel& model : models) {
      const int reach = std::min(teeth_apart, model.teeth_apart);
      std::vector<FlankStation> stations;
      for (int tooth = -reach; tooth <= reach; ++tooth) {
        for (const double zeta : zetas) stations.push_back({tooth, u, zeta});
      }
      const Eigen::MatrixXd K = model.deflections(stations, loads);
      for (std::size_t q = 0; q < loads.size(); ++q) {
        const double* value = K.col(static_cast<Eigen::Index>(q)).data();
        for (int tooth = -reach; tooth <= reach; ++tooth, value += zetas.size()) {
          by_load[q].push_back({model.name, loads[q], tooth, zetas, {value, value + zetas.size()}});
        }
      }
    }
    for (auto& some : by_load) std::move(some.begin(), some.end(), std::back_inserter(curves));
  }
  return curves;
}

std::vector<DeflectionCurve> gear_deflection_curves(std::span<const NamedModel> models, double face_width, int teeth_apart) {
  return deflection_curves(models, {1, 0, -1}, {0, face_width / 2, face_width}, subdivided(station_grid(face_width).zetas()), teeth_apart);
}

}  // namespace flankwright
