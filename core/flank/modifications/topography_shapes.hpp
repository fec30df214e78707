#pragma once

#include <algorithm>
#include <array>
#include <utility>

#include "core/base/jet.hpp"
#include "core/flank/modifications/descriptor.hpp"

namespace flankwright::modifications {

/// Degrees of one smooth shape over the active flank: material removed P_profile(xi) P_face(eta) with the Legendre polynomials P_n,
/// xi = -1 at the start of active profile .. 1 at the tip, eta = -1 at z = -b/2 .. 1 at z = +b/2.
struct TopographyShape {
  int profile{0}, face{0};
  std::string_view key, name, sense, meaning;
};

/// All shapes to the fourth degree but the constant, which only delays the mesh, and those of the first degree in both
/// directions, which are the slopes and the twist.
inline constexpr std::array<TopographyShape, 11> topography_shapes{{
    {0, 2, "topography.face_2", "topography, lead order 2", "Legendre polynomials; + removes at both face ends",
     "removed c P_0(profile) P_2(face): Legendre polynomials, -1 at the start of active profile and z = -b/2 .. 1 at the tip and z = +b/2"},
    {2, 0, "topography.profile_2", "topography, profile order 2", "Legendre polynomials; + removes at tip and root",
     "the same with P_2(profile) P_0(face)"},
    {0, 3, "topography.face_3", "topography, lead order 3", "Legendre polynomials; + removes at z = +b/2", "the same with P_0(profile) P_3(face)"},
    {3, 0, "topography.profile_3", "topography, profile order 3", "Legendre polynomials; + removes at the tip",
     "the same with P_3(profile) P_0(face)"},
    {1, 2, "topography.profile_1_face_2", "topography, profile order 1 by lead order 2",
     "Legendre polynomials; + removes at the tip at both face ends", "the same with P_1(profile) P_2(face)"},
    {2, 1, "topography.profile_2_face_1", "topography, profile order 2 by lead order 1",
     "Legendre polynomials; + removes at tip and root at z = +b/2", "the same with P_2(profile) P_1(face)"},
    {0, 4, "topography.face_4", "topography, lead order 4", "Legendre polynomials; + removes at both face ends",
     "the same with P_0(profile) P_4(face)"},
    {4, 0, "topography.profile_4", "topography, profile order 4", "Legendre polynomials; + removes at tip and root",
     "the same with P_4(profile) P_0(face)"},
    {1, 3, "topography.profile_1_face_3", "topography, profile order 1 by lead order 3", "Legendre polynomials; + removes at the tip at z = +b/2",
     "the same with P_1(profile) P_3(face)"},
    {3, 1, "topography.profile_3_face_1", "topography, profile order 3 by lead order 1", "Legendre polynomials; + removes at the tip at z = +b/2",
     "the same with P_3(profile) P_1(face)"},
    {2, 2, "topography.profile_2_face_2", "topography, profile order 2 by lead order 2", "Legendre polynomials; + removes at the four corners",
     "the same with P_2(profile) P_2(face)"},
}};

/// A shape of the face alone is a lead modification, which a process may twist, and one of the profile alone a profile modification.
constexpr ModificationClass class_of(const TopographyShape& shape) {
  return shape.profile == 0 ? ModificationClass::Lead : shape.face == 0 ? ModificationClass::Profile : ModificationClass::Topography;
}

/// Sum of c_ij P_i((2 r - r_a - r_Nf)/(r_a - r_Nf)) P_j(2z/b) over the topography_shapes of one class.
template <ModificationClass Class>
struct TopographyShapesOf {
  static constexpr ModificationClass flank_class = Class;
  static constexpr auto list = [] {
    constexpr auto is_own = [](const TopographyShape& shape) { return class_of(shape) == Class; };
    std::array<TopographyShape, static_cast<std::size_t>(std::ranges::count_if(topography_shapes, is_own))> own;
    std::ranges::copy_if(topography_shapes, own.begin(), is_own);
    return own;
  }();

  std::array<double, list.size()> shapes{};  ///< c of each shape of the list [mm]

  static constexpr auto parameters() {
    return []<std::size_t... K>(std::index_sequence<K...>) {
      return std::array{ParameterRow<TopographyShapesOf>{
          {.key = list[K].key, .name = list[K].name, .sense = list[K].sense, .meaning = list[K].meaning, .odd_along_face = list[K].face % 2 == 1},
          [](const TopographyShapesOf& m) { return m.shapes[K]; },
          [](TopographyShapesOf& m, double value) { m.shapes[K] = value; }}...};
    }
    (std::make_index_sequence<list.size()>());
  }

  class Term {
   public:
    Term(const TopographyShapesOf& m, const FlankFrame& frame);
    void add(double r, double z, Jet& d) const {
      if (any_) sum(r, z, d);
    }

   private:
    void sum(double r, double z, Jet& d) const;

    bool any_;
    std::array<double, list.size()> shapes_;
    double middle_radius_, half_height_, half_face_;  ///< what xi and eta count from and in
  };
  bool operator==(const TopographyShapesOf&) const = default;
};

using LeadShapes = TopographyShapesOf<ModificationClass::Lead>;
using ProfileShapes = TopographyShapesOf<ModificationClass::Profile>;
using TopographyShapes = TopographyShapesOf<ModificationClass::Topography>;

}  // namespace flankwright::modifications
