#pragma once

#include <atomic>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <string_view>
#include <vector>

#include "core/effects/registry.hpp"

namespace flankwright {

/// The effects that are on in a loaded mesh. Copies share one record of the costs.
class MeshEffects {
 public:
  /// All that are registered.
  MeshEffects() : MeshEffects(registered_effects()) {}
  /// @param on  in any order; one that needs another is left out where that is missing
  explicit MeshEffects(EffectList on);
  /// All that are registered but these, and those that need them.
  /// @throws InvalidInput for an unknown name
  static MeshEffects all_but(std::initializer_list<std::string_view> names);

  bool has(std::string_view name) const;
  /// Whether loads are determined: some effect makes every point compliant.
  bool make_compliant() const;
  /// Asks every effect of a stage for its part.
  void act(EffectStage stage, MeshBuilder& builder) const;
  /// The same, one stage after the other.
  void act(std::initializer_list<EffectStage> stages, MeshBuilder& builder) const {
    for (const EffectStage stage : stages) act(stage, builder);
  }

  const EffectList& list() const { return on_; }
  /// The number of calls of an effect and their time on all threads together [s]; 0 where it is off.
  std::int64_t calls(std::string_view name) const;
  double seconds(std::string_view name) const;

 private:
  struct Cost {
    std::atomic<std::int64_t> calls{0};
    std::atomic<double> seconds{0.0};
  };

  EffectList on_;
  std::shared_ptr<std::vector<Cost>> costs_;  ///< one an effect of on_
};

}  // namespace flankwright
