#include "studies/base/version.hpp"
#include "studies/exchange/rexs/rexs_export.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

#include "core/flank/flank.hpp"
#include "core/gear/both_gears.hpp"
#include "core/flank/natural_twist.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/study_file/grid_file.hpp"
#include "studies/exchange/rexs/model_builder.hpp"
#include "studies/exchange/rexs/study_text.hpp"

namespace flankwright::studies::rexs {

namespace {

constexpr std::array<std::string_view, 9> versions{"1.0", "1.1", "1.2", "1.3", "1.4", "1.5", "1.6", "1.7", "2.0"};
constexpr int topography_points = 25;  ///< along the profile and along the face, where no grid says otherwise

class Export : private ModelBuilder {
 public:
  Export(const Study& study, const RexsExportOptions& options)
      : ModelBuilder(options.version),
        study_(study),
        pair_(make_gear_pair(study.pair)),
        modification_(analysed_modification(study, study_effects(study))) {
    if (std::ranges::find(versions, options.version) == versions.end()) {
      throw InvalidInput("version of REXS", options.version, fmt::format("{}", fmt::join(versions, ", ")));
    }
    model().application = "Flankwright";
    model().application_version = version();
    model().date = options.date;
  }

  ExportedStage stage() {
    const int unit = unit_ = add("gear_unit", study_.title);
    const int stage = stage_ = add("cylindrical_stage", study_.title);
    length("center_distance", pair_.centre_distance);
    length("common_face_width", pair_.face_width);
    const std::array<int, 2> gears{add_gear(Member::Pinion), add_gear(Member::Wheel)};
    relate("assembly", {{unit, "assembly", "gear_unit"}, {stage, "part", "cylindrical_stage"}});
    relate("stage", {{stage, "stage", "cylindrical_stage"}, {gears[0], "gear_1", "cylindrical_gear"}, {gears[1], "gear_2", "cylindrical_gear"}});
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const int gear = gears[m == Member::Pinion ? 0 : 1];
      add_data(m, stage, gear);
      add_flanks(m, gear);
      add_material(m, gear);
    }
    add_oil();
    if (study_.spectrum.empty()) {
      add_load_cases();
    } else {
      add_spectrum(gears[0]);
    }
    add_notes();
    result_.model = std::move(model());
    return std::move(result_);
  }

 private:
  const Modification& modification(Member m) const { return modification_[m]; }
  const GivenGrid& grid(Member m) const { return study_.grid[m]; }

  int add_gear(Member m) {
    const Gear& gear = pair_[m];
    const int id = add("cylindrical_gear", name_of(m));
    attribute("number_of_teeth", "none", ValueType::Integer, std::to_string(gear.data.teeth));
    length("normal_module", study_.pair.normal_module);
    angle("helix_angle_reference_diameter", gear.hand == Hand::Right ? study_.pair.helix_angle : -study_.pair.helix_angle);
    length("face_width", gear.data.face_width);
    length("tip_diameter", 2.0 * gear.tip_radius);
    length("tip_form_diameter", 2.0 * gear.tip_form_radius);
    length("root_diameter", 2.0 * gear.root_radius);
    length("root_form_diameter", 2.0 * gear.form_radius);
    if (const double amount = gear.data.end_chamfer.amount; amount > 0.0) length("chamfer_at_tooth_end", amount);
    word("datum_face_orientation", "negative");
    return id;
  }

  void add_data(Member m, int stage, int gear) {
    const std::string type = before("1.3") ? "stage_gear_data" : "cylindrical_stage_gear_data";
    const int id = add(type);
    flag("is_driving_gear", study_.pair.driver == m);
    word("loaded_tooth_flank", name_of(study_.pair.working_flank));
    length("active_root_diameter", 2.0 * pair_[m].active_root_radius);
    length("active_tip_diameter", 2.0 * pair_[m].tip_form_radius);
    const double ratio = m == Member::Pinion ? 1.0 : pair_.gear_ratio();
    if (study_.torques.front() > 0.0) torque("torque", ratio * study_.torques.front());
    relate("stage_gear_data", {{stage, "stage", "cylindrical_stage"}, {gear, "gear", "cylindrical_gear"}, {id, "stage_gear_data", type}});
    if (m == Member::Pinion) pinion_data_ = id;
  }

