#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "core/gear/gear_pair.hpp"
#include "studies/exchange/rexs/relief_form.hpp"
#include "studies/exchange/rexs/rexs_reading.hpp"

namespace flankwright::studies::rexs {

/// Reads what reliefs have in common: their shape, their transition and where a relief of the profile starts.
class ReliefReading {
 public:
  /// What the depth of a relief grows with, from its start to its end.
  enum class Along { Radius, Roll };

  struct Relief {
    double amount{0.0};  ///< where the profile ends [mm]
    double height{0.0};  ///< radial, from there to the start [mm]
    ReliefForm form{};
  };

  ReliefReading(Reading& reading, const Gear& gear, const FlankFrame& frame) : reading_(reading), gear_(gear), frame_(frame) {}

  /// Linear or parabolic; what is neither, but near the parabola, is taken for it. Nullopt for the rest, which is left out.
  std::optional<ReliefShape> shape_of(const Component& c);

  /// The form of a relief with its tangential transition, where that can be taken.
  /// @param start, end  of the transition, as shares of the relief's extent
  ReliefForm form_of(const Component& c, ReliefShape shape, std::optional<double> start, std::optional<double> end);

  /// A relief at the tip or at the start of active profile. Nullopt where it is left out, which is said.
  /// @param name  that its attributes begin with
  std::optional<Relief> profile_relief(const Component& c, const std::string& name, bool at_tip, Along along);

 private:
  /// Radius at a roll length measured from the tip down, or from the start of active profile up.
  double radius_at(double roll, bool at_tip) const;
  double roll_at(double radius) const;

  Reading& reading_;
  const Gear& gear_;
  const FlankFrame& frame_;
};

}  // namespace flankwright::studies::rexs
