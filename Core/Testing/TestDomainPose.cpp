// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Domains of surfaces that were turned and shuffled.
#include "Search/DomainShell.h"
#include "Search/FindDomain.h"
#include "SegmentSurfaces.h"

#include <Eigen/Eigenvalues>

#include <gtest/gtest.h>

namespace
{
using namespace trivariate;
using Eigen::Vector3d;
using trivariate_testing::Icosphere;
using trivariate_testing::Moved;
using trivariate_testing::Shuffled;
using trivariate_testing::Turned;

// A shape for which several domains are about as good.
SurfaceMesh Branched()
{
  return Moved(Icosphere(4),
    [](const Vector3d& p)
    {
      double radius = 6.0;
      for (const Vector3d& limb :
        { Vector3d(0.6, 0.64, 0.48), Vector3d(-0.8, 0.0, 0.6), Vector3d(0.28, -0.96, 0.0) })
      {
        radius += (7.0 + 3.0 * limb.x()) * std::exp(-9.0 * (p - limb).squaredNorm());
      }
      return Vector3d(radius * p.x(), radius * p.y(), 1.2 * radius * p.z());
    });
}

// Stretched so that the area has equal moments along the axes, along the last one more by a factor.
SurfaceMesh WithEqualMoments(SurfaceMesh mesh, double factor)
{
  for (int round = 0; round < 100; ++round)
  {
    Eigen::Matrix3d moment = Eigen::Matrix3d::Zero();
    Vector3d middle = Vector3d::Zero();
    double area = 0.0;
    for (const bool isFirst : { true, false })
    {
      for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
      {
        const Triangle& c = mesh.Triangles[t];
        const Vector3d centre = (mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0;
        const double weight = mesh.AreaVector(t).norm();
        if (isFirst)
        {
          middle += weight * centre;
          area += weight;
        }
        else
        {
          const Vector3d p = centre - middle / area;
          moment += weight / area * p * p.transpose();
        }
      }
    }
    const Vector3d wanted(1.0, 1.0, std::sqrt(factor));
    const Eigen::Matrix3d stretch =
      Vector3d(10.0 * wanted).asDiagonal() *
      Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moment).operatorInverseSqrt();
    mesh = Moved(mesh, [&](const Vector3d& p) { return Vector3d(stretch * (p - middle / area)); });
  }
  return mesh;
}

// To the last bit, and shells too.
TEST(SegmentDomain, IsTheSameInAnyPoseAndOrder)
{
  const SurfaceMesh branched = Branched();
  const SurfaceMesh core = Moved(Icosphere(3),
    [](const Vector3d& p) { return Vector3d(3.0 * p.x(), 3.2 * p.y(), 3.5 * p.z()); });
  const SegmentDomain still = FindDomain(branched, DomainOptions(), Execution());
  const ShellDomains shell = FindShell(branched, core, DomainOptions(), Execution());
  for (int seed = 1; seed < 4; ++seed)
  {
    const auto move = [seed](const SurfaceMesh& mesh)
    { return Turned(Shuffled(mesh, seed), seed); };
    const SurfaceMesh turnedCore = move(core);
    const SurfaceMesh turned = move(branched);
    const SegmentDomain moved = FindDomain(turned, DomainOptions(), Execution());
    EXPECT_EQ(moved.Cubes.Cubes, still.Cubes.Cubes);
    EXPECT_EQ(moved.Layout.Patches, still.Layout.Patches);
    EXPECT_NEAR(moved.Alignment, still.Alignment, 1e-9);
    for (Index corner = 0; corner < still.Cubes.NumberOfCorners; ++corner)
    {
      for (Index other = 0; other < corner; ++other)
      {
        EXPECT_NEAR((moved.Places[corner] - moved.Places[other]).norm(),
          (still.Places[corner] - still.Places[other]).norm(), 1e-9);
      }
    }
    const ShellDomains movedShell = FindShell(turned, turnedCore, DomainOptions(), Execution());
    EXPECT_NEAR(movedShell.Outer.Alignment, shell.Outer.Alignment, 1e-9);
    EXPECT_NEAR(movedShell.Inner.Alignment, shell.Inner.Alignment, 1e-9);
  }
}

// Where principal axes are not unique too.
TEST(SegmentDomain, IsTheSameInAnyPoseWithEqualMoments)
{
  for (const double factor : { 1.0, 2.0, 0.5 })
  {
    const SurfaceMesh mesh = WithEqualMoments(Branched(), factor);
    const SegmentDomain still = FindDomain(mesh, DomainOptions(), Execution());
    for (int seed = 1; seed < 4; ++seed)
    {
      const SegmentDomain moved =
        FindDomain(Turned(Shuffled(mesh, seed), seed), DomainOptions(), Execution());
      EXPECT_EQ(moved.Cubes.Cubes, still.Cubes.Cubes) << factor;
      EXPECT_NEAR(moved.Alignment, still.Alignment, 1e-9) << factor;
    }
  }
}
}
