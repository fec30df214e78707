#pragma once

#include <string>

namespace flankwright::studies::rexs {

/// A study file as it is put together: tables with keys, each with a remark that says where its value comes from.
class StudyText {
 public:
  void comment(const std::string& text);
  void blank() { text_ += "\n"; }
  /// Opens [name].
  void table(const std::string& name);
  /// Opens [[scenes]].
  void scene() { list_table("scenes"); }
  /// Opens [[name]].
  void list_table(const std::string& name);
  /// key = value, with a comment behind it where the remark is not empty.
  void key(const std::string& name, const std::string& value, const std::string& remark = {});

  const std::string& text() const { return text_; }

 private:
  std::string text_;
};

/// A number in at most 15 significant digits: what survives a change of units without a tail of nines.
std::string number_text(double value);
/// A length that is a difference of others [mm], to 1e-9 mm.
std::string difference_text(double value);
/// A text in quotes, as TOML writes it.
std::string quoted(const std::string& text);

}  // namespace flankwright::studies::rexs
