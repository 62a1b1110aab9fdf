// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockSpline.h"

#include "TSpline/BlendingFunctionMap.h"

#include <algorithm>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
LocalKnots Reversed(const LocalKnots& k, std::int32_t one)
{
  return { one - k[4], one - k[3], one - k[2], one - k[1], one - k[0] };
}

// Sets of numbers; the root of each is its smallest.
class Forest
{
public:
  explicit Forest(Index n)
    : Parent(n)
  {
    std::iota(this->Parent.begin(), this->Parent.end(), Index(0));
  }

  Index Root(Index i)
  {
    while (this->Parent[i] != i)
    {
      i = this->Parent[i] = this->Parent[this->Parent[i]];
    }
    return i;
  }

  void Join(Index i, Index j)
  {
    const Index a = this->Root(i), b = this->Root(j);
    this->Parent[std::max(a, b)] = std::min(a, b);
  }

private:
  std::vector<Index> Parent;
};

// A trace as the key of a map.
BlendingFunction KeyOf(const std::array<LocalKnots, 2>& knots, Index face)
{
  const auto f = static_cast<std::int32_t>(face);
  return { knots[0], knots[1], { f, f, f, f, f } };
}

// The knot lines of the traces on a face: bit 0 of unit square (s, t) says that its low side in
// direction s is on one, bit 1 the same of t.
class TraceMesh
{
public:
  explicit TraceMesh(std::int32_t one)
    : One(one)
    , Bits(static_cast<std::size_t>(one) * one, 0)
  {
  }

  void Insert(const std::array<LocalKnots, 2>& trace)
  {
    for (int d = 0; d < 2; ++d)
    {
      for (const std::int32_t knot : trace[d])
      {
        for (std::int32_t q = trace[1 - d][0]; knot < this->One && q < trace[1 - d][4]; ++q)
        {
          this->At(d, knot, q) |= static_cast<std::uint8_t>(1 << d);
        }
      }
    }
  }

  // A line that crosses the trace in direction d and is no knot of it; -1: none.
  std::int32_t FindCrossing(const std::array<LocalKnots, 2>& trace, int d)
  {
    const LocalKnots &k = trace[d], &across = trace[1 - d];
    for (std::int32_t knot = k[0] + 1; knot < k[4]; ++knot)
    {
      bool crosses = std::find(k.begin(), k.end(), knot) == k.end();
      for (std::int32_t q = across[0]; crosses && q < across[4]; ++q)
      {
        crosses = (this->At(d, knot, q) >> d & 1) != 0;
      }
      if (crosses)
      {
        return knot;
      }
    }
    return -1;
  }

private:
  std::uint8_t& At(int d, std::int32_t knot, std::int32_t q)
  {
    return d == 0 ? this->Bits[static_cast<std::size_t>(q) * this->One + knot]
                  : this->Bits[static_cast<std::size_t>(knot) * this->One + q];
  }

  std::int32_t One;
  std::vector<std::uint8_t> Bits;
};
}

//------------------------------------------------------------------------------
BlockSpline::BlockSpline(const BlockComplex& complex, int depth)
  : Complex(&complex)
  , Levels(depth)
  , One(std::int32_t(1) << depth)
  , Size(complex.Extent())
  , BlockOfBox(static_cast<std::size_t>(Index(Size[0]) * Size[1] * Size[2]), -1)
{
  for (Index b = 0; b < complex.Size(); ++b)
  {
    const LatticePoint& o = complex.Origins[b];
    this->BlockOfBox[o[0] + Index(this->Size[0]) * (o[1] + Index(this->Size[1]) * o[2])] = b;
  }
}

//------------------------------------------------------------------------------
TSpline BlockSpline::MakeCoarsestGroup(
  const std::pair<LatticePoint, LatticePoint>& box, int cells) const
{
  const auto& [low, high] = box;
  std::array<KnotLine, 3> lines;
  for (int a = 0; a < 3; ++a)
  {
    lines[a] = MakeUniformKnotLine(low[a], high[a], (high[a] - low[a]) * this->One);
  }
  const int stride = this->One / cells;
  return MakeTensorProduct(lines, { stride, stride, stride }, 0);
}

//------------------------------------------------------------------------------
// What is no block of a group's box, in runs along u.
void BlockSpline::AddHoles(
  const std::pair<LatticePoint, LatticePoint>& box, std::vector<IndexBox>& holes) const
{
  const auto& [low, high] = box;
  for (std::int32_t w = low[2]; w < high[2]; ++w)
  {
    for (std::int32_t v = low[1]; v < high[1]; ++v)
    {
      bool isInHole = false;
      for (std::int32_t u = low[0]; u < high[0]; ++u)
      {
        const bool isHole =
          this->BlockOfBox[u + Index(this->Size[0]) * (v + Index(this->Size[1]) * w)] < 0;
        if (isHole && !isInHole)
        {
          holes.push_back({ { u * this->One, v * this->One, w * this->One },
            { 0, (v + 1) * this->One, (w + 1) * this->One } });
        }
        if (isHole)
        {
          holes.back().High[0] = (u + 1) * this->One;
        }
        isInHole = isHole;
      }
    }
  }
}

