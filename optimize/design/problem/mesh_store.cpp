#include "optimize/design/problem/mesh_store.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

namespace flankwright {

namespace {

bool same_but_for_phases(const MeshKey& a, const MeshKey& b) {
  const Quadrature &of_a = a.resolution.quadrature, &of_b = b.resolution.quadrature;
  return of_a.rule == of_b.rule && of_a.intervals == of_b.intervals && a.effects == b.effects && a.structure == b.structure &&
         a.root_stress == b.root_stress && a.shafts == b.shafts;
}

/// The size of the influence values, which make up most of a mesh.
std::size_t bytes_of(const MeshModel& mesh) {
  Eigen::Index values = 0;
  for (const MeshPosition& position : mesh.positions) values += position.influence.size();
  return sizeof(double) * static_cast<std::size_t>(values);
}

const MeshPosition* position_at(const std::vector<MeshPosition>& positions, double phase) {
  const auto found = std::ranges::find(positions, phase, &MeshPosition::phase);
  return found == positions.end() ? nullptr : &*found;
}

/// The mesh that a key asks for, of which another one has some of the positions.
MeshModel made_beside(const MeshModel& other, const MeshKey& key, const std::function<MeshModel(const std::vector<double>& phases)>& make) {
  assert(other.perturbed.empty());
  std::vector<double> unknown;
  for (const double phase : key.resolution.phases) {
    if (position_at(other.positions, phase) == nullptr) unknown.push_back(phase);
  }
  MeshModel mesh = unknown.empty() ? other : make(unknown);
  const std::vector<MeshPosition> made = std::exchange(mesh.positions, {});
  for (const double phase : key.resolution.phases) {
    const MeshPosition* const known = position_at(other.positions, phase);
    mesh.positions.push_back(known != nullptr ? *known : *position_at(made, phase));
  }
  return mesh;
}

}  // namespace

MeshStore::Group* MeshStore::group(const MeshKey& key) {
  const auto known = std::ranges::find_if(
      groups_, [&](const Group& g) { return same_but_for_phases(g.key, key) && g.key.resolution.phases == key.resolution.phases; });
  if (known == groups_.end()) return nullptr;
  groups_.splice(groups_.begin(), groups_, known);
  return &groups_.front();
}

std::shared_ptr<const MeshModel> MeshStore::find(const MeshKey& key) {
  const std::lock_guard lock(mutex_);
  Group* const of_key = group(key);
  if (of_key == nullptr) return nullptr;
  const auto known = of_key->meshes.find(key.placement);
  return known == of_key->meshes.end() ? nullptr : known->second.mesh.lock();
}

std::shared_ptr<const MeshModel> MeshStore::at_other_phases(const MeshKey& key) {
  const std::lock_guard lock(mutex_);
  for (const Group& of : groups_) {
    if (!same_but_for_phases(of.key, key)) continue;
    const auto known = of.meshes.find(key.placement);
    if (known == of.meshes.end()) continue;
    if (auto mesh = known->second.mesh.lock()) return mesh;
  }
  return nullptr;
}

std::shared_ptr<const MeshModel> MeshStore::mesh(const MeshKey& key, const std::function<MeshModel(const std::vector<double>& phases)>& make) {
  if (auto known = find(key)) return known;
  const auto other = at_other_phases(key);
  auto made = std::make_shared<const MeshModel>(other ? made_beside(*other, key, make) : make(key.resolution.phases));
  const std::lock_guard lock(mutex_);
  Group* of_key = group(key);
  if (of_key == nullptr) {
    groups_.push_front({key, {}});
    of_key = &groups_.front();
  }
  of_key->meshes[key.placement] = {made, made};
  forget_oldest();
  return made;
}

void MeshStore::forget_oldest() {
  std::size_t bytes = 0;
  for (Group& of : groups_) {
    std::size_t kept = 0;
    for (const auto& [placement, known] : of.meshes) kept += known.kept ? bytes_of(*known.kept) : 0;
    bytes += kept;
    if (bytes <= most_bytes || &of == &groups_.front()) continue;
    for (auto& [placement, known] : of.meshes) known.kept.reset();
    bytes -= kept;
  }
  for (Group& of : groups_) std::erase_if(of.meshes, [](const auto& entry) { return entry.second.mesh.expired(); });
  groups_.remove_if([](const Group& of) { return of.meshes.empty(); });
}

}  // namespace flankwright
