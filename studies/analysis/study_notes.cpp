#include "studies/analysis/study_notes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "core/compliance/shaft/unit_statics.hpp"
#include "core/compliance/thin_slice/thin_slice.hpp"
#include "core/base/units.hpp"
#include "core/flank/natural_twist.hpp"
#include "studies/analysis/axial_hold_note.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/compliance/study_compliance.hpp"

namespace flankwright::studies {

namespace {

/// Slices that are not those of the standard.
void note_uncalibrated_slices(const Study& study, const GearPair& pair, std::vector<std::string>& notes) {
  if (study.fidelity.compliance != ComplianceModel::ThinSlice || study.task->single_gears || !has_torque(study)) return;
  if (ThinSlice(pair, study.material.pinion, study.material.wheel).status() == ThinSliceStatus::Calibrated) return;
  notes.emplace_back(
      "at these flanks the Hertzian contact alone yields more than teeth and contact together by ISO 6336-1: the thin slices cannot be calibrated to the standard, "
      "and the bending of the teeth is used as computed; fidelity.compliance = \"fitted\" or \"fe\" needs no calibration");
}

/// Crowning counts over the active part of the profile: a note where that is empty, or little of the dedendum.
void note_crowning(const Modification& given, const Gear& gear, std::vector<std::string>& notes) {
  const char* name = name_of(gear.member);
  const double addendum = gear.tip_form_radius - gear.working_pitch_radius, dedendum = gear.working_pitch_radius - gear.active_root_radius;
  const bool no_addendum = addendum <= 0.0, no_dedendum = dedendum <= 0.0;
  if ((no_addendum && given.addendum_crowning != 0.0) || (no_dedendum && given.dedendum_crowning != 0.0)) {
    notes.push_back(fmt::format("the {}'s {} touches nothing, the path of contact lies on one side of the pitch point: it is not crowned", name,
                                no_addendum ? "addendum" : "dedendum"));
  }
  const double extents = (gear.working_pitch_radius - gear.form_radius) / dedendum;
  if (given.dedendum_crowning != 0.0 && !no_dedendum && extents > 2.0) {
    const double amount = given.dedendum_crowning / units::um;
    notes.push_back(fmt::format(
        "the {}'s dedendum touches over a height of {:.3g} mm only, where it is crowned by {:.4g} um: at the form circle that is {:.4g} um", name,
        dedendum, amount, amount * extents * extents));
  }
}

/// A relief that is longer than the flank is no relief: it goes on to the other end.
void note_long_reliefs(const Study& study, const Gear& gear, std::vector<std::string>& notes) {
  const std::vector<DesignVariable> variables = varied_by_tasks(study);
  for (const ModificationDescriptor& amount : modification_parameters) {
    if (amount.extent.empty()) continue;
    const ModificationDescriptor& extent = *find_parameter(amount.extent);
    const auto varied = [&](const ModificationDescriptor& d) {
      const auto found = std::ranges::find_if(variables, [&](const DesignVariable& v) { return v.touches(gear.member, d.parameter); });
      return found == variables.end() ? nullptr : &*found;
    };
    const Modification& given = study.modification[gear.member];
    const DesignVariable* range = varied(extent);
    if (amount.get(given) == 0.0 && varied(amount) == nullptr) continue;
    const double longest = range != nullptr ? range->upper : extent.get(given);
    const bool along_face = extent.flank_class == ModificationClass::Lead;
    const double flank = along_face ? 0.5 * gear.data.face_width : gear.tip_form_radius - gear.active_root_radius;
    if (!(longest > flank)) continue;
    notes.push_back(fmt::format("the {}'s {} {} {:.3g} mm, more than {} of {:.3g} mm: it is no relief then, but changes the whole {}",
                                name_of(gear.member), extent.name, range != nullptr ? "may reach" : "is", longest,
                                along_face ? "half the face" : "the active height", flank, along_face ? "lead" : "profile"));
  }
}

/// A lead modification of a helical gear without a process: what twist grinding would bring. One that only an optimisation varies is taken as 1 um of
/// crowning.
void note_natural_twist(const Study& study, const GearPair& pair, Member m, std::vector<std::string>& notes) {
  Modification ground = study.modification[m];
  if (ground.process.kind != GrindingKind::None || pair.data.helix_angle == 0.0) return;
  const bool given = has_lead_modification(ground);
  const bool varied = std::ranges::any_of(
      varied_by_tasks(study), [&](const DesignVariable& v) { return v.member == m && describe(v.parameter).flank_class == ModificationClass::Lead; });
  if (!given && !varied) return;
  if (!given) ground.lead_crowning = units::um;
  ground.process.twist_compensation = 0.0;  // a process that is "none" has none
  constexpr double least = 0.01;            // |S| [um]; a slope of the lead twists nothing
  const auto twist = [&](GrindingKind kind) {
    ground.process.kind = kind;
    return natural_twist(pair, m, ground) / units::um;
  };
  const double generated = twist(GrindingKind::GeneratingGrinding);
  if (std::abs(generated) < least) return;
  std::string note =
      fmt::format("the {}'s process is \"none\", its lead modification is taken as drawn: generating grinding would twist {} by {:.3g} um",
                  name_of(m), given ? "it" : "1 um of lead crowning", generated);
  try {
    note += fmt::format(", form grinding with a wheel of {:.4g} mm by {:.3g} um (+ removes at the tip at z = +b/2)", ground.process.wheel_diameter,
                        twist(GrindingKind::FormGrinding));
  } catch (const InvalidInput&) {  // a form wheel of that diameter does not fit
  }
  notes.push_back(std::move(note));
}

void note_steep_lead(const Modification& modification, const GearPair& pair, Member m, std::vector<std::string>& notes) {
  if (!modification.process.has_natural_twist() || !has_lead_modification(modification)) return;
  const DeviationFormula lead(only(modification, ModificationClass::Lead), {}, pair.flank_frame(m));
  constexpr int sections = 400;
  double steepest = 0.0;
  for (int i = 0; i <= sections; ++i) {
    const double z = (static_cast<double>(i) / sections - 0.5) * pair[m].data.face_width;
    steepest = std::max(steepest, std::abs(lead.at(pair.flank_frame(m).pitch_radius, z).v));
  }
  constexpr double tool_curvature_radius = 400.0, least = 0.5 * units::um;  // mm: usual; least: what is worth saying
  const double more = 0.5 * tool_curvature_radius * steepest * steepest;
  if (more < least) return;
  notes.push_back(fmt::format(
      "the {}'s lead has a slope of {:.2g} um/mm: a grinding tool of usual size removes up to {:.2g} um more there, which is not computed",
      name_of(m), steepest / units::um, more / units::um));
}

/// Keys of a study that act only beside others, which it does not give.
void note_unused_keys(const Study& study, std::vector<std::string>& notes) {
  const auto note = [&](const std::string& key, bool used, const std::string& why) {
    if (used || std::ranges::none_of(study.given, [&](const GivenValue& g) { return g.key == key; })) return;
    notes.push_back(fmt::format("{} is not used: {}", key, why));
  };
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const GrindingKind kind = study.modification[m].process.kind;
    const std::string gear = std::string(name_of(m)) + ".", why = fmt::format("the process is \"{}\"", to_string(kind));
    note(gear + "twist_compensation", kind == GrindingKind::GeneratingGrinding || kind == GrindingKind::FormGrinding, why);
    note(gear + "grinding_wheel_diameter", kind == GrindingKind::FormGrinding, why);
    const bool loads_opposite = std::ranges::any_of(study.scenes, [&](const Scene& scene) { return loads_other_flanks(study, scene); });
    note(gear + "modification.grid_of_opposite_flank", loads_opposite, "no scene loads the flank that pair.working_flank does not name");
    note(gear + "meshes_per_revolution", !study.spectrum.empty(), "only a load spectrum has cycles");
  }
  const UnitData& unit = study.unit;
  note("unit.reference_torque", !unit.meshes.empty() || !unit.loads.empty(), "the unit has neither meshes nor loads that grow with the torque");
}

/// Tables of other tasks in a study that names no task. One that names its task may keep them for another run.
void note_unused_tables(const Study& study, std::vector<std::string>& notes) {
  const auto is_given = [&](const auto& is_key) {
    return std::ranges::any_of(study.given, [&](const GivenValue& given) { return is_key(given.key); });
  };
  if (is_given([](const std::string& key) { return key == "task"; })) return;
  for (const Task* task : registered_tasks()) {
    const std::string table = std::string(task->name) + ".";
    if (task == study.task || !is_given([&](const std::string& key) { return key.starts_with(table); })) continue;
    notes.push_back(fmt::format("the study has [{0}] but no task, so it is analysed: task = \"{0}\" would use it", task->name));
  }
}

/// What of a signal loads no tooth of this flank.
void note_signal(const Study& study, std::vector<std::string>& notes) {
  if (!study.signal) return;
  const CountedSignal& signal = *study.signal;
  const auto percent = [&](double duration) { return 100.0 * duration / signal.duration; };
  if (signal.counting == LoadCounting::Rainflow) {
    notes.push_back("rainflow counts the swings of the torque, as load cycles of teeth that stay in mesh with each other; revolutions do not count");
    return;
  }
  if (signal.count.standing_duration > 0.0) {
    notes.push_back(fmt::format("{}: for {:.3g} % of the time the pinion is loaded at a standstill, which brings no load cycles", signal.file,
                                percent(signal.count.standing_duration)));
  }
}

/// What of a load spectrum loads a flank that no scene rates.
void note_unrated_loads(const Study& study, std::vector<std::string>& notes) {
  const auto is_other = [&](const Scene& scene) { return loads_other_flanks(study, scene); };
  const bool rates_other = std::ranges::any_of(study.scenes, is_other), rates_own = !std::ranges::all_of(study.scenes, is_other);
  double cycles = 0.0, reversed = 0.0, forward = 0.0;
  for (const SpectrumBin& bin : study.spectrum) {
    cycles += bin.cycles;
    if (bin.torque < 0.0) reversed += bin.cycles;
    if (bin.torque > 0.0) forward += bin.cycles;
  }
  const auto note = [&](double unrated, const char* what) {
    notes.push_back(fmt::format("load.spectrum: for {:.3g} % of the {} the torque is {} rates that one", 100.0 * unrated / cycles,
                                study.spectrum.front().same_teeth ? "load cycles" : "revolutions", what));
  };
  if (!rates_other && reversed > 0.0)
    note(reversed, "below 0 and loads the other flank, which counts as time without load here; a scene with the other working_flank");
  // Without a torque below 0, scenes of either flank take those above.
  if (!rates_own && reversed > 0.0 && forward > 0.0)
    note(forward, "above 0 and loads the flank of pair.working_flank, which counts as time without load here; a scene with that working_flank");
}

/// Roots that the unit or the load spectrum bends both ways.
void note_alternating_bending(const Study& study, const GearPair& pair, std::vector<std::string>& notes) {
  const auto has = [&](bool below) {
    return std::ranges::any_of(study.spectrum, [&](const SpectrumBin& bin) { return below ? bin.torque < 0.0 : bin.torque > 0.0; });
  };
  const bool reverses = has(true) && has(false);
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    const bool is_rated = study.life.grade[m] || !std::isnan(study.life.root[m].limit);
    const bool in_each_revolution = meshes_on_other_flank({study.shaft, study.unit}, pair, m) != 0;
    if (!is_rated || !(in_each_revolution || reverses)) continue;
    notes.push_back(
        fmt::format("the {}'s teeth are loaded on both flanks {}: ISO 6336-3 reduces the strength of such roots (Y_M, about 0.7 of an "
                    "idler), which is not done here; a root_endurance_limit of the study can contain it",
                    name_of(m), in_each_revolution ? "in each revolution" : "over the load spectrum"));
  }
}

