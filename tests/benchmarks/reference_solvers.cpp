#include "tests/benchmarks/reference_solvers.hpp"

#include <IpIpoptApplication.hpp>
#include <IpTNLP.hpp>
#include <algorithm>
#include <array>
#include <ctime>
#include <nlopt.hpp>

namespace flankwright::reference_solvers {

namespace {

/// Gauss-Legendre on 0 .. 1, ten points.
constexpr std::array<std::array<double, 2>, 10> gauss{{{0.013046735741414139, 0.033335672154344069},
                                                       {0.067468316655507744, 0.074725674575290297},
                                                       {0.16029521585048780, 0.10954318125799102},
                                                       {0.28330230293537640, 0.13463335965499818},
                                                       {0.42556283050918439, 0.14776211235737644},
                                                       {0.57443716949081561, 0.14776211235737644},
                                                       {0.71669769706462360, 0.13463335965499818},
                                                       {0.83970478414951220, 0.10954318125799102},
                                                       {0.93253168334449226, 0.074725674575290297},
                                                       {0.98695326425858586, 0.033335672154344069}}};

/// In shares x = a w/F of the force, sum x = 1, divided by the force and by the deflection under an even load: every number of the
/// order of one, as general solvers like it.
class Programme {
 public:
  explicit Programme(const LoadProblem& problem)
      : problem_(problem),
        size_(problem.gap.size()),
        gap_(problem.gap.array() - problem.gap.minCoeff()),
        load_per_share_(problem.force * problem.weight.cwiseInverse()),
        even_(problem.weight / problem.weight.sum()) {
    scale_ = (problem.force * problem.influence * even_ + local(even_)).mean();
  }

  Eigen::Index size() const { return size_; }
  const Eigen::VectorXd& even() const { return even_; }
  Eigen::VectorXd loads(const Eigen::VectorXd& x) const { return load_per_share_.cwiseProduct(x); }

  double objective(const Eigen::VectorXd& x) const {
    double sum = 0.5 * problem_.force * x.dot(problem_.influence * x) + gap_.dot(x);
    for (std::size_t i = 0; i < problem_.laws.size(); ++i) {
      const double share = std::max(0.0, x[static_cast<Eigen::Index>(i)]);
      const double load = load_per_share_[static_cast<Eigen::Index>(i)] * share;
      // Integral of the law over the load by w = load t^2, in which it is smooth.
      for (const auto& [t, weight] : gauss) sum += share * weight * 2.0 * t * problem_.laws[i].deflection(load * t * t);
    }
    return sum / scale_;
  }
  Eigen::VectorXd gradient(const Eigen::VectorXd& x) const { return (problem_.force * problem_.influence * x + local(x) + gap_) / scale_; }
  Eigen::MatrixXd hessian(const Eigen::VectorXd& x) const {
    Eigen::MatrixXd H = problem_.force / scale_ * problem_.influence;
    for (std::size_t i = 0; i < problem_.laws.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      const double load = std::max(load_per_share_[k] * x[k], 1e-9 * load_per_share_[k] * even_[k]);
      H(k, k) += problem_.laws[i].slope(load) * load_per_share_[k] / scale_;
    }
    return H;
  }

 private:
  Eigen::VectorXd local(const Eigen::VectorXd& x) const {
    Eigen::VectorXd c = Eigen::VectorXd::Zero(size_);
    for (std::size_t i = 0; i < problem_.laws.size(); ++i) {
      const auto k = static_cast<Eigen::Index>(i);
      c[k] = problem_.laws[i].deflection(std::max(0.0, load_per_share_[k] * x[k]));
    }
    return c;
  }

  const LoadProblem& problem_;
  Eigen::Index size_;
  Eigen::VectorXd gap_, load_per_share_, even_;
  double scale_{1.0};
};

/// Adds the time of its scope to an answer.
class Callback {
 public:
  explicit Callback(Answer& answer) : answer_(answer), start_(processor_ms()) {}
  ~Callback() { answer_.callback_ms += processor_ms() - start_; }
  Callback(const Callback&) = delete;
  Callback& operator=(const Callback&) = delete;

