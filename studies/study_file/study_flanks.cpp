#include "studies/study_file/study_flanks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <map>
#include <memory>
#include <utility>

#include "core/gear/both_gears.hpp"
#include "core/flank/measured_grid.hpp"
#include "studies/study_file/grid_file.hpp"

namespace flankwright::studies {

namespace {

/// A kind of generation, the keys that it needs and those that it may have.
struct GenerationKind {
  std::string_view name;
  std::vector<std::string_view> needed, optional;
};

const std::array<GenerationKind, 3>& generation_kinds() {
  static const std::array<GenerationKind, 3> kinds{
      {{"rack", {}, {}}, {"parabolic_rack", {"coefficient"}, {}}, {"revolution", {"half_apex", "distance"}, {"arc_radius"}}}};
  return kinds;
}

std::string keys_in_words(const GenerationKind& kind) {
  std::string words = "kind";
  for (const auto& keys : {kind.needed, kind.optional}) {
    for (const std::string_view key : keys) words.append(", ").append(key);
  }
  return words;
}

/// True where every key below `path` is one that the kind needs or may have, and none is missing.
bool check_generation_keys(StudyReading& reading, const std::string& path, const GenerationKind& kind) {
  const std::size_t before = reading.problems.size();
  const auto has = [](const std::vector<std::string_view>& keys, std::string_view key) { return std::ranges::find(keys, key) != keys.end(); };
  for (const std::string_view key : kind.needed) {
    const std::string missing = path + "." + std::string(key);
    if (reading.find(missing) != nullptr) continue;
    reading.refuse(reading.where(missing), missing, nullptr,
                   "required for kind \"" + std::string(kind.name) + "\": allowed is " + allowed_values(*study_keys().at(missing)));
  }
  for (const auto& [given, match] : reading.matches) {
    if (!given.starts_with(path + ".")) continue;
    const std::string_view key = std::string_view(given).substr(path.size() + 1);
    if (key == "kind" || has(kind.needed, key) || has(kind.optional, key)) continue;
    reading.refuse(match.position, given, match.node,
                   "has no meaning for kind \"" + std::string(kind.name) + "\": allowed are " + keys_in_words(kind));
  }
  return reading.problems.size() == before;
}

Generation generation_of(const GenerationKeys& keys) {
  if (keys.kind == "parabolic_rack") return ParabolicRack{keys.coefficient};
  if (keys.kind != "revolution") return StraightRack{};
  RevolutionTool tool{keys.half_apex, keys.distance};
  if (!std::isnan(keys.arc_radius)) tool.arc_radius = keys.arc_radius;
  return tool;
}

void read_generation(StudyReading& reading, const std::string& path, const GenerationKeys& keys, GearData& gear) {
  const Match* match = reading.find(path);
  if (match == nullptr || !match->node->is_table()) return;
  const std::string kind_key = path + ".kind";
  if (reading.find(kind_key) == nullptr) {
    reading.refuse(match->position, kind_key, nullptr, "required: allowed is " + allowed_values(*study_keys().at(kind_key)));
    return;
  }
  const auto kind = std::ranges::find(generation_kinds(), keys.kind, &GenerationKind::name);
  if (kind == generation_kinds().end()) return;  // refused where it was read
  if (check_generation_keys(reading, path, *kind)) gear.generation = generation_of(keys);
}

/// The grid of one gear, as the study and the file say it.
class GridReading {
 public:
  GridReading(StudyReading& reading, const GearPair& pair, Member member)
      : reading_(reading), pair_(pair), member_(member), prefix_(member == Member::Pinion ? "pinion.modification." : "wheel.modification.") {}

  /// The fitted field of each flank that has one, and what is to be said about it; problems go to the reading.
  void read(Modification& modification, GivenGrid& own, GivenGrid& opposite) const {
    const Match *of_own = reading_.find(prefix_ + "grid"), *of_opposite = reading_.find(prefix_ + "grid_of_opposite_flank");
    if (of_own == nullptr && of_opposite == nullptr) return check_smoothing_alone();
    if (of_own != nullptr) modification.topography = read(*of_own, own);
    if (of_opposite != nullptr) modification.opposite_topography = read(*of_opposite, opposite);
  }

