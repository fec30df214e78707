#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "core/compliance/tooth/flank_compliance.hpp"

namespace flankwright {

/// A model of one gear's compliance, of any kind, with a name.
struct NamedModel {
  std::string name;
  int teeth_apart{0};  ///< the largest number of pitches over which it couples teeth
  /// E m_n K [-], stations x loads: deflections of the stations under each unit load.
  std::function<Eigen::MatrixXd(std::span<const FlankStation> stations, std::span<const FlankStation> loads)> deflections;
};

/// @param compliance  must outlive the model
NamedModel named_model(std::string name, int teeth_apart, const FlankCompliance& compliance);

/// Deflection along one tooth, at the height of the load, under a point load.
struct DeflectionCurve {
  std::string model;
  FlankStation load;          ///< on tooth 0
  int tooth{0};               ///< that deflects
  std::vector<double> zeta;   ///< [m_n] from the acute end
  std::vector<double> value;  ///< E m_n K [-], one a zeta
};

/// Curves of every model under point loads on tooth 0, as the thesis has them in its figures 3.1 .. 3.10: along the
/// loaded tooth and along its neighbours, as far as a model couples them.
///
/// @param us           heights of the loads, -1 .. 1
/// @param load_zetas   where the loads act [m_n], 0 .. B
/// @param zetas        where the deflections are taken [m_n], 0 .. B
/// @param teeth_apart  neighbours looked at on either side, >= 0
/// @returns  for every height, load, model and tooth, in this order
std::vector<DeflectionCurve> deflection_curves(std::span<const NamedModel> models, const std::vector<double>& us,
                                               const std::vector<double>& load_zetas, const std::vector<double>& zetas, int teeth_apart);

/// The most telling curves of a gear. Loads act at tip, middle and root of the acute end, mid face and the obtuse end.
/// Deflections are at most a quarter of a module apart, and closer near the ends.
/// @param face_width  B = b/m_n [-], > 0
std::vector<DeflectionCurve> gear_deflection_curves(std::span<const NamedModel> models, double face_width, int teeth_apart);

}  // namespace flankwright
