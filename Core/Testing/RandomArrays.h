// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Random dense arrays, and the entries of arrays and banded operators by their indices.
#ifndef trivariate_RandomArrays_h
#define trivariate_RandomArrays_h

#include "Fit/BandedOperator.h"

#include <random>

namespace trivariate
{
inline double Entry(const BandedOperator& op, Index r, Index c)
{
  const Index at = c - op.First[r];
  return at < 0 || at >= op.Width ? 0.0 : op.Coefficients[r * op.Width + at];
}

inline Array3 RandomArray(const std::array<Index, 3>& size, std::mt19937& random)
{
  Array3 array(size, std::make_shared<ArrayPool>());
  for (double& value : array.Values)
  {
    value = std::uniform_real_distribution<double>(-1.0, 1.0)(random);
  }
  return array;
}

inline double At(const Array3& array, Index x, Index y, Index z)
{
  return array.Values[(z * array.Size[1] + y) * array.Size[0] + x];
}
}

#endif
