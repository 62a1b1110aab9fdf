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
TRIVARIATE_INLINE Cubic Restrict(const Cubic& c, double r, double sOverR)
{
  const auto cutAtR = [r](double x, double y) { return (1.0 - r) * x + r * y; };
  const double d1 = cutAtR(c[0], c[1]), d2 = cutAtR(c[1], c[2]), d3 = cutAtR(c[2], c[3]);
  const double e2 = cutAtR(d1, d2), e3 = cutAtR(d2, d3);
  const double f3 = cutAtR(e2, e3); // left of the cut: c0, d1, e2, f3
  const auto cutAtS = [sOverR](double x, double y) { return (1.0 - sOverR) * x + sOverR * y; };
  const double g0 = cutAtS(c[0], d1), g1 = cutAtS(d1, e2), g2 = cutAtS(e2, f3);
  const double h0 = cutAtS(g0, g1), h1 = cutAtS(g1, g2);
  return { cutAtS(h0, h1), h1, g2, f3 };
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
    const double begin = this->Line[k[piece]];
    const double end = this->Line[k[piece + 1]];
    const double a = this->Line[low] - begin;
    const double b = this->Line[high] - begin;
    return Restrict(this->Pieces[4 * function + piece], b / (end - begin), a / b);
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

// One active function's share: its univariate coefficients on the cell and its homogeneous row.
struct Term
{
  const double *U, *V, *W, *Row;
};

// Adds sum_i h_i u_i(u) v_i(v) w_i(w) for C of the components of the rows h_i, from `first` on.
// Functions with the same w follow each other and are summed over u and v first.
template <int C>
TRIVARIATE_INLINE void AddTerms(const std::vector<Term>& terms, int first, double* __restrict out)
{
  for (auto term = terms.begin(); term != terms.end();)
  {
    const double* w = term->W;
    double sum[C][16] = {};
    for (; term != terms.end() && term->W == w; ++term)
    {
      for (int c = 0; c < C; ++c)
      {
        for (int j = 0; j < 4; ++j)
        {
          const double hv = term->Row[first + c] * term->V[j];
          for (int i = 0; i < 4; ++i)
          {
            sum[c][4 * j + i] += hv * term->U[i];
          }
        }
      }
    }
    for (int c = 0; c < C; ++c)
    {
      for (int k = 0; k < 4; ++k)
      {
        for (int m = 0; m < 16; ++m)
        {
          out[64 * c + 16 * k + m] += w[k] * sum[c][m];
        }
      }
    }
  }
}

TRIVARIATE_INLINE void SumTerms(const std::vector<Term>& terms, int components, double* out)
{
  int c = 0;
  for (; c + 4 <= components; c += 4)
  {
    AddTerms<4>(terms, c, out + 64 * c);
  }
  for (; c < components; ++c)
  {
    AddTerms<1>(terms, c, out + 64 * c);
  }
}

// Extracts cell after cell, into zeros.
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
  {
  }

  TRIVARIATE_CLONES void Extract(Index cell, double* out)
  {
    const IndexBox& box = this->Mesh.Box(cell);
    for (int a = 0; a < 3; ++a)
    {
      this->Functions[a].SetInterval(box.Low[a], box.High[a]);
    }
    const IdRange active = this->Mesh.ActiveFunctions(cell);
    this->Terms.resize(active.size());
    auto term = this->Terms.begin();
    for (const std::int32_t i : active)
    {
      *term++ = { this->Functions[0][this->Mesh.UnivariateOf(i, 0)],
        this->Functions[1][this->Mesh.UnivariateOf(i, 1)],
        this->Functions[2][this->Mesh.UnivariateOf(i, 2)], &this->Rows[i * this->Components] };
    }
    SumTerms(this->Terms, this->Components, out);
  }

private:
  const BezierMesh& Mesh;
  const std::vector<double>& Rows;
  int Components;
  std::array<RestrictedFunctions, 3> Functions;
  std::vector<Term> Terms;
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
  return ExtractBezier(spline, mesh, components, 0, mesh.Size(), execution);
}

//------------------------------------------------------------------------------
std::vector<double> ExtractBezier(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<int>& components, Index firstCell, Index lastCell, const Execution& execution)
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
  std::vector<double> bezier((lastCell - firstCell) * stride);
  constexpr Index Batch = 1 << 16; // between two looks at the abort flag
  for (Index first = firstCell; first < lastCell; first += Batch)
  {
    execution.Check(static_cast<double>(first - firstCell) / (lastCell - firstCell));
    execution.ParallelFor(std::min(Batch, lastCell - first),
      [&](Index begin, Index end)
      {
        CellExtractor extractor(mesh, pieces, rows, static_cast<int>(components.size()));
        for (Index cell = first + begin; cell < first + end; ++cell)
        {
          extractor.Extract(cell, &bezier[(cell - firstCell) * stride]);
        }
      });
  }
  return bezier;
}
}
