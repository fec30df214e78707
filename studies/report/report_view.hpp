#pragma once

#include "studies/base/json_format.hpp"

namespace flankwright::studies {

/// The part of the results that is inlined in the page, in a compact form:
/// numbers are rounded to six significant digits (a plot or a table cell shows at most five; `given` and `used` stay
/// exact), and the contact points of `loaded[].cycle[].teeth[]` turn from a list of objects into one object of
/// columns `{z_mm[], pinion_radius_mm[], load_N_per_mm[], contact_stress_MPa[]}`, the only ones drawn. A point that
/// lacks a number, or has none, gets null in that column. Of `loaded[].gradients` those of the summary are kept.
///
/// @param results  results.json, any shape; parts that do not have the expected shape pass unchanged
Json report_view(const Json& results);

}  // namespace flankwright::studies
