#include "tests/benchmarks/contact_truth/contact_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "tests/benchmarks/contact_truth/mesh_layers.hpp"
#include "tests/benchmarks/contact_truth/tooth_surface.hpp"

namespace flankwright::contact_truth {
namespace {

using units::pi;

/// The section at any z: which nodes and quads there are does not depend on z, where they lie does.
class Section {
 public:
  Section(const ContactGear& gear, const ContactMeshOptions& options)
      : gear_(gear),
        options_(options),
        surface_(gear, options),
        form_(surface_.form()),
        pitch_(2 * pi / (*gear.pair)[gear.member].data.teeth),
        rim_(std::max(form_.root_radius() - 1.1 * gear.pair->data.normal_module, 0.5 * (form_.root_radius() + inside_teeth(gear, form_)))),
        first_(surface_.first_loaded() - options.form_teeth),
        last_(surface_.last_loaded() + options.form_teeth) {
    divide_body();
    build();
  }

  struct Quad {
    std::array<int, 8> nodes;
    int pair;                   ///< whose loaded flank it touches
    int face;                   ///< CalculiX' number of that face; 0: it does not touch one
    double half_width, middle;  ///< along z, of the part that it belongs to [mm]
    bool in_rim;                ///< below the root circle, above the underside of a rim on a web
    bool in_fillet;             ///< that face lies below the loaded flank
  };
  const std::vector<Quad>& quads() const { return quads_; }
  std::size_t size() const { return places_.size(); }
  bool at_bore(std::size_t node) const { return places_[node].kind == Ring && places_[node].j == 2 * rings(); }

  Eigen::Vector2d position(std::size_t node, double z) const {
    const Polar p = polar(places_[node], z);
    const double angle = p.angle + surface_.turn() + gear_.flank->helix_rate * z;
    return {p.radius * std::cos(angle), p.radius * std::sin(angle)};
  }

 private:
  enum Kind { Tooth, Centre, Gap, Plain, Ring, Cap };
  /// A node at half steps: i along the profile (around the ring), j from the inside to the surface (down to the bore).
  struct Place {
    Kind kind;
    int tooth, side, i, j;
    auto operator<=>(const Place&) const = default;
  };

  int rings() const { return static_cast<int>(ring_ends_.size()) - 1; }

  static double inside_teeth(const ContactGear& gear, const ToothForm& form) {
    return gear.web ? form.root_radius() - gear.web->rim_thickness : gear.bore_radius;
  }

  /// Rings from below the teeth to the bore; in a web, which bends, narrow next to rim and hub.
  void divide_body() {
    ring_ends_.push_back(rim_);
    const auto even = [&](double to, int n) {
      const double from = ring_ends_.back();
      for (int i = 1; i <= n; ++i) ring_ends_.push_back(from + (to - from) * i / n);
    };
    if (gear_.web == nullptr) return even(gear_.bore_radius, options_.body_rings);
    const double underside = inside_teeth(gear_, form_), hub = gear_.web->hub_diameter / 2;
    even(underside, options_.body_rings);
    web_begin_ = rings();
    const int n = 4 * options_.body_rings;
    for (int i = 1; i <= n; ++i) ring_ends_.push_back(underside + (hub - underside) * 0.5 * (1 - std::cos(pi * i / n)));
    web_end_ = rings();
    even(gear_.bore_radius, options_.body_rings);
  }
  /// Where the inner line turns from the centre line to the rim.
  int corner(int tooth) const { return surface_.steps(tooth) - std::max(1, surface_.fillet_elements(tooth) / 2); }

  /// Where the start of the fillet is joined to the centre line: share of the height from the rim to there.
  static constexpr double below_flank = 0.6;

  /// The tooth's centre line, then the rim's circle; the same for both sides of a tooth.
  Polar inner(int tooth, int i) const {
    const int flank = 2 * surface_.flank_elements(tooth), turn = 2 * corner(tooth), last = 2 * surface_.steps(tooth);
    if (i > turn) return {rim_, pitch_ / 2 * (i - turn) / (last - turn)};
    const double foot = rim_ + below_flank * (form_.form_radius() - rim_);
    if (i > flank) return {foot + (rim_ - foot) * (i - flank) / (turn - flank), 0};
    return {surface_.top(tooth) + (foot - surface_.top(tooth)) * i / flank, 0};
  }

