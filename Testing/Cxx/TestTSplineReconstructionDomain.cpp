// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ErrorLog.h"
#include "ReconstructionPhantom.h"
#include "WarningLog.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"
#include "vtkTSplineFit.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkFieldData.h"
#include "vtkMeshQuality.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>
#include <numeric>
#include <set>

using namespace trivariate_testing;

namespace
{
// The polycube that is found for segment 3.
vtkNew<vtkUnstructuredGrid> FoundDomain(vtkImageData* image)
{
  vtkNew<vtkSegmentBoundary> boundary;
  boundary->SetInputData(image);
  boundary->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Material");
  vtkNew<vtkPolycubeDomain> domain;
  domain->SetInputConnection(boundary->GetOutputPort());
  domain->Update();
  vtkNew<vtkUnstructuredGrid> polycube;
  polycube->DeepCopy(domain->GetPolycube());
  return polycube;
}

// Where the corners on the surface are, by their coordinates.
std::map<std::array<double, 3>, std::array<double, 3>> CornersOf(vtkUnstructuredGrid* polycube)
{
  std::map<std::array<double, 3>, std::array<double, 3>> corners;
  for (vtkIdType p = 0; p < polycube->GetNumberOfPoints(); ++p)
  {
    if (polycube->GetPointData()->GetArray("CornerId")->GetTuple1(p) >= 0.0)
    {
      std::array<double, 3> at;
      polycube->GetPointData()->GetArray("DomainCoordinates")->GetTuple(p, at.data());
      polycube->GetPoint(p, corners[at].data());
    }
  }
  return corners;
}

// Distinct ones: those of the last round of each segment. Over cubes some points of the grid stand
// for the same one, seen from blocks that share a face.
double ControlPointsOf(vtkTable* rounds)
{
  std::map<double, double> last;
  for (vtkIdType row = 0; row < rounds->GetNumberOfRows(); ++row)
  {
    last[rounds->GetValueByName(row, "Segment").ToDouble()] =
      rounds->GetValueByName(row, "ControlPoints").ToDouble();
  }
  return std::accumulate(last.begin(), last.end(), 0.0,
    [](double sum, const auto& segment) { return sum + segment.second; });
}
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, FindsSegmentsSurfacesAndDomains)
{
  auto reconstruction = Reconstruct(Phantom());
  reconstruction->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
  reconstruction->SetNumberOfSegments(2);
  reconstruction->SetDomainToAutomatic();
  reconstruction->Update();
  auto* image = Output<vtkImageData>(reconstruction, 2);
  vtkDataArray* labels = image->GetPointData()->GetArray("Segment");
  ASSERT_NE(labels, nullptr);
  vtkIdType wrong = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    wrong += labels->GetTuple1(i) != (Radius(x) < 7.6);
  }
  EXPECT_LT(wrong, 30);
  EXPECT_GT(Output<vtkPolyData>(reconstruction, 3)->GetNumberOfCells(), 500);
  EXPECT_GT(Output<vtkPolyData>(reconstruction, 4)->GetNumberOfCells(), 500);
  EXPECT_GE(Output<vtkUnstructuredGrid>(reconstruction, 5)->GetNumberOfCells(), 7);
  EXPECT_GT(Output<vtkTable>(reconstruction, 1)->GetNumberOfRows(), 2);
  EXPECT_LE(ControlPointsOf(Output<vtkTable>(reconstruction, 1)), 1500.0);

  // Parameters of the inside and nowhere else, and hexahedra that fill it.
  vtkPointData* fields = Output<vtkImageData>(reconstruction, 6)->GetPointData();
  vtkIdType parameters = 0, inside = 0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    const bool has = fields->GetArray("ParameterMask")->GetTuple1(i) != 0.0;
    const bool is = labels->GetTuple1(i) == 1.0;
    EXPECT_EQ(has, fields->GetArray("Block")->GetTuple1(i) >= 0.0);
    EXPECT_FALSE(has && !is);
    parameters += has;
    inside += is;
  }
  EXPECT_GT(parameters, 0.99 * double(inside));
  auto* hexahedra = Output<vtkUnstructuredGrid>(reconstruction, 7);
  EXPECT_GT(hexahedra->GetCellData()->GetArray("ScaledJacobian")->GetRange()[0], 0.0);
  EXPECT_EQ(hexahedra->GetFieldData()->GetArray("InvertedCells")->GetComponent(0, 1), 0.0);
  EXPECT_GT(hexahedra->GetFieldData()->GetArray("ScaledJacobian")->GetComponent(0, 1), 0.8);
  vtkNew<vtkMeshQuality> quality;
  quality->SetInputData(hexahedra);
  quality->SetHexQualityMeasureToVolume();
  quality->Update();
  double volume = 0.0;
  for (vtkIdType cell = 0; cell < hexahedra->GetNumberOfCells(); ++cell)
  {
    volume += quality->GetOutput()->GetCellData()->GetArray("Quality")->GetTuple1(cell);
  }
  EXPECT_NEAR(volume, 2.0 * double(inside), 0.2 * double(inside)); // of voxels of 1 x 2 x 1
}

