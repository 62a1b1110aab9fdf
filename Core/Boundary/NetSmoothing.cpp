// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "NetSmoothing.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

constexpr double Reach = 0.49;       // along each axis, of the only vertex of a corner
constexpr double NarrowReach = 0.15; // of others

// The point of a corner's faces that is nearest to p, which counts from the corner.
Vector3d NearestOnFaces(std::uint16_t faces, const Vector3d& p)
{
  Vector3d nearest = Vector3d::Zero();
  double least = p.squaredNorm();
  for (int arc = 0; arc < 12; ++arc)
  {
    if (faces >> arc & 1)
    {
      const int c = arc / 4, a = (c + 1) % 3, b = (c + 2) % 3;
      Vector3d q = p;
      q[c] = 0.0;
      q[a] = arc % 2 ? std::max(q[a], 0.0) : std::min(q[a], 0.0);
      q[b] = arc / 2 % 2 ? std::max(q[b], 0.0) : std::min(q[b], 0.0);
      const double distance = (p - q).squaredNorm();
      if (distance < least)
      {
        least = distance;
        nearest = q;
      }
    }
  }
  return nearest;
}

// The volume that a triangle sweeps from p to q along straight lines, exactly: the area vector is
// quadratic in time.
double SweptVolume(const Points& p, const Points& q, Index a, Index b, Index c)
{
  const auto area = [&](double t)
  {
    const Vector3d x = (1.0 - t) * p[a] + t * q[a];
    const Vector3d y = (1.0 - t) * p[b] + t * q[b];
    const Vector3d z = (1.0 - t) * p[c] + t * q[c];
    return Vector3d(0.5 * (y - x).cross(z - x));
  };
  const Vector3d move = (q[a] + q[b] + q[c] - p[a] - p[b] - p[c]) / 3.0;
  return move.dot(area(0.0) + 4.0 * area(0.5) + area(1.0)) / 6.0;
}

// A quadrilateral is the mean of its two triangulations.
double SweptVolume(const Points& p, const Points& q, const BoundaryFace& face)
{
  const auto& v = face.Vertices;
  if (face.Size() == 3)
  {
    return SweptVolume(p, q, v[0], v[1], v[2]);
  }
  return 0.5 * (SweptVolume(p, q, v[0], v[1], v[2]) + SweptVolume(p, q, v[0], v[2], v[3]) +
                 SweptVolume(p, q, v[0], v[1], v[3]) + SweptVolume(p, q, v[1], v[2], v[3]));
}

// Numbers the connected pieces of the inner vertices of surfaces; -1 for other vertices.
std::vector<Index> PiecesOf(const NetTopology& topology, Index& count)
{
  const Index size = static_cast<Index>(topology.Kinds.size());
  std::vector<Index> piece(size, -1);
  std::vector<Index> open;
  count = 0;
  for (Index seed = 0; seed < size; ++seed)
  {
    if (piece[seed] >= 0 || topology.Kinds[seed] != NetTopology::SURFACE)
    {
      continue;
    }
    piece[seed] = count;
    open.push_back(seed);
    while (!open.empty())
    {
      const Index v = open.back();
      open.pop_back();
      for (Index n = topology.NeighbourBegin[v]; n < topology.NeighbourBegin[v + 1]; ++n)
      {
        const Index w = topology.Neighbours[n];
        if (piece[w] < 0 && topology.Kinds[w] == NetTopology::SURFACE)
        {
          piece[w] = count;
          open.push_back(w);
        }
      }
    }
    ++count;
  }
  return piece;
}
}

