#pragma once

#include <memory>

#include "core/base/jet.hpp"

namespace flankwright {

/// How a real flank differs from the involute helicoid: distance D of the two along the transverse base tangent [mm], positive
/// into the tooth (removed), as a function of the two coordinates of the involute: roll length rho [mm] and axial position z [mm].
///
/// Every flank is the involute plus such a field: rack- and revolution-generated flanks (core/flank) and measured or
/// topological grids. Implementations are immutable and may be evaluated by several threads at once.
class DeviationField {
 public:
  virtual ~DeviationField() = default;

  /// What changes along the face alone: the trace at the middle of the profile, from its value at mid face on. Always the same one; null: the field
  /// counts as a deviation of the whole flank.
  virtual std::shared_ptr<const DeviationField> along_face() const { return nullptr; }
  /// What changes along the profile alone, and from tooth to tooth: the trace at mid face.
  virtual std::shared_ptr<const DeviationField> along_profile() const { return nullptr; }

  /// D and its first and second derivatives, u = rho, v = z. Exact (closed form or differentiation of the defining equations), for
  /// rho > 0 over the tooth and a little beyond its ends.
  virtual Jet at(double rho, double z) const = 0;
};

/// The field for a Scalar that carries derivatives of its own: double, Dual<N> or Jet.
template <class Scalar>
Scalar evaluate(const DeviationField& field, const Scalar& rho, const Scalar& z) {
  return chain(field.at(value_of(rho), value_of(z)), rho, z);
}

}  // namespace flankwright
