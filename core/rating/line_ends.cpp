#include "core/rating/line_ends.hpp"

#include <cmath>

#include "core/base/natural_spline.hpp"
#include "core/contact/gap/condition_gap.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/rating/line_region.hpp"

namespace flankwright {

namespace {

/// Structural deflection along one line.
NaturalSpline structural_deflection(const MeshPosition& at, const LoadedPosition& loaded, std::size_t begin, std::size_t end) {
  std::vector<double> z, deflection;
  for (std::size_t i = begin; i < end; ++i) {
    z.push_back(at.points[i].z);
    deflection.push_back(loaded.load.structural_deflection[static_cast<Eigen::Index>(i)]);
  }
  return {std::move(z), std::move(deflection)};
}

}  // namespace

std::vector<LineEnd> line_ends(const MeshModel& model, const MeshPosition& at, const LoadedPosition& loaded, const FlankCondition& condition) {
  std::vector<LineEnd> ends;
  if (!loaded.load.usable()) return ends;
  const LineRegion region(model);
  std::vector<ContactPoint> points;  // of the ends
  for (std::size_t begin = 0, end = 0; begin < at.points.size(); begin = end) {
    while (end < at.points.size() && at.points[end].tooth == at.points[begin].tooth) ++end;
    const int tooth = at.points[begin].tooth;
    const LineInterval line = region.line(at.phase + tooth, LineRegion::round_off * model.face_width);  // not beyond A or E by round-off
    if (!(line.begin < line.end)) continue;
    const NaturalSpline structural = structural_deflection(at, loaded, begin, end);
    for (const double z : {line.begin, line.end}) {
      const auto point = model.place(region.path, at.phase, tooth, z);
      if (!point || !model.contact_law(*point)) continue;  // an end without its own contact law has no load
      points.push_back(*point);
      ends.push_back({tooth, z, structural(z)});
    }
  }
  const Eigen::VectorXd gap = ConditionGap(model.pair, model.placement.gap, condition).at(points, at.phase).total;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    LineEnd& end = ends[i];
    end.approach = loaded.load.transmission_error - gap[static_cast<Eigen::Index>(i)] - end.structural_deflection;
    end.contact_deflection = std::max(0.0, end.approach);
    const ContactLaw law = *contact_law_in(model, points[i], condition);
    end.line_load = law.line_load(end.approach);
    end.contact_stress = contact_stress(model, points[i], &law, end.line_load).highest.pressure;
    end.point = points[i];
  }
  return ends;
}

}  // namespace flankwright
