#include "studies/results/shafts_json.hpp"

#include <cmath>

#include "studies/results/unit_json.hpp"

namespace flankwright::studies {

void add_shaft_motion(const LoadedResult& loaded, const StudyResults& results, Json& json) {
  const MeshModel& model = results.models[loaded.model];
  const ShaftPair shafts = results.shafts->at_torque(loaded.torque);
  if (shafts.has_unit() || results.shafts->depends_on_load()) json["unit"] = unit_state_json(shafts.state(loaded.torque, model.axial_offset));
  double sum = 0.0;  // of the positions' misalignment; NaN where one has no load distribution
  json["shafts"] = Json::array();
  for (std::size_t i = 0; i < loaded.cycle.positions.size(); ++i) {
    const MeshPosition& at = model.positions[i];
    const LoadDistribution& load = loaded.cycle.positions[i].load;
    if (!load.usable()) {
      json["shafts"].push_back(nullptr);
      sum = not_given;
      continue;
    }
    const Eigen::VectorXd forces = at.weight.cwiseProduct(load.line_load);
    Json entry{{"phase", at.phase}};
    double together = 0.0;
    for (const auto& [member, name] : {std::pair{Member::Pinion, "pinion"}, std::pair{Member::Wheel, "wheel"}}) {
      entry[name] = nullptr;
      if (!shafts.has_shaft(member)) continue;
      const ShaftMotion motion = shafts.motion(member, at.points, forces, model.axial_offset);
      entry[name] = {{"displacement_um", in_um(motion.displacement)}, {"misalignment_um", in_um(motion.misalignment)}};
      together += motion.misalignment;
    }
    entry["mesh_misalignment_um"] = in_um(together);
    json["shafts"].push_back(std::move(entry));
    sum += together;
  }
  json["summary"]["shaft_misalignment_um"] = in_um(sum / static_cast<double>(loaded.cycle.positions.size()));
}

}  // namespace flankwright::studies
