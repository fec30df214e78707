#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "tests/problems/awkward.hpp"
#include "tests/problems/classic.hpp"
#include "tests/problems/minimax.hpp"

namespace flankwright::problems {

using MakeProblem = std::function<std::unique_ptr<KnownProblem>()>;

/// Every problem that has a solution, awkward ones included.
inline std::vector<MakeProblem> solvable() {
  return {[] { return std::make_unique<Rosenbrock>(); },
          [] { return std::make_unique<BoundedSphere>(); },
          [] { return std::make_unique<ThrowingBowl>(); },
          [] { return std::make_unique<NanOutsideDisc>(false); },
          [] { return std::make_unique<NanOutsideDisc>(true); },
          [] { return std::make_unique<HockSchittkowski71>(); },
          [] { return std::make_unique<HockSchittkowski100>(); },
          [] { return std::make_unique<CharalambousBandler2>(); },
          [] { return std::make_unique<ChebyshevApproximation>(4, 20); },
          [] { return std::make_unique<RedundantPolygon>(); }};
}

}  // namespace flankwright::problems
