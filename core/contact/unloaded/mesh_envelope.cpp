#include "core/contact/unloaded/mesh_envelope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/base/peak.hpp"
#include "core/base/root.hpp"

namespace flankwright {

namespace {

constexpr double no_limit = std::numeric_limits<double>::infinity();
constexpr double margin = 0.25;                                // pitches beyond the extended path, see MeshEnvelope
constexpr double transfer_tolerance = 1e-13;                   // rad of the pinion
constexpr PeakTolerance extreme_tolerance{1e-9, 1e-16, 1e-7};  // rad of the pinion, rad of the wheel, rad of the pinion

}  // namespace

/// One pair's transmission error as find_peak() asks for it, upside down for a trough.
struct MeshEnvelope::Sample {
  ToothContact contact;
  double sign;

  double position() const { return contact.phi1; }
  double value() const { return sign * contact.transmission_error; }
  double slope() const { return sign * contact.slope; }
};

const ToothContact* MeshState::of(int tooth) const {
  const auto found = std::find_if(contacts.begin(), contacts.end(), [&](const ToothContact& c) { return c.tooth == tooth; });
  return found == contacts.end() ? nullptr : &*found;
}

MeshEnvelope::MeshEnvelope(const GearPair& pair, const FlankAssembly& assembly)
    : pair_(pair), solver_(assembly), path_(pair), pitch_(2.0 * units::pi / assembly.pinion_teeth) {}

bool MeshEnvelope::is_within(int tooth, double phi1, double beyond) const {
  const double phase = path_.line_phase_at(phi1 + tooth * pitch_, pair_);
  return phase >= -beyond && phase <= path_.last_line_phase() + beyond;
}

/// Contact of one pair, None where it is not in mesh.
ToothContact MeshEnvelope::contact(int tooth, double phi1) const {
  return is_within(tooth, phi1, margin) ? solver_.find(tooth, phi1) : ToothContact{};
}

MeshState MeshEnvelope::at(double phi1, int preferred) const {
  MeshState state;
  state.phi1 = phi1;
  const double phase = path_.line_phase_at(phi1, pair_);  // of pair 0; every tooth on adds one
  const int first = static_cast<int>(std::floor(-margin - phase));
  const int last = static_cast<int>(std::ceil(path_.last_line_phase() + margin - phase));
  for (int tooth = first; tooth <= last; ++tooth) {
    const ToothContact found = contact(tooth, phi1);
    if (found.exists()) state.contacts.push_back(found);
  }
  double highest = -no_limit;
  for (const ToothContact& c : state.contacts) highest = std::max(highest, c.transmission_error);
  for (int i = 0; i < static_cast<int>(state.contacts.size()); ++i) {
    const ToothContact& c = state.contacts[i];
    const bool stays = c.tooth == preferred && c.transmission_error >= highest - leading_tolerance;
    if (stays || (c.transmission_error == highest && state.leading_index < 0)) state.leading_index = i;
  }
  return state;
}

void MeshEnvelope::look_ahead(MeshState& state, double step) const {
  if (!state.exists()) return;
  const MeshState next = at(state.phi1 + step, state.leading().tooth);
  if (!next.exists()) return;
  const ToothContact* successor = state.of(next.leading().tooth);
  if (successor && successor->transmission_error >= state.leading().transmission_error - leading_tolerance) {
    state.leading_index = static_cast<int>(successor - state.contacts.data());
  }
}

void MeshEnvelope::follow(const MeshState& from, const MeshState& to, std::vector<Transfer>& transfers, double& smallest, double& largest) const {
  if (!from.exists() || !to.exists()) return;
  const int before = from.leading().tooth, after = to.leading().tooth;
  const double split = before == after ? hidden_transfer(from, to) : transfer_point(from, to);
  if (std::isnan(split)) {
    follow_pair(from.leading(), to.leading(), smallest, largest);
    return;
  }
  const MeshState middle = at(split, after);
  if (!middle.exists()) return;
  const ToothContact* leaves = middle.of(before);
  const bool inside = split > from.phi1 && split < to.phi1;
  const bool third = inside && middle.leading().tooth != after && middle.leading().tooth != before;
  if (before == after || third) {
    follow(from, middle, transfers, smallest, largest);
    follow(middle, to, transfers, smallest, largest);
    return;
  }
  const ToothContact& enters = middle.leading();
  Transfer transfer;
  transfer.phi1 = split;
  transfer.from_tooth = before;
  transfer.to_tooth = after;
  transfer.transmission_error = enters.transmission_error;
  transfer.slope_after = enters.slope;
  if (leaves) transfer.slope_before = leaves->slope;
  transfers.push_back(transfer);
  smallest = std::min(smallest, transfer.transmission_error);
  largest = std::max(largest, transfer.transmission_error);
  if (leaves) follow_pair(from.leading(), *leaves, smallest, largest);
  follow_pair(enters, to.leading(), smallest, largest);
}

/// The angle at which the leading pair of `to` overtakes that of `from`, by leading_tolerance.
double MeshEnvelope::transfer_point(const MeshState& from, const MeshState& to) const {
  const int before = from.leading().tooth, after = to.leading().tooth;
  const auto ahead = [&](const ToothContact* entering, const ToothContact* leaving) {
    if (!leaving || !leaving->exists()) return no_limit;
    if (!entering || !entering->exists()) return -no_limit;
    return entering->transmission_error - leaving->transmission_error - leading_tolerance;
  };
  const auto at_angle = [&](double phi1) {
    const ToothContact entering = contact(after, phi1), leaving = contact(before, phi1);
    return ahead(&entering, &leaving);
  };
  const double start = ahead(from.of(after), from.of(before)), end = ahead(to.of(after), to.of(before));
  if (end <= 0.0) return to.phi1;  // only about to overtake, see look_ahead()
  return bracketed_root(at_angle, from.phi1, start, to.phi1, end, transfer_tolerance).upper;
}

/// Angle at which another pair may overtake the one that is leading at both ends and fall back again; NaN where none
/// does. Its advance, concave near its crest, stays below the point where the tangents at both ends meet.
double MeshEnvelope::hidden_transfer(const MeshState& from, const MeshState& to) const {
  const ToothContact &first = from.leading(), &last = to.leading();
  for (const ToothContact& c : from.contacts) {
    const ToothContact* other = to.of(c.tooth);
    if (c.tooth == first.tooth || !other) continue;
    const double rise = c.slope - first.slope, fall = other->slope - last.slope;
    if (!(rise > 0.0 && fall < 0.0)) continue;
    const double advance = c.transmission_error - first.transmission_error;
    const double last_advance = other->transmission_error - last.transmission_error;
    const double width = to.phi1 - from.phi1;
    const double meet = (last_advance - advance - fall * width) / (rise - fall);
    if (advance + rise * meet <= leading_tolerance) continue;
    // The crest of the advance itself decides.
    const auto lead_slope = [&](double phi1) { return contact(c.tooth, phi1).slope - contact(first.tooth, phi1).slope; };
    const double crest = bracketed_root(lead_slope, from.phi1, rise, to.phi1, fall, 1e-6 * width).x;
    const ToothContact over = contact(c.tooth, crest), under = contact(first.tooth, crest);
    if (over.exists() && under.exists() && over.transmission_error > under.transmission_error + leading_tolerance) return crest;
  }
  return not_given;
}

/// The crest or trough of one pair between two angles, if its slope changes sign by more than round-off.
void MeshEnvelope::follow_pair(const ToothContact& from, const ToothContact& to, double& smallest, double& largest) const {
  const double width = to.phi1 - from.phi1;
  if (!(from.slope * to.slope < 0.0) || std::min(std::abs(from.slope), std::abs(to.slope)) * width <= leading_tolerance) return;
  const double sign = from.slope > 0.0 ? 1.0 : -1.0;
  const double curvature = std::abs(to.slope - from.slope) / width;
  const auto evaluate = [&](double phi1, const Sample*) { return Sample{contact(from.tooth, phi1), sign}; };
  const double guess = std::clamp(from.phi1 + std::abs(from.slope) / curvature, from.phi1, to.phi1);
  const Peak<Sample> peak =
      find_peak<Sample>(evaluate, from.phi1, to.phi1, guess, curvature, extreme_tolerance, Sample{from, sign}, Sample{to, sign});
  smallest = std::min(smallest, peak.top.contact.transmission_error);
  largest = std::max(largest, peak.top.contact.transmission_error);
}

}  // namespace flankwright
