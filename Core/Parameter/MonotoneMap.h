// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A monotone function of one variable through given points.
#ifndef trivariate_MonotoneMap_h
#define trivariate_MonotoneMap_h

#include <vector>

namespace trivariate
{
/**
 * Cubic between the points and continuously differentiable, straight beyond them; with two points
 * straight all over. Slopes are the harmonic means of F. N. Fritsch and J. Butland (1984), at the
 * ends those of the outermost pieces, so that it is monotone wherever the points are.
 */
class MonotoneMap
{
public:
  /// At least two places, strictly ascending, and ascending values.
  MonotoneMap(std::vector<double> places, std::vector<double> values);

  double operator()(double place) const;

private:
  std::vector<double> Places, Values, Slopes;
};
}

#endif
