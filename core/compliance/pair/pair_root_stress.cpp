#include "core/compliance/pair/pair_root_stress.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "core/base/wide_sum.hpp"
#include "core/compliance/pair/pair_compliance.hpp"

namespace flankwright {

Eigen::VectorXd RootStressInfluence::Forces::of_table(const Eigen::VectorXd& at_points) const {
  const Eigen::MatrixXd loaded = along_zeta * at_points.segment(begin, points()).asDiagonal();
  return (loaded * along_u.transpose()).eval().reshaped();
}

Eigen::RowVectorXd RootStressInfluence::Forces::at_points(const Eigen::RowVectorXd& of_table) const {
  const auto table = of_table.reshaped(along_zeta.rows(), along_u.rows());
  return (table * along_u).cwiseProduct(along_zeta).colwise().sum();
}

std::vector<Eigen::VectorXd> RootStressInfluence::components(const std::vector<const RootStressInfluence*>& positions,
                                                             const std::vector<Eigen::VectorXd>& forces) {
  struct Use {
    std::size_t position;
    Eigen::Index first_station;
    Eigen::VectorXd of_table;  ///< forces
  };
  std::vector<Eigen::VectorXd> result;
  std::vector<std::pair<const Eigen::MatrixXd*, std::vector<Use>>> tables;  // in the order in which they come up
  for (std::size_t p = 0; p < positions.size(); ++p) {
    result.push_back(Eigen::VectorXd::Zero(3 * std::ssize(positions[p]->stations)));
    std::vector<Eigen::VectorXd> of_table;
    for (const Forces& f : positions[p]->forces_) of_table.push_back(f.of_table(forces[p]));
    for (const Response& r : positions[p]->responses_) {
      if (of_table[r.forces].isZero(0.0)) continue;  // a line without load
      auto uses = std::ranges::find(tables, r.table.get(), [](const auto& known) { return known.first; });
      if (uses == tables.end()) uses = tables.insert(tables.end(), {r.table.get(), {}});
      uses->second.push_back({p, r.first_station, of_table[r.forces]});
    }
  }
  for (const auto& [table, uses] : tables) {
    Eigen::MatrixXd columns(table->cols(), std::ssize(uses));
    for (std::size_t k = 0; k < uses.size(); ++k) columns.col(static_cast<Eigen::Index>(k)) = uses[k].of_table;
    const Eigen::MatrixXd stress = wide_product(*table, columns);
    for (std::size_t k = 0; k < uses.size(); ++k) {
      result[uses[k].position].segment(3 * uses[k].first_station, table->rows()) += stress.col(static_cast<Eigen::Index>(k));
    }
  }
  for (std::size_t p = 0; p < positions.size(); ++p) {
    for (const Added& a : positions[p]->added_) {
      const Eigen::VectorXd across = a.stress * forces[p].segment(a.first_point, a.stress.cols());
      result[p].segment(3 * a.first_station, 3 * across.size()).reshaped(3, across.size()) += *a.components * across.asDiagonal();
    }
  }
  return result;
}

Eigen::VectorXd RootStressInfluence::components(const Eigen::VectorXd& forces) const { return components({this}, {forces}).front(); }

Eigen::Matrix3Xd RootStressInfluence::components_of(Eigen::Index station) const {
  Eigen::Matrix3Xd result = Eigen::Matrix3Xd::Zero(3, points_);
  for (const Response& r : responses_) {
    const Eigen::Index row = 3 * (station - r.first_station);
    if (row < 0 || row >= r.table->rows()) continue;
    const Forces& f = forces_[r.forces];
    for (Eigen::Index k = 0; k < 3; ++k) result.row(k).segment(f.begin, f.points()) += f.at_points(r.table->row(row + k));
  }
  for (const Added& a : added_) {
    const Eigen::Index place = station - a.first_station;
    if (place >= 0 && place < a.stress.rows()) result.middleCols(a.first_point, a.stress.cols()) += a.components->col(place) * a.stress.row(place);
  }
  return result;
}

TabulatedRootStress::TabulatedRootStress(const GearPair& pair, GearRootStress pinion, GearRootStress wheel,
                                         std::shared_ptr<const PairRootStress> other_flanks)
    : pair_(pair), gears_{std::move(pinion), std::move(wheel)}, other_flanks_(std::move(other_flanks)) {
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const auto& [table, correction] = gears_[member];
    if (!correction) continue;
    const auto across = std::ssize(table->fillet.zetas);
    Eigen::Matrix3Xd components(3, table->fillet.size());
    for (std::size_t i = 0; i < correction->places().size(); ++i) {
      components.middleCols(static_cast<Eigen::Index>(i) * across, across).colwise() = correction->places()[i].components;
    }
    components_[member] = std::make_shared<const Eigen::Matrix3Xd>(std::move(components));
  }
}

