// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ChartRelabelling.h"

#include <algorithm>
#include <bitset>
#include <queue>
#include <tuple>

namespace trivariate
{
namespace
{
// At most three labels around the point, each in one run, no two opposite.
bool IsRegular(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels, Index p)
{
  if (mesh.FanBegin(p) == mesh.FanEnd(p))
  {
    return true;
  }
  std::bitset<6> seen;
  int runs = 0;
  ChartLabel last = labels[mesh.FanEnd(p)[-1]];
  for (const Index* t = mesh.FanBegin(p); t != mesh.FanEnd(p); ++t)
  {
    runs += labels[*t] != last;
    last = labels[*t];
    seen.set(last);
  }
  for (int axis = 0; axis < 3; ++axis)
  {
    if (seen[2 * axis] && seen[2 * axis + 1])
    {
      return false;
    }
  }
  return seen.count() <= 3 && runs == (seen.count() == 1 ? 0 : static_cast<int>(seen.count()));
}

// Connected pieces of one label each: the piece of each triangle, and the pieces' sizes.
struct Pieces
{
  std::vector<Index> OfTriangle, Sizes;

  Pieces(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels)
    : OfTriangle(labels.size(), -1)
  {
    std::vector<Index> waiting;
    for (Index seed = 0; seed < mesh.NumberOfTriangles(); ++seed)
    {
      if (this->OfTriangle[seed] >= 0)
      {
        continue;
      }
      const Index piece = static_cast<Index>(this->Sizes.size());
      this->Sizes.push_back(0);
      this->OfTriangle[seed] = piece;
      waiting.push_back(seed);
      while (!waiting.empty())
      {
        const Index t = waiting.back();
        waiting.pop_back();
        ++this->Sizes[piece];
        for (int k = 0; k < 3; ++k)
        {
          const Index other = mesh.Neighbour(t, k);
          if (this->OfTriangle[other] < 0 && labels[other] == labels[t])
          {
            this->OfTriangle[other] = piece;
            waiting.push_back(other);
          }
        }
      }
    }
  }
};

class Relabelling
{
public:
  Relabelling(const SurfaceMesh& mesh, const ChartRewards& rewards, double stiffness,
    std::vector<ChartLabel>& labels)
    : Mesh(mesh)
    , Rewards(rewards)
    , Labels(labels)
  {
    double sum = 0.0;
    for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
    {
      for (int k = 0; k < 3; ++k)
      {
        sum += this->SideLength(t, k);
      }
    }
    this->BorderCost = stiffness * sum / (3.0 * std::max<Index>(1, mesh.NumberOfTriangles()));
  }

  Index Run(const Execution& execution)
  {
    for (Index t = 0; t < this->Mesh.NumberOfTriangles(); ++t)
    {
      this->Enqueue(t);
    }
    Index changes = 0;
    // Every change lowers the energy, so this ends; but changes of rounding size are not worth it.
    while (!this->Waiting.empty())
    {
      const Move move = this->Waiting.top();
      this->Waiting.pop();
      const Move now = this->BestMove(move.Triangle);
      if (now.To != move.To || now.Gain != move.Gain || !this->IsHarmless(move.Triangle, move.To))
      {
        continue;
      }
      if (++changes % 4096 == 0)
      {
        execution.Check(0.0);
      }
      this->Labels[move.Triangle] = move.To;
      // What was refused before around here may be harmless now.
      for (const Index p : this->Mesh.Triangles[move.Triangle])
      {
        for (const Index* t = this->Mesh.FanBegin(p); t != this->Mesh.FanEnd(p); ++t)
        {
          this->Enqueue(*t);
        }
      }
    }
    return changes;
  }

private:
  struct Move
  {
    double Gain;
    Index Triangle;
    ChartLabel To;

    bool operator<(const Move& other) const
    {
      return std::tie(this->Gain, other.Triangle, other.To) <
             std::tie(other.Gain, this->Triangle, this->To);
    }
  };

  double SideLength(Index t, int k) const
  {
    const Triangle& c = this->Mesh.Triangles[t];
    return (this->Mesh.Points[c[(k + 1) % 3]] - this->Mesh.Points[c[k]]).norm();
  }

  double Gain(Index t, ChartLabel to) const
  {
    const ChartLabel from = this->Labels[t];
    double border = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      const ChartLabel other = this->Labels[this->Mesh.Neighbour(t, k)];
      border += this->SideLength(t, k) * ((other != from) - (other != to));
    }
    return this->Rewards[t][to] - this->Rewards[t][from] + this->BorderCost * border;
  }

