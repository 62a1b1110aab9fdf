// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ContactPatch.h"

#include "InnerPath.h"
#include "TriangleTree.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector3i;

constexpr double FreeEdges = 3.0; // other corners stay so far from a disc, in mean edges
constexpr double Infinity = std::numeric_limits<double>::infinity();

Index Modulo4(Index k)
{
  return (k % 4 + 4) % 4;
}

Vector3i VectorOf(const LatticePoint& point)
{
  return { point[0], point[1], point[2] };
}

// Two edges of a face and its outward normal, as columns.
Eigen::Matrix3i FrameOf(const Polycube& cubes, const Polycube::Face& face, Index from, bool onward)
{
  const auto corner = [&](Index k) { return VectorOf(cubes.Points[face.Corners[Modulo4(k)]]); };
  Eigen::Matrix3i frame;
  frame.col(0) = corner(onward ? from + 1 : from - 1) - corner(from);
  frame.col(1) = corner(onward ? from - 1 : from + 1) - corner(from);
  frame.col(2) = (face.Side ? 1 : -1) * Vector3i::Unit(face.Axis);
  return frame;
}

// The mean edge of what the domain is laid out on, and its triangles far from all discs.
std::vector<Triangle> FreeTriangles(
  const SurfaceMesh& mesh, const std::vector<ContactPatch>& contacts, double distance)
{
  std::vector<Triangle> covered;
  for (const ContactPatch& contact : contacts)
  {
    for (const Index t : contact.Triangles)
    {
      covered.push_back(mesh.Triangles[t]);
    }
  }
  const TriangleTree tree(mesh.Points, covered);
  std::vector<char> free(mesh.Points.size());
  std::transform(mesh.Points.begin(), mesh.Points.end(), free.begin(),
    [&](const Vector3d& p) { return tree.Nearest(p).Distance > distance; });
  std::vector<Triangle> triangles;
  std::copy_if(mesh.Triangles.begin(), mesh.Triangles.end(), std::back_inserter(triangles),
    [&free](const Triangle& c) { return free[c[0]] && free[c[1]] && free[c[2]]; });
  return triangles;
}

// The outline of a disc from each corner of its face to the next, as borders of the polycube.
void AddBorders(const Polycube& cubes, const Polycube::Face& face,
  const std::vector<Index>& outline, const std::array<Index, 4>& places,
  std::vector<GivenBorder>& given)
{
  const Index n = static_cast<Index>(outline.size());
  for (int k = 0; k < 4; ++k)
  {
    const Index from = face.Corners[k], to = face.Corners[(k + 1) % 4];
    std::vector<Index> points(1, outline[places[k]]);
    for (Index i = places[k]; i != places[(k + 1) % 4];)
    {
      i = (i + 1) % n;
      points.push_back(outline[i]);
    }
    const auto edge = std::find_if(cubes.Edges.begin(), cubes.Edges.end(),
      [from, to](const Polycube::Edge& e)
      { return std::minmax(e.From, e.To) == std::minmax(from, to); });
    if (edge->From == to)
    {
      std::reverse(points.begin(), points.end());
    }
    given.push_back({ edge - cubes.Edges.begin(), std::move(points) });
  }
}
}

//------------------------------------------------------------------------------
std::vector<Index> OutlineOfDisc(const SurfaceMesh& mesh, const std::vector<Index>& triangles)
{
  const std::set<Index> inside(triangles.begin(), triangles.end());
  std::map<Index, Index> next;
  std::set<Index> points;
  Index doubledEdges = 0, outlineEdges = 0;
  for (const Index t : inside)
  {
    const Triangle& c = mesh.Triangles[t];
    points.insert(c.begin(), c.end());
    for (int k = 0; k < 3; ++k)
    {
      const bool inner = inside.count(mesh.Neighbour(t, k)) > 0;
      doubledEdges += inner ? 1 : 2;
      if (!inner)
      {
        ++outlineEdges;
        next[c[k]] = c[(k + 1) % 3];
      }
    }
  }
  std::vector<Index> outline;
  if (!next.empty())
  {
    const Index start = next.begin()->first;
    Index point = start;
    do
    {
      outline.push_back(point);
      const auto found = next.find(point);
      point = found == next.end() ? start : found->second;
    } while (point != start && static_cast<Index>(outline.size()) <= outlineEdges);
  }
  const Index euler =
    static_cast<Index>(points.size()) - doubledEdges / 2 + static_cast<Index>(inside.size());
  if (outline.empty() || static_cast<Index>(outline.size()) != outlineEdges || euler != 1)
  {
    throw std::invalid_argument("the common surface is no disc");
  }
  return outline;
}