//------------------------------------------------------------------------------
// Over its cubes or over its box: whichever is better stands for every voxel, and is told of.
TEST(TSplineReconstruction, TakesTheBetterOfCubesAndBox)
{
  const auto run = [](int domain)
  {
    auto reconstruction = Reconstruct(Phantom());
    reconstruction->SetDomain(domain);
    reconstruction->SetRMSTolerance(0.0);
    return ReportOn(reconstruction);
  };
  const vtkNew<vtkTable> boxes = run(vtkTSplineReconstruction::SEGMENTS);
  const vtkNew<vtkTable> best = run(vtkTSplineReconstruction::AUTOMATIC);
  ASSERT_EQ(best->GetNumberOfRows(), 3);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(best->GetValueByName(row, "FoundPercent").ToDouble(), 100.0);
    EXPECT_EQ(boxes->GetValueByName(row, "Domain").ToString(), "SegmentBox");
    EXPECT_TRUE(std::isnan(boxes->GetValueByName(row, "Corners").ToDouble()));
  }
  EXPECT_EQ(best->GetValueByName(0, "Domain").ToString(), "SegmentBox");
  EXPECT_LE(best->GetValueByName(1, "RoundTripRMSPercent").ToDouble(),
    1.0001 * boxes->GetValueByName(1, "RoundTripRMSPercent").ToDouble());
}

//------------------------------------------------------------------------------
// Where nothing jumps from one segment to the other, one smooth spline needs fewer control points.
TEST(TSplineReconstruction, TakesOneSplineForAllWhereThatIsBetter)
{
  const auto image = Phantom();
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    image->GetPointData()->GetScalars()->SetTuple1(
      i, std::sin(0.3 * x[0]) * std::cos(0.15 * x[1]) + 0.1 * x[2]);
  }
  auto reconstruction = Reconstruct(image);
  reconstruction->SetMaximumNumberOfControlPoints(600);
  reconstruction->SetRMSTolerance(0.0);
  reconstruction->SetDomainToAutomatic();
  const WarningLog log(reconstruction);
  reconstruction->Update();
  EXPECT_FALSE(log.Says("One spline"));
  vtkFieldData* told = Output<vtkTable>(reconstruction, 1)->GetFieldData();
  EXPECT_EQ(told->GetAbstractArray("Remark")->GetVariantValue(0).ToString().find(
              "One spline stands for all segments: its error is "),
    0u);
  auto box = Reconstruct(image);
  box->SetMaximumNumberOfControlPoints(600);
  box->SetRMSTolerance(0.0);
  box->SetDomainToBox();
  box->Update();
  ExpectSame(reconstruction->GetOutput(), box->GetOutput());
  EXPECT_GT(Output<vtkUnstructuredGrid>(reconstruction, 7)->GetNumberOfCells(), 0);
  EXPECT_GT(Output<vtkPartitionedDataSetCollection>(reconstruction, 8)->GetNumberOfCells(), 0);
  // There are patches with corners, but no spline over them.
  const auto report = ReportOn(reconstruction);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(report->GetValueByName(row, "Domain").ToString(), "ImageBox");
    EXPECT_TRUE(std::isnan(report->GetValueByName(row, "Corners").ToDouble()));
  }
}

