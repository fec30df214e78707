#pragma once

#include <vector>

#include "tests/benchmarks/contact_truth/contact_mesh.hpp"

namespace flankwright::contact_truth {

/// z of the layers' ends of a gear, rising [mm]: thin at the ends of the common face, where contact ends, and on a wider gear from there outwards; on a web
/// layers also end where web and hub do.
std::vector<double> layer_planes(const ContactGear& gear, const ContactMeshOptions& options);

}  // namespace flankwright::contact_truth
