// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Unfolding.h"

#include <cmath>
#include <unordered_map>

namespace trivariate
{
namespace
{
const double Pi = std::acos(-1.0);

double AngleBetween(const Point2& a, const Point2& b)
{
  return std::atan2(std::abs(Cross(a, b)), a.dot(b));
}

// The edge that a crossing leads through, seen from the triangle that it leaves.
struct Portal
{
  Index LeftPoint, RightPoint;
  Point2 Left, Right; // unfolded
};

// The shortest path within one row of triangles, and the row's way around the points it bends at.
class Sleeve
{
public:
  Sleeve(const LayoutMesh& mesh, Index from, Index to, std::vector<Crossing> crossings)
    : Mesh(mesh)
    , From(from)
    , To(to)
    , Crossings(std::move(crossings))
  {
    this->Shorten();
    this->PullTight();
  }

  /// Reroutes wherever that shortens. False where it does nowhere, but for rounding.
  bool Improve()
  {
    const double before = this->Length();
    if (!this->Reroute())
    {
      return false;
    }
    this->Shorten();
    this->PullTight();
    return this->Length() < (1.0 - 1e-12) * before;
  }

  double Length() const
  {
    double length = 0.0;
    for (std::size_t n = 0; n + 1 < this->Bends.size(); ++n)
    {
      length += (this->Bends[n + 1].Place - this->Bends[n].Place).norm();
    }
    return length;
  }
  Geodesic Result() const
  {
    Geodesic result{ this->Crossings, std::vector<double>(this->Crossings.size(), -1.0),
      this->Length() };
    for (std::size_t n = 0; n + 1 < this->Bends.size(); ++n)
    {
      const Bend& bend = this->Bends[n];
      const Bend& next = this->Bends[n + 1];
      const Point2 way = next.Place - bend.Place;
      for (std::size_t i = bend.Last + 1; i < next.First; ++i)
      {
        const Portal& portal = this->Portals[i];
        const double right = std::max(0.0, Cross(portal.Right - bend.Place, way));
        const double left = std::max(0.0, Cross(way, portal.Left - bend.Place));
        result.Fractions[i] = right + left > 0.0 ? right / (right + left) : 0.5;
      }
    }
    for (std::size_t n = 1; n + 1 < this->Bends.size(); ++n)
    {
      // An edge that joins two bends belongs to the first, unless the second has no other.
      const Bend& bend = this->Bends[n];
      for (std::size_t i = bend.First; i <= bend.Last; ++i)
      {
        if (result.Fractions[i] < 0.0 || bend.First == bend.Last)
        {
          result.Fractions[i] = bend.OnLeft ? 1.0 : 0.0;
        }
      }
    }
    return result;
  }

private:
  // First and Last: the crossings of the edges at the point, on its side. The path's own ends are
  // bends too, First and Last being just outside.
  struct Bend
  {
    Index Point;
    bool OnLeft;
    Point2 Place;
    std::size_t First, Last;
  };

  bool Reroute()
  {
    std::vector<Crossing> next;
    std::size_t done = 0;
    for (std::size_t n = 1; n + 1 < this->Bends.size(); ++n)
    {
      const Bend& bend = this->Bends[n];
      std::vector<Crossing> around;
      if (bend.First >= done && this->AngleBehind(n) < Pi - 1e-9 && this->WayAround(bend, around))
      {
        next.insert(
          next.end(), this->Crossings.begin() + done, this->Crossings.begin() + bend.First);
        next.insert(next.end(), around.begin(), around.end());
        done = bend.Last + 1;
      }
    }
    next.insert(next.end(), this->Crossings.begin() + done, this->Crossings.end());
    this->Crossings = std::move(next);
    return done > 0;
  }