//------------------------------------------------------------------------------
NetTopology::NetTopology(const BoundaryNet& net, const Execution& execution)
{
  const Index vertices = static_cast<Index>(net.Vertices.size());
  const Index faces = static_cast<Index>(net.Faces.size());
  this->FaceBegin.assign(vertices + 1, 0);
  for (const BoundaryFace& face : net.Faces)
  {
    for (int i = 0; i < face.Size(); ++i)
    {
      ++this->FaceBegin[face.Vertices[i] + 1];
    }
  }
  std::partial_sum(this->FaceBegin.begin(), this->FaceBegin.end(), this->FaceBegin.begin());
  this->Faces.resize(this->FaceBegin.back());
  std::vector<Index> next = this->FaceBegin;
  for (Index f = 0; f < faces; ++f)
  {
    for (int i = 0; i < net.Faces[f].Size(); ++i)
    {
      this->Faces[next[net.Faces[f].Vertices[i]]++] = f;
    }
  }

  // The neighbours of a vertex, each as often as there are faces at the edge to it.
  const auto edges = [&](Index v, std::vector<Index>& ends)
  {
    ends.clear();
    for (Index n = this->FaceBegin[v]; n < this->FaceBegin[v + 1]; ++n)
    {
      const BoundaryFace& face = net.Faces[this->Faces[n]];
      const int size = face.Size();
      const int at = static_cast<int>(
        std::find(face.Vertices.begin(), face.Vertices.end(), v) - face.Vertices.begin());
      ends.push_back(face.Vertices[(at + 1) % size]);
      ends.push_back(face.Vertices[(at + size - 1) % size]);
    }
    std::sort(ends.begin(), ends.end());
  };
  this->Kinds.resize(vertices);
  this->NeighbourBegin.assign(vertices + 1, 0);
  // Once to count, once to fill.
  for (bool fill : { false, true })
  {
    execution.ParallelFor(vertices,
      [&](Index begin, Index end)
      {
        std::vector<Index> ends;
        for (Index v = begin; v < end; ++v)
        {
          edges(v, ends);
          Index all = 0, onCurve = 0;
          for (std::size_t i = 0, j = 0; i < ends.size(); i = j)
          {
            while (j < ends.size() && ends[j] == ends[i])
            {
              ++j;
            }
            ++all;
            onCurve += j - i > 2;
            if (fill && (this->Kinds[v] == SURFACE || j - i > 2))
            {
              const Index number = (this->Kinds[v] == SURFACE ? all : onCurve) - 1;
              this->Neighbours[this->NeighbourBegin[v] + number] = ends[i];
            }
          }
          if (!fill)
          {
            this->Kinds[v] = onCurve == 0 ? SURFACE : onCurve == 2 ? CURVE : JUNCTION;
            this->NeighbourBegin[v + 1] = onCurve == 0 ? all : onCurve;
          }
        }
      });
    if (!fill)
    {
      std::partial_sum(
        this->NeighbourBegin.begin(), this->NeighbourBegin.end(), this->NeighbourBegin.begin());
      this->Neighbours.resize(this->NeighbourBegin.back());
    }
  }
}

//------------------------------------------------------------------------------
Points AnchorsOf(const BoundaryNet& net)
{
  Points points;
  points.reserve(net.Vertices.size());
  for (const BoundaryVertex& vertex : net.Vertices)
  {
    points.emplace_back(vertex.Anchor[0], vertex.Anchor[1], vertex.Anchor[2]);
  }
  return points;
}

//------------------------------------------------------------------------------
Vector3d Constrain(const BoundaryVertex& vertex, Vector3d point)
{
  const Vector3d anchor(vertex.Anchor[0], vertex.Anchor[1], vertex.Anchor[2]);
  const double reach = vertex.Alone ? Reach : NarrowReach;
  Vector3d p = (point - anchor).cwiseMax(-reach).cwiseMin(reach);
  for (int a = 0; a < 3; ++a)
  {
    p[a] = vertex.FixedAxes >> a & 1 ? 0.0 : p[a];
  }
  if (vertex.Alone && p.squaredNorm() > Reach * Reach)
  {
    const Vector3d nearest = NearestOnFaces(vertex.Faces, p);
    const double distance = (p - nearest).norm();
    p = distance > Reach ? Vector3d(nearest + (p - nearest) * (Reach / distance)) : p;
  }
  return anchor + p;
}

//------------------------------------------------------------------------------
Vector3d AreaVector(const BoundaryFace& face, const Points& points)
{
  const auto& v = face.Vertices;
  const Vector3d across = points[v[2]] - points[v[0]];
  return face.Size() == 3 ? Vector3d(0.5 * (points[v[1]] - points[v[0]]).cross(across))
                          : Vector3d(0.5 * across.cross(points[v[3]] - points[v[1]]));
}

//------------------------------------------------------------------------------
Vector3d NormalAt(
  const BoundaryNet& net, const NetTopology& topology, Index vertex, const Points& points)
{
  Vector3d sum = Vector3d::Zero();
  for (Index n = topology.FaceBegin[vertex]; n < topology.FaceBegin[vertex + 1]; ++n)
  {
    sum += AreaVector(net.Faces[topology.Faces[n]], points);
  }
  return sum.normalized();
}

