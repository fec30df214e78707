#include "tests/benchmarks/beams/beam_answer.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <map>
#include <sstream>

#include "core/compliance/shaft/beam_system.hpp"
#include "core/compliance/shaft/shaft_pair.hpp"
#include "tests/benchmarks/calculix.hpp"

namespace flankwright::beam_truth {

namespace {

using Eigen::Vector3d;

/// Nodes on the axis, numbered from 1, and elements of three of them.
struct BeamMesh {
  struct Element {
    int first;  ///< node; the next two follow it
    double diameter;
  };
  std::vector<double> nodes;
  std::vector<Element> elements;

  int node_at(double z) const {
    const auto nearest = std::ranges::min_element(nodes, {}, [&](double node) { return std::abs(node - z); });
    return static_cast<int>(nearest - nodes.begin()) + 1;
  }
};

BeamMesh make_mesh(const BeamCase& of, double length) {
  std::vector<double> cuts{0.0, of.force_position};
  double end = 0.0;
  for (const ShaftSection& section : of.shaft.sections) cuts.push_back(end += section.length);
  cuts.insert(cuts.end(), of.supports.begin(), of.supports.end());
  cuts.insert(cuts.end(), of.stations.begin(), of.stations.end());
  std::ranges::sort(cuts);
  const auto repeated = std::ranges::unique(cuts);
  cuts.erase(repeated.begin(), repeated.end());
  BeamMesh mesh{{0.0}, {}};
  std::size_t section = 0;
  double section_end = of.shaft.sections.front().length;
  for (std::size_t i = 0; i + 1 < cuts.size(); ++i) {
    while (cuts[i] >= section_end) section_end += of.shaft.sections[++section].length;
    const double diameter = of.shaft.sections[section].outer_diameter, piece = cuts[i + 1] - cuts[i];
    const int count = std::max(1, static_cast<int>(std::ceil(piece / (length * diameter) - 1e-9)));
    for (int k = 0; k < count; ++k) {
      mesh.elements.push_back({static_cast<int>(mesh.nodes.size()), diameter});
      for (const double part : {0.5, 1.0}) mesh.nodes.push_back(cuts[i] + piece * (k + part) / count);
    }
  }
  return mesh;
}

void write_deck(std::ostream& out, const BeamCase& of, const BeamMesh& mesh) {
  out.precision(15);
  out << "*NODE,NSET=AXIS\n";
  for (std::size_t i = 0; i < mesh.nodes.size(); ++i) out << i + 1 << ",0.,0.," << mesh.nodes[i] << "\n";
  const auto last = static_cast<int>(mesh.nodes.size());
  const double end = mesh.nodes.back();
  out << "*NODE\n" << last + 1 << ",20.,0.," << end << "\n" << last + 2 << ",40.,0.," << end << "\n";
  std::map<double, std::vector<std::size_t>> by_diameter;
  for (std::size_t i = 0; i < mesh.elements.size(); ++i) by_diameter[mesh.elements[i].diameter].push_back(i);
  int set = 0;
  for (const auto& [diameter, elements] : by_diameter) {
    out << "*ELEMENT,TYPE=B32,ELSET=D" << ++set << "\n";
    for (const std::size_t i : elements) {
      const int first = mesh.elements[i].first;
      out << i + 1 << "," << first << "," << first + 1 << "," << first + 2 << "\n";
    }
  }
  out << "*ELEMENT,TYPE=B32,ELSET=ARM\n" << mesh.elements.size() + 1 << "," << last << "," << last + 1 << "," << last + 2 << "\n";
  out << "*MATERIAL,NAME=STEEL\n*ELASTIC\n" << of.shaft.material.youngs_modulus << "," << of.shaft.material.poissons_ratio << "\n";
  set = 0;
  for (const auto& [diameter, elements] : by_diameter) {
    out << "*BEAM SECTION,ELSET=D" << ++set << ",MATERIAL=STEEL,SECTION=CIRC\n" << diameter << "," << diameter << "\n1.,0.,0.\n";
  }
  out << "*BEAM SECTION,ELSET=ARM,MATERIAL=STEEL,SECTION=CIRC\n10.,10.\n0.,1.,0.\n*BOUNDARY\n";
  for (const double z : of.supports) out << mesh.node_at(z) << ",1,2\n";
  out << mesh.node_at(of.supports.front()) << ",3,3\n" << last + 2 << ",2,2\n";
  out << "*STEP\n*STATIC\n*CLOAD\n" << mesh.node_at(of.force_position) << ",1," << of.force << "\n*NODE PRINT,NSET=AXIS\nU,RF\n*END STEP\n";
}

/// Components x of displacements and of forces by node.
struct PrintedNodes {
  std::map<int, double> displacement, force;
};

PrintedNodes read_printed(std::istream& in) {
  PrintedNodes printed;
  std::map<int, double>* into = nullptr;
  for (std::string line; std::getline(in, line);) {
    if (line.find("displacements") != line.npos) into = &printed.displacement;
    if (line.find("forces") != line.npos) into = &printed.force;
    std::istringstream words(line);
    int node = 0;
    double x = 0.0;
    if (into != nullptr && words >> node >> x) (*into)[node] = x;
  }
  return printed;
}

double largest(const std::vector<double>& values) {
  double size = 0.0;
  for (const double value : values) size = std::max(size, std::abs(value));
  return size;
}

double largest_difference(const std::vector<double>& one, const std::vector<double>& other) {
  std::vector<double> apart;
  for (std::size_t i = 0; i < one.size(); ++i) apart.push_back(one[i] - other[i]);
  return largest(apart) / largest(one);
}

}  // namespace

BeamAnswer own_answer(const BeamCase& of) {
  std::vector<BeamSupport> supports;
  for (const double z : of.supports) {
    supports.push_back({{z, Vector3d::UnitX()}});
    supports.push_back({{z, Vector3d::UnitY()}});
  }
  supports.push_back({{of.supports.front(), Vector3d::UnitZ()}});
  supports.push_back({{0.0, Vector3d::Zero(), Vector3d::UnitZ()}});
  const BeamSystem beam(shaft_pieces(of.shaft, {}), supports);
  const std::vector<BeamLoad> force{{of.force_position, of.force * Vector3d::UnitX()}};
  std::vector<BeamLoad> stations;
  for (const double z : of.stations) stations.push_back({z, Vector3d::UnitX()});
  const Eigen::VectorXd moved = beam.flexibility(stations, force).col(0), reactions = beam.reactions(force).col(0);
  BeamAnswer answer;
  answer.solved = true;
  answer.deflection.assign(moved.begin(), moved.end());
  for (std::size_t i = 0; i < of.supports.size(); ++i) answer.reaction.push_back(reactions[static_cast<Eigen::Index>(2 * i)]);
  return answer;
}

BeamAnswer run_calculix(const BeamCase& of, double length, const std::filesystem::path& folder) {
  const BeamMesh mesh = make_mesh(of, length);
  std::filesystem::create_directories(folder);
  {
    std::ofstream deck(folder / "beam.inp");
    write_deck(deck, of, mesh);
  }
  BeamAnswer answer;
  answer.elements = static_cast<int>(mesh.elements.size());
  if (calculix::run(folder, "beam") != 0) return answer;
  std::ifstream in(folder / "beam.dat");
  const PrintedNodes printed = read_printed(in);
  if (printed.displacement.size() != mesh.nodes.size() || printed.force.size() != mesh.nodes.size()) return answer;
  for (const double z : of.stations) answer.deflection.push_back(printed.displacement.at(mesh.node_at(z)));
  for (const double z : of.supports) answer.reaction.push_back(printed.force.at(mesh.node_at(z)));
  answer.solved = true;
  return answer;
}

BeamDifference difference(const BeamAnswer& one, const BeamAnswer& other) {
  return {largest_difference(one.deflection, other.deflection), largest_difference(one.reaction, other.reaction)};
}

}  // namespace flankwright::beam_truth
