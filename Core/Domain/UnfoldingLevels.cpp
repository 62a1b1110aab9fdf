// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "UnfoldingLevels.h"

#include "StretchEnergy.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>

namespace trivariate
{
namespace
{
using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr std::size_t MostNeighbours = 9;
constexpr double LeastCosine = 0.7;   // between normals before and after
constexpr double LeastQuality = 0.05; // of triangles in space; 1: equilateral
constexpr double LeastGain = 0.05;    // of triangles, by a sweep
constexpr double BetweenLevels = 4.0; // triangles of a level against the next coarser one
constexpr int LocalRounds = 8;
constexpr double LeastArea = 1e-3; // of a triangle in a hole, by that of the hole

double Cross(const Vector2d& a, const Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}
}

// Takes points away from triangles.
class UnfoldingLevels::Sweep
{
public:
  explicit Sweep(const LayoutUnfolding& map)
    : Map(map)
    , Triangles(map.Triangles)
    , Alive(map.Triangles.size(), 1)
    , Count(static_cast<Index>(map.Triangles.size()))
    , Around(map.Mesh.Points.size())
  {
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      for (const Index p : this->Triangles[t].Points)
      {
        this->Around[p].push_back(static_cast<Index>(t));
      }
    }
  }

  void Once(Index enough, std::vector<Removal>& removals)
  {
    std::vector<char> stays(this->Around.size(), 0);
    for (Index p = 0; p < static_cast<Index>(this->Around.size()) && this->Count > enough; ++p)
    {
      if (stays[p] || !this->Map.IsInside(p) || this->Around[p].empty() ||
          this->Around[p].size() > MostNeighbours)
      {
        continue;
      }
      Removal removal{ p, this->Triangles[this->Around[p][0]].Face, this->RingOf(p) };
      if (this->Fill(removal))
      {
        for (const Index q : removal.Ring)
        {
          stays[q] = 1;
        }
        removals.push_back(std::move(removal));
      }
    }
  }

  Index NumberOfTriangles() const { return this->Count; }

  std::vector<ChartTriangle> Left() const
  {
    std::vector<ChartTriangle> left;
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      if (this->Alive[t])
      {
        left.push_back(this->Triangles[t]);
      }
    }
    return left;
  }