  /// Share of the way from the inside to the surface at half level j where elements shrink by a ratio q towards it.
  double graded(double q, int j) const {
    if (j % 2 != 0) return (graded(q, j - 1) + graded(q, j + 1)) / 2;
    return q == 1 ? j / (2.0 * options_.across) : (1 - std::pow(q, -j / 2.0)) / (1 - std::pow(q, -options_.across));
  }

  /// The same on a tooth: fine below the loaded flank, as in the gap's middle elsewhere.
  double level(int tooth, int side, int i, int j) const {
    const double gap = graded(options_.gap_depth, j);
    if (side < 0 || !surface_.loaded(tooth)) return gap;
    const double fine = graded(options_.into_depth, j);
    const int end = 2 * surface_.flank_elements(tooth);
    return i <= end ? fine : fine + (gap - fine) * (i - end) / (2.0 * surface_.fillet_elements(tooth));
  }

  Polar tooth_polar(int tooth, int side, int i, int j, double z) const {
    const Polar at = blend(inner(tooth, i), surface_.profile(tooth, side, i, z), level(tooth, side, i, j));
    return {at.radius, tooth * pitch_ + side * at.angle};
  }

  /// Coons' patch between the loaded side's first column (growing i), the other side's (growing j), the tip land and the other flank's tip.
  Polar cap(int tooth, int i, int j, double z) const {
    const double u = level(tooth, 1, 0, i), v = level(tooth, -1, 0, j), middle = tooth * pitch_;
    const auto at = [](const Polar& p) { return Eigen::Vector2d(p.radius * std::cos(p.angle), p.radius * std::sin(p.angle)); };
    const Polar land = surface_.profile(tooth, 1, 0, z);
    const double tip = form_.tip_radius(), tip_angle = form_.tip_half_angle();
    const auto on_land = [&](double t) { return at({tip, middle + land.angle + t * (-tip_angle - land.angle)}); };
    const auto on_flank = [&](double t) {
      const double radius = surface_.top(tooth) + t * (tip - surface_.top(tooth));
      return at({radius, middle - form_.half_angle(radius)});
    };
    const Eigen::Vector2d first = at(tooth_polar(tooth, 1, 0, i, z)), other = at(tooth_polar(tooth, -1, 0, j, z));
    const Eigen::Vector2d centre = at({surface_.top(tooth), middle}), corner = at({tip, middle - tip_angle});
    const Eigen::Vector2d p = (1 - v) * first + v * on_flank(u) + (1 - u) * other + u * on_land(v) -
                              ((1 - u) * (1 - v) * centre + u * (1 - v) * on_land(0) + (1 - u) * v * on_flank(0) + u * v * corner);
    return {p.norm(), std::atan2(p.y(), p.x())};
  }

  Polar polar(const Place& p, double z) const {
    const double middle = p.tooth * pitch_;
    switch (p.kind) {
      case Cap:
        return cap(p.tooth, p.i, p.j, z);
      case Centre: {
        const Polar at = inner(p.tooth, p.i);
        return {at.radius, middle};
      }
      case Tooth:
        return tooth_polar(p.tooth, p.side, p.i, p.j, z);
      case Gap:
        return {rim_ + (form_.root_radius() - rim_) * graded(options_.gap_depth, p.j), middle + pitch_ / 2};
      case Plain: {
        const double start = (last_ + 0.5) * pitch_, end = (first_ - 0.5) * pitch_ + 2 * pi;
        return {rim_ + (form_.root_radius() - rim_) * graded(options_.gap_depth, p.j), start + (end - start) * plain(p.i)};
      }
      case Ring: {
        Polar at = polar(places_[static_cast<std::size_t>(around_[static_cast<std::size_t>(p.i)])], z);
        const auto ring = static_cast<std::size_t>(p.j / 2);
        at.radius = p.j % 2 == 0 ? ring_ends_[ring] : (ring_ends_[ring] + ring_ends_[ring + 1]) / 2;
        return at;
      }
    }
    __builtin_unreachable();
  }

  /// Positions around the plain ring, 0 .. 1, narrow next to the teeth.
  double plain(int i) const {
    const double t = i / (2.0 * plain_);
    return t - 0.6 / (2 * pi) * std::sin(2 * pi * t);
  }

