#include "core/compliance/finite_element/solid_model.hpp"

#include <algorithm>
#include <cassert>
#include <string>
#include <utility>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

/// Nodes that share a brick with each node and have no smaller number, ascending.
struct NodeGraph {
  std::vector<int> starts, neighbours;
};

NodeGraph node_graph(const SolidMesh& mesh) {
  const Eigen::Index n = mesh.nodes.cols();
  std::vector<std::vector<int>> lists(static_cast<std::size_t>(n));
  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    for (int i = 0; i < 20; ++i) {
      for (int j = 0; j < 20; ++j) {
        if (mesh.bricks(j, e) >= mesh.bricks(i, e)) lists[mesh.bricks(i, e)].push_back(mesh.bricks(j, e));
      }
    }
  }
  NodeGraph graph;
  graph.starts.push_back(0);
  for (auto& list : lists) {
    std::sort(list.begin(), list.end());
    list.erase(std::unique(list.begin(), list.end()), list.end());
    graph.neighbours.insert(graph.neighbours.end(), list.begin(), list.end());
    graph.starts.push_back(static_cast<int>(graph.neighbours.size()));
    std::vector<int>().swap(list);
  }
  return graph;
}

void check(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports) {
  if (!(material.youngs_modulus > 0)) {
    throw InvalidInput("material.youngs_modulus", std::to_string(material.youngs_modulus), "more than 0 MPa");
  }
  if (!(material.poissons_ratio >= 0 && material.poissons_ratio < 0.5)) {
    throw InvalidInput("material.poissons_ratio", std::to_string(material.poissons_ratio), "0 <= nu < 0.5");
  }
  const auto n = static_cast<int>(mesh.nodes.cols());
  std::vector<char> used(static_cast<std::size_t>(n), 0);
  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    for (int i = 0; i < 20; ++i) {
      const int node = mesh.bricks(i, e);
      if (node < 0 || node >= n) {
        throw InvalidInput("mesh.bricks", std::to_string(node), "node numbers below " + std::to_string(n));
      }
      used[node] = 1;
    }
    if (!(brick_quality(mesh.brick_nodes(e)) > 0)) {
      throw InvalidInput("mesh.bricks", "number " + std::to_string(e) + " is folded", "a positive Jacobian");
    }
  }
  const auto alone = std::find(used.begin(), used.end(), 0);
  if (alone != used.end()) {
    throw InvalidInput("mesh.nodes", "number " + std::to_string(alone - used.begin()) + " is in no brick",
                       "nodes that belong to a brick");
  }
  for (const NodeSupport& support : supports) {
    if (support.node < 0 || support.node >= n) {
      throw InvalidInput("supports", std::to_string(support.node), "node numbers below " + std::to_string(n));
    }
  }
}

}  // namespace

BrickNodes SolidMesh::brick_nodes(Eigen::Index brick) const {
  BrickNodes result;
  for (int i = 0; i < 20; ++i) result.col(i) = nodes.col(bricks(i, brick));
  return result;
}

double SolidMesh::quality() const {
  double worst = 1;
  for (Eigen::Index e = 0; e < bricks.cols(); ++e) worst = std::min(worst, brick_quality(brick_nodes(e)));
  return worst;
}

struct SolidModel::Assembled {
  Eigen::SparseMatrix<double> lower;
  Eigen::SparseMatrix<double> motion;
  Eigen::VectorXi node_of;

  Assembled(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports) {
    check(mesh, material, supports);
    const Eigen::Index n = mesh.nodes.cols();
    std::vector<char> fixed(static_cast<std::size_t>(3 * n), 0);
    std::vector<int> turn(static_cast<std::size_t>(n), -1);
    for (const NodeSupport& support : supports) {
      for (int a = 0; a < 3; ++a) fixed[3 * support.node + a] = support.fixed[a];
      if (!support.frame.isIdentity(0)) {
        turn[support.node] = static_cast<int>(turned_.size());
        turned_.push_back(support);
      }
    }
    std::vector<int> number(static_cast<std::size_t>(3 * n), -1);
    const auto count = static_cast<Eigen::Index>(std::count(fixed.begin(), fixed.end(), 0));
    node_of.resize(count);
    motion.resize(3 * n, count);
    motion.reserve(Eigen::VectorXi::Constant(count, 3));
    for (int row = 0, next = 0; row < 3 * n; ++row) {
      if (fixed[row]) continue;
      const int node = row / 3, t = turn[node];
      node_of[next] = node;
      number[row] = next;
      if (t < 0) {
        motion.insert(row, next) = 1.0;
      } else {
        for (int a = 0; a < 3; ++a) motion.insert(3 * node + a, next) = turned_[t].frame(a, row % 3);
      }
      ++next;
    }
    motion.makeCompressed();

    lower.resize(count, count);
    lay_out(node_graph(mesh), number, n);
    fill(mesh, material, number, turn);
  }

