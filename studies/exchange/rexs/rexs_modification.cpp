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
#include "studies/exchange/rexs/relief_reading.hpp"
#include "studies/exchange/rexs/topography_text.hpp"

namespace flankwright::studies::rexs {

namespace {

using Along = ReliefReading::Along;

class ModificationReading {
 public:
  ModificationReading(Reading& reading, const GearParts& parts, const GearPair& pair, Member member, SlopeEnd slope_end)
      : reading_(reading),
        parts_(parts),
        gear_(pair[member]),
        frame_(pair.flank_frame(member)),
        base_helix_(pair.base_helix_angle),
        slope_end_(slope_end),
        reliefs_(reading, gear_, frame_) {}

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
    read_triangular_relief(c, c.type == "triangular_tip_relief");
  }

  void remark(const std::string& key, const Component& c) {
    std::string& text = result_.remarks[key];
    text += (text.empty() ? "" : " + ") + Reading::name_of(c);
  }

  void read_relief(const Component& c, bool at_tip) {
    const auto taken = reliefs_.profile_relief(c, at_tip ? "tip_relief" : "root_relief", at_tip, Along::Radius);
    if (!taken) return;
    const auto& [amount, height, form] = *taken;
    if (reading_.length(c, "position_of_profile_modification"))
      reading_.note(c, "its position along the face is not taken, the relief is the same along all of it");
    ProfileRelief& relief = at_tip ? result_.modification.tip_relief : result_.modification.root_relief;
    if (cannot_join(relief, *taken)) {
      const double end = at_tip ? frame_.tip_radius : frame_.active_root_radius, sense = at_tip ? 1.0 : -1.0;
      return add_part(
          c, [=, form = form, amount = amount, height = height](double r, double) { return amount * form.at(1.0 + sense * (r - end) / height); },
          {.along_face = false});
    }
    relief = {relief.amount + amount, height, form.shape};
    remark(at_tip ? "tip_relief" : "root_relief", c);
  }

  /// The format gives the start of a triangular relief at the face end and no line: it is taken to start along the line of contact through that point, as
  /// ISO 21771 has it, which says at which end of the face it lies too.
  void read_triangular_relief(const Component& c, bool at_tip) {
    const std::string name = at_tip ? "triangular_tip_relief" : "triangular_root_relief";
    if (base_helix_ == 0.0) return reading_.leave_out(c, "lines of contact of a spur gear cut off no corner");
    const auto taken = reliefs_.profile_relief(c, name, at_tip, Along::Roll);
    if (!taken) return;
    const ContactLineCorner corner(frame_, at_tip ? ContactLineCorner::At::Tip : ContactLineCorner::At::Root, taken->height);
    if (reading_.length(c, "position_of_profile_modification")) reading_.note(c, "its position along the face is not taken");
    ProfileRelief& relief = at_tip ? result_.modification.triangular_tip_relief : result_.modification.triangular_root_relief;
    if (cannot_join(relief, *taken)) {
      return add_part(c, [corner, form = taken->form, amount = taken->amount](double r, double z) {
        return amount * form.at(corner.beyond(r, z) / corner.extent());
      });
    }
    relief = {relief.amount + taken->amount, taken->height, taken->form.shape};
    remark(name, c);
    result_.remarks[name] += fmt::format("; taken to start along a line of contact, at the corner z = {} mm", number_text(corner.face_end()));
  }

  /// Whether a study's one relief cannot have this one in it as well.
  static bool cannot_join(const ProfileRelief& relief, const ReliefReading::Relief& other) {
    return other.form.is_blended() || (relief.amount != 0.0 && (!agree(relief.height, other.height) || relief.shape != other.form.shape));
  }

