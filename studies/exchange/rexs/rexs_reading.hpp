#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "studies/exchange/rexs/rexs_model.hpp"
#include "studies/exchange/rexs/rexs_units.hpp"

namespace flankwright::studies::rexs {

/// A number that was taken from a file, and from where: "cylindrical_gear 6 face_width".
struct Taken {
  double value;  ///< in the inside unit of its Dimension
  std::string source;
};

/// Whether two statements of a file are the same: |a - b| <= 1e-9 (1 + |a|), as digits and units leave it.
bool agree(double a, double b);

/// Reads attributes out of a model, keeps a record of what was read, and collects what is to be said about the rest.
class Reading {
 public:
  Reading(const Model& model, const std::string& file) : model_(model), file_(file) {}

  const Model& model() const { return model_; }
  const std::string& file() const { return file_; }

  /// "cylindrical_gear 6"
  static std::string name_of(const Component& component);

  /// The number of an attribute; nullopt where it is absent or empty. Where it has no unit at all, the one of the standard is meant.
  /// @throws StudyErrors, one problem with component, id and attribute, where it is no finite number or has a unit of another dimension
  std::optional<Taken> number(const Component* component, std::string_view attribute, Dimension dimension);
  /// The number of an attribute that is a length [mm]; otherwise as number().
  std::optional<double> length(const Component& component, std::string_view attribute);
  /// The first of several names that is there: the format renamed things.
  std::optional<Taken> first_of(const Component* component, std::initializer_list<std::string_view> attributes, Dimension dimension);
  /// A word or flag, "true" or "linear"; empty where absent.
  std::string word(const Component* component, std::string_view attribute);
  /// A list of numbers, inside units; nullopt where absent. @throws as number()
  std::optional<std::vector<double>> numbers(const Component* component, std::string_view attribute, Dimension dimension);

  /// Components in one role of relations in which `of` is another: of(gear) -> tools. In the order of relation order, then of the file.
  std::vector<const Component*> related(const Component& of, std::initializer_list<std::string_view> types) const;
  /// The component that a relation has in a role. @throws StudyErrors where there is none, or no component of that id
  const Component& in_role(const Relation& relation, std::string_view role) const;

  /// A difference between study and file; each is repeated on stderr.
  void warn(std::string text);
  /// What is said of a component: that it is left out, or what is not taken of it.
  void leave_out(const Component& component, const std::string& why) { note(component, "not taken, " + why); }
  void note(const Component& component, const std::string& what) { warn(name_of(component) + ": " + what); }
  const std::vector<std::string>& warnings() const { return warnings_; }

  /// Attributes of a component that nobody asked for.
  std::vector<std::string> unread(const Component& component) const;

  [[noreturn]] void refuse_attribute(const Component& component, std::string_view attribute, const std::string& value,
                                     const std::string& allowed) const;

 private:
  double value_of(const Component& component, const Attribute& attribute, const std::string& text, double unit) const;
  double unit_of(const Component& component, const Attribute& attribute, Dimension dimension) const;

  const Model& model_;
  const std::string& file_;
  std::set<const Attribute*> read_;
  std::vector<std::string> warnings_;
};

}  // namespace flankwright::studies::rexs
