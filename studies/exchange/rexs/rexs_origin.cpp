#include "studies/exchange/rexs/rexs_origin.hpp"

#include <sstream>

namespace flankwright::studies::rexs {

Origin origin_of(const Model& model, const std::string& remark) {
  Origin origin;
  std::istringstream words(remark);
  const Component* named = nullptr;  // by the word before
  for (std::string word, before; words >> word; before = word) {
    const std::string bare = word.substr(0, word.find_last_not_of(",;:") + 1);
    if (const Attribute* attribute = named != nullptr && named == origin.component ? named->find(bare) : nullptr) origin.line = attribute->line;
    const auto id = whole_number(bare);
    named = id ? model.find(*id) : nullptr;
    if (named != nullptr && named->type != before) named = nullptr;
    origin.words += origin.words.empty() ? "" : " ";
    origin.words += named == nullptr ? word : full_name(*named).substr(before.size() + 1) + word.substr(bare.size());
    if (named == nullptr || origin.component != nullptr) continue;
    origin.component = named;
    origin.line = named->line;
  }
  return origin;
}

}  // namespace flankwright::studies::rexs
