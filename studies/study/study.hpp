#pragma once

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/compliance/finite_element/section_mesh.hpp"
#include "core/compliance/model/compliance_model.hpp"
#include "core/compliance/shaft/unit_data.hpp"
#include "core/contact/path/contact_points.hpp"
#include "core/contact/assembly/misalignment.hpp"
#include "core/fidelity/resolved_analysis.hpp"
#include "core/gear/gear_data.hpp"
#include "core/flank/modifications/modification.hpp"
#include "core/load/cycle/mesh_parameter.hpp"
#include "optimize/design/problem/design_task.hpp"
#include "studies/study/life_table.hpp"
#include "studies/study/scene_tolerance.hpp"
#include "studies/study/task.hpp"
#include "studies/study/task_tables.hpp"

/// A study as pure data: the contents of a study file, validated, in internal units (mm, N, rad, MPa); study_file.hpp reads.
namespace flankwright::studies {

struct Cycle {
  int positions{32};                 ///< mesh positions over one base pitch, >= 1
  bool automatic_positions{true};    ///< doubled from `positions` on where the figures need more; `positions` without load
  std::optional<bool> locate_peaks;  ///< as the study says; see locates_peaks()
  std::vector<double> phases;        ///< explicit phases of the reference tooth pair [base pitches]; empty: use `positions`
};

/// Whether and how the sizes of effects are found.
enum class EffectSizing { Off, Estimated, Exact };

struct Fidelity {
  ComplianceModel compliance{ComplianceModel::Fitted};
  GapModel gap{GapModel::PlaneOfAction};
  Quadrature quadrature{QuadratureRule::Graded, 12};
  bool automatic_intervals{true};  ///< doubled from those of `quadrature` on where the figures need more
  bool automatic_effects{true};
  std::vector<std::string> effects;  ///< switched on by hand where automatic_effects is false
  std::optional<double> accuracy;    ///< share that the rest shall keep, as far as it is not given; see choose_models()
  /// Share of its figures within which a run refines intervals and positions that are not given, see headline_error(); of an accuracy what its models leave.
  double resolution_accuracy{AutomaticResolution{}.accuracy};
  EffectSizing effect_sizes{EffectSizing::Estimated};
};

/// One working condition: base tables of the study with the scene's overrides applied.
struct Scene {
  std::string name{"nominal"};
  double weight{1.0};
  Misalignment misalignment;
  std::vector<double> torques;  ///< on the pinion [N mm], >= 0
  PerGear<ManufacturingError> error;
  double speed{not_given};                          ///< of the pinion [rad/s]; NaN: not given, or that of each bin of a spectrum
  std::vector<ModificationDeviation> deviations{};  ///< of drawn gears from their design
  std::optional<WorkingFlank> working_flank{};      ///< of the pinion, that this scene loads; nothing: the pair's
  int draw{-1};                                     ///< which drawn pair of gears it is of; -1: none
};

/// A measured or topological flank: the file that the study names and what was read from it.
struct GivenGrid {
  std::string file;                                            ///< as written; empty: none
  std::optional<int> profile_pieces, face_pieces;              ///< of a smoothed surface; empty: it passes through every point
  int rows{0}, columns{0};                                     ///< radii and axial positions
  double lowest_radius{not_given}, highest_radius{not_given};  ///< [mm]
  double lowest_z{not_given}, highest_z{not_given};            ///< [mm]
  double rms{not_given}, largest{not_given};                   ///< distance of the fitted surface from the points [mm]
};

/// One parameter of analyse.gradients.
struct GradientParameter {
  std::string path;  ///< as the study names it: "misalignment.crossing"
  MeshParameter parameter;
  std::string unit;       ///< of a bare number of that key
  double unit_size{1.0};  ///< one such unit in internal ones
};

/// [expect]: one key of results.json and its expected value.
struct Expectation {
  std::string key;  ///< dotted path, array indices as numbers; "loaded.summary.x" means every entry of loaded
  double value{std::numeric_limits<double>::quiet_NaN()};
  double within_relative{std::numeric_limits<double>::quiet_NaN()};  ///< "2 %" -> 0.02
  double within_absolute{std::numeric_limits<double>::quiet_NaN()};
  double minimum{-std::numeric_limits<double>::infinity()};
  double maximum{std::numeric_limits<double>::infinity()};
  std::string is{};  ///< text as it is, or "true" / "false"; empty: a number is expected
};

/// A key as written in the file or on the command line, for the `given` part of the results.
struct GivenValue {
  std::string key;    ///< dotted path
  std::string value;  ///< as written
};

/// Load cases whose contact points are in the results: all, or those that govern.
enum class CasesWithPoints { All, Governing };

struct Study {
  std::string title;
  std::string file;                              ///< path as given
  const Task* task{registered_tasks().front()};  ///< never null
  PairData pair;
  PerGear<Modification> modification;             ///< with the field of the grid below
  PerGear<GivenGrid> grid, opposite_grid;         ///< of the pair's own flanks and of the opposite ones
  PerGear<std::vector<std::string>> tooth_grids;  ///< files of single teeth's errors, empty: none of this tooth
  PerGear<ManufacturingError> error;
  Misalignment misalignment;
  PerGear<Material> material;
  PerGear<GearBody> body;                   ///< bodies below the teeth in finite elements
  PerGear<std::optional<ShaftData>> shaft;  ///< empty: rigid
  UnitData unit;                            ///< around the pair's shafts
  std::vector<double> torques;              ///< base [load] torque list [N mm]; {0} where [load] is absent
  std::vector<SpectrumBin> spectrum;        ///< empty: none; else every scene's torques are those of its bins, in their order
  SpectrumSource spectrum_source;           ///< of its bins, where a file has them
  std::optional<CountedSignal> signal;      ///< that its bins were counted from
  LifeTable life;
  double marking_thickness{6.35e-3};  ///< of the compound that shows the bearing pattern [mm], > 0
  Cycle cycle;
  Fidelity fidelity;
  std::vector<Scene> scenes;                 ///< never empty: without [[scenes]] the one nominal scene of the base tables
  std::vector<GradientParameter> gradients;  ///< derivatives asked for; meaningful where the task is "analyse"
  TaskTables tables;                         ///< what it says to its tasks, see table()
  std::vector<SceneTolerance> tolerances;    ///< of assembly and manufacture; those of tolerance_class among them
  std::optional<int> tolerance_class;        ///< of both gears; none: tolerances are given one by one
  std::optional<CasesWithPoints>
      points{};                      ///< load cases whose contact points are in the results; none: by how many there are, see cases_with_points()
  std::optional<int> drawing_class;  ///< of the drawing of the flanks; none: that of the tolerances
  std::vector<Expectation> expect;
  std::vector<GivenValue> given;
  std::string text;  ///< all of it as TOML, with what the command line set

