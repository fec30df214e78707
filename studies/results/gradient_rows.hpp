#pragma once

#include <Eigen/Core>
#include <vector>

#include "studies/base/json_format.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// Derivatives by internal units of the parameters become those by the units that a study file gives them in.
class GradientRows {
 public:
  explicit GradientRows(const std::vector<GradientParameter>& parameters) : units_(std::ssize(parameters)) {
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      units_[static_cast<Eigen::Index>(i)] = parameters[i].unit_size;
      parameters_.push_back(parameters[i].parameter);
    }
  }

  const std::vector<MeshParameter>& parameters() const { return parameters_; }

  /// @param per_unit  internal units of the output in one of its key's
  Json row(const Eigen::RowVectorXd& derivative, double per_unit = 1.0) const {
    if (derivative.size() == 0) return nullptr;
    return Json(Eigen::RowVectorXd(derivative.cwiseProduct(units_) / per_unit));
  }
  Json rows(const Eigen::MatrixXd& derivatives, double per_unit = 1.0) const {
    Json all = Json::array();
    for (Eigen::Index i = 0; i < derivatives.rows(); ++i) all.push_back(row(derivatives.row(i), per_unit));
    return all;
  }

 private:
  Eigen::RowVectorXd units_;
  std::vector<MeshParameter> parameters_;
};

}  // namespace flankwright::studies
