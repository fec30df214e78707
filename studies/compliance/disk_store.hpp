#pragma once

#include <mutex>

#include "core/compliance/model/compliance_store.hpp"

namespace flankwright::studies {

/// Runs and fits as files in RunCache::default_folder(). A run with root stress also serves a request without.
class DiskStore final : public ComplianceStore {
 public:
  std::optional<Kept<InfluenceTableRun>> find(const InfluenceTableTask& task) override;
  std::string keep(const InfluenceTableTask& task, const InfluenceTableRun& run) override;
  std::optional<Kept<CorrectionEntry>> find_fit(const InfluenceTableTask& coarse, const std::vector<double>& start) override;
  std::string keep_fit(const InfluenceTableTask& coarse, const std::vector<double>& start, const CorrectionEntry& fit) override;

  /// Problems with the folder so far, for the user.
  const std::vector<std::string>& notes() const { return notes_; }

 private:
  std::vector<std::string> notes_;
  std::mutex notes_mutex_;
};

}  // namespace flankwright::studies