private:
  std::vector<Index> RingOf(Index p) const
  {
    std::vector<Index> ring;
    const auto ends = [this, p](Index t)
    {
      const Triangle& c = this->Triangles[t].Points;
      const int k = c[0] == p ? 0 : c[1] == p ? 1 : 2;
      return std::array<Index, 2>{ c[(k + 1) % 3], c[(k + 2) % 3] };
    };
    const std::vector<Index>& fan = this->Around[p];
    Index next = ends(fan[0])[0];
    do
    {
      ring.push_back(next);
      for (const Index t : fan)
      {
        const auto [from, to] = ends(t);
        if (from == ring.back())
        {
          next = to;
          break;
        }
      }
    } while (next != ring[0] && ring.size() < fan.size());
    return ring;
  }

  // Whether a new edge would neither double one nor cut off a part of the patch.
  bool MayJoin(Index p, Index q) const
  {
    return (this->Map.IsInside(p) || this->Map.IsInside(q)) &&
           std::none_of(this->Around[p].begin(), this->Around[p].end(),
             [&](Index t)
             {
               const Triangle& c = this->Triangles[t].Points;
               return c[0] == q || c[1] == q || c[2] == q;
             });
  }

  // Fills the hole from the corner that makes the least triangle best, which becomes the first of
  // the ring.
  bool Fill(Removal& removal)
  {
    const std::vector<Index> ring = removal.Ring;
    const std::size_t n = ring.size();
    std::vector<Vector3d> places;
    for (std::size_t i = 0; i < n; ++i)
    {
      places.push_back(this->Map.Mesh.Points[ring[i]]);
    }
    Vector3d normal = Vector3d::Zero();
    for (std::size_t i = 0; i < n; ++i)
    {
      normal += (places[i] - places[0]).cross(places[(i + 1) % n] - places[0]);
    }
    double best = LeastQuality;
    std::size_t from = n;
    for (std::size_t first = 0; first < n; ++first)
    {
      double least = 1.0;
      for (std::size_t i = 1; i + 1 < n && least > best; ++i)
      {
        const std::size_t b = (first + i) % n, c = (first + i + 1) % n;
        const Vector3d x = places[b] - places[first], y = places[c] - places[first];
        const Vector3d cross = x.cross(y);
        const double squares = x.squaredNorm() + y.squaredNorm() + (y - x).squaredNorm();
        const bool sound = cross.dot(normal) > LeastCosine * cross.norm() * normal.norm() &&
                           (i == 1 || this->MayJoin(ring[first], ring[b]));
        least = sound ? std::min(least, 2.0 * std::sqrt(3.0) * cross.norm() / squares) : 0.0;
      }
      if (least > best)
      {
        best = least;
        from = first;
      }
    }
    if (from == n)
    {
      return false;
    }
    std::rotate(removal.Ring.begin(), removal.Ring.begin() + from, removal.Ring.end());
    this->Replace(removal);
    return true;
  }

  void Replace(const Removal& removal)
  {
    for (const Index t : this->Around[removal.Point])
    {
      this->Alive[t] = 0;
      for (const Index p : this->Triangles[t].Points)
      {
        if (p != removal.Point)
        {
          std::vector<Index>& around = this->Around[p];
          around.erase(std::find(around.begin(), around.end(), t));
        }
      }
    }
    this->Count -= 2;
    std::size_t slot = 0;
    for (std::size_t i = 1; i + 1 < removal.Ring.size(); ++i)
    {
      const Index t = this->Around[removal.Point][slot++];
      this->Triangles[t] =
        this->Map.InChart({ removal.Ring[0], removal.Ring[i], removal.Ring[i + 1] }, removal.Face);
      this->Alive[t] = 1;
      for (const Index p : this->Triangles[t].Points)
      {
        this->Around[p].push_back(t);
      }
    }
    this->Around[removal.Point].clear();
  }

  const LayoutUnfolding& Map;
  std::vector<ChartTriangle> Triangles;
  std::vector<char> Alive;
  Index Count;
  std::vector<std::vector<Index>> Around; // triangles at each point
};

//------------------------------------------------------------------------------
UnfoldingLevels::UnfoldingLevels(LayoutUnfolding& unfolding, Index triangles)
  : Map(unfolding)
{
  Sweep sweep(unfolding);
  this->Levels.push_back({ unfolding.Triangles, {} });
  bool falling = true;
  while (falling && sweep.NumberOfTriangles() > triangles)
  {
    const double target =
      std::max(double(triangles), double(sweep.NumberOfTriangles()) / BetweenLevels);
    while (falling && double(sweep.NumberOfTriangles()) > target)
    {
      const Index before = sweep.NumberOfTriangles();
      sweep.Once(static_cast<Index>(target), this->Levels.back().Removals);
      falling = double(before - sweep.NumberOfTriangles()) > LeastGain * double(before);
    }
    this->Levels.push_back({ sweep.Left(), {} });
  }
}

