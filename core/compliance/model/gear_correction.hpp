#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/compliance/fitted/corrected_compliance.hpp"
#include "core/compliance/model/gear_runs.hpp"

namespace flankwright {

/// One gear's compliance "fitted": where the kernels that complete its coarse influence values come from.
struct GearCorrection {
  std::shared_ptr<const CorrectedCompliance> compliance;
  /// Why the library of fits does not do, CorrectionLibrary::unknown(); empty where the kernels are the library's.
  std::string unknown;
  /// The gear's own fit, if it has one, and the residuals of the resulting compliance against the fine run, at stations
  /// that it has not seen, by teeth apart.
  CorrectionEntry fit;
  std::vector<ResidualStatistics> residuals;
  bool from_cache{false};
  std::string file;           ///< where the fit is kept; empty: nowhere
  double seconds{not_given};  ///< wall time in this build

  /// Another coarse compliance of the same gear with the same kernels: they belong to the tooth, whatever its body.
  std::shared_ptr<const CorrectedCompliance> completed(std::shared_ptr<const FlankCompliance> coarse) const {
    return std::make_shared<const CorrectedCompliance>(std::move(coarse), compliance->gear(), compliance->coefficients());
  }

  const char* source() const { return unknown.empty() ? "library" : "own fit"; }
};

/// Completes a gear's coarse run by the library of fits or, for a gear outside it, by a fit to its fine run, which is
/// stored for later runs.
/// @throws InvalidInput "fidelity.compliance" where a fit failed
GearCorrection gear_correction(const ComplianceTask& task, const FiniteElementRuns& runs, Member member, const ComplianceBuild& build);

}  // namespace flankwright
