#include "core/compliance/finite_element/solid_model.hpp"

#include <algorithm>
#include <cassert>
#include <map>
#include <ranges>
#include <string>
#include <utility>

#include "core/base/error.hpp"
#include "core/base/taken.hpp"
#include "core/base/wide_sum.hpp"

namespace flankwright {
namespace {

/// For every node its index among the tied nodes, or -1.
std::vector<int> indices_of_ties(const SolidMesh& mesh) {
  std::vector<int> indices(static_cast<std::size_t>(mesh.nodes.cols()), -1);
  for (std::size_t i = 0; i < mesh.tied.size(); ++i) indices[static_cast<std::size_t>(mesh.tied[i].node)] = static_cast<int>(i);
  return indices;
}

/// Nodes that decide how a brick moves, and by how much each moves the brick's own.
struct BrickMotion {
  std::vector<int> nodes;
  Eigen::MatrixXd weights;  ///< 20 x nodes; empty where the nodes are the brick's own, in its order

  BrickMotion(const SolidMesh& mesh, const std::vector<int>& ties, Eigen::Index brick) {
    const auto own = mesh.bricks.col(brick);
    nodes.assign(own.begin(), own.end());
    if (std::ranges::all_of(nodes, [&](int node) { return ties[node] < 0; })) return;
    std::map<int, Eigen::Vector<double, 20>> columns;
    for (int i = 0; i < 20; ++i) {
      const auto add = [&](int node, double weight) { columns.try_emplace(node, Eigen::Vector<double, 20>::Zero()).first->second[i] += weight; };
      if (ties[own[i]] < 0) {
        add(own[i], 1);
      } else {
        for (const auto& [node, weight] : mesh.tied[static_cast<std::size_t>(ties[own[i]])].follows) add(node, weight);
      }
    }
    nodes.clear();
    weights.resize(20, std::ssize(columns));
    for (const auto& [node, column] : columns) {
      weights.col(std::ssize(nodes)) = column;
      nodes.push_back(node);
    }
  }

