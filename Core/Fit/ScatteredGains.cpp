// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// What each split of each function would bring: the squared error that the part of a child that is
// orthogonal to its parent explains. Where functions share control points, splits along a common
// face are one, and the parent is the sum of all functions of the point. Residuals are summed
// against the children exactly; norms are those of the functions over the samples times the ratio
// of the univariate ones.
#include "ScatteredSystem.h"

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
// The squared norm of a function with four knot spans to one voxel distance each is 1/8 over a grid
// of voxels. Smaller children than that follow single voxels.
constexpr double LeastNorm = 0.25;

// The middles of a function's spans; -1: the span has none.
std::array<std::int32_t, 4> MiddlesOf(const LocalKnots& k)
{
  std::array<std::int32_t, 4> middles;
  for (int s = 0; s < 4; ++s)
  {
    middles[s] = DyadicMiddle(k[s], k[s + 1]);
  }
  return middles;
}

// The child of a split in the middle of a span that is farther from the function's other end: the
// one without a trace if the function has one in that direction, and the same from both sides of a
// face on which the direction runs backwards.
LocalKnots ChildOf(const LocalKnots& k, int span, std::int32_t knot)
{
  std::array<std::int32_t, 6> all{ k[0], k[1], k[2], k[3], k[4], knot };
  std::sort(all.begin(), all.end());
  const int first = span < 2 ? 0 : 1;
  return { all[first], all[first + 1], all[first + 2], all[first + 3], all[first + 4] };
}

// The integral of the product of two cubics on an interval of the given width.
double Integral(const BernsteinForm& f, const BernsteinForm& g, double width)
{
  // Gram matrix of the Bernstein polynomials: C(3,i) C(3,j) / (7 C(6, i + j)).
  constexpr double Binomial3[4] = { 1, 3, 3, 1 }, Binomial6[7] = { 1, 6, 15, 20, 15, 6, 1 };
  double sum = 0.0;
  for (int i = 0; i < 4; ++i)
  {
    for (int j = 0; j < 4; ++j)
    {
      sum += f[i] * g[j] * Binomial3[i] * Binomial3[j] / (7.0 * Binomial6[i + j]);
    }
  }
  return sum * width;
}

// The split of a univariate function p: the inner products of its child with p and with itself, in
// parts of the squared norm of p.
struct UnivariateSplit
{
  std::int32_t Knot = -1;
  double WithParent = 0.0, WithItself = 0.0;
};

std::array<UnivariateSplit, 4> SplitsOf(const KnotLine& line, const LocalKnots& k)
{
  const auto values = [&line](const LocalKnots& knots)
  {
    return Knots5{ line[knots[0]], line[knots[1]], line[knots[2]], line[knots[3]], line[knots[4]] };
  };
  std::array<UnivariateSplit, 4> splits;
  const auto middles = MiddlesOf(k);
  for (int s = 0; s < 4; ++s)
  {
    if (middles[s] < 0)
    {
      continue;
    }
    const LocalKnots child = ChildOf(k, s, middles[s]);
    double pp = 0.0, cp = 0.0, cc = 0.0;
    std::array<std::int32_t, 6> breaks{ k[0], k[1], k[2], k[3], k[4], middles[s] };
    std::sort(breaks.begin(), breaks.end());
    for (int b = 0; b < 5; ++b)
    {
      const double low = line[breaks[b]], high = line[breaks[b + 1]];
      if (low < high)
      {
        const BernsteinForm p = BernsteinOfBSpline(values(k), low, high);
        const BernsteinForm c = BernsteinOfBSpline(values(child), low, high);
        pp += Integral(p, p, high - low);
        cp += Integral(c, p, high - low);
        cc += Integral(c, c, high - low);
      }
    }
    splits[s] = { middles[s], cp / pp, cc / pp };
  }
  return splits;
}

// The forms of a function and of its four children on the two halves of a cell.
struct HalfForms
{
  std::array<BernsteinForm, 2> Parent{};
  std::array<std::array<BernsteinForm, 2>, 4> Child{};
  std::array<bool, 4> Exists{};
};

// Sums of a function: residual times itself, then times its 4 children in each of 3 directions.
constexpr Index SumsOfFunction = 13;

double Dot(const BernsteinForm& f, const BernsteinForm& g)
{
  return f[0] * g[0] + f[1] * g[1] + f[2] * g[2] + f[3] * g[3];
}
}