/// What is rated under more than its torque.
void note_load_factors(const Study& study, std::vector<std::string>& notes) {
  const LifeTable& life = study.life;
  const auto has_dynamic_factor = [](const SpectrumBin& bin) { return bin.dynamic_factor > 1.0; };
  if (!(life.application_factor * life.dynamic_factor > 1.0) && std::ranges::none_of(study.spectrum, has_dynamic_factor)) return;
  notes.push_back(
      "K_A and K_v count in damage, safety, film and flash temperature: contact stress times sqrt(K_A K_v), root stress and line load times K_A K_v; "
      "stresses, loads, loss and transmission error themselves are those of the torque alone");
  if (life.application_factor > 1.0 && !study.spectrum.empty()) {
    notes.push_back("load.application_factor is above 1 although load.spectrum gives the loads: ISO 6336-6 rates a spectrum with K_A = 1");
  }
}

/// What the flank behind the study's own is taken to be.
void note_other_flanks(const Study& study, std::vector<std::string>& notes) {
  std::vector<std::string> names, measured;
  for (const Scene& scene : study.scenes) {
    if (loads_other_flanks(study, scene)) names.push_back("\"" + scene.name + "\"");
  }
  if (names.empty()) return;
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (study.modification[m].opposite_topography) measured.push_back(name_of(m));
  }
  notes.push_back(fmt::format(
      "{} {} load{} the {} flank: it is taken as ground by the tool and in the setting of the {} one, with the same crowning and reliefs and the "
      "same change of the helix angle (lead slope and twist have the other sign along z there){}",
      names.size() == 1 ? "scene" : "scenes", fmt::join(names, ", "), names.size() == 1 ? "s" : "", name_of(opposite(study.pair.working_flank)),
      name_of(study.pair.working_flank),
      measured.empty() ? ""
                       : fmt::format("; of the {} it has its own grid instead of that of the other flank", fmt::join(measured, " and of the "))));
}

