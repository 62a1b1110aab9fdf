// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BezierExtraction.h"

#include "TargetClones.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
using Cubic = std::array<double, 4>; // Bernstein coefficients

// The Bernstein coefficients on the part [s, r] of the unit interval: de Casteljau's cut at r, then
// the cut of what is left of it at s / r. Convex combinations only: what is not negative stays so,
// and what vanishes at an end vanishes exactly.
Cubic Restrict(Cubic c, double s, double r)
{
  if (r < 1.0)
  {
    for (int degree = 1; degree < 4; ++degree)
    {
      for (int i = 3; i >= degree; --i)
      {
        c[i] = (1.0 - r) * c[i - 1] + r * c[i];
      }
    }
  }
  if (s > 0.0)
  {
    const double cut = s / r;
    for (int degree = 1; degree < 4; ++degree)
    {
      for (int i = 0; i + degree < 4; ++i)
      {
        c[i] = (1.0 - cut) * c[i] + cut * c[i + 1];
      }
    }
  }
  return c;
}

// The four polynomial pieces of every univariate function of one direction, each computed once.
class UnivariatePieces
{
public:
  UnivariatePieces(const BezierMesh& mesh, int a)
    : Line(mesh.KnotLines()[a])
    , Functions(mesh.Univariate(a))
  {
    for (const LocalKnots& k : this->Functions)
    {
      Knots5 t;
      std::transform(
        k.begin(), k.end(), t.begin(), [this](std::int32_t i) { return this->Line[i]; });
      for (int i = 0; i < 4; ++i)
      {
        this->Pieces.push_back(t[i] < t[i + 1] ? BernsteinOfBSpline(t, t[i], t[i + 1]) : Cubic{});
      }
    }
  }

  // The function's Bernstein coefficients between two knots that have no knot of it between them.
  Cubic Between(std::int32_t function, std::int32_t low, std::int32_t high) const
  {
    const LocalKnots& k = this->Functions[function];
    const int piece = (k[1] <= low) + (k[2] <= low) + (k[3] <= low);
    const Cubic& c = this->Pieces[4 * function + piece];
    if (k[piece] == low && k[piece + 1] == high)
    {
      return c;
    }
    const double origin = this->Line[k[piece]];
    const double length = this->Line[k[piece + 1]] - origin;
    return Restrict(c, (this->Line[low] - origin) / length, (this->Line[high] - origin) / length);
  }

  std::size_t Size() const { return this->Functions.size(); }

private:
  const KnotLine& Line;
  const std::vector<LocalKnots>& Functions;
  std::vector<Cubic> Pieces;
};

// The univariate functions of one direction on the interval of the cell at hand. Each is restricted
// when it is first asked for; neighbouring cells often have the interval in common.
class RestrictedFunctions
{
public:
  explicit RestrictedFunctions(const UnivariatePieces& pieces)
    : Pieces(pieces)
    , Coefficients(pieces.Size())
    , Stamps(pieces.Size(), 0)
  {
  }

  void SetInterval(std::int32_t low, std::int32_t high)
  {
    if (low != this->Low || high != this->High)
    {
      this->Low = low;
      this->High = high;
      ++this->Stamp;
    }
  }

  const double* operator[](std::int32_t function)
  {
    if (this->Stamps[function] != this->Stamp)
    {
      this->Stamps[function] = this->Stamp;
      this->Coefficients[function] = this->Pieces.Between(function, this->Low, this->High);
    }
    return this->Coefficients[function].data();
  }

private:
  const UnivariatePieces& Pieces;
  std::vector<Cubic> Coefficients;
  std::vector<Index> Stamps;
  Index Stamp = 0;
  std::int32_t Low = -1, High = -1;
};

// out[c] += b x in[c] for every component: the outer product of four coefficients with N numbers.
template <int N>
inline void AddOuterProducts(
  int components, const double* __restrict b, const double* __restrict in, double* __restrict out)
{
  for (int c = 0; c < components; ++c, in += N, out += 4 * N)
  {
    for (int j = 0; j < 4; ++j)
    {
      for (int i = 0; i < N; ++i)
      {
        out[j * N + i] += b[j] * in[i];
      }
    }
  }
}

