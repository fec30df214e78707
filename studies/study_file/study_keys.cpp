#include <string_view>

#include "core/effects/decision.hpp"
#include "studies/study_file/key_rows.hpp"

/// The table of keys.
namespace flankwright::studies {

namespace {

Material& material(StudyBuilder& builder, Member m) { return builder.study.material[m]; }

constexpr Range misalignment_angle = within(60.0);  // arcmin: a degree, far beyond any housing

using enum ValueKind;

}  // namespace

// A row is read as a row:
// clang-format off

std::vector<SchemaKey> working_condition_rows() {
  return {
      {.path = "misalignment.crossing", .quantity = Quantity::SmallAngle, .range = misalignment_angle, .fallback = "0",
       .meaning = "f_Sigma_beta, about the line of centres, out of plane; + closes the right flank at +z and opens the left one",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.crossing = v.number; }},
      {.path = "misalignment.intersecting", .quantity = Quantity::SmallAngle, .range = misalignment_angle,
       .fallback = "0", .meaning = "f_Sigma_delta, in the plane of the axes; + opens the mesh at +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.intersecting = v.number; }},
      {.path = "misalignment.centre_distance", .quantity = Quantity::Length, .range = within(100.0), .fallback = "0",
       .meaning = "delta E, added to the pair's; + apart",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.centre_distance = v.number; }},
      {.path = "misalignment.axial_offset", .quantity = Quantity::Length, .range = within(1000.0), .fallback = "0",
       .meaning = "wheel towards +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.axial_offset = v.number; }},
      {.path = "misalignment.pinion_lead_angle", .quantity = Quantity::SmallAngle, .range = misalignment_angle,
       .fallback = "0", .meaning = "delta lambda_p1 of the pinion, Litvin's appendix 2 in full",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.pinion_lead_angle = v.number; }},
      {.path = "misalignment.pinion_pressure_angle", .quantity = Quantity::SmallAngle, .range = misalignment_angle,
       .fallback = "0", .meaning = "delta alpha_n1 of the pinion",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.pinion_pressure_angle = v.number; }},
      {.path = "misalignment.mesh_misalignment", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "0",
       .meaning = "F_beta_y over the smaller face width, transverse base tangent; + opens at +z",
       .store = [](Scene& s, Member, const Value& v) { s.misalignment.mesh_misalignment = v.number; }},

