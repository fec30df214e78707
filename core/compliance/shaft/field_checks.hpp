#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "core/base/error.hpp"

namespace flankwright {

/// Base of checks that name every field outside its range instead of the first one only.
class FieldChecks {
 protected:
  void require(bool holds, const std::string& field, const std::string& value, const std::string& allowed) {
    if (!holds) found_.emplace_back(field, value, allowed);
  }
  void require(bool holds, const std::string& field, double value, const std::string& allowed) {
    require(holds, field, std::isnan(value) ? "(not given)" : in_words(value), allowed);
  }

  std::vector<InvalidInput> found_;
};

}  // namespace flankwright
