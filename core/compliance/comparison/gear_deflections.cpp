#include "core/compliance/comparison/gear_deflections.hpp"

#include "core/compliance/plate/cantilever_plate.hpp"
#include "core/compliance/thin_slice/thin_slice_tooth.hpp"

namespace flankwright {

std::vector<GearDeflections> gear_deflections(const GearPair& pair, const Material& pinion, const Material& wheel, const PairCompliance* structure,
                                              const std::string& name, const ForEachIndex& for_each) {
  const auto* of_gears = dynamic_cast<const StructuralPair*>(structure);
  if (of_gears == nullptr) return {};
  constexpr int neighbours = 1;  // known to every model that couples teeth
  const double module = pair.data.normal_module;
  std::vector<GearDeflections> all(2);
  const auto add = [&](std::size_t i) {
    const Member member = i == 0 ? Member::Pinion : Member::Wheel;
    const double nu = (member == Member::Pinion ? pinion : wheel).poissons_ratio;
    const double face = pair[member].data.face_width;
    const ToothForm form = tooth_form(pair, member);
    const CantileverPlate plate(form, module, face, nu);
    const ThinSliceTooth slices(form, module, face, nu);
    const std::vector<NamedModel> models{named_model(name, neighbours, *(*of_gears)[member].compliance), named_model("plate", 0, plate),
                                         named_model("thin slices", 0, slices)};
    all[i] = {member, pair[member].data.teeth, gear_deflection_curves(models, face / module, neighbours)};
  };
  run_for_each(for_each, all.size(), add);
  return all;
}

}  // namespace flankwright