 private:
  Answer& answer_;
  double start_;
};

class IpoptProgramme final : public Ipopt::TNLP {
 public:
  IpoptProgramme(const Programme& programme, Answer& answer) : programme_(programme), answer_(answer), n_(static_cast<int>(programme.size())) {}

  bool get_nlp_info(Ipopt::Index& n, Ipopt::Index& m, Ipopt::Index& nnz_jac_g, Ipopt::Index& nnz_h_lag, IndexStyleEnum& index_style) override {
    n = nnz_jac_g = n_;
    m = 1;
    nnz_h_lag = n_ * (n_ + 1) / 2;
    index_style = C_STYLE;
    return true;
  }
  bool get_bounds_info(Ipopt::Index n, Ipopt::Number* x_l, Ipopt::Number* x_u, Ipopt::Index, Ipopt::Number* g_l, Ipopt::Number* g_u) override {
    std::fill_n(x_l, n, 0.0);
    std::fill_n(x_u, n, 2e19);
    g_l[0] = g_u[0] = 1.0;
    return true;
  }
  bool get_starting_point(Ipopt::Index n, bool, Ipopt::Number* x, bool, Ipopt::Number*, Ipopt::Number*, Ipopt::Index, bool, Ipopt::Number*) override {
    std::copy_n(programme_.even().data(), n, x);
    return true;
  }
  bool eval_f(Ipopt::Index, const Ipopt::Number* x, bool, Ipopt::Number& value) override {
    const Callback timed(answer_);
    value = programme_.objective(at(x));
    return true;
  }
  bool eval_grad_f(Ipopt::Index n, const Ipopt::Number* x, bool, Ipopt::Number* gradient) override {
    const Callback timed(answer_);
    ++answer_.evaluations;
    const Eigen::VectorXd g = programme_.gradient(at(x));
    std::copy_n(g.data(), n, gradient);
    return true;
  }
  bool eval_g(Ipopt::Index, const Ipopt::Number* x, bool, Ipopt::Index, Ipopt::Number* g) override {
    g[0] = at(x).sum();
    return true;
  }
  bool eval_jac_g(Ipopt::Index n, const Ipopt::Number*, bool, Ipopt::Index, Ipopt::Index, Ipopt::Index* rows, Ipopt::Index* columns,
                  Ipopt::Number* values) override {
    if (values != nullptr) {
      std::fill_n(values, n, 1.0);
      return true;
    }
    for (int j = 0; j < n; ++j) {
      rows[j] = 0;
      columns[j] = j;
    }
    return true;
  }
  bool eval_h(Ipopt::Index, const Ipopt::Number* x, bool, Ipopt::Number factor, Ipopt::Index, const Ipopt::Number*, bool, Ipopt::Index,
              Ipopt::Index* rows, Ipopt::Index* columns, Ipopt::Number* values) override {
    const Callback timed(answer_);
    Eigen::MatrixXd H;
    if (values != nullptr) H = factor * programme_.hessian(at(x));
    for (int j = 0, k = 0; j < n_; ++j) {
      for (int i = j; i < n_; ++i, ++k) {
        if (values != nullptr) {
          values[k] = H(i, j);
        } else {
          rows[k] = i;
          columns[k] = j;
        }
      }
    }
    return true;
  }
  void finalize_solution(Ipopt::SolverReturn, Ipopt::Index, const Ipopt::Number* x, const Ipopt::Number*, const Ipopt::Number*, Ipopt::Index,
                         const Ipopt::Number*, const Ipopt::Number*, Ipopt::Number, const Ipopt::IpoptData*,
                         Ipopt::IpoptCalculatedQuantities*) override {
    answer_.line_load = programme_.loads(at(x).cwiseMax(0.0));
  }

 private:
  Eigen::VectorXd at(const Ipopt::Number* x) const { return Eigen::Map<const Eigen::VectorXd>(x, n_); }