/// Scenes whose axes are so close that nothing is left of the backlash.
void note_closed_backlash(const Study& study, const GearPair& pair, std::vector<std::string>& notes) {
  for (const Scene& scene : study.scenes) {
    const double closer = -scene.misalignment.centre_distance, left = pair.backlash_at(pair.centre_distance - closer);
    if (left >= -units::um) continue;
    notes.push_back(fmt::format(
        "in the scene \"{}\" the axes are closer by {:.4g} mm: the teeth overlap by {:.4g} um and would jam; only the working "
        "flanks are analysed{}",
        scene.name, closer, -left / units::um,
        pair.backlash > units::um ? "" : " (this pair has no backlash; pinion.tooth_thickness_allowance or pair.centre_distance gives it some)"));
  }
}

/// Faces that end together become narrower in common whichever way the wheel moves along its axis.
void note_one_sided_derivative(const Study& study, const GearPair& pair, std::vector<std::string>& notes) {
  const auto by_offset = [](const GradientParameter& p) {
    const auto* misalignment = std::get_if<MisalignmentParameter>(&p.parameter);
    return misalignment != nullptr && *misalignment == &Misalignment::axial_offset;
  };
  if (std::ranges::none_of(study.gradients, by_offset)) return;
  constexpr double together = 1e-6;  // ends of faces that are apart by at most this [mm]
  const auto meet = [&](const Scene& scene) {
    const double offset = scene.misalignment.axial_offset;
    return std::abs(pair.pinion.face.end - pair.wheel.face.end - offset) <= together ||
           std::abs(pair.pinion.face.begin - pair.wheel.face.begin - offset) <= together;
  };
  if (std::ranges::none_of(study.scenes, meet)) return;
  notes.emplace_back(
      "the faces end together: an axial offset either way narrows the common face, and derivatives by misalignment.axial_offset are those towards larger "
      "offsets");
}