  int node(Place p) {
    if (p.kind == Cap && p.j == 0) p = {Tooth, p.tooth, 1, 0, p.i};
    if (p.kind == Cap && p.i == 0) p = {Tooth, p.tooth, -1, 0, p.j};
    if (p.kind == Tooth && p.i == 2 * surface_.steps(p.tooth))
      p = {Gap, p.side > 0 ? p.tooth : p.tooth - 1, 0, 0, p.j};
    else if (p.kind == Tooth && p.j == 0 && p.i <= 2 * corner(p.tooth))
      p = {Centre, p.tooth, 0, p.i, 0};
    else if (p.kind == Plain && (p.i == 0 || p.i == 2 * plain_))
      p = {Gap, p.i == 0 ? last_ : first_ - 1, 0, 0, p.j};
    else if (p.kind == Ring && p.j == 0)
      return around_[static_cast<std::size_t>(p.i)];
    const auto [found, made] = numbers_.try_emplace(p, static_cast<int>(places_.size()));
    if (made) places_.push_back(p);
    return found->second;
  }

  /// @param flipped          where growing i and j turn clockwise
  /// @param surface_columns  on a loaded flank, the others being below it; 0: none of them is
  template <class At>
  void grid(int columns, int rows, bool flipped, int tooth, int surface_columns, At&& at) {
    for (int i = 0; i < 2 * columns; i += 2) {
      for (int j = 0; j < 2 * rows; j += 2) {
        const std::array<int, 8> n{at(i, j),     at(i + 2, j),     at(i + 2, j + 2), at(i, j + 2),
                                   at(i + 1, j), at(i + 2, j + 1), at(i + 1, j + 2), at(i, j + 1)};
        const bool surface = surface_columns > 0 && j == 2 * rows - 2, fillet = surface && i >= 2 * surface_columns;
        const int face = !surface ? 0 : flipped ? 4 : 5;
        const double half = (*gear_.pair)[gear_.member].data.face_width / 2;
        if (flipped)
          quads_.push_back({{n[0], n[3], n[2], n[1], n[7], n[6], n[5], n[4]}, surface_.pair_of(tooth), face, half, 0, is_below_root(n), fillet});
        else
          quads_.push_back({n, surface_.pair_of(tooth), face, half, 0, is_below_root(n), fillet});
      }
    }
  }

  bool is_below_root(const std::array<int, 8>& nodes) const {
    Eigen::Vector2d centre(0, 0);
    for (std::size_t i = 0; i < 4; ++i) centre += position(static_cast<std::size_t>(nodes[i]), 0) / 4;
    return gear_.web != nullptr && centre.norm() < form_.root_radius();
  }

  void build() {
    for (int m = first_; m <= last_; ++m) {
      for (const int side : {-1, 1}) {
        grid(surface_.steps(m), options_.across, side > 0, m, side > 0 && surface_.loaded(m) ? surface_.flank_elements(m) : 0, [&](int i, int j) {
          return node({Tooth, m, side, i, j});
        });
      }
      if (surface_.capped(m)) grid(options_.across, options_.across, true, m, 0, [&](int i, int j) { return node({Cap, m, 0, i, j}); });
      for (int i = 2 * surface_.steps(m); i > 2 * corner(m); --i) around_.push_back(node({Tooth, m, -1, i, 0}));
      for (int i = 2 * corner(m); i < 2 * surface_.steps(m); ++i) around_.push_back(node({Tooth, m, 1, i, 0}));
    }
    // A full turn has to close on the teeth; elements of at most 24 deg.
    plain_ = std::max(6, static_cast<int>(std::ceil((2 * pi - (last_ - first_ + 1) * pitch_) / (options_.plain_element * units::deg))));
    grid(plain_, options_.across, true, 0, 0, [&](int i, int j) { return node({Plain, 0, 0, i, j}); });
    for (int i = 0; i < 2 * plain_; ++i) around_.push_back(node({Plain, 0, 0, i, 0}));
    const auto n = static_cast<int>(around_.size());
    const std::size_t above_rings = quads_.size();
    grid(n / 2, rings(), false, 0, 0, [&](int i, int j) { return node({Ring, 0, 0, i % n, j}); });
    if (gear_.web == nullptr) return;
    for (std::size_t k = above_rings; k < quads_.size(); ++k) {
      const int ring = static_cast<int>(k - above_rings) % rings();
      quads_[k].in_rim = ring < web_begin_;
      if (ring >= web_end_) quads_[k].half_width = gear_.web->hub_width / 2;
      if (ring >= web_begin_ && ring < web_end_) {
        quads_[k].half_width = gear_.web->web_thickness / 2;
        quads_[k].middle = gear_.web->web_offset;
      }
    }
  }

