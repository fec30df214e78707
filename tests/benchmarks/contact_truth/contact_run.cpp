#include "tests/benchmarks/contact_truth/contact_run.hpp"
#include "core/gear/gear_pair.hpp"
#include "tests/benchmarks/calculix.hpp"

#include <sys/resource.h>

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iomanip>
#include <map>
#include <set>
#include <sstream>

namespace flankwright::contact_truth {
namespace {

/// Both gears' meshes in the housing's frame, numbered one after the other.
struct ContactModel {
  GearPair pair;
  FlankAssembly scene;
  int first{0}, last{0};  ///< tooth pairs that may touch
  std::array<ContactMesh, 2> meshes;
  std::array<Eigen::Index, 2> first_node{}, first_brick{};

  ContactModel(const ContactTask& task, const ContactMeshOptions& options)
      : pair(make_gear_pair(task.pair)),
        scene(assemble_flanks(pair, {.modification = task.condition.modification, .misalignment = task.condition.misalignment})) {
    // A pair may be pressed together this far before A and after E [base pitches].
    constexpr double beyond = 0.15;
    const PathOfContact path(pair);
    const auto may_touch = [&](int tooth) {
      const double a = path.phase_at(task.phase + tooth, -path.half_face), b = path.phase_at(task.phase + tooth, path.half_face);
      return std::max(a, b) > path.before - beyond && std::min(a, b) < path.path_end() + beyond;
    };
    while (!may_touch(first)) ++first;
    while (may_touch(first - 1)) --first;
    last = first;
    while (may_touch(last + 1)) ++last;
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const std::size_t g = m == Member::Pinion ? 0 : 1;
      const Flank& flank = g == 0 ? scene.pinion : scene.wheel;
      meshes[g] = contact_mesh(contact_gear(task, pair, flank, m, first, last), options);
    }
    first_node = {0, meshes[0].solid.nodes.cols()};
    first_brick = {0, meshes[0].solid.bricks.cols()};
  }