/// What scenes have, and a list of effects leaves out.
void note_left_out_effects(const Study& study, std::vector<std::string>& notes) {
  if (study.fidelity.automatic_effects) return;
  const EffectDecisions decisions = study_effects(study), called_for = decide_effects(effect_facts(study));
  std::map<std::string, std::vector<std::string>> scenes_without;  // by the effect
  for (const Scene& scene : study.scenes) {
    for (const std::string& effect : effects_missing_for(decisions, condition_of(study, scene))) {
      if (is_on(called_for, effect)) scenes_without[effect].push_back(scene.name);
    }
  }
  for (const auto& [effect, scenes] : scenes_without) {
    notes.push_back(
        fmt::format("fidelity.effects leaves \"{}\" out: what {} of it counts nowhere", effect,
                    scenes.size() == study.scenes.size() ? "the study says" : fmt::format("the scenes \"{}\" say", fmt::join(scenes, "\", \""))));
  }
  if (is_on(called_for, "shafts") && !is_on(decisions, "shafts")) {
    notes.push_back("fidelity.effects leaves \"shafts\" out: what the study says of shafts, bearings and a unit counts nowhere");
  }
}

}  // namespace

std::string backlash_in_words(const GearPair& pair) {
  const double of_pinion = pair.data.pinion.tooth_thickness_allowance / units::um, of_wheel = pair.data.wheel.tooth_thickness_allowance / units::um;
  const bool has_allowance = of_pinion != 0.0 || of_wheel != 0.0;
  if (std::isnan(pair.data.centre_distance) && !has_allowance) return {};
  const std::string allowances =
      has_allowance ? fmt::format(", with tooth thickness allowances of {:.4g} um on the pinion and {:.4g} um on the wheel", of_pinion, of_wheel)
                    : "";
  return fmt::format(
      "backlash {:.4g} um on the working pitch circle (j_wt), {:.4g} um normal to the flanks (j_bn), at the centre distance of {:.6g} mm (none at "
      "{:.6g} mm){}",
      pair.backlash / units::um, pair.normal_backlash() / units::um, pair.centre_distance, pair.backlash_free_centre_distance, allowances);
}

