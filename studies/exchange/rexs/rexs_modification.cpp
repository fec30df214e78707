#include "studies/exchange/rexs/rexs_modification.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "core/base/units.hpp"
#include "core/flank/measured_grid.hpp"
#include "studies/study_file/grid_file.hpp"
#include "studies/exchange/rexs/flank_parts.hpp"
#include "studies/exchange/rexs/modification_list.hpp"
#include "studies/exchange/rexs/relief_form.hpp"
#include "studies/exchange/rexs/topography_text.hpp"

namespace flankwright::studies::rexs {

namespace {

/// Equal to the digits that a unit leaves [mm].
bool same_length(double a, double b) { return std::abs(a - b) <= 1e-9 * (1.0 + std::abs(a)); }

class ModificationReading {
 public:
  ModificationReading(Reading& reading, const GearParts& parts, const GearPair& pair, Member member, SlopeEnd slope_end)
      : reading_(reading),
        parts_(parts),
        gear_(pair[member]),
        frame_(pair.flank_frame(member)),
        base_helix_(pair.base_helix_angle),
        slope_end_(slope_end) {}

  ImportedModification read() {
    if (parts_.flank == nullptr) return {};
    for (const Component* component : modifications_of(reading_, *parts_.flank)) read(*component);
    join_end_reliefs();
    lay_grid();
    if (parts_.other_flank != nullptr) compare_other_flank();
    return std::move(result_);
  }

 private:
  void read(const Component& c) {
    reading_.word(&c, "is_additive_modification");  // they always add up here
    if (c.type == "tip_relief") return read_relief(c, true);
    if (c.type == "root_relief") return read_relief(c, false);
    if (c.type == "profile_slope") return read_profile_slope(c);
    if (c.type == "profile_crowning") return read_profile_crowning(c);
    if (c.type == "helix_slope") return read_helix_slope(c);
    if (c.type == "helix_crowning") return read_helix_crowning(c);
    if (c.type == "profile_twist") return read_twist(c);
    if (c.type == "end_relief_datum_face") return read_end_relief(c, "datum_face", datum_end_);
    if (c.type == "end_relief_non_datum_face") return read_end_relief(c, "non_datum_face", other_end_);
    if (c.type == "topographical_modification") return read_topography(c);
    // Triangular reliefs: the diameter at which one starts and its depth, but neither at which end of the face it lies nor how far it
    // reaches along it.
    reading_.word(&c, "shape_of_relief");
    leave_out(c, "the format does not say over which part of the face it reaches");
  }

  std::optional<double> length(const Component& c, std::string_view id) {
    const auto taken = reading_.number(&c, id, Dimension::Length);
    return taken ? std::optional(taken->value) : std::nullopt;
  }
  void remark(const std::string& key, const Component& c) {
    std::string& text = result_.remarks[key];
    text += (text.empty() ? "" : " + ") + Reading::name_of(c);
  }
  void leave_out(const Component& c, const std::string& why) { reading_.warn(Reading::name_of(c) + ": not taken, " + why); }
  void note(const Component& c, const std::string& what) { reading_.warn(Reading::name_of(c) + ": " + what); }

  /// Radius at a roll length measured from the tip down.
  double radius_below_tip(double roll) const {
    const double rest = gear_.roll_length_at(frame_.tip_radius) - roll;
    return std::hypot(frame_.base_radius, std::max(0.0, rest));
  }
  /// Radius at a roll length measured from the start of active profile up.
  double radius_above_root(double roll) const {
    return std::hypot(frame_.base_radius, gear_.roll_length_at(std::max(frame_.active_root_radius, frame_.base_radius)) + roll);
  }

  /// Linear or parabolic; what is neither, but near the parabola, is taken for it. Nullopt for the rest, which is left out.
  std::optional<ReliefShape> shape_of(const Component& c) {
    const std::string shape = reading_.word(&c, "shape_of_relief");
    if (shape.empty() || shape == "linear" || shape == "false" || shape == "False") return ReliefShape::Linear;
    if (shape == "circular") note(c, "its circular shape is taken as parabolic");
    if (shape == "parabolic" || shape == "circular") return ReliefShape::Parabolic;
    leave_out(c, fmt::format("the format has no formula for its shape, \"{}\"", shape));
    return std::nullopt;
  }