  /// The table of a task, which declares its type in its folder; as it begins where the study says nothing of it.
  template <class Table>
  const Table& table() const {
    return tables.get<Table>();
  }
  template <class Table>
  Table& table() {
    return tables.get<Table>();
  }
};

/// Whether a scene loads the flanks that are not the pair's own.
inline bool loads_other_flanks(const Study& study, const Scene& scene) {
  return scene.working_flank.has_value() && *scene.working_flank != study.pair.working_flank;
}

/// Whether any scene has a torque.
inline bool has_torque(const Study& study) {
  return std::ranges::any_of(study.scenes,
                             [](const Scene& scene) { return std::ranges::any_of(scene.torques, [](double torque) { return torque > 0.0; }); });
}

/// Whether peaks between the positions, and the load distribution factors that follow, belong to the results: unless the study says
/// otherwise in an analysis, not beside an optimisation's many scenes; never where explicit phases are asked for.
inline bool locates_peaks(const Study& study) { return study.cycle.phases.empty() && study.cycle.locate_peaks.value_or(study.task->one_design); }

/// Whether the summary's extremes are sought between the positions: unless the study samples peaks or gives phases. Points at fixed places
/// (all rules but Graded) enter and leave a line whole, and what they do between positions is no property of the gears.
inline bool seeks_extremes(const Study& study) {
  return study.cycle.phases.empty() && study.cycle.locate_peaks.value_or(true) && study.fidelity.quadrature.rule == QuadratureRule::Graded;
}

}  // namespace flankwright::studies
