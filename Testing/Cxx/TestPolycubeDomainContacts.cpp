// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Segments that touch, one not around the other: what both have in common.
#include "DomainChecks.h"
#include "WarningLog.h"

using namespace trivariate_testing;

namespace
{
int IntegerAt(vtkDataSetAttributes* data, const char* name, vtkIdType id, int component = 0)
{
  return static_cast<int>(data->GetArray(name)->GetComponent(id, component));
}

struct Common
{
  std::set<vtkIdType> Points;
  std::set<int> Patches, Corners;
};

// What both segments have in the first output; their axes must be one and their sides two there.
Common CommonOf(vtkPolyData* patches, int a, int b)
{
  std::map<int, std::set<std::array<int, 3>>> owners;
  std::map<int, std::set<vtkIdType>> points;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < patches->GetNumberOfCells(); ++cell)
  {
    vtkCellData* data = patches->GetCellData();
    const int segment = IntegerAt(data, "Segment", cell);
    owners[IntegerAt(data, "Patch", cell)].insert(
      { segment, IntegerAt(data, "PatchAxis", cell), IntegerAt(data, "PatchSide", cell) });
    patches->GetCellPoints(cell, ids);
    points[segment].insert(ids->begin(), ids->end());
    const int other = IntegerAt(data, "BoundaryLabels", cell, 1);
    EXPECT_EQ(owners[IntegerAt(data, "Patch", cell)].size() == 2, other > 0 && segment == b)
      << cell; // segment a comes first
  }
  Common common;
  for (const auto& [patch, sides] : owners)
  {
    if (sides.size() == 2)
    {
      const std::array<int, 3>&low = *sides.begin(), &high = *sides.rbegin();
      EXPECT_EQ(low[0], a);
      EXPECT_EQ(high[0], b);
      EXPECT_EQ(low[1], high[1]);
      EXPECT_NE(low[2], high[2]);
      common.Patches.insert(patch);
    }
  }
  for (const vtkIdType p : points[a])
  {
    if (points[b].count(p) > 0)
    {
      common.Points.insert(p);
      const int corner = IntegerAt(patches->GetPointData(), "CornerId", p);
      if (corner >= 0)
      {
        common.Corners.insert(corner);
      }
    }
  }
  return common;
}

// Points where three segments meet.
std::size_t JunctionPoints(vtkPolyData* surface)
{
  std::map<vtkIdType, std::set<double>> labels;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, ids);
    for (const vtkIdType id : *ids)
    {
      labels[id].insert(CellArray(surface, "BoundaryLabels")->GetComponent(cell, 0));
      labels[id].insert(CellArray(surface, "BoundaryLabels")->GetComponent(cell, 1));
    }
  }
  return std::count_if(
    labels.begin(), labels.end(), [](const auto& point) { return point.second.size() > 2; });
}

vtkIdType PointsBetween(vtkPolyData* surface, int a, int b)
{
  std::set<vtkIdType> points;
  vtkNew<vtkIdList> ids;
  vtkDataArray* labels = CellArray(surface, "BoundaryLabels");
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    if (std::minmax(labels->GetComponent(cell, 0), labels->GetComponent(cell, 1)) ==
        std::minmax(double(a), double(b)))
    {
      surface->GetCellPoints(cell, ids);
      points.insert(ids->begin(), ids->end());
    }
  }
  return static_cast<vtkIdType>(points.size());
}

// Corners that two blocks of different segments have in common, with what they are in the lattice.
std::set<std::array<int, 3>> CommonLattice(vtkUnstructuredGrid* blocks, int a, int b)
{
  std::map<int, std::set<vtkIdType>> points;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < blocks->GetNumberOfCells(); ++cell)
  {
    blocks->GetCellPoints(cell, ids);
    points[IntegerAt(blocks->GetCellData(), "Segment", cell)].insert(ids->begin(), ids->end());
  }
  std::set<std::array<int, 3>> lattice;
  for (const vtkIdType p : points[a])
  {
    if (points[b].count(p) > 0)
    {
      vtkPointData* data = blocks->GetPointData();
      lattice.insert({ IntegerAt(data, "DomainCoordinates", p),
        IntegerAt(data, "DomainCoordinates", p, 1), IntegerAt(data, "DomainCoordinates", p, 2) });
    }
  }
  return lattice;
}

