#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/compliance/finite_element/solve_influence_table.hpp"
#include "core/compliance/fitted/correction_library.hpp"

namespace flankwright {

/// Something that was made before, and where it is kept.
template <typename T>
struct Kept {
  T value;
  std::string where;
};

/// A store of influence values and fits for later runs. The store never changes a result: a stored value is the one
/// that would be computed. One thread calls at a time.
class ComplianceStore {
 public:
  virtual ~ComplianceStore() = default;

  /// The run of that task, or one that tells more; empty where there is none that can be used. May be called by several threads at a time.
  virtual std::optional<Kept<InfluenceTableRun>> find(const InfluenceTableTask& task) = 0;
  /// @param run  Factorised
  /// @return where it is kept; empty: nowhere
  virtual std::string keep(const InfluenceTableTask& task, const InfluenceTableRun& run) = 0;

  /// The fit of a gear to its run by the default mesh.
  /// @param coarse  task of the run that it completes
  /// @param start   coefficients that it started from
  virtual std::optional<Kept<CorrectionEntry>> find_fit(const InfluenceTableTask& coarse, const std::vector<double>& start) = 0;
  /// @return where it is kept; empty: nowhere
  virtual std::string keep_fit(const InfluenceTableTask& coarse, const std::vector<double>& start, const CorrectionEntry& fit) = 0;

 protected:
  ComplianceStore() = default;
  ComplianceStore(const ComplianceStore&) = default;
  ComplianceStore& operator=(const ComplianceStore&) = default;
};

}  // namespace flankwright
