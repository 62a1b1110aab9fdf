// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FlatPolycube.h"

#include "NormalAxes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double FlatCosine = 0.9;      // of a normal to its axis in a flat part
constexpr double LeastArea = 0.005;     // of a flat part, in those of the surface
constexpr double LeastTriangles = 24.0; // of a flat part, in mean ones
constexpr double LeastWidth = 0.06;     // between two planes, in the solid's extents along the axis
constexpr double LeastEdges = 2.0;      // between two planes, in mean edges
constexpr double FullTurn = 12.566370614359172;

struct Areas
{
  std::vector<double> Weights;
  std::vector<Vector3d> Normals, Centres;
  double Sum = 0.0;

  explicit Areas(const SurfaceMesh& mesh)
  {
    for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
    {
      const Triangle& c = mesh.Triangles[t];
      const Vector3d area = mesh.AreaVector(t);
      this->Weights.push_back(area.norm());
      this->Normals.push_back(area.normalized());
      this->Centres.push_back((mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0);
      this->Sum += this->Weights.back();
    }
  }
};

// From some starts, so that no poor maximum is taken.
Matrix3d BestAxes(const Areas& areas, const Execution& execution)
{
  const Matrix3d principal = PrincipalFrame(areas.Weights, areas.Centres);
  Matrix3d best = principal;
  double most = -1.0;
  for (const Vector3d& axis :
    { Vector3d(0, 0, 0), Vector3d(0.35, 0.35, 0.35), Vector3d(0.6, 0, 0), Vector3d(0, 0, 0.6) })
  {
    execution.Check(0.0);
    const Eigen::AngleAxisd turn(
      axis.norm(), axis.norm() > 0.0 ? Vector3d(axis.normalized()) : Vector3d::UnitX().eval());
    const Matrix3d frame =
      ClingToNormals(areas.Weights, areas.Normals, turn.toRotationMatrix() * principal);
    double value = 0.0;
    for (std::size_t t = 0; t < areas.Normals.size(); ++t)
    {
      value += areas.Weights[t] * (frame * areas.Normals[t]).array().pow(4).sum();
    }
    if (value > most)
    {
      most = value;
      best = frame;
    }
  }
  return best;
}

// The flat side that a normal belongs to: 2 axis + side; -1: none.
int FlatSide(const Vector3d& normal)
{
  int axis = 0;
  return normal.cwiseAbs().maxCoeff(&axis) < FlatCosine ? -1 : 2 * axis + (normal[axis] > 0.0);
}

struct Plane
{
  double Place, Area;
};

// The planes of the connected flat parts, along each axis.
std::array<std::vector<Plane>, 3> FlatParts(
  const SurfaceMesh& mesh, const Areas& areas, const Matrix3d& frame)
{
  std::array<std::vector<Plane>, 3> planes;
  std::vector<int> side(areas.Normals.size());
  std::transform(areas.Normals.begin(), areas.Normals.end(), side.begin(),
    [&frame](const Vector3d& n) { return FlatSide(frame * n); });
  const double least =
    areas.Sum * std::max(LeastArea, LeastTriangles / double(areas.Weights.size()));
  std::vector<Index> waiting;
  for (Index seed = 0; seed < mesh.NumberOfTriangles(); ++seed)
  {
    const int own = side[seed];
    if (own < 0)
    {
      continue;
    }
    Plane plane{ 0.0, 0.0 };
    side[seed] = -1;
    waiting.push_back(seed);
    while (!waiting.empty())
    {
      const Index t = waiting.back();
      waiting.pop_back();
      plane.Place += areas.Weights[t] * frame.row(own / 2).dot(areas.Centres[t]);
      plane.Area += areas.Weights[t];
      for (int k = 0; k < 3; ++k)
      {
        const Index next = mesh.Neighbour(t, k);
        if (side[next] == own)
        {
          side[next] = -1;
          waiting.push_back(next);
        }
      }
    }
    if (plane.Area > least)
    {
      planes[own / 2].push_back({ plane.Place / plane.Area, plane.Area });
    }
  }
  return planes;
}

// Planes close to each other become one, the closest two first. `edge`: the mean one.
std::vector<double> Merged(std::vector<Plane> planes, double edge)
{
  const auto lower = [](const Plane& a, const Plane& b) { return a.Place < b.Place; };
  std::sort(planes.begin(), planes.end(), lower);
  const double extent = planes.empty() ? 0.0 : planes.back().Place - planes.front().Place;
  const double least = std::max(LeastWidth * extent, LeastEdges * edge);
  while (planes.size() > 2)
  {
    std::size_t closest = 1;
    for (std::size_t i = 2; i < planes.size(); ++i)
    {
      closest =
        planes[i].Place - planes[i - 1].Place < planes[closest].Place - planes[closest - 1].Place
          ? i
          : closest;
    }
    Plane &a = planes[closest - 1], &b = planes[closest];
    if (b.Place - a.Place > least)
    {
      break;
    }
    a.Place = (a.Area * a.Place + b.Area * b.Place) / (a.Area + b.Area);
    a.Area += b.Area;
    planes.erase(planes.begin() + closest);
  }
  std::vector<double> places;
  for (const Plane& plane : planes)
  {
    places.push_back(plane.Place);
  }
  return places;
}

// The surface's winding number about a point exceeds a half. Solid angles as in van Oosterom and
// Strackee, "The solid angle of a plane triangle", IEEE Trans. Biomed. Eng. 30 (1983).
bool IsInside(const SurfaceMesh& mesh, const Vector3d& point)
{
  double angle = 0.0;
  for (const Triangle& c : mesh.Triangles)
  {
    const Vector3d a = mesh.Points[c[0]] - point, b = mesh.Points[c[1]] - point,
                   d = mesh.Points[c[2]] - point;
    const double la = a.norm(), lb = b.norm(), ld = d.norm();
    angle += 2.0 * std::atan2(a.dot(b.cross(d)),
                     la * lb * ld + a.dot(b) * ld + b.dot(d) * la + d.dot(a) * lb);
  }
  return angle > 0.5 * FullTurn;
}
}

