// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PartLattice.h"

#include "TargetClones.h"

namespace trivariate
{
namespace
{
constexpr int Lanes = 8; // PartLine and what makes it a vector

// out[k][i] = sum over m of values[k][m] in[m][i], of the slowest direction.
template <int N>
TRIVARIATE_INLINE void ExpandSlowest(const double* values, const double* in, double* out)
{
  for (int k = 0; k < PartLine; ++k)
  {
    for (int i = 0; i < N; ++i)
    {
      out[N * k + i] = values[4 * k] * in[i] + values[4 * k + 1] * in[N + i] +
                       values[4 * k + 2] * in[2 * N + i] + values[4 * k + 3] * in[3 * N + i];
    }
  }
}

// out[m][i] += sum over k of values[k][m] in[k][i].
template <int N>
TRIVARIATE_INLINE void ReduceSlowest(const double* values, const double* in, double* out)
{
  for (int m = 0; m < 4; ++m)
  {
    for (int k = 0; k < PartLine; ++k)
    {
      for (int i = 0; i < N; ++i)
      {
        out[N * m + i] += values[4 * k + m] * in[N * k + i];
      }
    }
  }
}

// out[n][i] = scale sum over m of values[i][m] in[n][m], of the fastest direction. What is written
// beyond a line is zero, or the next line's place.
TRIVARIATE_INLINE void ExpandFastest(
  const double* values, double scale, const double* in, double* out)
{
  double transposed[4][Lanes] = {};
  for (int i = 0; i < PartLine; ++i)
  {
    for (int m = 0; m < 4; ++m)
    {
      transposed[m][i] = scale * values[4 * i + m];
    }
  }
  for (int n = 0; n < PartLine * PartLine; ++n)
  {
    double line[Lanes];
    for (int i = 0; i < Lanes; ++i)
    {
      line[i] = transposed[0][i] * in[4 * n] + transposed[1][i] * in[4 * n + 1] +
                transposed[2][i] * in[4 * n + 2] + transposed[3][i] * in[4 * n + 3];
    }
    for (int i = 0; i < Lanes; ++i)
    {
      out[PartLine * n + i] = line[i];
    }
  }
}

// out[n][m] = scale sum over i of values[i][m] in[n][i].
TRIVARIATE_INLINE void ReduceFastest(
  const double* values, double scale, const double* in, double* out)
{
  for (int n = 0; n < PartLine * PartLine; ++n)
  {
    double sums[4] = {};
    for (int i = 0; i < PartLine; ++i)
    {
      for (int m = 0; m < 4; ++m)
      {
        sums[m] += values[4 * i + m] * in[PartLine * n + i];
      }
    }
    for (int m = 0; m < 4; ++m)
    {
      out[4 * n + m] = scale * sums[m];
    }
  }
}
}

//------------------------------------------------------------------------------
TRIVARIATE_CLONES void Expand(
  const Lines& lines, const double* scales, const double* coefficients, PartMatrices& out)
{
  const Line &u = *lines[0], &v = *lines[1], &w = *lines[2];
  for (int c = 0; c < 3; ++c)
  {
    double planes[2][PartLine * 16]; // the values along w, and the slopes
    ExpandSlowest<16>(w.Polynomials.data(), coefficients + 64 * c, planes[0]);
    ExpandSlowest<16>(w.Slopes.data(), coefficients + 64 * c, planes[1]);
    double pencils[3][PartLine * PartLine * 4]; // values; slopes along v; along w
    for (int k = 0; k < PartLine; ++k)
    {
      constexpr int Size = PartLine * 4;
      ExpandSlowest<4>(v.Polynomials.data(), planes[0] + 16 * k, pencils[0] + Size * k);
      ExpandSlowest<4>(v.Slopes.data(), planes[0] + 16 * k, pencils[1] + Size * k);
      ExpandSlowest<4>(v.Polynomials.data(), planes[1] + 16 * k, pencils[2] + Size * k);
    }
    ExpandFastest(u.Slopes.data(), scales[0], pencils[0], out.Rows[c]);
    ExpandFastest(u.Polynomials.data(), scales[1], pencils[1], out.Rows[3 + c]);
    ExpandFastest(u.Polynomials.data(), scales[2], pencils[2], out.Rows[6 + c]);
  }
}

//------------------------------------------------------------------------------
TRIVARIATE_CLONES void Reduce(
  const Lines& lines, const double* scales, const PartMatrices& in, double* coefficients)
{
  const Line &u = *lines[0], &v = *lines[1], &w = *lines[2];
  for (int c = 0; c < 3; ++c)
  {
    double pencils[3][PartLine * PartLine * 4];
    ReduceFastest(u.Slopes.data(), scales[0], in.Rows[c], pencils[0]);
    ReduceFastest(u.Polynomials.data(), scales[1], in.Rows[3 + c], pencils[1]);
    ReduceFastest(u.Polynomials.data(), scales[2], in.Rows[6 + c], pencils[2]);
    double planes[2][PartLine * 16] = {};
    for (int k = 0; k < PartLine; ++k)
    {
      constexpr int Size = PartLine * 4;
      ReduceSlowest<4>(v.Polynomials.data(), pencils[0] + Size * k, planes[0] + 16 * k);
      ReduceSlowest<4>(v.Slopes.data(), pencils[1] + Size * k, planes[0] + 16 * k);
      ReduceSlowest<4>(v.Polynomials.data(), pencils[2] + Size * k, planes[1] + 16 * k);
    }
    ReduceSlowest<16>(w.Polynomials.data(), planes[0], coefficients + 64 * c);
    ReduceSlowest<16>(w.Slopes.data(), planes[1], coefficients + 64 * c);
  }
}

//------------------------------------------------------------------------------
TRIVARIATE_CLONES void FindDeterminants(const PartMatrices& matrices, double* determinants)
{
  const auto& j = matrices.Rows;
  for (int p = 0; p < PaddedPoints; ++p)
  {
    determinants[p] = j[0][p] * (j[4][p] * j[8][p] - j[5][p] * j[7][p]) +
                      j[1][p] * (j[5][p] * j[6][p] - j[3][p] * j[8][p]) +
                      j[2][p] * (j[3][p] * j[7][p] - j[4][p] * j[6][p]);
  }
}

//------------------------------------------------------------------------------
TRIVARIATE_CLONES void MultiplyCurvature(
  const PartCurvature& curvature, double factor, PartMatrices& changes)
{
  const auto& j = curvature.Jacobian.Rows;
  auto& d = changes.Rows;
  for (int p = 0; p < PaddedPoints; ++p)
  {
    double cofactors[9];
    for (int a = 0; a < 3; ++a)
    {
      const int b = 3 * ((a + 1) % 3), c = 3 * ((a + 2) % 3);
      for (int k = 0; k < 3; ++k)
      {
        const int l = (k + 1) % 3, m = (k + 2) % 3;
        cofactors[3 * a + k] = j[b + l][p] * j[c + m][p] - j[b + m][p] * j[c + l][p];
      }
    }
    double trace = 0.0, determinant = 0.0;
    for (int m = 0; m < 9; ++m)
    {
      trace += 2.0 * j[m][p] * d[m][p];
      determinant += cofactors[m] * d[m][p];
    }
    const double ofChange = 2.0 * factor * curvature.ByTrace[p];
    const double ofJacobian = 2.0 * factor * curvature.ByBoth[p] * determinant;
    const double ofCofactors =
      factor * (curvature.ByBoth[p] * trace + curvature.ByDeterminantTwice[p] * determinant);
    for (int m = 0; m < 9; ++m)
    {
      d[m][p] = ofChange * d[m][p] + ofJacobian * j[m][p] + ofCofactors * cofactors[m];
    }
  }
}
}
