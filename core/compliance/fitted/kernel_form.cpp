#include "core/compliance/fitted/kernel_form.hpp"

#include <algorithm>

#include "core/base/error.hpp"

namespace flankwright {
namespace {

void append_names(std::vector<std::string>& names, const std::string& prefix, const EndPolynomial& polynomial) {
  static constexpr std::array<const char*, 3> kLengthNames{"d_2", "d_0.8", "d_0.3"};
  const auto powers = [&](const std::string& part, int count) {
    for (int i = 0; i < count; ++i) names.push_back(prefix + part + ".u_" + std::to_string(i));
  };
  powers(".middle", polynomial.middle);
  for (std::size_t k = 0; k < 3; ++k) {
    for (const char* end : {".end_0.", ".end_1."}) powers(std::string(end) + kLengthNames[k], polynomial.end[k]);
  }
}

void validate(const EndPolynomial& polynomial, const std::string& field) {
  const auto check = [&](int number, int lowest) {
    if (number < lowest || number > 6) {
      throw InvalidInput(field, std::to_string(number), std::to_string(lowest) + " .. 6 powers");
    }
  };
  check(polynomial.middle, 1);
  for (const int number : polynomial.end) check(number, 0);
}

}  // namespace

KernelForm KernelForm::one_tooth() { return {{Kernel{}, Kernel{}}, {BodyPart{}}, true}; }

KernelForm KernelForm::one_tooth_accurate() {
  Kernel smooth;
  smooth.smoothness = Smoothness::Matern52;
  return {{Kernel{}, Kernel{}, smooth}, {BodyPart{10, Coupling::Common}}, true};
}

KernelForm KernelForm::several_teeth() {
  KernelForm form = one_tooth_accurate();
  Kernel far, smooth_far;
  far.reach = Reach::Turning;
  smooth_far.reach = Reach::Gear;
  smooth_far.smoothness = Smoothness::Matern52;
  form.kernels.push_back(far);
  form.kernels.push_back(smooth_far);
  form.bodies.push_back({6, Coupling::Decaying});
  return form;
}

KernelForm KernelForm::correction() { return {{Kernel{}, Kernel{}}, {}, false}; }

int KernelForm::tooth_count() const {
  int sum = kWarpCoefficients;
  for (const Kernel& kernel : kernels) sum += kernel.count();
  return sum;
}

int KernelForm::body_count() const {
  int sum = torsion ? 2 : 0;
  for (const BodyPart& body : bodies) sum += body.count();
  return sum;
}

bool KernelForm::couples_teeth() const {
  return std::any_of(kernels.begin(), kernels.end(), [](const Kernel& kernel) { return kernel.couples_teeth(); });
}

std::vector<std::string> KernelForm::coefficient_names() const {
  std::vector<std::string> names;
  for (int i = 0; i < kWarpCoefficients; ++i) names.push_back("warp." + std::to_string(i));
  for (std::size_t k = 0; k < kernels.size(); ++k) {
    const std::string prefix = "kernel_" + std::to_string(k);
    append_names(names, prefix + ".log_amplitude", kernels[k].amplitude);
    append_names(names, prefix + ".log_axial", kernels[k].axial);
    append_names(names, prefix + ".log_radial", kernels[k].radial);
    if (kernels[k].couples_teeth()) {
      names.push_back(prefix + ".log_lambda");
      names.push_back(prefix + ".kappa");
    }
  }
  if (torsion) {
    names.push_back("wind_up.log_compliance");
    names.push_back("wind_up.log_width");
  }
  for (std::size_t k = 0; k < bodies.size(); ++k) {
    const std::string prefix = "body_" + std::to_string(k);
    for (int i = 0; i < bodies[k].functions; ++i) {
      for (int j = 0; j <= i; ++j) names.push_back(prefix + ".L_" + std::to_string(i) + "_" + std::to_string(j));
    }
    if (bodies[k].coupling == Coupling::Decaying) names.push_back(prefix + ".log_tau");
  }
  return names;
}

void KernelForm::validate() const {
  if (kernels.empty()) throw InvalidInput("form.kernels", "none", "at least one kernel");
  for (const Kernel& kernel : kernels) {
    flankwright::validate(kernel.amplitude, "form.kernel.amplitude");
    flankwright::validate(kernel.axial, "form.kernel.axial");
    flankwright::validate(kernel.radial, "form.kernel.radial");
  }
  for (const BodyPart& body : bodies) {
    if (body.functions < 1 || body.functions > 10) {
      throw InvalidInput("form.body.functions", std::to_string(body.functions), "1 .. 10");
    }
  }
}

}  // namespace flankwright