  /// The form of a relief with its tangential transition, where that can be taken.
  /// @param start, end  of the transition, as shares of the relief's extent
  ReliefForm form_of(const Component& c, ReliefShape shape, std::optional<double> start, std::optional<double> end) {
    const ReliefForm plain{shape};
    if (reading_.word(&c, "specify_tangential_transition") != "true") return plain;
    const std::string kink = "its tangential transition is not taken, the relief starts with a kink: ";
    if (!start || !end) {
      note(c, kink + "the file does not say where it starts and ends");
    } else if (shape != ReliefShape::Linear) {
      note(c, kink + "the format has it for linear reliefs");
    } else if (const ReliefForm blended{shape, *start, *end}; !blended.can_blend()) {
      note(c, kink + "the relief does not start in the middle third of it");
    } else {
      return blended;
    }
    return plain;
  }

  void read_relief(const Component& c, bool at_tip) {
    const std::string name = at_tip ? "tip_relief" : "root_relief";
    const auto depth = length(c, name + "_depth");
    if (!depth || *depth == 0.0) return leave_out(c, "it has no depth");
    const auto diameter = length(c, name + "_datum_diameter"), roll = length(c, name + "_datum_length");
    const auto reference = length(c, name + "_evaluation_reference");
    if (!diameter && !roll) return leave_out(c, "it has neither datum diameter nor datum length");
    const auto shape = shape_of(c);
    if (!shape) return;
    if (length(c, "position_of_profile_modification")) note(c, "its position along the face is not taken, the relief is the same along all of it");
    const double end = at_tip ? frame_.tip_radius : frame_.active_root_radius;
    const double start = diameter ? 0.5 * *diameter : at_tip ? radius_below_tip(*roll) : radius_above_root(*roll);
    const double height = at_tip ? end - start : start - end;
    if (!(height > 0.0))
      return leave_out(
          c, fmt::format("it starts at radius {} mm, beyond the end of the profile at {} mm", difference_text(start), difference_text(end)));
    if (!diameter)
      note(c, at_tip ? "its datum length is taken as roll length from the tip"
                     : "its datum length is taken as roll length from the start of active profile");
    const double sense = at_tip ? 1.0 : -1.0;
    const auto share_of = [&](const std::string& place) -> std::optional<double> {
      auto radius = length(c, name + "_diameter_where_tangential_transition_" + place + "s");
      if (radius) *radius *= 0.5;
      const auto roll_length = length(c, name + "_length_of_tangential_transition_" + place);
      if (!radius && roll_length) radius = at_tip ? radius_below_tip(*roll_length) : radius_above_root(*roll_length);
      return radius ? std::optional(sense * (*radius - start) / height) : std::nullopt;
    };
    const ReliefForm form = form_of(c, *shape, share_of("start"), share_of("end"));
    double amount = *depth;
    if (reference && !same_length(0.5 * *reference, end)) {
      const double share = height / std::abs(0.5 * *reference - start);
      if (!std::isfinite(share)) return leave_out(c, "it is evaluated where it starts");
      amount *= ReliefForm{*shape}.at(share);
      note(c, fmt::format("its depth at diameter {} mm is carried on to diameter {} mm, where a study states it", number_text(*reference),
                          difference_text(2.0 * end)));
    }
    ProfileRelief& relief = at_tip ? result_.modification.tip_relief : result_.modification.root_relief;
    if (form.is_blended() || (relief.amount != 0.0 && (!same_length(relief.height, height) || relief.shape != *shape))) {
      return add_part(c, [=](double r, double) { return amount * form.at(sense * (r - start) / height); }, {.along_face = false});
    }
    relief = {relief.amount + amount, height, *shape};
    remark(name, c);
  }

  void read_profile_slope(const Component& c) {
    const auto amount = length(c, "profile_slope");
    if (!amount) return leave_out(c, "it has no amount");
    const auto start = length(c, "profile_evaluation_start"), end = length(c, "profile_evaluation_end");
    double share = 1.0;
    if (start && end && !same_length(*start, *end)) {
      const double range = 0.5 * std::abs(*end - *start), active = frame_.tip_radius - frame_.active_root_radius;
      if (!same_length(range, active)) {
        share = active / range;
        note(c, "its slope is carried on over the whole active profile, where a study states it");
      }
    }
    result_.modification.profile_slope += share * *amount;
    remark("profile_slope", c);
  }

