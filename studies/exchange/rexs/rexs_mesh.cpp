#include "studies/exchange/rexs/rexs_mesh.hpp"

#include <cmath>

#include "core/base/units.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

namespace {

class MeshReading {
 public:
  MeshReading(Reading& reading, const StageParts& parts) : reading_(reading), parts_(parts) {}

  ImportedMesh read() {
    read_module();
    read_pressure_angle();
    read_helix();
    if (const auto distance = reading_.number(parts_.stage, "center_distance", Dimension::Length)) {
      mesh_.centre_distance = distance->value;
      mesh_.remarks["centre_distance"] = distance->source;
    }
    return std::move(mesh_);
  }

 private:
  const Component& gear(Member m) const { return *parts_[m].gear; }

  void read_module() {
    constexpr std::string_view id = "normal_module";
    const auto of_pinion = reading_.number(&gear(Member::Pinion), id, Dimension::Length),
               of_wheel = reading_.number(&gear(Member::Wheel), id, Dimension::Length);
    if (!of_pinion && !of_wheel) reading_.refuse_attribute(gear(Member::Pinion), id, "not given", "a number: a study needs it");
    if (of_pinion && of_wheel && !agree(of_pinion->value, of_wheel->value)) {
      reading_.refuse_attribute(gear(Member::Wheel), id, number_text(of_wheel->value), "that of the mate, " + number_text(of_pinion->value));
    }
    const Taken& taken = of_pinion ? *of_pinion : *of_wheel;
    mesh_.normal_module = taken.value;
    mesh_.remarks["normal_module"] = taken.source;
  }

  void read_pressure_angle() {
    std::optional<Taken> found;
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      for (const Component* at : {parts_[m].flank, parts_[m].gear, parts_[m].tool}) {
        const auto angle = reading_.number(at, "normal_pressure_angle", Dimension::Angle);
        if (angle && found && !agree(angle->value, found->value)) {
          reading_.refuse_attribute(*at, "normal_pressure_angle", number_text(angle->value / units::deg),
                                    number_text(found->value / units::deg) + " deg, as " + found->source + " says");
        }
        if (!found) found = angle;
      }
    }
    if (found) mesh_.pressure_angle = found->value;
    mesh_.remarks["pressure_angle"] = found ? found->source : "not in the file";
  }

  void read_helix() {
    const Component &pinion = gear(Member::Pinion), &wheel = gear(Member::Wheel);
    constexpr std::string_view id = "helix_angle_reference_diameter";
    const auto of_pinion = reading_.number(&pinion, id, Dimension::Angle), of_wheel = reading_.number(&wheel, id, Dimension::Angle);
    if (of_pinion && of_wheel && !agree(of_pinion->value, -of_wheel->value)) {
      reading_.refuse_attribute(wheel, id, number_text(of_wheel->value / units::deg),
                                number_text(-of_pinion->value / units::deg) + " deg, opposite to the mate's: axes are parallel");
    }
    const double beta = of_pinion ? of_pinion->value : of_wheel ? -of_wheel->value : 0.0;
    mesh_.helix_angle = std::abs(beta);
    mesh_.pinion_hand = beta < 0.0 ? Hand::Left : Hand::Right;
    mesh_.remarks["helix_angle"] = of_pinion ? of_pinion->source : of_wheel ? of_wheel->source : "not in the file: spur";
    mesh_.remarks["pinion_hand"] = beta == 0.0 ? "of no meaning for spur gears" : "positive helix angles are right-handed";
  }

  Reading& reading_;
  const StageParts& parts_;
  ImportedMesh mesh_;
};

}  // namespace

ImportedMesh read_mesh(Reading& reading, const StageParts& parts) { return MeshReading(reading, parts).read(); }

}  // namespace flankwright::studies::rexs
