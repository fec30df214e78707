#pragma once

#include <limits>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "studies/study/study.hpp"
#include "studies/base/value_with_unit.hpp"

/// Every key of a study file in one table: its name, allowed values, meaning and storage.
/// Reading, --set, the hints at misspelt keys, the key reference (key_page.hpp) and the scenes all follow from it.
namespace flankwright::studies {

/// Values that a number may take, in the unit of a bare number.
struct Range {
  double low{-std::numeric_limits<double>::infinity()};
  double high{std::numeric_limits<double>::infinity()};
  bool low_open{false};   ///< value > low instead of value >= low
  bool high_open{false};  ///< value < high instead of value <= high
};

enum class ValueKind {
  Number,        ///< bare, or text with its unit
  NumberOrList,  ///< one number, or a list of at least one
  NumberList,    ///< a list of at least one number
  Integer,
  Percentage,       ///< text such as "1 %"; the range is in per cent, the number a share
  IntegerOrAuto,    ///< an integer, or "auto"
  NumberOrNone,     ///< a number, or "none", which is stored as 0
  Text,             ///< any text
  TextList,         ///< a list of at least one text
  Word,             ///< one of `words`
  WordOrTable,      ///< one of `words`, or a table of the keys below it
  WordList,         ///< "auto", or a list of `words`
  TableList,        ///< array of tables, each with the keys of element_keys()
  TableListOrFile,  ///< the same, or a table that names a file
  Free              ///< with a reader of its own; the row says what is allowed
};

/// The converted value of a key. The kind of the key determines the members that are set.
struct Value {
  double number{std::numeric_limits<double>::quiet_NaN()};  ///< internal units
  long long integer{0};                                     ///< an integer, or the index of a word
  std::string text{};
  bool is_list{false};
  std::vector<double> numbers{};     ///< internal units; one entry where is_list is false
  std::vector<std::string> words{};  ///< of a TextList its texts; empty with is_list false: "auto"
};

/// Generation of a gear's flank as given by its keys.
struct GenerationKeys {
  std::string kind;  ///< "rack", "parabolic_rack" or "revolution"; empty where a table does not say
  double coefficient{not_given}, half_apex{not_given}, distance{not_given}, arc_radius{not_given};
};

/// A study while it is being read.
struct StudyBuilder {
  Study study;
  Scene base;  ///< values of [misalignment], [load] and the errors, before any scene
  std::optional<Hand> wheel_hand;
  PerGear<GenerationKeys> generation;
};

using StoreInStudy = void (*)(StudyBuilder&, Member, const Value&);
using StoreInScene = void (*)(Scene&, Member, const Value&);  ///< such a key may be overridden by a scene
/// A key that holds a ModificationParameter may be a design variable.
using Store = std::variant<std::monostate, StoreInStudy, StoreInScene, ModificationParameter, const ModificationChoice*>;

struct SchemaKey {
  std::string path{};  ///< dotted; "scenes[].name" is a key of each scene
  ValueKind kind{ValueKind::Number};
  Quantity quantity{Quantity::Number};
  Range range{};
  std::vector<std::string> words{};  ///< allowed words, in the order of their enumerators
  std::string allowed{};             ///< of a Free key: its values in words
  std::string fallback{};            ///< default as it would be written in the file; words in (...) say where it comes from
  std::string meaning{};             ///< one line, with the sign
  std::string hint{};                ///< said with a refusal: what to do instead
  Store store{};
  Member member{Member::Pinion};  ///< which gear's key this is, where it is a gear's
};

/// All keys, each of a gear's twice. The order is the order of storing: common before particular.
const std::vector<SchemaKey>& study_schema();

/// Keys by their name in a file.
using KeyIndex = std::map<std::string, const SchemaKey*>;

/// The keys of a study file.
const KeyIndex& study_keys();

/// The keys of one [[scenes]] table: name, weight and the keys that a scene may override.
const KeyIndex& scene_keys();

/// The keys of one table of a TableList, "pinion.shaft.sections": "length" ... . Storing the list's own key adds an
/// element to it, storing these fills the last one.
KeyIndex element_keys(const std::string& list);

/// True where keys lie below this path: "pinion.rack".
bool is_table(const KeyIndex& keys, const std::string& path);

/// ", did you mean ...?" where a known name is near a misspelt path, else empty.
std::string nearest_key_hint(const KeyIndex& keys, const std::string& path);

/// The nearest of some words within a few letters, else empty.
std::string nearest_word(const std::string& word, const std::vector<std::string>& words);

/// Two keys for the same quantity, so that a file may give only one.
struct ExclusiveKeys {
  std::string first, second;
};
const std::vector<ExclusiveKeys>& exclusive_keys();

/// True where the default comes from elsewhere or there is none: "(required)".
bool is_described_fallback(const SchemaKey& key);
bool is_required(const SchemaKey& key);

/// Allowed values of a key in words: "a number above 0 and at most 1000 mm".
std::string allowed_values(const SchemaKey& key);

/// Words as a file has them: "\"a\", \"b\"".
std::string quoted_list(const std::vector<std::string>& words);

/// The words after "a number", or "an integer", for a range: " 10 .. 35 deg".
std::string range_in_words(const Range& range, Quantity quantity);

}  // namespace flankwright::studies
