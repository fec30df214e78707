#pragma once

#include "core/contact/assembly/flank_assembly.hpp"

namespace flankwright {

/// How finely first contact is searched so that no maximum is missed.
struct SearchDensity {
  int sections{0};               ///< transverse sections over the face, both ends included
  double hollow_curvature{0.0};  ///< largest -d2D/dz2 along a line of contact, with what sampling may have missed [1/mm], >= 0
  int cells{1};                  ///< pieces of the profile in each section, every one searched; 1 where a section has one maximum only
};

/// Judged from the two flanks' deviations D = D1(rho1, z) + D2(rho2, z) along the path on which undisturbed flanks touch,
/// rho1 + rho2 constant, by their exact second derivatives on a grid: 7 x 3 points, 33 x 33 where one of them is a field
/// (generated, predesigned, measured).
///
/// - Profile: a stationary point of the wheel angle is a maximum where the relative curvature, 1/rho1 + 1/rho2 = kappa,
///   outweighs that of D over the arc length of the flanks, -D_ss < kappa. Where -D_ss <= kappa/2 on the whole grid, a
///   section has one maximum and is searched once; the grid reaches as far as either flank, and beyond the end of one
///   that end stands for it. Elsewhere a section is cut into eight cells for every stretch of one sign of curvature
///   that a profile of the grid shows, into 32 at least and 64 at most; the one in which the wheel's form circle ends
///   it into eight more, as near the base circle the wheel's roll length changes fast.
/// - Face: 9 sections over the line of contact of analytic flanks; with fields four for every stretch of one sign of
///   D's curvature along it, 17 at least; twice as many, 33 at least, where a section has several maxima; 129 at most.
///   The search itself covers what hollow curvature can hide between two of them; hollow_curvature is three times the
///   largest value on the grid.
///
/// Two maxima are separated where they lie in different cells or sections; of two in one cell one is found. Fields are
/// assumed not to vary faster than the grid of 33 x 33 shows. Linear reliefs of negative amount (metal added) make a
/// hollow kink without curvature: they count as a hollow profile.
SearchDensity search_density(const FlankAssembly& assembly);

}  // namespace flankwright