  // The best of the neighbours' labels; gain 0 if none is better.
  Move BestMove(Index t) const
  {
    Move best{ 0.0, t, this->Labels[t] };
    for (int k = 0; k < 3; ++k)
    {
      const ChartLabel to = this->Labels[this->Mesh.Neighbour(t, k)];
      const double gain = to == this->Labels[t] ? 0.0 : this->Gain(t, to);
      if (gain > best.Gain || (gain == best.Gain && gain > 0.0 && to < best.To))
      {
        best = { gain, t, to };
      }
    }
    return best;
  }

  void Enqueue(Index t)
  {
    const Move move = this->BestMove(t);
    if (move.Gain > 1e-9 * this->BorderCost * this->BorderCost)
    {
      this->Waiting.push(move);
    }
  }

  bool IsHarmless(Index t, ChartLabel to)
  {
    const ChartLabel from = this->Labels[t];
    if (!this->TouchesInOnePiece(t, from) || !this->TouchesInOnePiece(t, to))
    {
      return false;
    }
    this->Labels[t] = to;
    const Triangle& corners = this->Mesh.Triangles[t];
    const bool regular = std::all_of(corners.begin(), corners.end(),
      [this](Index p) { return IsRegular(this->Mesh, this->Labels, p); });
    this->Labels[t] = from;
    return regular;
  }

  // Whether the part of the triangle's rim that lies on chart `label` is one piece, neither nothing
  // nor all.
  bool TouchesInOnePiece(Index t, ChartLabel label) const
  {
    std::array<bool, 6> touches; // corner, side, corner, side, ...
    for (int k = 0; k < 3; ++k)
    {
      const Index p = this->Mesh.Triangles[t][k];
      touches[2 * k] = std::any_of(this->Mesh.FanBegin(p), this->Mesh.FanEnd(p),
        [this, t, label](Index other) { return other != t && this->Labels[other] == label; });
      touches[2 * k + 1] = this->Labels[this->Mesh.Neighbour(t, k)] == label;
    }
    int beginnings = 0;
    for (int i = 0; i < 6; ++i)
    {
      beginnings += touches[i] && !touches[(i + 5) % 6];
    }
    return beginnings == 1;
  }

  const SurfaceMesh& Mesh;
  const ChartRewards& Rewards;
  std::vector<ChartLabel>& Labels;
  double BorderCost;
  std::priority_queue<Move> Waiting;
};
}

//------------------------------------------------------------------------------
Index RelabelTowardNormals(const SurfaceMesh& mesh, const ChartRewards& rewards, double stiffness,
  std::vector<ChartLabel>& labels, const Execution& execution)
{
  return Relabelling(mesh, rewards, stiffness, labels).Run(execution);
}

//------------------------------------------------------------------------------
bool AreCubeCharts(const SurfaceMesh& mesh, const std::vector<ChartLabel>& labels)
{
  for (Index p = 0; p < mesh.NumberOfPoints(); ++p)
  {
    if (!IsRegular(mesh, labels, p))
    {
      return false;
    }
  }
  std::bitset<6> seen;
  for (const ChartLabel label : labels)
  {
    seen.set(label);
  }
  return seen.all() && Pieces(mesh, labels).Sizes.size() == 6;
}

//------------------------------------------------------------------------------
void KeepLargestPieces(const SurfaceMesh& mesh, std::vector<ChartLabel>& labels)
{
  const Pieces pieces(mesh, labels);
  std::array<Index, 6> largest;
  largest.fill(-1);
  for (std::size_t t = 0; t < labels.size(); ++t)
  {
    Index& best = largest[labels[t]];
    const Index piece = pieces.OfTriangle[t];
    best = best < 0 || pieces.Sizes[piece] > pieces.Sizes[best] ? piece : best;
  }
  constexpr ChartLabel none = 6;
  std::vector<Index> front;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    if (pieces.OfTriangle[t] == largest[labels[t]])
    {
      front.push_back(t);
    }
    else
    {
      labels[t] = none;
    }
  }
  // From the largest pieces outwards; a triangle between several takes the lowest label.
  while (!front.empty())
  {
    std::vector<Index> next;
    std::vector<ChartLabel> taken;
    for (const Index t : front)
    {
      for (int k = 0; k < 3; ++k)
      {
        const Index other = mesh.Neighbour(t, k);
        if (labels[other] == none)
        {
          next.push_back(other);
          taken.push_back(labels[t]);
        }
      }
    }
    front.clear();
    for (std::size_t i = 0; i < next.size(); ++i)
    {
      if (labels[next[i]] == none)
      {
        front.push_back(next[i]);
      }
      labels[next[i]] = std::min(labels[next[i]], taken[i]);
    }
  }
}
}