  Eigen::Vector3d place(std::size_t gear, Eigen::Index node) const {
    const Eigen::Vector3d p = meshes[gear].solid.nodes.col(node);
    return gear == 0 ? p : Eigen::Vector3d(scene.wheel_centre + scene.wheel_axes * p);
  }
  /// The elements' faces of one layer of a flank; all layers have equally many.
  std::vector<ElementFace> layer_faces(std::size_t gear, int tooth, std::size_t layer) const {
    const auto& faces = meshes[gear].flanks[static_cast<std::size_t>(tooth - first)];
    const std::size_t n = faces.size() / (meshes[gear].planes.size() - 1);
    const auto begin = faces.begin() + static_cast<std::ptrdiff_t>(layer * n);
    return {begin, begin + static_cast<std::ptrdiff_t>(n)};
  }
  std::size_t layers() const { return meshes[0].planes.size() - 1; }
  std::vector<int> rim_nodes(std::size_t gear) const {
    std::set<int> nodes;
    for (const int brick : meshes[gear].rim) {
      for (int i = 0; i < 20; ++i) nodes.insert(meshes[gear].solid.bricks(i, brick));
    }
    return {nodes.begin(), nodes.end()};
  }
  std::vector<int> fillet_nodes(std::size_t gear) const {
    std::set<int> nodes;
    for (const auto& fillet : meshes[gear].fillets) {
      for (const ElementFace& f : fillet) {
        for (const int i : nodes_of_face_4) nodes.insert(meshes[gear].solid.bricks(i, f.brick));
      }
    }
    return {nodes.begin(), nodes.end()};
  }
  /// See ContactAnswer::fillets.
  std::vector<FilletFace> fillet_faces(std::size_t gear, const std::map<Eigen::Index, Eigen::Vector3d>& displacements) const {
    std::vector<FilletFace> faces;
    for (int k = first; k <= last; ++k) {
      for (const ElementFace& f : meshes[gear].fillets[static_cast<std::size_t>(k - first)]) {
        FilletFace& face = faces.emplace_back(FilletFace{k, {}, {}});
        for (int i = 0; i < 8; ++i) {
          const int node = meshes[gear].solid.bricks(nodes_of_face_4[static_cast<std::size_t>(i)], f.brick);
          face.nodes.col(i) = place(gear, node);
          face.displacements.col(i) = displacements.at(node);
        }
      }
    }
    return faces;
  }
  /// See ContactAnswer::rim.
  Eigen::Vector<double, 6> rim_motion(std::size_t gear, const std::map<Eigen::Index, Eigen::Vector3d>& displacements) const {
    const ContactMesh& mesh = meshes[gear];
    const Eigen::Vector3d centre = gear == 0 ? Eigen::Vector3d(0, 0, 0) : scene.wheel_centre;
    Eigen::Matrix<double, 6, 6> normal = Eigen::Matrix<double, 6, 6>::Zero();
    Eigen::Vector<double, 6> right = Eigen::Vector<double, 6>::Zero();
    for (const int brick : mesh.rim) {
      BrickNodes nodes, moved;
      for (int i = 0; i < 20; ++i) {
        nodes.col(i) = place(gear, mesh.solid.bricks(i, brick)) - centre;
        moved.col(i) = displacements.at(mesh.solid.bricks(i, brick));
      }
      for (int i = 0; i < 27; ++i) {
        const int a = i % 3, b = i / 3 % 3, c = i / 9;
        const BrickShape shape = brick_shape({gauss3_abscissae[a], gauss3_abscissae[b], gauss3_abscissae[c]});
        const Eigen::Matrix3d jacobian = nodes * shape.derivatives;
        const double volume = gauss3_weights[a] * gauss3_weights[b] * gauss3_weights[c] * std::abs(jacobian.determinant());
        const Eigen::Vector3d x = nodes * shape.values;
        Eigen::Matrix<double, 6, 3> rigid;  // u = rigid' (t, omega)
        rigid << Eigen::Matrix3d::Identity(), Eigen::Matrix3d{{0, -x.z(), x.y()}, {x.z(), 0, -x.x()}, {-x.y(), x.x(), 0}};
        normal += volume * rigid * rigid.transpose();
        right += volume * rigid * (moved * shape.values);
      }
    }
    return normal.ldlt().solve(right);
  }
};

std::string numbered(std::string name, std::size_t number) { return name += std::to_string(number); }
// Tooth pairs from -10 on.
std::string slave(int tooth, std::size_t layer) { return numbered(numbered("P", static_cast<std::size_t>(tooth + 10)) += "L", layer); }
std::string master(int tooth) { return numbered("W", static_cast<std::size_t>(tooth + 10)); }

/// All nodes of a line along the axis move as its first one does, but those of the bores, whose motion is given.
void write_plane_strain(std::ostream& out, const ContactModel& model) {
  out << "*EQUATION\n";
  for (std::size_t g : {0U, 1U}) {
    const ContactMesh& mesh = model.meshes[g];
    const std::set<int> held(mesh.bore.begin(), mesh.bore.end());
    std::map<std::pair<double, double>, Eigen::Index> first;  // spur gears: places of a line are alike to the bit
    for (Eigen::Index i = 0; i < mesh.solid.nodes.cols(); ++i) {
      const auto [found, made] = first.try_emplace({mesh.solid.nodes(0, i), mesh.solid.nodes(1, i)}, i);
      if (made || held.contains(static_cast<int>(i))) continue;
      const Eigen::Index other = model.first_node[g] + found->second + 1, own = model.first_node[g] + i + 1;
      for (const int direction : {1, 2}) out << "2\n" << own << ", " << direction << ", 1., " << other << ", " << direction << ", -1.\n";
    }
  }
}

/// The pinion's flanks are the slaves, a surface per layer so that each one's force is printed.
void write_deck(std::ostream& out, const ContactModel& model, const ContactTask& task, const ContactSettings& settings) {
  out << std::scientific << std::setprecision(12) << "*NODE, NSET=ALL\n";
  for (std::size_t g : {0U, 1U}) {
    for (Eigen::Index i = 0; i < model.meshes[g].solid.nodes.cols(); ++i) {
      const Eigen::Vector3d p = model.place(g, i);
      out << model.first_node[g] + i + 1 << ", " << p.x() << ", " << p.y() << ", " << p.z() << '\n';
    }
  }
  out << "*ELEMENT, TYPE=" << (settings.reduced_integration ? "C3D20R" : "C3D20") << ", ELSET=GEARS\n";
  for (std::size_t g : {0U, 1U}) {
    const auto& bricks = model.meshes[g].solid.bricks;
    for (Eigen::Index e = 0; e < bricks.cols(); ++e) {
      out << model.first_brick[g] + e + 1;
      for (int i = 0; i < 20; ++i) out << (i == 10 ? ",\n" : ", ") << model.first_node[g] + bricks(i, e) + 1;
      out << '\n';
    }
  }
  const auto surface = [&](const std::string& name, std::size_t gear, const std::vector<ElementFace>& faces) {
    out << "*SURFACE, NAME=" << name << '\n';
    for (const ElementFace& f : faces) out << model.first_brick[gear] + f.brick + 1 << ", S" << f.face << '\n';
  };
  for (int k = model.first; k <= model.last; ++k) {
    surface(master(k), 1, model.meshes[1].flanks[static_cast<std::size_t>(k - model.first)]);
    for (std::size_t layer = 0; layer < model.layers(); ++layer) surface(slave(k, layer), 0, model.layer_faces(0, k, layer));
  }
  const auto node_set = [&](const std::string& name, std::size_t gear, const std::vector<int>& nodes) {
    out << "*NSET, NSET=" << name << '\n';
    for (const int n : nodes) out << model.first_node[gear] + n + 1 << ",\n";
  };
  for (std::size_t g : {0U, 1U}) {
    node_set(numbered("BORE", g), g, model.meshes[g].bore);
    if (task.half_face) node_set(numbered("MIDDLE", g), g, model.meshes[g].mid_face);
  }
  for (std::size_t g : {0U, 1U}) {
    if (!model.meshes[g].rim.empty()) node_set(numbered("RIM", g), g, model.rim_nodes(g));
    if (settings.fillets) node_set(numbered("FILLET", g), g, model.fillet_nodes(g));
  }
  out << "*ELSET, ELSET=SKIN\n";
  for (const auto& flank : model.meshes[0].flanks) {
    for (const ElementFace& f : flank) out << f.brick + 1 << ",\n";
  }
  out << "*MATERIAL, NAME=STEEL\n*ELASTIC\n"
      << task.material.youngs_modulus << ", " << task.material.poissons_ratio
      << "\n*SOLID SECTION, ELSET=GEARS, MATERIAL=STEEL\n*SURFACE INTERACTION, NAME=CONTACT\n"
         "*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE=LINEAR\n"
      << settings.penalty << '\n';
  for (int k = model.first; k <= model.last; ++k) {
    for (std::size_t layer = 0; layer < model.layers(); ++layer) {
      out << "*CONTACT PAIR, INTERACTION=CONTACT, TYPE=SURFACE TO SURFACE\n" << slave(k, layer) << ", " << master(k) << '\n';
    }
  }
  out << "*BOUNDARY\nBORE1, 1, 3\nBORE0, 3, 3\n";
  if (task.half_face) out << "MIDDLE0, 3, 3\nMIDDLE1, 3, 3\n";
  if (task.plane_strain) {
    out << "ALL, 3, 3\n";
    write_plane_strain(out, model);
  }
  out << "*STEP, INC=50\n*STATIC\n1., 1.\n*BOUNDARY\n";
  const double turn = task.approach / (model.pair.pinion.base_radius * std::cos(model.pair.base_helix_angle));
  for (const int n : model.meshes[0].bore) {
    const Eigen::Vector3d p = model.place(0, n);
    out << n + 1 << ", 1, 1, " << -turn * p.y() << '\n' << n + 1 << ", 2, 2, " << turn * p.x() << '\n';
  }
  out << "*NODE PRINT, NSET=BORE0\nRF\n*NODE PRINT, NSET=BORE1\nRF\n";
  for (std::size_t g : {0U, 1U}) {
    if (!model.meshes[g].rim.empty()) out << "*NODE PRINT, NSET=" << numbered("RIM", g) << "\nU\n";
    if (settings.fillets) out << "*NODE PRINT, NSET=" << numbered("FILLET", g) << "\nU\n";
  }
  for (int k = model.first; k <= model.last; ++k) {
    for (std::size_t layer = 0; layer < model.layers(); ++layer) {
      out << "*CONTACT PRINT, SLAVE=" << slave(k, layer) << ", MASTER=" << master(k) << "\nCF\n";
    }
  }
  out << "*EL PRINT, ELSET=SKIN\nS\n*END STEP\n";
}

/// The next line of numbers.
std::vector<double> next_numbers(std::istream& in) {
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::vector<double> numbers;
    for (double x; words >> x;) numbers.push_back(x);
    if (!numbers.empty()) return numbers;
  }
  return {};
}

