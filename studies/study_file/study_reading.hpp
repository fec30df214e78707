#pragma once

#include <toml++/toml.h>

#include <map>
#include <string>
#include <vector>

#include "studies/study_file/study_document.hpp"
#include "studies/study_file/study_schema.hpp"

/// Inside the reader: keys of a table matched with the schema, and their values converted.
namespace flankwright::studies {

/// A key of the schema as written in the file.
struct Match {
  const SchemaKey* key{nullptr};
  const toml::node* node{nullptr};
  Position position;  ///< of the key
  std::string path;   ///< as messages show it: "scenes.0.load.torque"
};

/// Everything the parts of the reader share.
struct StudyReading {
  const StudyDocument& document;
  std::vector<StudyProblem>& problems;
  StudyBuilder builder{};
  std::map<std::string, Match> matches{};       ///< by path
  std::map<std::string, Position> positions{};  ///< of the keys and tables of the file, by path

  /// Adds a problem; the value is the node's text, or "(not given)".
  void refuse(const Position& at, const std::string& key, const toml::node* node, const std::string& allowed);

  /// The same at the key of a path, anywhere in the file.
  void refuse_key(const std::string& path, const std::string& allowed);

  /// The same with a value that does not stand there as it is said.
  void refuse_value(const std::string& path, const std::string& value, const std::string& allowed);

  /// Match of a path, or null.
  const Match* find(const std::string& path) const;

  /// Position of a key, else the nearest table around it, else the start of the file.
  Position where(const std::string& path) const;
};

/// Matches the keys of a table; unknown ones become problems.
///
/// @param prefix  of the paths in messages
std::map<std::string, Match> match_keys(StudyReading& reading, const toml::table& table, const KeyIndex& keys, const std::string& prefix);

/// The value of a key that is a number, an integer, a text or words, in internal units.
///
/// @throws InvalidInput with an empty field and value; its allowed() is what the key accepts
Value read_value(const SchemaKey& key, const toml::node& node);

/// One number of a key's quantity and range, in internal units. Throws as read_value() does.
double read_number(const SchemaKey& key, const toml::node& node);

/// Reads a matched key and stores it in the builder or a scene; what cannot be read becomes a problem.
void read_into(StudyReading& reading, const Match& match, Scene& scene);

/// Stores the defaults of all keys that have one.
void store_defaults(StudyBuilder& builder);

}  // namespace flankwright::studies
