#include "core/contact/unloaded/parabola_check.hpp"

#include <Eigen/QR>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <map>
#include <vector>

namespace flankwright {

namespace {

constexpr double coefficient_tolerance = 0.10;  // of the wanted a
constexpr double residual_tolerance = 0.05;     // of a (pi/N1)^2

/// A position or transfer point of the mesh in the angle of the leading tooth.
struct ArcPoint {
  double angle;  ///< phi1 of its own passage: 0 where its undisturbed flank passes the pitch point [rad]
  double error;  ///< delta_phi2 [rad]
};

/// One pitch of the mesh by its leading teeth; at least one transfer point.
struct LeadingPair {
  std::vector<ArcPoint> positions, transfer_points;
  std::vector<Transfer> transfers;
  std::map<ContactKind, int> kinds;  ///< positions at which the leading pair touches so
};

ToothContact leading_at(const UnloadedMesh& mesh, std::size_t position) {
  ToothContact leading;
  for (const PairCurve& pair : mesh.pairs) {
    for (const ToothContact& c : pair.positions) {
      if (c.phi1 == mesh.phi1[position] && (!leading.exists() || c.transmission_error > leading.transmission_error)) leading = c;
    }
  }
  return leading;
}

LeadingPair follow_leading_pair(const FlankAssembly& assembly, const UnloadedMesh& mesh) {
  const double pitch = 2.0 * units::pi / assembly.pinion_teeth;
  LeadingPair leading_pair;
  leading_pair.transfers = mesh.transfers;
  std::size_t next = 0;
  for (std::size_t i = 0; i < mesh.phi1.size(); ++i) {
    while (next < leading_pair.transfers.size() && leading_pair.transfers[next].phi1 <= mesh.phi1[i]) ++next;
    const int tooth = next == 0 ? leading_pair.transfers.front().from_tooth : leading_pair.transfers[next - 1].to_tooth;
    leading_pair.positions.push_back({mesh.phi1[i] + tooth * pitch, mesh.transmission_error[i]});
    const ToothContact contact = leading_at(mesh, i);
    ++leading_pair.kinds[contact.kind];
  }
  for (const Transfer& t : leading_pair.transfers) {
    leading_pair.transfer_points.push_back({t.phi1 + t.from_tooth * pitch, t.transmission_error});
    leading_pair.transfer_points.push_back({t.phi1 + t.to_tooth * pitch, t.transmission_error});
  }
  return leading_pair;
}

std::string text(const char* format, double value) {
  char buffer[160];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

/// Percentage of the pitch over which the leading pair touches in one of these ways [%].
double share_of_pitch(const LeadingPair& leading_pair, std::initializer_list<ContactKind> kinds) {
  int count = 0;
  for (const ContactKind kind : kinds) {
    const auto found = leading_pair.kinds.find(kind);
    if (found != leading_pair.kinds.end()) count += found->second;
  }
  return 100.0 * count / static_cast<double>(leading_pair.positions.size());
}

double on_face_end(const LeadingPair& leading_pair) { return share_of_pitch(leading_pair, {ContactKind::FaceEnd, ContactKind::Corner}); }

/// The cause of the departure from the parabola, as far as the kinds of contact show it.
std::string cause(const LeadingPair& leading_pair) {
  const double ends = on_face_end(leading_pair);
  const double tips = share_of_pitch(leading_pair, {ContactKind::PinionTip, ContactKind::WheelTip, ContactKind::PinionRoot, ContactKind::WheelRoot});
  if (ends > tips) return text("; contact runs on a face end over %.0f %% of the pitch: more lead crowning or less misalignment", ends);
  if (tips > 0.0) return text("; contact runs on a tip or root edge over %.0f %% of the pitch: a larger parabola shifts less", tips);
  return "";
}

// Quiet where a slope is NaN: of a pair that is not there.
bool leaves_well(const Transfer& t) { return std::islessequal(t.slope_before, 0.0); }
bool enters_well(const Transfer& t) { return std::isgreaterequal(t.slope_after, 0.0); }

std::string verdict(const ParabolaCheck& check, const LeadingPair& leading_pair, double height) {
  for (const Transfer& t : leading_pair.transfers) {
    const double degrees = t.phi1 / units::deg;
    if (!leaves_well(t)) {
      return text("the pair that leaves still gains at the transfer point at %.3f deg", degrees) + cause(leading_pair);
    }
    if (!enters_well(t)) {
      return text("the pair that enters still falls behind at the transfer point at %.3f deg", degrees) + cause(leading_pair);
    }
  }
  const double off = check.found / check.wanted - 1.0;
  if (!(std::abs(off) <= coefficient_tolerance)) {
    return text("the parabola's coefficient differs by %+.0f %% from the one asked for", 100.0 * off) + cause(leading_pair);
  }
  if (!(check.residual <= residual_tolerance * height)) {
    return text("the arc departs from its parabola by %.0f %% of its height", 100.0 * check.residual / height) + cause(leading_pair);
  }
  if (on_face_end(leading_pair) > 0.0) return "the parabola is there, but not on the flanks" + cause(leading_pair);
  return "";
}

}  // namespace

ParabolaCheck check_parabola(const FlankAssembly& assembly, const UnloadedMesh& mesh, double wanted) {
  if (!(wanted > 0.0 && std::isfinite(wanted))) throw InvalidInput("parabolic_te", std::to_string(wanted), "above 0 1/rad");
  if (mesh.phi1.size() < 4) throw InvalidInput("positions", std::to_string(mesh.phi1.size()), "at least 4");
  ParabolaCheck check;
  check.wanted = wanted;
  if (mesh.missing > 0) {
    check.why = text("no tooth pair touches at %.0f positions: the contact ratio is below 1", mesh.missing);
    return check;
  }
  if (mesh.transfers.empty()) {
    check.why = "no transfer point: the pairs lead together, there is no parabola";
    return check;
  }
  const LeadingPair leading_pair = follow_leading_pair(assembly, mesh);
  const double half_pitch = units::pi / assembly.pinion_teeth;  // scales the fit to numbers of order 1
  const double height = wanted * half_pitch * half_pitch;

  const auto count = static_cast<Eigen::Index>(leading_pair.positions.size());
  Eigen::MatrixX3d powers(count, 3);
  Eigen::VectorXd errors(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const ArcPoint& point = leading_pair.positions[static_cast<std::size_t>(i)];
    const double x = point.angle / half_pitch;
    powers.row(i) << 1.0, x, x * x;
    errors[i] = point.error / height;
  }
  const Eigen::Vector3d fit = powers.colPivHouseholderQr().solve(errors);
  check.found = -fit[2] * wanted;
  check.shift = -0.5 * fit[1] / fit[2] * half_pitch;
  check.residual = 0.0;
  for (const std::vector<ArcPoint>* points : {&leading_pair.positions, &leading_pair.transfer_points}) {
    for (const ArcPoint& point : *points) {
      const double x = point.angle / half_pitch;
      check.residual = std::max(check.residual, std::abs(point.error - height * (fit[0] + x * (fit[1] + x * fit[2]))));
    }
  }
  check.right_sign =
      std::all_of(leading_pair.transfers.begin(), leading_pair.transfers.end(), [](const Transfer& t) { return leaves_well(t) && enters_well(t); });
  check.why = verdict(check, leading_pair, height);
  check.holds = check.why.empty();
  return check;
}

}  // namespace flankwright