      {.path = "material.youngs_modulus", .quantity = Quantity::Stress, .range = above_zero(1e7), .fallback = "206000",
       .meaning = "E of both gears",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.material.pinion.youngs_modulus = d.study.material.wheel.youngs_modulus = v.number;
       }},
      {.path = "material.poissons_ratio", .range = {.low = 0.0, .high = 0.5, .high_open = true}, .fallback = "0.3",
       .meaning = "nu of both gears",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.material.pinion.poissons_ratio = d.study.material.wheel.poissons_ratio = v.number;
       }},
      {.path = "gear.material.youngs_modulus", .quantity = Quantity::Stress, .range = above_zero(1e7),
       .fallback = "(as [material])", .meaning = "E of this gear",
       .store = [](StudyBuilder& d, Member m, const Value& v) { material(d, m).youngs_modulus = v.number; }},
      {.path = "gear.material.poissons_ratio", .range = {.low = 0.0, .high = 0.5, .high_open = true},
       .fallback = "(as [material])", .meaning = "nu of this gear",
       .store = [](StudyBuilder& d, Member m, const Value& v) { material(d, m).poissons_ratio = v.number; }},

      {.path = "load.torque", .kind = NumberOrList, .quantity = Quantity::Torque, .range = from_zero(1e9),
       .fallback = "0", .meaning = "on the pinion; a list runs each, 0 is unloaded",
       .hint = "for torque the other way round write pair.working_flank = \"left\"",
       .store = [](Scene& s, Member, const Value& v) { s.torques = v.numbers; }},
      {.path = "unloaded.marking_thickness", .quantity = Quantity::Deviation, .range = above_zero(1000.0),
       .fallback = "6.35", .meaning = "of the compound that shows the bearing pattern; 6.35 um is 0.00025 in",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.marking_thickness = v.number; }},
      {.path = "drawing.iso_1328_class", .kind = Integer, .range = {.low = 1, .high = 11}, .fallback = "(that of optimise.scatter)",
       .meaning = "class of the bands about the traces that go on the drawing; without a class there is no drawing",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.drawing_class = static_cast<int>(v.integer); }},
      {.path = "output.points", .kind = Word, .words = {"all", "governing"}, .fallback = "(all up to 40 load cases, those of all designs counted; governing beyond)",
       .meaning = "load cases whose contact points are in results.json, points.csv and the report; governing: those of the largest stresses, transmission error and damage, and of the least safety and film, of each design and flank; all load cases have their quantities over the cycle",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.points = v.text == "all" ? CasesWithPoints::All : CasesWithPoints::Governing; }},
      {.path = "cycle.positions", .kind = IntegerOrAuto, .range = {.low = 1, .high = 4096}, .fallback = "\"auto\"",
       .meaning = "mesh positions over one base pitch; auto is 32, and in an analysis under load up to 128 where the estimated errors ask for more",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.cycle.automatic_positions = v.text == "auto";
         if (v.text != "auto") d.study.cycle.positions = static_cast<int>(v.integer);
       }},
      {.path = "cycle.peaks", .kind = Word, .words = {"refined", "sampled"}, .fallback = "(refined; sampled where the task is to optimise)",
       .meaning = "refined: peaks with and without spikes, sought between the positions, and the load distribution factors K_H that follow; sampled: those of the positions only",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.cycle.locate_peaks = v.text == "refined"; }},
      {.path = "cycle.phases", .kind = NumberList, .range = within(100.0), .fallback = "(evenly spaced positions)",
       .meaning = "explicit phases of the reference tooth pair, in base pitches; 0 where its contact line enters",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.cycle.phases = v.numbers; }},

      {.path = "fidelity.compliance", .kind = Word, .words = {"rigid", "thin_slice", "fitted", "fe"},
       .fallback = "\"fitted\"", .meaning = "compliance model, in the order of cost; without a torque none is used",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.fidelity.compliance = compliance_model(v.text);
       }},
      {.path = "fidelity.gap", .kind = Word, .words = {"plane_of_action", "whole_surface"},
       .fallback = "\"plane_of_action\"",
       .meaning = "where contact is sought: near the lines of contact of undisturbed flanks, or over the whole flanks, misaligned and modified",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.fidelity.gap = static_cast<GapModel>(v.integer); }},
      {.path = "fidelity.quadrature.rule", .kind = Word, .words = {"gauss2", "gauss3", "midpoint", "graded"},
       .fallback = "(graded)", .meaning = "points in each interval of a contact line; graded: two Gauss points on intervals that end where the line does; the others: at fixed points of the face, as in Haddad's thesis",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.fidelity.automatic_intervals = false;
         d.study.fidelity.quadrature.rule = static_cast<QuadratureRule>(v.integer);
       }},
      {.path = "fidelity.quadrature.intervals", .kind = Integer, .range = {.low = 1, .high = 500}, .fallback = "(12, or what the figures need)",
       .meaning = "intervals of a full contact line; left out, an analysis under load takes up to 48 where the estimated errors ask for more",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.fidelity.automatic_intervals = false;
         d.study.fidelity.quadrature.intervals = static_cast<int>(v.integer);
       }},
      {.path = "fidelity.effects", .kind = WordList,
       .words = listed_effect_names(), .fallback = "\"auto\"",
       .meaning = "what enters the run; auto decides from the study, a list switches by hand",
       .store = [](StudyBuilder& d, Member, const Value& v) {
         d.study.fidelity.automatic_effects = !v.is_list;
         d.study.fidelity.effects = v.words;
       }},
      {.path = "fidelity.accuracy", .kind = Percentage, .range = above_zero(50.0), .fallback = "(none)",
       .meaning = "\"1 %\": chooses compliance and gap and refines quadrature and positions, as far as the study does not give them: the cheapest whose estimated error in transmission error, its harmonics and peak contact stress is within it; the results have the estimates and their cost in `accuracy_choice`",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.fidelity.accuracy = v.number; }},
      {.path = "fidelity.effect_sizes", .kind = Word, .words = {"off", "estimated", "exact"}, .fallback = "\"estimated\"",
       .meaning = "what each effect does to transmission error and contact stress: to first order at a few positions, or by leaving it out at the study's resolution as well",
       .store = [](StudyBuilder& d, Member, const Value& v) { d.study.fidelity.effect_sizes = static_cast<EffectSizing>(v.integer); }},
  };
}

