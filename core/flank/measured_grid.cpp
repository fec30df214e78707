#include "core/flank/measured_grid.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "core/base/error.hpp"
#include "core/flank/bicubic_spline.hpp"

namespace flankwright {

namespace {

std::string mm(double number) { return in_words(number) + " mm"; }

[[noreturn]] void refuse(const std::string& value, const std::string& allowed) { throw InvalidInput("grid", value, allowed); }

double roll_length(double radius, double base_radius) { return std::sqrt((radius - base_radius) * (radius + base_radius)); }

void check_line(const std::vector<double>& points, const std::string& name) {
  if (points.size() < 2 || points.size() > most_grid_lines) {
    refuse(std::to_string(points.size()) + " " + name, "2 .. " + std::to_string(most_grid_lines) + " of them");
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!(std::abs(points[i]) <= largest_grid_length)) {
      refuse(mm(points[i]) + " among the " + name, "a length within " + mm(largest_grid_length));
    }
    if (i > 0 && points[i] - points[i - 1] < smallest_grid_step) {
      refuse(mm(points[i]) + " after " + mm(points[i - 1]), name + " that increase by at least " + mm(smallest_grid_step));
    }
  }
}

int checked_pieces(std::optional<int> given, std::size_t points, const std::string& field) {
  const int most = most_spline_pieces(static_cast<int>(points));
  if (given && (*given < 1 || *given > most)) {
    throw InvalidInput(field, std::to_string(*given), "an integer 1 .. " + std::to_string(most) + " on " + std::to_string(points) + " points");
  }
  return given.value_or(most);
}

void check_not_folded(const GridSamples& removed) {
  for (std::size_t i = 0; i + 1 < removed.u.size(); ++i) {
    const auto row = static_cast<Eigen::Index>(i);
    const double change = (removed.values.row(row + 1) - removed.values.row(row)).cwiseAbs().maxCoeff();
    const double along = removed.u[i + 1] - removed.u[i];
    if (change >= along) {
      refuse("a change by " + mm(change) + " over a roll length of " + mm(along),
             "a deviation that changes less than the roll length from one radius to the next");
    }
  }
}

using SharedSpline = std::shared_ptr<const BicubicSpline>;

/// A measured surface as far as it changes along the face, by its trace at one roll length.
class HelixTrace final : public DeviationField {
 public:
  HelixTrace(SharedSpline spline, double rho, double middle) : spline_(std::move(spline)), rho_(rho), from_(spline_->at(rho, middle).value) {}
  Jet at(double, double z) const override {
    const Jet of = spline_->at(rho_, z);
    return {of.value - from_, 0.0, of.v, 0.0, 0.0, of.vv};
  }

 private:
  SharedSpline spline_;
  double rho_, from_;
};

/// As far as it changes along the profile, by its trace at one axial position.
class ProfileTrace final : public DeviationField {
 public:
  ProfileTrace(SharedSpline spline, double z) : spline_(std::move(spline)), z_(z) {}
  Jet at(double rho, double) const override {
    const Jet of = spline_->at(rho, z_);
    return {of.value, of.u, 0.0, of.uu, 0.0, 0.0};
  }

 private:
  SharedSpline spline_;
  double z_;
};

class GridField final : public DeviationField {
 public:
  /// @param rho, z  of the middle of the grid
  GridField(SharedSpline spline, double rho, double z)
      : spline_(std::move(spline)),
        along_face_(std::make_shared<HelixTrace>(spline_, rho, z)),
        along_profile_(std::make_shared<ProfileTrace>(spline_, z)) {}
  Jet at(double rho, double z) const override { return spline_->at(rho, z); }
  std::shared_ptr<const DeviationField> along_face() const override { return along_face_; }
  std::shared_ptr<const DeviationField> along_profile() const override { return along_profile_; }

 private:
  SharedSpline spline_;
  std::shared_ptr<const DeviationField> along_face_, along_profile_;
};

}  // namespace

void validate(const MeasuredGrid& grid, double base_radius) {
  check_line(grid.radii, "radii");
  check_line(grid.z, "axial positions");
  if (!(grid.radii.front() > base_radius)) {
    refuse("radius " + mm(grid.radii.front()), "radii above the base radius, " + mm(base_radius));
  }
  const auto rows = static_cast<Eigen::Index>(grid.radii.size()), columns = static_cast<Eigen::Index>(grid.z.size());
  if (grid.deviation.rows() != rows || grid.deviation.cols() != columns) {
    refuse(std::to_string(grid.deviation.size()) + " deviations", "one for every radius and axial position");
  }
  for (const double delta : grid.deviation.reshaped()) {
    if (!(std::abs(delta) <= largest_grid_deviation)) {
      refuse("a deviation of " + mm(delta), "deviations within " + mm(largest_grid_deviation));
    }
  }
}

GridCoverage check_coverage(const MeasuredGrid& grid, const FlankFrame& frame) {
  // Share of the range between `low` and `high` that the grid spans from `first` to `last`.
  const auto share = [](double first, double last, double low, double high, const std::string& found, const std::string& allowed) {
    const double margin = widest_grid_margin * (high - low);
    if (first - low > margin || high - last > margin) refuse(found, allowed);
    return (std::min(last, high) - std::max(first, low)) / (high - low);
  };
  const auto roll = [&](double radius) { return roll_length(radius, frame.base_radius); };
  const std::string margin = std::to_string(static_cast<int>(100.0 * widest_grid_margin)) + " %";
  GridCoverage coverage;
  coverage.profile = share(roll(grid.radii.front()), roll(grid.radii.back()), roll(frame.active_root_radius), roll(frame.tip_radius),
                           "radii " + mm(grid.radii.front()) + " .. " + mm(grid.radii.back()),
                           "radii that leave at most " + margin + " of the active roll length to either side, which goes from radius " +
                               mm(frame.active_root_radius) + " to " + mm(frame.tip_radius));
  const double half = 0.5 * frame.face_width;
  coverage.face = share(grid.z.front(), grid.z.back(), -half, half, "z " + mm(grid.z.front()) + " .. " + mm(grid.z.back()),
                        "z from mid face that leaves at most " + margin + " of the face width to either side, " + mm(-half) + " .. " + mm(half));
  return coverage;
}

GridFit make_grid_field(const MeasuredGrid& grid, double base_radius, double base_helix_angle, const GridFitOptions& options) {
  validate(grid, base_radius);
  const double cos_beta_b = std::cos(base_helix_angle);
  GridSamples removed{{}, grid.z, grid.deviation / -cos_beta_b};
  for (const double radius : grid.radii) removed.u.push_back(roll_length(radius, base_radius));
  check_not_folded(removed);
  SplineFit fit = fit_spline(removed, {checked_pieces(options.profile_pieces, grid.radii.size(), "grid.profile_pieces"),
                                       checked_pieces(options.face_pieces, grid.z.size(), "grid.face_pieces")});
  const auto middle = [](const std::vector<double>& values) { return 0.5 * (values.front() + values.back()); };
  return {std::make_shared<GridField>(std::make_shared<const BicubicSpline>(std::move(fit.spline)), middle(removed.u), middle(removed.v)),
          fit.rms * cos_beta_b, fit.largest * cos_beta_b};
}

}  // namespace flankwright