std::vector<std::string> steep_lead_notes(const PerGear<Modification>& modification, const GearPair& pair) {
  std::vector<std::string> notes;
  for (const Member m : {Member::Pinion, Member::Wheel}) note_steep_lead(modification[m], pair, m, notes);
  return notes;
}

std::vector<std::string> study_notes(const Study& study, const GearPair& pair) {
  std::vector<std::string> notes;
  if (study.fidelity.compliance == ComplianceModel::Rigid && has_torque(study) && !study.task->single_gears) {
    notes.push_back("compliance is rigid: torques are ignored, contact is analysed without load");
  }
  const bool has_body = std::ranges::any_of(study.given, [](const GivenValue& g) { return g.key.find(".body.") != std::string::npos; });
  if (has_body && has_torque(study) && !solves_finite_elements(study)) {
    notes.push_back(fmt::format("a gear's body is given, but the compliance \"{}\" does not know of it", to_string(study.fidelity.compliance)));
  }
  for (const Gear* gear : {&pair.pinion, &pair.wheel}) {
    const char* name = name_of(gear->member);
    if (gear->undercut) notes.push_back(fmt::format("the {} is undercut: its involute starts at diameter {:.6g} mm", name, 2.0 * gear->form_radius));
    if (gear->fillet_interference) {
      notes.push_back(fmt::format(
          "the mate's tip reaches below the {}'s form circle: the path of contact ends there, {} it the edge that the fillet leaves carries load; "
          "what touches the fillet itself is not modelled",
          name, gear->member == Member::Pinion ? "before" : "beyond"));
    }
  }
  note_crowning(study.modification.pinion, pair.pinion, notes);
  note_crowning(study.modification.wheel, pair.wheel, notes);
  note_long_reliefs(study, pair.pinion, notes);
  note_long_reliefs(study, pair.wheel, notes);
  if (study.task->add_notes != nullptr) study.task->add_notes(study, notes);
  for (const Member m : {Member::Pinion, Member::Wheel}) {
    if (!study.task->single_gears) note_natural_twist(study, pair, m, notes);
  }
  for (std::string& note : steep_lead_notes(study.modification, pair)) notes.push_back(std::move(note));
  note_uncalibrated_slices(study, pair, notes);
  note_unused_keys(study, notes);
  note_unused_tables(study, notes);
  note_signal(study, notes);
  note_unrated_loads(study, notes);
  note_load_factors(study, notes);
  note_alternating_bending(study, pair, notes);
  if (pair.transverse_contact_ratio < 1.0) {
    notes.push_back(fmt::format(
        "the transverse contact ratio is {:.3g}: in each section no teeth touch for a while, the overlap ratio of {:.3g} alone carries the mesh on",
        pair.transverse_contact_ratio, pair.overlap_ratio));
  }
  const bool is_beyond_ohlendorf = pair.transverse_contact_ratio < 1.0 || pair.transverse_contact_ratio > 2.0;
  if (is_beyond_ohlendorf && study.life.has_lubricant && has_torque(study)) {
    notes.push_back(fmt::format(
        "the transverse contact ratio is {:.3g}: Ohlendorf's loss factor, from which ISO/TS 6336-22 has the bulk temperature, holds for 1 to 2 and is too "
        "large above; the loss power is that of the local loads",
        pair.transverse_contact_ratio));
  }
  if (pair.backlash < -units::um) {
    notes.push_back(
        fmt::format("the teeth overlap by {:.4g} um at the centre distance of {:.6g} mm and would jam, from {:.6g} mm on they would not; only the "
                    "working flanks are analysed",
                    -pair.backlash / units::um, pair.centre_distance, pair.backlash_free_centre_distance));
  }
  if (pair.backlash >= -units::um) note_closed_backlash(study, pair, notes);
  note_one_sided_derivative(study, pair, notes);
  if (!study.task->single_gears) note_left_out_effects(study, notes);
  note_other_flanks(study, notes);
  for (std::string& note : axial_hold_notes(study)) notes.push_back(std::move(note));
  return notes;
}

}  // namespace flankwright::studies