  const Programme& programme_;
  Answer& answer_;
  int n_;
};

/// Set up once: what is measured is solving.
Ipopt::IpoptApplication& ipopt() {
  static const Ipopt::SmartPtr<Ipopt::IpoptApplication> application = [] {
    Ipopt::SmartPtr<Ipopt::IpoptApplication> a = new Ipopt::IpoptApplication(false);
    a->Options()->SetStringValue("sb", "yes");
    a->Options()->SetIntegerValue("print_level", 0);
    a->Options()->SetStringValue("linear_solver", "mumps");
    a->Options()->SetStringValue("mu_strategy", "adaptive");
    a->Options()->SetStringValue("jac_c_constant", "yes");
    a->Options()->SetNumericValue("tol", 1e-10);
    a->Options()->SetNumericValue("compl_inf_tol", 1e-12);
    a->Options()->SetIntegerValue("acceptable_iter", 0);
    a->Options()->SetNumericValue("bound_relax_factor", 0.0);
    a->Initialize("");
    return a;
  }();
  return *application;
}

}  // namespace

Answer solve_by_ipopt(const LoadProblem& problem) {
  Answer answer;
  const Programme programme(problem);
  const Ipopt::SmartPtr<Ipopt::TNLP> nlp = new IpoptProgramme(programme, answer);
  ipopt().OptimizeTNLP(nlp);
  return answer;
}

Answer solve_by_slsqp(const LoadProblem& problem) {
  Answer answer;
  const Programme programme(problem);
  const auto n = static_cast<std::size_t>(programme.size());
  // In loads over the mean load, times the number of points: from a start of ones, with a Hessian of the order of one, it needs half
  // as many steps as in shares.
  struct Scaled {
    const Programme& programme;
    Answer& answer;
    double points;
    Eigen::VectorXd shares(const std::vector<double>& y) const {
      return Eigen::Map<const Eigen::VectorXd>(y.data(), programme.size()).cwiseProduct(programme.even());
    }
  } scaled{programme, answer, static_cast<double>(n)};
  const auto objective = [](const std::vector<double>& y, std::vector<double>& gradient, void* data) {
    const auto& at = *static_cast<const Scaled*>(data);
    const Callback timed(at.answer);
    const Eigen::VectorXd x = at.shares(y);
    if (!gradient.empty()) {
      ++at.answer.evaluations;
      Eigen::Map<Eigen::VectorXd>(gradient.data(), x.size()) = at.points * at.programme.gradient(x).cwiseProduct(at.programme.even());
    }
    return at.points * at.programme.objective(x);
  };
  const auto balance = [](const std::vector<double>& y, std::vector<double>& gradient, void* data) {
    const auto& at = *static_cast<const Scaled*>(data);
    if (!gradient.empty()) Eigen::Map<Eigen::VectorXd>(gradient.data(), at.programme.size()) = at.programme.even();
    return at.shares(y).sum() - 1.0;
  };
  nlopt::opt solver(nlopt::LD_SLSQP, static_cast<unsigned>(n));
  solver.set_lower_bounds(0.0);
  solver.set_min_objective(objective, &scaled);
  solver.add_equality_constraint(balance, &scaled, 1e-10);  // tighter, and round-off hides its best point from it
  solver.set_xtol_rel(1e-13);
  solver.set_maxeval(5000);
  std::vector<double> y(n, 1.0);
  double value = 0.0;
  try {
    solver.optimize(y, value);
  } catch (const nlopt::roundoff_limited&) {  // as far as it comes: y is the best point
  }
  answer.line_load = programme.loads(scaled.shares(y).cwiseMax(0.0));
  return answer;
}

double natural_residual(const LoadProblem& problem, const Eigen::VectorXd& line_load) {
  const Eigen::VectorXd forces = problem.weight.cwiseProduct(line_load);
  Eigen::VectorXd deflection = problem.influence * forces;
  for (std::size_t i = 0; i < problem.laws.size(); ++i) {
    deflection[static_cast<Eigen::Index>(i)] += problem.laws[i].deflection(line_load[static_cast<Eigen::Index>(i)]);
  }
  const Eigen::VectorXd approach = deflection + problem.gap;
  const Eigen::VectorXd remaining = approach.array() - forces.dot(approach) / forces.sum();
  const double mean = problem.force / problem.weight.sum();
  const Eigen::ArrayXd natural = (line_load.array() / mean).min(remaining.array() / deflection.maxCoeff());
  return std::max(natural.abs().maxCoeff(), std::abs(forces.sum() - problem.force) / problem.force);
}

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

}  // namespace flankwright::reference_solvers
