#pragma once

#include <string>
#include <vector>

#include "studies/analysis/study_results.hpp"
#include "studies/base/progress.hpp"
#include "studies/base/results_folder.hpp"
#include "studies/study_file/stored_study.hpp"

namespace flankwright::studies {

/// Excitation of a drive train by a mesh, for programs of rotor and multibody dynamics. Columns and directions: README.md of this folder.
struct MeshExcitation {
  /// One mesh position under a torque.
  struct Position {
    double phase{not_given};               ///< [base pitches], 0 where the contact line of the reference pair enters
    double transmission_error{not_given};  ///< the wheel's lag along the flank normal [mm]
    double secant_stiffness{not_given};    ///< F / (f_t from first touch), along the flank normal [N/mm]
    double tangent_stiffness{not_given};   ///< dF/df_t, along the flank normal [N/mm]
  };
  std::string scene;
  double torque{not_given};          ///< on the pinion [N mm]
  double normal_force{not_given};    ///< [N]
  std::vector<Position> cycle;       ///< one base pitch
  std::vector<Position> revolution;  ///< of the wheel; empty where the teeth of each gear are alike
};

struct DynamicsRun {
  GearPair pair;
  std::string design;  ///< whose flanks: "after" an optimisation, or as "given"
  std::vector<MeshExcitation> cases;
  std::vector<std::string> notes;
};

/// Analyses a study that has run once more, with its final flanks or with those that it gives, at the resolution that it ended with, and with tangent stiffness. Over one wheel
/// revolution, at 16 positions a pitch, where teeth of a gear have errors of their own.
///
/// @param results  whole_results()
/// @param file     their path, for messages
/// @throws InvalidInput where it is none of this program's, of an older version, of a study without torque or with explicit phases
DynamicsRun mesh_excitation(const Json& results, const std::string& file, StoredFlanks flanks, const ProgressReport& progress = {});

/// One order of the mesh frequency: amplitude * cos(2 pi order phase + angle).
struct ExcitationHarmonic {
  double amplitude{not_given}, angle{not_given};  ///< angle [rad], -pi .. pi
};
/// Orders 1 to `orders` of evenly spaced positions over one pitch; as many as the positions resolve.
std::vector<ExcitationHarmonic> excitation_harmonics(const std::vector<double>& phases, const std::vector<double>& values, int orders);

/// dynamics.json, dynamics-cycle.csv, dynamics-harmonics.csv, and dynamics-revolution.csv where there is one.
std::vector<NamedText> dynamics_files(const DynamicsRun& run);

}  // namespace flankwright::studies
