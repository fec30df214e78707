#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <memory>
#include <utility>

#include "core/flank/grinding_process.hpp"
#include "core/flank/modifications/end_relief.hpp"
#include "core/flank/modifications/lead_crowning.hpp"
#include "core/flank/modifications/lead_slope.hpp"
#include "core/flank/modifications/modification_list.hpp"
#include "core/flank/modifications/parabolic_te.hpp"
#include "core/flank/modifications/profile_crowning.hpp"
#include "core/flank/modifications/profile_slope.hpp"
#include "core/flank/modifications/root_relief.hpp"
#include "core/flank/modifications/tip_relief.hpp"
#include "core/flank/modifications/topography_shapes.hpp"
#include "core/flank/modifications/triangular_relief.hpp"
#include "core/flank/modifications/twist.hpp"
#include "core/gear/deviation_field.hpp"

namespace flankwright {

/// Every modification that there is. Its header describes it; code that needs all of them goes through this list.
using Modifications =
    ModificationList<modifications::LeadCrowning, modifications::LeadSlope, modifications::ProfileCrowning, modifications::ProfileSlope,
                     modifications::TipRelief, modifications::RootRelief, modifications::EndReliefs, modifications::TriangularTipRelief,
                     modifications::TriangularRootRelief, modifications::Twist, modifications::ParabolicTe, modifications::LeadShapes,
                     modifications::ProfileShapes, modifications::TopographyShapes>;

/// Flank modification as a designer states it: material removed (positive into the tooth), measured in the
/// transverse plane along the base tangent [ISO 21771; ISO 1328-1]. All amounts in mm, parabolic_te in 1/rad.
struct Modification : Modifications {
  /// Measured or topological grid on top of the rest; none where null.
  std::shared_ptr<const DeviationField> topography{};
  /// The same of the opposite flank of each tooth, see on_opposite_flank().
  std::shared_ptr<const DeviationField> opposite_topography{};
  GrindingProcess process{};                             ///< which may move the lead modifications over the flank, see ContactShift
  bool operator==(const Modification&) const = default;  ///< of grids: the same object
};

using ModificationDescriptor = DescriptorOf<Modifications>;
using ModificationChoice = ChoiceOf<Modifications>;

/// All numbers of what is removed that a designer may vary, in the order of Modifications.
inline constexpr auto modification_parameters = descriptors_of(std::type_identity<Modifications>());
static_assert(are_complete(modification_parameters));

/// A number of the process that a designer may vary beside them.
struct ProcessDescriptor : ParameterDescription {
  double (*get)(const GrindingProcess&){nullptr};
  void (*set)(GrindingProcess&, double){nullptr};
};

/// All of them. Their indices follow those of modification_parameters, so that one ModificationParameter names either.
inline constexpr std::array process_parameters{
    ProcessDescriptor{{{.key = "twist_compensation",
                        .name = "twist compensation",
                        .meaning = "part of the natural twist that the machine takes out, by diagonal feed or a modified worm; 1 leaves none",
                        .kind = ParameterKind::Fraction},
                       ModificationParameter{modification_parameters.size()},
                       ModificationClass::Process},
                      [](const GrindingProcess& process) { return process.twist_compensation; },
                      [](GrindingProcess& process, double value) { process.twist_compensation = value; }}};

/// All words of a Modification.
inline constexpr auto modification_choices = choices_of(std::type_identity<Modifications>());

/// f(row) for every parameter and every choice, the choices of a modification behind its parameters.
template <class F>
void for_each_modification_key(F&& f) {
  for (const ModificationDescriptor& d : modification_parameters) {
    f(d);
    for (const ModificationChoice& c : modification_choices) {
      if (c.after == d.key) f(c);
    }
  }
}

/// The row of a parameter of the process; null for one of what is removed.
constexpr const ProcessDescriptor* of_process(ModificationParameter parameter) {
  const auto index = static_cast<std::size_t>(parameter);
  return index < modification_parameters.size() ? nullptr : &process_parameters[index - modification_parameters.size()];
}

constexpr const ParameterDescription& describe(ModificationParameter parameter) {
  if (const ProcessDescriptor* process = of_process(parameter)) return *process;
  return modification_parameters[static_cast<std::size_t>(parameter)];
}

/// The row of what is removed of a key; null where there is none.
constexpr const ModificationDescriptor* find_parameter(std::string_view key) {
  for (const ModificationDescriptor& d : modification_parameters) {
    if (d.key == key) return &d;
  }
  return nullptr;
}

/// The parameter of a key, of what is removed or of the process; a key that does not exist does not compile.
consteval ModificationParameter parameter_of(std::string_view key) {
  for (const ProcessDescriptor& d : process_parameters) {
    if (d.key == key) return d.parameter;
  }
  return find_parameter(key)->parameter;
}

/// Value of one parameter [mm; parabolic_te 1/rad; twist_compensation -]. profile_crowning reads the mean of addendum and dedendum crowning.
inline double get(const Modification& m, ModificationParameter parameter) {
  if (const ProcessDescriptor* process = of_process(parameter)) return process->get(m.process);
  return modification_parameters[static_cast<std::size_t>(parameter)].get(m);
}

/// Sets one parameter [mm; parabolic_te 1/rad; twist_compensation -]. profile_crowning sets both halves.
inline void set(Modification& m, ModificationParameter parameter, double value) {
  if (const ProcessDescriptor* process = of_process(parameter)) return process->set(m.process, value);
  modification_parameters[static_cast<std::size_t>(parameter)].set(m, value);
}

/// What a tool that is dressed alike for both flanks leaves on the opposite one in the same setting: the flank that works when the gear is turned over,
/// end for end. Removal at z there is that at -z here, so that numbers that are odd along the face change their signs: a lead slope is one of the helix
/// angle, for both flanks. A process twists each flank as ContactShift has it.
/// A grid belongs to one flank: there is that of the opposite one.
inline Modification on_opposite_flank(Modification m) {
  std::swap(m.topography, m.opposite_topography);
  for (const ModificationDescriptor& d : modification_parameters) {
    if (d.odd_along_face) d.set(m, -d.get(m));
  }
  return m;
}

/// Whether something is removed that depends on z alone.
inline bool has_lead_modification(const Modifications& m) {
  return std::ranges::any_of(modification_parameters, [&](const ModificationDescriptor& d) {
    return d.flank_class == ModificationClass::Lead && d.kind != ParameterKind::Extent && d.get(m) != 0.0;
  });
}

/// The lead or profile modifications alone, without grids and as drawn, whatever the process makes of them.
inline Modification only(const Modification& modification, ModificationClass flank_class) {
  return {only(static_cast<const Modifications&>(modification), flank_class), nullptr, nullptr, {}};
}

}  // namespace flankwright