//------------------------------------------------------------------------------
// Some steps of Newton's method for one point.
Vector2d UnfoldingLevels::Improved(Vector2d place, const std::vector<Vector2d>& flat,
  const std::vector<Vector3d>& points, const Removal& removal)
{
  std::vector<StretchTriangle> triangles;
  const std::size_t n = flat.size();
  for (std::size_t i = 0; i < n; ++i)
  {
    triangles.emplace_back(
      points[removal.Point], points[removal.Ring[i]], points[removal.Ring[(i + 1) % n]]);
  }
  const auto edges = [&](const Vector2d& at, std::size_t i)
  {
    Eigen::Matrix2d out;
    out << flat[i] - at, flat[(i + 1) % n] - at;
    return out;
  };
  const auto energyAt = [&](const Vector2d& at)
  {
    double energy = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      energy += triangles[i].Energy(edges(at, i));
    }
    return energy;
  };
  double energy = energyAt(place);
  for (int round = 0; round < LocalRounds; ++round)
  {
    Vector2d slope = Vector2d::Zero();
    Eigen::Matrix2d curvature = Eigen::Matrix2d::Zero();
    for (std::size_t i = 0; i < n; ++i)
    {
      StretchTriangle::Gradient gradient;
      StretchTriangle::Hessian hessian;
      triangles[i].Differentiate(edges(place, i), gradient, hessian);
      slope += gradient.head<2>();
      curvature += hessian.topLeftCorner<2, 2>();
    }
    Vector2d step = -curvature.inverse() * slope;
    double now = energyAt(place + step);
    for (int i = 0; i < 10 && !(now < energy); ++i)
    {
      step *= 0.5;
      now = energyAt(place + step);
    }
    if (!(now < energy))
    {
      break;
    }
    place += step;
    energy = now;
  }
  return place;
}

//------------------------------------------------------------------------------
void UnfoldingLevels::PlaceAgain(Index level)
{
  const std::vector<Removal>& removals = this->Levels[level].Removals;
  for (auto removal = removals.rbegin(); removal != removals.rend(); ++removal)
  {
    const std::size_t n = removal->Ring.size();
    std::vector<Vector2d> flat;
    std::vector<Vector3d> ways;
    for (const Index p : removal->Ring)
    {
      flat.push_back(this->Map.Place(this->Map.InChart({ p, p, p }, removal->Face), 0));
      ways.push_back(this->Map.Mesh.Points[p] - this->Map.Mesh.Points[removal->Point]);
    }
    // Mean-value weights.
    Vector2d place = Vector2d::Zero();
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i)
    {
      double weight = 0.0;
      for (const std::size_t other : { (i + 1) % n, (i + n - 1) % n })
      {
        const double product = ways[i].norm() * ways[other].norm();
        weight += ways[i].cross(ways[other]).norm() /
                  std::max(product + ways[i].dot(ways[other]), 1e-12 * product);
      }
      weight /= std::max(ways[i].norm(), 1e-300);
      place += weight * flat[i];
      sum += weight;
    }
    place /= sum;
    double area = 0.0;
    for (std::size_t i = 1; i + 1 < n; ++i)
    {
      area += Cross(flat[i] - flat[0], flat[i + 1] - flat[0]);
    }
    const auto least = [&](const Vector2d& at)
    {
      double smallest = area;
      for (std::size_t i = 0; i < n; ++i)
      {
        smallest = std::min(smallest, Cross(flat[i] - at, flat[(i + 1) % n] - at));
      }
      return smallest;
    };
    if (!(least(place) > LeastArea * area))
    {
      // All of the hole is seen from its first corner, so close to it a point sees all as well.
      const Vector2d to = flat[1] - flat[0], from = flat[0] - flat[n - 1];
      const Vector2d inwards =
        Vector2d(-to.y(), to.x()).normalized() + Vector2d(-from.y(), from.x()).normalized();
      double step = 0.5 * std::min(to.norm(), from.norm());
      double most = 0.0;
      for (int i = 0; i < 40; ++i, step *= 0.5)
      {
        const Vector2d at = flat[0] + step * inwards;
        const double smallest = least(at);
        if (smallest > most)
        {
          most = smallest;
          place = at;
        }
      }
    }
    place = Improved(place, flat, this->Map.Mesh.Points, *removal);
    const std::array<Index, 2>& own = this->Map.VariablesOf(removal->Point);
    this->Map.Values[own[0]] = place[0];
    this->Map.Values[own[1]] = place[1];
  }
}
}
