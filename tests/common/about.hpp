#pragma once

#include <catch2/catch.hpp>

namespace flankwright::tests {

/// Equal within an absolute margin, which is all that counts: Approx with a margin alone would let 1.2e-5 of the value pass as well.
inline Approx about(double value, double margin) { return Approx(value).epsilon(0).margin(margin); }

}  // namespace flankwright::tests
