// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Domain/ContactPatch.h"
#include "Domain/LayoutCheck.h"
#include "LayoutSurfaces.h"
#include "Search/FindDomain.h"

#include <Eigen/LU>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>

using namespace trivariate;
using namespace trivariate_testing;

namespace
{
std::vector<Index> TrianglesWhere(
  const SurfaceMesh& mesh, const std::function<bool(const Point&)>& inside)
{
  std::vector<Index> triangles;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Triangle& c = mesh.Triangles[t];
    if (inside((mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0))
    {
      triangles.push_back(t);
    }
  }
  return triangles;
}

// A unit cube as it is, a box of 4 x 2 x 3 with corner 0 at `low`.
SurfaceMesh Box(const Point& low)
{
  return Moved(SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 12),
    [&low](const Point& p) { return Point(low + p.cwiseProduct(Point(4.0, 2.0, 3.0))); });
}

std::string Joined(const std::vector<std::string>& messages)
{
  std::string all;
  for (const std::string& message : messages)
  {
    all += message + "\n";
  }
  return all;
}
}

//------------------------------------------------------------------------------
TEST(ContactPatch, GoesAroundDiscsOnly)
{
  const SurfaceMesh cube = SurfaceOf(Polycube::FromGrid({ 1, 1, 1 }), 4);
  const auto top = TrianglesWhere(cube, [](const Point& p) { return p.z() > 0.999; });
  const std::vector<Index> outline = OutlineOfDisc(cube, top);
  ASSERT_EQ(outline.size(), 16u);
  EXPECT_EQ(outline.front(), *std::min_element(outline.begin(), outline.end()));
  double area = 0.0; // anticlockwise seen from above
  for (std::size_t i = 0; i < outline.size(); ++i)
  {
    const Point &a = cube.Points[outline[i]], &b = cube.Points[outline[(i + 1) % 16]];
    EXPECT_NEAR((a - b).norm(), 0.25, 1e-12);
    area += 0.5 * (a.x() * b.y() - a.y() * b.x());
  }
  EXPECT_NEAR(area, 1.0, 1e-12);

  const auto ring = TrianglesWhere(cube, [](const Point& p) { return p.z() > 0.3 && p.z() < 0.7; });
  const auto two =
    TrianglesWhere(cube, [](const Point& p) { return p.z() > 0.999 || p.z() < 0.001; });
  const auto touching = TrianglesWhere(
    cube, [](const Point& p) { return p.z() > 0.999 && (p.x() < 0.5) == (p.y() < 0.5); });
  const auto all = TrianglesWhere(cube, [](const Point&) { return true; });
  for (const std::vector<Index>& triangles : { ring, two, touching, all, std::vector<Index>() })
  {
    EXPECT_THROW(OutlineOfDisc(cube, triangles), std::invalid_argument) << triangles.size();
  }
}

TEST(ContactPatch, FindsTheFaceThatCoversADiscBest)
{
  const SurfaceMesh box = Box({ 0, 0, 0 });
  const SegmentDomain domain = FindDomain(box, DomainOptions(), Execution());
  for (int axis = 0; axis < 3; ++axis)
  {
    const double high = Point(4.0, 2.0, 3.0)[axis];
    const FaceMatch whole =
      FaceOver(domain, TrianglesWhere(box, [&](const Point& p) { return p[axis] > high - 1e-6; }));
    EXPECT_NEAR(whole.Overlap, 1.0, 1e-9);
    const FaceMatch half = FaceOver(domain, TrianglesWhere(box,
                                              [&](const Point& p)
                                              {
                                                const int other = (axis + 1) % 3;
                                                return p[axis] > high - 1e-6 &&
                                                       p[other] < 0.5 * Point(4.0, 2.0, 3.0)[other];
                                              }));
    EXPECT_EQ(half.Face, whole.Face);
    EXPECT_NEAR(half.Overlap, 0.5, 0.05);
  }
}

