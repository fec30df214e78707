#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "core/contact/path/contact_points.hpp"
#include "core/contact/assembly/misalignment.hpp"

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

/// dg/dp of plane_of_action_gap() at each point [mm/rad or mm/mm], exact, the points held.
/// @throws InvalidInput for the axial offset, by which points move
Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const Misalignment& misalignment,
                               MisalignmentParameter parameter);

}  // namespace flankwright