void read_answer(std::istream& in, const ContactModel& model, const ContactSettings& settings, bool half_face, ContactAnswer& answer) {
  std::map<Eigen::Index, std::pair<int, std::size_t>> layer_of;  // of an element, from 1
  std::map<std::pair<int, std::size_t>, double> compression;
  for (int k = model.first; k <= model.last; ++k) {
    for (std::size_t layer = 0; layer < model.layers(); ++layer) {
      for (const ElementFace& f : model.layer_faces(0, k, layer)) layer_of[f.brick + 1] = {k, layer};
    }
  }
  enum { Nothing, Bore0, Bore1, Stress, Moved0, Moved1 } block = Nothing;
  std::map<Eigen::Index, Eigen::Vector3d> displacements[2];
  double moments[2] = {0, 0};
  bool complete = false;
  for (std::string line; std::getline(in, line);) {
    if (line.find("set BORE0") != line.npos) {
      // Every increment begins here; what counts is the last one.
      answer.layers.clear();
      compression.clear();
      moments[0] = moments[1] = 0;
      complete = false;
      block = Bore0;
    } else if (line.find("set BORE1") != line.npos)
      block = Bore1;
    else if (line.find("set RIM0") != line.npos || line.find("set FILLET0") != line.npos)
      block = Moved0;
    else if (line.find("set RIM1") != line.npos || line.find("set FILLET1") != line.npos)
      block = Moved1;
    else if (line.find("stresses (elem") != line.npos)
      block = Stress;
    else if (line.find("total surface force") != line.npos) {
      block = Nothing;
      const std::vector<double> force = next_numbers(in);
      if (force.size() < 3) return;
      const std::size_t i = answer.layers.size(), layer = i % model.layers();
      const int tooth = model.first + static_cast<int>(i / model.layers());
      const auto& planes = model.meshes[0].planes;
      answer.layers.push_back({tooth, planes[layer], planes[layer + 1], std::hypot(force[0], force[1], force[2]), compression[{tooth, layer}]});
      complete = answer.layers.size() == model.layers() * static_cast<std::size_t>(model.last - model.first + 1);
    } else if (block != Nothing) {
      std::istringstream words(line);
      Eigen::Index number;
      if (!(words >> number)) continue;
      if (block == Stress) {
        double point, xx, yy, zz, xy, xz, yz;
        if (!(words >> point >> xx >> yy >> zz >> xy >> xz >> yz) || !layer_of.contains(number)) continue;
        Eigen::Matrix3d stress;
        stress << xx, xy, xz, xy, yy, yz, xz, yz, zz;
        const double lowest = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(stress, Eigen::EigenvaluesOnly).eigenvalues()[0];
        compression[layer_of[number]] = std::max(compression[layer_of[number]], -lowest);
      } else if (block == Moved0 || block == Moved1) {
        const std::size_t g = block == Moved0 ? 0 : 1;
        Eigen::Vector3d u;
        if (words >> u.x() >> u.y() >> u.z()) displacements[g][number - 1 - model.first_node[g]] = u;
      } else {
        const std::size_t g = block == Bore0 ? 0 : 1;
        Eigen::Vector3d force;
        words >> force.x() >> force.y() >> force.z();
        const Eigen::Vector3d axis = g == 0 ? Eigen::Vector3d::UnitZ() : Eigen::Vector3d(model.scene.wheel_axes.col(2));
        const Eigen::Vector3d centre = g == 0 ? Eigen::Vector3d(0, 0, 0) : model.scene.wheel_centre;
        moments[g] += axis.dot((model.place(g, number - 1 - model.first_node[g]) - centre).cross(force));
      }
    }
  }
  if (half_face) {
    for (double& m : moments) m *= 2;
  }
  if (complete) {
    for (const Member m : {Member::Pinion, Member::Wheel}) {
      const std::size_t g = m == Member::Pinion ? 0 : 1;
      if (!model.meshes[g].rim.empty()) answer.rim[m] = model.rim_motion(g, displacements[g]);
      if (settings.fillets) answer.fillets[m] = model.fillet_faces(g, displacements[g]);
    }
  }
  // Both bores hold against the drive: the pinion's moment drives, and the wheel's hinders its clockwise turn.
  answer.pinion_torque = moments[0];
  answer.wheel_torque = moments[1];
  answer.converged = complete;
}

}  // namespace

