#include "studies/exchange/rexs/relief_reading.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

double ReliefReading::roll_at(double radius) const { return gear_.roll_length_at(std::max(radius, frame_.base_radius)); }

double ReliefReading::radius_at(double roll, bool at_tip) const {
  const double rest = at_tip ? roll_at(frame_.tip_radius) - roll : roll_at(frame_.active_root_radius) + roll;
  return std::hypot(frame_.base_radius, std::max(0.0, rest));
}

std::optional<ReliefShape> ReliefReading::shape_of(const Component& c) {
  const std::string shape = reading_.word(&c, "shape_of_relief");
  if (shape.empty() || shape == "linear" || shape == "false" || shape == "False") return ReliefShape::Linear;
  if (shape == "circular") reading_.note(c, "its circular shape is taken as parabolic");
  if (shape == "parabolic" || shape == "circular") return ReliefShape::Parabolic;
  reading_.leave_out(c, fmt::format("the format has no formula for its shape, \"{}\"", shape));
  return std::nullopt;
}

ReliefForm ReliefReading::form_of(const Component& c, ReliefShape shape, std::optional<double> start, std::optional<double> end) {
  const ReliefForm plain{shape};
  if (reading_.word(&c, "specify_tangential_transition") != "true") return plain;
  const std::string kink = "its tangential transition is not taken, the relief starts with a kink: ";
  if (!start || !end) {
    reading_.note(c, kink + "the file does not say where it starts and ends");
  } else if (shape != ReliefShape::Linear) {
    reading_.note(c, kink + "the format has it for linear reliefs");
  } else if (const ReliefForm blended{shape, *start, *end}; !blended.can_blend()) {
    reading_.note(c, kink + "the relief does not start in the middle third of it");
  } else {
    return blended;
  }
  return plain;
}

std::optional<ReliefReading::Relief> ReliefReading::profile_relief(const Component& c, const std::string& name, bool at_tip, Along along) {
  const auto left_out = [&](const std::string& why) {
    reading_.leave_out(c, why);
    return std::nullopt;
  };
  const auto depth = reading_.length(c, name + "_depth");
  if (!depth || *depth == 0.0) return left_out("it has no depth");
  const auto diameter = reading_.length(c, name + "_datum_diameter"), roll = reading_.length(c, name + "_datum_length");
  const auto reference = reading_.length(c, name + "_evaluation_reference");
  if (!diameter && !roll) return left_out("it has neither datum diameter nor datum length");
  const auto shape = shape_of(c);
  if (!shape) return std::nullopt;
  const double end = at_tip ? frame_.tip_radius : frame_.active_root_radius, sense = at_tip ? 1.0 : -1.0;
  const double start = diameter ? 0.5 * *diameter : radius_at(*roll, at_tip), height = sense * (end - start);
  if (!(height > 0.0)) {
    return left_out(fmt::format("it starts at radius {} mm, beyond the end of the profile at {} mm", difference_text(start), difference_text(end)));
  }
  if (!diameter) {
    reading_.note(c, at_tip ? "its datum length is taken as roll length from the tip"
                            : "its datum length is taken as roll length from the start of active profile");
  }
  const auto share_at = [&](double radius) {
    return along == Along::Radius ? sense * (radius - start) / height : (roll_at(radius) - roll_at(start)) / (roll_at(end) - roll_at(start));
  };
  const auto share_of = [&](const std::string& place) -> std::optional<double> {
    const auto at_diameter = reading_.length(c, name + "_diameter_where_tangential_transition_" + place + "s");
    const auto at_roll = reading_.length(c, name + "_length_of_tangential_transition_" + place);
    if (at_diameter) return share_at(0.5 * *at_diameter);
    return at_roll ? std::optional(share_at(radius_at(*at_roll, at_tip))) : std::nullopt;
  };
  Relief relief{*depth, height, form_of(c, *shape, share_of("start"), share_of("end"))};
  if (reference && !agree(0.5 * *reference, end)) {
    const double share = 1.0 / std::abs(share_at(0.5 * *reference));
    if (!std::isfinite(share)) return left_out("it is evaluated where it starts");
    relief.amount *= ReliefForm{*shape}.at(share);
    reading_.note(c, fmt::format("its depth at diameter {} mm is carried on to diameter {} mm, where a study states it", number_text(*reference),
                                 difference_text(2.0 * end)));
  }
  return relief;
}

}  // namespace flankwright::studies::rexs
