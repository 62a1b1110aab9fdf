// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PosedSurface.h"

#include "OwnAxes.h"

#include <Eigen/Geometry>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr int Bits = 18; // of coordinates

// Triangles as points with weights.
struct Areas
{
  explicit Areas(const SurfaceMesh& mesh)
  {
    for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
    {
      const Triangle& c = mesh.Triangles[t];
      this->Centres.push_back((mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0);
      this->Weights.push_back(mesh.AreaVector(t).norm());
    }
  }

  Vector3d Middle() const
  {
    Vector3d sum = Vector3d::Zero();
    for (std::size_t i = 0; i < this->Centres.size(); ++i)
    {
      sum += this->Weights[i] * this->Centres[i];
    }
    return sum / std::accumulate(this->Weights.begin(), this->Weights.end(), 0.0);
  }

  std::vector<Vector3d> Centres;
  std::vector<double> Weights;
};

// Off the axes: along those of a symmetric surface much is equal, and rounding breaks the ties.
Matrix3d Oblique()
{
  return Eigen::AngleAxisd(1.0, Vector3d(0.5, 0.3, 0.7).normalized()).toRotationMatrix();
}

Matrix3d FrameOf(const Areas& areas)
{
  const std::optional<OwnAxes> own = FindOwnAxes(areas.Weights, areas.Centres);
  return !own                ? Matrix3d(Matrix3d::Identity())
         : own->ArePrincipal ? Matrix3d(Oblique() * own->Frame)
                             : own->Frame;
}

// `count` numbers, in order.
template <typename Less>
std::vector<Index> Ordered(std::size_t count, const Less& less)
{
  std::vector<Index> order(count);
  std::iota(order.begin(), order.end(), Index(0));
  std::stable_sort(order.begin(), order.end(), less);
  return order;
}

std::vector<Index> Inverse(const std::vector<Index>& order)
{
  std::vector<Index> place(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    place[order[i]] = static_cast<Index>(i);
  }
  return place;
}

// A place near a triangle, as far along the sides of another one.
Vector3d InOther(const Vector3d& place, const std::array<Vector3d, 3>& triangle,
  const std::array<Vector3d, 3>& other)
{
  const auto sides = [](const std::array<Vector3d, 3>& t)
  { return (Eigen::Matrix<double, 3, 2>() << t[1] - t[0], t[2] - t[0]).finished(); };
  const Eigen::Vector2d along = sides(triangle).colPivHouseholderQr().solve(place - triangle[0]);
  return other[0] + sides(other) * along;
}

std::array<Vector3d, 3> PlacesOf(const std::vector<Vector3d>& points, const Triangle& corners)
{
  return { points[corners[0]], points[corners[1]], points[corners[2]] };
}
}

//------------------------------------------------------------------------------
SurfacePose::SurfacePose(const SurfaceMesh& surface)
{
  const Areas areas(surface);
  this->Middle = areas.Middle();
  this->Frame = FrameOf(areas);
  double size = 0.0;
  for (const Vector3d& point : surface.Points)
  {
    size = std::max(size, (this->Frame * (point - this->Middle)).lpNorm<Eigen::Infinity>());
  }
  this->Unit = std::ldexp(1.0, std::ilogb(size) - Bits);
}

//------------------------------------------------------------------------------
PosedSurface::PosedSurface(const SurfaceMesh& given)
  : PosedSurface(given, SurfacePose(given))
{
}

//------------------------------------------------------------------------------
PosedSurface::PosedSurface(const SurfaceMesh& given, const SurfacePose& pose)
  : SurfacePose(pose)
  , Mesh(this->Sorted(given))
{
}

//------------------------------------------------------------------------------
SurfaceMesh PosedSurface::Sorted(const SurfaceMesh& given)
{
  std::vector<Vector3d> places;
  for (const Vector3d& point : given.Points)
  {
    places.push_back(this->ToPosed(point));
  }
  this->Points = Ordered(places.size(),
    [&places](Index a, Index b)
    {
      return std::lexicographical_compare(
        places[a].begin(), places[a].end(), places[b].begin(), places[b].end());
    });
  const std::vector<Index> number = Inverse(this->Points);
  std::vector<Triangle> corners;
  for (const Triangle& c : given.Triangles)
  {
    Triangle& renumbered =
      corners.emplace_back(Triangle{ number[c[0]], number[c[1]], number[c[2]] });
    std::rotate(
      renumbered.begin(), std::min_element(renumbered.begin(), renumbered.end()), renumbered.end());
  }
  this->Triangles =
    Ordered(corners.size(), [&corners](Index a, Index b) { return corners[a] < corners[b]; });
  std::vector<Vector3d> points;
  for (const Index point : this->Points)
  {
    points.push_back(places[point]);
  }
  std::sort(corners.begin(), corners.end());
  return { std::move(points), std::move(corners) };
}

//------------------------------------------------------------------------------
Vector3d SurfacePose::ToGiven(const Vector3d& place) const
{
  return this->Middle + this->Frame.transpose() * place;
}

//------------------------------------------------------------------------------
Vector3d SurfacePose::ToPosed(const Vector3d& place) const
{
  return this->Unit * (this->Frame * (place - this->Middle) / this->Unit).array().round().matrix();
}

//------------------------------------------------------------------------------
SegmentDomain SurfacePose::ToPosed(SegmentDomain domain) const
{
  for (std::vector<Vector3d>* places : { &domain.Layout.Points, &domain.Places })
  {
    for (Vector3d& place : *places)
    {
      place = this->ToPosed(place);
    }
  }
  return domain;
}

//------------------------------------------------------------------------------
SegmentDomain PosedSurface::ToGiven(const SurfaceMesh& given, SegmentDomain domain) const
{
  SurfaceLayout& layout = domain.Layout;
  const Index kept = given.NumberOfPoints();
  const auto numberOf = [&](Index point) { return point < kept ? this->Points[point] : point; };
  const std::vector<Vector3d> points = std::move(layout.Points), parameters = layout.Parameters;
  layout.Points = given.Points;
  layout.Points.resize(points.size());
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& origin = this->Mesh.Triangles[layout.Origins[t]];
    const Triangle same{ this->Points[origin[0]], this->Points[origin[1]],
      this->Points[origin[2]] };
    for (const Index p : layout.Triangles[t])
    {
      if (p >= kept)
      {
        layout.Points[p] =
          InOther(points[p], PlacesOf(this->Mesh.Points, origin), PlacesOf(given.Points, same));
      }
    }
  }
  for (std::size_t p = 0; p < parameters.size(); ++p)
  {
    layout.Parameters[numberOf(static_cast<Index>(p))] = parameters[p];
  }
  for (Triangle& triangle : layout.Triangles)
  {
    std::transform(triangle.begin(), triangle.end(), triangle.begin(), numberOf);
  }
  for (Index& origin : layout.Origins)
  {
    origin = this->Triangles[origin];
  }
  std::transform(layout.Corners.begin(), layout.Corners.end(), layout.Corners.begin(), numberOf);
  for (LayoutBorder& border : layout.Borders)
  {
    std::transform(border.Points.begin(), border.Points.end(), border.Points.begin(), numberOf);
  }
  for (std::size_t p = 0; p < domain.Places.size(); ++p)
  {
    domain.Places[p] = p < layout.Corners.size() ? layout.Points[layout.Corners[p]]
                                                 : this->ToGiven(domain.Places[p]);
  }
  return domain;
}
}
