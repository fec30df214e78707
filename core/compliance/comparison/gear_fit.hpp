#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/compliance/comparison/deflection_curves.hpp"
#include "core/compliance/comparison/residual_shares.hpp"
#include "core/compliance/finite_element/influence.hpp"
#include "core/compliance/fitted/fit_compliance.hpp"
#include "core/compliance/fitted/thesis_form.hpp"

namespace flankwright {

/// One gear whose compliance is fitted, and the data that the fit uses and is judged by.
struct GearFitTask {
  GearToMesh gear;
  Material material;
  GearMeshOptions mesh{};
  RemovedRigidMotion removed{RemovedRigidMotion::TranslationTorsionAndTilt};
  KernelForm form{KernelForm::one_tooth_accurate()};
  FitOptions fit{};
  int radii{6};           ///< of the stations fitted, >= 4; axially they are those of station_grid()
  int adjacent_radii{5};  ///< of those on several teeth, >= 4; axially every second one
  int teeth_apart{2};     ///< pitches over which teeth are coupled, 1 .. mesh.teeth_each_side; forms for one tooth: 0
  bool test_grid{true};   ///< judged at stations that the fit has not seen: the centres of the grids' cells
};

/// Residuals of one form against finite elements.
struct FormResiduals {
  std::string form;  ///< "kernels", the task's; "thesis_in_master", "thesis_separate"
  FitStatus status{FitStatus::NotRun};
  std::vector<ResidualDistribution> fitted;  ///< at the stations fitted, by teeth apart
  std::vector<ResidualDistribution> unseen;  ///< on those of the test grid; empty without one
};

/// Wall times [s].
struct GearFitTimes {
  double model{not_given};   ///< mesh, assembly, factorisation
  double loads{not_given};   ///< all loads of grids and curves
  double fit{not_given};     ///< of the task's form
  double others{not_given};  ///< fits of the thesis' forms, plate, curves
};

struct GearFitResult {
  GearProportions gear;
  GearBody body;  ///< as given to the task
  FactorStatus status{FactorStatus::NotPositiveDefinite};
  RemovedRigidMotion removed{RemovedRigidMotion::TranslationTorsionAndTilt};
  RunStatistics finite_elements;
  int loads{0};   ///< solved for
  FitResult fit;  ///< NotRun unless status is Factorised
  /// Of all pairs. The thesis' forms were fitted to those with more than 1 % of their own compliances in common.
  std::vector<FormResiduals> residuals;
  std::vector<DeflectionCurve> curves;  ///< of models "finite elements", "fitted", "thesis", "plate", "thin slices"
  /// Lowest eigenvalue of the fitted block matrix over five teeth (forms for one tooth: over one) on the adjacent
  /// teeth's grid, relative to the largest [-]; >= 0 but for round-off.
  double lowest_eigenvalue{not_given};
  int eigenvalue_teeth{0};  ///< teeth in that matrix
  GearFitTimes times;
};

/// A label of what is being done, steps done and in all.
using FitProgress = std::function<void(const std::string& label, int done, int total)>;

/// Runs a gear's finite elements and fits the form to the influence values. Compares this form and those of the thesis
/// on a grid that no fit has seen, and makes every model's deflection curves under loads at root, middle and tip of
/// both ends and mid face. One thread: same input, same result.
/// @throws InvalidInput  as gear_mesh(), "fit.radii", "fit.teeth_apart"
GearFitResult fit_gear(const GearFitTask& task, const FitProgress& progress = {});

/// Influence values between the stations us x zetas on tooth 0 and, for each m = 1 .. teeth_apart, between those of
/// teeth 0 and m. The load is on tooth 0, which is meshed finely; the deflection is read on both neighbours m pitches
/// away. These differ only by their mesh and count as each other's reciprocal.
std::vector<InfluenceSample> finite_element_samples(const InfluenceModel& model, const GearProportions& gear, const std::vector<double>& us,
                                                    const std::vector<double>& zetas, int teeth_apart, RemovedRigidMotion removed);

}  // namespace flankwright