 private:
  std::vector<NodeSupport> turned_;  ///< supports whose frame is not the axes

  /// Pattern of `lower`, values 0.
  void lay_out(const NodeGraph& graph, const std::vector<int>& number, Eigen::Index n) {
    Eigen::VectorXi counts(lower.cols());
    std::vector<int> rows;
    const auto below = [&](int node) {
      rows.clear();
      for (int k = graph.starts[node]; k < graph.starts[node + 1]; ++k) {
        for (int a = 0; a < 3; ++a) {
          const int row = number[3 * graph.neighbours[k] + a];
          if (row >= 0) rows.push_back(row);
        }
      }
    };
    for (int node = 0; node < n; ++node) {
      below(node);
      for (int a = 0, column = 0; a < 3; ++a) {
        if (number[3 * node + a] < 0) continue;
        counts[number[3 * node + a]] = static_cast<int>(rows.size()) - column++;
      }
    }
    lower.resizeNonZeros(counts.sum());
    int* outer = lower.outerIndexPtr();
    outer[0] = 0;
    for (Eigen::Index i = 0; i < counts.size(); ++i) outer[i + 1] = outer[i] + counts[i];
    for (int node = 0; node < n; ++node) {
      below(node);
      for (int a = 0, column = 0; a < 3; ++a) {
        const int c = number[3 * node + a];
        if (c < 0) continue;
        std::copy(rows.begin() + column++, rows.end(), lower.innerIndexPtr() + outer[c]);
      }
    }
    std::fill_n(lower.valuePtr(), lower.nonZeros(), 0.0);
  }

  void fill(const SolidMesh& mesh, const Material& material, const std::vector<int>& number,
            const std::vector<int>& turn) {
    const int* outer = lower.outerIndexPtr();
    const int* inner = lower.innerIndexPtr();
    for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
      Eigen::Matrix<double, 60, 60> stiffness = brick_stiffness(mesh.brick_nodes(e), material);
      for (int i = 0; i < 20; ++i) {
        const int t = turn[mesh.bricks(i, e)];
        if (t < 0) continue;
        stiffness.middleRows<3>(3 * i) = (turned_[t].frame.transpose() * stiffness.middleRows<3>(3 * i)).eval();
        stiffness.middleCols<3>(3 * i) = (stiffness.middleCols<3>(3 * i) * turned_[t].frame).eval();
      }
      for (int j = 0; j < 60; ++j) {
        const int column = number[3 * mesh.bricks(j / 3, e) + j % 3];
        if (column < 0) continue;
        for (int i = 0; i < 60; ++i) {
          const int row = number[3 * mesh.bricks(i / 3, e) + i % 3];
          if (row < column) continue;
          const int* place = std::lower_bound(inner + outer[column], inner + outer[column + 1], row);
          lower.valuePtr()[place - inner] += stiffness(i, j);
        }
      }
    }
  }
};

SolidModel::SolidModel(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports)
    : SolidModel(Assembled(mesh, material, supports)) {}

SolidModel::SolidModel(Assembled&& assembled)
    : motion_(std::move(assembled.motion)), factor_(assembled.lower, assembled.node_of) {}

Eigen::MatrixXd SolidModel::solve(const Eigen::SparseMatrix<double>& loads) const {
  assert(loads.rows() == motion_.rows());
  return motion_ * factor_.solve(motion_.transpose() * loads);
}

Eigen::MatrixXd SolidModel::influence(const Eigen::SparseMatrix<double>& loads) const {
  assert(loads.rows() == motion_.rows());
  return factor_.gram(motion_.transpose() * loads);
}

}  // namespace flankwright
