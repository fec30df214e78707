#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "core/flank/contact_shift.hpp"
#include "core/flank/modifications/modification.hpp"
#include "core/gear/gear_pair.hpp"

namespace flankwright {

namespace detail {

template <class M>
constexpr std::size_t starts_of() {
  if constexpr (ModificationWithStarts<M>) {
    return std::tuple_size_v<decltype(std::declval<const M&>().beyond_starts(std::declval<const FlankFrame&>(), 0.0, 0.0))>;
  } else {
    return 0;
  }
}

template <class... M>
constexpr std::size_t count_starts(std::type_identity<ModificationList<M...>>) {
  return (starts_of<M>() + ...);
}

}  // namespace detail

/// The lines on a flank at which the slope of its modification jumps: where reliefs begin.
class ReliefStarts {
 public:
  static constexpr std::size_t count = detail::count_starts(std::type_identity<Modifications>());

  ReliefStarts(const GearPair& pair, Member member, const Modification& modification)
      : modification_(modification), frame_(pair.flank_frame(member)) {
    if (has_lead_modification(modification)) shift_ = ContactShift::of(pair, member, modification.process);
  }

  /// Distances beyond each at r and z of the flank [mm]; minus infinity of what has no such start. A lead modification begins where its process takes it to.
  std::array<double, count> beyond(double r, double z) const {
    std::array<double, count> distances{};
    std::size_t next = 0;
    const double from = shift_ ? z - shift_->at_radius(r) : z;
    for_each_modification(modification_, [&]<class M>(const M& m) {
      if constexpr (ModificationWithStarts<M>) {
        for (const double distance : m.beyond_starts(frame_, r, M::flank_class == ModificationClass::Lead ? from : z)) distances[next++] = distance;
      }
    });
    return distances;
  }

 private:
  Modifications modification_;
  FlankFrame frame_;
  std::optional<ContactShift> shift_;
};

}  // namespace flankwright