  void read_profile_crowning(const Component& c) {
    const std::string shape = reading_.word(&c, "shape_of_profile_crowning");
    if (shape == "circular") note(c, "its circular shape is taken as parabolic");
    const auto tip = length(c, "profile_crowning_at_tip"), root = length(c, "profile_crowning_at_root");
    if (!tip && !root) return leave_out(c, "it has no amount");
    const double pitch = frame_.pitch_radius;
    const auto carried = [&](double amount, std::string_view id, double border) {
      const auto diameter = length(c, id);
      if (!diameter || same_length(0.5 * *diameter, border)) return amount;
      const double share = (border - pitch) / (0.5 * *diameter - pitch);
      if (!std::isfinite(share)) return amount;
      note(c, fmt::format("its amount at diameter {} mm is carried on to diameter {} mm, where a study states it", number_text(*diameter),
                          difference_text(2.0 * border)));
      return amount * share * share;
    };
    if (const auto apex = length(c, "profile_highest_point"); apex && !same_length(*apex, 2.0 * pitch)) {
      note(c,
           fmt::format("its highest point at {} mm is moved to the pitch circle, diameter {} mm", number_text(*apex), difference_text(2.0 * pitch)));
    }
    if (tip) {
      result_.modification.addendum_crowning += carried(*tip, "diameter_where_profile_crowning_tip_is_specified", frame_.tip_radius);
      remark("addendum_crowning", c);
    }
    if (root) {
      result_.modification.dedendum_crowning += carried(*root, "diameter_where_profile_crowning_root_is_specified", frame_.active_root_radius);
      remark("dedendum_crowning", c);
    }
  }

  void read_helix_slope(const Component& c) {
    const auto amount = length(c, "helix_slope");
    if (!amount) return leave_out(c, "it has no amount");
    reading_.word(&c, "helix_evaluation_reference");
    const auto start = length(c, "helix_evaluation_start"), end = length(c, "helix_evaluation_end");
    double share = 1.0;
    if (start && end && !same_length(*start, *end) && !same_length(std::abs(*end - *start), frame_.face_width)) {
      share = frame_.face_width / std::abs(*end - *start);
      note(c, "its slope is carried on over the whole face, where a study states it");
    }
    const bool at_high_z = (slope_end_ == SlopeEnd::NonDatumFace) == parts_.datum_at_low_z;
    result_.modification.lead_slope += (at_high_z ? share : -share) * *amount;
    remark("lead_slope", c);
    result_.remarks["lead_slope"] +=
        slope_end_ == SlopeEnd::NonDatumFace ? "; + taken to remove at the non-datum face" : "; + taken to remove at the datum face";
  }

  void read_helix_crowning(const Component& c) {
    if (reading_.word(&c, "shape_of_helix_crowning") == "circular") note(c, "its circular shape is taken as parabolic");
    const auto datum = length(c, "helix_crowning_amount_datum_face"), other = length(c, "helix_crowning_amount_non_datum_face");
    if (!datum && !other) return leave_out(c, "it has no amount");
    const double one = datum.value_or(other.value_or(0.0)), two = other.value_or(one);
    const double apex = length(c, "helix_highest_point").value_or(0.0), half = 0.5 * frame_.face_width;
    const double at_one = length(c, "coordinate_where_helix_crowning_is_specified_datum_face").value_or(-half);
    const double at_two = length(c, "coordinate_where_helix_crowning_is_specified_non_datum_face").value_or(half);
    // One parabola K (z - apex)^2 on both sides: crowning K b^2/4 and, off centre, a slope; a constant only turns the gear.
    const double left = one / ((at_one - apex) * (at_one - apex)), right = two / ((at_two - apex) * (at_two - apex));
    if (!std::isfinite(left) || !std::isfinite(right)) return leave_out(c, "its amount is specified at its highest point");
    if (std::abs(left - right) > 1e-6 * (std::abs(left) + std::abs(right))) {
      const double to_datum = parts_.datum_at_low_z ? 1.0 : -1.0;
      const auto removed = [=](double, double z) {
        const double along = to_datum * z - apex;
        return (along < 0.0 ? left : right) * along * along;
      };
      return add_part(c, removed, {.along_profile = false});
    }
    const double curvature = 0.5 * (left + right);
    if (!same_length(std::abs(at_one), half) || !same_length(std::abs(at_two), half))
      note(c, "its amounts are carried on to the ends of the face, where a study states them");
    result_.modification.lead_crowning +=
        same_length(one, two) && apex == 0.0 && same_length(-at_one, half) && same_length(at_two, half) ? one : curvature * half * half;
    remark("lead_crowning", c);
    if (apex == 0.0) return;
    const double slope = -2.0 * curvature * apex * frame_.face_width;
    result_.modification.lead_slope += parts_.datum_at_low_z ? slope : -slope;
    remark("lead_slope", c);
    note(c, fmt::format("its highest point at {} mm becomes a lead slope", number_text(apex)));
  }

