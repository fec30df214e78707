#include "studies/results/compliance_json.hpp"

#include <algorithm>

#include "core/base/units.hpp"
#include "core/compliance/fitted/correction_library.hpp"
#include "studies/results/bodies_json.hpp"

namespace flankwright::studies {

namespace {

Json gear_run_json(const GearRun& run, const Material& material) {
  const RunStatistics& statistics = run.statistics;
  const InfluenceTable& table = *run.table;
  return {{"source", run.from_cache ? "cache" : "solved"},
          {"file", run.file},
          {"seconds", run.seconds},
          {"bricks", statistics.bricks},
          {"unknowns", statistics.unknowns},
          {"factor_entries", statistics.factor_entries},
          {"peak_memory_bytes", statistics.peak_bytes},
          {"model_seconds", statistics.model_seconds},
          {"loads_seconds", statistics.solve_seconds},
          {"teeth_apart", table.teeth_apart()},
          {"root_stress", run.root_stress != nullptr},
          {"grid", {{"radii", table.grid().us().size()}, {"axial_positions", table.grid().zetas().size()}}},
          {"removed_shaft_motion", name_of(run.removed)},
          {"lowest_eigenvalue", table.projection().lowest_eigenvalue},
          {"projection", table.projection().added},
          {"youngs_modulus_MPa", material.youngs_modulus},
          {"poissons_ratio", material.poissons_ratio},
          {"body", body_json(run.body)}};
}

Json residuals_json(const ResidualStatistics& residuals) {
  return {{"teeth_apart", residuals.teeth_apart},
          {"pairs", residuals.pairs},
          {"median", 100 * residuals.median},
          {"share_95", 100 * residuals.share_95},
          {"worst", 100 * residuals.worst}};
}

/// Where the kernels of one gear come from, and how close its own fit comes.
Json correction_json(const GearCorrection& correction) {
  Json json{{"source", correction.source()}};
  if (correction.unknown.empty()) return json;
  json["why"] = correction.unknown;
  json["file"] = correction.file;
  json["from_cache"] = correction.from_cache;
  json["seconds"] = correction.seconds;
  json["status"] = to_string(correction.fit.status);
  json["steps"] = correction.fit.iterations;
  json["fit_seconds"] = correction.fit.seconds;
  json["range"] = {{"u", {-1, 1}}, {"zeta", {0, correction.fit.gear.relative_face}}};
  json["residual_percent"] = {{"fitted", residuals_json(correction.fit.fitted)}, {"unseen", Json::array()}};
  for (const ResidualStatistics& residuals : correction.residuals) {
    json["residual_percent"]["unseen"].push_back(residuals_json(residuals));
  }
  json["covariance"] = covariance_json(KernelForm::correction(), correction.fit.coefficients, correction.fit.covariance);
  return json;
}

/// The library that completes the coarse values, and how close its own gears come, the least close of each figure.
Json fits_json(const CorrectionLibrary& library) {
  ResidualStatistics worst{0, 0, 0, 0, 0};
  for (const CorrectionEntry& entry : library.entries()) {
    worst.pairs += entry.unseen.pairs;
    worst.median = std::max(worst.median, entry.unseen.median);
    worst.share_95 = std::max(worst.share_95, entry.unseen.share_95);
    worst.worst = std::max(worst.worst, entry.unseen.worst);
  }
  const CorrectionGrid& standard = library.standard();
  const auto ends = [](const auto& values) { return Json{values.front(), values.back()}; };
  return {
      {"gears", library.entries().size()},
      {"teeth", ends(standard.teeth())},
      {"helix_angle_deg", {standard.helix_angles().front() / units::deg, standard.helix_angles().back() / units::deg}},
      {"profile_shift", ends(standard.profile_shifts())},
      {"interpolation", "polynomials through all gears in 1/z, helix angle and profile shift; departures of other racks and pressure angles added"},
      {"largest_residual_percent", residuals_json(worst)}};
}

}  // namespace

const char* name_of(RemovedRigidMotion removed) {
  switch (removed) {
    case RemovedRigidMotion::None:
      return "none";
    case RemovedRigidMotion::TranslationAndTorsion:
      return "transverse translation and torsion";
    case RemovedRigidMotion::TranslationTorsionAndTilt:
      return "transverse translation, torsion and tilt";
    case RemovedRigidMotion::WholeTranslationTorsionAndTilt:
      return "translation, torsion and tilt";
  }
  __builtin_unreachable();
}

Json compliance_json(const GearStructures& structures, const Study& study) {
  const FiniteElementRuns& runs = *structures.finite_elements;
  const auto gear = [&](Member member, const Material& material) {
    Json json = gear_run_json(runs[member], material);
    if (const auto& fine = runs.fine[member]) json["fine_mesh"] = gear_run_json(*fine, material);
    if (const auto& rigid = runs.rigid_body[member]) json["rigid_body"] = gear_run_json(*rigid, material);
    if (const auto& narrow = runs.narrow[member]) json["coarse_mesh_of_fit"] = gear_run_json(*narrow, material);
    if (const auto& correction = structures.corrections[member]) json["fit"] = correction_json(*correction);
    return json;
  };
  Json json{{"model", to_string(study.fidelity.compliance)},
            {"seconds", runs.seconds},
            {"pinion", gear(Member::Pinion, study.material.pinion)},
            {"wheel", gear(Member::Wheel, study.material.wheel)}};
  if (structures.corrections[Member::Pinion]) json["fits"] = fits_json(CorrectionLibrary::shipped());
  return json;
}

Json covariance_json(const KernelForm& form, const std::vector<double>& coefficients, const Eigen::MatrixXd& covariance) {
  Json rows = Json::array();
  for (Eigen::Index i = 0; i < covariance.rows(); ++i) {
    Json row = Json::array();
    for (Eigen::Index j = 0; j <= i; ++j) row.push_back(covariance(i, j));
    rows.push_back(std::move(row));
  }
  return {{"coefficient", form.coefficient_names()}, {"value", coefficients}, {"lower_triangle", std::move(rows)}};
}

Json curve_json(const DeflectionCurve& curve) {
  return {{"model", curve.model},
          {"load", {{"u", curve.load.u}, {"zeta", curve.load.zeta}}},
          {"tooth", curve.tooth},
          {"zeta", curve.zeta},
          {"value", curve.value}};
}

Json deflections_json(const GearDeflections& deflections) {
  return {{"gear", name_of(deflections.member)}, {"teeth", deflections.teeth}, {"curves", list(deflections.curves, curve_json)}};
}

}  // namespace flankwright::studies
