#include "core/compliance/fitted/refinement_fit.hpp"

#include <algorithm>

#include "core/base/error.hpp"
#include "core/base/units.hpp"
#include "core/compliance/tooth_places.hpp"

namespace flankwright {
namespace {

/// Axial positions on a face of 12 modules: the ends' as they are, the middle stretched to another face.
std::vector<double> on_face(std::vector<double> zetas, double face) {
  constexpr double kEnd = 3.2, kFace = 12;
  for (double& zeta : zetas) {
    if (zeta > kFace - kEnd) {
      zeta += face - kFace;
    } else if (zeta > kEnd) {
      zeta = kEnd + (zeta - kEnd) * (face - 2 * kEnd) / (kFace - 2 * kEnd);
    }
  }
  return zetas;
}

std::vector<FlankPlace> fitted_places(double face) {
  return places_on({-1, -0.6, -0.2, 0.2, 0.6, 1},
                   on_face({0,   0.15, 0.35, 0.65, 1.05, 1.6,  2.3,   3.2,   4.3,   5.4,
                            6.6, 7.7,  8.8,  9.7,  10.4, 10.95, 11.35, 11.65, 11.85, 12},
                           face));
}

std::vector<FlankPlace> unseen_places(double face) {
  return places_on({-0.9, -0.45, 0.05, 0.5, 0.95},
                   on_face({0.08, 0.5, 2, 6.2, 9.6, 11.45, 11.85}, face));
}

}  // namespace

GearMeshOptions coarse_mesh() {
  GearMeshOptions options;
  options.flank_elements = 3;
  options.fillet_elements = 3;
  options.half_thickness_elements = 2;
  options.adjacent_flank_elements = 2;
  options.adjacent_fillet_elements = 2;
  options.end_element = 0.4;
  options.axial_growth = 1.6;
  options.largest_element = 1.2;
  options.body_growth = 2.5;
  return options;
}

GearToMesh standard_gear(const GearFacts& facts) {
  GearToMesh gear;
  gear.gear.teeth = facts.teeth;
  gear.gear.face_width = facts.relative_face;
  gear.gear.profile_shift = facts.profile_shift;
  gear.normal_module = 1;
  gear.pressure_angle = 20 * units::deg;
  gear.helix_angle = facts.helix_angle;
  return gear;
}

InfluenceSample element_sample(const GearFacts& gear, const GearMeshOptions& mesh,
                               const std::vector<FlankPlace>& places) {
  const InfluenceModel model(standard_gear(gear), {1.0, 0.3}, mesh);
  const ToothForm& form = model.mesh().form;
  std::vector<FlankPoint> points;
  for (const FlankPlace& place : places) {
    points.push_back({place.tooth, flank_radius(form, place.u), place.zeta - gear.relative_face / 2});
  }
  return {gear, places, model.influence(points).compliance};
}

std::vector<FlankPlace> places_on(const std::vector<double>& us, const std::vector<double>& zetas) {
  std::vector<FlankPlace> places;
  for (const double u : us) {
    for (const double zeta : zetas) places.push_back({0, u, zeta});
  }
  return places;
}

RefinementSamples refinement_samples(const GearFacts& gear, const GearMeshOptions& fine) {
  if (!(gear.relative_face >= 7)) {
    throw InvalidInput("gear.relative_face", std::to_string(gear.relative_face), "at least 7 modules");
  }
  const std::vector<FlankPlace> fitted = fitted_places(gear.relative_face), unseen = unseen_places(gear.relative_face);
  std::vector<FlankPlace> all = fitted;
  all.insert(all.end(), unseen.begin(), unseen.end());
  // What a finer mesh adds to a tooth does not reach its neighbours: one on either side will do.
  GearMeshOptions finely = fine, coarsely = coarse_mesh();
  finely.teeth_each_side = coarsely.teeth_each_side = 1;
  const InfluenceSample values = element_sample(gear, finely, all), coarse = element_sample(gear, coarsely, all);
  const auto n = static_cast<Eigen::Index>(fitted.size()), rest = static_cast<Eigen::Index>(unseen.size());
  return {{gear, fitted, values.compliance.topLeftCorner(n, n), coarse.compliance.topLeftCorner(n, n)},
          {gear, unseen, values.compliance.bottomRightCorner(rest, rest),
           coarse.compliance.bottomRightCorner(rest, rest)}};
}

RefinementEntry fit_refinement(const RefinementSamples& samples, const std::vector<double>& start) {
  FitOptions options;
  options.start = start;
  options.tooth_ridge = start.empty() ? 2.4e-4 : 1e-3;
  options.scale_floor = kScaleFloor;
  options.solver.max_iterations = 1000;  // the first, from a flat start, takes hundreds
  const FitResult result = fit_compliance({&samples.fitted, 1}, KernelForm::refinement(), options);
  RefinementEntry entry;
  entry.gear = samples.fitted.gear;
  entry.status = result.status;
  entry.iterations = result.iterations;
  entry.pairs = result.pairs;
  if (!result.fit) return entry;
  entry.coefficients = result.fit->coefficients();
  entry.fitted = residual_statistics(*result.fit, {&samples.fitted, 1}, kScaleFloor).front();
  entry.unseen = residual_statistics(*result.fit, {&samples.unseen, 1}, kScaleFloor).front();
  return entry;
}

}  // namespace flankwright