// Sums over the active functions, sum_i h_i u_i(u) v_i(v) w_i(w) with homogeneous rows h_i. They
// come sorted by w, then v, so functions that share both are summed over u first, and so on.
class CellExtractor
{
public:
  CellExtractor(const BezierMesh& mesh, const std::array<UnivariatePieces, 3>& pieces,
    const std::vector<double>& rows, int components)
    : Mesh(mesh)
    , Rows(rows)
    , Components(components)
    , Functions{ RestrictedFunctions(pieces[0]), RestrictedFunctions(pieces[1]),
      RestrictedFunctions(pieces[2]) }
    , SumU(4 * components)
    , SumUV(16 * components)
  {
  }

  TRIVARIATE_CLONES void Extract(Index cell, double* out)
  {
    const IndexBox& box = this->Mesh.Box(cell);
    for (int a = 0; a < 3; ++a)
    {
      this->Functions[a].SetInterval(box.Low[a], box.High[a]);
    }
    std::fill_n(out, 64 * this->Components, 0.0);
    const IdRange active = this->Mesh.ActiveFunctions(cell);
    for (const std::int32_t* i = active.begin(); i != active.end();)
    {
      const std::int32_t w = this->Mesh.UnivariateOf(*i, 2);
      std::fill(this->SumUV.begin(), this->SumUV.end(), 0.0);
      while (i != active.end() && this->Mesh.UnivariateOf(*i, 2) == w)
      {
        const std::int32_t v = this->Mesh.UnivariateOf(*i, 1);
        std::fill(this->SumU.begin(), this->SumU.end(), 0.0);
        for (; i != active.end() && this->Mesh.UnivariateOf(*i, 1) == v &&
               this->Mesh.UnivariateOf(*i, 2) == w;
             ++i)
        {
          AddOuterProducts<1>(this->Components, this->Functions[0][this->Mesh.UnivariateOf(*i, 0)],
            &this->Rows[*i * this->Components], this->SumU.data());
        }
        AddOuterProducts<4>(
          this->Components, this->Functions[1][v], this->SumU.data(), this->SumUV.data());
      }
      AddOuterProducts<16>(this->Components, this->Functions[2][w], this->SumUV.data(), out);
    }
  }

private:
  const BezierMesh& Mesh;
  const std::vector<double>& Rows;
  int Components;
  std::array<RestrictedFunctions, 3> Functions;
  std::vector<double> SumU, SumUV; // sums over functions that differ in u, in u and v only
};

// w_i p_i[c] or w_i, a row a function.
std::vector<double> HomogeneousRows(const TSpline& spline, const std::vector<int>& components)
{
  std::vector<double> rows;
  rows.reserve(spline.Functions.size() * components.size());
  for (Index i = 0; i < spline.Size(); ++i)
  {
    for (const int c : components)
    {
      rows.push_back(spline.Weights[i] * (c == Denominator ? 1.0 : spline.ControlPoint(i)[c]));
    }
  }
  return rows;
}
}

//------------------------------------------------------------------------------
std::vector<double> ExtractBezier(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<int>& components, const Execution& execution)
{
  for (const int c : components)
  {
    if (c != Denominator && (c < 0 || c >= spline.Components))
    {
      throw std::invalid_argument("The T-spline has no component " + std::to_string(c) +
                                  "; its control points have " + std::to_string(spline.Components) +
                                  ".");
    }
  }
  const std::vector<double> rows = HomogeneousRows(spline, components);
  const std::array<UnivariatePieces, 3> pieces = { UnivariatePieces(mesh, 0),
    UnivariatePieces(mesh, 1), UnivariatePieces(mesh, 2) };
  const Index stride = 64 * static_cast<Index>(components.size());
  std::vector<double> bezier(mesh.Size() * stride);
  constexpr Index Batch = 1 << 16; // between two looks at the abort flag
  for (Index first = 0; first < mesh.Size(); first += Batch)
  {
    execution.Check(static_cast<double>(first) / mesh.Size());
    execution.ParallelFor(std::min(Batch, mesh.Size() - first),
      [&](Index begin, Index end)
      {
        CellExtractor extractor(mesh, pieces, rows, static_cast<int>(components.size()));
        for (Index cell = first + begin; cell < first + end; ++cell)
        {
          extractor.Extract(cell, &bezier[cell * stride]);
        }
      });
  }
  return bezier;
}
}
