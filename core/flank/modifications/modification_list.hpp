#pragma once

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>

#include "core/flank/modifications/descriptor.hpp"

namespace flankwright {

/// A parameter of a modification or of its process: its index among the rows of all registered ones.
enum class ModificationParameter : std::size_t {};

/// What pages, messages and tables need to know of a parameter.
struct ParameterDescription : ParameterText {
  ModificationParameter parameter{};
  ModificationClass flank_class{};
};

/// All modifications of a list, their numbers as members.
template <DescribedModification... M>
struct ModificationList : M... {
  bool operator==(const ModificationList&) const = default;
};

/// A row of one modification, for the whole list.
template <class List>
struct DescriptorOf : ParameterDescription {
  double (*get)(const List&){nullptr};
  void (*set)(List&, double){nullptr};
  double (*slope)(const List&, const FlankFrame&, double r, double z){nullptr};  ///< null: enters linearly
  bool has_slope{false};                                                         ///< whether it is not
};

/// A choice of one modification, for the whole list.
template <class List>
struct ChoiceOf {
  std::string_view key, name;
  std::array<std::string_view, 2> words;
  std::string_view meaning;
  std::string_view after;  ///< key of the last parameter of its modification
  void (*set)(List&, std::size_t word);
};

namespace detail {

template <class M>
constexpr std::size_t choice_count = [] {
  if constexpr (requires { M::choices(); }) return M::choices().size();
  return std::size_t{0};
}();

template <class List, class M, std::size_t I>
constexpr DescriptorOf<List> describe() {
  constexpr ParameterRow<M> row = M::parameters()[I];
  DescriptorOf<List> described{{row.text, {}, M::flank_class},
                               [](const List& m) {
                                 constexpr auto of = M::parameters()[I].get;
                                 return of(m);
                               },
                               [](List& m, double value) {
                                 constexpr auto to = M::parameters()[I].set;
                                 to(m, value);
                               }};
  if constexpr (row.has_slope) {
    described.has_slope = true;
    described.slope = [](const List& m, const FlankFrame& frame, double r, double z) {
      constexpr auto of = M::parameters()[I].slope;
      return of(m, frame, r, z);
    };
  }
  return described;
}

template <class List, class M, std::size_t I>
constexpr ChoiceOf<List> describe_choice() {
  constexpr ChoiceRow<M> row = M::choices()[I];
  return {row.key, row.name, row.words, row.meaning, M::parameters().back().text.key, [](List& m, std::size_t word) {
            constexpr auto to = M::choices()[I].set;
            to(m, word);
          }};
}

template <class Row, class... Rows>
constexpr auto joined(const Rows&... rows) {
  std::array<Row, (std::tuple_size_v<Rows> + ...)> all{};
  auto* next = all.data();
  ((next = std::ranges::copy(rows, next).out), ...);
  return all;
}

template <class List, class M>
constexpr auto describe_one() {
  return []<std::size_t... I>(std::index_sequence<I...>) { return std::array<DescriptorOf<List>, sizeof...(I)>{describe<List, M, I>()...}; }
  (std::make_index_sequence<M::parameters().size()>());
}

template <class List, class M>
constexpr auto describe_choices() {
  return []<std::size_t... I>(std::index_sequence<I...>) { return std::array<ChoiceOf<List>, sizeof...(I)>{describe_choice<List, M, I>()...}; }
  (std::make_index_sequence<choice_count<M>>());
}

}  // namespace detail

/// The parameters of a list in the order of its modifications.
template <class... M>
constexpr auto descriptors_of(std::type_identity<ModificationList<M...>>) {
  auto all = detail::joined<DescriptorOf<ModificationList<M...>>>(detail::describe_one<ModificationList<M...>, M>()...);
  for (std::size_t index = 0; index < all.size(); ++index) all[index].parameter = ModificationParameter{index};
  return all;
}

/// The choices of a list in the order of its modifications.
template <class... M>
constexpr auto choices_of(std::type_identity<ModificationList<M...>>) {
  return detail::joined<ChoiceOf<ModificationList<M...>>>(detail::describe_choices<ModificationList<M...>, M>()...);
}

/// Whether rows are complete: a key of their own, a name and a meaning; an extent and halves that exist; the slope of
/// an extent.
template <class Rows>
constexpr bool are_complete(const Rows& rows) {
  const auto count = [&](std::string_view key) {
    int found = 0;
    for (const auto& row : rows) found += row.key == key ? 1 : 0;
    return found;
  };
  for (const auto& row : rows) {
    if (row.key.empty() || row.name.empty() || row.meaning.empty() || count(row.key) != 1) return false;
    if (row.kind == ParameterKind::Extent && !row.has_slope) return false;
    for (const std::string_view other : {row.extent, row.half, row.other_half}) {
      if (!other.empty() && count(other) != 1) return false;
    }
  }
  return true;
}

/// f(part) for every modification of a list.
template <class... M, class F>
void for_each_modification(const ModificationList<M...>& list, F&& f) {
  (f(static_cast<const M&>(list)), ...);
}

/// Those of one class; nothing of the others.
template <class... M>
ModificationList<M...> only(const ModificationList<M...>& list, ModificationClass flank_class) {
  ModificationList<M...> part;
  const auto copy = [&]<class One>() {
    if (One::flank_class == flank_class) static_cast<One&>(part) = list;
  };
  (copy.template operator()<M>(), ...);
  return part;
}

}  // namespace flankwright
