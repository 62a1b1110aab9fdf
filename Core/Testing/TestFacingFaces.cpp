// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Parameter/BlockCells.h"
#include "Parameter/BlockMeshing.h"
#include "Parameter/FacingFaces.h"
#include "Search/FindDomain.h"
#include "SegmentSurfaces.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace trivariate;
using namespace trivariate_testing;

namespace
{
// A ball of radius 10 with a limb.
BlockDomain BallWithLimb(double height, double sharpness)
{
  const SurfaceMesh surface = Moved(Icosphere(5),
    [height, sharpness](const Vector3d& p)
    {
      const double limb = std::exp(-sharpness * (p - Vector3d(0.6, 0.64, 0.48)).squaredNorm());
      return Vector3d((10.0 + height * limb) * p);
    });
  const SegmentDomain ball = FindDomain(surface, DomainOptions(), Execution());
  return DomainOfSegment(LayeredBlocks(ball, 2.5, Execution()), ball);
}

// What the faces of a mesh lack, and what they would from the other side.
std::array<double, 2> Lacks(const BlockDomain& domain, BlockMesh mesh)
{
  const DomainSurface surface(domain, 1.0);
  const SlidingNodes sliding(surface, mesh, 0.5, Execution());
  std::vector<Vector3d> targets = CellTargets(mesh);
  const double right = FacingFaces(sliding, mesh, targets).Energy(mesh.Places, sliding);
  for (Vector3d& lengths : targets)
  {
    lengths = { -lengths[1], lengths[0], lengths[2] };
  }
  return { right, FacingFaces(sliding, mesh, targets).Energy(mesh.Places, sliding) };
}
}

//------------------------------------------------------------------------------
TEST(FacingFaces, LackNothingOnABallButFromWithin)
{
  const BlockDomain domain = BallWithLimb(0.0, 1.0);
  BlockMeshOptions options;
  options.CellsPerBlock = 4;
  const BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
  const auto [right, wrong] = Lacks(domain, mesh);
  EXPECT_EQ(right, 0.0);
  EXPECT_GT(wrong, 50.0);
}

TEST(FacingFaces, HaveTermsThatTellWhatAMoveChanges)
{
  const BlockDomain domain = BallWithLimb(5.0, 40.0);
  BlockMeshOptions options;
  options.CellsPerBlock = 3;
  options.Freedom = 20.0; // for the turned faces, below
  BlockMesh mesh = MakeBlockMesh(domain, options, Execution());
  const DomainSurface surface(domain, 1.0);
  const SlidingNodes sliding(surface, mesh, options.Freedom, Execution());
  for (Vector3d& place : mesh.Places)
  {
    place[0] *= -1.0;
  }
  const FacingFaces faces(sliding, mesh, CellTargets(mesh));
  const Vector3d d(0.3, -0.2, 0.5);
  std::vector<FacingFaces::Term> terms;
  int tested = 0;
  for (const PatchFace& face : PatchFaces(domain, mesh))
  {
    for (const Index node : face.Nodes)
    {
      const double before = faces.Energy(mesh.Places, sliding);
      faces.TermsOf(node, mesh.Places, sliding, terms);
      double change = 0.0;
      for (const FacingFaces::Term& term : terms)
      {
        change += std::pow(term.LackAt(d), 2) - std::pow(term.LackAt(Vector3d::Zero()), 2);
      }
      const Vector3d place = mesh.Places[node];
      mesh.Places[node] += d;
      EXPECT_NEAR(faces.Energy(mesh.Places, sliding) - before, change, 1e-9 * before);
      mesh.Places[node] = place;
      tested += std::abs(change) > 0.01;
    }
  }
  EXPECT_GT(tested, 50);
}

TEST(FacingFaces, HaveNoPleatsAtTheFootOfALimb)
{
  const BlockDomain domain = BallWithLimb(10.0, 80.0);
  double pleated = 0.0, smooth = 0.0;
  for (const double length : { 1.7, 2.0, 2.5 })
  {
    BlockMeshOptions options;
    options.CellLength = length;
    options.Freedom = 0.5;
    options.Repair.Patience = 6;
    pleated += Lacks(domain, MakeBlockMesh(domain, options, Execution()))[0];
    options.Repair.Facing = 10.0;
    BlockMeshReport report;
    smooth += Lacks(domain, MakeBlockMesh(domain, options, Execution(), &report))[0];
    EXPECT_EQ(report.End.Inverted, 0);
  }
  EXPECT_LT(smooth, 0.1 * pleated);
  EXPECT_GT(pleated, 1.0);
}
