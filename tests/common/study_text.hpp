#pragma once

#include <cstdio>
#include <string>

namespace flankwright::tests {

/// Writes a study line by line, with every digit of its numbers.
class StudyText {
 public:
  void table(const std::string& name) { text_.append("[").append(name).append("]\n"); }
  void line(const std::string& key, double value) {
    char digits[40];
    std::snprintf(digits, sizeof digits, " = %.17g\n", value);
    text_.append(key).append(digits);
  }
  void line(const std::string& key, int value) { line(key, std::to_string(value)); }
  void line(const std::string& key, const std::string& value) { text_.append(key).append(" = ").append(value).append("\n"); }
  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

}  // namespace flankwright::tests