  int add_flank(Member m, const std::string& side) {
    const int id = add(before("1.3") ? "flank_geometry" : "cylindrical_gear_flank", (m == Member::Pinion ? "pinion, " : "wheel, ") + side + " flank");
    angle("normal_pressure_angle", study_.pair.pressure_angle);
    number("addendum_modification_coefficient", pair_[m].data.profile_shift);
    number("addendum_coefficient_basic_profile", pair_[m].data.rack.addendum);
    if (const double amount = pair_[m].data.tip_chamfer.amount; amount > 0.0) length("tooth_tip_chamfer", amount);
    return id;
  }

  void add_flanks(Member m, int gear) {
    const int left = add_flank(m, "left"), right = add_flank(m, "right");
    const std::string type = model().components.back().type;
    relate("flank", {{gear, "gear", "cylindrical_gear"}, {left, "left", type}, {right, "right", type}});
    const RackProfile& rack = pair_[m].data.rack;
    const int tool = add("rack_shaped_tool");
    number("addendum_coefficient_reference_profile", rack.dedendum);
    number(before("2.0") ? "tip_radius_factor" : "tip_corner_radius_factor_reference_profile", rack.root_radius);
    if (before("1.3")) {
      relate("ordered_reference", {{gear, "origin", "cylindrical_gear"}, {tool, "referenced", "rack_shaped_tool"}}, 1);
    } else {
      const std::string settings_type = "cylindrical_gear_manufacturing_settings";
      for (const int flank : {left, right}) {
        const int settings = add(settings_type);
        number("generated_addendum_modification_coefficient", pair_[m].generating_profile_shift);
        length("machining_allowance", 0.0);
        relate("manufacturing_step",
               {{flank, "workpiece", type}, {tool, "tool", "rack_shaped_tool"}, {settings, "manufacturing_settings", settings_type}}, 1);
      }
    }
    flank_ = study_.pair.working_flank == WorkingFlank::Right ? right : left;
    flank_type_ = type;
    add_modifications(m);
  }

  /// A component at the working flank; its attributes follow.
  void add_modification(const std::string& type) {
    const int id = add(type);
    relate("reference", {{flank_, "origin", flank_type_}, {id, "referenced", type}});
    flag("is_additive_modification", true);
  }

  /// A component for every modification that the format has one for; the others become points of a topography.
  void add_modifications(Member m) {
    Modification rest = modification(m);
    rest.topography = rest.opposite_topography = nullptr;
    rest.process = {};  // its twist is that of all lead modifications, see add_topography()
    for_each_modification(modification(m), [&]<class Part>(const Part& part) {
      if constexpr (requires { this->write(m, part); }) {
        if (removes_something(part)) this->write(m, part);
        static_cast<Part&>(rest) = {};
      }
    });
    add_topography(m, rest);
  }

  template <class Part>
  static bool removes_something(const Part& part) {
    return std::ranges::any_of(Part::parameters(), [&](const auto& row) { return row.text.kind != ParameterKind::Extent && row.get(part) != 0.0; });
  }

  double half_face(Member m) const { return 0.5 * pair_[m].data.face_width; }
  double tip(Member m) const { return 2.0 * pair_[m].tip_form_radius; }
  double root(Member m) const { return 2.0 * pair_[m].active_root_radius; }

