#pragma once

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "core/base/error.hpp"

namespace flankwright {

/// A length as messages name it.
inline std::string in_mm(double length) { return in_words(length) + " mm"; }

/// Everything that is wrong with an input, where a check would throw at the first field outside its range.
class Findings {
 public:
  void require(bool holds, const std::string& field, const std::string& value, const std::string& allowed) {
    if (!holds) found_.emplace_back(field, value, allowed);
  }
  void require(bool holds, const std::string& field, double value, const std::string& allowed) {
    require(holds, field, std::isnan(value) ? "(not given)" : in_words(value), allowed);
  }
  void add(InvalidInput problem) { found_.push_back(std::move(problem)); }
  void add(const std::vector<InvalidInput>& problems) { found_.insert(found_.end(), problems.begin(), problems.end()); }
  bool empty() const { return found_.empty(); }
  std::vector<InvalidInput> take() { return std::exchange(found_, {}); }

 private:
  std::vector<InvalidInput> found_;
};

}  // namespace flankwright
