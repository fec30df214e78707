#include "studies/results/gradients_json.hpp"

#include <cmath>

#include "core/fidelity/cycle_quantities.hpp"
#include "core/load/cycle/perturbed_position.hpp"
#include "core/rating/position_gradient.hpp"
#include "core/rating/shaft_misalignment.hpp"
#include "studies/analysis/rims.hpp"
#include "studies/results/gradient_rows.hpp"

namespace flankwright::studies {

namespace {

Json located_json(const PeakGradients& peaks, const GradientRows& outside) {
  const auto pair = [&](const PeakGradients::Pair& of) {
    return Json{{"contact_stress_MPa", outside.row(of.contact_stress)}, {"load_N_per_mm", outside.row(of.line_load)}};
  };
  return {{"without_spikes", pair(peaks.without_spikes)}, {"with_spikes", pair(peaks.with_spikes)}};
}

Json located_json(const LoadRating& rating, const GradientRows& outside) {
  Json json = located_json(rating.peak_gradients, outside);
  json["perfect_pair"] = located_json(rating.perfect_gradients, outside);
  return json;
}

Json factors_json(const LoadRating& rating, const GradientRows& outside) {
  const auto triple = [&](const LoadFactorGradients::Triple& of) {
    return Json{{"K_Hbeta", outside.row(of.lead)},
                {"K_Halpha", outside.row(of.profile)},
                {"K_H", outside.row(of.combined)},
                {"K_Hbeta_times_K_Halpha", outside.row(of.product)}};
  };
  return {{"without_spikes", triple(rating.factor_gradients.without_spikes)},
          {"with_spikes", triple(rating.factor_gradients.with_spikes)},
          {"line_load", triple(rating.factor_gradients.line_load)}};
}

Json iso_gradient_json(const LoadedResult& loaded, const MeshModel& model, const GradientRows& outside, const ShaftMisalignment& shafts) {
  const IsoGradient iso = iso_gradient(model, loaded.condition, loaded.iso, loaded.cycle, outside.parameters(), shafts);
  return {{"K_Hbeta", outside.row(iso.lead)},
          {"K_Halpha", outside.row(iso.profile)},
          {"K_H", outside.row(iso.combined)},
          {"F_beta_y_um", outside.row(iso.misalignment, units::um)},
          {"specific_load_N_per_mm", outside.row(iso.specific_load)}};
}

Json summary_gradient_json(const LoadedResult& loaded, const MeshModel& model, const GradientRows& outside, const ShaftMisalignment& shafts,
                           bool full_cycle) {
  const CycleGradient summary = resolved_gradient(model, loaded.cycle, loaded.resolved);
  const auto tangent = [&](const CycleGradient::Root& root) {
    return root.tangent_stress.size() == 0 ? Json() : Json{{"at_30_deg_tangent_MPa", outside.row(root.tangent_stress)}};
  };
  Json json = Json::object();
  for (const CycleQuantity& quantity : cycle_quantities()) {
    const Eigen::MatrixXd rows = quantity.gradients(loaded.summary, summary);
    Json& entry = json[std::string(quantity.key)];
    if (quantity.is_list) {
      entry = full_cycle ? outside.rows(rows, quantity.unit_size) : Json::array();
    } else {
      entry = rows.size() == 0 ? Json() : outside.row(rows.row(0), quantity.unit_size);
    }
  }
  json.update({{"pinion_root_stress", tangent(summary.pinion_root_stress)},
               {"wheel_root_stress", tangent(summary.wheel_root_stress)},
               {"peaks", loaded.rating ? located_json(*loaded.rating, outside) : Json()},
               {"load_factors", loaded.rating ? factors_json(*loaded.rating, outside) : Json()},
               {"iso6336", iso_gradient_json(loaded, model, outside, shafts)}});
  return json;
}

/// teeth[] of a position, as position_json() has them.
Json teeth_json(const MeshPosition& at, const LoadedPosition& position, const PositionGradient& gradient, const std::vector<LineEnd>& ends,
                const GradientRows& outside) {
  Json teeth = Json::array();
  const auto um = [&](const Eigen::MatrixXd& of, Eigen::Index i) { return outside.row(of.row(i), units::um); };
  const std::vector<ToothShare> shares = load_sharing(at, position);
  for (Eigen::Index k = 0, i = 0, e = 0; k < std::ssize(shares); ++k) {
    const int tooth = shares[static_cast<std::size_t>(k)].tooth;
    Json points = Json::array(), line_ends = Json::array();
    for (; i < std::ssize(at.points) && at.points[static_cast<std::size_t>(i)].tooth == tooth; ++i) {
      points.push_back({{"load_N_per_mm", outside.row(position.line_load_derivative.row(i))},
                        {"contact_stress_MPa", outside.row(position.contact_stress_derivative.row(i))},
                        {"contact_deflection_um", um(gradient.contact_deflection, i)},
                        {"structural_deflection_um", um(gradient.structural_deflection, i)},
                        {"gap_um", um(gradient.gap, i)},
                        {"error_um", um(gradient.error, i)}});
    }
    for (; e < std::ssize(ends) && ends[static_cast<std::size_t>(e)].tooth == tooth; ++e) {
      line_ends.push_back(
          {{"load_N_per_mm", outside.row(gradient.line_end_load.row(e))}, {"contact_stress_MPa", outside.row(gradient.line_end_stress.row(e))}});
    }
    Json entry{{"tooth", tooth}, {"points", std::move(points)}, {"line_ends", std::move(line_ends)}, {"share", outside.row(gradient.shares.row(k))}};
    for (const auto& [member, key] : {std::pair{Member::Pinion, "pinion_root_stress_MPa"}, std::pair{Member::Wheel, "wheel_root_stress_MPa"}}) {
      const Eigen::Index highest = highest_root_stress(at, position, {member, tooth});
      if (highest >= 0) entry[key] = outside.row(root_stress_derivative(at, position, highest));
    }
    teeth.push_back(std::move(entry));
  }
  return teeth;
}

/// Of ShaftMotion, row for row.
struct ShaftGradient {
  Eigen::RowVectorXd displacement, misalignment;
};

/// A shaft's motion is linear in the forces.
ShaftGradient shaft_gradient(const ShaftPair& shafts, Member member, const LoadedResult& loaded, const MeshModel& model, std::size_t i,
                             const PositionGradient& position, const std::vector<MeshParameter>& parameters) {
  const Eigen::Index m = position.point_force.cols();
  ShaftGradient gradient{Eigen::RowVectorXd(m), Eigen::RowVectorXd(m)};
  for (Eigen::Index p = 0; p < m; ++p) {
    const ShaftMotion motion = shafts.motion_by(member, model.positions[i].points, position.point_force.col(p), model.axial_offset);
    gradient.displacement[p] = motion.displacement;
    gradient.misalignment[p] = motion.misalignment;
  }
  for (const Eigen::Index p : moving_among(model.placement.gap, parameters)) {
    const auto parameter = std::get<MisalignmentParameter>(parameters[static_cast<std::size_t>(p)]);
    const PerturbedPosition way(model, loaded.condition, loaded.cycle.positions[i], i, parameter, p);
    const auto motion = [&](const PerturbedPosition::Stage& s) {
      return shafts.motion(member, s.at.points, s.at.weight.cwiseProduct(s.loaded.load.line_load), s.model.axial_offset);
    };
    gradient.displacement[p] = way.slope([&](const PerturbedPosition::Stage& s) { return motion(s).displacement; });
    gradient.misalignment[p] = way.slope([&](const PerturbedPosition::Stage& s) { return motion(s).misalignment; });
  }
  return gradient;
}

/// shafts[] of one position, as add_shaft_motion() has them.
/// @param sum  the mesh's misalignment is added to it
Json shafts_gradient_json(const ShaftPair& shafts, const LoadedResult& loaded, const MeshModel& model, std::size_t i,
                          const PositionGradient& position, const GradientRows& outside, Eigen::RowVectorXd& sum) {
  Json entry{{"phase", model.positions[i].phase}};
  Eigen::RowVectorXd together = Eigen::RowVectorXd::Zero(position.point_force.cols());
  for (const auto& [member, name] : {std::pair{Member::Pinion, "pinion"}, std::pair{Member::Wheel, "wheel"}}) {
    entry[name] = nullptr;
    if (!shafts.has_shaft(member)) continue;
    const ShaftGradient gradient = shaft_gradient(shafts, member, loaded, model, i, position, outside.parameters());
    entry[name] = {{"displacement_um", outside.row(gradient.displacement, units::um)},
                   {"misalignment_um", outside.row(gradient.misalignment, units::um)}};
    together += gradient.misalignment;
  }
  entry["mesh_misalignment_um"] = outside.row(together, units::um);
  sum += together;
  return entry;
}

/// f_sh with what rims on webs open beside it, in proportion to the torque.
ShaftMisalignment with_rims(ShaftMisalignment shafts, double rim_opening, double torque, const std::vector<MeshParameter>& parameters) {
  shafts.value += rim_opening;
  for (std::size_t p = 0; p < parameters.size(); ++p) {
    if (std::holds_alternative<PinionTorque>(parameters[p])) shafts.derivative[static_cast<Eigen::Index>(p)] += rim_opening / torque;
  }
  return shafts;
}

}  // namespace

bool has_gradients(const StudyResults& results) { return results.study.task->one_design && !results.study.gradients.empty(); }

Json gradients_json(const LoadedResult& loaded, const StudyResults& results) {
  const Study& study = results.study;
  const MeshModel& model = results.models[loaded.model];
  const GradientRows outside(study.gradients);
  const double cos_base_helix = std::cos(model.pair.base_helix_angle);
  Json cycle = Json::array(), shafts = Json::array();
  ShaftMisalignment by_shafts{0.0, Eigen::RowVectorXd::Zero(loaded.cycle.force_derivative.size())};
  const std::optional<ShaftPair> at_load = results.shafts ? std::optional(shafts_under(*results.shafts, model, loaded.torque)) : std::nullopt;
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const LoadedPosition& position = loaded.cycle.positions[i];
    const std::vector<LineEnd> ends = line_ends(model, model.positions[i], position, loaded.condition);
    const PositionGradient gradient = position_gradient(model, loaded.condition, loaded.cycle, i, ends, outside.parameters());
    cycle.push_back({{"phase", position.phase},
                     {"te_um", outside.row(position.transmission_error_derivative, units::um)},
                     {"te_base_tangent_um", outside.row(position.transmission_error_derivative, units::um * cos_base_helix)},
                     {"stiffness_N_per_mm_um", outside.row(stiffness_derivative(loaded.cycle, position))},
                     {"teeth", teeth_json(model.positions[i], position, gradient, ends, outside)}});
    if (at_load) shafts.push_back(shafts_gradient_json(*at_load, loaded, model, i, gradient, outside, by_shafts.derivative));
  }
  by_shafts.derivative /= static_cast<double>(loaded.cycle.positions.size());
  if (at_load) by_shafts.value = shaft_misalignment(*at_load, loaded.shaft_motions);
  const ShaftMisalignment by_bodies = with_rims(by_shafts, rim_opening(results, model, loaded.torque), loaded.torque, outside.parameters());
  Json json{{"parameters", list(study.gradients, [](const GradientParameter& p) { return p.path; })},
            {"units", list(study.gradients, [](const GradientParameter& p) { return p.unit; })},
            {"normal_force_N", outside.row(loaded.cycle.force_derivative)},
            {"summary", summary_gradient_json(loaded, model, outside, by_bodies, study.cycle.phases.empty())},
            {"cycle", std::move(cycle)}};
  if (results.shafts) {
    json["summary"]["shaft_misalignment_um"] = outside.row(by_shafts.derivative, units::um);
    json["shafts"] = std::move(shafts);
  }
  return json;
}

}  // namespace flankwright::studies