bool IsUnitSquare(const std::set<std::array<int, 3>>& lattice)
{
  int spread[3] = { 0, 0, 0 };
  for (const std::array<int, 3>& p : lattice)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      spread[axis] = std::max(spread[axis], p[axis] - (*lattice.begin())[axis]);
    }
  }
  return lattice.size() == 4 && spread[0] + spread[1] + spread[2] == 2;
}
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, SharesAPatchWhereSegmentsTouch)
{
  struct Case
  {
    const char* Name;
    Label Segments;
    double Jacobian;
  };
  for (const Case& c :
    {
      Case{ "two boxes with a common face",
        [](const double* p) { return BoxLabel(p, 10, 6, 6) ? (p[0] < 1.0 ? 2 : 5) : 0; }, 0.25 },
      Case{ "two halves of a ball",
        [](const double* p) { return vtkMath::Norm(p) < 10.0 ? (p[2] < 0.5 ? 2 : 5) : 0; }, 0.0 },
      Case{ "a narrow box on a wide one",
        [](const double* p)
        {
          return p[2] < 0.0 ? 2 * BoxLabel(p, 8, 8, 9)
                            : 5 * int(std::abs(p[0]) < 6.0 && std::abs(p[1]) < 5.0 && p[2] < 8.0);
        },
        -1.0 },
      Case{ "a bar cut lengthwise",
        [](const double* p) { return BoxLabel(p, 4, 11, 5) ? (p[0] < 0.5 ? 2 : 5) : 0; }, 0.0 },
    })
  {
    const vtkNew<vtkPolyData> surface = SurfaceOf(12, c.Segments);
    vtkNew<vtkPolycubeDomain> domain;
    WarningLog log(domain);
    domain->SetInputData(surface);
    for (const bool layered : { true, false })
    {
      domain->SetLayered(layered);
      domain->Update();
      ExpectSound(domain, surface, { 2, 5 });
      const Common common = CommonOf(domain->GetPatches(), 2, 5);
      EXPECT_EQ(common.Patches.size(), 1u) << c.Name;
      EXPECT_EQ(common.Corners.size(), 4u) << c.Name;
      EXPECT_EQ(vtkIdType(common.Points.size()), PointsBetween(surface, 2, 5)) << c.Name;
      EXPECT_TRUE(IsUnitSquare(CommonLattice(domain->GetPolycube(), 2, 5))) << c.Name;
      EXPECT_EQ(domain->GetPolycube()->GetNumberOfCells(), layered ? 14 : 2) << c.Name;
      EXPECT_EQ(domain->GetPolycube()->GetNumberOfPoints(), layered ? 28 : 12) << c.Name;
      EXPECT_GT(LeastJacobian(domain->GetPolycube()), c.Jacobian) << c.Name;
      // The curve where three segments meet is four borders, on both sides.
      std::size_t onCurve = 0;
      vtkPolyData* borders = domain->GetBorders();
      for (vtkIdType cell = 0; cell < borders->GetNumberOfCells(); ++cell)
      {
        const int left = IntegerAt(borders->GetCellData(), "BorderPatches", cell);
        const int right = IntegerAt(borders->GetCellData(), "BorderPatches", cell, 1);
        if (common.Patches.count(left) + common.Patches.count(right) > 0)
        {
          onCurve += borders->GetCellSize(cell) - 1;
        }
      }
      EXPECT_EQ(onCurve, 2 * JunctionPoints(surface)) << c.Name;
    }
    EXPECT_EQ(log.Text, "") << c.Name;
  }
}

TEST(PolycubeDomain, SharesPatchesAlongARow)
{
  const vtkNew<vtkPolyData> surface = SurfaceOf(16,
    [](const double* p) {
      return BoxLabel(p, 15, 6, 5) ? (p[0] < -5.0 ? 3 : p[0] < 4.0 ? 1 : 2) : 0;
    });
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputData(surface);
  domain->Update();
  ExpectSound(domain, surface, { 1, 2, 3 });
  vtkUnstructuredGrid* blocks = domain->GetPolycube();
  EXPECT_EQ(blocks->GetNumberOfCells(), 21);
  EXPECT_EQ(blocks->GetNumberOfPoints(), 16 + 24);
  EXPECT_TRUE(IsUnitSquare(CommonLattice(blocks, 1, 3)));
  EXPECT_TRUE(IsUnitSquare(CommonLattice(blocks, 1, 2)));
  EXPECT_TRUE(CommonLattice(blocks, 2, 3).empty());
  std::set<std::array<int, 3>> lattice;
  for (vtkIdType id = 0; id < blocks->GetNumberOfPoints(); ++id)
  {
    lattice.insert({ IntegerAt(blocks->GetPointData(), "DomainCoordinates", id),
      IntegerAt(blocks->GetPointData(), "DomainCoordinates", id, 1),
      IntegerAt(blocks->GetPointData(), "DomainCoordinates", id, 2) });
  }
  EXPECT_EQ(lattice.size(), 16u); // three cubes in a row
}

//------------------------------------------------------------------------------
TEST(PolycubeDomain, SaysWhyTouchingSegmentsShareNothing)
{
  struct Case
  {
    Label Segments;
    const char* Warning;
  };
  for (const Case& c :
    {
      // A bar stuck through a plate touches it in a ring.
      Case{ [](const double* p) { return BoxLabel(p, 4, 4, 10) ? 2 : int(BoxLabel(p, 11, 11, 4)); },
        "Segments 1 and 2 touch but have separate domains there: the common surface is no disc." },
      // A ball in a bowl: too little of the ball is left for five faces.
      Case{ [](const double* p)
        {
          const double r = vtkMath::Norm(p);
          return r < 7.0 ? 2 : r < 10.0 && p[2] < 5.0 ? 1 : 0;
        },
        "Segments 1 and 2 touch but have separate domains there: no domain has it as a patch" },
      // Four corners of a frame: the last contact would have to close their lattice.
      Case{ [](const double* p)
        {
          const bool frame = BoxLabel(p, 11, 11, 4) && !BoxLabel(p, 4, 4, 5);
          return frame ? 1 + (p[0] > 0.5) + 2 * (p[1] > 0.5) : 0;
        },
        "touch but have separate domains there: they share surfaces with others around a ring." },
      // Four quarters of a box around its axis: the pairs' faces meet along that.
      Case{ [](const double* p)
        { return BoxLabel(p, 10, 10, 6) ? 1 + (p[0] > 0.5) + 2 * (p[1] > 0.5) : 0; },
        "Segments 3 and 4 touch but have separate domains there: the common surface meets one "
        "with another segment." },
    })
  {
    const vtkNew<vtkPolyData> surface = SurfaceOf(12, c.Segments);
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetCornerCost(0.0); // as many cubes as there are flat parts
    WarningLog log(domain);
    domain->SetInputData(surface);
    domain->Update();
    const std::string& warning = log.Text;
    EXPECT_NE(warning.find(c.Warning), std::string::npos) << warning;
    EXPECT_GE(ValuesOf(CellArray(domain->GetPolycube(), "Segment")).size(), 2u);
  }
}
