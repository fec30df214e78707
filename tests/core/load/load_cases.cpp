#include "tests/core/load/load_cases.hpp"

namespace flankwright::load_cases {

Eigen::MatrixXd influence(Structure structure, Eigen::Index n, double compliance, Random& random) {
  switch (structure) {
    case Structure::Slices:
      return compliance * random.vector(n, 0.5, 2.0).asDiagonal().toDenseMatrix();
    case Structure::DecayingKernel: {
      const double reach = random.log_uniform(0.5, 50.0);
      return Eigen::MatrixXd::NullaryExpr(
          n, n, [&](Eigen::Index i, Eigen::Index j) { return compliance * std::exp(-std::abs(static_cast<double>(i - j)) / reach); });
    }
    case Structure::LowRank: {
      const Eigen::Index rank = std::max<Eigen::Index>(1, n / 4);
      const Eigen::MatrixXd factor = random.matrix(n, rank);
      return compliance / static_cast<double>(rank) * factor * factor.transpose();
    }
    case Structure::WholeBody:
      return Eigen::MatrixXd::Constant(n, n, compliance);
    case Structure::Rigid:
      return Eigen::MatrixXd::Zero(n, n);
  }
  __builtin_unreachable();
}

std::vector<ContactLaw> random_laws(Eigen::Index n, Random& random) {
  std::vector<ContactLaw> laws;
  for (Eigen::Index i = 0; i < n; ++i) {
    const double tip = random.integer(0, 2) == 0 ? random.log_uniform(1e-3, 10.0) : std::numeric_limits<double>::infinity();
    laws.push_back(steel_law(random.log_uniform(1.0, 300.0), random.log_uniform(0.5, 50.0), random.log_uniform(0.5, 50.0), tip));
  }
  return laws;
}

LoadProblem random_problem(int n, Random& random) {
  LoadProblem problem;
  problem.weight = random.vector(n, 0.1, 1.0) * random.log_uniform(0.1, 10.0);
  const auto structure = static_cast<Structure>(random.integer(0, 4));
  problem.influence = influence(structure, n, random.log_uniform(1e-8, 1e-4), random);
  problem.gap = random.integer(0, 5) == 0 ? Eigen::VectorXd(Eigen::VectorXd::Zero(n))
                                          : Eigen::VectorXd(random.vector(n, 0.0, 1.0) * random.log_uniform(1e-7, 1.0));
  if (random.integer(0, 3) == 0) problem.gap.array() += random(-1.0, 1.0);
  if (random.integer(0, 7) != 0) {
    problem.laws = random_laws(n, random);
  } else if (structure == Structure::Rigid) {
    problem.influence = influence(Structure::Slices, n, 1e-5, random);
  } else {
    // Without contact law K has to be definite; this makes it so by little.
    problem.influence.diagonal().array() += random.log_uniform(1e-8, 1e-2) * problem.influence.diagonal().maxCoeff();
  }
  problem.force = random.log_uniform(1e-3, 1e6) * problem.weight.sum();
  return problem;
}

Optimality optimality(const LoadProblem& problem, const Eigen::VectorXd& w, double f) {
  Optimality result;
  result.non_negative = w.minCoeff() >= 0.0;
  result.balance = std::abs(problem.weight.dot(w) - problem.force) / problem.force;
  const Eigen::VectorXd forces = problem.weight.cwiseProduct(w);
  const Eigen::VectorXd bent = problem.influence * forces, terms = problem.influence.cwiseAbs() * forces;
  double deflection = 0.0;
  for (Eigen::Index i = 0; i < w.size(); ++i) {
    const double local = problem.laws.empty() ? 0.0 : problem.laws[static_cast<std::size_t>(i)].deflection(std::max(0.0, w[i]));
    const double remaining = bent[i] + local + (problem.gap[i] - f);
    // f may be known to its last digit and no better.
    const double digits = std::numeric_limits<double>::epsilon() * std::abs(f);
    double& part = w[i] > 0.0 ? result.loaded : result.unloaded;
    part = std::max(part, (w[i] > 0.0 ? std::abs(remaining) : -remaining) - digits);
    if (w[i] > 0.0) deflection = std::max(deflection, terms[i] + local);
  }
  result.loaded /= deflection;
  result.unloaded /= deflection;
  return result;
}

}  // namespace flankwright::load_cases