//------------------------------------------------------------------------------
TSpline BlockSpline::MakeCoarsest(int cells, int attributes) const
{
  if (cells < 1 || (cells & (cells - 1)) != 0 || cells > this->One)
  {
    throw std::invalid_argument("A block of " + std::to_string(this->One) +
                                " knot intervals cannot have " + std::to_string(cells) + " cells.");
  }
  TSpline spline;
  for (int a = 0; a < 3; ++a)
  {
    spline.KnotLines[a] = MakeUniformKnotLine(0.0, this->Size[a], this->Size[a] * this->One);
  }
  for (const auto& entry : this->Complex->GroupBoxes())
  {
    this->AddHoles(entry.second, spline.Holes);
    for (BlendingFunction f : this->MakeCoarsestGroup(entry.second, cells).Functions)
    {
      for (int a = 0; a < 3; ++a)
      {
        for (std::int32_t& knot : f[a])
        {
          knot += entry.second.first[a] * this->One;
        }
      }
      if (HasSupportOutside(spline.Holes, f))
      {
        spline.Functions.push_back(f);
      }
    }
  }
  spline.Components = 3 + attributes;
  spline.Weights.assign(spline.Functions.size(), 1.0);
  spline.ControlPoints.assign(spline.Functions.size() * spline.Components, 0.0);
  return spline;
}

//------------------------------------------------------------------------------
Index BlockSpline::BlockOf(const BlendingFunction& f) const
{
  const auto low = [this, &f](int a) { return Index(f[a][0] / this->One); };
  const auto high = [this, &f](int a) { return Index((f[a][4] - 1) / this->One); };
  for (Index w = low(2); w <= high(2); ++w)
  {
    for (Index v = low(1); v <= high(1); ++v)
    {
      for (Index u = low(0); u <= high(0); ++u)
      {
        const Index block = this->BlockOfBox[u + this->Size[0] * (v + this->Size[1] * w)];
        if (block >= 0)
        {
          return block;
        }
      }
    }
  }
  return -1;
}

//------------------------------------------------------------------------------
BlockSpline::Trace BlockSpline::TraceOf(
  const BlendingFunction& f, Index block, int axis, int side) const
{
  const LatticePoint& origin = this->Complex->Origins[block];
  const std::int32_t end = (origin[axis] + side) * this->One;
  Trace trace;
  if (f[axis][side ? 1 : 3] != end)
  {
    return trace;
  }
  const BlockFace face{ block, axis, side };
  if (!this->Complex->IsGlued(face))
  {
    return trace;
  }
  const FaceTwin& twin = this->Complex->Twin(face);
  const std::array<int, 2> axes = TangentialAxes(axis);
  for (int d = 0; d < 2; ++d)
  {
    for (int k = 0; k < 5; ++k)
    {
      trace.Knots[d][k] = f[axes[d]][k] - origin[axes[d]] * this->One;
    }
  }
  const Index own = 6 * block + 2 * axis + side;
  const Index other = 6 * twin.Face.Block + 2 * twin.Face.Axis + twin.Face.Side;
  trace.Face = std::min(own, other);
  if (other < own)
  {
    if (twin.Swapped)
    {
      std::swap(trace.Knots[0], trace.Knots[1]);
    }
    for (int d = 0; d < 2; ++d)
    {
      trace.Knots[d] = twin.Flipped[d] ? Reversed(trace.Knots[d], this->One) : trace.Knots[d];
    }
  }
  return trace;
}

//------------------------------------------------------------------------------
bool BlockSpline::IsShared(const BlockFace& face, Sharing what) const
{
  const Index other = this->Complex->Twin(face).Face.Block;
  return what == Sharing::Places ||
         (other >= 0 && this->Complex->Segments[face.Block] == this->Complex->Segments[other]);
}

//------------------------------------------------------------------------------
template <typename Visit>
void BlockSpline::VisitTraces(const TSpline& spline, Sharing what, const Visit& visit) const
{
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const BlendingFunction& f = spline.Functions[i];
    const Index block = this->BlockOf(f);
    for (int side = 0; side < 6; ++side)
    {
      const BlockFace face{ block, side / 2, side % 2 };
      const Trace trace = this->TraceOf(f, block, face.Axis, face.Side);
      if (trace.Face >= 0 && this->IsShared(face, what))
      {
        visit(i, face, trace);
      }
    }
  }
}

