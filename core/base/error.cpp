#include "core/base/error.hpp"

#include <sstream>
#include <utility>

namespace flankwright {

InvalidInput::InvalidInput(std::string field, std::string value, std::string allowed)
    : std::runtime_error(field + " = " + value + ": allowed is " + allowed),
      field_(std::move(field)),
      value_(std::move(value)),
      allowed_(std::move(allowed)) {}

std::string in_words(double value) {
  std::ostringstream out;
  out.precision(7);
  out << value;
  return out.str();
}

}  // namespace flankwright