double ContactAnswer::force() const {
  double sum = 0;
  for (const LayerLoad& l : layers) sum += l.force;
  return sum;
}

double ContactAnswer::share(int tooth) const {
  double sum = 0;
  for (const LayerLoad& l : layers) sum += l.tooth == tooth ? l.force : 0;
  return sum / force();
}

double ContactAnswer::peak_compression() const {
  double peak = 0;
  for (const LayerLoad& l : layers) peak = std::max(peak, l.peak_compression);
  return peak;
}

double ContactAnswer::peak_compression(int tooth) const {
  double peak = 0;
  for (const LayerLoad& l : layers) peak = l.tooth == tooth ? std::max(peak, l.peak_compression) : peak;
  return peak;
}

ContactGear contact_gear(const ContactTask& task, const GearPair& pair, const Flank& flank, Member member, int first, int last) {
  const WebbedBody* web = task.web[member] ? &*task.web[member] : nullptr;
  return {&pair, &flank, member, task.phase, task.bore_radius[member], first, last, task.half_face, web};
}

bool calculix_is_installed() { return calculix::is_installed(); }

ContactAnswer run_calculix(const ContactTask& task, const ContactSettings& settings, const std::filesystem::path& folder) {
  const ContactModel model(task, settings.mesh);
  std::filesystem::create_directories(folder);
  {
    std::ofstream deck(folder / "pair.inp");
    write_deck(deck, model, task, settings);
  }
  const auto usage = [] {
    rusage used{};
    getrusage(RUSAGE_CHILDREN, &used);
    return used;
  };
  const auto seconds = [](const rusage& used) {
    return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
           1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
  };
  ContactAnswer answer;
  answer.unknowns = model.meshes[0].solid.nodes.size() + model.meshes[1].solid.nodes.size();
  const double before = seconds(usage());
  const int code = calculix::run(folder, "pair");
  answer.processor_seconds = seconds(usage()) - before;
  answer.peak_bytes = 1024.0 * static_cast<double>(usage().ru_maxrss);  // of the largest run so far
  if (code != 0) return answer;
  std::ifstream in(folder / "pair.dat");
  read_answer(in, model, settings, task.half_face, answer);
  return answer;
}

}  // namespace flankwright::contact_truth
