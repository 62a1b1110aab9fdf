// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SurfaceReduction.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <queue>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double Evenness = 0.02;   // of the squared length of an edge, against distances
constexpr double LeastCosine = 0.2; // between a triangle's normals before and after
constexpr double LeastRoundness = 0.05;
constexpr Index CheckedEvery = 4096;

// The sum of squared distances from planes.
struct Quadric
{
  Eigen::Matrix3d A = Eigen::Matrix3d::Zero();
  Vector3d B = Vector3d::Zero();
  double C = 0.0, Area = 0.0;

  void Add(const Vector3d& areaVector, const Vector3d& origin)
  {
    const double area = areaVector.norm();
    if (area > 0.0)
    {
      const Vector3d n = areaVector / area;
      const double d = n.dot(origin);
      this->A += area * n * n.transpose();
      this->B += area * d * n;
      this->C += area * d * d;
      this->Area += area;
    }
  }
  void Add(const Quadric& other)
  {
    this->A += other.A;
    this->B += other.B;
    this->C += other.C;
    this->Area += other.Area;
  }
  double At(const Vector3d& p) const { return p.dot(this->A * p) - 2.0 * p.dot(this->B) + this->C; }
};

// `From` drawn into `To`.
struct Collapse
{
  double Cost;
  Index From, To;
  Index Version; // of both points, summed
};

struct Dearer
{
  bool operator()(const Collapse& a, const Collapse& b) const { return a.Cost > b.Cost; }
};

class Reducer
{
public:
  explicit Reducer(const SurfaceMesh& mesh)
    : Points(mesh.Points)
    , Given(mesh.Triangles)
    , Triangles(mesh.Triangles)
    , Around(mesh.Points.size())
    , Quadrics(mesh.Points.size())
    , Versions(mesh.Points.size(), 0)
    , DrawnInto(mesh.Points.size(), -1)
    , Left(mesh.NumberOfTriangles())
  {
    for (const Vector3d& point : this->Points)
    {
      this->Centre += point / double(this->Points.size());
    }
    for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
    {
      for (const Index p : mesh.Triangles[t])
      {
        this->Around[p].push_back(t);
        this->Quadrics[p].Add(mesh.AreaVector(t), mesh.Points[p] - this->Centre);
      }
    }
    for (Index p = 0; p < mesh.NumberOfPoints(); ++p)
    {
      this->Offer(p, false);
    }
  }

  void Run(Index triangles, const Execution& execution)
  {
    const Index whole = this->Left;
    for (Index step = 0; this->Left > triangles && !this->Queue.empty(); ++step)
    {
      if (step % CheckedEvery == 0)
      {
        execution.Check(double(whole - this->Left) / double(whole - triangles));
      }
      const Collapse next = this->Queue.top();
      this->Queue.pop();
      if (next.Version == this->Versions[next.From] + this->Versions[next.To] &&
          !this->Around[next.From].empty() && !this->Around[next.To].empty() &&
          this->IsAllowed(next.From, next.To))
      {
        this->Draw(next.From, next.To);
      }
    }
  }

  ReducedSurface Result() const
  {
    std::vector<Index> number(this->Points.size(), -1), kept, numberOfTriangle, triangleAt;
    std::vector<Vector3d> points;
    std::vector<Triangle> triangles;
    for (Triangle c : this->Triangles)
    {
      numberOfTriangle.push_back(c[0] >= 0 ? static_cast<Index>(triangles.size()) : Index(-1));
      if (c[0] >= 0)
      {
        for (Index& p : c)
        {
          if (number[p] < 0)
          {
            number[p] = static_cast<Index>(points.size());
            points.push_back(this->Points[p]);
            kept.push_back(p);
            triangleAt.push_back(numberOfTriangle.back());
          }
          p = number[p];
        }
        triangles.push_back(c);
      }
    }
    for (std::size_t t = 0; t < numberOfTriangle.size(); ++t)
    {
      if (numberOfTriangle[t] < 0)
      {
        numberOfTriangle[t] = triangleAt[number[this->EndOf(this->Given[t][0])]];
      }
    }
    return { SurfaceMesh(std::move(points), std::move(triangles)), std::move(kept),
      std::move(numberOfTriangle) };
  }

private:
  static bool Has(const Triangle& c, Index p) { return c[0] == p || c[1] == p || c[2] == p; }

