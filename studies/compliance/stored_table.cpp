#include "studies/compliance/stored_table.hpp"

#include <fmt/format.h>

#include "core/base/error.hpp"

namespace flankwright::studies {

namespace {

/// To be raised whenever the same task comes to mean other numbers: mesh, load functional, removed motion, solution.
constexpr int model_version = 9;

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

Json gear_key(const GearToMesh& gear) {
  const auto& [data, module, pressure_angle, helix_angle, body] = gear;
  const auto& [teeth, face_width, profile_shift, tip_diameter, rack, generation] = data;
  const auto& [addendum, dedendum, root_radius] = rack;
  const auto& [shaft_diameter, bore_diameter, shaft_overhang, torque_end, rigid] = body;
  static_cast<void>(module);      // 1
  static_cast<void>(generation);  // amounts of micrometres, which the mesh does not know
  Json key{{"teeth", teeth},
           {"face_width", face_width},
           {"profile_shift", profile_shift},
           {"tip_diameter", tip_diameter},
           {"rack", {addendum, dedendum, root_radius}},
           {"pressure_angle", pressure_angle},
           {"helix_angle", helix_angle},
           {"body", {shaft_diameter, bore_diameter, shaft_overhang, torque_end == FaceEnd::Blunt ? "blunt" : "sharp"}}};
  if (rigid) key["rigid_body"] = true;
  return key;
}

std::string table_name(int teeth_apart) { return fmt::format("influence {} apart", teeth_apart); }
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
    if (stress.rows() != 3 * root.fillet.size() || stress.cols() != task.grid.size() ||
        root.fillet.tangent >= root.fillet.along.size()) {
      throw InvalidInput("run", root_stress_name(m), "as large as its grids");
    }
  }
  return root;
}

}  // namespace

Json cache_key(const InfluenceTableTask& task) {
  return {{"model", model_version},
          {"gear", gear_key(in_modules(task).gear)},
          {"poissons_ratio", task.poissons_ratio},
          {"teeth_apart", task.teeth_apart},
          {"mesh", mesh_key(task.mesh)},
          {"removed_motion", static_cast<int>(task.removed)},
          {"root_stress", task.root_stress},
          {"us", task.grid.us()},
          {"zetas", task.grid.zetas()}};
}

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
  return stored;
}

InfluenceTableRun from_store(const InfluenceTableTask& task, const StoredRun& stored) {
  InfluenceTableRun run{FactorStatus::Factorised, std::nullopt, std::nullopt, {}};
  const Json& facts = stored.facts;
  run.statistics = {facts.at("bricks"),     facts.at("unknowns"),      facts.at("factor_entries"),
                    facts.at("peak_bytes"), facts.at("model_seconds"), facts.at("solve_seconds")};
  std::vector<Eigen::MatrixXd> tables;
  for (int m = 0; m <= task.teeth_apart; ++m) tables.push_back(stored_matrix(stored, table_name(m)));
  run.table.emplace(task.grid, std::move(tables), TableProjection{facts.at("lowest_eigenvalue"), facts.at("added")});
  if (task.root_stress) run.root_stress = root_stress_from_store(task, stored);
  return run;
}

}  // namespace flankwright::studies
