#include <cmath>
#include <map>
#include <utility>

#include "core/base/error.hpp"
#include "core/compliance/fitted/fitted_compliance.hpp"

namespace flankwright {
namespace {

/// Writes every number of a fit under its name, or reads it: one description of the table serves both ways.
class Writer {
 public:
  void operator()(const std::string& name, const double& value) {
    table.names.push_back(name);
    table.values.push_back(value);
  }
  void operator()(const std::string& name, const int& value) { (*this)(name, static_cast<double>(value)); }
  void operator()(const std::string& name, const bool& value) { (*this)(name, value ? 1.0 : 0.0); }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const std::string& name, const Enum& value, int) { (*this)(name, static_cast<int>(value)); }
  template <class List>
  void resize(const std::string& name, const List& list, int) {
    (*this)(name, static_cast<int>(list.size()));
  }

  FitTable table;
};

class Reader {
 public:
  explicit Reader(const FitTable& table) {
    if (table.names.size() != table.values.size()) {
      throw InvalidInput("fit table", std::to_string(table.values.size()) + " values",
                         "one for each of " + std::to_string(table.names.size()) + " names");
    }
    for (std::size_t i = 0; i < table.names.size(); ++i) {
      if (!entries_.emplace(table.names[i], table.values[i]).second) {
        throw InvalidInput(table.names[i], "given twice", "once");
      }
    }
  }

  void operator()(const std::string& name, double& value) {
    const auto entry = entries_.find(name);
    if (entry == entries_.end()) throw InvalidInput(name, "missing", "a number");
    value = entry->second;
    entries_.erase(entry);
  }
  void operator()(const std::string& name, int& value) { value = whole(name, -1'000'000, 1'000'000); }
  void operator()(const std::string& name, bool& value) { value = whole(name, 0, 1) == 1; }
  template <class Enum>
  requires std::is_enum_v<Enum>
  void operator()(const std::string& name, Enum& value, int count) { value = static_cast<Enum>(whole(name, 0, count - 1)); }
  template <class List>
  void resize(const std::string& name, List& list, int most) {
    list.resize(static_cast<std::size_t>(whole(name, 0, most)));
  }
  void finish() const {
    if (!entries_.empty()) throw InvalidInput(entries_.begin()->first, "given", "no such entry in this form");
  }

 private:
  int whole(const std::string& name, int least, int most) {
    double value = 0;
    (*this)(name, value);
    if (!(value >= least && value <= most) || value != std::floor(value)) {
      throw InvalidInput(name, std::to_string(value), "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    }
    return static_cast<int>(value);
  }

  std::map<std::string, double> entries_;
};

template <class Visitor, class Form>
void visit_form(Visitor& visit, Form& form) {
  const auto polynomial = [&visit](const std::string& name, auto& powers) {
    visit(name + ".middle", powers.middle);
    for (std::size_t k = 0; k < powers.end.size(); ++k) visit(name + ".end_" + std::to_string(k), powers.end[k]);
  };
  visit.resize("form.kernels", form.kernels, 20);
  for (std::size_t k = 0; k < form.kernels.size(); ++k) {
    const std::string name = "form.kernel_" + std::to_string(k);
    auto& kernel = form.kernels[k];
    visit(name + ".smoothness", kernel.smoothness, 2);
    visit(name + ".reach", kernel.reach, 3);
    polynomial(name + ".amplitude", kernel.amplitude);
    polynomial(name + ".axial", kernel.axial);
    polynomial(name + ".radial", kernel.radial);
  }
  visit("form.wind_up", form.torsion);
  visit.resize("form.bodies", form.bodies, 20);
  for (std::size_t k = 0; k < form.bodies.size(); ++k) {
    const std::string name = "form.body_" + std::to_string(k);
    visit(name + ".functions", form.bodies[k].functions);
    visit(name + ".coupling", form.bodies[k].coupling, 3);
  }
}

template <class Visitor, class Gear>
void visit_gear(Visitor& visit, Gear& gear) {
  visit("gear.teeth", gear.teeth);
  visit("gear.helix_angle", gear.helix_angle);
  visit("gear.relative_face", gear.relative_face);
  visit("gear.profile_shift", gear.profile_shift);
}

template <class Visitor, class Record>
void visit_record(Visitor& visit, Record& record, const std::vector<std::string>& coefficient_names) {
  visit("range.u_min", record.range.u_min);
  visit("range.u_max", record.range.u_max);
  visit("range.zeta_min", record.range.zeta_min);
  visit("range.zeta_max", record.range.zeta_max);
  visit("range.teeth_apart", record.range.teeth_apart);
  visit.resize("residuals", record.residuals, 1000);
  for (std::size_t i = 0; i < record.residuals.size(); ++i) {
    const std::string name = "residual_" + std::to_string(i);
    auto& residual = record.residuals[i];
    visit(name + ".teeth_apart", residual.teeth_apart);
    visit(name + ".pairs", residual.pairs);
    visit(name + ".median", residual.median);
    visit(name + ".share_95", residual.share_95);
    visit(name + ".worst", residual.worst);
  }
  visit.resize("standard_errors", record.standard_errors, static_cast<int>(coefficient_names.size()));
  if (record.standard_errors.empty()) return;
  if (record.standard_errors.size() != coefficient_names.size()) {
    throw InvalidInput("standard_errors", std::to_string(record.standard_errors.size()), "0 or " + std::to_string(coefficient_names.size()));
  }
  for (std::size_t i = 0; i < coefficient_names.size(); ++i) {
    visit("standard_error." + coefficient_names[i], record.standard_errors[i]);
  }
}

}  // namespace

FitTable FittedCompliance::to_table() const {
  Writer write;
  visit_form(write, form_);
  visit_gear(write, gear_);
  const std::vector<std::string> names = form_.coefficient_names();
  for (std::size_t i = 0; i < names.size(); ++i) write("coefficient." + names[i], coefficients_[i]);
  visit_record(write, record_, names);
  return std::move(write.table);
}

FittedCompliance FittedCompliance::from_table(const FitTable& table) {
  Reader read(table);
  KernelForm form;
  GearProportions gear;
  visit_form(read, form);
  form.validate();
  visit_gear(read, gear);
  const std::vector<std::string> names = form.coefficient_names();
  std::vector<double> coefficients(names.size());
  for (std::size_t i = 0; i < names.size(); ++i) read("coefficient." + names[i], coefficients[i]);
  FitRecord record;
  visit_record(read, record, names);
  read.finish();
  return FittedCompliance(std::move(form), gear, std::move(coefficients), std::move(record));
}

}  // namespace flankwright
