#include "studies/analysis/effect_sizes.hpp"

#include <algorithm>

namespace flankwright::studies {

const SizeInStudy* size_of(const std::vector<SizeInStudy>& sizes, const std::string& name) {
  const auto found = std::ranges::find(sizes, name, [](const SizeInStudy& s) { return s.size.name; });
  return found == sizes.end() ? nullptr : &*found;
}

}  // namespace flankwright::studies
