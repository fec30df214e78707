#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/load/cycle/mesh_cycle.hpp"
#include "core/rating/life_model.hpp"

namespace flankwright {

/// A quantity of the loaded analysis that can be minimised or bounded. Units inside: MPa, mm, N/mm.
enum class Output {
  PeakContactStress,  ///< [MPa]
  TePeakToPeak,       ///< of f_t, along the flank normal [mm]
  TeHarmonic,         ///< amplitude of one order of f_t [mm]
  LoadFactor,         ///< peak line load / mean line load [-]
  PeakLineLoad,       ///< [N/mm]
  PeakRootStress,     ///< of both gears' fillets; needs DesignTask::root_stress [MPa]
  /// Number of tooth pairs that share the load, mean over the positions of 1 / sum of squared fractions: their count
  /// where they carry alike, less where one carries most; smooth, unlike the count [-]
  EffectiveContactRatio,
  EdgeStress,             ///< contact stress on tip edges, see LoadedPosition::edge_stress [MPa]
  TipEdgeShare,           ///< part of the force that tip roundings carry, see LoadedPosition::tip_edge_share [-]
  EdgeLoad,               ///< peak line load within ObjectiveTerm::edge_margin of a tip edge or a face end [N/mm]
  ContactDamage,          ///< largest contact_damage() of both gears' flanks over the scene's whole load spectrum [-]
  RootDamage,             ///< largest root_damage() of both gears' fillets over it; needs DesignTask::root_stress [-]
  LossFactor,             ///< local_loss_factor() H_VL [-]
  SpecificFilmThickness,  ///< least local_film() ratio lambda_GF of the points under load [-]
  FlashTemperature,       ///< largest local_temperature() theta_fl [K]
  ContactTemperature,     ///< largest local_temperature() theta_B [deg C]
  ContactUtilisation,     ///< reciprocals of safeties, see utilisation_outputs.hpp [-]
  RootUtilisation,        ///< needs DesignTask::root_stress
  MicropittingUtilisation,
  ScuffingUtilisation,
};

/// One output with its weight in an objective.
struct ObjectiveTerm {
  Output output{Output::PeakContactStress};
  int harmonic{0};           ///< order for TeHarmonic, 1 .. 10
  double weight{1.0};        ///< per unit of the output outside (MPa, um, N/mm), > 0
  std::string name;          ///< as the study names it: "te_harmonic_1"
  double edge_margin{0.05};  ///< of EdgeLoad: share of the common face width and of either gear's active height, 0 .. 0.5
  /// 1 / output is meant, which is large where the output is too small; only of an output that has_reciprocal().
  bool reciprocal{false};

  /// Factor from the inside unit to the unit that the weight and every report refer to (MPa, um, N/mm, 1); of a reciprocal to its reciprocal.
  double outside_factor() const;
  const char* unit() const;
  /// The name of its output: that of its row, with the order of a harmonic.
  std::string own_name() const;
};

/// Value of a smooth function of the design and its gradient with respect to the design variables [per mm].
struct SmoothValue {
  double value{not_given};
  Eigen::VectorXd gradient;
};

/// A smooth function whose maximum over all candidates is an output: the stress at one contact point or fillet point at
/// one position, the difference of f_t between two positions, one of harmonic_directions projections of a harmonic's
/// phasor, or an output that is smooth itself. Smooth while the points keep their contact.
///
/// A harmonic's amplitude |c| has a kink where c passes through zero; Re(c e^(-i theta)) has none. The projections' largest is |c| at
/// c = 0 and less than 0.5 % below it elsewhere; there the amplitude itself, exact and smooth, is a candidate as well (whole_output).
struct PeakCandidate {
  int position{-1};  ///< index into the cycle; -1 for a harmonic or a smooth output
  int other{-1};     ///< contact point, fillet point, second position of a difference, or direction; -1: the whole output

  auto operator<=>(const PeakCandidate&) const = default;
};

inline constexpr int harmonic_directions = 32;  ///< cos(pi / 32) = 0.9952
inline constexpr PeakCandidate whole_output{-1, -1};

/// One load case of a design, and what outputs may need beside its cycle.
struct LoadedScene {
  const MeshModel& model;
  const LoadedCycle& cycle;
  const Operation* operation{nullptr};            ///< null: not known
  const LifeModel* life{nullptr};                 ///< null: not known
  LoadSpectrum spectrum{};                        ///< every load case of the scene's spectrum, this one included; empty: none
  const PerGear<FilletPoints>* fillets{nullptr};  ///< of the model, where root damage is asked for
};

/// One row of the table of outputs that can be minimised or bounded: a new output is a member of Output and a row. A
/// row defines its output as the largest of smooth functions: at points of positions by `at_points`, as one smooth
/// function by `smooth`, by `candidates`, or by none of these as the differences of f_t between positions.
struct DesignOutput {
  Output output;
  std::string_view name;   ///< "te_peak_to_peak"; of the harmonics without their order, "te_harmonic"
  const char* unit;        ///< of weights, limits and reports: "um"; "1" of a plain number
  double per_inside{1.0};  ///< of that unit in one internal one
  bool has_orders{false};  ///< name_1 .. name_10

  /// At every contact point or fillet point of one position.
  using AtPoints = Eigen::VectorXd (*)(const ObjectiveTerm&, const MeshModel&, const LoadedCycle&, int position);
  using PointDerivative = Eigen::RowVectorXd (*)(const ObjectiveTerm&, const PeakCandidate&, const MeshModel&, const LoadedCycle&);
  using Smooth = SmoothValue (*)(const ObjectiveTerm&, const MeshModel&, const LoadedCycle&, int direction);
  /// All smooth functions of a load case with their values, and one of them with its gradient: an output that needs more than the cycle.
  using Candidates = std::vector<std::pair<PeakCandidate, double>> (*)(const ObjectiveTerm&, const LoadedScene&);
  using Candidate = SmoothValue (*)(const ObjectiveTerm&, const PeakCandidate&, const LoadedScene&);
  /// The output whose relative rise between the positions, and whose relative error, it has as well.
  std::optional<Output> rises_with{};
  Candidates candidates{nullptr};
  Candidate candidate{nullptr};
  /// The power of a stress or load that it grows with, in rough terms, >= 1: searches see the root, since a power spans many decades.
  double growth{1.0};
  double load_growth{1.0};    ///< likewise of the line load: half of it where Hertz' stress decides
  bool over_spectrum{false};  ///< a sum over all load cases of the spectrum, the same in each of them
  bool needs_oil{false};      ///< a lubricant and a speed
  bool of_roots{false};       ///< needs DesignTask::root_stress
  bool sees_edges{false};     ///< grows with the stress on tip edges, or with the load there
  bool is_least{false};       ///< the least of the smooth functions instead of the largest; can be bounded, not minimised
  AtPoints at_points{nullptr};
  PointDerivative point_derivative{nullptr};
  Smooth smooth{nullptr};
};

}  // namespace flankwright
