#include "core/flank/modifications/modification.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>
#include <string>

#include "core/flank/removal.hpp"
#include "tests/core/flank/sample_flank_frame.hpp"

using namespace flankwright;

namespace {

const FlankFrame frame = sample_flank_frame();

bool is_half_of(const ModificationDescriptor& half, const ModificationDescriptor& both) {
  return half.key == both.half || half.key == both.other_half;
}

/// A modification of this test: C t with t = (z/b + y/h_active - (1 - l))/l where that is positive, from one corner of the flank inwards.
struct CornerRelief {
  double amount{0.0};  ///< C, removed where z/b + y/h_active = 1 [mm]
  double share{0.5};   ///< l

  static constexpr ModificationClass flank_class = ModificationClass::Topography;
  static constexpr auto parameters() {
    return std::array{
        row<CornerRelief, &CornerRelief::amount>(
            {.key = "corner_relief.amount", .name = "corner relief", .meaning = "removed at the corner", .extent = "corner_relief.share"}),
        row<CornerRelief, &CornerRelief::share>(
            {.key = "corner_relief.share", .name = "corner relief share", .meaning = "where it starts", .kind = ParameterKind::Extent},
            [](const CornerRelief& m, const FlankFrame& f, double r, double z) {
              const double beyond = Term(m, f).beyond(r, z);
              return beyond > 0.0 ? m.amount * (m.share - beyond) / (m.share * m.share) : 0.0;
            })};
  }

  struct Term {
    double slope, start;  ///< C/l, 1 - l
    FlankFrame f;

    Term(const CornerRelief& m, const FlankFrame& on) : slope(m.amount / m.share), start(1.0 - m.share), f(on) {}
    double beyond(double r, double z) const { return z / f.face_width + (r - f.pitch_radius) / (f.tip_radius - f.active_root_radius) - start; }
    void add(double r, double z, Jet& d) const {
      if (beyond(r, z) <= 0.0) return;
      d.value += slope * beyond(r, z);
      d.u += slope / (f.tip_radius - f.active_root_radius);
      d.v += slope / f.face_width;
    }
  };
  bool operator==(const CornerRelief&) const = default;
};

/// What registers it: one line.
using WithCornerRelief = ModificationList<modifications::LeadCrowning, modifications::ProfileCrowning, modifications::TipRelief, CornerRelief>;
constexpr auto with_corner_relief = descriptors_of(std::type_identity<WithCornerRelief>());
static_assert(are_complete(with_corner_relief));

/// A modification that forgets to remove anything is none.
struct WithoutRemoval {
  double amount{0.0};
  static constexpr ModificationClass flank_class = ModificationClass::Lead;
  static constexpr auto parameters() { return std::array{row<WithoutRemoval, &WithoutRemoval::amount>({.key = "a", .name = "b", .meaning = "c"})}; }
  bool operator==(const WithoutRemoval&) const = default;
};
static_assert(DescribedModification<CornerRelief>);
static_assert(!DescribedModification<WithoutRemoval>);

/// Nor does a row do that forgets a word, has the key of another, names an extent that is none, or has an extent without its slope.
constexpr bool is_complete_with(auto change) {
  auto rows = with_corner_relief;
  change(rows.back());
  return are_complete(rows);
}
using Row = DescriptorOf<WithCornerRelief>;
static_assert(is_complete_with([](Row&) {}));
static_assert(!is_complete_with([](Row& r) { r.name = {}; }));
static_assert(!is_complete_with([](Row& r) { r.meaning = {}; }));
static_assert(!is_complete_with([](Row& r) { r.key = "lead_crowning"; }));
static_assert(!is_complete_with([](Row& r) { r.extent = "corner_relief.length"; }));
static_assert(!is_complete_with([](Row& r) { r.has_slope = false; }));

/// Numbers as a flank may have them, one after the other.
template <class List, class Rows>
List all_set(const Rows& rows) {
  List m;
  double value = 0.004;
  for (const auto& d : rows) {
    d.set(m, d.kind == ParameterKind::Extent ? 100.0 * value : value);
    value += 0.0007;
  }
  return m;
}

/// Each parameter changes what is removed, and its derivative is the central difference.
template <class List, class Rows>
void check_derivatives(const Rows& rows) {
  const List m = all_set<List>(rows);
  constexpr double kStep = 1e-5, kDiscretisation = 1e-8;  // third derivative of the extents' t^2 times step^2, and round-off/step
  for (const auto& d : rows) {
    double largest = 0.0;
    for (double r = 46.93; r < 54.0; r += 0.31) {
      for (double z = -14.9; z < 15.0; z += 1.37) {
        List base = m, up = m, down = m;
        d.set(base, d.get(m));
        d.set(up, d.get(m) + kStep);
        d.set(down, d.get(m) - kStep);
        const DeviationFormulaOf<List> above(up, {}, frame), below(down, {}, frame);
        const double difference = (above.at(r, z).value - below.at(r, z).value) / (2 * kStep);
        const double exact = RemovalDerivativeOf<List>(base, frame, d).at(r, z);
        CAPTURE(std::string(d.key), r, z, exact, difference);
        CHECK(std::abs(exact - difference) <= kDiscretisation * std::max(1.0, std::abs(exact)));
        largest = std::max(largest, std::abs(exact));
      }
    }
    CAPTURE(std::string(d.key));
    CHECK(largest > 1e-4);
  }
}

}  // namespace

