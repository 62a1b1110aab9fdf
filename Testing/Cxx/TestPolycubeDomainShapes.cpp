// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Shapes with cavities and with branches, and one of a real-valued volume.
#include "DomainChecks.h"
#include "WarningLog.h"
#include "vtkHydrogenOrbitalSource.h"
#include "vtkSegmentTopology.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkPoints.h"
#include "vtkSMPTools.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace trivariate_testing;

namespace
{
std::vector<double> ValuesOfAll(vtkDataArray* array)
{
  std::vector<double> values;
  for (vtkIdType i = 0; i < array->GetNumberOfValues(); ++i)
  {
    values.push_back(array->GetVariantValue(i).ToDouble());
  }
  return values;
}
}

//------------------------------------------------------------------------------
// An L keeps a branch, so all kinds of trials are made.
TEST(PolycubeDomain, GivesAnLForAnyNumberOfThreads)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(11,
    [](const double* p)
    {
      const bool inside = std::abs(p[0]) < 8.5 && std::abs(p[1]) < 8.5 && std::abs(p[2]) < 4.5;
      return int(inside && (p[0] < 0 || p[1] < 0));
    });
  std::vector<std::vector<double>> results;
  for (const int threads : { 1, 2, 3 })
  {
    vtkSMPTools::Initialize(threads);
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetInputData(surface);
    domain->Update();
    vtkSMPTools::Initialize(0);
    EXPECT_GT(domain->GetPolycube()->GetNumberOfCells(), 7);
    std::vector<double>& values = results.emplace_back();
    vtkDataArray* const arrays[] = { domain->GetPatches()->GetPoints()->GetData(),
      CellArray(domain->GetPatches(), "Patch"), CellArray(domain->GetPatches(), "PatchAxis"),
      domain->GetPolycube()->GetPoints()->GetData(),
      CellArray(domain->GetPolycube(), "Alignment") };
    for (vtkDataArray* array : arrays)
    {
      const std::vector<double> own = ValuesOfAll(array);
      values.insert(values.end(), own.begin(), own.end());
    }
    EXPECT_EQ(values, results.front()) << threads << " threads";
  }
}

//------------------------------------------------------------------------------
// Square bars bent through a quarter and half a turn, as voxels turned against them see them.
TEST(PolycubeDomain, FindsOneCubeInABentBar)
{
  for (const double angle : { 0.5 * vtkMath::Pi(), vtkMath::Pi() })
  {
    for (const double turn : { 0.0, 0.35 })
    {
      const vtkNew<vtkPolyData> surface = SurfaceOf(28,
        [&](const double* p)
        {
          const double y = p[1] * std::cos(turn) - p[2] * std::sin(turn);
          const double z = p[1] * std::sin(turn) + p[2] * std::cos(turn);
          const double r = std::hypot(p[0], y), a = std::atan2(y, p[0]);
          return int(r > 12.2 && r < 24.7 && a > 0.02 && a < angle - 0.02 && std::abs(z) < 6.4);
        });
      vtkNew<vtkPolycubeDomain> domain;
      domain->SetInputData(surface);
      domain->Update();
      ExpectSound(domain, surface, { 1 });
      EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 7) << angle << ", " << turn;
      EXPECT_GT(CellArray(domain->GetPolycube(), "Alignment")->GetComponent(0, 0), 0.94);
    }
  }
}

//------------------------------------------------------------------------------
// A torus away from the origin: the shortest loop goes around its tube.
TEST(PolycubeDomain, SaysWhereAHandleIs)
{
  const auto fromRing = [](const double* p)
  { return std::hypot(std::hypot(p[0], p[1]) - 13.0, p[2]); };
  const vtkNew<vtkPolyData> surface =
    SurfaceOf(20, [&fromRing](const double* p) { return int(fromRing(p) < 5.0); });
  vtkNew<vtkPoints> points; // turned about x, and far away
  points->SetDataTypeToDouble();
  for (vtkIdType id = 0; id < surface->GetNumberOfPoints(); ++id)
  {
    const double* p = surface->GetPoint(id);
    points->InsertNextPoint(p[0] + 30.0, 0.6 * p[1] - 0.8 * p[2] - 50.0, 0.8 * p[1] + 0.6 * p[2]);
  }
  surface->SetPoints(points);
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetMostCubes(7); // around a hole there are eight
  ErrorLog log(domain);
  domain->Update();
  const std::string error = log.TakeOnly();
  EXPECT_NE(error.find("Segment 1: Its surface has 1 handle "), std::string::npos) << error;
  EXPECT_EQ(error.find("ut or close"), error.rfind("ut or close")) << "twice: " << error;
  const auto at = error.find("A loop around a handle, ");
  ASSERT_NE(at, std::string::npos) << error;
  double length = 0.0, x = 0.0, y = 0.0, z = 0.0;
  ASSERT_EQ(std::sscanf(error.c_str() + at,
              "A loop around a handle, %lf long, passes (%lf, %lf, %lf)", &length, &x, &y, &z),
    4)
    << error;
  EXPECT_NEAR(length, 2.0 * vtkMath::Pi() * 5.0, 0.15 * 2.0 * vtkMath::Pi() * 5.0);
  const double back[] = { x - 30.0, 0.6 * (y + 50.0) + 0.8 * z, 0.6 * z - 0.8 * (y + 50.0) };
  EXPECT_NEAR(fromRing(back), 5.0, 0.8) << error;
}

