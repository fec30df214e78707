#include "core/effects/registry.hpp"

#include <algorithm>
#include <tuple>

#include "core/effects/adjacent_teeth.hpp"
#include "core/effects/bending.hpp"
#include "core/effects/contact_coupling.hpp"
#include "core/effects/edge_contact.hpp"
#include "core/effects/extended_contact_region.hpp"
#include "core/effects/free_ends.hpp"
#include "core/effects/gear_body_compliance.hpp"
#include "core/effects/hertzian_contact.hpp"
#include "core/effects/manufacturing_errors.hpp"
#include "core/effects/misalignment.hpp"
#include "core/effects/modifications.hpp"
#include "core/effects/natural_twist.hpp"
#include "core/effects/root_stress.hpp"
#include "core/effects/shafts.hpp"
#include "core/effects/tip_corner.hpp"
#include "core/effects/unloaded_contact.hpp"
#include "core/effects/whole_surface_gap.hpp"

namespace flankwright {

const EffectList& registered_effects() {
  static const std::tuple<AdjacentTeethEffect, BendingEffect, ContactCouplingEffect, EdgeContactEffect, ExtendedContactRegionEffect, FreeEndsEffect,
                          GearBodyComplianceEffect, HertzianContactEffect, ManufacturingErrorsEffect, MisalignmentEffect, ModificationsEffect,
                          NaturalTwistEffect, RootStressEffect, ShaftsEffect, TipCornerEffect, UnloadedContactEffect, WholeSurfaceGapEffect>
      effects;
  static const EffectList list = std::apply([](const auto&... effect) { return in_order_of_flow({&effect...}); }, effects);
  return list;
}

EffectList in_order_of_flow(EffectList effects) {
  std::ranges::sort(effects, {}, [](const Effect* effect) { return std::tuple(effect->stage(), effect->name()); });
  return effects;
}

}  // namespace flankwright