//------------------------------------------------------------------------------
FaceMatch FaceOver(const SegmentDomain& domain, const std::vector<Index>& triangles)
{
  const std::set<Index> inside(triangles.begin(), triangles.end());
  const SurfaceLayout& layout = domain.Layout;
  std::vector<double> area(layout.PatchLabels.size(), 0.0), common = area;
  double disc = 0.0;
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Triangle& c = layout.Triangles[t];
    const Vector3d& a = layout.Points[c[0]];
    const double own = (layout.Points[c[1]] - a).cross(layout.Points[c[2]] - a).norm();
    area[layout.Patches[t]] += own;
    if (inside.count(layout.Origins[t]) > 0)
    {
      common[layout.Patches[t]] += own;
      disc += own;
    }
  }
  FaceMatch best{ 0, -1.0 };
  for (std::size_t face = 0; face < area.size(); ++face)
  {
    const double overlap = common[face] / (area[face] + disc - common[face]);
    if (overlap > best.Overlap)
    {
      best = { static_cast<Index>(face), overlap };
    }
  }
  return best;
}

//------------------------------------------------------------------------------
LatticePoint LatticeMotion::operator()(const LatticePoint& point) const
{
  const Vector3i moved = this->Turn * VectorOf(point) + this->Shift;
  return { moved[0], moved[1], moved[2] };
}

LatticePoint LatticeMotion::OfCube(const LatticePoint& low) const
{
  const LatticePoint a = (*this)(low), b = (*this)({ low[0] + 1, low[1] + 1, low[2] + 1 });
  return { std::min(a[0], b[0]), std::min(a[1], b[1]), std::min(a[2], b[2]) };
}

//------------------------------------------------------------------------------
CommonCorners MeetCorners(const std::vector<Vector3d>& outline,
  const std::array<Vector3d, 4>& first, const std::array<Vector3d, 4>& second)
{
  const Index n = static_cast<Index>(outline.size());
  CommonCorners best{ {}, 0 };
  double least = Infinity;
  for (Index shift = 0; shift < 4; ++shift)
  {
    // Which corner comes first along the outline; then each next one after the one before it.
    for (Index lead = 0; lead < 4; ++lead)
    {
      std::array<std::vector<double>, 4> sums;
      std::array<std::vector<Index>, 4> chosen; // the best place up to each
      for (Index j = 0; j < 4; ++j)
      {
        const Index k = (lead + j) % 4;
        sums[j].assign(n, Infinity);
        chosen[j].assign(n, -1);
        for (Index i = j; i < n; ++i)
        {
          const double before = j == 0 ? 0.0 : sums[j - 1][i - 1];
          const double own = (outline[i] - first[k]).squaredNorm() +
                             (outline[i] - second[Modulo4(shift - k)]).squaredNorm();
          const bool here = i == j || before + own < sums[j][i - 1];
          sums[j][i] = here ? before + own : sums[j][i - 1];
          chosen[j][i] = here ? i : chosen[j][i - 1];
        }
      }
      if (n >= 4 && sums[3].back() < least)
      {
        least = sums[3].back();
        best.Shift = shift;
        Index last = n - 1;
        for (Index j = 3; j >= 0; --j)
        {
          const Index place = chosen[j][last];
          best.Places[(lead + j) % 4] = place;
          last = place - 1;
        }
      }
    }
  }
  if (least == Infinity)
  {
    throw std::invalid_argument(
      "the common surface has only " + std::to_string(n) + " points around it");
  }
  return best;
}

//------------------------------------------------------------------------------
LatticeMotion MotionOnto(
  const Polycube& first, Index firstFace, const Polycube& second, Index secondFace, Index shift)
{
  const Polycube::Face &to = first.Faces[firstFace], &from = second.Faces[secondFace];
  Eigen::Matrix3i target = FrameOf(first, to, 0, true);
  target.col(2) *= -1;
  LatticeMotion motion;
  // Columns are unit vectors: the transpose is the inverse.
  motion.Turn = target * FrameOf(second, from, shift, false).transpose();
  motion.Shift = VectorOf(first.Points[to.Corners[0]]) -
                 motion.Turn * VectorOf(second.Points[from.Corners[Modulo4(shift)]]);
  return motion;
}