TEST_CASE("Every modification parameter is read back as set and leaves the others alone", "[core][gear]") {
  std::set<std::string> names;
  for (const ModificationDescriptor& changed : modification_parameters) {
    Modification m;
    double value = 1.0;
    for (const ModificationDescriptor& p : modification_parameters) set(m, p.parameter, value++);
    const Modification before = m;
    set(m, changed.parameter, -7.5);
    CHECK(get(m, changed.parameter) == -7.5);
    for (const ModificationDescriptor& other : modification_parameters) {
      if (other.parameter == changed.parameter || is_half_of(changed, other) || is_half_of(other, changed)) continue;
      CAPTURE(std::string(changed.key), std::string(other.key));
      CHECK(get(m, other.parameter) == get(before, other.parameter));
    }
    names.insert(std::string(changed.key));
  }
  CHECK(names.size() == modification_parameters.size());
}

TEST_CASE("Profile crowning sets both halves and reads their mean", "[core][gear]") {
  Modification m;
  set(m, parameter_of("profile_crowning"), 6.0);
  CHECK(m.addendum_crowning == 6.0);
  CHECK(m.dedendum_crowning == 6.0);
  set(m, parameter_of("addendum_crowning"), 2.0);
  CHECK(get(m, parameter_of("profile_crowning")) == 4.0);
}

TEST_CASE("Every registered parameter changes the removal, by its derivative", "[core][flank][modification]") {
  check_derivatives<Modifications>(modification_parameters);
}

TEST_CASE("A modification is one description and one line", "[core][flank][modification]") {
  check_derivatives<WithCornerRelief>(with_corner_relief);
  REQUIRE(with_corner_relief.size() == 8);
  const Row &amount = with_corner_relief[6], &share = with_corner_relief[7];
  CHECK(amount.key == "corner_relief.amount");
  CHECK(static_cast<std::size_t>(share.parameter) == 7);
  CHECK(std::string(unit_of(amount.kind)) == "um");
  CHECK(outside_factor(share.kind) == 1.0);
  WithCornerRelief m;
  amount.set(m, 0.02);
  CHECK(m.amount == 0.02);
  CHECK(DeviationFormulaOf<WithCornerRelief>(m, {}, frame).at(53.5, 15.0).value == Approx(0.02).epsilon(1e-13));  // round-off
  CHECK(only(m, ModificationClass::Lead) == only(WithCornerRelief{}, ModificationClass::Lead));
  CHECK(only(m, ModificationClass::Topography) == m);
}

TEST_CASE("Lead, profile and topography together are the whole modification", "[core][flank][modification]") {
  const auto all = all_set<Modifications>(modification_parameters);
  const auto lead = only(all, ModificationClass::Lead), profile = only(all, ModificationClass::Profile),
             rest = only(all, ModificationClass::Topography);
  for (const ModificationDescriptor& d : modification_parameters) {
    CAPTURE(std::string(d.key));
    CHECK(d.get(lead) + d.get(profile) + d.get(rest) == d.get(all));
  }
  constexpr double round_off = 1e-12;
  for (double r = 47.0; r < 54.0; r += 0.5) {
    CHECK(removal(lead, frame, r, 4.0) == Approx(removal(lead, frame, 50.0, 4.0)).epsilon(round_off));
    CHECK(removal(profile, frame, r, 4.0) == Approx(removal(profile, frame, r, -9.0)).epsilon(round_off));
  }
}

TEST_CASE("The rows come modification by modification, its choices behind its numbers", "[core][flank][modification]") {
  std::string keys;
  for_each_modification_key([&](const auto& row) { keys += std::string(row.key) + " "; });
  CHECK(keys.find("tip_relief.amount tip_relief.height tip_relief.shape root_relief.amount") != keys.npos);
  CHECK(keys.find("root_relief.height root_relief.shape end_relief.amount") != keys.npos);
}