  void read_twist(const Component& c) {
    const auto amount = length(c, "profile_twist");
    if (!amount) return leave_out(c, "it has no amount");
    const auto datum = length(c, "position_of_profile_twist_datum_face"), other = length(c, "position_of_profile_twist_non_datum_face");
    double share = 1.0;
    if (datum && other && !same_length(*datum, *other) && !same_length(std::abs(*other - *datum), frame_.face_width)) {
      share = frame_.face_width / std::abs(*other - *datum);
      note(c, "its twist is carried on over the whole face, where a study states it");
    }
    result_.modification.twist += (parts_.datum_at_low_z ? share : -share) * *amount;
    remark("twist", c);
    result_.remarks["twist"] += "; + taken to remove at the tip at the non-datum face";
  }

  struct EndOfFace {
    double amount{0.0}, length{0.0};
    ReliefForm form{};
    const Component* component{nullptr};
    bool operator==(const EndOfFace& other) const {
      return same_length(amount, other.amount) && same_length(length, other.length) && form == other.form;
    }
  };

  void read_end_relief(const Component& c, const std::string& side, EndOfFace& end) {
    const auto depth = length(c, "end_relief_depth_" + side), extent = length(c, "end_relief_length_" + side);
    const auto reference = length(c, "end_relief_evaluation_reference_" + side);
    if (!depth || !extent || !(*extent > 0.0)) return leave_out(c, "it has no depth or no length");
    const auto shape = shape_of(c);
    if (!shape) return;
    const auto share_of = [&](const std::string& place) -> std::optional<double> {
      const auto from_end = length(c, "end_relief_" + side + "_length_of_tangential_transition_" + place);
      return from_end ? std::optional(1.0 - *from_end / *extent) : std::nullopt;
    };
    const ReliefForm form = form_of(c, *shape, share_of("start"), share_of("end"));
    double amount = *depth;
    if (reference && !same_length(std::abs(*reference), 0.5 * frame_.face_width)) {
      const double within = *extent - (0.5 * frame_.face_width - std::abs(*reference));
      if (!(within > 0.0)) return leave_out(c, "it is evaluated before it starts");
      amount /= form.at(within / *extent);
      note(c, "its depth is carried on to the end of the face, where a study states it");
    }
    const EndOfFace read{amount, *extent, form, &c};
    if (end.component != nullptr) return add_end_relief(read, &end == &datum_end_);
    end = read;
  }

  void add_end_relief(const EndOfFace& end, bool at_datum) {
    const double sense = at_datum == parts_.datum_at_low_z ? -1.0 : 1.0, start = 0.5 * frame_.face_width - end.length;
    add_part(*end.component, [=](double, double z) { return end.amount * end.form.at((sense * z - start) / end.length); }, {.along_profile = false});
  }

  /// A study has the same linear relief at both ends; all else is a part of the grid.
  void join_end_reliefs() {
    const EndOfFace &one = datum_end_, &two = other_end_;
    if (one.component != nullptr && two.component != nullptr && one == two && one.form == ReliefForm{}) {
      result_.modification.end_relief = {one.amount, one.length};
      remark("end_relief", *one.component);
      remark("end_relief", *two.component);
      return;
    }
    if (one.component != nullptr) add_end_relief(one, true);
    if (two.component != nullptr) add_end_relief(two, false);
  }

