#include "studies/study_file/key_rows.hpp"

namespace flankwright::studies {

namespace {

using enum ValueKind;

SpectrumBin& bin(StudyBuilder& builder) { return builder.study.spectrum.back(); }

SpectrumSource& source(StudyBuilder& builder) { return builder.study.spectrum_source; }

LifeTable& life(StudyBuilder& builder) { return builder.study.life; }

Lubricant& lubricant(StudyBuilder& builder) {
  life(builder).has_lubricant = true;
  return life(builder).lubricant;
}

constexpr Range strength_range = above_zero(1e5);                 // MPa
constexpr Range slope_range = {.low = 1.0, .high = 200.0};        // exponents of S-N curves
constexpr Range cycles_to_knee = {.low = 1e3, .high = 1e12};      // load cycles
constexpr Range load_factor_range = {.low = 1.0, .high = 10.0};   // K_A, K_v
constexpr Range turning_speed = {.low = 1e-4, .high = 1e6};       // rpm: from a turn a week to turbines
constexpr Range oil_temperature = {.low = -50.0, .high = 250.0};  // deg C

using Curves = PerGear<GivenSnCurve> LifeTable::*;

/// Changes one kind of S-N curve of both gears, or of one.
template <Curves curves, bool of_both, class Change>
void change_curves(StudyBuilder& builder, Member m, const Change& change) {
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    if (of_both || member == m) change((life(builder).*curves)[member]);
  }
}

/// Changes the named material of both gears, or of one.
template <bool of_both, class Change>
void change_grades(StudyBuilder& builder, Member m, const Change& change) {
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    if (!of_both && member != m) continue;
    std::optional<MaterialGrade>& grade = life(builder).grade[member];
    if (!grade) grade.emplace();
    change(*grade);
  }
}

// A row is read as a row:
// clang-format off

/// The keys of one kind of S-N curve, of both gears or of one.
template <Curves curves, bool of_both>
void append_curve(std::vector<SchemaKey>& rows, const std::string& table, const char* kind, const char* limit_meaning) {
  const std::string name = table + "material." + kind, none = of_both ? "(none)" : "(as [material])";
  rows.insert(rows.end(), {
      {.path = name + "_endurance_limit", .quantity = Quantity::Stress, .range = strength_range,
       .fallback = of_both ? "(that of strength, else none)" : none, .meaning = limit_meaning,
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_curves<curves, of_both>(d, m, [&](GivenSnCurve& c) { c.limit = v.number; }); }},
      {.path = name + "_sn_curve", .kind = WordOrTable, .words = {"through_hardened", "case_hardened", "nitrided", "nitrocarburised"},  // as LifeFactors
       .fallback = of_both ? "(that of strength.kind, else case_hardened)" : "(as [material])", .meaning = "life factors of ISO 6336 for a heat treatment, or a curve of one's own",
       .store = [](StudyBuilder& d, Member m, const Value& v) {
         if (!v.text.empty()) change_curves<curves, of_both>(d, m, [&](GivenSnCurve& c) { c = {c.limit, static_cast<LifeFactors>(v.integer)}; });
       }},
      {.path = name + "_sn_curve.exponent", .range = slope_range, .fallback = "(that of the life factors)", .meaning = "p of N ~ stress^-p above the endurance limit; needs knee",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_curves<curves, of_both>(d, m, [&](GivenSnCurve& c) { c.exponent = v.number; }); }},
      {.path = name + "_sn_curve.knee", .range = cycles_to_knee, .fallback = "(that of the life factors)", .meaning = "load cycles that the endurance limit is borne for; needs exponent",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_curves<curves, of_both>(d, m, [&](GivenSnCurve& c) { c.knee = v.number; }); }},
      {.path = name + "_sn_curve.exponent_beyond", .range = slope_range, .fallback = "(exponent: Miner's elementary rule)", .meaning = "p below the endurance limit, at least exponent",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_curves<curves, of_both>(d, m, [&](GivenSnCurve& c) { c.exponent_beyond = v.number; }); }},
  });
}

/// The keys of a material named by ISO 6336-5, of both gears or of one.
template <bool of_both>
void append_grade(std::vector<SchemaKey>& rows, const std::string& table) {
  const std::string name = table + "material.strength.", none = of_both ? "(none)" : "(as [material])";
  const auto words_of = [](int count, auto first) {
    std::vector<std::string> words;
    for (int i = 0; i < count; ++i) words.emplace_back(to_string(static_cast<decltype(first)>(i)));
    return words;
  };
  rows.insert(rows.end(), {
      {.path = name + "kind", .kind = Word, .words = words_of(material_kind_count, MaterialKind{}), .fallback = none,
       .meaning = "material and heat treatment by ISO 6336-5, whose table gives the endurance limits that are not given; needs hardness",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_grades<of_both>(d, m, [&](MaterialGrade& g) { g.kind = static_cast<MaterialKind>(v.integer); }); }},
      {.path = name + "quality", .kind = Word, .words = words_of(3, MaterialQuality{}), .fallback = of_both ? "(MQ)" : none,
       .meaning = "of material and heat treatment, ISO 6336-5",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_grades<of_both>(d, m, [&](MaterialGrade& g) { g.quality = static_cast<MaterialQuality>(v.integer); }); }},
      {.path = name + "hardness", .range = above_zero(1200.0), .fallback = none,
       .meaning = "of the surface, HBW of normalised steel and cast iron, else HV; the table has a range for each kind and quality",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_grades<of_both>(d, m, [&](MaterialGrade& g) { g.hardness = v.number; }); }},
      {.path = name + "core_hardness", .range = {.low = 25.0, .high = 60.0}, .fallback = of_both ? "(25)" : none,
       .meaning = "HRC, of case_hardened MQ alone: from 30 on its sigma_Flim is 500 MPa, below 425 MPa",
       .store = [](StudyBuilder& d, Member m, const Value& v) { change_grades<of_both>(d, m, [&](MaterialGrade& g) { g.core_hardness = v.number; }); }},
  });
}

}  // namespace