TEST(ContactPatch, MeetsInCornersBetweenThoseOfBothFaces)
{
  std::vector<Point> circle;
  const auto at = [](double degrees)
  { return Point(std::cos(degrees * M_PI / 180.0), std::sin(degrees * M_PI / 180.0), 0.0); };
  for (int i = 0; i < 360; ++i)
  {
    circle.push_back(at(i));
  }
  for (const double start : { 10.0, 100.0, 300.0 })
  {
    // The second one's corners go the other way round, 20 degrees farther, and begin elsewhere.
    std::array<Point, 4> first, second;
    for (int k = 0; k < 4; ++k)
    {
      first[k] = 1.5 * at(start + 90.0 * k);
      second[k] = 1.5 * at(start + 20.0 + 90.0 * (3 - k));
    }
    const CommonCorners common = MeetCorners(circle, first, second);
    EXPECT_EQ(common.Shift, 3);
    for (int k = 0; k < 4; ++k)
    {
      EXPECT_EQ(common.Places[k] % 360, int(start + 10.0 + 90.0 * k) % 360);
    }
  }
  circle.resize(3);
  EXPECT_THROW(MeetCorners(circle, {}, {}), std::invalid_argument);
}

// Each face of one cube against each face of another, in all four ways.
TEST(ContactPatch, MovesCubesFaceToFace)
{
  const Polycube cube({ { 2, 0, 1 } });
  for (Index first = 0; first < 6; ++first)
  {
    for (Index second = 0; second < 6; ++second)
    {
      for (Index shift = 0; shift < 4; ++shift)
      {
        const LatticeMotion motion = MotionOnto(cube, first, cube, second, shift);
        EXPECT_NEAR(motion.Turn.cast<double>().determinant(), 1.0, 1e-12);
        LatticePoint neighbour = cube.Cubes[0];
        neighbour[first / 2] += first % 2 ? 1 : -1;
        EXPECT_EQ(motion.OfCube(cube.Cubes[0]), neighbour);
        for (Index k = 0; k < 4; ++k)
        {
          EXPECT_EQ(motion(cube.Points[cube.Faces[second].Corners[(shift - k + 4) % 4]]),
            cube.Points[cube.Faces[first].Corners[k]]);
        }
      }
    }
  }
}

