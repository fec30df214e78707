#include "optimize/design/outputs/design_output.hpp"

#include <array>
#include <cmath>
#include <complex>
#include <map>

#include "core/fidelity/cycle_quantities.hpp"
#include "optimize/design/outputs/utilisation_outputs.hpp"

namespace flankwright {

namespace {

/// Among the exponents of ISO 6336 by stress: 13.2 of flanks, 6.2 to 17 of roots (nitrocarburised steel aside).
constexpr double damage_growth = 10.0;

const LoadedPosition& at(const LoadedCycle& cycle, int position) { return cycle.positions[static_cast<std::size_t>(position)]; }

/// The amplitude, or the phasor's projection onto a direction.
SmoothValue harmonic(const ObjectiveTerm& term, const MeshModel&, const LoadedCycle& cycle, int direction) {
  const TeHarmonic found = te_harmonic(cycle, term.harmonic);
  if (direction < 0) return {found.amplitude, found.derivative.transpose()};
  const std::complex<double> turn = std::polar(1.0, -2.0 * units::pi * direction / harmonic_directions);
  return {(turn * found.phasor).real(), (turn * found.phasor_derivative).real().transpose()};
}

/// Mean over the positions of 1 / sum_k s_k^2 with the shares s_k of the tooth pairs, and its derivative.
SmoothValue effective_contact_ratio(const ObjectiveTerm&, const MeshModel& model, const LoadedCycle& cycle, int) {
  const auto n = static_cast<double>(cycle.positions.size());
  const Eigen::Index m = cycle.positions.front().line_load_derivative.cols();
  SmoothValue mean{0.0, Eigen::VectorXd::Zero(m)};
  for (std::size_t i = 0; i < cycle.positions.size(); ++i) {
    const MeshPosition& place = model.positions[i];
    const LoadedPosition& position = cycle.positions[i];
    std::map<int, SmoothValue> shares;
    for (Eigen::Index j = 0; j < place.weight.size(); ++j) {
      SmoothValue& share =
          shares.try_emplace(place.points[static_cast<std::size_t>(j)].tooth, SmoothValue{0.0, Eigen::VectorXd::Zero(m)}).first->second;
      share.value += place.weight[j] * position.load.line_load[j] / cycle.force;
      if (m > 0) share.gradient += place.weight[j] / cycle.force * position.line_load_derivative.row(j).transpose();
    }
    double squares = 0.0;
    Eigen::VectorXd slope = Eigen::VectorXd::Zero(m);
    for (const auto& [tooth, share] : shares) {
      squares += share.value * share.value;
      slope += 2.0 * share.value * share.gradient;
    }
    mean.value += 1.0 / (squares * n);
    mean.gradient -= slope / (squares * squares * n);
  }
  return mean;
}

/// Whether a contact point lies within a share of the face's ends or of either gear's tip.
bool is_near_edge(const MeshModel& model, const ContactPoint& point, double margin) {
  const auto near_tip = [&](Member member, double radius) {
    const Gear& gear = model.pair[member];
    return radius > gear.tip_form_radius - margin * (gear.tip_form_radius - gear.active_root_radius);
  };
  const double inset = margin * model.face_width;
  return point.z < model.face_start() + inset || point.z > model.face_end() - inset || near_tip(Member::Pinion, point.pinion_radius) ||
         near_tip(Member::Wheel, point.wheel_radius);
}

Eigen::VectorXd contact_stresses(const ObjectiveTerm&, const MeshModel&, const LoadedCycle& cycle, int position) {
  return at(cycle, position).contact_stress;
}

Eigen::RowVectorXd contact_stress_slope(const ObjectiveTerm&, const PeakCandidate& candidate, const MeshModel&, const LoadedCycle& cycle) {
  return at(cycle, candidate.position).contact_stress_derivative.row(candidate.other);
}

Eigen::VectorXd edge_stresses(const ObjectiveTerm&, const MeshModel&, const LoadedCycle& cycle, int position) {
  const LoadedPosition& there = at(cycle, position);
  return there.edge_stress.size() > 0 ? there.edge_stress : Eigen::VectorXd::Zero(there.load.line_load.size());
}

Eigen::RowVectorXd edge_stress_slope(const ObjectiveTerm&, const PeakCandidate& candidate, const MeshModel&, const LoadedCycle& cycle) {
  const LoadedPosition& there = at(cycle, candidate.position);
  if (there.edge_stress.size() == 0) return Eigen::RowVectorXd::Zero(there.line_load_derivative.cols());
  return there.edge_stress_derivative.row(candidate.other);
}

/// One value a position.
Eigen::VectorXd tip_edge_shares(const ObjectiveTerm&, const MeshModel&, const LoadedCycle& cycle, int position) {
  const double share = at(cycle, position).tip_edge_share;
  return Eigen::VectorXd::Constant(1, std::isnan(share) ? 0.0 : share);
}

Eigen::RowVectorXd tip_edge_share_slope(const ObjectiveTerm&, const PeakCandidate& candidate, const MeshModel&, const LoadedCycle& cycle) {
  const LoadedPosition& there = at(cycle, candidate.position);
  if (std::isnan(there.tip_edge_share)) return Eigen::RowVectorXd::Zero(there.line_load_derivative.cols());
  return there.tip_edge_share_derivative;
}

Eigen::VectorXd line_loads(const ObjectiveTerm&, const MeshModel&, const LoadedCycle& cycle, int position) { return at(cycle, position).peak_load; }

Eigen::RowVectorXd line_load_slope(const ObjectiveTerm&, const PeakCandidate& candidate, const MeshModel&, const LoadedCycle& cycle) {
  return at(cycle, candidate.position).peak_load_derivative.row(candidate.other);
}

Eigen::VectorXd load_factors(const ObjectiveTerm&, const MeshModel& model, const LoadedCycle& cycle, int position) {
  return at(cycle, position).peak_load / model.mean_line_load(cycle.force);
}

Eigen::RowVectorXd load_factor_slope(const ObjectiveTerm&, const PeakCandidate& candidate, const MeshModel& model, const LoadedCycle& cycle) {
  return load_factor_derivative(model, cycle, candidate.position, candidate.other);
}

Eigen::VectorXd fillet_stresses(const ObjectiveTerm&, const MeshModel& model, const LoadedCycle& cycle, int index) {
  const LoadedPosition& position = at(cycle, index);
  const bool is_there = position.root_stress.size() > 0;  // else of an objective that the analysis was not made for
  return is_there ? position.root_stress : root_stresses(model.positions[static_cast<std::size_t>(index)], position.load);
}

Eigen::RowVectorXd fillet_stress_slope(const ObjectiveTerm&, const PeakCandidate& candidate, const MeshModel& model, const LoadedCycle& cycle) {
  return root_stress_derivative(model.positions[static_cast<std::size_t>(candidate.position)], at(cycle, candidate.position), candidate.other);
}

bool is_edge_point(const ObjectiveTerm& term, const MeshModel& model, int position, Eigen::Index point) {
  return is_near_edge(model, model.positions[static_cast<std::size_t>(position)].points[static_cast<std::size_t>(point)], term.edge_margin);
}

Eigen::VectorXd edge_loads(const ObjectiveTerm& term, const MeshModel& model, const LoadedCycle& cycle, int position) {
  Eigen::VectorXd loads = at(cycle, position).peak_load;
  for (Eigen::Index j = 0; j < loads.size(); ++j) {
    if (!is_edge_point(term, model, position, j)) loads[j] = 0.0;
  }
  return loads;
}

Eigen::RowVectorXd edge_load_slope(const ObjectiveTerm& term, const PeakCandidate& candidate, const MeshModel& model, const LoadedCycle& cycle) {
  const Eigen::MatrixXd& slopes = at(cycle, candidate.position).peak_load_derivative;
  if (is_edge_point(term, model, candidate.position, candidate.other)) return slopes.row(candidate.other);
  return Eigen::RowVectorXd::Zero(slopes.cols());
}

constexpr std::array rows{
    DesignOutput{.output = Output::PeakContactStress,
                 .name = "peak_contact_stress",
                 .unit = "MPa",
                 .sees_edges = true,
                 .at_points = contact_stresses,
                 .point_derivative = contact_stress_slope},
    DesignOutput{.output = Output::TePeakToPeak, .name = "te_peak_to_peak", .unit = "um", .per_inside = 1.0 / units::um},
    DesignOutput{
        .output = Output::TeHarmonic, .name = "te_harmonic", .unit = "um", .per_inside = 1.0 / units::um, .has_orders = true, .smooth = harmonic},
    DesignOutput{.output = Output::LoadFactor, .name = "load_factor", .unit = "1", .at_points = load_factors, .point_derivative = load_factor_slope},
    DesignOutput{
        .output = Output::PeakLineLoad, .name = "peak_line_load", .unit = "N/mm", .at_points = line_loads, .point_derivative = line_load_slope},
    DesignOutput{.output = Output::PeakRootStress,
                 .name = "peak_root_stress",
                 .unit = "MPa",
                 .of_roots = true,
                 .at_points = fillet_stresses,
                 .point_derivative = fillet_stress_slope},
    DesignOutput{.output = Output::EffectiveContactRatio, .name = "effective_contact_ratio", .unit = "1", .smooth = effective_contact_ratio},
    DesignOutput{.output = Output::EdgeStress,
                 .name = "edge_stress",
                 .unit = "MPa",
                 .sees_edges = true,
                 .at_points = edge_stresses,
                 .point_derivative = edge_stress_slope},
    DesignOutput{.output = Output::TipEdgeShare,
                 .name = "tip_edge_share",
                 .unit = "1",
                 .sees_edges = true,
                 .at_points = tip_edge_shares,
                 .point_derivative = tip_edge_share_slope},
    DesignOutput{.output = Output::EdgeLoad, .name = "edge_load", .unit = "N/mm", .at_points = edge_loads, .point_derivative = edge_load_slope},
    DesignOutput{.output = Output::ContactDamage,
                 .name = "contact_damage",
                 .unit = "1",
                 .candidates = contact_damages,
                 .candidate = contact_damage_of,
                 .growth = damage_growth,
                 .load_growth = 0.5 * damage_growth,
                 .over_spectrum = true,
                 .sees_edges = true},
    DesignOutput{.output = Output::RootDamage,
                 .name = "root_damage",
                 .unit = "1",
                 .candidates = root_damages,
                 .candidate = root_damage_of,
                 .growth = damage_growth,
                 .load_growth = damage_growth,
                 .over_spectrum = true,
                 .of_roots = true},
    DesignOutput{.output = Output::LossFactor, .name = "loss_factor", .unit = "1", .candidates = loss_factors, .candidate = loss_factor_of},
    DesignOutput{.output = Output::SpecificFilmThickness,
                 .name = "specific_film_thickness",
                 .unit = "1",
                 .candidates = film_ratios,
                 .candidate = film_ratio_of,
                 .needs_oil = true,
                 .sees_edges = true,
                 .is_least = true},
    DesignOutput{.output = Output::FlashTemperature,
                 .name = "flash_temperature",
                 .unit = "K",
                 .candidates = flash_temperatures,
                 .candidate = flash_temperature_of,
                 .needs_oil = true,
                 .sees_edges = true},
    DesignOutput{.output = Output::ContactTemperature,
                 .name = "contact_temperature",
                 .unit = "degC",
                 .candidates = contact_temperatures,
                 .candidate = contact_temperature_of,
                 .needs_oil = true,
                 .sees_edges = true},
    DesignOutput{.output = Output::ContactUtilisation,
                 .name = "contact_utilisation",
                 .unit = "1",
                 .rises_with = Output::PeakContactStress,
                 .candidates = contact_utilisations,
                 .candidate = contact_utilisation_of,
                 .sees_edges = true},
    DesignOutput{.output = Output::RootUtilisation,
                 .name = "root_utilisation",
                 .unit = "1",
                 .rises_with = Output::PeakRootStress,
                 .candidates = root_utilisations,
                 .candidate = root_utilisation_of,
                 .of_roots = true},
    DesignOutput{.output = Output::MicropittingUtilisation,
                 .name = "micropitting_utilisation",
                 .unit = "1",
                 .candidates = micropitting_utilisations,
                 .candidate = micropitting_utilisation_of,
                 .needs_oil = true,
                 .sees_edges = true},
    DesignOutput{.output = Output::ScuffingUtilisation,
                 .name = "scuffing_utilisation",
                 .unit = "1",
                 .candidates = scuffing_utilisations,
                 .candidate = scuffing_utilisation_of,
                 .needs_oil = true,
                 .sees_edges = true},
};

constexpr bool in_order() {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (static_cast<std::size_t>(rows[i].output) != i) return false;
  }
  return true;
}
static_assert(in_order());

}  // namespace

