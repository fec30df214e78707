#include "optimize/design_task.hpp"

namespace flankwright {

namespace {

bool is_extent(ModificationParameter parameter) {
  return parameter == ModificationParameter::TipReliefHeight || parameter == ModificationParameter::RootReliefHeight ||
         parameter == ModificationParameter::EndReliefLength;
}

}  // namespace

const char* to_string(Aggregate over) {
  switch (over) {
    case Aggregate::Nominal: return "nominal";
    case Aggregate::Worst: return "worst";
    case Aggregate::Mean: return "mean";
    case Aggregate::MeanPlusTwoSigma: return "mean+2sigma";
  }
  __builtin_unreachable();
}

const char* ObjectiveTerm::unit() const {
  switch (output) {
    case Output::PeakContactStress:
    case Output::PeakRootStress: return "MPa";
    case Output::TePeakToPeak:
    case Output::TeHarmonic: return "um";
    case Output::LoadFactor: return "1";
    case Output::PeakLineLoad: return "N/mm";
  }
  __builtin_unreachable();
}

double DesignVariable::outside_factor() const {
  if (parameter == ModificationParameter::ParabolicTe) return 1.0 / units::arcsec_per_square_deg;
  return is_extent(parameter) ? 1.0 : 1.0 / units::um;
}

const char* DesignVariable::unit() const {
  if (parameter == ModificationParameter::ParabolicTe) return "arcsec/deg^2";
  return is_extent(parameter) ? "mm" : "um";
}

std::string DesignTask::objective_name() const {
  std::string name;
  for (const ObjectiveTerm& term : objective) name += (name.empty() ? "" : " + ") + term.name;
  return name;
}

const char* DesignTask::objective_unit() const { return objective.size() == 1 ? objective.front().unit() : "weighted sum"; }

}  // namespace flankwright