  void write(Member m, const modifications::LeadCrowning& part) {
    add_modification("helix_crowning");
    length("helix_crowning_amount_datum_face", part.lead_crowning);
    length("helix_crowning_amount_non_datum_face", part.lead_crowning);
    length("coordinate_where_helix_crowning_is_specified_datum_face", -half_face(m));
    length("coordinate_where_helix_crowning_is_specified_non_datum_face", half_face(m));
    length("helix_highest_point", 0.0);
    word("shape_of_helix_crowning", "parabolic");
  }
  void write(Member m, const modifications::LeadSlope& part) {
    add_modification("helix_slope");
    length("helix_slope", part.lead_slope);
    length("helix_evaluation_start", -half_face(m));
    length("helix_evaluation_end", half_face(m));
  }
  void write(Member m, const modifications::ProfileCrowning& part) {
    add_modification("profile_crowning");
    length("profile_crowning_at_tip", part.addendum_crowning);
    length("profile_crowning_at_root", part.dedendum_crowning);
    length("diameter_where_profile_crowning_tip_is_specified", tip(m));
    length("diameter_where_profile_crowning_root_is_specified", root(m));
    length("profile_highest_point", 2.0 * pair_[m].working_pitch_radius);
    word("shape_of_profile_crowning", "parabolic");
  }
  void write(Member m, const modifications::ProfileSlope& part) {
    add_modification("profile_slope");
    length("profile_slope", part.profile_slope);
    length("profile_evaluation_start", root(m));
    length("profile_evaluation_end", tip(m));
  }
  void write(Member m, const modifications::TipRelief& part) {
    add_relief("tip_relief", part.tip_relief, tip(m) - 2.0 * part.tip_relief.height, tip(m));
  }
  void write(Member m, const modifications::RootRelief& part) {
    add_relief("root_relief", part.root_relief, root(m) + 2.0 * part.root_relief.height, root(m));
  }
  void write(Member m, const modifications::TriangularTipRelief& part) {
    add_relief("triangular_tip_relief", part.triangular_tip_relief, tip(m) - 2.0 * part.triangular_tip_relief.height, tip(m));
  }
  void write(Member m, const modifications::TriangularRootRelief& part) {
    add_relief("triangular_root_relief", part.triangular_root_relief, root(m) + 2.0 * part.triangular_root_relief.height, root(m));
  }
  void write(Member m, const modifications::EndReliefs& part) {
    for (const auto& [side, end] : {std::pair{std::string("datum_face"), -half_face(m)}, std::pair{std::string("non_datum_face"), half_face(m)}}) {
      add_modification("end_relief_" + side);
      length("end_relief_depth_" + side, part.end_relief.amount);
      length("end_relief_length_" + side, part.end_relief.length);
      length("end_relief_evaluation_reference_" + side, end);
      word("shape_of_relief", "linear");
    }
  }
  void write(Member m, const modifications::Twist& part) {
    add_modification("profile_twist");
    length("profile_twist", part.twist);
    length("position_of_profile_twist_datum_face", -half_face(m));
    length("position_of_profile_twist_non_datum_face", half_face(m));
  }

  void add_relief(const std::string& name, const ProfileRelief& relief, double datum_diameter, double end_diameter) {
    add_modification(name);
    length(name + "_depth", relief.amount);
    length(name + "_datum_diameter", datum_diameter);
    length(name + "_evaluation_reference", end_diameter);
    word("shape_of_relief", relief.shape == ReliefShape::Linear ? "linear" : "parabolic");
    flag("specify_tangential_transition", false);
  }

  /// Everything of a flank that no component of the format says.
  /// @param rest  modifications without a component
  void add_topography(Member m, const Modification& rest) {
    Flank flank = make_flank(pair_, m, rest, {});
    if (auto twist = make_natural_twist_field(pair_, m, modification(m))) flank.fields.push_back(std::move(twist));
    const bool other = !flank.fields.empty() || flank.modification != Modification{};
    MeasuredGrid points;
    if (!grid(m).file.empty()) {
      points = read_grid((std::filesystem::path(study_.file).parent_path() / grid(m).file).string());
    } else if (other) {
      points = even_points(m);
    } else {
      return;
    }
    std::vector<double> z, diameters, amounts;
    for (std::size_t i = 0; i < points.radii.size(); ++i) {
      for (std::size_t j = 0; j < points.z.size(); ++j) {
        double amount = -points.deviation(static_cast<Eigen::Index>(i), static_cast<Eigen::Index>(j)) / std::cos(pair_.base_helix_angle);
        for (const auto& field : flank.fields) amount += field->at(flank.roll_at(points.radii[i]), points.z[j]).value;
        amount += removal(flank.modification, flank.frame, points.radii[i], points.z[j]);
        z.push_back(points.z[j]);
        diameters.push_back(2.0 * points.radii[i]);
        amounts.push_back(amount);
      }
    }
    add_modification("topographical_modification");
    lengths("coordinates_of_topographical_modification", z);
    lengths("diameters_of_topographical_modification", diameters);
    lengths("topographical_modification_amounts", amounts);
    word("type_of_interpolation_topographical_modification", "spline");
    if (other) {
      result_.notes.push_back(fmt::format("{}: what no component of the format says is exported as {} points of a topographical_modification",
                                          name_of(m), amounts.size()));
    }
  }

