#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/contact/assembly/flank_condition.hpp"
#include "core/effects/mesh_builder.hpp"

namespace flankwright {

/// The settings of a study on which effects depend.
struct EffectFacts {
  bool loaded{false};                        ///< some torque is above zero
  bool unloaded{false};                      ///< some torque is zero
  std::vector<FlankCondition> conditions{};  ///< of all scenes
  bool coupled_teeth{false};                 ///< the compliance model couples teeth
  bool gear_bodies{false};                   ///< and how the gears' bodies yield
  bool helical{false};                       ///< the helix angle is above zero
  bool rounded_tips{false};                  ///< a gear has a tip rounding
  bool shafts{false};                        ///< a gear's shaft is described
  bool root_stress{false};                   ///< finite elements are made anyway, or something asks for peak_root_stress
  bool whole_surface{false};                 ///< contact is sought over the whole flanks
};

/// Whether a scene calls for an effect, and why or why not.
struct EffectCall {
  bool on{false};
  std::string why;
};

/// Where between flanks and stress an effect acts. Effects are asked stage by stage, and by name within one, so that the order of
/// their registration never shows in a result.
enum class EffectStage {
  Unloaded,         ///< contact without load, beside the loaded mesh
  Condition,        ///< the shape of the flanks: left out by clear_from()
  Region,           ///< how far along the plane of action points are made
  Placement,        ///< where the points lie
  Body,             ///< the gear bodies
  Structure,        ///< what yields when loads act anywhere on the mesh: the influence matrix
  Coupling,         ///< its coupling between teeth
  ContactSite,      ///< a point's surroundings, for the contact law
  ContactLaw,       ///< what yields under a point's own load
  ContactCoupling,  ///< what contact yields under the loads beside a point
  Roots,            ///< what is read off the loads
};

/// One physical effect: its name, the rule for when a scene calls for it, and what it does to a mesh. An effect that is
/// off does nothing, but its part of a condition is cleared.
class Effect {
 public:
  virtual ~Effect() = default;

  virtual std::string_view name() const = 0;
  virtual EffectStage stage() const = 0;
  virtual EffectCall called_for(const EffectFacts& facts) const = 0;

  /// Name of the effect without which it means nothing; empty: none.
  virtual std::string_view needs() const { return {}; }
  /// A list of effects in a study switches it; false: another key does.
  virtual bool listed() const { return true; }
  /// It alone makes every point compliant, so that loads are determined.
  virtual bool makes_compliant() const { return false; }
  /// Removes the effect's part of a condition.
  virtual void clear_from(FlankCondition&) const {}
  /// Adds its part to a mesh position, in its stage.
  virtual void act(MeshBuilder&) const {}

 protected:
  Effect() = default;
  Effect(const Effect&) = default;
  Effect& operator=(const Effect&) = default;
};

}  // namespace flankwright