  std::vector<Index> NeighboursOf(Index p) const
  {
    std::vector<Index> neighbours;
    for (const Index t : this->Around[p])
    {
      const Triangle& c = this->Triangles[t];
      neighbours.push_back(c[0] == p ? c[1] : c[1] == p ? c[2] : c[0]);
    }
    return neighbours;
  }

  // The cheaper way along all edges of a point, or only those toward larger numbers.
  void Offer(Index p, bool all)
  {
    for (const Index q : this->NeighboursOf(p))
    {
      if (all || q > p)
      {
        Quadric sum = this->Quadrics[p];
        sum.Add(this->Quadrics[q]);
        const double even = Evenness * sum.Area * (this->Points[p] - this->Points[q]).squaredNorm();
        const Index version = this->Versions[p] + this->Versions[q];
        const double atP = sum.At(this->Points[p] - this->Centre);
        const double atQ = sum.At(this->Points[q] - this->Centre);
        this->Queue.push(atP < atQ ? Collapse{ atP + even, q, p, version }
                                   : Collapse{ atQ + even, p, q, version });
      }
    }
  }

  // Two triangles go, with two points beside the edge as the only common neighbours; no other is
  // turned over or becomes a needle.
  bool IsAllowed(Index from, Index to) const
  {
    std::vector<Index> a = this->NeighboursOf(from), b = this->NeighboursOf(to), common;
    std::sort(a.begin(), a.end());
    std::sort(b.begin(), b.end());
    std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
    if (common.size() != 2 || this->Around[common[0]].size() < 4 ||
        this->Around[common[1]].size() < 4 || a.size() + b.size() < 8)
    {
      return false;
    }
    for (const Index t : this->Around[from])
    {
      const Triangle& c = this->Triangles[t];
      if (Has(c, to))
      {
        continue;
      }
      const int k = c[0] == from ? 0 : c[1] == from ? 1 : 2;
      const Vector3d &u = this->Points[c[(k + 1) % 3]], &v = this->Points[c[(k + 2) % 3]];
      const Vector3d before = (u - this->Points[from]).cross(v - this->Points[from]);
      const Vector3d after = (u - this->Points[to]).cross(v - this->Points[to]);
      const double sides = (u - v).squaredNorm() + (u - this->Points[to]).squaredNorm() +
                           (v - this->Points[to]).squaredNorm();
      if (before.dot(after) <= LeastCosine * before.norm() * after.norm() ||
          after.norm() < LeastRoundness * sides)
      {
        return false;
      }
    }
    return true;
  }

  void Draw(Index from, Index to)
  {
    for (const Index t : this->Around[from])
    {
      Triangle& c = this->Triangles[t];
      if (Has(c, to))
      {
        for (const Index p : c)
        {
          if (p != from)
          {
            std::vector<Index>& around = this->Around[p];
            around.erase(std::find(around.begin(), around.end(), t));
          }
        }
        c = { -1, -1, -1 };
        --this->Left;
      }
      else
      {
        std::replace(c.begin(), c.end(), from, to);
        this->Around[to].push_back(t);
      }
    }
    this->Around[from].clear();
    this->DrawnInto[from] = to;
    this->Quadrics[to].Add(this->Quadrics[from]);
    ++this->Versions[to];
    this->Offer(to, true);
  }

  // Where a point is in the end.
  Index EndOf(Index p) const
  {
    while (this->DrawnInto[p] >= 0)
    {
      p = this->DrawnInto[p];
    }
    return p;
  }

  const std::vector<Vector3d>& Points;
  const std::vector<Triangle>& Given;
  std::vector<Triangle> Triangles; // { -1, -1, -1 }: gone
  std::vector<std::vector<Index>> Around;
  std::vector<Quadric> Quadrics; // about Centre
  std::vector<Index> Versions;
  std::vector<Index> DrawnInto; // by each point; -1: still there
  Index Left;
  Vector3d Centre = Vector3d::Zero();
  std::priority_queue<Collapse, std::vector<Collapse>, Dearer> Queue;
};
}

//------------------------------------------------------------------------------
SurfaceMesh Reduced(const SurfaceMesh& mesh, Index triangles, const Execution& execution)
{
  return mesh.NumberOfTriangles() <= triangles ? mesh : Reduce(mesh, triangles, execution).Mesh;
}

//------------------------------------------------------------------------------
ReducedSurface Reduce(const SurfaceMesh& mesh, Index triangles, const Execution& execution)
{
  Reducer reducer(mesh);
  reducer.Run(triangles, execution);
  return reducer.Result();
}
}