//------------------------------------------------------------------------------
// The corners found, with u, v, w called v, w, u: what comes out has them so, and stands for every
// voxel.
TEST(TSplineReconstruction, TakesCubesAndCornersThatAreGiven)
{
  const auto image = Phantom();
  const auto given = FoundDomain(image);
  vtkDataArray* coordinates = given->GetPointData()->GetArray("DomainCoordinates");
  for (vtkIdType p = 0; p < given->GetNumberOfPoints(); ++p)
  {
    double at[3];
    coordinates->GetTuple(p, at);
    coordinates->SetTuple3(p, at[2], at[0], at[1]);
  }
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToGiven();
  reconstruction->SetInputData(1, given);
  reconstruction->Update();
  const auto wanted = CornersOf(given);
  const auto got = CornersOf(Output<vtkUnstructuredGrid>(reconstruction, 5));
  ASSERT_EQ(got.size(), wanted.size());
  for (const auto& [at, place] : wanted)
  {
    ASSERT_EQ(got.count(at), 1u);
    for (int a = 0; a < 3; ++a)
    {
      EXPECT_NEAR(got.at(at)[a], place[a], 0.5);
    }
  }
  EXPECT_GE(Output<vtkUnstructuredGrid>(reconstruction, 5)->GetNumberOfCells(), 7); // layers

  std::map<double, std::set<double>> blocks;
  vtkPointData* data = reconstruction->GetOutput()->GetPointData();
  for (vtkIdType p = 0; p < reconstruction->GetOutput()->GetNumberOfPoints(); ++p)
  {
    blocks[data->GetArray("Segment")->GetTuple1(p)].insert(data->GetArray("Block")->GetTuple1(p));
  }
  EXPECT_EQ(blocks[0].size(), 1u);
  EXPECT_GE(blocks[3].size(), 7u);
  const auto report = ReportOn(reconstruction);
  // The fields have the parameters that the fit began with, and only in cubes: none counts.
  const auto onFields = ReportOn(reconstruction, 6);
  for (vtkIdType row = 0; row < report->GetNumberOfRows(); ++row)
  {
    EXPECT_EQ(onFields->GetValueByName(row, "RMSPercent").ToDouble(),
      report->GetValueByName(row, "RMSPercent").ToDouble());
  }
  const auto cell = [&report](vtkIdType row, const char* name)
  { return report->GetValueByName(row, name).ToDouble(); };
  EXPECT_EQ(cell(2, "FoundPercent"), 100.0);
  EXPECT_LT(cell(2, "RoundTripRMSPercent"), 2.0);
  const char* domains[] = { "SegmentBox", "LayeredCubes", "Mixed" };
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(report->GetValueByName(row, "Domain").ToString(), domains[row]);
    // The error at the voxels' own parameters is told, and the round trip keeps it.
    EXPECT_LE(cell(row, "RoundTripRMSPercent"), 1.05 * cell(row, "RMSPercent")) << row;
    EXPECT_GE(cell(row, "RoundTripRMSPercent"), 0.95 * cell(row, "RMSPercent")) << row;
  }
  EXPECT_TRUE(std::isnan(cell(0, "Corners")));
  EXPECT_EQ(cell(1, "Corners"), double(wanted.size()));
  EXPECT_EQ(cell(2, "Corners"), double(wanted.size()));
}

//------------------------------------------------------------------------------
// What the reconstruction has found on its way is enough to fit anew over the domain.
TEST(TSplineReconstruction, GivesWhatAnotherFitOverTheDomainNeeds)
{
  const auto image = Phantom();
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToGiven();
  reconstruction->SetInputData(1, FoundDomain(image));
  reconstruction->Update();
  auto* blocks = Output<vtkPartitionedDataSetCollection>(reconstruction, 8);
  ASSERT_EQ(static_cast<vtkIdType>(blocks->GetNumberOfPartitionedDataSets()),
    Output<vtkUnstructuredGrid>(reconstruction, 5)->GetNumberOfCells());
  for (unsigned int block = 0; block < blocks->GetNumberOfPartitionedDataSets(); ++block)
  {
    EXPECT_TRUE(vtkStructuredGrid::SafeDownCast(blocks->GetPartition(block, 0)));
  }
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputConnection(0, reconstruction->GetOutputPort(6));
  fit->SetInputConnection(1, reconstruction->GetOutputPort(5));
  fit->SetInputConnection(2, reconstruction->GetOutputPort(8));
  fit->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Density");
  double error[2];
  for (const int most : { 1000, 3000 })
  {
    fit->SetMaximumNumberOfControlPoints(most);
    fit->Update();
    auto* rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
    ASSERT_GT(rounds->GetNumberOfRows(), 0);
    error[most == 3000] = rounds->GetValueByName(rounds->GetNumberOfRows() - 1, "RMS").ToDouble();
  }
  EXPECT_LT(error[0], 8.0);
  EXPECT_LT(error[1], 0.5 * error[0]);
}