  void read_profile_slope(const Component& c) {
    const auto amount = reading_.length(c, "profile_slope");
    if (!amount) return reading_.leave_out(c, "it has no amount");
    const auto start = reading_.length(c, "profile_evaluation_start"), end = reading_.length(c, "profile_evaluation_end");
    double share = 1.0;
    if (start && end && !agree(*start, *end)) {
      const double range = 0.5 * std::abs(*end - *start), active = frame_.tip_radius - frame_.active_root_radius;
      if (!agree(range, active)) {
        share = active / range;
        reading_.note(c, "its slope is carried on over the whole active profile, where a study states it");
      }
    }
    result_.modification.profile_slope += share * *amount;
    remark("profile_slope", c);
  }

  void read_profile_crowning(const Component& c) {
    const std::string shape = reading_.word(&c, "shape_of_profile_crowning");
    if (shape == "circular") reading_.note(c, "its circular shape is taken as parabolic");
    const auto tip = reading_.length(c, "profile_crowning_at_tip"), root = reading_.length(c, "profile_crowning_at_root");
    if (!tip && !root) return reading_.leave_out(c, "it has no amount");
    const double pitch = frame_.pitch_radius;
    const auto carried = [&](double amount, std::string_view id, double border) {
      const auto diameter = reading_.length(c, id);
      if (!diameter || agree(0.5 * *diameter, border)) return amount;
      const double share = (border - pitch) / (0.5 * *diameter - pitch);
      if (!std::isfinite(share)) return amount;
      reading_.note(c, fmt::format("its amount at diameter {} mm is carried on to diameter {} mm, where a study states it", number_text(*diameter),
                                   difference_text(2.0 * border)));
      return amount * share * share;
    };
    if (const auto apex = reading_.length(c, "profile_highest_point"); apex && !agree(*apex, 2.0 * pitch)) {
      reading_.note(c, fmt::format("its highest point at {} mm is moved to the pitch circle, diameter {} mm", number_text(*apex),
                                   difference_text(2.0 * pitch)));
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
    const auto amount = reading_.length(c, "helix_slope");
    if (!amount) return reading_.leave_out(c, "it has no amount");
    reading_.word(&c, "helix_evaluation_reference");
    const auto start = reading_.length(c, "helix_evaluation_start"), end = reading_.length(c, "helix_evaluation_end");
    double share = 1.0;
    if (start && end && !agree(*start, *end) && !agree(std::abs(*end - *start), frame_.face_width)) {
      share = frame_.face_width / std::abs(*end - *start);
      reading_.note(c, "its slope is carried on over the whole face, where a study states it");
    }
    const bool at_high_z = (slope_end_ == SlopeEnd::NonDatumFace) == parts_.datum_at_low_z;
    result_.modification.lead_slope += (at_high_z ? share : -share) * *amount;
    remark("lead_slope", c);
    result_.remarks["lead_slope"] +=
        slope_end_ == SlopeEnd::NonDatumFace ? "; + taken to remove at the non-datum face" : "; + taken to remove at the datum face";
  }

  void read_helix_crowning(const Component& c) {
    if (reading_.word(&c, "shape_of_helix_crowning") == "circular") reading_.note(c, "its circular shape is taken as parabolic");
    const auto datum = reading_.length(c, "helix_crowning_amount_datum_face"), other = reading_.length(c, "helix_crowning_amount_non_datum_face");
    if (!datum && !other) return reading_.leave_out(c, "it has no amount");
    const double one = datum.value_or(other.value_or(0.0)), two = other.value_or(one);
    const double apex = reading_.length(c, "helix_highest_point").value_or(0.0), half = 0.5 * frame_.face_width;
    const double at_one = reading_.length(c, "coordinate_where_helix_crowning_is_specified_datum_face").value_or(-half);
    const double at_two = reading_.length(c, "coordinate_where_helix_crowning_is_specified_non_datum_face").value_or(half);
    // One parabola K (z - apex)^2 on both sides: crowning K b^2/4 and, off centre, a slope; a constant only turns the gear.
    const double left = one / ((at_one - apex) * (at_one - apex)), right = two / ((at_two - apex) * (at_two - apex));
    if (!std::isfinite(left) || !std::isfinite(right)) return reading_.leave_out(c, "its amount is specified at its highest point");
    if (std::abs(left - right) > 1e-6 * (std::abs(left) + std::abs(right))) {
      const double to_datum = parts_.datum_at_low_z ? 1.0 : -1.0;
      const auto removed = [=](double, double z) {
        const double along = to_datum * z - apex;
        return (along < 0.0 ? left : right) * along * along;
      };
      return add_part(c, removed, {.along_profile = false});
    }
    const double curvature = 0.5 * (left + right);
    if (!agree(std::abs(at_one), half) || !agree(std::abs(at_two), half))
      reading_.note(c, "its amounts are carried on to the ends of the face, where a study states them");
    result_.modification.lead_crowning +=
        agree(one, two) && apex == 0.0 && agree(-at_one, half) && agree(at_two, half) ? one : curvature * half * half;
    remark("lead_crowning", c);
    if (apex == 0.0) return;
    const double slope = -2.0 * curvature * apex * frame_.face_width;
    result_.modification.lead_slope += parts_.datum_at_low_z ? slope : -slope;
    remark("lead_slope", c);
    reading_.note(c, fmt::format("its highest point at {} mm becomes a lead slope", number_text(apex)));
  }

  void read_twist(const Component& c) {
    const auto amount = reading_.length(c, "profile_twist");
    if (!amount) return reading_.leave_out(c, "it has no amount");
    const auto datum = reading_.length(c, "position_of_profile_twist_datum_face"),
               other = reading_.length(c, "position_of_profile_twist_non_datum_face");
    double share = 1.0;
    if (datum && other && !agree(*datum, *other) && !agree(std::abs(*other - *datum), frame_.face_width)) {
      share = frame_.face_width / std::abs(*other - *datum);
      reading_.note(c, "its twist is carried on over the whole face, where a study states it");
    }
    result_.modification.twist += (parts_.datum_at_low_z ? share : -share) * *amount;
    remark("twist", c);
    result_.remarks["twist"] += "; + taken to remove at the tip at the non-datum face";
  }

  struct EndOfFace {
    double amount{0.0}, length{0.0};
    ReliefForm form{};
    const Component* component{nullptr};
    bool operator==(const EndOfFace& other) const { return agree(amount, other.amount) && agree(length, other.length) && form == other.form; }
  };

  void read_end_relief(const Component& c, const std::string& side, EndOfFace& end) {
    const auto depth = reading_.length(c, "end_relief_depth_" + side), extent = reading_.length(c, "end_relief_length_" + side);
    const auto reference = reading_.length(c, "end_relief_evaluation_reference_" + side);
    if (!depth || !extent || !(*extent > 0.0)) return reading_.leave_out(c, "it has no depth or no length");
    const auto shape = reliefs_.shape_of(c);
    if (!shape) return;
    const auto share_of = [&](const std::string& place) -> std::optional<double> {
      const auto from_end = reading_.length(c, "end_relief_" + side + "_length_of_tangential_transition_" + place);
      return from_end ? std::optional(1.0 - *from_end / *extent) : std::nullopt;
    };
    const ReliefForm form = reliefs_.form_of(c, *shape, share_of("start"), share_of("end"));
    double amount = *depth;
    if (reference && !agree(std::abs(*reference), 0.5 * frame_.face_width)) {
      const double within = *extent - (0.5 * frame_.face_width - std::abs(*reference));
      if (!(within > 0.0)) return reading_.leave_out(c, "it is evaluated before it starts");
      amount /= form.at(within / *extent);
      reading_.note(c, "its depth is carried on to the end of the face, where a study states it");
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
    if (!z || !diameters || !amounts) return reading_.leave_out(c, "it lacks coordinates, diameters or amounts");
    if (z->size() != amounts->size() || diameters->size() != amounts->size()) {
      return reading_.leave_out(c, "its coordinates, diameters and amounts are not one for each point");
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
      return reading_.leave_out(c, problem.what());
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
  ReliefReading reliefs_;
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
