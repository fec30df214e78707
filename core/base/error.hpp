#pragma once

#include <stdexcept>
#include <string>

namespace flankwright {

/// The error type for bad input: the field, its value and what is allowed.
///
/// Thrown by everything that validates what a user supplied. Non-convergence is never
/// an InvalidInput: it is a status inside a result.
class InvalidInput : public std::runtime_error {
 public:
  /// @param field    name of the offending quantity as the user knows it ("pinion.teeth")
  /// @param value    the value found, as text
  /// @param allowed  accepted values ("an integer of at least 5")
  InvalidInput(std::string field, std::string value, std::string allowed);

  const std::string& field() const { return field_; }
  const std::string& value() const { return value_; }
  const std::string& allowed() const { return allowed_; }

 private:
  std::string field_, value_, allowed_;
};

/// A number as messages show it: seven significant digits, enough to find it again in a study file.
std::string in_words(double value);

}  // namespace flankwright