//------------------------------------------------------------------------------
Vector3d MeanOfNeighbours(const NetTopology& topology, Index v, const Points& points)
{
  Vector3d sum = Vector3d::Zero();
  const Index begin = topology.NeighbourBegin[v], end = topology.NeighbourBegin[v + 1];
  for (Index n = begin; n < end; ++n)
  {
    sum += points[topology.Neighbours[n]];
  }
  return begin < end ? Vector3d(sum / (end - begin)) : points[v];
}

//------------------------------------------------------------------------------
void Smooth(const BoundaryNet& net, const NetTopology& topology, int iterations, Points& points,
  const Execution& execution)
{
  const Index size = static_cast<Index>(points.size());
  Points forwards(points.size());
  for (int i = 0; i < iterations; ++i)
  {
    execution.Check(static_cast<double>(i) / iterations);
    execution.ParallelFor(size,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          forwards[v] = 0.5 * (points[v] + MeanOfNeighbours(topology, v, points));
        }
      });
    execution.ParallelFor(size,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          points[v] = Constrain(
            net.Vertices[v], 1.5 * forwards[v] - 0.5 * MeanOfNeighbours(topology, v, forwards));
        }
      });
  }
}

//------------------------------------------------------------------------------
void SmoothTangentially(const BoundaryNet& net, const NetTopology& topology, int iterations,
  Points& points, const Execution& execution)
{
  const Index size = static_cast<Index>(points.size());
  Points moved(points.size());
  for (int i = 0; i < iterations; ++i)
  {
    execution.Check(static_cast<double>(i) / iterations);
    execution.ParallelFor(size,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          Vector3d move = 0.5 * (MeanOfNeighbours(topology, v, points) - points[v]);
          if (topology.Kinds[v] == NetTopology::SURFACE)
          {
            const Vector3d normal = NormalAt(net, topology, v, points);
            move -= normal * normal.dot(move);
          }
          else if (topology.Kinds[v] == NetTopology::CURVE)
          {
            const Index* neighbour = &topology.Neighbours[topology.NeighbourBegin[v]];
            const Vector3d along = (points[neighbour[1]] - points[neighbour[0]]).normalized();
            move = along * along.dot(move);
          }
          else
          {
            move.setZero();
          }
          moved[v] = Constrain(net.Vertices[v], points[v] + move);
        }
      });
    points.swap(moved);
  }
}

//------------------------------------------------------------------------------
void RestoreVolumes(
  const BoundaryNet& net, const NetTopology& topology, Points& points, const Execution& execution)
{
  const Points anchors = AnchorsOf(net);
  const Index size = static_cast<Index>(points.size());
  const Index faces = static_cast<Index>(net.Faces.size());
  Index count = 0;
  const std::vector<Index> pieces = PiecesOf(topology, count);
  std::vector<double> swept(faces), step(count), area(count);
  Points normals(points.size());
  for (int round = 0; round < 3; ++round)
  {
    execution.Check(round / 3.0);
    execution.ParallelFor(faces,
      [&](Index begin, Index end)
      {
        for (Index f = begin; f < end; ++f)
        {
          swept[f] = SweptVolume(anchors, points, net.Faces[f]);
        }
      });
    execution.ParallelFor(size,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          normals[v].setZero();
          for (Index n = topology.FaceBegin[v]; n < topology.FaceBegin[v + 1]; ++n)
          {
            const BoundaryFace& face = net.Faces[topology.Faces[n]];
            normals[v] += AreaVector(face, points) / face.Size();
          }
        }
      });
    // In the order of the faces and vertices, whatever the threads.
    std::fill(step.begin(), step.end(), 0.0);
    std::fill(area.begin(), area.end(), 0.0);
    for (Index f = 0; f < faces; ++f)
    {
      const BoundaryFace& face = net.Faces[f];
      for (int i = 0; i < face.Size(); ++i)
      {
        const Index piece = pieces[face.Vertices[i]];
        if (piece >= 0)
        {
          step[piece] -= swept[f];
          break;
        }
      }
    }
    for (Index v = 0; v < size; ++v)
    {
      if (pieces[v] >= 0)
      {
        area[pieces[v]] += normals[v].norm();
      }
    }
    for (Index p = 0; p < count; ++p)
    {
      step[p] = area[p] > 0.0 ? std::clamp(step[p] / area[p], -0.2, 0.2) : 0.0;
    }
    execution.ParallelFor(size,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          if (pieces[v] >= 0)
          {
            points[v] =
              Constrain(net.Vertices[v], points[v] + step[pieces[v]] * normals[v].normalized());
          }
        }
      });
  }
}
}
