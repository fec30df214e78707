#include "tests/benchmarks/contact_truth/mesh_layers.hpp"

#include <algorithm>

namespace flankwright::contact_truth {
namespace {

/// Sizes growing from both ends of `length` (or from the first only), as positions from 0.
std::vector<double> layer_ends(double length, const ContactMeshOptions& options, bool half) {
  const double reach = half ? length : length / 2;
  std::vector<double> ends{0};
  for (double size = options.end_layer; ends.back() < reach; size = std::min(size * options.layer_growth, options.largest_layer)) {
    ends.push_back(ends.back() + size);
  }
  if (ends.size() > 2 && ends.back() - reach > reach - ends[ends.size() - 2]) ends.pop_back();
  const double scale = reach / ends.back();
  for (double& end : ends) end *= scale;
  if (!half) {
    for (std::size_t i = ends.size() - 1; i-- > 0;) ends.push_back(length - ends[i]);
  }
  return ends;
}

/// Those of the common face, and beyond it layers that grow outwards.
std::vector<double> planes_of_face(double own_width, double common_width, const ContactMeshOptions& options, bool half) {
  std::vector<double> planes;
  if (options.middle_layer > 0 && !half) {
    ContactMeshOptions outwards = options;
    outwards.end_layer = options.middle_layer;
    const std::vector<double> ends = layer_ends(common_width / 2, outwards, true);
    for (std::size_t i = ends.size(); i-- > 1;) planes.push_back(-ends[i]);
    planes.insert(planes.end(), ends.begin(), ends.end());
    return planes;
  }
  for (const double end : layer_ends(half ? common_width / 2 : common_width, options, half)) planes.push_back(end - common_width / 2);
  const double overhang = (own_width - common_width) / 2;
  if (overhang <= 0) return planes;
  std::vector<double> whole;
  const std::vector<double> beyond = layer_ends(overhang, options, true);
  for (std::size_t i = beyond.size() - 1; i > 0; --i) whole.push_back(planes.front() - beyond[i]);
  whole.insert(whole.end(), planes.begin(), planes.end());
  if (!half) {
    for (std::size_t i = 1; i < beyond.size(); ++i) whole.push_back(planes.back() + beyond[i]);
  }
  return whole;
}

/// Layers also end at z: the nearest plane moves there, or another is added.
void end_layer_at(double z, std::vector<double>& planes) {
  const auto above = std::upper_bound(planes.begin(), planes.end(), z);
  if (above == planes.begin() || above == planes.end()) return;
  double &lower = *(above - 1), &upper = *above;
  const double near = 0.25 * (upper - lower);
  if (z - lower < near && above - 1 != planes.begin())
    lower = z;
  else if (upper - z < near && above + 1 != planes.end())
    upper = z;
  else if (z > lower)
    planes.insert(above, z);
}

}  // namespace

std::vector<double> layer_planes(const ContactGear& gear, const ContactMeshOptions& options) {
  std::vector<double> planes = planes_of_face((*gear.pair)[gear.member].data.face_width, gear.pair->face_width, options, gear.half_face);
  if (gear.web == nullptr) return planes;
  const WebbedBody& web = *gear.web;
  for (const double z :
       {web.web_offset - web.web_thickness / 2, web.web_offset + web.web_thickness / 2, web.web_offset, -web.hub_width / 2, web.hub_width / 2}) {
    end_layer_at(z, planes);
  }
  return planes;
}

}  // namespace flankwright::contact_truth
