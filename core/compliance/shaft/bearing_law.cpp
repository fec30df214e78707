#include "core/compliance/shaft/bearing_law.hpp"

#include <algorithm>
#include <cmath>

#include "core/base/findings.hpp"

namespace flankwright {

namespace {

bool is_ball(BearingType type) { return type == BearingType::DeepGrooveBall || type == BearingType::AngularContactBall; }

/// Types whose contact angle must be said.
bool has_angle(BearingType type) { return type == BearingType::AngularContactBall || type == BearingType::TaperedRoller; }

constexpr double largest_angle = 60 * units::deg;
constexpr int fewest_elements = 3;

class LawChecks : Findings {
 public:
  explicit LawChecks(const BearingLawData& data) : data_(data) {}

  std::vector<InvalidInput> run() {
    if (data_.has_table()) check_table();
    if (data_.type != BearingType::NotGiven) check_type();
    if (data_.type == BearingType::NotGiven) {
      const std::string allowed = "none: it belongs to a type of bearing, which is not given";
      require(data_.elements == 0, "elements", data_.elements, allowed);
      require(std::isnan(data_.element_diameter), "element_diameter", data_.element_diameter, allowed);
      require(std::isnan(data_.element_length), "element_length", data_.element_length, allowed);
      require(std::isnan(data_.contact_angle), "contact_angle", data_.contact_angle / units::deg, allowed);
    }
    return take();
  }

 private:
  /// Names the first value that is not above the one before it.
  void check_column(const std::string& field, const std::vector<double>& values, double unit, const std::string& unit_name) {
    if (values.empty()) return require(false, field, "(not given)", "as many numbers as the other column of the table has");
    require(values.front() >= 0.0 && std::isfinite(values.front()), field, values.front() / unit, "0 " + unit_name + " or more");
    for (std::size_t i = 1; i < values.size() && empty(); ++i) {
      require(values[i] > values[i - 1] && std::isfinite(values[i]), field, values[i] / unit,
              "above " + in_words(values[i - 1] / unit) + " " + unit_name + ", the value before it: a table increases");
    }
  }

  void check_table() {
    require(data_.type == BearingType::NotGiven, "type", name_of(data_.type), "none beside a table: one of them says how the bearing yields");
    const std::vector<double>&forces = data_.table_force, &deflections = data_.table_deflection;
    check_column("force_table", forces, 1.0, "N");
    check_column("deflection_table", deflections, units::um, "um");
    if (!empty()) return;
    require(forces.size() == deflections.size(), "deflection_table", std::to_string(deflections.size()) + " numbers",
            std::to_string(forces.size()) + " numbers, one for each of force_table");
    require(forces.back() > 0.0 && deflections.back() > 0.0, "force_table", forces.back(), "at least one point beyond the origin");
    require((forces.front() == 0.0) == (deflections.front() == 0.0), "deflection_table", deflections.front() / units::um,
            "a table through the origin, where both force and deflection are 0; a play is a radial_clearance");
  }

  void check_type() {
    const BearingType type = data_.type;
    require(data_.elements >= fewest_elements, "elements", data_.elements == 0 ? not_given : data_.elements,
            "an integer of at least " + std::to_string(fewest_elements) + ", the balls or rollers of all rows");
    const auto is_size = [](double size) { return size > 0.0 && std::isfinite(size); };
    if (is_ball(type)) {
      require(is_size(data_.element_diameter), "element_diameter", data_.element_diameter, "above 0 mm: a ball's");
      require(std::isnan(data_.element_length), "element_length", data_.element_length, "none: rollers have it, and this is a " + name_of(type));
    } else {
      require(is_size(data_.element_length), "element_length", data_.element_length, "above 0 mm: a roller's effective length");
      require(std::isnan(data_.element_diameter), "element_diameter", data_.element_diameter,
              "none: the formula of a " + name_of(type) + " has the length of its rollers only");
    }
    const double angle = data_.contact_angle;
    const bool in_range = angle >= 0.0 && angle <= largest_angle;
    const bool may_be_missing = !has_angle(type) && std::isnan(angle);
    require(in_range || may_be_missing, "contact_angle", angle / units::deg, "0 .. " + in_words(largest_angle / units::deg) + " deg");
    require(type != BearingType::CylindricalRoller || may_be_missing || angle == 0.0, "contact_angle", angle / units::deg,
            "0 deg: a cylindrical_roller bearing has none");
  }

  const BearingLawData& data_;
};

}  // namespace

std::string name_of(BearingType type) {
  switch (type) {
    case BearingType::NotGiven:
      return "";
    case BearingType::DeepGrooveBall:
      return "deep_groove_ball";
    case BearingType::AngularContactBall:
      return "angular_contact_ball";
    case BearingType::CylindricalRoller:
      return "cylindrical_roller";
    case BearingType::TaperedRoller:
      return "tapered_roller";
  }
  return "";
}

std::vector<InvalidInput> find_problems(const BearingLawData& data) { return LawChecks(data).run(); }

RadialLaw::RadialLaw(const BearingLawData& data) {
  const std::vector<InvalidInput> problems = find_problems(data);
  if (!problems.empty()) throw problems.front();
  if (data.has_table()) {
    if (data.table_force.front() > 0.0) {
      forces_ = {0.0};
      deflections_ = {0.0};
    }
    forces_.insert(forces_.end(), data.table_force.begin(), data.table_force.end());
    deflections_.insert(deflections_.end(), data.table_deflection.begin(), data.table_deflection.end());
    return;
  }
  const double Z = data.elements, D = data.element_diameter, l = data.element_length;
  const double cos_alpha = std::isnan(data.contact_angle) ? 1.0 : std::cos(data.contact_angle);
  const double Q_per_F = 5.0 / (Z * cos_alpha);
  exponent_ = is_ball(data.type) ? 2.0 / 3.0 : 0.9;
  factor_ = (is_ball(data.type) ? 4.36e-4 / std::cbrt(D) : 7.68e-5 / std::pow(l, 0.8)) / cos_alpha * std::pow(Q_per_F, exponent_);
}

std::size_t RadialLaw::piece_of(const std::vector<double>& values, double value) {
  const auto above = std::upper_bound(values.begin() + 1, values.end() - 1, value);
  return static_cast<std::size_t>(above - values.begin()) - 1;
}

double RadialLaw::deflection(double force) const {
  if (forces_.empty()) return factor_ * std::pow(force, exponent_);
  return deflections_[piece_of(forces_, force)] + compliance(force) * (force - forces_[piece_of(forces_, force)]);
}

double RadialLaw::compliance(double force) const {
  if (forces_.empty()) return exponent_ * factor_ * std::pow(force, exponent_ - 1.0);
  const std::size_t i = piece_of(forces_, force);
  return (deflections_[i + 1] - deflections_[i]) / (forces_[i + 1] - forces_[i]);
}

double RadialLaw::force(double deflection) const {
  if (forces_.empty()) return std::pow(deflection / factor_, 1.0 / exponent_);
  const std::size_t i = piece_of(deflections_, deflection);
  return forces_[i] + stiffness(deflection) * (deflection - deflections_[i]);
}

double RadialLaw::stiffness(double deflection) const {
  if (forces_.empty()) return std::pow(deflection / factor_, 1.0 / exponent_ - 1.0) / (exponent_ * factor_);
  const std::size_t i = piece_of(deflections_, deflection);
  return (forces_[i + 1] - forces_[i]) / (deflections_[i + 1] - deflections_[i]);
}

}  // namespace flankwright
