#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <string>

#include "core/base/stopwatch.hpp"
#include "core/gear/gear_pair.hpp"
#include "studies/compliance/study_compliance.hpp"
#include "studies/study_file/study_file.hpp"
#include "tests/benchmarks/contact_truth/benchmark_cases.hpp"
#include "tests/benchmarks/contact_truth/contact_cases.hpp"
#include "tests/benchmarks/contact_truth/held_structure.hpp"
#include "tests/benchmarks/contact_truth/outside_fillet.hpp"
#include "tests/benchmarks/contact_truth/own_answer.hpp"

// A gear pair in full three-dimensional contact by CalculiX, beside the program's own models at the torque that came
// out:
//
//     flankwright_contact_truth FOLDER [MESH] [PART_OF_A_CASE'S_NAME] [FIRST_POSITION]
//
// MESH is coarse, medium, fine, ends, layers, lines, "line ends" or pressure, for root stress "roots" or "fine roots"; cases of edges have their own, and take "fine" for a finer one. Cycles begin at their FIRST_POSITION, counted from 0. FOLDER receives decks and CalculiX' output. Times are processor
// seconds, of the program's own models wall seconds.

using namespace flankwright;
using namespace flankwright::contact_truth;

namespace {

/// The pair as a user states it, with the gears' default bodies.
studies::Study study_of(const ContactTask& task, double torque, const char* compliance) {
  std::ostringstream text;
  text.precision(17);
  const PairData& data = task.pair;
  text << "task = \"analyse\"\n[pair]\nnormal_module = " << data.normal_module << "\nhelix_angle = " << data.helix_angle / units::deg
       << "\n[pinion]\nteeth = " << data.pinion.teeth << "\nface_width = " << data.pinion.face_width << "\n[wheel]\nteeth = " << data.wheel.teeth
       << "\nface_width = " << data.wheel.face_width << "\n[load]\ntorque = " << torque * 1e-3 << "\n[fidelity]\ncompliance = \"" << compliance
       << "\"\n";
  return studies::parse_study(text.str(), "contact_truth");
}

void print_row(const char* model, double approach, double share, double stress, double line_end_to_middle, double seconds) {
  std::printf("| %s | %.2f | %.4f | %.0f | %.3f | %.1f |\n", model, approach / units::um, share, stress, line_end_to_middle, seconds);
  std::fflush(stdout);
}

void compare(const ContactCase& c, const ContactSettings& settings, const std::string& folder) {
  const ContactTask& task = c.task;
  const ContactAnswer outside = run_calculix(task, settings, folder);
  if (!outside.converged) {
    std::printf("%s: CalculiX did not converge, see %s/ccx.log\n", c.name.c_str(), folder.c_str());
    return;
  }
  const GearPair pair = make_gear_pair(task.pair);
  const int tooth = outside.layers.front().tooth;
  std::printf(
      "\n%s: %.1f N·m; CalculiX %ld unknowns, %.2f GB; torques' ratio %.5f; largest compression next to the flank %.0f "
      "MPa\n\n"
      "| model | approach um | share of pair %d | Hertzian peak MPa | end over middle | s "
      "|\n|---|---|---|---|---|---|\n",
      c.name.c_str(), outside.pinion_torque * 1e-3, static_cast<long>(outside.unknowns), outside.peak_bytes / 1e9,
      outside.wheel_torque / outside.pinion_torque / pair.gear_ratio(), outside.peak_compression(), tooth);
  std::size_t layers = 0;
  while (layers < outside.layers.size() && outside.layers[layers].tooth == tooth) ++layers;
  const LayerLoad &first = outside.layers.front(), &middle = outside.layers[task.half_face ? layers - 1 : layers / 2];
  const auto load = [](const LayerLoad& l) { return l.force / (l.end - l.begin); };
  print_row("CalculiX", task.approach, outside.share(tooth), hertzian_peak(task, outside), load(first) / load(middle), outside.processor_seconds);
  const auto own = [&](const char* name, const PairCompliance* structure, double seconds) {
    const OwnAnswer answer = own_answer(task, outside.pinion_torque, structure);
    const auto at = [&](const LayerLoad& l) { return answer.mean_face_load(tooth, l.begin, l.end); };
    print_row(name, answer.loaded.load.transmission_error, answer.share(tooth), answer.peak_stress(), at(first) / at(middle), seconds);
  };
  const Stopwatch held_clock;
  const auto held = held_structure(task);
  own("fe, held at the bores", held.get(), held_clock.seconds());
  for (const char* compliance : {"fe", "fitted"}) {
    const Stopwatch clock;
    const auto structures = studies::gear_structures(study_of(task, outside.pinion_torque, compliance), pair, {});
    own(compliance, structures.pair.get(), clock.seconds());
  }
  own("thin_slice", nullptr, 0);
  std::printf("\nforce per mm of face, N/mm: tooth pair, z, CalculiX, fe held\n");
  const OwnAnswer answer = own_answer(task, outside.pinion_torque, held.get());
  for (const LayerLoad& l : outside.layers) {
    std::printf("  %2d %8.2f %9.1f %9.1f\n", l.tooth, (l.begin + l.end) / 2, load(l), answer.mean_face_load(l.tooth, l.begin, l.end));
  }
}

/// A position where contact reaches a rounded tip edge, by tooth pairs.
void compare_edges(const ContactCase& c, const ContactSettings& settings, const std::string& folder) {
  const ContactAnswer outside = run_calculix(c.task, settings, folder);
  if (!outside.converged) {
    std::printf("%s: CalculiX did not converge, see %s/ccx.log\n", c.name.c_str(), folder.c_str());
    return;
  }
  const OwnAnswer own = own_answer(c.task, outside.pinion_torque, held_structure(c.task).get());
  std::printf("\n%s: %.1f N mm; CalculiX %ld unknowns, %.1f s; approach %.4f um, ours over CalculiX' %.4f\n", c.name.c_str(), outside.pinion_torque,
              static_cast<long>(outside.unknowns), outside.processor_seconds, c.task.approach / units::um,
              own.loaded.load.transmission_error / c.task.approach);
  std::printf("| pair | share: CalculiX, ours | peak MPa: CalculiX, ours |\n|---|---|---|\n");
  for (int tooth = outside.layers.front().tooth; tooth <= outside.layers.back().tooth; ++tooth) {
    std::printf("| %d | %.4f, %.4f | %.0f, %.0f |\n", tooth, outside.share(tooth), own.share(tooth), outside.peak_compression(tooth),
                own.peak_stress(tooth));
  }
  if (!c.task.plane_strain) {
    std::printf("\ntooth pair, z, force per mm of face N/mm: CalculiX, ours; peak MPa: CalculiX, ours, ours under CalculiX' force\n");
    for (const LayerLoad& l : outside.layers) {
      const double force = l.force / (l.end - l.begin), own_force = own.mean_face_load(l.tooth, l.begin, l.end);
      const double under_its_force = own_force > 0.0 ? own.peak_stress(l.tooth, l.begin, l.end, force / own_force) : 0.0;
      std::printf("  %2d %8.3f .. %8.3f %9.2f %9.2f %9.0f %9.0f %9.0f\n", l.tooth, l.begin, l.end, force, own_force, l.peak_compression,
                  own.peak_stress(l.tooth, l.begin, l.end), under_its_force);
    }
  }
  std::fflush(stdout);
}

/// Transmission error over a cycle at one torque. CalculiX is asked at our approach; by how much its torque differs, our own stiffness takes into account,
/// with an error of second order.
/// @param first  position, from 0: those before it were run earlier
void compare_cycle(const CycleCase& c, const ContactSettings& settings, const std::string& folder, int first) {
  const auto held = held_structure(contact_task(c.pair, 0.0, 0.0));
  double least = INFINITY, most = -INFINITY, own_least = INFINITY, own_most = -INFINITY;
  std::printf("\n%s, %.1f N·m\n\n| phase | transmission error um: CalculiX, fe held | torque of CalculiX there N·m |\n|---|---|---|\n",
              c.name.c_str(), c.torque * 1e-3);
  for (int i = first; i < c.positions; ++i) {
    ContactTask task = contact_task(c.pair, static_cast<double>(i) / c.positions, 0.0);
    const double own = task.approach = own_answer(task, c.torque, held.get()).loaded.load.transmission_error;
    const ContactAnswer outside = run_calculix(task, settings, folder + "/" + std::to_string(i));
    if (!outside.converged) {
      std::printf("| %.4f | CalculiX did not converge | |\n", task.phase);
      return;
    }
    const double te = 2.0 * own - own_answer(task, outside.pinion_torque, held.get()).loaded.load.transmission_error;
    std::printf("| %.4f | %.3f, %.3f | %.1f |\n", task.phase, te / units::um, own / units::um, outside.pinion_torque * 1e-3);
    std::fflush(stdout);
    least = std::min(least, te);
    most = std::max(most, te);
    own_least = std::min(own_least, own);
    own_most = std::max(own_most, own);
  }
  std::printf("\npeak to peak of these %.3f and %.3f um: ours over CalculiX' %.4f\n", (most - least) / units::um, (own_most - own_least) / units::um,
              (own_most - own_least) / (most - least));
}

/// The largest principal stress below the loaded flanks, tooth by tooth.
void compare_roots(const ContactCase& c, ContactSettings settings, const std::string& folder) {
  settings.fillets = true;
  const ContactAnswer outside = run_calculix(c.task, settings, folder);
  if (!outside.converged) {
    std::printf("%s: CalculiX did not converge, see %s/ccx.log\n", c.name.c_str(), folder.c_str());
    return;
  }
  const GearPair pair = make_gear_pair(c.task.pair);
  const auto own = [&](const GearStructures& s) { return own_answer(c.task, outside.pinion_torque, s.pair.get(), s.root_stress.get()); };
  const OwnAnswer held = own(rigid_bore_structures(c.task)),
                  shaft = own(studies::gear_structures(study_of(c.task, outside.pinion_torque, "fe"), pair, {}));
  std::printf("\n%s: %.4f N·m; CalculiX %ld unknowns, %.1f s; approach %.2f um, ours held %.2f\n\n", c.name.c_str(), outside.pinion_torque * 1e-3,
              static_cast<long>(outside.unknowns), outside.processor_seconds, c.task.approach / units::um,
              held.loaded.load.transmission_error / units::um);
  std::printf(
      "| gear, tooth pair (share: CalculiX, held, default) | 30 deg tangent MPa: CalculiX, held, default | largest MPa (along, z): CalculiX, held, default "
      "|\n|---|---|---|\n");
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    for (int tooth = outside.layers.front().tooth; tooth <= outside.layers.back().tooth; ++tooth) {
      if (outside.share(tooth) < 0.05) continue;
      const OutsideFillet fillet(c.task, member, tooth, outside);
      const auto at_tangent = fillet.peak(fillet.tangent(), fillet.tangent()), peak = fillet.peak(0, 1);
      const auto largest = [&](const OwnAnswer& answer) {
        const auto& at = answer.model.positions.front();
        const Eigen::Index i = highest_root_stress(at, answer.loaded, {.member = member, .tooth = tooth});
        const RootStation& s = at.root_stress.stations[static_cast<std::size_t>(i)];
        std::printf(", %.2f (%.3f, %.2f)", answer.loaded.root_stress[i], s.along, s.z);
      };
      std::printf("| %s, %d (%.4f, %.4f, %.4f) | %.2f, %.2f, %.2f | %.2f (%.3f, %.2f)", name_of(member), tooth, outside.share(tooth),
                  held.share(tooth), shaft.share(tooth), at_tangent.stress, held.tangent_stress(member, tooth), shaft.tangent_stress(member, tooth),
                  peak.stress, peak.along, peak.z);
      largest(held);
      largest(shaft);
      std::printf(" |\n");
      for (const double z : held.root_places(member, tooth)) {
        if (c.task.half_face && z > 0) continue;
        std::printf("    z %7.2f tangent %.3f: %.2f %.2f %.2f\n", z, fillet.tangent(), fillet.stress(fillet.tangent(), z),
                    held.tangent_stress(member, tooth, z), shaft.tangent_stress(member, tooth, z));
      }
    }
  }
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const std::string mesh = argc > 2 ? argv[2] : "medium";
  ContactSettings settings;
  settings.mesh = contact_mesh_options(mesh);
  if (mesh.ends_with("roots"))
    return run_cases(argc, argv, "", root_cases(), [&](const ContactCase& c, const std::string& folder) { compare_roots(c, settings, folder); });
  const int exit_code = run_cases(argc, argv, " [FIRST_POSITION]", contact_cases(), [&](const ContactCase& c, const std::string& folder) {
    if (c.task.pair.pinion.tip_rounding > 0)
      compare_edges(c, mesh == "fine" ? fine_edge_settings(c.task) : edge_settings(c.task), folder);
    else
      compare(c, settings, folder);
  });
  if (exit_code != 0) return exit_code;
  const int first = argc > 4 ? std::stoi(argv[4]) : 0;
  return run_cases(argc, argv, "", cycle_cases(),
                   [&](const CycleCase& c, const std::string& folder) { compare_cycle(c, settings, folder + "_cycle", first); });
}
