#include "studies/results/drawing.hpp"

#include <algorithm>
#include <cmath>

#include "core/flank/flank.hpp"
#include "optimize/design/problem/design_task.hpp"
#include "studies/analysis/study_effects.hpp"
#include "studies/results/drawing_lines.hpp"
#include "studies/results/drawing_sheet.hpp"

namespace flankwright::studies {

namespace {

constexpr int stations = 161;  // of a trace; where a relief begins its corner is cut by at most one of the steps

double part(int i) { return static_cast<double>(i) / (stations - 1); }

/// A relief over no height or length removes nothing.
void remove_relief(Modification& modification, std::string_view extent) {
  for (const ModificationDescriptor& amount : modification_parameters) {
    if (amount.extent == extent) amount.set(modification, 0.0);
  }
}

/// A flank and what it is where a single amount lies at one end of its tolerance and the others at their design.
class TolerancedFlank {
 public:
  TolerancedFlank(const GearPair& pair, Member member, const Modification& modification, const std::vector<AmountTolerance>& amounts)
      : design_(make_flank(pair, member, modification, {})) {
    for (const AmountTolerance& tolerance : amounts) {
      const auto moved_by = [&](double difference) {
        const ModificationDescriptor& d = *find_parameter(tolerance.key);
        Modification moved = modification;
        const double design = d.get(modification), value = design + allowed_deviation(d, design, difference);
        d.set(moved, value);
        if (d.kind == ParameterKind::Extent && !(value > 0.0)) remove_relief(moved, d.key);
        return make_flank(pair, member, moved, {});
      };
      ends_.push_back({moved_by(tolerance.low), moved_by(tolerance.high)});
    }
  }

  double roll_at(double radius) const { return design_.roll_at(radius); }

  /// @param half  of the class' band [mm]
  void add_to(FlankTrace& trace, double along, double rho, double z, double half) const {
    const double removed = design_.deviation(rho, z, 0);
    double low = -removed - half, high = -removed + half;
    for (const auto& [at_low, at_high] : ends_) {
      const auto [least, most] = std::minmax({0.0, removed - at_low.deviation(rho, z, 0), removed - at_high.deviation(rho, z, 0)});
      low += least;
      high += most;
    }
    trace.along.push_back(along);
    trace.deviation.push_back(-removed);
    trace.low.push_back(low);
    trace.high.push_back(high);
  }

