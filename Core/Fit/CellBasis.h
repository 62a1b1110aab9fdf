// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The blending functions on one Bezier cell, as products of few univariate cubics.
 */
#ifndef trivariate_CellBasis_h
#define trivariate_CellBasis_h

#include "TSpline/BezierMesh.h"

#include <algorithm>
#include <array>
#include <vector>

namespace trivariate
{
/// A univariate cubic on an interval in Bernstein form.
using BernsteinForm = std::array<double, 4>;

/// The box of a cell with its active functions, whose factors are numbered within the cell.
class CellBasis
{
public:
  /// `mesh` must belong to the spline and outlive this object.
  explicit CellBasis(const BezierMesh& mesh)
    : Mesh(&mesh)
  {
  }

  void SetCell(Index cell)
  {
    this->Cell = cell;
    const std::array<double, 6> bounds = this->Mesh->Bounds(cell);
    const IdRange active = this->Mesh->ActiveFunctions(cell);
    this->Numbers.resize(active.size());
    for (int a = 0; a < 3; ++a)
    {
      this->Low[a] = bounds[2 * a];
      this->High[a] = bounds[2 * a + 1];
      std::vector<std::int32_t>& factors = this->Factors[a];
      factors.clear();
      for (const std::int32_t i : active)
      {
        factors.push_back(this->Mesh->UnivariateOf(i, a));
      }
      std::sort(factors.begin(), factors.end());
      factors.erase(std::unique(factors.begin(), factors.end()), factors.end());
      for (Index n = 0; n < active.size(); ++n)
      {
        const std::int32_t id = this->Mesh->UnivariateOf(active.First[n], a);
        this->Numbers[n][a] =
          static_cast<int>(std::lower_bound(factors.begin(), factors.end(), id) - factors.begin());
      }
      this->Forms[a].clear();
      for (const std::int32_t id : factors)
      {
        this->Forms[a].push_back(
          BernsteinOfBSpline(this->ValuesOf(a, id), this->Low[a], this->High[a]));
      }
    }
  }

  /// The Bernstein polynomials of the cell at a point, in each direction.
  std::array<BernsteinForm, 3> BernsteinAt(const double* p) const
  {
    std::array<BernsteinForm, 3> b;
    for (int a = 0; a < 3; ++a)
    {
      b[a] = Bernstein((p[a] - this->Low[a]) / (this->High[a] - this->Low[a]));
    }
    return b;
  }

  IdRange Active() const { return this->Mesh->ActiveFunctions(this->Cell); }

  /// Knot values of the univariate function `id` of direction a, as the mesh numbers them.
  Knots5 ValuesOf(int a, std::int32_t id) const
  {
    return this->ValuesOf(a, this->Mesh->Univariate(a)[id]);
  }
  Knots5 ValuesOf(int a, const LocalKnots& k) const
  {
    const KnotLine& line = this->Mesh->KnotLines()[a];
    return { line[k[0]], line[k[1]], line[k[2]], line[k[3]], line[k[4]] };
  }

  const BezierMesh* Mesh;
  Index Cell = 0;
  std::array<double, 3> Low{}, High{};
  std::array<std::vector<std::int32_t>, 3> Factors; ///< the distinct univariate functions
  std::array<std::vector<BernsteinForm>, 3> Forms;  ///< and what they are on the cell
  std::vector<std::array<int, 3>> Numbers;          ///< of each active function: its three of them
};

/// Sums against Bernstein polynomials of a cell, u fastest, and what they are for its functions.
using Moments64 = std::array<double, 64>;

/// moments += factor * u x v x w, the first one fastest.
inline void AddProduct(double factor, const BernsteinForm& u, const BernsteinForm& v,
  const BernsteinForm& w, Moments64& moments)
{
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const double vw = factor * w[k] * v[j];
      for (int i = 0; i < 4; ++i)
      {
        moments[16 * k + 4 * j + i] += vw * u[i];
      }
    }
  }
}

/**
 * Calls visit(u, v, w) with the second derivatives of the Bernstein polynomials at 2 x 2 x 2 points
 * of the unit cube, as products of one factor for each direction: uu, vv, ww and, times the square
 * root of two, uv, vw, uw. The sum of the squares of a polynomial's is its thin-plate energy there.
 */
template <typename Visit>
void VisitSecondDerivatives(const Visit& visit)
{
  constexpr double Points[2] = { 0.21132486540518712, 0.78867513459481288 }; // of Gauss
  constexpr double Root = 1.4142135623730951;
  using Jet = std::array<BernsteinForm, 3>; // polynomials and their derivatives
  std::array<Jet, 2> jets;
  for (int g = 0; g < 2; ++g)
  {
    const double s = Points[g], r = 1.0 - s;
    jets[g] = { Bernstein(s),
      BernsteinForm{ -3.0 * r * r, 3.0 * r * (r - 2.0 * s), 3.0 * s * (2.0 * r - s), 3.0 * s * s },
      BernsteinForm{ 6.0 * r, 6.0 * (s - 2.0 * r), 6.0 * (r - 2.0 * s), 6.0 * s } };
  }
  for (int g = 0; g < 8; ++g)
  {
    const std::array<const Jet*, 3> at{ &jets[g & 1], &jets[g >> 1 & 1], &jets[g >> 2] };
    for (int a = 0; a < 3; ++a)
    {
      std::array<BernsteinForm, 3> pure{ (*at[0])[0], (*at[1])[0], (*at[2])[0] }, mixed = pure;
      pure[a] = (*at[a])[2];
      const int b = (a + 1) % 3;
      mixed[a] = (*at[a])[1];
      mixed[b] = (*at[b])[1];
      for (double& value : mixed[a])
      {
        value *= Root;
      }
      visit(pure);
      visit(mixed);
    }
  }
}

/// out[m] = sum_k form[k] in[m + Stride k] over the last of the directions left.
template <int Stride>
inline void ContractLast(const BernsteinForm& form, const double* in, double* out)
{
  for (int m = 0; m < Stride; ++m)
  {
    out[m] = form[0] * in[m] + form[1] * in[Stride + m] + form[2] * in[2 * Stride + m] +
             form[3] * in[3 * Stride + m];
  }
}
}

#endif
