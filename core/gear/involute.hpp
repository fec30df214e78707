#pragma once

namespace flankwright {

/// Involute function inv(alpha) = tan(alpha) - alpha [rad], alpha [rad].
double involute(double angle);

/// Angle whose involute is `value` >= 0 [rad]; exact to round-off. Throws InvalidInput for a negative or non-finite value.
double inverse_involute(double value);

}  // namespace flankwright
