#include "core/rating/damage.hpp"

#include <stdexcept>

namespace flankwright {

namespace {

/// Where the stress of a fillet point is largest in a cycle.
struct LargestStress {
  double stress{0.0};
  std::size_t position{0};
  Eigen::Index station{-1};
};

LargestStress largest_at(const LoadedCycle& cycle, const FilletPoints& points, Eigen::Index point) {
  LargestStress largest;
  for (const FilletPoints::Pass& pass : points.passes) {
    const Eigen::VectorXd& stress = cycle.positions[pass.position].root_stress;
    if (stress.size() == 0) throw std::runtime_error("root stress was not computed");
    const Eigen::Index station = pass.begin + point;
    if (stress[station] > largest.stress) largest = {stress[station], pass.position, station};
  }
  return largest;
}

/// Adds n times the damage of a stress and its derivative.
void add(DamageSum& sum, const SnCurve& curve, double cycles, double stress, const Eigen::RowVectorXd& slope) {
  const SnCurve::Damage damage = curve.damage(stress);
  sum.value += cycles * damage.value;
  if (slope.size() == 0) return;
  if (sum.gradient.size() == 0) sum.gradient = Eigen::RowVectorXd::Zero(slope.size());
  sum.gradient += cycles * damage.slope * slope;
}

}  // namespace

Eigen::VectorXd contact_damage(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, std::size_t position) {
  Eigen::VectorXd damage = Eigen::VectorXd::Zero(std::ssize(model.positions[position].points));
  for (const SpectrumCase& load_case : spectrum) {
    const double cycles = load_cycles(model.pair, member, load_case.operation);
    const SnCurve of_case = curve.of_stress_times(load_case.operation.contact_overload());
    const Eigen::VectorXd& stress = load_case.cycle->positions[position].contact_stress;
    for (Eigen::Index j = 0; j < damage.size(); ++j) damage[j] += cycles * of_case.damage(stress[j]).value;
  }
  return damage;
}

DamageSum contact_damage_at(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, std::size_t position,
                            Eigen::Index point) {
  DamageSum sum;
  for (const SpectrumCase& load_case : spectrum) {
    const LoadedPosition& there = load_case.cycle->positions[position];
    const bool has_slopes = there.contact_stress_derivative.cols() > 0;
    const SnCurve of_case = curve.of_stress_times(load_case.operation.contact_overload());
    add(sum, of_case, load_cycles(model.pair, member, load_case.operation), there.contact_stress[point],
        has_slopes ? Eigen::RowVectorXd(there.contact_stress_derivative.row(point)) : Eigen::RowVectorXd());
  }
  return sum;
}

FilletPoints fillet_points(const MeshModel& model, Member member) {
  FilletPoints points;
  for (std::size_t i = 0; i < model.positions.size(); ++i) {
    const std::vector<RootStation>& stations = model.positions[i].root_stress.stations;
    for (Eigen::Index begin = 0; begin < std::ssize(stations);) {
      const RootStation& first = stations[static_cast<std::size_t>(begin)];
      Eigen::Index end = begin;
      const auto same_tooth = [&](const RootStation& station) { return station.member == first.member && station.tooth == first.tooth; };
      while (end < std::ssize(stations) && same_tooth(stations[static_cast<std::size_t>(end)])) ++end;
      if (first.member == member) {
        points.count = end - begin;
        points.passes.push_back({i, begin});
      }
      begin = end;
    }
  }
  return points;
}

Eigen::VectorXd root_damage(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, const FilletPoints& points) {
  Eigen::VectorXd damage = Eigen::VectorXd::Zero(points.count);
  for (const SpectrumCase& load_case : spectrum) {
    const double cycles = load_cycles(model.pair, member, load_case.operation);
    const SnCurve of_case = curve.of_stress_times(load_case.operation.overload());
    for (Eigen::Index p = 0; p < points.count; ++p) damage[p] += cycles * of_case.damage(largest_at(*load_case.cycle, points, p).stress).value;
  }
  return damage;
}

DamageSum root_damage_at(const MeshModel& model, const LoadSpectrum& spectrum, Member member, const SnCurve& curve, const FilletPoints& points,
                         Eigen::Index point) {
  DamageSum sum;
  for (const SpectrumCase& load_case : spectrum) {
    const LargestStress largest = largest_at(*load_case.cycle, points, point);
    const LoadedPosition& there = load_case.cycle->positions[largest.position];
    const bool has_slopes = there.line_load_derivative.cols() > 0;
    Eigen::RowVectorXd slope;
    if (has_slopes && largest.station >= 0) slope = root_stress_derivative(model.positions[largest.position], there, largest.station);
    if (has_slopes && largest.station < 0) slope = Eigen::RowVectorXd::Zero(there.line_load_derivative.cols());
    add(sum, curve.of_stress_times(load_case.operation.overload()), load_cycles(model.pair, member, load_case.operation), largest.stress, slope);
  }
  return sum;
}

}  // namespace flankwright
