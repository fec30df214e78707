#pragma once

#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"

namespace flankwright {

/// Line load at an end of a contact line, read off the solved position afterwards.
struct LineEnd {
  int tooth{0};
  double z{not_given};                      ///< [mm]
  double structural_deflection{not_given};  ///< extrapolated [mm]
  double approach{not_given};               ///< what gap and structure leave of f_t, below 0 where flanks stay apart [mm]
  double contact_deflection{not_given};     ///< the same, 0 where nothing is left [mm]
  double line_load{not_given};              ///< [N/mm]
  double contact_stress{not_given};         ///< sigma_H [MPa]
  ContactPoint point{};                     ///< the end as a point of the mesh, without a weight
};

/// Line loads where each line ends between A and E: on a tip edge or on a face [Haddad 1991, eq. 1.70]. The structural
/// deflection, smooth along a line, is extrapolated by a natural cubic spline through the line's quadrature points. f_t
/// less this and the gap is the local deflection, and the contact law gives the line load that belongs to it.
///
/// They are no part of the equilibrium: with these loads the force would not balance, and on a short line with few
/// points they exceed those of a finer one by far (at five Gauss intervals the thesis prints 203 N/mm where ten give
/// 121). There are two entries for each line that has a part between A and E and a point, by tooth and rising z; none
/// without Hertzian contact.
/// @param condition  of the solved position
std::vector<LineEnd> line_ends(const MeshModel& model, const MeshPosition& at, const LoadedPosition& loaded, const FlankCondition& condition);

}  // namespace flankwright