  /// 3k x 3k, from 60 x 60.
  Eigen::MatrixXd reduce(const Eigen::Matrix<double, 60, 60>& stiffness) const {
    if (weights.size() == 0) return stiffness;
    Eigen::MatrixXd moves = Eigen::MatrixXd::Zero(60, 3 * weights.cols());
    for (Eigen::Index k = 0; k < weights.cols(); ++k) {
      for (int i = 0; i < 20; ++i) moves.block<3, 3>(3 * i, 3 * k).diagonal().setConstant(weights(i, k));
    }
    return wide_product(moves.transpose(), wide_product(stiffness, moves));
  }
};

/// Nodes that act in a brick with each node and have no smaller number, ascending.
struct NodeGraph {
  std::vector<int> starts, neighbours;
};

NodeGraph node_graph(const SolidMesh& mesh, const std::vector<int>& ties) {
  const Eigen::Index n = mesh.nodes.cols();
  std::vector<std::vector<int>> lists(static_cast<std::size_t>(n));
  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    const std::vector<int> nodes = BrickMotion(mesh, ties, e).nodes;
    for (const int i : nodes) {
      for (const int j : nodes) {
        if (j >= i) lists[static_cast<std::size_t>(i)].push_back(j);
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
  check_elastic(material);
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
    throw InvalidInput("mesh.nodes", "number " + std::to_string(alone - used.begin()) + " is in no brick", "nodes that belong to a brick");
  }
  const auto is_too_soft = [](double factor) { return !(factor > 0); };
  if (!mesh.stiffness.empty() && (std::ssize(mesh.stiffness) != mesh.bricks.cols() || std::ranges::any_of(mesh.stiffness, is_too_soft))) {
    throw InvalidInput("mesh.stiffness", std::to_string(mesh.stiffness.size()) + " factors", "none, or one above 0 for every brick");
  }
  std::vector<char> tied(static_cast<std::size_t>(n), 0);
  for (const TiedNode& tie : mesh.tied) {
    if (tie.node < 0 || tie.node >= n) throw InvalidInput("mesh.tied", std::to_string(tie.node), "node numbers below " + std::to_string(n));
    tied[static_cast<std::size_t>(tie.node)] = 1;
  }
  const auto is_free = [&](int node) { return node >= 0 && node < n && !tied[static_cast<std::size_t>(node)]; };
  for (const TiedNode& tie : mesh.tied) {
    for (const auto& [node, weight] : tie.follows) {
      if (!is_free(node)) throw InvalidInput("mesh.tied", std::to_string(node), "to follow nodes of the mesh that are not tied");
    }
  }
  for (const NodeSupport& support : supports) {
    if (!is_free(support.node)) throw InvalidInput("supports", std::to_string(support.node), "nodes of the mesh that are not tied");
  }
}

/// Fills a stiffness.
class Assembly {
 public:
  Assembly(SolidStiffness& stiffness, const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports)
      : lower_(stiffness.lower) {
    Eigen::SparseMatrix<double>& motion = stiffness.motion;
    Eigen::VectorXi& node_of = stiffness.node_of;
    const Eigen::Index n = mesh.nodes.cols();
    const std::vector<int> ties = indices_of_ties(mesh);
    std::vector<char> fixed(static_cast<std::size_t>(3 * n), 0);
    for (const TiedNode& tie : mesh.tied) std::fill_n(fixed.begin() + 3 * tie.node, 3, 1);
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
    for (int row = 0, next = 0; row < 3 * n; ++row) {
      if (fixed[row]) continue;
      node_of[next] = row / 3;
      number[row] = next++;
    }
    std::vector<Eigen::Triplet<double>> moves;
    const auto add = [&](int node, int other, double weight) {  // how `node` moves by the unknowns of `other`
      for (int axis = 0; axis < 3; ++axis) {
        const int column = number[3 * other + axis], t = turn[other];
        if (column < 0) continue;
        if (t < 0) {
          moves.emplace_back(3 * node + axis, column, weight);
        } else {
          for (int a = 0; a < 3; ++a) moves.emplace_back(3 * node + a, column, weight * turned_[t].frame(a, axis));
        }
      }
    };
    for (int node = 0; node < n; ++node) {
      if (ties[node] < 0) {
        add(node, node, 1);
      } else {
        for (const auto& [other, weight] : mesh.tied[static_cast<std::size_t>(ties[node])].follows) add(node, other, weight);
      }
    }
    motion.resize(3 * n, count);
    motion.setFromTriplets(moves.begin(), moves.end());

    lower_.resize(count, count);
    lay_out(node_graph(mesh, ties), number, n);
    fill(mesh, material, ties, number, turn);
  }

 private:
  Eigen::SparseMatrix<double>& lower_;
  std::vector<NodeSupport> turned_;  ///< supports whose frame is not the axes

  /// Pattern of `lower`, values 0.
  void lay_out(const NodeGraph& graph, const std::vector<int>& number, Eigen::Index n) {
    Eigen::VectorXi counts(lower_.cols());
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
    lower_.resizeNonZeros(counts.sum());
    int* outer = lower_.outerIndexPtr();
    outer[0] = 0;
    for (Eigen::Index i = 0; i < counts.size(); ++i) outer[i + 1] = outer[i] + counts[i];
    for (int node = 0; node < n; ++node) {
      below(node);
      for (int a = 0, column = 0; a < 3; ++a) {
        const int c = number[3 * node + a];
        if (c < 0) continue;
        std::copy(rows.begin() + column++, rows.end(), lower_.innerIndexPtr() + outer[c]);
      }
    }
    std::fill_n(lower_.valuePtr(), lower_.nonZeros(), 0.0);
  }

  void fill(const SolidMesh& mesh, const Material& material, const std::vector<int>& ties, const std::vector<int>& number,
            const std::vector<int>& turn) {
    for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
      const BrickMotion brick(mesh, ties, e);
      const std::vector<int>& nodes = brick.nodes;
      Eigen::MatrixXd stiffness = brick.reduce(brick_stiffness(mesh.brick_nodes(e), material));
      if (!mesh.stiffness.empty()) stiffness *= mesh.stiffness[static_cast<std::size_t>(e)];
      for (int i = 0; i < std::ssize(nodes); ++i) {
        const int t = turn[nodes[i]];
        if (t < 0) continue;
        stiffness.middleRows<3>(3 * i) = (turned_[t].frame.transpose() * stiffness.middleRows<3>(3 * i)).eval();
        stiffness.middleCols<3>(3 * i) = (stiffness.middleCols<3>(3 * i) * turned_[t].frame).eval();
      }
      for (std::size_t j = 0; j < nodes.size(); ++j) {
        for (std::size_t i = 0; i < nodes.size(); ++i) {
          if (nodes[i] >= nodes[j])
            add_block(nodes[i], nodes[j], stiffness.block<3, 3>(3 * static_cast<Eigen::Index>(i), 3 * static_cast<Eigen::Index>(j)), number);
        }
      }
    }
  }

  /// The unknowns of a node have consecutive numbers, in rows as in columns. The rows of a node's second and third column begin one and two later, on the diagonal.
  /// @param of, by  nodes, of >= by
  /// @param block   of the stiffness, rows of one and columns of the other
  void add_block(int of, int by, const Eigen::Matrix3d& block, const std::vector<int>& number) {
    const int* const outer = lower_.outerIndexPtr();
    const int* const inner = lower_.innerIndexPtr();
    std::ptrdiff_t first = -1;  // entry of the first row of `of` in the first column of `by`
    for (int b = 0, columns = 0; b < 3; ++b) {
      const int column = number[3 * by + b];
      if (column < 0) continue;
      for (int a = 0, rows = 0; a < 3; ++a) {
        const int row = number[3 * of + a];
        if (row < 0) continue;
        if (first < 0) first = std::lower_bound(inner + outer[column], inner + outer[column + 1], row) - (inner + outer[column]);
        if (row >= column) lower_.valuePtr()[outer[column] + first + rows - columns] += block(a, b);
        ++rows;
      }
      ++columns;
    }
  }
};

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

SolidStiffness::SolidStiffness(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports) {
  check(mesh, material, supports);
  Assembly(*this, mesh, material, supports);
}

SolidModel::SolidModel(const SolidMesh& mesh, const Material& material, const std::vector<NodeSupport>& supports)
    : SolidModel(SolidStiffness(mesh, material, supports)) {}

SolidModel::SolidModel(SolidStiffness&& stiffness) : motion_(taken(stiffness.motion)), factor_(stiffness.lower, stiffness.node_of) {}

Eigen::MatrixXd SolidModel::solve(const Eigen::SparseMatrix<double>& loads) const {
  assert(loads.rows() == motion_.rows());
  return motion_ * factor_.solve(motion_.transpose() * loads);
}

Eigen::MatrixXd SolidModel::influence(const Eigen::SparseMatrix<double>& loads) const {
  assert(loads.rows() == motion_.rows());
  return factor_.gram(motion_.transpose() * loads);
}

MultifrontalGram influence_at_once(SolidStiffness&& stiffness, Eigen::SparseMatrix<double>&& loads, double memory_limit,
                                   const EliminationProgress& progress, const ForEachIndex& for_each, EliminationOrder order) {
  assert(loads.rows() == stiffness.motion.rows());
  const Eigen::SparseMatrix<double, Eigen::RowMajor> by_unknowns = taken(stiffness.motion).transpose() * taken(loads);
  return multifrontal_gram(taken(stiffness.lower), stiffness.node_of, by_unknowns, memory_limit, progress, for_each, std::move(order));
}

}  // namespace flankwright
