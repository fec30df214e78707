#pragma once

#include <toml++/toml.h>

#include <string>
#include <string_view>
#include <vector>

#include "studies/study/study.hpp"
#include "studies/study/study_errors.hpp"
#include "studies/study_file/override.hpp"

namespace flankwright::studies {

/// A place in a study file, or of a value from the command line.
struct Position {
  std::string file;
  int line{0}, column{0};  ///< from 1; 0 unknown
};

/// The TOML of a study with the --set values merged in, and where each part of it was written.
class StudyDocument {
 public:
  /// @param problems  receives what is wrong with an override
  /// @throws StudyErrors where the text is not TOML
  StudyDocument(std::string_view text, std::string name, const std::vector<Override>& overrides, std::vector<StudyProblem>& problems);

  const toml::table& root() const { return root_; }
  const std::string& name() const { return name_; }

  Position position(const toml::key& key) const;
  /// @param around  where the node has no place of its own
  Position position(const toml::node& node, const Position& around) const;

  /// A value as written, in one line; of a table that is not inline, "a table".
  std::string text_of(const toml::node& node) const;

  /// The document as it is now, as TOML.
  std::string text() const;

  /// All values of file and command line, by dotted path; array elements that are tables by their index from 0.
  std::vector<GivenValue> given() const;

 private:
  void merge(const Override& override_, std::vector<StudyProblem>& problems);

  std::string name_;
  std::vector<std::string> lines_;
  toml::table root_;
};

}  // namespace flankwright::studies
