#include "tests/fuzz/readers.hpp"

#include "studies/study_file/grid_file.hpp"
#include "studies/exchange/rexs/rexs_import.hpp"
#include "studies/study_file/study_file.hpp"

namespace flankwright::studies::fuzz {

void read_study_text(std::string_view text) {
  try {
    parse_study(text, "fuzz.toml");
  } catch (const InvalidInput&) {
  }
}

void read_grid_text(std::string_view text) {
  try {
    parse_grid(text, "fuzz.csv");
  } catch (const InvalidInput&) {
  }
}

void read_rexs_text(std::string_view text) {
  try {
    rexs::import_stage(std::string(text), "fuzz.rexs", {.stage = 1, .grid_stem = "fuzz"});
  } catch (const InvalidInput&) {
  }
}

}  // namespace flankwright::studies::fuzz
