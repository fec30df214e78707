#include "core/rating/position_gradient.hpp"

#include <cassert>
#include <variant>

#include "core/base/natural_spline.hpp"
#include "core/contact/gap/condition_gap.hpp"
#include "core/load/cycle/contact_stress.hpp"
#include "core/load/cycle/perturbed_position.hpp"

namespace flankwright {

namespace {

/// Structural deflection is extrapolated to a line's end by a spline through those of its points; so are derivatives.
Eigen::RowVectorXd extrapolated(const MeshPosition& at, const LineEnd& end, const Eigen::MatrixXd& values) {
  std::vector<double> z;
  std::vector<Eigen::Index> rows;
  for (std::size_t i = 0; i < at.points.size(); ++i) {
    if (at.points[i].tooth != end.tooth) continue;
    z.push_back(at.points[i].z);
    rows.push_back(static_cast<Eigen::Index>(i));
  }
  Eigen::RowVectorXd there(values.cols());
  for (Eigen::Index p = 0; p < there.size(); ++p) {
    const Eigen::VectorXd column = values(rows, p);
    there[p] = NaturalSpline(z, {column.begin(), column.end()})(end.z);
  }
  return there;
}

/// Slopes of gap and tip edge at the ends of lines, one row per end.
ParameterSlopes end_slopes(const MeshModel& model, const FlankCondition& condition, double phase, const std::vector<LineEnd>& ends,
                           const std::vector<MeshParameter>& parameters) {
  MeshPosition at;
  at.phase = phase;
  std::vector<Eigen::Index> edged;
  for (const LineEnd& end : ends) {
    if (model.effects.has("edge_contact") && end.point.tip_edge.radius >= 0.0) edged.push_back(std::ssize(at.points));
    at.points.push_back(end.point);
  }
  const ConditionGap gaps(model.pair, model.placement.gap, condition);
  return ConditionSlopes(model, gaps, parameters).at(at, gaps.at(at.points, phase), edged);
}

void add_line_ends(const MeshModel& model, const FlankCondition& condition, const MeshPosition& at, const LoadedPosition& loaded,
                   const std::vector<LineEnd>& ends, const std::vector<MeshParameter>& parameters, PositionGradient& gradient) {
  ParameterSlopes slopes = end_slopes(model, condition, loaded.phase, ends, parameters);
  Eigen::MatrixXd& gap = slopes.gap;
  for (std::size_t p = 0; p < parameters.size() && at.outside.by_force.size() > 0; ++p) {
    if (!std::holds_alternative<PinionTorque>(parameters[p])) continue;
    for (Eigen::Index i = 0; i < gap.rows(); ++i) {
      gap(i, static_cast<Eigen::Index>(p)) += model.normal_force(1.0) * extrapolated(at, ends[static_cast<std::size_t>(i)], at.outside.by_force)[0];
    }
  }
  gradient.line_end_load = gradient.line_end_stress = Eigen::MatrixXd::Zero(gap.rows(), gap.cols());
  for (Eigen::Index i = 0; i < gap.rows(); ++i) {
    const LineEnd& end = ends[static_cast<std::size_t>(i)];
    if (!(end.line_load > 0.0)) continue;
    const ContactLaw law = *contact_law_in(model, end.point, condition);
    Eigen::RowVectorXd deflection = loaded.transmission_error_derivative - gap.row(i) - extrapolated(at, end, gradient.structural_deflection);
    if (slopes.edge.size() > 0) deflection -= law.edge_slope(end.line_load) * slopes.edge.row(i);
    const StripContact::Peak peak = contact_stress(model, end.point, &law, end.line_load).highest;
    gradient.line_end_load.row(i) = deflection / law.slope(end.line_load);
    gradient.line_end_stress.row(i) = peak.slope * gradient.line_end_load.row(i);
    if (slopes.edge.size() > 0) gradient.line_end_stress.row(i) += peak.by_edge * slopes.edge.row(i);
  }
}

void add_shares(const MeshPosition& at, const LoadedPosition& loaded, PositionGradient& gradient) {
  const std::vector<ToothShare> shares = load_sharing(at, loaded);
  const double force = at.weight.dot(loaded.load.line_load);
  const Eigen::RowVectorXd whole = gradient.point_force.colwise().sum();
  gradient.shares.resize(std::ssize(shares), whole.size());
  for (Eigen::Index k = 0, i = 0; k < gradient.shares.rows(); ++k) {
    const ToothShare& share = shares[static_cast<std::size_t>(k)];
    Eigen::RowVectorXd carried = Eigen::RowVectorXd::Zero(whole.size());
    for (; i < std::ssize(at.points) && at.points[static_cast<std::size_t>(i)].tooth == share.tooth; ++i) carried += gradient.point_force.row(i);
    gradient.shares.row(k) = (carried - share.share * whole) / force;
  }
}

Eigen::VectorXd clearances(const MeshPosition& at) {
  Eigen::VectorXd all(std::ssize(at.points));
  for (Eigen::Index i = 0; i < all.size(); ++i) all[i] = at.points[static_cast<std::size_t>(i)].clearance;
  return all;
}

/// Approach [mm], contact deflection [mm] and contact stress [MPa] under the ends' held loads, of the ends of lines, all of one kind
/// after the other; empty where the number of ends differs.
Eigen::VectorXd end_readings(const PerturbedPosition::Stage& stage, const std::vector<LineEnd>& held) {
  const std::vector<LineEnd> ends = line_ends(stage.model, stage.at, stage.loaded, stage.condition);
  if (ends.size() != held.size()) return {};
  const Eigen::Index n = std::ssize(ends);
  Eigen::VectorXd readings(3 * n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const LineEnd& end = ends[static_cast<std::size_t>(i)];
    readings[i] = end.approach;
    const ContactLaw law = *contact_law_in(stage.model, end.point, stage.condition);
    const double load = held[static_cast<std::size_t>(i)].line_load;
    readings[n + i] = law.deflection(load);
    readings[2 * n + i] = contact_stress(stage.model, end.point, &law, load).highest.pressure;
  }
  return readings;
}

/// Where the mesh moves, and with it an end's position and contact law: dw = (d(f_t - g - S) - dc at w held)/c', and
/// the stress follows load, curvature and edge.
void move_line_ends(const MeshModel& model, const FlankCondition& condition, const PerturbedPosition& way, const std::vector<LineEnd>& ends,
                    Eigen::Index column, PositionGradient& gradient) {
  const Eigen::VectorXd slopes = way.slope([&](const PerturbedPosition::Stage& s) { return end_readings(s, ends); });
  const Eigen::Index n = std::ssize(ends);
  for (Eigen::Index i = 0; i < n; ++i) {
    const LineEnd& end = ends[static_cast<std::size_t>(i)];
    if (!(end.line_load > 0.0)) continue;
    const ContactLaw law = *contact_law_in(model, end.point, condition);
    const double load = (slopes[i] - slopes[n + i]) / law.slope(end.line_load);
    gradient.line_end_load(i, column) = load;
    gradient.line_end_stress(i, column) = contact_stress(model, end.point, &law, end.line_load).highest.slope * load + slopes[2 * n + i];
  }
}

}  // namespace

PositionGradient position_gradient(const MeshModel& model, const FlankCondition& condition, const LoadedCycle& cycle, std::size_t position,
                                   const std::vector<LineEnd>& ends, const std::vector<MeshParameter>& parameters) {
  const MeshPosition& at = model.positions[position];
  const LoadedPosition& loaded = cycle.positions[position];
  assert(loaded.load.usable() && loaded.gap_derivative.cols() == std::ssize(parameters));
  PositionGradient gradient;
  gradient.point_force = at.weight.asDiagonal() * loaded.line_load_derivative;
  gradient.structural_deflection = at.influence * gradient.point_force;
  gradient.gap = loaded.gap_derivative;
  gradient.error = -gradient.gap;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    // What other forces of a unit move the gears by grows with the torque; it is part of the gap and no deviation of flanks.
    if (std::holds_alternative<PinionTorque>(parameters[p])) gradient.error.col(static_cast<Eigen::Index>(p)).setZero();
  }
  add_line_ends(model, condition, at, loaded, ends, parameters, gradient);
  for (const Eigen::Index p : moving_among(model.placement.gap, parameters)) {
    const PerturbedPosition way(model, condition, loaded, position, std::get<MisalignmentParameter>(parameters[static_cast<std::size_t>(p)]), p);
    gradient.point_force.col(p) =
        way.point_slope([](const PerturbedPosition::Stage& s) { return Eigen::VectorXd(s.at.weight.cwiseProduct(s.loaded.load.line_load)); });
    gradient.structural_deflection.col(p) = way.point_slope([](const PerturbedPosition::Stage& s) { return s.loaded.load.structural_deflection; });
    gradient.error.col(p) += way.point_slope([](const PerturbedPosition::Stage& s) { return clearances(s.at); });
    move_line_ends(model, condition, way, ends, p, gradient);
  }
  gradient.contact_deflection = -gradient.gap - gradient.structural_deflection;
  for (Eigen::Index i = 0; i < gradient.contact_deflection.rows(); ++i) {
    if (loaded.load.line_load[i] > 0.0) {
      gradient.contact_deflection.row(i) += loaded.transmission_error_derivative;
    } else {
      gradient.contact_deflection.row(i).setZero();
    }
  }
  add_shares(at, loaded, gradient);
  return gradient;
}

}  // namespace flankwright