//------------------------------------------------------------------------------
// Adds the sums of the functions of one cell.
void ScatteredSystem::SumLines(CellBasis& basis, int component, std::vector<double>& sums) const
{
  const BezierMesh& mesh = *this->Cells;
  const IndexBox& box = mesh.Box(basis.Cell);
  const IdRange active = basis.Active();
  for (int a = 0; a < 3; ++a)
  {
    const int b = a == 0 ? 1 : 0, c = a == 2 ? 1 : 2;
    // Children have no knot inside of a cell but at its dyadic middle.
    const std::int32_t knot = DyadicMiddle(box.Low[a], box.High[a]);
    const double middle = knot < 0 ? basis.High[a] : mesh.KnotLines()[a][knot];
    const std::array<double, 3> ends{ basis.Low[a], middle, basis.High[a] };
    const int halves = knot < 0 ? 1 : 2;

    std::array<Moments64, 2> moments{}; // a fastest, then b, then c
    for (Index at = this->SampleBegin[basis.Cell]; at < this->SampleBegin[basis.Cell + 1]; ++at)
    {
      const Index sample = this->Sorted[at];
      const double* p = &this->Samples.Parameters[3 * sample];
      const auto bernstein = basis.BernsteinAt(p);
      const int half = p[a] < middle ? 0 : halves - 1;
      AddProduct(this->Residuals[component][at] * this->WeightOf(sample),
        Bernstein((p[a] - ends[half]) / (ends[half + 1] - ends[half])), bernstein[b], bernstein[c],
        moments[half]);
    }

    // With the other two factors summed out, a line of four numbers on each half.
    const std::size_t nb = basis.Forms[b].size(), nc = basis.Forms[c].size();
    std::vector<std::array<BernsteinForm, 2>> lines(nb * nc);
    for (int half = 0; half < halves; ++half)
    {
      for (std::size_t n = 0; n < nc; ++n)
      {
        double plane[16];
        ContractLast<16>(basis.Forms[c][n], moments[half].data(), plane);
        for (std::size_t m = 0; m < nb; ++m)
        {
          ContractLast<4>(basis.Forms[b][m], plane, lines[n * nb + m][half].data());
        }
      }
    }

    std::vector<HalfForms> forms(basis.Factors[a].size());
    for (std::size_t f = 0; f < forms.size(); ++f)
    {
      const LocalKnots& k = mesh.Univariate(a)[basis.Factors[a][f]];
      const auto middles = MiddlesOf(k);
      for (int half = 0; half < halves; ++half)
      {
        const auto formOf = [&](const LocalKnots& knots)
        { return BernsteinOfBSpline(basis.ValuesOf(a, knots), ends[half], ends[half + 1]); };
        forms[f].Parent[half] = formOf(k);
        for (int s = 0; s < 4; ++s)
        {
          forms[f].Exists[s] = middles[s] >= 0;
          if (middles[s] >= 0)
          {
            forms[f].Child[s][half] = formOf(ChildOf(k, s, middles[s]));
          }
        }
      }
    }
    for (Index n = 0; n < active.size(); ++n)
    {
      const std::array<int, 3>& number = basis.Numbers[n];
      const auto& line = lines[number[c] * nb + number[b]];
      const HalfForms& form = forms[number[a]];
      double* sum = &sums[SumsOfFunction * active.First[n]];
      for (int half = 0; half < halves; ++half)
      {
        sum[0] += a == 0 ? Dot(form.Parent[half], line[half]) : 0.0;
        for (int s = 0; s < 4; ++s)
        {
          sum[1 + 4 * a + s] += form.Exists[s] ? Dot(form.Child[s][half], line[half]) : 0.0;
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
void ScatteredSystem::AddGains(int component, double factor, std::vector<SplitGain>& gains) const
{
  const BezierMesh& mesh = *this->Cells;
  const Index functions = static_cast<Index>(this->Shared.PointOf.size());
  const std::vector<double> sums = SumOfParts(mesh.Size(), SumsOfFunction * functions, this->Run,
    [&](Index first, Index last, std::vector<double>& part)
    {
      CellBasis basis(mesh);
      for (Index k = first; k < last; ++k)
      {
        const Index cell = this->Order[k];
        if (this->SampleBegin[cell] < this->SampleBegin[cell + 1])
        {
          basis.SetCell(cell);
          this->SumLines(basis, component, part);
        }
      }
    });
  std::array<std::vector<std::array<UnivariateSplit, 4>>, 3> splits;
  for (int a = 0; a < 3; ++a)
  {
    for (const LocalKnots& k : mesh.Univariate(a))
    {
      splits[a].push_back(SplitsOf(mesh.KnotLines()[a], k));
    }
  }
  // Of each control point: its function's squared norm, and the sum of residual times it.
  std::vector<double> norm2(this->Shared.Count(), 0.0), residual(this->Shared.Count(), 0.0);
  for (Index i = 0; i < functions; ++i)
  {
    norm2[this->Shared.PointOf[i]] += this->SquaredNorms[i];
    residual[this->Shared.PointOf[i]] += sums[SumsOfFunction * i];
  }
  // Of each set of splits with one unknown: sums over its functions, kept with the first.
  struct Together
  {
    double Norm2 = 0.0, Residual = 0.0;
  };
  const auto splitOf = [&](Index i, int a, int s) -> const UnivariateSplit&
  { return splits[a][mesh.UnivariateOf(i, a)][s]; };
  std::vector<Together> together(this->SplitsUnknown.size());
  for (Index n = 0; n < static_cast<Index>(together.size()); ++n)
  {
    Together& sum = together[this->SplitsUnknown[n]];
    sum.Norm2 += this->SquaredNorms[n / 12];
    sum.Residual += sums[SumsOfFunction * (n / 12) + 1 + n % 12];
  }
  // What each set brings is that of the splits that it is made with, whose first comes before it.
  const bool isFirst = gains.empty();
  std::size_t next = 0;
  std::vector<std::size_t> gainOf(together.size());
  for (Index n = 0; n < static_cast<Index>(together.size()); ++n)
  {
    const Index i = n / 12;
    const int a = static_cast<int>(n % 12 / 4);
    const UnivariateSplit& split = splitOf(i, a, static_cast<int>(n % 4));
    if (split.Knot < 0 || this->SplitsUnknown[n] != n)
    {
      continue;
    }
    if (this->SplitsMade[n] == n)
    {
      gainOf[n] = next++;
      if (isFirst)
      {
        gains.push_back({ i, a, split.Knot, 0.0 });
      }
    }
    const Index point = this->Shared.PointOf[i];
    const double inner = split.WithParent * together[n].Norm2;
    const double share = inner / norm2[point];
    const double rest = split.WithItself * together[n].Norm2 - share * inner;
    const double explained = together[n].Residual - share * residual[point];
    gains[gainOf[this->SplitsMade[n]]].SquaredError +=
      this->SquaredNorms[i] > LeastNorm ? factor * explained * explained / rest : 0.0;
  }
}
}