double ObjectiveTerm::outside_factor() const {
  const double factor = design_output(output).per_inside;
  return reciprocal ? 1.0 / factor : factor;
}

const char* ObjectiveTerm::unit() const { return design_output(output).unit; }

std::span<const DesignOutput> design_outputs() { return rows; }

const DesignOutput& design_output(Output output) { return rows[static_cast<std::size_t>(output)]; }

bool has_reciprocal(const DesignOutput& row) { return row.is_least || (row.smooth != nullptr && !row.has_orders); }

std::string ObjectiveTerm::own_name() const {
  std::string own(design_output(output).name);
  if (harmonic > 0) own.append("_").append(std::to_string(harmonic));
  return own;
}

std::optional<ObjectiveTerm> find_term(std::string_view name) {
  for (const DesignOutput& row : rows) {
    for (int order = row.has_orders ? 1 : 0; order <= (row.has_orders ? highest_te_harmonic : 0); ++order) {
      ObjectiveTerm term{.output = row.output, .harmonic = order, .weight = 1.0, .name = std::string(name)};
      if (term.own_name() == name) return term;
    }
  }
  return std::nullopt;
}

std::vector<std::string> term_names() {
  std::vector<std::string> names, with_orders;
  for (const DesignOutput& row : rows) {
    if (!row.has_orders) names.emplace_back(row.name);
    for (int order = 1; row.has_orders && order <= highest_te_harmonic; ++order) {
      with_orders.push_back(ObjectiveTerm{.output = row.output, .harmonic = order, .name = {}}.own_name());
    }
  }
  names.insert(names.end(), with_orders.begin(), with_orders.end());
  return names;
}

}  // namespace flankwright