//------------------------------------------------------------------------------
TEST(TSplineReconstruction, NamesWhatIsWrongWithAGivenDomain)
{
  const auto image = Phantom();
  const auto found = FoundDomain(image);
  auto reconstruction = Reconstruct(image);
  reconstruction->SetDomainToGiven();
  ErrorLog log(reconstruction);
  const auto expect = [&](const std::function<void(vtkUnstructuredGrid*)>& spoil, const char* words)
  {
    vtkNew<vtkUnstructuredGrid> given;
    given->DeepCopy(found);
    spoil(given);
    reconstruction->SetInputData(1, given);
    reconstruction->Update();
    const std::string text = log.TakeOnly();
    EXPECT_NE(text.find(words), std::string::npos) << text << "\ninstead of: " << words;
    EXPECT_EQ(reconstruction->GetOutput()->GetNumberOfPoints(), 0) << words;
  };
  const auto corner = [](vtkUnstructuredGrid* given, int u, int v, int w)
  {
    for (vtkIdType p = 0; p < given->GetNumberOfPoints(); ++p)
    {
      const double* at = given->GetPointData()->GetArray("DomainCoordinates")->GetTuple3(p);
      if (at[0] == u && at[1] == v && at[2] == w &&
          given->GetPointData()->GetArray("CornerId")->GetTuple1(p) >= 0.0)
      {
        return p;
      }
    }
    return vtkIdType(-1);
  };
  expect([](auto* given) { given->Initialize(); }, "no cubes");
  expect([](auto* given) { given->GetPointData()->RemoveArray("DomainCoordinates"); },
    "no array DomainCoordinates of 3");
  expect([](auto* given) { given->GetCellData()->RemoveArray("Segment"); }, "no array Segment");
  expect([](auto* given) { given->GetCellData()->GetArray("Segment")->Fill(5); },
    "Segment 5 of the given domain: ");
  expect([](auto* given) { given->GetCellData()->GetArray("Patch")->Fill(0); },
    "Segment 3 of the given domain: It has blocks along its surface, but no cubes");
  expect([&](auto* given)
    { given->GetPointData()->GetArray("CornerId")->SetTuple1(corner(given, 1, 0, 1), -1); },
    "The corner at (1, 0, 1) has no place");
  expect(
    [&](auto* given)
    {
      given->GetPointData()
        ->GetArray("DomainCoordinates")
        ->SetTuple3(corner(given, 1, 0, 1), 1, 1, 1);
    },
    "The corner at (1, 1, 1) is there twice");
  expect([&](auto* given) { given->GetPoints()->SetPoint(corner(given, 0, 1, 0), 90.0, 0.0, 0.0); },
    "at (0, 1, 0)");
  expect([](auto* given) { given->GetPointData()->GetArray("DomainCoordinates")->Fill(2); },
    "is no cube of the lattice");
  expect(
    [&](auto* given)
    {
      vtkDataArray* coordinates = given->GetPointData()->GetArray("DomainCoordinates");
      for (vtkIdType p = 0; p < given->GetNumberOfPoints(); ++p)
      {
        coordinates->SetComponent(p, 0, 1.0 - coordinates->GetComponent(p, 0));
      }
    },
    "mirrored");
  reconstruction->SetInputConnection(1, nullptr);
  reconstruction->Update();
  EXPECT_NE(log.TakeOnly().find("second input is not connected"), std::string::npos);
}
