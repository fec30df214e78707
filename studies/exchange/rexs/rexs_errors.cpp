#include "studies/exchange/rexs/rexs_errors.hpp"

#include "studies/base/printable.hpp"

namespace flankwright::studies::rexs {

void refuse(const std::string& file, int line, const std::string& key, const std::string& value, const std::string& allowed) {
  constexpr std::size_t most_shown = 60;
  const std::string shown = without_control_characters(value.substr(0, most_shown));
  throw StudyErrors({{file, line, line > 0 ? 1 : 0, key, value.size() > most_shown ? shown + "..." : shown, "allowed is " + allowed}});
}

}  // namespace flankwright::studies::rexs
