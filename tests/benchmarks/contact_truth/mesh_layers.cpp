#include "tests/benchmarks/contact_truth/mesh_layers.hpp"

#include <algorithm>
#include <cmath>

#include "core/contact/path/contact_points.hpp"

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

/// z of the ends of contact lines on the flanks, undisturbed and inside the common face.
std::vector<double> line_ends(const ContactGear& gear) {
  const PathOfContact path(*gear.pair);
  std::vector<double> ends;
  for (int tooth = gear.first; tooth <= gear.last; ++tooth) {
    const auto in_contact = [&](double z) { return contact_point(*gear.pair, path, gear.line_phase, tooth, z, false).has_value(); };
    constexpr int steps = 64;  // of the face: a line is longer
    const double half = gear.pair->face_width / 2;
    for (int i = 0; i < steps; ++i) {
      double below = half * (2.0 * i / steps - 1), above = half * (2.0 * (i + 1) / steps - 1);
      const bool begins = in_contact(below);
      if (begins == in_contact(above)) continue;
      for (int halving = 0; halving < 40; ++halving) (in_contact((below + above) / 2) == begins ? below : above) = (below + above) / 2;
      ends.push_back((below + above) / 2);
    }
  }
  return ends;
}

/// Layers of the common face, as thin at the ends of lines and of the face as asked; one ends at every one of them. Their size grows with the distance from
/// there as that of neighbours in layer_ends() does.
std::vector<double> planes_at_line_ends(const ContactGear& gear, const ContactMeshOptions& options) {
  const double half = gear.pair->face_width / 2;
  std::vector<double> ends = line_ends(gear);
  const auto size = [&](double z) {
    const double slope = options.layer_growth - 1;
    double least = std::min(options.largest_layer, options.end_layer + slope * (half - std::abs(z)));
    for (const double end : ends) least = std::min(least, options.line_layer + slope * std::abs(z - end));
    return least;
  };
  std::vector<double> fixed = ends;
  fixed.insert(fixed.end(), {-half, half});
  std::ranges::sort(fixed);
  std::vector<double> planes{-half};
  for (std::size_t part = 0; part + 1 < fixed.size(); ++part) {
    constexpr int steps = 1000;
    std::vector<double> layers{0};  // number of layers up to each step
    const double from = fixed[part], length = fixed[part + 1] - from;
    for (int i = 0; i < steps; ++i) layers.push_back(layers.back() + length / steps / size(from + length * (i + 0.5) / steps));
    const double count = std::max(1.0, std::round(layers.back()));
    for (int layer = 1; layer < static_cast<int>(count); ++layer) {
      const auto reached = std::ranges::lower_bound(layers, layer / count * layers.back());
      planes.push_back(from + length * static_cast<double>(reached - layers.begin()) / steps);
    }
    planes.push_back(fixed[part + 1]);
  }
  return planes;
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
  if (options.line_layer > 0) return planes_at_line_ends(gear, options);
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
