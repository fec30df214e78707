#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <unordered_map>
#include <utility>
#include <vector>

#include "core/compliance/finite_element/section.hpp"

namespace flankwright {

/// Collects quads; points that fall together become one node.
class SectionBuilder {
 public:
  /// @param tolerance  points less than this apart are one node [mm]
  explicit SectionBuilder(double tolerance) : cell_(tolerance) {}

  int node(const Eigen::Vector2d& p) {
    const auto i = std::llround(p.x() / cell_), j = std::llround(p.y() / cell_);
    for (auto a = i - 1; a <= i + 1; ++a) {
      for (auto b = j - 1; b <= j + 1; ++b) {
        const auto found = places_.find(key(a, b));
        if (found != places_.end() && (points_[found->second] - p).norm() < cell_) return found->second;
      }
    }
    const auto number = static_cast<int>(points_.size());
    points_.push_back(p);
    places_.emplace(key(i, j), number);
    return number;
  }

  /// A grid of quads from points at half steps; the corner (i, j), (i + 1, j), (i + 1, j + 1) must turn
  /// counter-clockwise. `at(i, j)`: i = 0 .. 2 columns, j = 0 .. 2 rows.
  template <typename At>
  void grid(int columns, int rows, SectionPart part, At&& at) {
    for (int i = 0; i < 2 * columns; i += 2) {
      for (int j = 0; j < 2 * rows; j += 2) {
        quads_.push_back({node(at(i, j)), node(at(i + 2, j)), node(at(i + 2, j + 2)), node(at(i, j + 2)), node(at(i + 1, j)), node(at(i + 2, j + 1)),
                          node(at(i + 1, j + 2)), node(at(i, j + 1))});
        parts_.push_back(part);
      }
    }
  }

  SectionMesh take(std::vector<SectionTooth> teeth) {
    SectionMesh mesh;
    mesh.nodes.resize(2, static_cast<Eigen::Index>(points_.size()));
    for (std::size_t i = 0; i < points_.size(); ++i) mesh.nodes.col(static_cast<Eigen::Index>(i)) = points_[i];
    mesh.quads.resize(8, static_cast<Eigen::Index>(quads_.size()));
    for (std::size_t i = 0; i < quads_.size(); ++i) {
      for (int k = 0; k < 8; ++k) mesh.quads(k, static_cast<Eigen::Index>(i)) = quads_[i][k];
    }
    mesh.parts = std::move(parts_);
    mesh.teeth = std::move(teeth);
    return mesh;
  }

 private:
  static std::uint64_t key(long long i, long long j) { return (static_cast<std::uint64_t>(i) << 32) ^ (static_cast<std::uint64_t>(j) & 0xffffffffU); }
  double cell_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<std::array<int, 8>> quads_;
  std::vector<SectionPart> parts_;
  std::unordered_map<std::uint64_t, int> places_;
};

}  // namespace flankwright
