// The same mesh, supports and loads in an independent program, CalculiX (Debian package calculix-ccx).
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iomanip>
#include <sstream>

#include "core/compliance/finite_element/load_functional.hpp"
#include "tests/core/compliance/finite_element/gears.hpp"

using namespace flankwright;
using namespace flankwright::test;

namespace {

/// An input deck with one static step; nodes and elements are numbered from 1.
void write_deck(std::ostream& out, const SolidMesh& mesh, const Material& material, const std::vector<int>& clamped, const Eigen::VectorXd& load) {
  // A field may have 20 characters.
  out << std::scientific << std::setprecision(12) << "*NODE, NSET=NALL\n";
  for (Eigen::Index i = 0; i < mesh.nodes.cols(); ++i) {
    out << i + 1 << ", " << mesh.nodes(0, i) << ", " << mesh.nodes(1, i) << ", " << mesh.nodes(2, i) << '\n';
  }
  out << "*ELEMENT, TYPE=C3D20, ELSET=EALL\n";
  for (Eigen::Index e = 0; e < mesh.bricks.cols(); ++e) {
    out << e + 1;
    for (int i = 0; i < 20; ++i) out << (i == 10 ? ",\n" : ", ") << mesh.bricks(i, e) + 1;
    out << '\n';
  }
  for (const TiedNode& tie : mesh.tied) {
    for (int axis = 1; axis <= 3; ++axis) {
      out << "*EQUATION\n" << tie.follows.size() + 1 << '\n' << tie.node + 1 << ", " << axis << ", -1.0";
      for (std::size_t i = 0; i < tie.follows.size(); ++i) {  // at most four terms a line
        out << (i % 4 == 3 ? ",\n" : ", ") << tie.follows[i].first + 1 << ", " << axis << ", " << tie.follows[i].second;
      }
      out << '\n';
    }
  }
  out << "*MATERIAL, NAME=STEEL\n*ELASTIC\n"
      << material.youngs_modulus << ", " << material.poissons_ratio << '\n'
      << "*SOLID SECTION, ELSET=EALL, MATERIAL=STEEL\n*BOUNDARY\n";
  for (const int node : clamped) out << node + 1 << ", 1, 3\n";
  out << "*STEP\n*STATIC\n*CLOAD\n";
  for (Eigen::Index i = 0; i < load.size(); ++i) {
    if (load[i] != 0) out << i / 3 + 1 << ", " << i % 3 + 1 << ", " << load[i] << '\n';
  }
  out << "*NODE PRINT, NSET=NALL\nU\n*END STEP\n";
}

Eigen::VectorXd read_displacements(const std::filesystem::path& file, Eigen::Index nodes) {
  Eigen::VectorXd result = Eigen::VectorXd::Constant(3 * nodes, not_given);
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Eigen::Index node;
    double x, y, z;
    if (words >> node >> x >> y >> z && node >= 1 && node <= nodes) result.segment<3>(3 * (node - 1)) << x, y, z;
  }
  return result;
}

}  // namespace

TEST_CASE("CalculiX finds the same displacements on the same mesh", "[core][compliance][fe][calculix]") {
  if (std::system("command -v ccx > /dev/null 2>&1") != 0) {
    WARN("skipped: CalculiX (ccx, Debian package calculix-ccx) is not installed");
    return;
  }
  const Material steel{206000, 0.3};
  GearMeshOptions options = coarse();
  options.largest_element = options.end_element = 0.2;  // short enough for joined layers
  const GearMesh mesh = gear_mesh(gear_of(18, 30, 3), options);
  REQUIRE(mesh.solid.tied.size() > 50);
  const Eigen::VectorXd load = 1000 * Eigen::VectorXd(centre_functional(mesh, {0, mesh.form.reference_radius(), 0.5}));
  std::vector<int> clamped;
  std::vector<NodeSupport> supports;
  const double end = mesh.solid.nodes.row(2).minCoeff();
  for (int i = 0; i < mesh.solid.nodes.cols(); ++i) {
    if (mesh.solid.nodes(2, i) > end + 1e-9) continue;
    clamped.push_back(i);
    supports.push_back({i});
  }
  const Eigen::SparseMatrix<double> column = Eigen::MatrixXd(load).sparseView();
  const Eigen::VectorXd ours = SolidModel(mesh.solid, steel, supports).solve(column);

  const auto folder = std::filesystem::temp_directory_path() / ("flankwright_ccx_" + std::to_string(std::rand()));
  std::filesystem::create_directories(folder);
  {
    std::ofstream deck(folder / "gear.inp");
    write_deck(deck, mesh.solid, steel, clamped, load);
  }
  const int code = std::system(("cd " + folder.string() + " && OMP_NUM_THREADS=1 ccx gear > ccx.log 2>&1").c_str());
  const Eigen::VectorXd theirs = read_displacements(folder / "gear.dat", mesh.solid.nodes.cols());
  std::filesystem::remove_all(folder);
  REQUIRE(code == 0);
  REQUIRE(theirs.allFinite());
  // CalculiX prints seven digits.
  CHECK((ours - theirs).cwiseAbs().maxCoeff() < 1e-6 * ours.cwiseAbs().maxCoeff());
  CHECK(load.dot(theirs) == Approx(load.dot(ours)).epsilon(1e-6));
}