  // Removes loops, and triangles at either end that the path need not enter.
  void Shorten()
  {
    std::unordered_map<Index, std::size_t> place; // of each triangle that is left
    std::vector<Crossing> kept;
    for (const Crossing h : this->Crossings)
    {
      const auto known = place.find(h / 3);
      if (known != place.end())
      {
        const std::size_t back = known->second;
        while (kept.size() > back)
        {
          place.erase(kept.back() / 3);
          kept.pop_back();
        }
      }
      place[h / 3] = kept.size();
      kept.push_back(h);
    }
    const auto touches = [this](Crossing h, Index p)
    { return LeftOf(this->Mesh, h) == p || RightOf(this->Mesh, h) == p; };
    std::size_t first = 0, end = kept.size();
    while (end > first + 1 && touches(kept[end - 1], this->To))
    {
      --end;
    }
    while (first + 1 < end && touches(kept[first], this->From))
    {
      ++first;
    }
    this->Crossings.assign(kept.begin() + first, kept.begin() + end);
  }

  void UnfoldAll()
  {
    const LayoutMesh& mesh = this->Mesh;
    this->Portals.clear();
    const Crossing first = this->Crossings[0];
    // The first triangle is laid out with its edge below the origin, then moved to its apex.
    const Eigen::Vector3d right = mesh.Points[RightOf(mesh, first)];
    const Eigen::Vector3d edge = mesh.Points[LeftOf(mesh, first)] - right;
    const Eigen::Vector3d source = mesh.Points[this->From] - right;
    const double length = edge.norm();
    const Point2 origin(-edge.dot(source) / length, -edge.cross(source).norm() / length);
    Portal portal{ LeftOf(mesh, first), RightOf(mesh, first), Point2(-length, 0.0) - origin,
      -origin };
    this->Portals.push_back(portal);
    for (std::size_t i = 0; i < this->Crossings.size(); ++i)
    {
      const Entered next = Enter(mesh, this->Crossings[i]);
      const Point2 apex = Unfold(mesh, this->Crossings[i], next.Apex, portal.Left, portal.Right);
      if (i + 1 == this->Crossings.size())
      {
        portal = { this->To, this->To, apex, apex };
      }
      else if (this->Crossings[i + 1] == next.LeftExit)
      {
        portal.Right = apex;
        portal.RightPoint = next.Apex;
      }
      else
      {
        portal.Left = apex;
        portal.LeftPoint = next.Apex;
      }
      this->Portals.push_back(portal);
    }
  }

  // The funnel algorithm. Bends get the range of crossings at their point.
  void PullTight()
  {
    this->UnfoldAll();
    const std::size_t end = this->Crossings.size();
    this->Bends.assign(1, { this->From, true, Point2::Zero(), 0, static_cast<std::size_t>(-1) });
    std::size_t left = 0, right = 0;
    Point2 apex = Point2::Zero();
    for (std::size_t i = 1; i <= end; ++i)
    {
      const Portal &now = this->Portals[i], &l = this->Portals[left], &r = this->Portals[right];
      const Point2 toLeft = l.Left - apex, toRight = r.Right - apex;
      if (Cross(toRight, now.Right - apex) >= 0.0)
      {
        if (Cross(now.Right - apex, toLeft) < 0.0)
        {
          i = this->TurnAt(left, true, apex);
          left = right = i;
          continue;
        }
        right = i;
      }
      if (Cross(now.Left - apex, toLeft) >= 0.0)
      {
        if (Cross(this->Portals[right].Right - apex, now.Left - apex) < 0.0)
        {
          i = this->TurnAt(right, false, apex);
          left = right = i;
          continue;
        }
        left = i;
      }
    }
    this->Bends.push_back({ this->To, true, this->Portals[end].Left, end, end });
  }