 private:
  struct Ends {
    Flank at_low, at_high;
  };
  Flank design_;
  std::vector<Ends> ends_;  ///< of each tolerance
};

FlankTrace profile_at(const Gear& gear, const TolerancedFlank& flank, double z, double total) {
  FlankTrace trace{.at = z, .along = {}, .deviation = {}, .low = {}, .high = {}};
  for (int i = 0; i < stations; ++i) {
    const double rho = flank.roll_at(gear.active_root_radius + (gear.tip_form_radius - gear.active_root_radius) * part(i));
    flank.add_to(trace, rho, rho, z, 0.5 * total);
  }
  return trace;
}

FlankTrace helix_at(const Gear& gear, const TolerancedFlank& flank, double r, double total) {
  FlankTrace trace{.at = r, .along = {}, .deviation = {}, .low = {}, .high = {}};
  for (int i = 0; i < stations; ++i) {
    const double z = (part(i) - 0.5) * gear.data.face_width;
    flank.add_to(trace, z, flank.roll_at(r), z, 0.5 * total);
  }
  return trace;
}

Json traces_json(const std::vector<FlankTrace>& traces, const char* at, const char* along) {
  return list(traces, [&](const FlankTrace& trace) -> Json {
    return {{at, trace.at},
            {along, trace.along},
            {"deviation_um", list(trace.deviation, in_um)},
            {"band_low_um", list(trace.low, in_um)},
            {"band_high_um", list(trace.high, in_um)}};
  });
}

/// Least and largest value of what scatters, in its own unit.
std::pair<double, double> limits_of(const Distribution& distribution) {
  // A normal distribution has none. As for slopes within a class, three standard deviations are the tolerance.
  static const double beyond = normal_probability(-3.0);
  constexpr double at_the_end = 1e-12;
  const bool is_normal = distribution.kind() == Distribution::Kind::Normal;
  std::pair limits{distribution.quantile(is_normal ? beyond : at_the_end), distribution.quantile(1.0 - (is_normal ? beyond : at_the_end))};
  for (int level = 0; level < distribution.levels(); ++level) {  // of listed values, in any order
    const double value = distribution.quantile((level + 0.5) / distribution.levels());
    limits = {std::min(limits.first, value), std::max(limits.second, value)};
  }
  return limits;
}

/// Tolerances of a gear's modification that the study gives by itself; those of its class are in the band of the class.
std::vector<AmountTolerance> given_tolerances(const Study& study, Member member, const Modification& modification) {
  const std::string table = std::string(name_of(member)) + ".modification.";
  std::vector<AmountTolerance> all;
  for (const SceneTolerance& tolerance : study.tolerances) {
    if (tolerance.of_class || !tolerance.path.starts_with(table)) continue;
    const ModificationDescriptor* d = find_parameter(std::string_view(tolerance.path).substr(table.size()));
    if (d == nullptr) continue;
    const auto [low, high] = limits_of(tolerance.distribution);
    const double unit = 1.0 / outside_factor(d->kind), design = tolerance.added ? 0.0 : d->get(modification);
    all.push_back({std::string(d->key), low * unit - design, high * unit - design});
  }
  return all;
}

/// Whether the flanks of a gear are ground together, by what finishes them or because scenes load both.
bool ties_flanks(const Study& study, const Modification& modification) {
  if (modification.topography) return false;  // a grid belongs to one flank
  return modification.process.kind == GrindingKind::GeneratingGrinding ||
         std::ranges::any_of(study.scenes, [&](const Scene& scene) { return loads_other_flanks(study, scene); });
}

}  // namespace

FlankDrawing make_drawing(const GearPair& pair, Member member, const Modification& modification, const DrawingTerms& terms) {
  const Gear& gear = pair[member];
  const TolerancedFlank flank(pair, member, modification, terms.amounts);
  FlankDrawing drawing;
  drawing.gear = std::string(name_of(member));
  drawing.tolerance_class = terms.tolerance_class;
  drawing.base_radius = gear.base_radius;
  drawing.tolerances = flank_tolerances(ToleranceData::of(pair, member), terms.tolerance_class);
  const FlankTolerances& t = drawing.tolerances;
  for (const double share : {-0.4, 0.0, 0.4}) drawing.profiles.push_back(profile_at(gear, flank, share * gear.data.face_width, t.profile_total));
  // In the middle of the profile, in roll length, the lead is as asked for.
  const double start = gear.roll_length_at(gear.active_root_radius), tip = gear.roll_length_at(gear.tip_form_radius);
  for (const double share : {0.1, 0.5, 0.9}) {
    drawing.helices.push_back(helix_at(gear, flank, std::hypot(gear.base_radius, start + share * (tip - start)), t.helix_total));
  }
  drawing.lines = drawing_lines(pair, member, modification, t, terms);
  return drawing;
}

std::vector<FlankDrawing> drawings_of(const StudyResults& results) {
  const Study& study = results.study;
  const std::optional<int> tolerance_class = study.drawing_class ? study.drawing_class : study.tolerance_class;
  std::vector<FlankDrawing> drawings;
  if (!tolerance_class) return drawings;
  const PerGear<Modification> ground = results.designs.empty() ? analysed_modification(study, results.effects) : results.designs.back().modification;
  for (const Member member : {Member::Pinion, Member::Wheel}) {
    const Modification &modification = ground[member], &given = study.modification[member];
    // Where the process leaves no trace on the flank, the analysis is without it; the sheet names it all the same.
    const GrindingProcess& process = modification.process.kind == GrindingKind::None ? given.process : modification.process;
    drawings.push_back(make_drawing(results.pair, member, modification,
                                    {*tolerance_class, given_tolerances(study, member, modification), process, ties_flanks(study, given)}));
  }
  return drawings;
}

Json drawing_json(const FlankDrawing& drawing) {
  return {{"gear", drawing.gear},
          {"iso_1328_class", drawing.tolerance_class},
          {"profile_band_um", in_um(drawing.tolerances.profile_total)},
          {"helix_band_um", in_um(drawing.tolerances.helix_total)},
          {"profiles", traces_json(drawing.profiles, "z_mm", "roll_length_mm")},
          {"helices", traces_json(drawing.helices, "radius_mm", "z_mm")},
          {"lines", drawing.lines},
          {"sheet", drawing_svg(drawing)}};
}

}  // namespace flankwright::studies
