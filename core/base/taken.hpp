#pragma once

namespace flankwright {

/// The contents of an object, which is left empty. Eigen's sparse matrices copy where they are moved, and keep their memory where
/// an empty one is assigned.
template <class Matrix>
Matrix taken(Matrix& from) {
  Matrix result;
  result.swap(from);
  return result;
}

}  // namespace flankwright
