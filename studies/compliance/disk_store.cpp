#include "studies/compliance/disk_store.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "core/base/error.hpp"
#include "studies/compliance/run_cache.hpp"

namespace flankwright::studies {

namespace {

/// To be raised whenever the same task comes to mean other numbers: mesh, load functional, removed motion, solution.
constexpr int model_version = 11;
/// To be raised whenever the same influence values give another fit: form, stations, residuals.
constexpr int fit_version = 3;
/// To be raised whenever the same web comes to mean other numbers.
constexpr int web_model_version = 1;

// clang-format off
/// A field that is added to these structs must be added to the key: the bindings then no longer compile.
Json mesh_key(const GearMeshOptions& options) {
  const auto& [flank, fillet, half_thickness, adjacent_flank, adjacent_fillet, teeth_each_side, end, axial_growth, largest,
               most_layers, body_growth, shaft, layer_share] = options;
  static_cast<void>(teeth_each_side);  // teeth_apart says it
  return {flank, fillet, half_thickness, adjacent_flank, adjacent_fillet, end, axial_growth, largest, most_layers,
          body_growth, shaft, layer_share};
}
// clang-format on

Json web_key(const WebbedBody& body) {
  const auto& [rim_thickness, web_thickness, web_offset, hub_diameter, hub_width, holes] = body;
  const auto& [count, diameter, circle_diameter] = holes;
  Json key{web_model_version, rim_thickness, web_thickness, web_offset, hub_diameter, hub_width};
  if (count > 0) key.push_back({count, diameter, circle_diameter});
  return key;
}

Json gear_key(const GearToMesh& gear) {
  const auto& [data, module, pressure_angle, helix_angle, body] = gear;
  const auto& [teeth, face_width, profile_shift, tooth_thickness_allowance, tip_diameter, rack, tip_rounding, tip_chamfer, end_rounding, end_chamfer,
               generation] = data;
  const auto& [addendum, dedendum, root_radius] = rack;
  const auto& [shaft_diameter, bore_diameter, shaft_overhang, torque_end, rigid, hold, web] = body;
  static_cast<void>(module);                     // 1
  static_cast<void>(tooth_thickness_allowance);  // part of the profile shift in modules
  static_cast<void>(tip_rounding);               // the mesh has sharp edges
  static_cast<void>(tip_chamfer);
  static_cast<void>(end_rounding);
  static_cast<void>(end_chamfer);
  static_cast<void>(generation);  // amounts of micrometres, which the mesh does not know
  Json key{{"teeth", teeth},
           {"face_width", face_width},
           {"profile_shift", profile_shift},
           {"tip_diameter", tip_diameter},
           {"rack", {addendum, dedendum, root_radius}},
           {"pressure_angle", pressure_angle},
           {"helix_angle", helix_angle},
           {"body", {shaft_diameter, bore_diameter, shaft_overhang, torque_end == FaceEnd::Obtuse ? "blunt" : "sharp"}}};
  if (rigid) key["rigid_body"] = true;
  if (hold != BodyHold::Shaft) key["hold"] = to_string(hold);
  if (web) key["web"] = web_key(*web);
  return key;
}

std::string table_name(int teeth_apart) { return fmt::format("influence {} apart", teeth_apart); }
const std::string whole_rim_name = "motion of the rim";
std::string rim_below_name(int tooth) { return fmt::format("motion of the rim below tooth 0 by tooth {}", tooth); }
std::string root_stress_name(int tooth) { return fmt::format("root stress by tooth {}", tooth); }

const Eigen::MatrixXd& stored_matrix(const StoredRun& stored, const std::string& name) {
  const Eigen::MatrixXd* matrix = stored.find(name);
  if (matrix == nullptr) throw InvalidInput("run", name, "there");
  return *matrix;
}

RootStressTable root_stress_from_store(const InfluenceTableTask& task, const StoredRun& stored) {
  const Json& facts = stored.facts;
  RootStressTable root{task.grid, {facts.at("fillet_along"), facts.at("fillet_tangent"), facts.at("fillet_zetas")}, {}};
  for (int m = -task.teeth_apart; m <= task.teeth_apart; ++m) {
    root.stress.push_back(stored_matrix(stored, root_stress_name(m)));
    const Eigen::MatrixXd& stress = root.stress.back();
    if (stress.rows() != 3 * root.fillet.size() || stress.cols() != task.grid.size() || root.fillet.tangent >= root.fillet.along.size()) {
      throw InvalidInput("run", root_stress_name(m), "as large as its grids");
    }
  }
  return root;
}

RimMotionTable rim_motion_from_store(const InfluenceTableTask& task, const StoredRun& stored) {
  RimMotionTable rim{task.grid, stored_matrix(stored, whole_rim_name), {}};
  for (int m = -task.teeth_apart; m <= task.teeth_apart; ++m) rim.below.push_back(stored_matrix(stored, rim_below_name(m)));
  const auto fits = [&](const Eigen::MatrixXd& motion) { return motion.rows() == 6 && motion.cols() == task.grid.size(); };
  if (!fits(rim.whole) || !std::ranges::all_of(rim.below, fits)) throw InvalidInput("run", whole_rim_name, "as large as its grid");
  return rim;
}

/// Everything that defines the outcome of a task, in modules, as the key of its stored run.
Json cache_key(const InfluenceTableTask& task) {
  return {{"model", model_version},
          {"gear", gear_key(in_modules(task).gear)},
          {"poissons_ratio", task.poissons_ratio},
          {"teeth_apart", task.teeth_apart},
          {"mesh", mesh_key(task.mesh)},
          {"removed_motion", static_cast<int>(task.removed)},
          {"root_stress", task.root_stress},
          {"us", task.grid.us()},
          {"zetas", task.grid.zetas()},
          {"neighbours", {task.grid_of_neighbours().us(), task.grid_of_neighbours().zetas()}}};
}

/// @param run  Factorised
StoredRun to_store(const InfluenceTableRun& run) {
  const InfluenceTable& table = *run.table;
  StoredRun stored;
  stored.facts = {{"bricks", run.statistics.bricks},
                  {"unknowns", run.statistics.unknowns},
                  {"factor_entries", run.statistics.factor_entries},
                  {"peak_bytes", run.statistics.peak_bytes},
                  {"model_seconds", run.statistics.model_seconds},
                  {"solve_seconds", run.statistics.solve_seconds},
                  {"lowest_eigenvalue", table.projection().lowest_eigenvalue},
                  {"added", table.projection().added}};
  for (int m = 0; m <= table.teeth_apart(); ++m) {
    stored.matrices.emplace_back(table_name(m), table.tables()[static_cast<std::size_t>(m)]);
  }
  if (run.root_stress) {
    const RootStressTable& root = *run.root_stress;
    stored.facts["fillet_along"] = root.fillet.along;
    stored.facts["fillet_tangent"] = root.fillet.tangent;
    stored.facts["fillet_zetas"] = root.fillet.zetas;
    for (int m = -root.teeth_each_side(); m <= root.teeth_each_side(); ++m) {
      stored.matrices.emplace_back(root_stress_name(m), root.stress[static_cast<std::size_t>(m + root.teeth_each_side())]);
    }
  }
  if (run.rim_motion) {
    const RimMotionTable& rim = *run.rim_motion;
    stored.matrices.emplace_back(whole_rim_name, rim.whole);
    for (int m = -rim.teeth_each_side(); m <= rim.teeth_each_side(); ++m) {
      stored.matrices.emplace_back(rim_below_name(m), rim.below[static_cast<std::size_t>(m + rim.teeth_each_side())]);
    }
  }
  return stored;
}

/// A run as to_store() writes it.
/// @throws Json::exception, InvalidInput where something is missing
InfluenceTableRun from_store(const InfluenceTableTask& task, const StoredRun& stored) {
  InfluenceTableRun run{FactorStatus::Factorised, std::nullopt, std::nullopt, {}, std::nullopt};
  const Json& facts = stored.facts;
  run.statistics = {facts.at("bricks"),     facts.at("unknowns"),      facts.at("factor_entries"),
                    facts.at("peak_bytes"), facts.at("model_seconds"), facts.at("solve_seconds")};
  std::vector<Eigen::MatrixXd> tables;
  for (int m = 0; m <= task.teeth_apart; ++m) tables.push_back(stored_matrix(stored, table_name(m)));
  run.table.emplace(task.grid, std::move(tables), TableProjection{facts.at("lowest_eigenvalue"), facts.at("added")});
  if (task.root_stress) run.root_stress = root_stress_from_store(task, stored);
  if (reads_rim_motion(task.gear.body)) run.rim_motion = rim_motion_from_store(task, stored);
  return run;
}

Json fit_key(InfluenceTableTask coarse, const std::vector<double>& start) {
  coarse.root_stress = false;
  InfluenceTableTask fine = coarse;
  fine.mesh = {};
  return {{"refinement", fit_version}, {"coarse", cache_key(coarse)}, {"fine", cache_key(fine)}, {"start", start}};
}

/// The entry of a key as `read` interprets it; with a note where it cannot be used.
template <typename Read>
auto kept(const Json& key, const char* what, std::vector<std::string>& notes, Read&& read) -> std::optional<Kept<decltype(read(StoredRun{}))>> {
  const RunCache cache(RunCache::default_folder());
  const auto stored = cache.find(key, notes);
  if (!stored) return std::nullopt;
  const std::string file = cache.file_of(key).string();
  try {
    return Kept{read(*stored), file};
  } catch (const std::exception& problem) {
    notes.push_back(std::string("the stored ") + what + " " + file + " is not used: " + problem.what());
    return std::nullopt;
  }
}

std::string keep_under(const Json& key, const StoredRun& run, std::vector<std::string>& notes) {
  const RunCache cache(RunCache::default_folder());
  return cache.store(key, run, notes) ? cache.file_of(key).string() : "";
}

}  // namespace

std::optional<Kept<InfluenceTableRun>> DiskStore::find(const InfluenceTableTask& task) {
  InfluenceTableTask asked = task;
  std::vector<std::string> notes;
  auto run = kept(cache_key(asked), "finite-element run", notes, [&](const StoredRun& stored) { return from_store(task, stored); });
  if (!run && !asked.root_stress) {
    asked.root_stress = true;
    run = kept(cache_key(asked), "finite-element run", notes, [&](const StoredRun& stored) { return from_store(task, stored); });
  }
  const std::lock_guard lock(notes_mutex_);
  notes_.insert(notes_.end(), notes.begin(), notes.end());
  std::ranges::sort(notes_);  // whichever thread came first
  return run;
}

std::string DiskStore::keep(const InfluenceTableTask& task, const InfluenceTableRun& run) {
  return keep_under(cache_key(task), to_store(run), notes_);
}

std::optional<Kept<CorrectionEntry>> DiskStore::find_fit(const InfluenceTableTask& coarse, const std::vector<double>& start) {
  return kept(fit_key(coarse, start), "fit", notes_,
              [](const StoredRun& stored) { return entries_in(stored.facts.at("fit").get<std::string>()).at(0); });
}

std::string DiskStore::keep_fit(const InfluenceTableTask& coarse, const std::vector<double>& start, const CorrectionEntry& fit) {
  return keep_under(fit_key(coarse, start), {.facts = {{"fit", to_text(fit)}}, .matrices = {}}, notes_);
}

}  // namespace flankwright::studies