  /// Over the active flank, without deviation.
  MeasuredGrid even_points(Member m) const {
    MeasuredGrid points;
    const Gear& gear = pair_[m];
    for (int i = 0; i < topography_points; ++i) {
      const double share = static_cast<double>(i) / (topography_points - 1);
      points.radii.push_back(std::lerp(gear.active_root_radius, gear.tip_form_radius, share));
      points.z.push_back((share - 0.5) * gear.data.face_width);
    }
    points.deviation = Eigen::MatrixXd::Zero(topography_points, topography_points);
    return points;
  }

  void add_material(Member m, int gear) {
    const Material& material = study_.material[m];
    const int id = add("material");
    attribute("elastic_modulus", before("2.0") ? "N / mm^2" : "MPa", ValueType::Number, number_text(material.youngs_modulus));
    number("poisson_ratio", material.poissons_ratio);
    relate("reference", {{gear, "origin", "cylindrical_gear"}, {id, "referenced", "material"}});
  }

  void add_load_cases() {
    std::vector<double> torques;
    for (const Scene& scene : study_.scenes) {
      for (const double torque : scene.torques) {
        if (std::ranges::find(torques, torque) == torques.end()) torques.push_back(torque);
      }
    }
    if (torques.size() < 2) return;
    for (const double torque : torques) {
      Component varied{.id = pinion_data_, .type = model().find(pinion_data_)->type};
      varied.attributes.push_back({"torque", "N m", ValueType::Number, number_text(torque / units::newton_metre)});
      model().load_cases.push_back({static_cast<int>(model().load_cases.size()) + 1, {varied}});
    }
  }

  /// Torque, speed, time and temperature of each bin, at the components that the format has them for.
  void add_spectrum(int pinion) {
    const int shaft = add("shaft", "pinion shaft");
    relate("assembly", {{shaft, "assembly", "shaft"}, {pinion, "part", "cylindrical_gear"}});
    const auto vary = [this](LoadCase& load_case, int component, const char* id, const char* unit, double value) {
      Component varied{.id = component, .type = model().find(component)->type};
      varied.attributes.push_back({id, unit, ValueType::Number, number_text(value)});
      load_case.components.push_back(std::move(varied));
    };
    bool says_all = true;
    for (const SpectrumBin& bin : study_.spectrum) {
      LoadCase load_case{static_cast<int>(model().load_cases.size()) + 1, {}};
      vary(load_case, pinion_data_, "torque", "N m", bin.torque / units::newton_metre);
      constexpr double rpm = units::pi / 30.0, hour = 3600.0;
      const double time = std::isnan(bin.hours) ? bin.cycles * 2.0 * units::pi / bin.speed : bin.hours;  // s
      if (!std::isnan(bin.speed)) vary(load_case, shaft, "rotational_speed", "1 / min", bin.speed / rpm);
      if (!std::isnan(time)) vary(load_case, unit_, before("1.3") ? "load_duration" : "operating_time", "h", time / hour);
      if (!std::isnan(bin.temperature)) vary(load_case, stage_, "temperature_lubricant", "C", bin.temperature);
      says_all = says_all && !std::isnan(time) && bin.mesh_misalignment == 0.0 && std::isnan(bin.dynamic_factor);
      model().load_cases.push_back(std::move(load_case));
    }
    if (!says_all) {
      result_.notes.push_back(
          "of the load spectrum, what the format has no attribute for is not exported: cycles without a speed, K_v and misalignment of single bins");
    }
  }

