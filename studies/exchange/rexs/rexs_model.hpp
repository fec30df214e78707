#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

/// A REXS file (reusable engineering exchange standard, rexs.info) as pure data: components with attributes, relations between them
/// and load cases, as they are written. Nothing is interpreted here; rexs_stage.hpp does.
namespace flankwright::studies::rexs {

/// What an attribute holds. Numbers stay the text that was written until somebody asks for them.
enum class ValueType { Boolean, Integer, Number, Word, Text, NumberArray, Other };

struct Attribute {
  std::string id;
  std::string unit;                  ///< as written; "none" or empty: a pure number
  ValueType type{ValueType::Text};   ///< of files read from XML, which does not say, Text or NumberArray
  std::string text{};                ///< scalar value
  std::vector<std::string> array{};  ///< of a NumberArray
  int line{0};                       ///< in the file, from 1; 0 where the form has no lines (JSON)
};

struct Component {
  int id{0};
  std::string type;
  std::string name{};
  std::vector<Attribute> attributes{};
  int line{0};

  /// The attribute of this id; null where there is none.
  const Attribute* find(std::string_view attribute) const;
};

/// A component as messages name it: shaft 11 "Output".
std::string full_name(const Component& component);

struct Reference {
  int id{0};
  std::string role;
  std::string hint{};  ///< type of the component
};

struct Relation {
  int id{0};
  std::string type;
  std::optional<int> order{};
  std::vector<Reference> refs{};
  int line{0};

  /// Id of the component in this role.
  std::optional<int> role(std::string_view name) const;
};

/// What varies in one load case: components joined to the model's by their id.
struct LoadCase {
  int id{0};
  std::vector<Component> components{};
};

struct Model {
  std::string version;  ///< "1.6", "2.0.0"
  std::string application{}, application_version{}, date{};
  std::vector<Relation> relations{};
  std::vector<Component> components{};
  std::vector<LoadCase> load_cases{};

  /// The component of this id; null where there is none.
  const Component* find(int id) const;
};

/// Text forms of the format.
enum class Form { Xml, Json };

/// Reads either form, distinguished by its first character, or unpacked from an archive, see rexs_archive.hpp.
///
/// @param name  stands for the file in messages
/// @throws StudyErrors with one problem, and its line where the form has one: damaged XML, JSON or archive, not
/// UTF-8, no REXS model, an id that is missing, no number or given twice, an attribute with two values
Model parse_model(std::string_view text, const std::string& name);

/// The model as a file in UTF-8 with a byte order mark.
std::string model_text(const Model& model, Form form);

/// Each form by itself; see parse_model() and model_text(). The texts are without byte order mark.
Model parse_xml(std::string_view text, const std::string& name);
Model parse_json(std::string_view text, const std::string& name);
std::string xml_text(const Model& model);
std::string json_text(const Model& model);

/// A whole number from 0 to 2^31 - 1, as ids and orders are; nullopt for anything else.
std::optional<int> whole_number(std::string_view text);

/// Numbers packed in base64, little endian: code is "int32", "float32" or "float64".
/// @return  nullopt where the text is no base64, of no whole number of entries, or the code another
std::optional<std::vector<std::string>> unpacked(std::string_view base64, std::string_view code);

}  // namespace flankwright::studies::rexs
