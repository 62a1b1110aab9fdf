// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerPlaces.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr double SnapDistance = 0.05; // of an edge
constexpr double SamePlace = 1e-6;    // of the surface's diagonal
// A bar bent to a ring has its hexahedron turned a little inside out; a mirrored choice of corners
// goes far beyond.
constexpr double MirroredVolume = -0.25; // of the surface's own

struct Foot
{
  Index Triangle = -1;
  Eigen::Vector3d Weights; // barycentric
  double SquaredDistance = std::numeric_limits<double>::infinity();
};

// The weights of the point of a triangle nearest to p: of its plane's foot, or of a side's.
Eigen::Vector3d NearestWeights(
  const Eigen::Vector3d& p, const std::array<Eigen::Vector3d, 3>& corners)
{
  const Eigen::Vector3d u = corners[1] - corners[0], v = corners[2] - corners[0];
  const Eigen::Vector3d normal = u.cross(v), w = p - corners[0];
  const double square = normal.squaredNorm();
  if (square > 0.0)
  {
    const double b = w.cross(v).dot(normal) / square, c = u.cross(w).dot(normal) / square;
    if (b >= 0.0 && c >= 0.0 && b + c <= 1.0)
    {
      return { 1.0 - b - c, b, c };
    }
  }
  Eigen::Vector3d best = Eigen::Vector3d::UnitX();
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k)
  {
    const Eigen::Vector3d side = corners[(k + 1) % 3] - corners[k];
    const double length = side.squaredNorm();
    const double along = length > 0.0 ? (p - corners[k]).dot(side) / length : 0.0;
    const double s = std::min(std::max(along, 0.0), 1.0);
    const double distance = (p - corners[k] - s * side).squaredNorm();
    if (distance < least)
    {
      least = distance;
      best.setZero();
      best[k] = 1.0 - s;
      best[(k + 1) % 3] = s;
    }
  }
  return best;
}

Foot Project(const LayoutMesh& mesh, const Eigen::Vector3d& p)
{
  Foot foot;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Triangle& c = mesh.Triangles[t];
    const std::array<Eigen::Vector3d, 3> corners{ mesh.Points[c[0]], mesh.Points[c[1]],
      mesh.Points[c[2]] };
    const Eigen::Vector3d low = corners[0].cwiseMin(corners[1]).cwiseMin(corners[2]);
    const Eigen::Vector3d high = corners[0].cwiseMax(corners[1]).cwiseMax(corners[2]);
    const Eigen::Vector3d outside = (low - p).cwiseMax(p - high).cwiseMax(0.0);
    if (outside.squaredNorm() < foot.SquaredDistance)
    {
      const Eigen::Vector3d weights = NearestWeights(p, corners);
      const double distance =
        (weights[0] * corners[0] + weights[1] * corners[1] + weights[2] * corners[2] - p)
          .squaredNorm();
      if (distance < foot.SquaredDistance)
      {
        foot = { t, weights, distance };
      }
    }
  }
  return foot;
}

// A point of the mesh there: one of its own where that is near and free, or a new one, on an edge
// or within the triangle (by a cut to the far corner, and one of that cut).
Index PointAt(LayoutMesh& mesh, const Foot& foot)
{
  const Index t = foot.Triangle;
  int k = 0;
  const double largest = foot.Weights.maxCoeff(&k);
  if (largest > 1.0 - SnapDistance && !mesh.Occupied[mesh.Triangles[t][k]])
  {
    return mesh.Triangles[t][k];
  }
  const double least = foot.Weights.minCoeff(&k);
  const int from = (k + 1) % 3;
  const Index far = mesh.Triangles[t][k];
  const double where = foot.Weights[(k + 2) % 3] / (1.0 - least);
  const Index onEdge =
    mesh.SplitEdge(t, from, std::min(std::max(where, SnapDistance), 1.0 - SnapDistance));
  if (least < SnapDistance)
  {
    return onEdge;
  }
  const Index u = mesh.TriangleLeftOf(onEdge, far);
  return mesh.SplitEdge(u, mesh.CornerOf(u, onEdge), least);
}

double Volume(const std::vector<Eigen::Vector3d>& points, const Triangle& c)
{
  return points[c[0]].dot(points[c[1]].cross(points[c[2]])) / 6.0;
}
}