//------------------------------------------------------------------------------
ContactDomain DomainWithContacts(const SurfaceMesh& mesh, const SegmentDomain& domain,
  const LatticeMotion& motion, const std::vector<ContactPatch>& contacts,
  const Execution& execution)
{
  std::vector<LatticePoint> lows;
  for (const LatticePoint& low : domain.Cubes.Cubes)
  {
    lows.push_back(motion.OfCube(low));
  }
  const Polycube cubes(lows);
  std::map<LatticePoint, Index> number;
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    number[cubes.Points[corner]] = corner;
  }
  std::vector<Vector3d> places(cubes.NumberOfCorners);
  std::vector<Index> moved;
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    moved.push_back(number.at(motion(domain.Cubes.Points[corner])));
    places[moved.back()] = domain.Places[corner];
  }

  std::vector<Index> faces;
  std::vector<GivenBorder> given;
  std::vector<char> onDisc(places.size(), 0);
  for (const ContactPatch& contact : contacts)
  {
    const Polycube::Face& before = domain.Cubes.Faces[contact.Face];
    std::set<Index> corners;
    for (const Index corner : before.Corners)
    {
      corners.insert(moved[corner]);
    }
    const auto face = std::find_if(cubes.Faces.begin(), cubes.Faces.end(),
      [&corners](const Polycube::Face& candidate)
      { return std::set<Index>(candidate.Corners.begin(), candidate.Corners.end()) == corners; });
    faces.push_back(face - cubes.Faces.begin());
    std::array<Index, 4> at{};
    for (int k = 0; k < 4; ++k)
    {
      const Index corner = moved[before.Corners[k]];
      at[std::find(face->Corners.begin(), face->Corners.end(), corner) - face->Corners.begin()] =
        contact.Corners[k];
      places[corner] = mesh.Points[contact.Outline[contact.Corners[k]]];
      onDisc[corner] = 1;
    }
    AddBorders(cubes, *face, contact.Outline, at, given);
  }

  const std::vector<Triangle> free =
    FreeTriangles(mesh, contacts, FreeEdges * MeanEdge(domain.Layout));
  if (free.empty())
  {
    throw std::runtime_error("there is no surface beside the common one");
  }
  const TriangleTree tree(mesh.Points, free);
  for (std::size_t corner = 0; corner < places.size(); ++corner)
  {
    places[corner] = onDisc[corner] ? places[corner] : tree.Nearest(places[corner]).Place;
  }
  return { DomainFromCorners(mesh, cubes, places, execution, Infinity, given), std::move(faces) };
}

//------------------------------------------------------------------------------
std::vector<std::string> CheckContact(
  const SegmentDomain& first, Index firstFace, const SegmentDomain& second, Index secondFace)
{
  std::vector<std::string> messages;
  const std::string names =
    "Patches " + std::to_string(firstFace) + " and " + std::to_string(secondFace) + " ";
  const Polycube::Face& a = first.Cubes.Faces[firstFace];
  const Polycube::Face& b = second.Cubes.Faces[secondFace];
  if (a.Axis != b.Axis || a.Side == b.Side)
  {
    messages.push_back(names + "do not face each other along one axis.");
  }
  for (const Index corner : a.Corners)
  {
    const bool found = std::any_of(b.Corners.begin(), b.Corners.end(),
      [&](Index other)
      {
        return first.Places[corner] == second.Places[other] &&
               first.Cubes.Points[corner] == second.Cubes.Points[other];
      });
    if (!found)
    {
      messages.push_back(names + "do not share corner " + std::to_string(corner) + " at " +
                         NameOf(first.Cubes.Points[corner]) + ".");
    }
  }
  using Place = std::array<double, 3>;
  const auto trianglesOf = [](const SurfaceLayout& layout, Index patch)
  {
    std::multiset<std::array<Place, 3>> triangles;
    for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
    {
      if (layout.Patches[t] == patch)
      {
        std::array<Place, 3> places;
        for (int k = 0; k < 3; ++k)
        {
          const Vector3d& p = layout.Points[layout.Triangles[t][k]];
          places[k] = { p[0], p[1], p[2] };
        }
        std::sort(places.begin(), places.end());
        triangles.insert(places);
      }
    }
    return triangles;
  };
  if (trianglesOf(first.Layout, firstFace) != trianglesOf(second.Layout, secondFace))
  {
    messages.push_back(names + "are not the same triangles.");
  }
  return messages;
}
}
