// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// The compact rule: semi-standard T-splines whose blending functions have minimal support on a box
// mesh. A mark inserts a knot face as large as the marked function's cross-section; a function that
// a face crosses completely is split by knot insertion, weight and control point carried along, and
// equal functions merge. Mesh and functions determine each other, so the order of the splits does
// not matter (Dokken, Lyche, Pettersen 2013, who study this mesh for polynomial spline spaces;
// Sederberg et al. 2004 for the weights).
#include "BlendingFunctionMap.h"
#include "KnotFaces.h"
#include "RefinementRule.h"

#include <algorithm>
#include <queue>
#include <tuple>

namespace trivariate
{
namespace
{
// Functions under refinement with their homogeneous rows (w, w p), addressed by their knots.
class FunctionPool
{
public:
  FunctionPool(int components, Index expected)
    : Stride(components + 1)
    , Row(components + 1)
  {
    this->Ids.Reserve(expected);
    this->Functions.reserve(expected);
    this->Rows.reserve(expected * this->Stride);
  }

  // Adds factor * row to the function; returns its id and whether it is new.
  std::pair<Index, bool> Add(const BlendingFunction& function, double factor, const double* row)
  {
    const auto [id, isNew] = this->Ids.Insert(function, static_cast<Index>(this->Functions.size()));
    if (isNew)
    {
      this->Functions.push_back(function);
      this->Alive.push_back(true);
      this->Rows.resize(this->Rows.size() + this->Stride, 0.0);
    }
    double* target = &this->Rows[id * this->Stride];
    for (int c = 0; c < this->Stride; ++c)
    {
      target[c] += factor * row[c];
    }
    return { id, isNew };
  }

  // Takes a function out and returns its row, which stays valid until the next Remove.
  const double* Remove(Index id)
  {
    this->Ids.Erase(this->Functions[id]);
    this->Alive[id] = false;
    std::copy_n(&this->Rows[id * this->Stride], this->Stride, this->Row.begin());
    return this->Row.data();
  }

  int Stride;
  std::vector<BlendingFunction> Functions;
  std::vector<char> Alive;
  std::vector<double> Rows;

private:
  BlendingFunctionMap Ids;
  std::vector<double> Row;
};

// Interleaves the bits of the three central knots, so that neighbours in space are neighbours in
// memory (and in the file).
std::uint64_t MortonCode(const BlendingFunction& f)
{
  std::uint64_t code = 0;
  for (int bit = 20; bit >= 0; --bit)
  {
    for (int a = 2; a >= 0; --a)
    {
      code = (code << 1) | ((static_cast<std::uint64_t>(f[a][2]) >> bit) & 1u);
    }
  }
  return code;
}

Index SupportVolume(const BlendingFunction& f)
{
  return Index(f[0][4] - f[0][0]) * Index(f[1][4] - f[1][0]) * Index(f[2][4] - f[2][0]);
}

// A function that a face crosses, and where.
struct Split
{
  Index Volume, Function;
  int Direction;
  std::int32_t Knot;

  bool operator<(const Split& other) const
  {
    return std::tie(this->Volume, this->Function) < std::tie(other.Volume, other.Function);
  }
};

class KnotInsertionRule : public RefinementRule
{
public:
  explicit KnotInsertionRule(const TSpline& spline)
    : Faces(spline)
  {
  }

  std::unique_ptr<RefinementRule> Clone() const override
  {
    return std::make_unique<KnotInsertionRule>(*this);
  }

  void Refine(TSpline& spline, const std::vector<RefinementMark>& marks) override
  {
    for (const RefinementMark& mark : marks)
    {
      this->Faces.Insert(spline.Functions[mark.Function], mark.Direction, mark.Knot);
    }
    FunctionPool pool(spline.Components, 2 * spline.Size());
    std::vector<double> row(pool.Stride);
    for (Index i = 0; i < spline.Size(); ++i)
    {
      row[0] = spline.Weights[i];
      for (int c = 0; c < spline.Components; ++c)
      {
        row[c + 1] = spline.Weights[i] * spline.ControlPoint(i)[c];
      }
      pool.Add(spline.Functions[i], 1.0, row.data());
    }
    this->SplitAll(spline, pool);
    this->Collect(pool, spline);
  }

private:
  // The function with the largest support first. A child's support is smaller than its parent's, so
  // when a function's turn comes all that merges into it has done so, and it is split only once.
  // What is left without support in the domain is dropped.
  void SplitAll(const TSpline& spline, FunctionPool& pool) const
  {
    std::priority_queue<Split> waiting;
    const auto enqueue = [this, &pool, &waiting](Index id)
    {
      int direction = 0;
      const std::int32_t knot = this->Faces.FindCrossing(pool.Functions[id], direction);
      if (knot >= 0)
      {
        waiting.push({ SupportVolume(pool.Functions[id]), id, direction, knot });
      }
    };
    for (Index id = 0; id < static_cast<Index>(pool.Functions.size()); ++id)
    {
      enqueue(id);
    }
    while (!waiting.empty())
    {
      const auto [volume, id, direction, knot] = waiting.top();
      waiting.pop();
      const BlendingFunction parent = pool.Functions[id];
      const KnotLine& line = spline.KnotLines[direction];
      const LocalKnots& k = parent[direction];
      const KnotInsertion factor =
        InsertKnot({ line[k[0]], line[k[1]], line[k[2]], line[k[3]], line[k[4]] }, line[knot]);
      std::array<std::int32_t, 6> all{ k[0], k[1], k[2], k[3], k[4], knot };
      std::sort(all.begin(), all.end());
      BlendingFunction first = parent, second = parent;
      std::copy_n(all.begin(), 5, first[direction].begin());
      std::copy_n(all.begin() + 1, 5, second[direction].begin());

      const double* row = pool.Remove(id);
      for (const auto& [child, share] :
        { std::make_pair(first, factor.First), std::make_pair(second, factor.Second) })
      {
        if (!HasSupportOutside(spline.Holes, child))
        {
          continue;
        }
        const auto [childId, isNew] = pool.Add(child, share, row);
        if (isNew)
        {
          enqueue(childId);
        }
      }
    }
  }

  static void Collect(const FunctionPool& pool, TSpline& spline)
  {
    std::vector<std::pair<std::uint64_t, Index>> order;
    for (std::size_t id = 0; id < pool.Functions.size(); ++id)
    {
      if (pool.Alive[id])
      {
        order.emplace_back(MortonCode(pool.Functions[id]), static_cast<Index>(id));
      }
    }
    std::sort(order.begin(), order.end(),
      [&pool](const auto& a, const auto& b)
      {
        return a.first != b.first ? a.first < b.first
                                  : pool.Functions[a.second] < pool.Functions[b.second];
      });
    spline.Functions.clear();
    spline.Weights.clear();
    spline.ControlPoints.clear();
    for (const auto& entry : order)
    {
      const double* row = &pool.Rows[entry.second * pool.Stride];
      spline.Functions.push_back(pool.Functions[entry.second]);
      spline.Weights.push_back(row[0]);
      for (int c = 1; c < pool.Stride; ++c)
      {
        spline.ControlPoints.push_back(row[c] / row[0]);
      }
    }
  }

  KnotFaces Faces;
};
}

//------------------------------------------------------------------------------
std::unique_ptr<RefinementRule> MakeKnotInsertionRule(const TSpline& spline)
{
  return std::make_unique<KnotInsertionRule>(spline);
}
}
