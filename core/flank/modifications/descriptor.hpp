#pragma once

#include <array>
#include <concepts>
#include <string_view>

#include "core/base/units.hpp"
#include "core/gear/flank_frame.hpp"

namespace flankwright {

/// Direction of the flank along which a modification changes: a lead modification depends on z alone, a profile modification on the radius alone.
/// A parameter of the process removes nothing of its own, it changes what becomes of the lead modifications.
enum class ModificationClass { Lead, Profile, Topography, Process };

/// What a parameter of a modification or of its process measures. Units inside the program: mm, 1/rad for TeParabola, none for Fraction.
enum class ParameterKind {
  Amount,      ///< material removed; enters the removal linearly
  Extent,      ///< height or length over which an amount is spread, > 0 where the amount is not 0
  TeParabola,  ///< a of a transmission error -a phi1^2; enters linearly
  Fraction     ///< of the natural twist, 0 .. 1 [-]
};

/// Unit in study files and reports; "1" of a plain number.
constexpr const char* unit_of(ParameterKind kind) {
  switch (kind) {
    case ParameterKind::Amount:
      return "um";
    case ParameterKind::Extent:
      return "mm";
    case ParameterKind::TeParabola:
      return "arcsec/deg^2";
    case ParameterKind::Fraction:
      break;
  }
  return "1";
}
/// Factor from the unit inside to that of study files and reports.
constexpr double outside_factor(ParameterKind kind) {
  return kind == ParameterKind::Amount ? 1.0 / units::um : kind == ParameterKind::TeParabola ? 1.0 / units::arcsec_per_square_deg : 1.0;
}

/// The texts about one number of a modification, for all pages and messages.
struct ParameterText {
  std::string_view key;       ///< below [pinion.modification] of a study file: "tip_relief.amount"
  std::string_view name;      ///< in sentences and tables: "tip relief"
  std::string_view symbol{};  ///< of ISO 21771 or ISO 1328-1: "C_αa"; empty where they have none
  std::string_view sense{};   ///< what a positive value does, where its sign can be mistaken
  std::string_view meaning;   ///< the line of the key reference
  ParameterKind kind{ParameterKind::Amount};
  std::string_view extent{};              ///< key of the extent over which this amount is spread; empty: it needs none
  std::string_view half{}, other_half{};  ///< keys of the two parameters that this one sets at once; empty: it is an independent number
  bool odd_along_face{false};             ///< its removal changes its sign with z
  bool needs_helix{false};                ///< a spur gear cannot have it
};

/// One number of modification M, which a study may set, a designer vary and a sweep draw.
template <class M>
struct ParameterRow {
  ParameterText text;
  double (*get)(const M&);
  void (*set)(M&, double);
  /// Derivative of the removal at r, z by this parameter [mm/mm]; null for one that enters linearly.
  double (*slope)(const M&, const FlankFrame&, double r, double z){nullptr};
  bool has_slope{false};  ///< whether there is one: with sanitizers g++ 12 cannot compare the address of a function while it compiles
};

/// The row of the number at a path of members: row<TipRelief, &TipRelief::tip_relief, &ProfileRelief::amount>({...}).
template <class M, auto... Path>
constexpr ParameterRow<M> row(ParameterText text) {
  return {text, [](const M& m) -> double { return (m.*....*Path); }, [](M& m, double value) { (m.*....*Path) = value; }};
}
template <class M, auto... Path>
constexpr ParameterRow<M> row(ParameterText text, decltype(ParameterRow<M>::slope) slope) {
  ParameterRow<M> made = row<M, Path...>(text);
  made.slope = slope;
  made.has_slope = true;
  return made;
}

/// A property of modification M that is one of two words, such as the shape of a relief.
template <class M>
struct ChoiceRow {
  std::string_view key, name;
  std::array<std::string_view, 2> words;  ///< the first is the default
  std::string_view meaning;               ///< the line of the key reference
  void (*set)(M&, std::size_t word);
};

/// Sums of what is polynomial in y = r - r_w and z, each as an amount in mm; see FlankPolynomial.
struct PolynomialAmounts {
  double lead_crowning{0.0}, lead_slope{0.0}, addendum_crowning{0.0}, dedendum_crowning{0.0}, profile_slope{0.0}, twist{0.0};
};

/// A modification whose removal is part of the polynomial: m.add_to(amounts).
template <class M>
concept PolynomialModification = requires(const M m, PolynomialAmounts& amounts) {
  m.add_to(amounts);
};

/// A modification whose removal is a separate term: M::Term(m, frame), then term.add(r, z, jet).
template <class M>
concept TermModification = requires {
  typename M::Term;
};

/// A modification whose removal has slopes that jump: m.beyond_starts(frame, r, z) gives distances that change their signs there.
template <class M>
concept ModificationWithStarts = requires(const M m, const FlankFrame& frame) {
  m.beyond_starts(frame, 0.0, 0.0);
};

/// The definition of a modification: its numbers as members (all 0: nothing is removed), its class, a row for each
/// number and its removal.
template <class M>
concept DescribedModification = std::default_initializable<M> && std::equality_comparable<M> && requires {
  { M::flank_class } -> std::convertible_to<ModificationClass>;
  M::parameters();
} &&(PolynomialModification<M> || TermModification<M>);

}  // namespace flankwright
