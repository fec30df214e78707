#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "studies/exchange/rexs/rexs_condition.hpp"

namespace flankwright::studies::rexs {

/// Torque on a gear in one of its meshes, by its shaft, about z.
struct GearTorque {
  double torque{0.0};    ///< [N mm]; where the size is not known, +1 or -1
  bool has_size{false};  ///< false: only its sign is known
  std::string source{};  ///< what it came from
};

/// Two statements of one torque agree where they differ by no more than this part of the larger: what the meshes and bearings between them may lose.
inline constexpr double largest_loss = 0.05;

/// Torques of all meshes of a file in one condition, from its external loads.
///
///     sum of the loads on a shaft = sum of the torques on its gears, in all of their meshes
///     torque on the second gear of an external mesh = torque on the first one * z2 / z1, of the same sign
///
/// A shaft with one unknown torque gives it. Where a shaft shares its torque between several meshes, each torque has the sign of what is left for them.
/// A load that transmits a torque of unknown size leaves the torques on its shaft open. Friction and losses of bearings are left out. Torque does not pass through meshes of other than external cylindrical
/// gears.
class TorqueFlow {
 public:
  /// @param z  about which torques count; shafts that run against it have the opposite sign
  TorqueFlow(const Condition& condition, const std::array<double, 3>& z);

  /// On a gear of a stage; nullopt where the loads do not say.
  std::optional<GearTorque> on(const Component& gear, const Component& stage) const;

  /// Shafts on which the loads contradict each other, in words: all torques are known, and they leave more than largest_loss of the largest.
  std::vector<std::string> contradictions() const;

 private:
  /// A mesh with the torque on its first gear.
  struct Mesh {
    const Component* stage{nullptr};
    std::array<const Component*, 2> gears{}, shafts{};  ///< a shaft is null where a gear sits on none
    std::array<double, 2> ratio{1.0, 1.0};              ///< torque on each gear over that on the first
    bool passes_torque{false};
    std::optional<GearTorque> first{};
    const Component* origin{nullptr};  ///< the shaft that gave the torque
  };
  /// A gear of a mesh, as its shaft has it.
  struct Place {
    std::size_t mesh;
    std::size_t gear;
  };
  struct Shaft {
    const Component* component{nullptr};
    std::vector<Taken> loads{};  ///< known torques of external loads, about z
    bool has_open_load{false};   ///< another load transmits a torque of unknown size
    std::vector<Place> places{};
  };
  struct Found {
    Place at;
    GearTorque torque;  ///< on that gear
    const Component* origin;
  };

  void read_meshes(Reading& reading);
  void read_shafts(const Condition& condition, const std::array<double, 3>& z);
  bool is_open(const Place& place) const { return !meshes_[place.mesh].first.has_value(); }
  GearTorque torque_at(const Place& place) const;
  /// Loads less the torques that are known on the shaft's gears; nothing where none is known, where a load is open, or where torques of unknown size
  /// have different signs.
  std::optional<GearTorque> left_for_gears(const Shaft& shaft) const;
  std::vector<Found> sizes_of(const Shaft& shaft) const;
  std::vector<Found> signs_of(const Shaft& shaft) const;
  /// What the shafts give by what is known before; true where something is new.
  bool spread(std::vector<Found> (TorqueFlow::*found_on)(const Shaft&) const);

  std::vector<Mesh> meshes_;
  std::vector<Shaft> shafts_;
};

}  // namespace flankwright::studies::rexs
