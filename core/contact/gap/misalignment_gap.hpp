#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "core/contact/path/contact_points.hpp"
#include "core/contact/assembly/flank_condition.hpp"

namespace flankwright {

/// One number of a Misalignment, e.g. &Misalignment::crossing.
using MisalignmentParameter = double Misalignment::*;

/// A parameter and the name it carries in a study file below [misalignment].
struct NamedMisalignmentParameter {
  MisalignmentParameter parameter;
  std::string_view name;
};

/// All of them. In the plane of action the axial offset alone does more than open the gap: it cuts the common face elsewhere, which moves the points and
/// their influence (MeshSlopes of core/load).
inline constexpr std::array<NamedMisalignmentParameter, 7> misalignment_parameters{{
    {&Misalignment::crossing, "crossing"},
    {&Misalignment::intersecting, "intersecting"},
    {&Misalignment::centre_distance, "centre_distance"},
    {&Misalignment::axial_offset, "axial_offset"},
    {&Misalignment::pinion_lead_angle, "pinion_lead_angle"},
    {&Misalignment::pinion_pressure_angle, "pinion_pressure_angle"},
    {&Misalignment::mesh_misalignment, "mesh_misalignment"},
}};

/// The name of one of them.
std::string_view name_of(MisalignmentParameter parameter);

/// Derivatives by one number of a misalignment, the points held, at each of them [mm/rad or mm/mm].
struct MisalignmentSlopes {
  Eigen::VectorXd gap;   ///< of plane_of_action_gap(): exact, but for the part by which the wheel moves along the profile
  Eigen::VectorXd edge;  ///< of edge_moved_by()
};

/// What moves the wheel along the profile changes the touch to second order: that part of the gap's slope, and the edge's, are central differences.
/// @throws InvalidInput for the axial offset, by which points move
MisalignmentSlopes misalignment_slopes(const GearPair& pair, const std::vector<ContactPoint>& points, const FlankCondition& condition,
                                       MisalignmentParameter parameter);

}  // namespace flankwright
