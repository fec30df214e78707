#include "core/compliance/finite_element/rim_motion.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <cassert>
#include <map>

namespace flankwright {
namespace {

using RigidMotion = Eigen::Matrix<double, 6, 3>;

/// u = rigid_motion(x)' (t, omega).
RigidMotion rigid_motion(const Eigen::Vector3d& x) {
  RigidMotion rigid;
  rigid << Eigen::Matrix3d::Identity(), Eigen::Matrix3d{{0, -x.z(), x.y()}, {x.z(), 0, -x.x()}, {-x.y(), x.x(), 0}};
  return rigid;
}

/// Collects a least-squares fit over the volume of bricks.
class MotionFit {
 public:
  void add(const GearMesh& mesh, int brick) {
    const BrickNodes nodes = mesh.solid.brick_nodes(brick);
    for (int i = 0; i < 27; ++i) {
      const int a = i % 3, b = i / 3 % 3, c = i / 9;
      const BrickShape shape = brick_shape({gauss3_abscissae[a], gauss3_abscissae[b], gauss3_abscissae[c]});
      const Eigen::Matrix3d jacobian = nodes * shape.derivatives;
      const double volume = gauss3_weights[a] * gauss3_weights[b] * gauss3_weights[c] * jacobian.determinant();
      const RigidMotion rigid = rigid_motion(nodes * shape.values);
      normal_ += volume * rigid * rigid.transpose();
      for (int k = 0; k < 20; ++k) {
        nodal_.try_emplace(mesh.solid.bricks(k, brick), RigidMotion::Zero()).first->second += volume * shape.values[k] * rigid;
      }
    }
  }

  /// Columns first .. first + 5.
  void write(int first, std::vector<Eigen::Triplet<double>>& entries) const {
    const Eigen::LDLT<Eigen::Matrix<double, 6, 6>> normal(normal_);
    for (const auto& [node, weights] : nodal_) {
      const RigidMotion solved = normal.solve(weights);
      for (int row = 0; row < 6; ++row) {
        for (int axis = 0; axis < 3; ++axis) entries.emplace_back(3 * node + axis, first + row, solved(row, axis));
      }
    }
  }

 private:
  Eigen::Matrix<double, 6, 6> normal_{Eigen::Matrix<double, 6, 6>::Zero()};
  std::map<int, RigidMotion> nodal_;
};

}  // namespace

Eigen::SparseMatrix<double> rim_functionals(const GearMesh& mesh) {
  MotionFit below, whole;
  for (const RimBrick& of_rim : mesh.rim) {
    whole.add(mesh, of_rim.brick);
    if (of_rim.tooth == 0) below.add(mesh, of_rim.brick);
  }
  std::vector<Eigen::Triplet<double>> entries;
  below.write(0, entries);
  whole.write(6, entries);
  Eigen::SparseMatrix<double> functionals(mesh.solid.nodes.size(), 12);
  functionals.setFromTriplets(entries.begin(), entries.end());
  return functionals;
}

RimMotionTable rim_motion_table(const GearMesh& mesh, const StationGrid& grid, const Eigen::MatrixXd& motions) {
  const Eigen::Index n = grid.size();
  assert(motions.rows() == 12 && motions.cols() == (2 * mesh.teeth_each_side + 1) * n);
  const double module = mesh.normal_module;
  Eigen::Vector<double, 6> scale;
  scale << Eigen::Vector3d::Constant(module), Eigen::Vector3d::Constant(module * module);
  RimMotionTable table{grid, scale.asDiagonal() * motions.block(6, mesh.teeth_each_side * n, 6, n), {}};
  for (Eigen::Index begin = 0; begin < motions.cols(); begin += n) table.below.push_back(scale.asDiagonal() * motions.block(0, begin, 6, n));
  return table;
}

}  // namespace flankwright
