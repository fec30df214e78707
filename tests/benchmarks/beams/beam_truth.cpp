// Shafts as beams beside CalculiX' beam elements: beam_truth FOLDER [ELEMENT_LENGTH_OVER_DIAMETER]
#include <cstdio>

#include "tests/benchmarks/beams/beam_answer.hpp"
#include "tests/benchmarks/calculix.hpp"

using namespace flankwright;
using namespace flankwright::beam_truth;

int main(int argc, char** argv) {
  if (argc < 2) {
    std::fprintf(stderr, "usage: %s FOLDER [ELEMENT_LENGTH_OVER_DIAMETER]\n", argv[0]);
    return 2;
  }
  if (!calculix::is_installed()) {
    std::fprintf(stderr, "CalculiX (ccx, Debian package calculix-ccx) is not installed\n");
    return 1;
  }
  const double length = argc > 2 ? std::stod(argv[2]) : 0.125;
  int number = 0;
  for (const BeamCase& of : beam_cases()) {
    const BeamAnswer outside = run_calculix(of, length, std::string(argv[1]) + "/beam_" + std::to_string(++number));
    if (!outside.solved) {
      std::printf("%s: CalculiX found no solution\n", of.name.c_str());
      continue;
    }
    const BeamAnswer own = own_answer(of);
    const BeamDifference apart = difference(outside, own);
    std::printf("\n%s: %d elements, largest difference of deflections %.2f %%, of reactions %.2f %%\n\n", of.name.c_str(), outside.elements,
                100.0 * apart.deflection, 100.0 * apart.reaction);
    for (std::size_t i = 0; i < of.stations.size(); ++i) {
      std::printf("  z %6.1f mm   deflection um  %9.2f %9.2f\n", of.stations[i], 1e3 * outside.deflection[i], 1e3 * own.deflection[i]);
    }
    for (std::size_t i = 0; i < of.supports.size(); ++i) {
      std::printf("  z %6.1f mm   reaction N     %9.1f %9.1f\n", of.supports[i], outside.reaction[i], own.reaction[i]);
    }
  }
}