  void read_topography(const Component& c) {
    reading_.word(&c, "type_of_interpolation_topographical_modification");
    const auto z = reading_.numbers(&c, "coordinates_of_topographical_modification", Dimension::Length);
    const auto diameters = reading_.numbers(&c, "diameters_of_topographical_modification", Dimension::Length);
    const auto amounts = reading_.numbers(&c, "topographical_modification_amounts", Dimension::Length);
    if (!z || !diameters || !amounts) return leave_out(c, "it lacks coordinates, diameters or amounts");
    if (z->size() != amounts->size() || diameters->size() != amounts->size()) {
      return leave_out(c, "its coordinates, diameters and amounts are not one for each point");
    }
    std::vector<TopographyPoint> points;
    for (std::size_t i = 0; i < amounts->size(); ++i) {
      points.push_back({0.5 * (*diameters)[i], parts_.datum_at_low_z ? (*z)[i] : -(*z)[i], (*amounts)[i]});
    }
    std::string grid = topography_text(points, Reading::name_of(c), base_helix_);
    try {
      const std::shared_ptr<const DeviationField> field = make_grid_field(parse_grid(grid, "points"), frame_.base_radius, base_helix_).field;
      add_part(c, [field, this](double r, double axial) { return field->at(gear_.roll_length_at(r), axial).value; });
    } catch (const InvalidInput& problem) {
      return leave_out(c, problem.what());
    }
    points_ = std::move(grid);
  }

  /// Removal that the keys of a study cannot say.
  void add_part(const Component& c, std::function<double(double r, double z)> removed, FlankPart changes = {}) {
    changes.removed = std::move(removed);
    parts_of_grid_.push_back(std::move(changes));
    remark("grid", c);
  }

  /// What no key says goes into the grid: a topography by itself with the points that it has, all else summed at even ones.
  void lay_grid() {
    if (parts_of_grid_.empty()) return;
    if (parts_of_grid_.size() == 1 && !points_.empty()) {
      result_.grid = std::move(points_);
      return;
    }
    const std::string of = result_.remarks.at("grid");
    try {
      GriddedParts laid = grid_of(parts_of_grid_, frame_, base_helix_);
      reading_.warn(
          fmt::format("{}: taken as a grid of {} radii and {} axial positions; the surface through them departs from it by at most {:.2g} um", of,
                      laid.radii, laid.positions, laid.departure / units::um));
      result_.grid = "# " + of + "\n" + std::move(laid.text);
    } catch (const InvalidInput& problem) {
      reading_.warn(of + ": not taken, " + problem.what());
      result_.remarks.erase("grid");
    }
  }

  /// Whether the flank at the back is modified alike is not a study's business, but not to be lost either.
  void compare_other_flank() {
    const auto of_other = modifications_of(reading_, *parts_.other_flank);
    const auto of_this = modifications_of(reading_, *parts_.flank);
    for (const Component* c : of_other) {
      if (std::ranges::find(of_this, c) == of_this.end()) back_.push_back(Reading::name_of(*c));
    }
    if (!back_.empty()) {
      reading_.warn(
          fmt::format("{}: not taken, the other flank carries the load; its own: {}", Reading::name_of(*parts_.other_flank), fmt::join(back_, ", ")));
    }
  }

  Reading& reading_;
  const GearParts& parts_;
  const Gear& gear_;
  FlankFrame frame_;
  double base_helix_;
  SlopeEnd slope_end_;
  EndOfFace datum_end_, other_end_;
  std::vector<FlankPart> parts_of_grid_;
  std::string points_;  ///< the grid file of the last topographical_modification
  std::vector<std::string> back_;
  ImportedModification result_;
};

}  // namespace

ImportedModification read_modification(Reading& reading, const GearParts& parts, const GearPair& pair, Member member, SlopeEnd slope_end) {
  return ModificationReading(reading, parts, pair, member, slope_end).read();
}

}  // namespace flankwright::studies::rexs