  // Bends around one end of a portal; returns the first portal that does not touch it on that side.
  std::size_t TurnAt(std::size_t portal, bool onLeft, Point2& apex)
  {
    const auto point = [onLeft](const Portal& p) { return onLeft ? p.LeftPoint : p.RightPoint; };
    const Index corner = point(this->Portals[portal]);
    apex = onLeft ? this->Portals[portal].Left : this->Portals[portal].Right;
    std::size_t first = portal, last = portal;
    while (first > 0 && point(this->Portals[first - 1]) == corner)
    {
      --first;
    }
    while (last + 1 < this->Crossings.size() && point(this->Portals[last + 1]) == corner)
    {
      ++last;
    }
    this->Bends.push_back({ corner, onLeft, apex, first, last });
    return last + 1;
  }

  // The angle at a bend on the side away from the sleeve.
  double AngleBehind(std::size_t n) const
  {
    const Bend& bend = this->Bends[n];
    double inside = 0.0;
    Point2 before = this->Bends[n - 1].Place - bend.Place;
    for (std::size_t i = bend.First; i <= bend.Last; ++i)
    {
      const Point2 spoke =
        (bend.OnLeft ? this->Portals[i].Right : this->Portals[i].Left) - bend.Place;
      inside += AngleBetween(before, spoke);
      before = spoke;
    }
    inside += AngleBetween(before, this->Bends[n + 1].Place - bend.Place);
    double total = 0.0;
    const Index first = this->Mesh.TriangleAt(bend.Point);
    Index t = first;
    do
    {
      const Triangle& c = this->Mesh.Triangles[t];
      const int k = this->Mesh.CornerOf(t, bend.Point);
      const Eigen::Vector3d a = this->Mesh.Points[c[(k + 1) % 3]] - this->Mesh.Points[bend.Point];
      const Eigen::Vector3d b = this->Mesh.Points[c[(k + 2) % 3]] - this->Mesh.Points[bend.Point];
      total += std::atan2(a.cross(b).norm(), a.dot(b));
      t = this->Mesh.Anticlockwise(t, bend.Point);
    } while (t != first);
    return total - inside;
  }

  // The crossings around the other side of a bend's point; false where a marked edge forbids.
  bool WayAround(const Bend& bend, std::vector<Crossing>& around) const
  {
    const Index end = this->Mesh.Neighbour(
      this->Crossings[bend.Last] / 3, static_cast<int>(this->Crossings[bend.Last] % 3));
    for (Index t = this->Crossings[bend.First] / 3; t != end;)
    {
      const int corner = this->Mesh.CornerOf(t, bend.Point);
      const int side = bend.OnLeft ? corner : (corner + 2) % 3;
      if (this->Mesh.Mark(t, side) >= 0)
      {
        return false;
      }
      around.push_back(3 * t + side);
      t = this->Mesh.Neighbour(t, side);
    }
    return true;
  }

  const LayoutMesh& Mesh;
  Index From, To;
  std::vector<Crossing> Crossings;
  std::vector<Portal> Portals; // one more than crossings: the last is the end
  std::vector<Bend> Bends;
};
}

//------------------------------------------------------------------------------
PathEnd SectorWith(const LayoutMesh& mesh, Index point, Index triangle)
{
  PathEnd end{ point, { triangle } };
  Index t = triangle;
  while (mesh.Mark(t, (mesh.CornerOf(t, point) + 2) % 3) < 0)
  {
    t = mesh.Anticlockwise(t, point);
    if (t == triangle)
    {
      std::sort(end.Sector.begin(), end.Sector.end());
      return end;
    }
    end.Sector.push_back(t);
  }
  for (t = triangle; mesh.Mark(t, mesh.CornerOf(t, point)) < 0;)
  {
    t = mesh.Clockwise(t, point);
    end.Sector.push_back(t);
  }
  std::sort(end.Sector.begin(), end.Sector.end());
  return end;
}

//------------------------------------------------------------------------------
Geodesic Straighten(const LayoutMesh& mesh, Index from, Index to, std::vector<Crossing> crossings)
{
  Sleeve sleeve(mesh, from, to, std::move(crossings));
  while (sleeve.Improve())
  {
  }
  return sleeve.Result();
}
}
