#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "optimize/design/scatter/statistic_model.hpp"

namespace flankwright {

/// Draws analysed at one design by one problem.
struct AnalysedDraws {
  const DesignProblem* problem{nullptr};
  Eigen::VectorXd x;
  std::map<std::pair<std::size_t, int>, LinearDraw> linear;  ///< by statistic and draw
  std::set<int> units;                                       ///< DrawAnalyses::unit_of()

  bool is_of(const DesignProblem& of, const Eigen::VectorXd& at) const { return problem == &of && x.size() == at.size() && x == at; }
};

/// Analyses draws for several statistics at once. Scenes that belong together, the load cases of a draw or of a spectrum, are one unit and are analysed together.
class DrawAnalyses {
 public:
  /// @param full    the scenes of all draws
  /// @param models  the statistics; they outlive this
  DrawAnalyses(const DesignProblem& full, std::vector<const StatisticModel*> models);

  /// Whether the draws of some statistic are load spectra: the first n draws are then not the same ones for all statistics.
  bool of_spectrum() const { return of_spectrum_; }
  int unit_of(const StatisticModel& model, int draw) const { return unit_of(model.first_scene(draw)); }

  /// Adds the draws of a statistic that were not analysed yet. Every statistic then knows them.
  /// @returns cycles analysed
  std::int64_t add(AnalysedDraws& analysed, const StatisticModel& of, const std::vector<int>& draws, bool with_derivatives) const;
  /// Measures m_s of draws that were analysed.
  std::vector<double> measures(const AnalysedDraws& analysed, const StatisticModel& of, const std::vector<int>& draws) const;

 private:
  void number_units(const DesignProblem& full);
  int unit_of(int scene) const { return units_[static_cast<std::size_t>(scene)]; }
  void linearise(AnalysedDraws& analysed, const std::vector<int>& scenes, bool with_derivatives) const;

  std::vector<const StatisticModel*> models_;
  bool of_spectrum_{false};
  std::vector<int> units_;  ///< per scene, see number_units()
};

}  // namespace flankwright
