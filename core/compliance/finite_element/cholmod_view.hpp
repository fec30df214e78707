#pragma once

#include <cholmod.h>

#include <cstddef>

namespace flankwright {

/// A symmetric matrix as CHOLMOD sees it, without a copy: the lower triangle, by columns, rows ascending.
/// @param starts  of the columns, n + 1
/// @param values  null: the pattern alone
inline cholmod_sparse lower_view(std::size_t n, std::size_t entries, const int* starts, const int* rows, const double* values) {
  cholmod_sparse a{};
  a.nrow = a.ncol = n;
  a.nzmax = entries;
  a.p = const_cast<int*>(starts);
  a.i = const_cast<int*>(rows);
  a.x = const_cast<double*>(values);
  a.stype = -1;
  a.itype = CHOLMOD_INT;
  a.xtype = values == nullptr ? CHOLMOD_PATTERN : CHOLMOD_REAL;
  a.dtype = CHOLMOD_DOUBLE;
  a.sorted = a.packed = 1;
  return a;
}

}  // namespace flankwright
