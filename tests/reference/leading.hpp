#pragma once

#include <algorithm>
#include <vector>

#include "core/contact/unloaded/transmission_error.hpp"

namespace flankwright::reference {

/// The contact of the pair that leads, at every position of a mesh.
inline std::vector<ToothContact> leading_contacts(const UnloadedMesh& mesh) {
  std::vector<ToothContact> leading;
  for (const double phi1 : mesh.phi1) {
    ToothContact best;
    for (const PairCurve& pair : mesh.pairs) {
      for (const ToothContact& c : pair.positions) {
        if (c.phi1 == phi1 && (!best.exists() || c.transmission_error > best.transmission_error)) best = c;
      }
    }
    leading.push_back(best);
  }
  return leading;
}

/// Kinds of contact of one tooth pair in the order in which it passes through them, each named once a run.
inline std::vector<ContactKind> sequence_of_kinds(const std::vector<ToothContact>& contacts) {
  std::vector<ContactKind> sequence;
  for (const ToothContact& c : contacts) {
    if (c.exists() && (sequence.empty() || sequence.back() != c.kind)) sequence.push_back(c.kind);
  }
  return sequence;
}

}  // namespace flankwright::reference
