#pragma once

#include "tests/benchmarks/contact_truth/contact_run.hpp"

namespace flankwright::contact_truth {

/// What is missing from root stress because loads of the program's finite elements enter over the tooth's centre surface: the largest principal stress at mid
/// face under an even line load on the flank itself, over that under the same load as NetFunctionals has it, both on one mesh, bores rigid.
///
/// Spur gears, undisturbed contact.
/// @param along  arc length from the fillet's start over the fillet's, 0 .. 1
double flank_over_centre_load(const ContactTask& task, Member member, int tooth, double along);

}  // namespace flankwright::contact_truth
