#include "optimize/design/problem/mesh_store.hpp"

#include <algorithm>

namespace flankwright {

namespace {

bool same(const MeshKey& a, const MeshKey& b) {
  const Quadrature &of_a = a.resolution.quadrature, &of_b = b.resolution.quadrature;
  return of_a.rule == of_b.rule && of_a.intervals == of_b.intervals && a.resolution.phases == b.resolution.phases && !(a.placement < b.placement) &&
         !(b.placement < a.placement) && a.effects == b.effects && a.structure == b.structure && a.root_stress == b.root_stress &&
         a.shafts == b.shafts;
}

/// The size of the influence values, which make up most of a mesh.
std::size_t bytes_of(const MeshModel& mesh) {
  Eigen::Index values = 0;
  for (const MeshPosition& position : mesh.positions) values += position.influence.size();
  return sizeof(double) * static_cast<std::size_t>(values);
}

}  // namespace

std::shared_ptr<const MeshModel> MeshStore::find(const MeshKey& key) {
  const std::lock_guard lock(mutex_);
  const auto known = std::ranges::find_if(kept_, [&](const Kept& kept) { return same(kept.key, key); });
  if (known == kept_.end()) return nullptr;
  kept_.splice(kept_.begin(), kept_, known);
  return known->mesh;
}

std::shared_ptr<const MeshModel> MeshStore::mesh(const MeshKey& key, const std::function<MeshModel()>& make) {
  if (auto known = find(key)) return known;
  auto made = std::make_shared<const MeshModel>(make());
  const std::lock_guard lock(mutex_);
  kept_.push_front({key, made, bytes_of(*made)});
  std::size_t bytes = 0;
  std::erase_if(kept_, [&](const Kept& kept) {
    bytes += kept.bytes;
    return bytes > most_bytes;
  });
  return made;
}

}  // namespace flankwright
