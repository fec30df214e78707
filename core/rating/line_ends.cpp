#include "core/rating/line_ends.hpp"

#include <cmath>
#include <optional>

#include "core/base/natural_spline.hpp"
#include "core/contact/gap/condition_gap.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/rating/line_region.hpp"

namespace flankwright {

namespace {

/// A motion of the points along one line.
NaturalSpline along_line(const MeshPosition& at, const Eigen::VectorXd& motion, std::size_t begin, std::size_t end) {
  std::vector<double> z, values;
  for (std::size_t i = begin; i < end; ++i) {
    z.push_back(at.points[i].z);
    values.push_back(motion[static_cast<Eigen::Index>(i)]);
  }
  return {std::move(z), std::move(values)};
}

}  // namespace

std::vector<LineEnd> line_ends(const MeshModel& model, const MeshPosition& at, const LoadedPosition& loaded, const FlankCondition& condition) {
  std::vector<LineEnd> ends;
  if (!loaded.load.usable()) return ends;
  const LineRegion region(model);
  std::vector<ContactPoint> points;  // of the ends
  std::vector<double> opened;        // there by other forces than the mesh's
  Eigen::VectorXd outside = Eigen::VectorXd::Zero(at.outside.empty() ? 0 : std::ssize(at.points));
  if (outside.size() > 0) at.outside.add_to(outside, at.weight.dot(loaded.load.line_load));
  for (std::size_t begin = 0, end = 0; begin < at.points.size(); begin = end) {
    while (end < at.points.size() && at.points[end].tooth == at.points[begin].tooth) ++end;
    const int tooth = at.points[begin].tooth;
    const LineInterval line = region.line(at.phase + tooth, LineRegion::round_off * model.face_width);  // not beyond A or E by round-off
    if (!(line.begin < line.end)) continue;
    const NaturalSpline structural = along_line(at, loaded.load.structural_deflection, begin, end);
    std::optional<NaturalSpline> by_others;
    if (outside.size() > 0) by_others.emplace(along_line(at, outside, begin, end));
    for (const double z : {line.begin, line.end}) {
      const auto point = model.place(region.path, at.phase, tooth, z);
      if (!point || !model.contact_law(*point)) continue;  // an end without its own contact law has no load
      points.push_back(*point);
      ends.push_back({tooth, z, structural(z)});
      opened.push_back(by_others ? (*by_others)(z) : 0.0);
    }
  }
  const Eigen::VectorXd gap = ConditionGap(model.pair, model.placement.gap, condition).at(points, at.phase).total;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    LineEnd& end = ends[i];
    end.approach = loaded.load.transmission_error - (gap[static_cast<Eigen::Index>(i)] + opened[i]) - end.structural_deflection;
    end.contact_deflection = std::max(0.0, end.approach);
    const ContactLaw law = *contact_law_in(model, points[i], condition);
    end.line_load = law.line_load(end.approach);
    end.contact_stress = contact_stress(model, points[i], &law, end.line_load).highest.pressure;
    end.point = points[i];
  }
  return ends;
}

}  // namespace flankwright
