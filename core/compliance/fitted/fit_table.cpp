#include "core/compliance/fitted/fitted_compliance.hpp"

namespace flankwright {
namespace {

void add(FitTable& table, const std::string& name, double value) {
  table.names.push_back(name);
  table.values.push_back(value);
}

void add(FitTable& table, const std::string& name, const EndPolynomial& polynomial) {
  add(table, name + ".middle", polynomial.middle);
  for (std::size_t k = 0; k < polynomial.end.size(); ++k) add(table, name + ".end_" + std::to_string(k), polynomial.end[k]);
}

void add(FitTable& table, const KernelForm& form) {
  add(table, "form.kernels", static_cast<double>(form.kernels.size()));
  for (std::size_t k = 0; k < form.kernels.size(); ++k) {
    const std::string name = "form.kernel_" + std::to_string(k);
    const Kernel& kernel = form.kernels[k];
    add(table, name + ".smoothness", static_cast<int>(kernel.smoothness));
    add(table, name + ".reach", static_cast<int>(kernel.reach));
    add(table, name + ".amplitude", kernel.amplitude);
    add(table, name + ".axial", kernel.axial);
    add(table, name + ".radial", kernel.radial);
  }
  add(table, "form.wind_up", form.torsion ? 1.0 : 0.0);
  add(table, "form.bodies", static_cast<double>(form.bodies.size()));
  for (std::size_t k = 0; k < form.bodies.size(); ++k) {
    const std::string name = "form.body_" + std::to_string(k);
    add(table, name + ".functions", form.bodies[k].functions);
    add(table, name + ".coupling", static_cast<int>(form.bodies[k].coupling));
  }
}

void add(FitTable& table, const FitRecord& record, const std::vector<std::string>& coefficient_names) {
  add(table, "range.u_min", record.range.u_min);
  add(table, "range.u_max", record.range.u_max);
  add(table, "range.zeta_min", record.range.zeta_min);
  add(table, "range.zeta_max", record.range.zeta_max);
  add(table, "range.teeth_apart", record.range.teeth_apart);
  add(table, "residuals", static_cast<double>(record.residuals.size()));
  for (std::size_t i = 0; i < record.residuals.size(); ++i) {
    const std::string name = "residual_" + std::to_string(i);
    const ResidualStatistics& residual = record.residuals[i];
    add(table, name + ".teeth_apart", residual.teeth_apart);
    add(table, name + ".pairs", residual.pairs);
    add(table, name + ".median", residual.median);
    add(table, name + ".share_95", residual.share_95);
    add(table, name + ".worst", residual.worst);
  }
  add(table, "standard_errors", static_cast<double>(record.standard_errors.size()));
  for (std::size_t i = 0; i < record.standard_errors.size(); ++i) {
    add(table, "standard_error." + coefficient_names[i], record.standard_errors[i]);
  }
}

}  // namespace

FitTable FittedCompliance::to_table() const {
  FitTable table;
  add(table, form_);
  add(table, "gear.teeth", gear_.teeth);
  add(table, "gear.helix_angle", gear_.helix_angle);
  add(table, "gear.relative_face", gear_.relative_face);
  add(table, "gear.profile_shift", gear_.profile_shift);
  const std::vector<std::string> names = form_.coefficient_names();
  for (std::size_t i = 0; i < names.size(); ++i) add(table, "coefficient." + names[i], coefficients_[i]);
  add(table, record_, names);
  return table;
}

}  // namespace flankwright