//------------------------------------------------------------------------------
TEST(ContactPatch, IsSharedByTwoBoxes)
{
  const SurfaceMesh left = Box({ 0, 0, 0 }), right = Box({ 4, 0, 0 });
  const SegmentDomain a = FindDomain(left, DomainOptions(), Execution());
  const SegmentDomain b = FindDomain(right, DomainOptions(), Execution());
  const auto common = [](const Point& p) { return std::abs(p.x() - 4.0) < 1e-6; };
  const std::vector<Index> onLeft = TrianglesWhere(left, common),
                           onRight = TrianglesWhere(right, common);
  const std::vector<Index> leftOutline = OutlineOfDisc(left, onLeft);
  std::vector<Index> rightOutline;
  std::vector<Point> outline;
  for (const Index p : leftOutline)
  {
    outline.push_back(left.Points[p]);
    const auto twin = std::find_if(right.Points.begin(), right.Points.end(),
      [&](const Point& q) { return (q - left.Points[p]).norm() < 1e-9; });
    rightOutline.insert(rightOutline.begin(), twin - right.Points.begin());
  }
  const Index faceA = FaceOver(a, onLeft).Face, faceB = FaceOver(b, onRight).Face;
  const auto cornersOf = [](const SegmentDomain& domain, Index face)
  {
    std::array<Point, 4> corners;
    for (int k = 0; k < 4; ++k)
    {
      corners[k] = domain.Places[domain.Cubes.Faces[face].Corners[k]];
    }
    return corners;
  };
  const CommonCorners corners = MeetCorners(outline, cornersOf(a, faceA), cornersOf(b, faceB));
  std::array<Index, 4> placesB;
  for (Index k = 0; k < 4; ++k)
  {
    placesB[(corners.Shift - k + 4) % 4] = Index(outline.size()) - 1 - corners.Places[k];
  }
  const ContactDomain first = DomainWithContacts(
    left, a, {}, { { faceA, onLeft, leftOutline, corners.Places } }, Execution());
  const ContactDomain second =
    DomainWithContacts(right, b, MotionOnto(a.Cubes, faceA, b.Cubes, faceB, corners.Shift),
      { { faceB, onRight, rightOutline, placesB } }, Execution());
  for (const ContactDomain* domain : { &first, &second })
  {
    EXPECT_EQ(Joined(CheckLayout(domain->Domain.Layout, domain->Domain.Cubes)), "");
    EXPECT_NEAR(domain->Domain.Alignment, 1.0, 1e-9);
  }
  const auto check = [&](const ContactDomain& c, const ContactDomain& d)
  { return Joined(CheckContact(c.Domain, c.Faces[0], d.Domain, d.Faces[0])); };
  // Both boxes were made alike: only to rounding does the right one's face equal the left one's.
  ContactDomain moved = second;
  for (Point& p : moved.Domain.Layout.Points)
  {
    const auto twin = std::find_if(left.Points.begin(), left.Points.end(),
      [&p](const Point& q) { return (p - q).norm() < 1e-9; });
    p = twin == left.Points.end() ? p : *twin;
  }
  for (Index corner = 0; corner < 8; ++corner)
  {
    moved.Domain.Places[corner] = moved.Domain.Layout.Points[moved.Domain.Layout.Corners[corner]];
  }
  EXPECT_EQ(check(first, moved), "");

  // And what is wrong is told.
  ContactDomain wrong = moved;
  wrong.Faces[0] = moved.Faces[0] ^ 1;
  EXPECT_NE(check(first, wrong), "");
  wrong = moved;
  wrong.Domain.Cubes.Points[wrong.Domain.Cubes.Faces[wrong.Faces[0]].Corners[2]][1] += 5;
  EXPECT_NE(check(first, wrong).find("do not share corner"), std::string::npos);
  wrong = moved;
  wrong.Domain.Cubes.Faces[wrong.Faces[0]].Side ^= 1;
  EXPECT_NE(check(first, wrong).find("face each other"), std::string::npos);
  wrong = moved;
  for (Index& patch : wrong.Domain.Layout.Patches)
  {
    if (patch == moved.Faces[0])
    {
      patch ^= 1;
      break;
    }
  }
  EXPECT_NE(check(first, wrong).find("not the same triangles"), std::string::npos);
}

// A disc much larger than the face that is to cover it, with corners of the cube in it.
TEST(ContactPatch, KeepsOtherCornersOutside)
{
  const SurfaceMesh ball = Icosphere(4);
  const SegmentDomain domain = FindDomain(ball, DomainOptions(), Execution());
  for (const double height : { -0.5, 0.0, 0.8 })
  {
    const std::vector<Index> cap =
      TrianglesWhere(ball, [height](const Point& p) { return p.z() > height; });
    const std::vector<Index> outline = OutlineOfDisc(ball, cap);
    std::vector<Point> places;
    for (const Index p : outline)
    {
      places.push_back(ball.Points[p]);
    }
    const Index face = FaceOver(domain, cap).Face;
    std::array<Point, 4> corners, other;
    for (int k = 0; k < 4; ++k)
    {
      corners[k] = domain.Places[domain.Cubes.Faces[face].Corners[k]];
      other[3 - k] = corners[k];
    }
    const ContactDomain found = DomainWithContacts(ball, domain, {},
      { { face, cap, outline, MeetCorners(places, corners, other).Places } }, Execution());
    EXPECT_EQ(Joined(CheckLayout(found.Domain.Layout, found.Domain.Cubes)), "") << height;
    const SurfaceLayout& layout = found.Domain.Layout;
    for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
    {
      EXPECT_EQ(layout.Patches[t] == found.Faces[0],
        std::binary_search(cap.begin(), cap.end(), layout.Origins[t]));
    }
  }
}
