// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The coefficient of a function of the refined mesh is its dual functional of the coarse spline.
// The functional is a tensor product of univariate ones, and of each coarse function all but a few
// give zero: in a direction in which the knots of both overlap and differ, the functional vanishes.
#include "AnalysisSuitableRule.h"

#include "BlendingFunctionMap.h"
#include "DualCompatibility.h"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

namespace trivariate
{
namespace
{
// A unit cell in the support of f next to its centre, where no function has a knot inside.
GridIndex CentralUnit(const BlendingFunction& f)
{
  GridIndex unit;
  for (int a = 0; a < 3; ++a)
  {
    unit[a] = f[a][2] < f[a][4] ? f[a][2] : f[a][2] - 1;
  }
  return unit;
}

bool SupportHolds(const BlendingFunction& f, const GridIndex& unit)
{
  return f[0][0] <= unit[0] && unit[0] < f[0][4] && f[1][0] <= unit[1] && unit[1] < f[1][4] &&
         f[2][0] <= unit[2] && unit[2] < f[2][4];
}

// The univariate dual functionals of one direction. Many functions share a local knot vector, so
// each pair of vectors is computed once.
class Duals
{
public:
  explicit Duals(const KnotLine& line)
    : Line(line)
  {
  }

  int IdOf(const LocalKnots& knots)
  {
    return this->Ids.emplace(knots, static_cast<int>(this->Ids.size())).first->second;
  }

