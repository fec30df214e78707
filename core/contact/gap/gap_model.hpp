#pragma once

namespace flankwright {

/// How the gap between the flanks is found.
enum class GapModel {
  PlaneOfAction,  ///< near where undisturbed flanks would touch, see PlaneOfActionGap
  WholeSurface,   ///< over the whole flanks, see SurfaceGap
};

/// Name of the model in a study file ("whole_surface").
constexpr const char* to_string(GapModel model) { return model == GapModel::PlaneOfAction ? "plane_of_action" : "whole_surface"; }

}  // namespace flankwright
