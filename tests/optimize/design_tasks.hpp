#pragma once

#include <string>
#include <vector>

#include "optimize/design/problem/design_problem.hpp"
#include "tests/common/random.hpp"

/// Small design tasks that the tests of optimize share: real pairs, coarsely resolved.
namespace flankwright::design_tasks {

/// Haddad's helical pair 18:54 [thesis 1991, table 4.1] at 1014.868 N·m, one scene for each mesh misalignment [um].
/// Variables: lead crowning 0 .. 40, lead slope -20 .. 20 and profile crowning 0 .. 30 um, of the pinion, all 0 at the
/// start. Root stress is synthetic_root_stress.hpp's.
DesignTask helical(const std::vector<double>& misalignments_um = {0.0, 12.0, -12.0}, int positions = 8);

/// A spur pair 24:36 of module 4 at 300 N·m; variables: lead crowning 0 .. 40 and lead slope -20 .. 20 um of the
/// pinion.
DesignTask spur(const std::vector<double>& misalignments_um);

/// A spur pair with rounded tips that are not relieved yet; the tip relief of both gears is sought.
DesignTask relieved_spur();

/// All outputs that can be minimised, harmonics of order 1 to 3.
std::vector<ObjectiveTerm> all_outputs();

ObjectiveTerm term(Output output, int harmonic = 0, double weight = 1.0);

/// A scaled design inside the bounds.
Eigen::VectorXd random_design(int variables, tests::Random32& random);

}  // namespace flankwright::design_tasks