std::vector<SchemaKey> life_rows() {
  std::vector<SchemaKey> rows{
      {.path = "load.speed", .quantity = Quantity::RotationalSpeed, .range = turning_speed, .fallback = "(none)",
       .meaning = "of the pinion; loss power and lubricant film need it",
       .store = [](Scene& s, Member, const Value& v) { s.speed = v.number; }},
      {.path = "load.application_factor", .range = load_factor_range, .fallback = "(1)",
       .meaning = "K_A of ISO 6336; K_A K_v multiplies the loads in damage, safety, film and flash temperature; 1 with a spectrum that has all loads",
       .store = [](StudyBuilder& d, Member, const Value& v) { life(d).application_factor = v.number; }},
      {.path = "load.dynamic_factor", .range = load_factor_range, .fallback = "(1)",
       .meaning = "K_v of ISO 6336-1, beside K_A",
       .store = [](StudyBuilder& d, Member, const Value& v) { life(d).dynamic_factor = v.number; }},
      {.path = "load.spectrum", .kind = TableListOrFile, .fallback = "(none)",
       .meaning = "loads that follow each other, instead of torque: each is a load case of every scene, and their damage is added up; { file = \"x.csv\" } reads them from columns of these names, { signal = \"x.csv\" } counts them from a torque over time",
       .hint = "",
       .store = [](StudyBuilder& d, Member, const Value&) { d.study.spectrum.emplace_back(); }},
      {.path = "load.spectrum[].torque", .quantity = Quantity::Torque, .range = within(1e9), .fallback = "(required)",
       .meaning = "on the pinion; above 0 it loads the pair's working flank and below 0 the other one, which a scene with the other working_flank rates; 0 is a time without load",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).torque = v.number; }},
      {.path = "load.spectrum[].speed", .quantity = Quantity::RotationalSpeed, .range = turning_speed, .fallback = "(load.speed)",
       .meaning = "of the pinion; hours need it",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).speed = v.number; }},
      {.path = "load.spectrum[].hours", .quantity = Quantity::Duration, .range = above_zero(1e7), .fallback = "(none)",
       .meaning = "how long this load acts; this or cycles is required",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).hours = v.number; }},
      {.path = "load.spectrum[].cycles", .range = above_zero(1e15), .fallback = "(from hours and speed)",
       .meaning = "revolutions of the pinion under this load",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).cycles = v.number; }},
      {.path = "load.spectrum[].temperature", .quantity = Quantity::Temperature, .range = oil_temperature, .fallback = "(lubricant.temperature)",
       .meaning = "of the oil under this load",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).temperature = v.number; }},
      {.path = "load.spectrum[].dynamic_factor", .range = load_factor_range, .fallback = "(load.dynamic_factor)",
       .meaning = "K_v under this load and speed",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).dynamic_factor = v.number; }},
      {.path = "load.spectrum[].mesh_misalignment", .quantity = Quantity::Deviation, .range = removal_range, .fallback = "(0)",
       .meaning = "F_beta_y that this load adds to the scene's; + opens at +z",
       .store = [](StudyBuilder& d, Member, const Value& v) { bin(d).mesh_misalignment = v.number; }},
  };
  const std::vector<SchemaKey> files{
      {.path = "load.spectrum.file", .kind = Text, .fallback = "(none)",
       .meaning = "CSV file of the loads, its path from the folder of the study file",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).file = v.text; }},
      {.path = "load.spectrum.signal", .kind = Text, .fallback = "(none)",
       .meaning = "CSV file of the pinion's torque over time: columns time (s), torque (N·m; + loads the working flank, - the other one) and speed (rpm; without it load.speed)",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).signal = v.text; }},
      {.path = "load.spectrum.counting", .kind = Word, .words = {"time_at_level", "rainflow"}, .fallback = "(time_at_level)",
       .meaning = "of a signal: revolutions under each torque, or swings of the torque, which load teeth only where the same teeth stay in mesh",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).counting = static_cast<LoadCounting>(v.integer); }},
      {.path = "load.spectrum.bins", .kind = Integer, .range = {.low = 1, .high = 200}, .fallback = "(20)",
       .meaning = "equal ranges of torque that a signal is counted in; each is a load case of every scene, with the largest torque that occurs in it",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).bins = static_cast<int>(v.integer); }},
      {.path = "load.spectrum.hours", .quantity = Quantity::Duration, .range = above_zero(1e7), .fallback = "(that of the signal)",
       .meaning = "life that the signal is repeated for",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).hours = v.number; }},
      {.path = "load.spectrum.repeats", .range = above_zero(1e12), .fallback = "(1)",
       .meaning = "how often the signal occurs, instead of hours",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).repeats = v.number; }},
      {.path = "load.spectrum.torque_factor", .range = within(1e6), .fallback = "(1)",
       .meaning = "pinion torque over that of the signal; -1 with working_flank = \"left\" rates the other flank under the same signal",
       .store = [](StudyBuilder& d, Member, const Value& v) { source(d).torque_factor = v.number; }},
  };
  rows.insert(rows.end(), files.begin(), files.end());
  constexpr auto contact_meaning = "sigma_Hlim that the flank bears for the cycles at the knee, with the factors of lubricant, speed, roughness, hardness and size in it";
  constexpr auto root_meaning = "nominal sigma_Flim, with the relative factors of notch, surface and size in it; a fillet's own stress may reach twice that, Y_ST = 2";
  append_grade<true>(rows, "");
  append_curve<&LifeTable::contact, true>(rows, "", "contact", contact_meaning);
  append_curve<&LifeTable::root, true>(rows, "", "root", root_meaning);
  rows.push_back({.path = "gear.meshes_per_revolution", .kind = Integer, .range = {.low = 1, .high = 100}, .fallback = "(1, with [unit] those of this gear on the same flank)",
                  .meaning = "load cycles of each tooth in a revolution of its gear, where several gears load the same flank as much as the one of this pair",
                  .store = [](StudyBuilder& d, Member m, const Value& v) { life(d).meshes_per_revolution[m] = static_cast<int>(v.integer); }});
  append_grade<false>(rows, "gear.");
  append_curve<&LifeTable::contact, false>(rows, "gear.", "contact", contact_meaning);
  append_curve<&LifeTable::root, false>(rows, "gear.", "root", root_meaning);
  const std::vector<SchemaKey> oil{
      {.path = "lubricant.base", .kind = Word, .words = {"mineral", "polyalphaolefin", "polyglycol"}, .fallback = "(mineral)",
       .meaning = "base oil, which pressure-viscosity coefficient and friction depend on",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d).base = static_cast<BaseOil>(v.integer); }},
      {.path = "lubricant.viscosity_40", .quantity = Quantity::KinematicViscosity, .range = {.low = 1.0, .high = 10000.0}, .fallback = "(none; a lubricant needs it)",
       .meaning = "kinematic, at 40 deg C; above viscosity_100",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d).viscosity_40 = v.number; }},
      {.path = "lubricant.viscosity_100", .quantity = Quantity::KinematicViscosity, .range = {.low = 1.0, .high = 1000.0}, .fallback = "(none; a lubricant needs it)",
       .meaning = "kinematic, at 100 deg C",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d).viscosity_100 = v.number; }},
      {.path = "lubricant.density", .quantity = Quantity::Density, .range = {.low = 500.0, .high = 2000.0}, .fallback = "(890)",
       .meaning = "at 15 deg C",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d).density_15 = v.number; }},
      {.path = "lubricant.temperature", .quantity = Quantity::Temperature, .range = oil_temperature, .fallback = "(none; a lubricant needs it)",
       .meaning = "of the oil in the gearbox",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d).temperature = v.number; }},
      {.path = "lubricant.roughness", .quantity = Quantity::Deviation, .range = above_zero(100.0), .fallback = "(none; a lubricant needs it)",
       .meaning = "Ra, mean of both flanks",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d); life(d).roughness = v.number; }},
      {.path = "lubricant.bulk_temperature", .quantity = Quantity::Temperature, .range = oil_temperature, .fallback = "(ISO/TS 6336-22, formerly ISO/TR 15144-1: without tip relief, injected oil)",
       .meaning = "of the teeth",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d); life(d).bulk_temperature = v.number; }},
      {.path = "lubricant.permissible_film", .range = above_zero(100.0), .fallback = "(none)",
       .meaning = "lambda_GFP from a test of this oil: micropitting safety is the least specific film thickness over it",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d); life(d).permissible_film = v.number; }},
      {.path = "lubricant.scuffing_temperature", .quantity = Quantity::Temperature, .range = {.low = -50.0, .high = 2000.0}, .fallback = "(none)",
       .meaning = "theta_S of ISO/TS 6336-20 from a test of this oil: scuffing safety is its distance from the oil's temperature over that of the largest contact temperature",
       .store = [](StudyBuilder& d, Member, const Value& v) { lubricant(d); life(d).scuffing_temperature = v.number; }},
  };
  rows.insert(rows.end(), oil.begin(), oil.end());
  return rows;
}

// clang-format on

}  // namespace flankwright::studies