  const ContactGear& gear_;
  const ContactMeshOptions& options_;
  ToothSurface surface_;
  const ToothForm& form_;
  double pitch_, rim_;
  int first_, last_, plain_{0};
  std::vector<double> ring_ends_;  ///< radii, inwards [mm]
  int web_begin_{0}, web_end_{0};  ///< numbers of rings
  std::vector<Place> places_;
  std::map<Place, int> numbers_;
  std::vector<int> around_;
  std::vector<Quad> quads_;
};

}  // namespace

ContactMesh contact_mesh(const ContactGear& gear, const ContactMeshOptions& options) {
  const Section section(gear, options);
  ContactMesh mesh;
  mesh.planes = layer_planes(gear, options);
  mesh.flanks.resize(static_cast<std::size_t>(gear.last - gear.first + 1));
  mesh.fillets.resize(mesh.flanks.size());

  std::map<std::pair<int, int>, int> numbers;  // of (level, node of the section)
  std::vector<Eigen::Vector3d> points;
  const auto node = [&](int level, int number) {
    const auto [found, made] = numbers.try_emplace({level, number}, static_cast<int>(points.size()));
    if (made) {
      const auto k = static_cast<std::size_t>(level / 2), n = static_cast<std::size_t>(number);
      const double z = level % 2 == 0 ? mesh.planes[k] : (mesh.planes[k] + mesh.planes[k + 1]) / 2;
      const Eigen::Vector2d p = section.position(n, z);
      points.push_back({p.x(), p.y(), z});
      if (section.at_bore(n)) mesh.bore.push_back(found->second);
      if (gear.half_face && k + 1 == mesh.planes.size()) mesh.mid_face.push_back(found->second);
    }
    return found->second;
  };
  std::vector<std::array<int, 20>> bricks;
  for (int layer = 0; layer + 1 < static_cast<int>(mesh.planes.size()); ++layer) {
    const double middle = (mesh.planes[static_cast<std::size_t>(layer)] + mesh.planes[static_cast<std::size_t>(layer) + 1]) / 2;
    for (const Section::Quad& quad : section.quads()) {
      if (std::abs(middle - quad.middle) > quad.half_width) continue;
      if (quad.in_rim) mesh.rim.push_back(static_cast<int>(bricks.size()));
      std::array<int, 20> brick;
      for (std::size_t i = 0; i < 4; ++i) {
        brick[i] = node(2 * layer, quad.nodes[i]);
        brick[i + 4] = node(2 * layer + 2, quad.nodes[i]);
        brick[i + 8] = node(2 * layer, quad.nodes[i + 4]);
        brick[i + 12] = node(2 * layer + 2, quad.nodes[i + 4]);
        brick[i + 16] = node(2 * layer + 1, quad.nodes[i]);
      }
      if (quad.face != 0) {
        (quad.in_fillet ? mesh.fillets : mesh.flanks)[static_cast<std::size_t>(quad.pair - gear.first)].push_back(
            {static_cast<int>(bricks.size()), quad.face});
      }
      bricks.push_back(brick);
    }
  }
  mesh.solid.nodes.resize(3, std::ssize(points));
  for (std::size_t i = 0; i < points.size(); ++i) mesh.solid.nodes.col(static_cast<Eigen::Index>(i)) = points[i];
  mesh.solid.bricks.resize(20, std::ssize(bricks));
  for (std::size_t i = 0; i < bricks.size(); ++i) {
    for (int k = 0; k < 20; ++k) mesh.solid.bricks(k, static_cast<Eigen::Index>(i)) = bricks[i][static_cast<std::size_t>(k)];
  }
  return mesh;
}

}  // namespace flankwright::contact_truth