//------------------------------------------------------------------------------
SharedPoints BlockSpline::Share(const TSpline& spline, Sharing what) const
{
  Forest functions(spline.Size());
  BlendingFunctionMap functionOf;
  this->VisitTraces(spline, what,
    [&](Index i, const BlockFace&, const Trace& trace)
    { functions.Join(i, functionOf.Insert(KeyOf(trace.Knots, trace.Face), i).first); });
  SharedPoints shared;
  shared.PointOf.resize(spline.Functions.size());
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const Index first = functions.Root(i);
    if (first == i)
    {
      shared.PointOf[i] = shared.Count();
      shared.FirstOf.push_back(i);
    }
    shared.PointOf[i] = shared.PointOf[first];
  }
  return shared;
}

//------------------------------------------------------------------------------
void BlockSpline::MakePointsEqual(TSpline& spline) const
{
  const SharedPoints whole = this->Share(spline, Sharing::Attributes),
                     places = this->Share(spline, Sharing::Places);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const Index first = whole.FirstOf[whole.PointOf[i]], place = places.FirstOf[places.PointOf[i]];
    spline.Weights[i] = spline.Weights[place];
    std::copy_n(spline.ControlPoint(first), spline.Components, spline.ControlPoint(i));
    std::copy_n(spline.ControlPoint(place), 3, spline.ControlPoint(i));
  }
}

//------------------------------------------------------------------------------
std::vector<RefinementMark> BlockSpline::CrossedTraces(const TSpline& spline) const
{
  std::map<Index, TraceMesh> meshes;
  this->VisitTraces(spline, Sharing::Places,
    [&](Index, const BlockFace&, const Trace& trace)
    { meshes.try_emplace(trace.Face, this->One).first->second.Insert(trace.Knots); });
  std::vector<RefinementMark> marks;
  this->VisitTraces(spline, Sharing::Places,
    [&](Index i, const BlockFace& face, const Trace& trace)
    {
      for (int d = 0; d < 2; ++d)
      {
        const std::int32_t knot = meshes.at(trace.Face).FindCrossing(trace.Knots, d);
        if (knot >= 0)
        {
          marks.push_back(this->ToMark(i, face, trace.Face, d, knot));
        }
      }
    });
  return marks;
}

//------------------------------------------------------------------------------
// Which direction of its block direction d of a trace is, and whether it runs backwards there.
std::pair<int, bool> BlockSpline::AlongTrace(const BlockFace& face, Index traceFace, int d) const
{
  const std::array<int, 2> axes = TangentialAxes(face.Axis);
  if (traceFace == 6 * face.Block + 2 * face.Axis + face.Side)
  {
    return { axes[d], false };
  }
  const FaceTwin& twin = this->Complex->Twin(face);
  return { axes[twin.Swapped ? 1 - d : d], twin.Flipped[d] };
}

//------------------------------------------------------------------------------
// The split at a knot line of a trace, as its function sees it.
RefinementMark BlockSpline::ToMark(
  Index function, const BlockFace& face, Index traceFace, int d, std::int32_t knot) const
{
  const auto [direction, isFlipped] = this->AlongTrace(face, traceFace, d);
  return { function, direction,
    this->Complex->Origins[face.Block][direction] * this->One +
      (isFlipped ? this->One - knot : knot) };
}

//------------------------------------------------------------------------------
std::vector<Index> BlockSpline::LinkSplits(const TSpline& spline, Sharing what) const
{
  Forest splits(12 * spline.Size());
  BlendingFunctionMap functionOf;
  std::vector<BlockFace> faceOf; // of the first function of each trace
  std::vector<Index> firstOf;
  this->VisitTraces(spline, what,
    [&](Index i, const BlockFace& face, const Trace& trace)
    {
      // Traces are numbered; the first function of each and its face are kept under that number.
      const auto known = static_cast<Index>(faceOf.size());
      const auto [number, isNew] = functionOf.Insert(KeyOf(trace.Knots, trace.Face), known);
      if (isNew)
      {
        faceOf.push_back(face);
        firstOf.push_back(i);
        return;
      }
      for (int d = 0; d < 2; ++d)
      {
        const auto [own, ownFlipped] = this->AlongTrace(face, trace.Face, d);
        const auto [other, otherFlipped] = this->AlongTrace(faceOf[number], trace.Face, d);
        for (int span = 0; span < 4; ++span)
        {
          splits.Join(SplitNumber(i, own, ownFlipped ? 3 - span : span),
            SplitNumber(firstOf[number], other, otherFlipped ? 3 - span : span));
        }
      }
    });
  std::vector<Index> first(12 * spline.Size());
  for (std::size_t n = 0; n < first.size(); ++n)
  {
    first[n] = splits.Root(static_cast<Index>(n));
  }
  return first;
}

//------------------------------------------------------------------------------
std::vector<int> BlockSpline::SegmentsOf(const TSpline& spline) const
{
  std::vector<int> segments;
  for (const BlendingFunction& f : spline.Functions)
  {
    segments.push_back(this->Complex->Segments[this->BlockOf(f)]);
  }
  return segments;
}
}
