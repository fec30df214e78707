#pragma once

#include <Eigen/Core>
#include <array>
#include <string_view>
#include <vector>

#include "core/contact/contact_points.hpp"
#include "core/contact/misalignment.hpp"

namespace flankwright {

/// One number of a Misalignment, e.g. &Misalignment::crossing.
using MisalignmentParameter = double Misalignment::*;

/// A parameter and the name it carries in a study file below [misalignment].
struct NamedMisalignmentParameter {
  MisalignmentParameter parameter;
  std::string_view name;
};

/// Those that leave the contact points where they are, so that loads have a derivative with respect to them. The axial offset has
/// none: it cuts the common face elsewhere, which moves the points and their influence.
inline constexpr std::array<NamedMisalignmentParameter, 6> misalignment_parameters{{
    {&Misalignment::crossing, "crossing"},
    {&Misalignment::intersecting, "intersecting"},
    {&Misalignment::centre_distance, "centre_distance"},
    {&Misalignment::pinion_lead_angle, "pinion_lead_angle"},
    {&Misalignment::pinion_pressure_angle, "pinion_pressure_angle"},
    {&Misalignment::mesh_misalignment, "mesh_misalignment"},
}};

/// dg/dp of plane_of_action_gap() at each point [mm/rad or mm/mm], exact.
/// @throws InvalidInput for the axial offset
Eigen::VectorXd gap_derivative(const GearPair& pair, const std::vector<ContactPoint>& points, const Misalignment& misalignment,
                               MisalignmentParameter parameter);

}  // namespace flankwright