//------------------------------------------------------------------------------
// A corner on the other side of the hole leaves the borders of others in the way.
TEST(PolycubeDomain, NamesCornersWithoutAPath)
{
  const vtkNew<vtkPolyData> torus = SurfaceOf(
    22, [](const double* p) { return int(std::hypot(std::hypot(p[0], p[1]) - 14.0, p[2]) < 6.0); });
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(torus);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(3, 3, 1);
  domain->AddSwitchedOffCube(4);
  domain->SetSnapLimit(1.0);
  const auto pick = [&domain](double turned)
  {
    domain->ClearCornerPositions();
    for (int i = 0; i < 32; ++i)
    {
      const double x = i % 4 - 1.5, y = i / 4 % 4 - 1.5;
      const bool inner = std::abs(x) < 1.0 && std::abs(y) < 1.0;
      const double angle = std::atan2(y, x) + (i == 0 ? turned : 0.0);
      const double radius = inner ? 9.8 : 18.2;
      domain->AddCornerPosition(
        radius * std::cos(angle), radius * std::sin(angle), i < 16 ? -4.2 : 4.2);
    }
  };
  pick(0.0);
  domain->Update();
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 8 + 32);
  ErrorLog log(domain);
  pick(0.9 * vtkMath::Pi());
  ExpectFault(domain, log, "Segment 1: From corner ");
  ExpectFault(domain, log, "There is no path: other borders lie between its ends.");
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, SaysWhyCavitiesAreNotShared)
{
  const auto isIn = [](const double* p, double x, double radius)
  { return std::hypot(p[0] - x, p[1], p[2]) < radius; };
  const vtkNew<vtkPolyData> cheese = SurfaceOf(12, [&](const double* p)
    { return BoxLabel(p, 10, 6, 6) && !isIn(p, -5.0, 2.5) && !isIn(p, 5.0, 2.5) ? 1 : 0; });
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(cheese);
  ErrorLog log(domain);
  ExpectFault(domain, log, "Segment 1: Its surface has 3 pieces, 2 of them around cavities");

  const vtkNew<vtkPolyData> neighbours = SurfaceOf(12,
    [&](const double* p) {
      return !BoxLabel(p, 10, 6, 6) || isIn(p, 5.0, 2.5) ? 0 : p[0] < 0.0 ? 1 : 2;
    });
  vtkNew<vtkPolycubeDomain> two;
  two->SetInputData(neighbours);
  const WarningLog warnings(two);
  two->Update();
  ExpectSound(two, neighbours, { 1, 2 });
  EXPECT_TRUE(warnings.Says(
    "Segments 1 and 2 touch but have separate domains there: one of them has a cavity."))
    << warnings.Text;
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, TakesTheEdgesOfACylinderByHand)
{
  const double radius = 7.5, half = 8.5;
  const vtkNew<vtkPolyData> surface = SurfaceOf(11,
    [&](const double* p) { return int(std::hypot(p[0], p[1]) < radius && std::abs(p[2]) < half); });
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->SetModeToManual();
  domain->SetNumberOfCubes(1, 1, 1);
  std::vector<Place> corners;
  for (int i = 0; i < 8; ++i)
  {
    const double side = radius * std::sqrt(0.5);
    corners.push_back({ i & 1 ? side : -side, i & 2 ? side : -side, i & 4 ? half : -half });
    domain->AddCornerPosition(corners.back().data());
  }
  domain->Update();
  ExpectSound(domain, surface, { 1 });
  EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), 7);
  EXPECT_LT(domain->GetPolycube()->GetPointData()->GetArray("SnapDistance")->GetRange()[1], 0.8);
  EXPECT_GT(CellArray(domain->GetPolycube(), "Alignment")->GetComponent(0, 0), 0.84);
}

//------------------------------------------------------------------------------
// A density of real numbers, at five thresholds.
TEST(PolycubeDomain, FindsDomainsOfAnOrbital)
{
  vtkNew<vtkHydrogenOrbitalSource> orbital;
  orbital->SetDimensions(48, 48, 48);
  orbital->Update();
  vtkImageData* density = orbital->GetOutput();
  vtkDataArray* values = density->GetPointData()->GetScalars();
  ASSERT_NE(values, nullptr);
  for (const double share : { 0.02, 0.05, 0.1, 0.2, 0.4 })
  {
    vtkNew<vtkIntArray> labels;
    labels->SetName("Segment");
    for (vtkIdType i = 0; i < values->GetNumberOfTuples(); ++i)
    {
      labels->InsertNextValue(values->GetComponent(i, 0) > share * values->GetRange()[1] ? 1 : 0);
    }
    vtkNew<vtkImageData> image;
    image->ShallowCopy(density);
    image->GetPointData()->AddArray(labels);
    vtkNew<vtkSegmentTopology> whole;
    whole->SetInputData(image);
    vtkNew<vtkSegmentBoundary> boundary;
    boundary->SetInputConnection(whole->GetOutputPort());
    boundary->UseDensityOff(); // its level is half-way between materials, not the threshold
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetInputConnection(boundary->GetOutputPort());
    domain->Update();
    ExpectSound(domain, boundary->GetOutput(), { 1 });
    ASSERT_GT(domain->GetPolycube()->GetNumberOfCells(), 0) << share;
    EXPECT_GT(CellArray(domain->GetPolycube(), "Alignment")->GetComponent(0, 0), 0.77) << share;
  }
}