//------------------------------------------------------------------------------
FlatPolycube FindFlatPolycube(const SurfaceMesh& mesh, Index most, const Execution& execution)
{
  const Areas areas(mesh);
  const Matrix3d frame = BestAxes(areas, execution);
  const std::array<std::vector<Plane>, 3> parts = FlatParts(mesh, areas, frame);
  const double edge = std::sqrt(4.0 / std::sqrt(3.0) * areas.Sum / double(areas.Weights.size()));
  std::array<std::vector<double>, 3> places;
  Index cells = 1;
  for (int axis = 0; axis < 3; ++axis)
  {
    places[axis] = Merged(parts[axis], edge);
    if (places[axis].size() < 2)
    {
      throw std::runtime_error("The surface has no flat parts on both sides along some axis.");
    }
    cells *= static_cast<Index>(places[axis].size()) - 1;
  }
  // A polycube worth its name fills a fair part of its box.
  if (cells > 4 * most)
  {
    throw std::runtime_error(
      "The flat parts of the surface cut its box into " + std::to_string(cells) + " cells.");
  }
  std::vector<LatticePoint> cubes;
  LatticePoint cell;
  Index tested = 0;
  for (cell[2] = 0; cell[2] + 1 < static_cast<int>(places[2].size()); ++cell[2])
  {
    for (cell[1] = 0; cell[1] + 1 < static_cast<int>(places[1].size()); ++cell[1])
    {
      for (cell[0] = 0; cell[0] + 1 < static_cast<int>(places[0].size()); ++cell[0])
      {
        execution.Check(double(tested++) / double(cells));
        Vector3d middle;
        for (int axis = 0; axis < 3; ++axis)
        {
          middle[axis] = 0.5 * (places[axis][cell[axis]] + places[axis][cell[axis] + 1]);
        }
        if (IsInside(mesh, frame.transpose() * middle))
        {
          cubes.push_back(cell);
        }
      }
    }
  }
  if (static_cast<Index>(cubes.size()) > most)
  {
    throw std::runtime_error("The flat parts of the surface make " + std::to_string(cubes.size()) +
                             " cubes; at most " + std::to_string(most) + " are allowed.");
  }
  FlatPolycube result{ Polycube(cubes), {} };
  if (result.Cubes.EulerCharacteristic() != mesh.EulerCharacteristic())
  {
    throw std::runtime_error("The cubes between the flat parts of the surface have Euler "
                             "characteristic " +
                             std::to_string(result.Cubes.EulerCharacteristic()) + ", the surface " +
                             std::to_string(mesh.EulerCharacteristic()) + ".");
  }
  for (Index corner = 0; corner < result.Cubes.NumberOfCorners; ++corner)
  {
    const LatticePoint& p = result.Cubes.Points[corner];
    result.Corners.push_back(
      frame.transpose() * Vector3d(places[0][p[0]], places[1][p[1]], places[2][p[2]]));
  }
  return result;
}
}
