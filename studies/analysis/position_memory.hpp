#pragma once

#include <cstddef>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "core/rating/contact_peaks.hpp"

namespace flankwright::studies {

class PositionMemory;

/// What the memories of one run keep together. Beyond `most_bytes` those that were used longest ago forget their positions, and make them anew where they are asked for again: a
/// load spectrum has a mesh, and so a memory, for each of its loads.
class PositionBudget {
 public:
  /// Influence values that all memories together keep [bytes].
  static constexpr std::size_t most_bytes = std::size_t{1} << 30U;

  explicit PositionBudget(std::size_t most = most_bytes) : most_(static_cast<std::ptrdiff_t>(most)) {}

  /// A memory was used, and keeps so many bytes more.
  void used(PositionMemory& memory, std::size_t more);
  /// A memory goes, with the bytes that it kept.
  void left(PositionMemory& memory, std::size_t bytes);

 private:
  const std::ptrdiff_t most_;
  std::mutex mutex_;
  std::list<PositionMemory*> by_use_;  ///< the latest first
  std::ptrdiff_t bytes_{0};            ///< for a moment below what is kept: a memory may forget positions before used() was told of them
};

/// Positions of one mesh by their phase, each made once as far as the budget allows. May be used by several threads at a time.
class PositionMemory {
 public:
  /// Influence values that the kept positions of one memory may have [bytes]; positions beyond that are made each time.
  static constexpr std::size_t most_bytes = std::size_t{256} << 20U;

  /// @param budget  outlives this
  explicit PositionMemory(PositionBudget& budget) : budget_(budget) {}
  ~PositionMemory() { budget_.left(*this, bytes_); }
  PositionMemory(const PositionMemory&) = delete;
  PositionMemory& operator=(const PositionMemory&) = delete;

  /// The mesh as `make` makes it, without what is known already made anew. This must outlive it.
  MeshAt remembering(MeshAt make) {
    return [this, make = std::move(make)](const std::vector<double>& phases) {
      Positions at = known(phases);
      std::vector<double> unknown;
      for (const double phase : phases) {
        if (!at.contains(phase)) unknown.push_back(phase);
      }
      std::size_t more = 0;
      if (!unknown.empty()) {
        MeshModel made = make(unknown);
        const std::lock_guard lock(mutex_);
        for (std::size_t i = 0; i < unknown.size(); ++i) {
          const auto position = std::make_shared<const MeshPosition>(std::move(made.positions[i]));
          more += keep(unknown[i], position);
          at.emplace(unknown[i], position);
        }
        made.positions.clear();
        if (!mesh_) mesh_ = std::move(made);
      }
      budget_.used(*this, more);
      MeshModel mesh = without_positions();
      for (const double phase : phases) mesh.positions.push_back(*at.at(phase));
      return mesh;
    };
  }

  /// Forgets its positions. @returns the bytes that they had
  std::size_t forget() {
    const std::lock_guard lock(mutex_);
    positions_.clear();
    return std::exchange(bytes_, 0);
  }

 private:
  using Positions = std::map<double, std::shared_ptr<const MeshPosition>>;  // by phase

  Positions known(const std::vector<double>& phases) {
    const std::lock_guard lock(mutex_);
    Positions at;
    for (const double phase : phases) {
      if (const auto found = positions_.find(phase); found != positions_.end()) at.insert(*found);
    }
    return at;
  }

  MeshModel without_positions() {
    const std::lock_guard lock(mutex_);
    return *mesh_;
  }

  /// @returns the bytes that are kept more
  std::size_t keep(double phase, const std::shared_ptr<const MeshPosition>& position) {
    const std::size_t bytes = sizeof(double) * static_cast<std::size_t>(position->influence.size());
    if (bytes_ + bytes > most_bytes || !positions_.emplace(phase, position).second) return 0;
    bytes_ += bytes;
    return bytes;
  }

  PositionBudget& budget_;
  std::mutex mutex_;
  std::optional<MeshModel> mesh_;  ///< without positions
  Positions positions_;
  std::size_t bytes_{0};
};

inline void PositionBudget::used(PositionMemory& memory, std::size_t more) {
  const std::lock_guard lock(mutex_);
  bytes_ += static_cast<std::ptrdiff_t>(more);
  by_use_.remove(&memory);
  by_use_.push_front(&memory);
  while (bytes_ > most_ && by_use_.size() > 1) {
    bytes_ -= static_cast<std::ptrdiff_t>(by_use_.back()->forget());
    by_use_.pop_back();
  }
}

inline void PositionBudget::left(PositionMemory& memory, std::size_t bytes) {
  const std::lock_guard lock(mutex_);
  bytes_ -= static_cast<std::ptrdiff_t>(bytes);
  by_use_.remove(&memory);
}

}  // namespace flankwright::studies
