#pragma once

#if !__has_include(<valgrind/callgrind.h>)
#error "instructions are counted by Valgrind's Callgrind: see .scripts/install-dependencies --tests"
#endif
#include <valgrind/callgrind.h>

#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <string>

namespace flankwright {

/// Instructions of this program outside the kernel, counted by Callgrind, which it must have been started under with
/// `--callgrind-out-file` as the environment's FLANKWRIGHT_INSTRUCTIONS.
class InstructionCount {
 public:
  bool possible() const { return RUNNING_ON_VALGRIND != 0 && std::getenv("FLANKWRIGHT_INSTRUCTIONS") != nullptr; }

  void start() {
    CALLGRIND_START_INSTRUMENTATION;
    CALLGRIND_ZERO_STATS;
  }
  /// -1 where Callgrind wrote nothing that can be read.
  std::int64_t stop() {
    CALLGRIND_DUMP_STATS;
    CALLGRIND_STOP_INSTRUMENTATION;
    std::string name(std::getenv("FLANKWRIGHT_INSTRUCTIONS"));
    name += '.';
    name += std::to_string(++dumps_);
    std::ifstream file(name);
    for (std::string word; file >> word;) {
      std::int64_t count = -1;
      if (word == "totals:" && file >> count) return count;
    }
    return -1;
  }

 private:
  static inline int dumps_{0};  ///< Callgrind numbers them through the whole run
};

}  // namespace flankwright
