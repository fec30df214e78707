#include "studies/results/load_case_fields.hpp"

#include <fmt/format.h>

#include "studies/base/csv.hpp"
#include "studies/base/json_format.hpp"

namespace flankwright::studies {

std::string load_case_fields(const LoadedResult& loaded) {
  const std::string bin = loaded.bin < 0 ? std::string() : std::to_string(loaded.bin);
  return fmt::format("{},{},{},{}", csv_field(loaded.scene), in_Nm(loaded.torque), loaded.design, bin);
}

}  // namespace flankwright::studies