//------------------------------------------------------------------------------
std::string CornerName(const Polycube& polycube, Index corner)
{
  return "corner " + std::to_string(corner) + " at " + NameOf(polycube.Points[corner]) +
         " of the polycube";
}

//------------------------------------------------------------------------------
void CheckCorners(
  const SurfaceMesh& mesh, const Polycube& polycube, const std::vector<Eigen::Vector3d>& corners)
{
  if (static_cast<Index>(corners.size()) != polycube.NumberOfCorners)
  {
    throw std::invalid_argument("The polycube has " + std::to_string(polycube.NumberOfCorners) +
                                " corners; " + std::to_string(corners.size()) + " were given.");
  }
  Index components = 0;
  mesh.Components(components);
  if (components != 1)
  {
    throw std::invalid_argument("The surface has " + std::to_string(components) +
                                " connected components; corners can be laid out on one only.");
  }
  if (mesh.EulerCharacteristic() != polycube.EulerCharacteristic())
  {
    throw std::invalid_argument(
      "The surface has Euler characteristic " + std::to_string(mesh.EulerCharacteristic()) +
      ", the polycube's boundary " + std::to_string(polycube.EulerCharacteristic()) +
      "; 2 is no handle, 0 is one, and so on.");
  }
  double inside = 0.0, spanned = 0.0;
  for (const Triangle& c : mesh.Triangles)
  {
    inside += Volume(mesh.Points, c);
  }
  for (const Polycube::Face& face : polycube.Faces)
  {
    // Both ways to cut the quadrilateral in two, each counted half.
    for (int k = 0; k < 4; ++k)
    {
      spanned += 0.5 * Volume(corners,
                         { face.Corners[k], face.Corners[(k + 1) % 4], face.Corners[(k + 2) % 4] });
    }
  }
  if (spanned < MirroredVolume * inside)
  {
    throw std::invalid_argument("The corners are those of a mirrored polycube: they span a volume "
                                "of " +
                                std::to_string(spanned) + "; exchange two of its axes.");
  }
}

//------------------------------------------------------------------------------
std::vector<Index> PlaceCorners(LayoutMesh& mesh, const Polycube& polycube,
  const std::vector<Eigen::Vector3d>& corners, double farthest, std::vector<Index> placed)
{
  Eigen::Vector3d low = mesh.Points[0], high = low;
  for (const Eigen::Vector3d& point : mesh.Points)
  {
    low = low.cwiseMin(point);
    high = high.cwiseMax(point);
  }
  std::vector<Eigen::Vector3d> feet;
  for (std::size_t i = 0; i < corners.size(); ++i)
  {
    const Index corner = static_cast<Index>(i);
    if (!corners[i].allFinite())
    {
      throw std::invalid_argument(
        "The place of " + CornerName(polycube, corner) + " is not finite.");
    }
    if (placed[i] >= 0)
    {
      feet.push_back(mesh.Points[placed[i]]);
      continue;
    }
    const Foot foot = Project(mesh, corners[i]);
    if (foot.SquaredDistance > farthest * farthest)
    {
      throw std::invalid_argument("The place of " + CornerName(polycube, corner) + " is " +
                                  std::to_string(std::sqrt(foot.SquaredDistance)) +
                                  " away from the surface; at most " + std::to_string(farthest) +
                                  " is allowed.");
    }
    const Triangle& c = mesh.Triangles[foot.Triangle];
    feet.push_back(foot.Weights[0] * mesh.Points[c[0]] + foot.Weights[1] * mesh.Points[c[1]] +
                   foot.Weights[2] * mesh.Points[c[2]]);
    for (std::size_t other = 0; other < i; ++other)
    {
      if ((feet[other] - feet[i]).norm() <= SamePlace * (high - low).norm())
      {
        throw std::invalid_argument("The " + CornerName(polycube, static_cast<Index>(other)) +
                                    " and the " + CornerName(polycube, corner) +
                                    " are at the same place of the surface.");
      }
    }
    placed[i] = PointAt(mesh, foot);
    mesh.Occupied[placed[i]] = 1;
  }
  return placed;
}
}