  void add_oil() {
    const LifeTable& life = study_.life;
    if (!life.has_lubricant) return;
    for (Component& component : model().components) {
      if (component.id == stage_)
        component.attributes.push_back({"temperature_lubricant", "C", ValueType::Number, number_text(life.lubricant.temperature)});
      const bool has_roughness = component.type == "cylindrical_gear" && !std::isnan(life.roughness);
      const char* const roughness = before("1.3") ? "arithmetic_average_roughness_flank" : "arithmetic_mean_roughness_flank_iso_4287_1997";
      if (has_roughness) component.attributes.push_back({roughness, "mum", ValueType::Number, number_text(life.roughness / units::um)});
    }
    const int oil = add("lubricant");
    relate("reference", {{stage_, "origin", "cylindrical_stage"}, {oil, "referenced", "lubricant"}});
    word("kind", "oil");
    const BaseOil base = life.lubricant.base;
    word("lubricant_type_iso_6336_2019", base == BaseOil::Mineral           ? "mineral_oil"
                                         : base == BaseOil::Polyalphaolefin ? "polyalfaolefin"
                                                                            : "water_soluble_polyglycol");
    attribute("viscosity_at_40_degree_celsius", "mm^2 / s", ValueType::Number, number_text(life.lubricant.viscosity_40));
    attribute("viscosity_at_100_degree_celsius", "mm^2 / s", ValueType::Number, number_text(life.lubricant.viscosity_100));
    attribute("density_at_15_degree_celsius", "kg / dm^3", ValueType::Number, number_text(life.lubricant.density_15 * 1e-3));
  }

  void add_notes() {
    result_.notes.push_back("modifications are those of the working flanks; the flanks at the back are exported without");
    if (before("1.3")) result_.notes.push_back("modifications are part of the format since 1.3; older readers pass over them");
    const bool has_allowance = pair_.pinion.data.tooth_thickness_allowance != 0.0 || pair_.wheel.data.tooth_thickness_allowance != 0.0;
    if (before("1.3") && has_allowance) result_.notes.push_back("tooth thickness allowances are part of the format since 1.3: left out");
    result_.notes.push_back(
        fmt::format("misalignment, shafts, {}errors of teeth, strength, K_A and K_v are not exported", study_.spectrum.empty() ? "speed, " : ""));
    for (const Member m : both_gears) note_edges(m);
  }

  /// The format has amounts of chamfers alone. An import takes the usual edge for the rest.
  void note_edges(Member m) {
    const GearData& gear = pair_[m].data;
    const double usual = usual_edge_radius(m, pair_.data);
    const auto is_usual = [&](double radius) { return std::abs(radius - usual) < 1e-9 * pair_.data.normal_module; };  // round-off
    const auto note = [&](const std::string& what) {
      result_.notes.push_back(fmt::format("{}: {}, which the format has no attribute for, is not exported", name_of(m), what));
    };
    if (gear.end_chamfer.amount == 0.0 && !is_usual(gear.end_rounding)) note(fmt::format("an end rounding of {:g} mm", gear.end_rounding));
    for (const auto& [chamfer, name] : {std::pair{&gear.tip_chamfer, "tip"}, std::pair{&gear.end_chamfer, "end"}}) {
      if (chamfer->amount > 0.0 && chamfer->angle != EdgeChamfer{}.angle)
        note(fmt::format("the angle of the {} chamfer, {:g} deg", name, chamfer->angle / units::deg));
    }
  }

  const Study& study_;
  GearPair pair_;
  PerGear<Modification> modification_;  ///< with the process that was analysed
  ExportedStage result_;
  int unit_{0}, stage_{0}, flank_{0}, pinion_data_{0};
  std::string flank_type_;
};

}  // namespace

ExportedStage export_stage(const Study& study, const RexsExportOptions& options) { return Export(study, options).stage(); }

}  // namespace flankwright::studies::rexs