  // The functional of N[fine] of the piece of N[coarse] around a unit interval next to fine's
  // centre.
  double operator()(
    const LocalKnots& fine, int fineId, const LocalKnots& coarse, int coarseId, std::int32_t unit)
  {
    if (fineId == coarseId)
    {
      return 1.0;
    }
    const auto [entry, isNew] = this->Known.emplace((std::uint64_t(fineId) << 32) | coarseId, 0.0);
    if (isNew)
    {
      entry->second = DualOf(fine, coarse, unit, this->Line);
    }
    return entry->second;
  }

private:
  const KnotLine& Line;
  std::unordered_map<LocalKnots, int, LocalKnotsHash> Ids;
  std::unordered_map<std::uint64_t, double> Known;
};

// The same for functions, which carry the ids of their knots.
struct Numbered
{
  BlendingFunction Knots;
  GridIndex Unit, Ids;
};

Numbered Number(const BlendingFunction& f, std::array<Duals, 3>& duals)
{
  return { f, CentralUnit(f), { duals[0].IdOf(f[0]), duals[1].IdOf(f[1]), duals[2].IdOf(f[2]) } };
}

double Dual(const Numbered& fine, const Numbered& coarse, std::array<Duals, 3>& duals)
{
  for (int a = 0; a < 3; ++a)
  {
    if (fine.Ids[a] != coarse.Ids[a] && Overlap(fine.Knots[a], coarse.Knots[a]))
    {
      return 0.0;
    }
  }
  double product = 1.0;
  for (int a = 0; a < 3 && product != 0.0; ++a)
  {
    product *= duals[a](fine.Knots[a], fine.Ids[a], coarse.Knots[a], coarse.Ids[a], fine.Unit[a]);
  }
  return product;
}

}

//------------------------------------------------------------------------------
AnalysisSuitableRule::AnalysisSuitableRule(
  const GridIndex& rootCells, const std::array<int, 3>& depth, Closure closure)
  : Mesh(rootCells, depth, closure)
  , Anchors(Mesh.SortedAnchors())
  , CoarseNodes(Mesh.CountNodes())
{
}

//------------------------------------------------------------------------------
void AnalysisSuitableRule::Bisect(const TSpline& spline, const std::vector<RefinementMark>& marks)
{
  this->Check(spline, marks);
  for (const RefinementMark& mark : marks)
  {
    this->BisectAround(spline.Functions[mark.Function], mark.Direction, mark.Knot);
  }
}

//------------------------------------------------------------------------------
void AnalysisSuitableRule::Carry(TSpline& spline)
{
  std::vector<Index> changed;
  TSpline refined = this->CarryFunctions(spline, changed);
  this->Transfer(spline, changed, refined);
  spline = std::move(refined);
  this->CoarseNodes = this->Mesh.CountNodes();
}

//------------------------------------------------------------------------------
void AnalysisSuitableRule::Check(
  const TSpline& spline, const std::vector<RefinementMark>& marks) const
{
  if (spline.Size() != static_cast<Index>(this->Anchors.size()))
  {
    throw std::invalid_argument("The spline is not the one that this refinement belongs to.");
  }
  for (const RefinementMark& mark : marks)
  {
    if (mark.Function < 0 || mark.Function >= spline.Size() || mark.Direction < 0 ||
        mark.Direction > 2 || mark.Knot < spline.Functions[mark.Function][mark.Direction][0] ||
        mark.Knot > spline.Functions[mark.Function][mark.Direction][4])
    {
      throw std::out_of_range("A refinement mark lies outside of the support of its function.");
    }
  }
}

//------------------------------------------------------------------------------
// Bisects the cells at the axis of f that the knot lies inside of, unless that has been done
// since the spline was carried to the mesh.
void AnalysisSuitableRule::BisectAround(const BlendingFunction& f, int direction, std::int32_t knot)
{
  const int b = (direction + 1) % 3, c = (direction + 2) % 3;
  for (const std::int32_t y : { f[b][2] - 1, f[b][2] })
  {
    for (const std::int32_t z : { f[c][2] - 1, f[c][2] })
    {
      GridIndex at;
      at[direction] = knot;
      at[b] = y;
      at[c] = z;
      if (this->Mesh.Inside(at))
      {
        const BisectionMesh::Cell cell = this->Mesh.Find(at);
        if (cell.Id < this->CoarseNodes && this->Mesh.Box(at, cell.Level).Low[direction] < knot)
        {
          this->Mesh.Bisect(at);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
// The functions of the refined mesh, with the control points of those that were there before; the
// others are listed in `changed` and have zeros.
TSpline AnalysisSuitableRule::CarryFunctions(const TSpline& coarse, std::vector<Index>& changed)
{
  const std::vector<Index> old = std::exchange(this->Anchors, this->Mesh.SortedAnchors());
  TSpline refined;
  refined.KnotLines = coarse.KnotLines;
  refined.Components = coarse.Components;
  refined.Functions.reserve(this->Anchors.size());
  refined.Weights.assign(this->Anchors.size(), 1.0);
  refined.ControlPoints.assign(this->Anchors.size() * coarse.Components, 0.0);
  Index from = 0; // anchors stay, so the old ones appear among the new ones in the same order
  for (const Index anchor : this->Anchors)
  {
    const Index i = refined.Size();
    refined.Functions.push_back(this->Mesh.FunctionAt(anchor));
    const bool wasThere = from < coarse.Size() && old[from] == anchor;
    if (wasThere && coarse.Functions[from] == refined.Functions[i])
    {
      std::copy_n(coarse.ControlPoint(from), coarse.Components, refined.ControlPoint(i));
    }
    else
    {
      changed.push_back(i);
    }
    from += wasThere ? 1 : 0;
  }
  return refined;
}

//------------------------------------------------------------------------------
void AnalysisSuitableRule::Transfer(
  const TSpline& coarse, const std::vector<Index>& changed, TSpline& refined) const
{
  std::array<Duals, 3> duals{ Duals(coarse.KnotLines[0]), Duals(coarse.KnotLines[1]),
    Duals(coarse.KnotLines[2]) };
  // By coarse cell, the functions whose functional is taken in it.
  std::vector<char> wanted(this->CoarseNodes, false);
  std::vector<std::vector<std::size_t>> inCell(this->CoarseNodes);
  std::vector<Numbered> functions;
  for (const Index i : changed)
  {
    functions.push_back(Number(refined.Functions[i], duals));
    inCell[this->Mesh.MarkPath(functions.back().Unit, wanted).Id].push_back(functions.size() - 1);
  }
  for (Index j = 0; j < coarse.Size(); ++j)
  {
    const Numbered g = Number(coarse.Functions[j], duals);
    this->Mesh.VisitCells(SupportOf(g.Knots), wanted,
      [&](const BisectionMesh::Cell& cell, const GridIndex&)
      {
        for (const std::size_t n : inCell[cell.Id])
        {
          const double dual =
            SupportHolds(g.Knots, functions[n].Unit) ? Dual(functions[n], g, duals) : 0.0;
          for (int c = 0; dual != 0.0 && c < coarse.Components; ++c)
          {
            refined.ControlPoint(changed[n])[c] += dual * coarse.ControlPoint(j)[c];
          }
        }
      });
  }
}

//------------------------------------------------------------------------------
std::unique_ptr<AnalysisSuitableRule> MakeAnalysisSuitableRule(
  const TSpline& tensorProduct, Closure closure)
{
  GridIndex rootCells{ 0, 0, 0 };
  std::array<int, 3> depth{ 0, 0, 0 };
  for (int a = 0; a < 3 && tensorProduct.Size() > 0; ++a)
  {
    // The first function sits in the domain's corner: its last knot ends the first root cell.
    const std::int32_t width = tensorProduct.Functions[0][a][4];
    const auto intervals = static_cast<std::int32_t>(tensorProduct.KnotLines[a].size()) - 1;
    while ((2 << depth[a]) <= width)
    {
      ++depth[a];
    }
    if (width == 1 << depth[a] && intervals % width == 0)
    {
      rootCells[a] = intervals / width;
    }
  }
  if (*std::min_element(rootCells.begin(), rootCells.end()) > 0)
  {
    auto rule = std::make_unique<AnalysisSuitableRule>(rootCells, depth, closure);
    if (rule->Matches(tensorProduct))
    {
      return rule;
    }
  }
  throw std::invalid_argument(
    "Analysis-suitable refinement starts from a tensor-product spline whose "
    "cells are powers of two of knot spans wide.");
}

//------------------------------------------------------------------------------
std::unique_ptr<RefinementRule> MakeAnalysisSuitableRule(const TSpline& tensorProduct)
{
  return MakeAnalysisSuitableRule(tensorProduct, Closure::Narrow);
}
}