RootStressInfluence TabulatedRootStress::influence(const std::vector<ContactPoint>& points, double axial_offset) const {
  const double per_unit_module = 1.0 / (pair_.data.normal_module * pair_.data.normal_module);
  std::set<int> teeth;
  for (const ContactPoint& point : points) teeth.insert(point.tooth);

  std::vector<RootStation> stations;
  std::vector<RootStressInfluence::Forces> forces;
  std::vector<RootStressInfluence::Response> responses;
  std::vector<RootStressInfluence::Added> added;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const auto& [table, correction] = gears_[member];
    std::map<int, RootStressInfluence::Added> of_pair;  // of the tooth pairs
    const std::size_t first = forces.size();
    std::vector<int> loaded_teeth;  // counted on the gear, one for every new entry of `forces`
    for (std::size_t begin = 0, end = 0; begin < points.size(); begin = end) {
      while (end < points.size() && points[end].tooth == points[begin].tooth) ++end;
      const auto count = static_cast<Eigen::Index>(end - begin);
      RootStressInfluence::Forces on_line{static_cast<Eigen::Index>(begin), Eigen::MatrixXd(std::ssize(table->grid.zetas()), count),
                                          Eigen::MatrixXd(std::ssize(table->grid.us()), count)};
      std::vector<FlankStation> places;
      std::vector<double> lengths;
      for (std::size_t i = begin; i < end; ++i) {
        places.push_back(flank_station(pair_, member, points[i], axial_offset));
        lengths.push_back(points[i].weight / pair_.data.normal_module);
        const StationGrid::Factors factors = table->grid.weight_factors(places.back());
        on_line.along_zeta.col(static_cast<Eigen::Index>(i - begin)) = factors.along_zeta;
        on_line.along_u.col(static_cast<Eigen::Index>(i - begin)) = per_unit_module * factors.along_u;
      }
      if (correction) {
        of_pair[points[begin].tooth] = {0, static_cast<Eigen::Index>(begin),
                                        per_unit_module * correction->added(table->fillet, places, lengths, std::cos(pair_.base_helix_angle)),
                                        components_[member]};
      }
      loaded_teeth.push_back(gear_tooth(member, points[begin].tooth));
      forces.push_back(std::move(on_line));
    }
    for (const int tooth : teeth) {
      for (std::size_t k = 0; k < loaded_teeth.size(); ++k) {
        const Eigen::MatrixXd* response = table->response(gear_tooth(member, tooth), loaded_teeth[k]);
        if (response) responses.push_back({std::ssize(stations), first + k, {table, response}});
      }
      if (correction) {
        RootStressInfluence::Added& own = of_pair.at(tooth);
        own.first_station = std::ssize(stations);
        added.push_back(std::move(own));
      }
      for (std::size_t i = 0; i < table->fillet.along.size(); ++i) {
        for (const double zeta : table->fillet.zetas) {
          stations.push_back({member, tooth, table->fillet.along[i], axial_position(pair_, member, zeta, axial_offset), i == table->fillet.tangent});
        }
      }
    }
  }
  return {std::move(stations), std::ssize(points), std::move(forces), std::move(responses), std::move(added)};
}

}  // namespace flankwright