std::vector<SchemaKey> scene_rows() {
  return {
      {.path = "scenes", .kind = Free, .allowed = "[[scenes]] tables",
       .fallback = "(one scene, nominal)",
       .meaning = "working conditions; each overrides `misalignment.*`, `load.torque`, `load.speed` or either gear's `error.*`"},
      {.path = "scenes[].name", .kind = Text, .fallback = "(scene 1, scene 2 ...)",
       .meaning = "names the scene in results",
       .store = [](Scene& s, Member, const Value& v) { s.name = v.text; }},
      {.path = "scenes[].weight", .range = above_zero(1e9), .fallback = "1",
       .meaning = "its share in mean and mean+2sigma",
       .store = [](Scene& s, Member, const Value& v) { s.weight = v.number; }},
      {.path = "scenes[].working_flank", .kind = Word, .words = {"right", "left"}, .fallback = "(pair.working_flank)",
       .meaning = "flank of the pinion that this scene loads; the one that is not pair.working_flank has the modifications that the same tool leaves there",
       .store = [](Scene& s, Member, const Value& v) { s.working_flank = static_cast<WorkingFlank>(v.integer); }},

      {.path = "expect", .kind = Free, .allowed = "a table of keys of results.json, each with { value, within }, { min, max } or { is }",
       .fallback = "(none)",
       .meaning = "\"loaded.summary.te_peak_to_peak_um\" = { max = 3 }: what results.json must say"},
  };
}

// clang-format on

namespace {

/// Appends the rows, a gear's once for each gear.
void append(std::vector<SchemaKey>& schema, const std::vector<SchemaKey>& rows) {
  constexpr std::string_view any_gear = "gear.";
  for (const SchemaKey& row : rows) {
    schema.push_back(row);
    if (!row.path.starts_with(any_gear)) continue;
    schema.push_back(row);
    const std::string rest = row.path.substr(any_gear.size());
    SchemaKey& of_pinion = schema[schema.size() - 2];
    SchemaKey& of_wheel = schema.back();
    of_pinion.path = "pinion." + rest;
    of_wheel.path = "wheel." + rest;
    of_wheel.member = Member::Wheel;
  }
}

std::vector<SchemaKey> make_schema() {
  std::vector<SchemaKey> schema;
  for (const auto& rows :
       {geometry_rows(), flank_rows(), working_condition_rows(), life_rows(), body_rows(), shaft_rows(), unit_rows(), scene_rows()})
    append(schema, rows);
  for (const Task* task : registered_tasks()) {
    if (task->keys != nullptr) append(schema, task->keys());
  }
  return schema;
}

}  // namespace

const std::vector<SchemaKey>& study_schema() {
  static const std::vector<SchemaKey> schema = make_schema();
  return schema;
}

const std::vector<ExclusiveKeys>& exclusive_keys() {
  static const std::vector<ExclusiveKeys> pairs = [] {
    std::vector<ExclusiveKeys> made{{"pair.normal_module", "pair.normal_diametral_pitch"},
                                    {"cycle.positions", "cycle.phases"},
                                    {"load.torque", "load.spectrum"},
                                    {"load.spectrum.file", "load.spectrum.signal"},
                                    {"load.spectrum.hours", "load.spectrum.repeats"}};
    for (const std::string gear : {"pinion.modification.", "wheel.modification."}) {
      for (const ModificationDescriptor& d : modification_parameters) {
        for (const std::string_view half : {d.half, d.other_half}) {
          if (!half.empty()) made.push_back({gear + std::string(d.key), gear + std::string(half)});
        }
      }
    }
    return made;
  }();
  return pairs;
}

}  // namespace flankwright::studies