  /// The fields of single teeth, one a file; null for "".
  std::vector<std::shared_ptr<const DeviationField>> read_teeth(const std::vector<std::string>& files) const {
    const std::string key = name_of(member_) + std::string(".error.grids");
    const Match* match = reading_.find(key);
    if (match == nullptr) return {};
    const int teeth = pair_[member_].data.teeth;
    if (static_cast<int>(files.size()) != teeth) {
      const std::string allowed = "allowed is a list of " + std::to_string(teeth) + ", one for each tooth";
      reading_.refuse(match->position, key, match->node, allowed);
      return {};
    }
    std::map<std::string, std::shared_ptr<const DeviationField>> fields{{"", nullptr}};
    for (const std::string& file : files) {
      if (!fields.try_emplace(file).second) continue;
      read(*match, file, {}, [&](const MeasuredGrid&, const GridFit& fit) { fields[file] = fit.field; });
    }
    std::vector<std::shared_ptr<const DeviationField>> of_teeth;
    for (const std::string& file : files) of_teeth.push_back(fields.at(file));
    return of_teeth;
  }

 private:
  std::shared_ptr<const DeviationField> read(const Match& match, GivenGrid& grid) const {
    std::shared_ptr<const DeviationField> field;
    read(match, grid.file, {grid.profile_pieces, grid.face_pieces}, [&](const MeasuredGrid& points, const GridFit& fit) {
      field = fit.field;
      grid.rows = static_cast<int>(points.radii.size());
      grid.columns = static_cast<int>(points.z.size());
      grid.lowest_radius = points.radii.front();
      grid.highest_radius = points.radii.back();
      grid.lowest_z = points.z.front();
      grid.highest_z = points.z.back();
      grid.rms = fit.rms;
      grid.largest = fit.largest;
    });
    return field;
  }

  /// Reads and fits a file and hands on what came out; problems go to the reading, at the key that names it.
  template <typename Use>
  void read(const Match& match, const std::string& file, const GridFitOptions& smoothing, Use&& use) const {
    // Relative to the study; on the command line, too, a study means the same wherever it is run from.
    const std::string path = (std::filesystem::path(reading_.document.name()).parent_path() / file).string();
    try {
      const MeasuredGrid points = read_grid(path);
      validate(points, pair_[member_].base_radius);
      check_coverage(points, pair_.flank_frame(member_));
      use(points, make_grid_field(points, pair_[member_].base_radius, pair_.base_helix_angle, smoothing));
    } catch (const StudyErrors& errors) {
      for (const StudyProblem& problem : errors.problems()) refuse_file(match, path, problem);
    } catch (const InvalidInput& problem) {
      refuse_grid(match, path, problem);
    }
  }

  /// A line of the grid file keeps its place there; a file that cannot be read has none.
  void refuse_file(const Match& match, const std::string& path, const StudyProblem& problem) const {
    if (problem.line > 0) {
      reading_.problems.push_back(problem);
    } else {
      reading_.refuse(match.position, match.path, match.node, path + ": " + problem.allowed);
    }
  }

  /// The points are numbers but no flank of this gear, or the smoothing does not suit them.
  void refuse_grid(const Match& match, const std::string& path, const InvalidInput& problem) const {
    constexpr std::string_view pieces = "grid.";
    const std::string& field = problem.field();
    const Match* smoothing = field.starts_with(pieces) ? reading_.find(prefix_ + "grid_smoothing." + field.substr(pieces.size())) : nullptr;
    const Match& at = smoothing == nullptr ? match : *smoothing;
    reading_.refuse(at.position, at.path, at.node, path + ": " + problem.value() + ": allowed is " + problem.allowed());
  }

  void check_smoothing_alone() const {
    for (const char* key : {"grid_smoothing.profile_pieces", "grid_smoothing.face_pieces"}) {
      const Match* match = reading_.find(prefix_ + key);
      if (match == nullptr) continue;
      reading_.refuse(match->position, match->path, match->node, "has no meaning without " + prefix_ + "grid");
    }
  }

  StudyReading& reading_;
  const GearPair& pair_;
  Member member_;
  std::string prefix_;
};

}  // namespace

void read_grids(StudyReading& reading) {
  if (!reading.problems.empty()) return;
  Study& study = reading.builder.study;
  const GearPair pair = make_gear_pair(study.pair);
  for (const Member m : both_gears) {
    const GridReading gear(reading, pair, m);
    gear.read(study.modification[m], study.grid[m], study.opposite_grid[m]);
    study.error[m].topographies = gear.read_teeth(study.tooth_grids[m]);
    for (Scene& scene : study.scenes) scene.error[m].topographies = study.error[m].topographies;
  }
}

void read_generation(StudyReading& reading) {
  StudyBuilder& builder = reading.builder;
  read_generation(reading, "pinion.generation", builder.generation.pinion, builder.study.pair.pinion);
  read_generation(reading, "wheel.generation", builder.generation.wheel, builder.study.pair.wheel);
}

}  // namespace flankwright::studies
