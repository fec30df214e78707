#include <cstdio>
#include <string>

#include "tests/benchmarks/contact_truth/benchmark_cases.hpp"
#include "tests/benchmarks/contact_truth/own_answer.hpp"
#include "tests/benchmarks/gear_bodies/body_cases.hpp"

// Wheels on webs in full three-dimensional contact by CalculiX, beside the program's own models at the torque that came out:
//
//     flankwright_gear_bodies FOLDER [MESH] [PART_OF_A_CASE'S_NAME] [FORM_TEETH]
//
// MESH is one of contact_truth's (coarse, medium, fine); FOLDER receives decks and CalculiX' output; FORM_TEETH are teeth with their form on either side of the
// loaded ones, the others being left out.

using namespace flankwright;
using namespace flankwright::contact_truth;
using namespace flankwright::gear_bodies;

namespace {

void print_row(const char* model, double approach, const RimMotion& rim) {
  std::printf("| %s | %.2f | %.2f | %.4f | %.2f | %.2f |\n", model, approach / units::um, rim.misalignment / units::um, rim.tilt / 1e-3,
              rim.radial / units::um, rim.axial / units::um);
  std::fflush(stdout);
}

void compare(const BodyCase& c, const ContactSettings& settings, const std::string& folder) {
  const ContactAnswer outside = run_calculix(c.task, settings, folder);
  if (!outside.converged) {
    std::printf("%s: CalculiX did not converge, see %s/ccx.log\n", c.name.c_str(), folder.c_str());
    return;
  }
  std::printf(
      "\n%s: %.1f N m; CalculiX %ld unknowns, %.0f s\n\n| model | approach um | rim's misalignment um | tilt mrad | radial um | axial um |\n"
      "|---|---|---|---|---|---|\n",
      c.name.c_str(), outside.pinion_torque * 1e-3, static_cast<long>(outside.unknowns), outside.processor_seconds);
  print_row("CalculiX", c.task.approach, c.task.web.wheel ? calculix_rim(c.task, outside) : RimMotion{});
  for (const ComplianceModel model : {ComplianceModel::Fe, ComplianceModel::Fitted}) {
    const GearStructures structures = own_structures(c.task, model);
    const OwnAnswer own = own_answer(c.task, outside.pinion_torque, structures.pair.get());
    const MeshPosition& at = own.model.positions.front();
    RimMotion rim;
    if (structures.rim_motion) rim = structures.rim_motion->motion(Member::Wheel, at.points, at.weight.cwiseProduct(own.loaded.load.line_load), 0);
    print_row(to_string(model), own.loaded.load.transmission_error, rim);
  }
}

}  // namespace

int main(int argc, char** argv) {
  ContactSettings settings;
  settings.mesh = contact_mesh_options(argc > 2 ? argv[2] : "medium");
  settings.mesh.plain_element = 10;
  if (argc > 4) settings.mesh.form_teeth = std::stoi(argv[4]);
  return run_cases(argc, argv, " [FORM_TEETH]", body_cases(), [&](const BodyCase& c, const std::string& folder) { compare(c, settings, folder); });
}
