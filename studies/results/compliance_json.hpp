#pragma once

#include "core/compliance/fitted/kernel_form.hpp"
#include "core/compliance/model/gear_structures.hpp"
#include "core/compliance/comparison/gear_deflections.hpp"
#include "studies/base/json_format.hpp"
#include "studies/study/study.hpp"

namespace flankwright::studies {

/// The section `compliance` of results.json: what the finite elements of both gears are and took.
Json compliance_json(const GearStructures& structures, const Study& study);

/// The motion of the shaft that is taken out of influence values, in words.
const char* name_of(RemovedRigidMotion removed);

/// Coefficients of a fit by name, and the lower triangle of their covariance, row by row.
Json covariance_json(const KernelForm& form, const std::vector<double>& coefficients, const Eigen::MatrixXd& covariance);

/// One curve of deflections[] or fit[].
Json curve_json(const DeflectionCurve& curve);

/// One entry of deflections[] of results.json.
Json deflections_json(const GearDeflections& deflections);

}  // namespace flankwright::studies
