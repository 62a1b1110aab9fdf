// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ReportChecks.h"
#include "vtkTSplineWriter.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCubeSource.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkTriangleFilter.h"
#include "vtkUnsignedCharArray.h"
#include "vtkZLibDataCompressor.h"

#include <array>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <map>

using namespace trivariate;

//------------------------------------------------------------------------------
TEST(ReconstructionReport, OfTheImageThatASplineIsHasNoErrors)
{
  const TSplineModel model = RandomBox({ 2, 1, 2 }, 4, 3);
  const auto grid = MakeGrid(model);
  const auto image = Sampled(grid, Lattice(17, 9, 17));
  auto report = MakeReport(image, "Value", grid);
  report->Update();
  ASSERT_EQ(report->GetOutput()->GetNumberOfRows(), 2);
  const double voxels = 17.0 * 9.0 * 17.0, n = static_cast<double>(model.Spline.Size());
  for (const int row : { 0, 1 })
  {
    EXPECT_EQ(Cell(report, row, "Segment"), row == 0 ? 0.0 : -1.0);
    EXPECT_EQ(Cell(report, row, "Voxels"), voxels);
    EXPECT_EQ(Cell(report, row, "FoundPercent"), 100.0);
    for (const char* error : { "RMSPercent", "RoundTripRMSPercent", "MaximumErrorPercent" })
    {
      EXPECT_LT(Cell(report, row, error), 1e-11) << error;
    }
    EXPECT_GT(Cell(report, row, "PSNRDecibels"), 250.0);
    EXPECT_EQ(Cell(report, row, "ControlPoints"), n);
    EXPECT_EQ(Cell(report, row, "DistinctControlPoints"), n);
    EXPECT_EQ(Cell(report, row, "NumbersStored"), n + 12.0); // the geometry is affine
    EXPECT_EQ(Cell(report, row, "Blocks"), 1.0);
    EXPECT_EQ(DomainIn(report, row), "ImageBox");
    EXPECT_NEAR(Cell(report, row, "MinimumScaledJacobian"), 1.0, 1e-12);
    EXPECT_EQ(Cell(report, row, "InvertedCells"), 0.0);
    EXPECT_EQ(Cell(report, row, "GradientJumpPercent"), 0.0);
    EXPECT_EQ(Cell(report, row, "RawBytes"), 8.0 * voxels);
    for (const char* unknown : { "Corners", "HausdorffVoxels", "Seconds" })
    {
      EXPECT_TRUE(std::isnan(Cell(report, row, unknown))) << unknown;
    }
  }

  // The bytes are those of a file and of the compressor.
  vtkNew<vtkTSplineWriter> writer;
  writer->SetInputData(grid);
  writer->SetFileName("report.tspline");
  writer->Write();
  EXPECT_EQ(Cell(report, 1, "SplineBytes"),
    static_cast<double>(std::filesystem::file_size("report.tspline")));
  vtkDataArray* values = image->GetPointData()->GetArray("Value");
  const auto* raw = static_cast<unsigned char*>(values->GetVoidPointer(0));
  vtkNew<vtkZLibDataCompressor> compressor;
  const auto size = static_cast<std::size_t>(8.0 * voxels);
  std::vector<unsigned char> packed(compressor->GetMaximumCompressionSpace(size));
  EXPECT_EQ(Cell(report, 1, "ZLibBytes"),
    static_cast<double>(compressor->Compress(raw, size, packed.data(), packed.size())));
}

//------------------------------------------------------------------------------
TEST(ReconstructionReport, OfKnownDifferencesIsTheirRootMeanSquare)
{
  // The spline is x on [0, 16]; the image has the range 20, and x + 1 but for one voxel.
  TSplineModel model = RandomBox({ 2, 1, 1 }, 3, 5);
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    model.Spline.ControlPoint(i)[3] = model.Spline.ControlPoint(i)[0];
  }
  auto image = Lattice(17, 9, 9);
  AddArray<vtkDoubleArray>(image, "Value", [](const double* x) { return x[0] + 1.0; })
    ->SetValue(16 + 17 * 9 * 8, 21.0);
  auto report = MakeReport(image, "Value", MakeGrid(model));
  report->Update();
  const double n = 17.0 * 81.0, rms = std::sqrt((n - 1.0 + 25.0) / n) / 20.0;
  EXPECT_NEAR(Cell(report, 1, "RoundTripRMSPercent"), 100.0 * rms, 1e-10);
  EXPECT_NEAR(Cell(report, 1, "RMSPercent"), 100.0 * rms, 1e-10);
  EXPECT_NEAR(Cell(report, 1, "MaximumErrorPercent"), 25.0, 1e-10);
  EXPECT_NEAR(Cell(report, 1, "PSNRDecibels"), -20.0 * std::log10(rms), 1e-10);
}

//------------------------------------------------------------------------------
TEST(ReconstructionReport, CountsWhatIsNotFoundAsZero)
{
  // A quarter of the voxels lies beyond the spline, which is 3 everywhere.
  TSplineModel model = RandomBox({ 1, 1, 1 }, 2, 5);
  for (Index i = 0; i < model.Spline.Size(); ++i)
  {
    model.Spline.ControlPoint(i)[3] = 3.0;
  }
  auto image = Lattice(12, 9, 9);
  AddArray<vtkDoubleArray>(image, "Value", [](const double* x) { return x[0] < 0.5 ? 5.0 : 3.0; });
  auto report = MakeReport(image, "Value", MakeGrid(model));
  report->Update();
  EXPECT_NEAR(Cell(report, 1, "FoundPercent"), 75.0, 1e-12);
  // One layer of 2, three of 3, in a range of 2.
  EXPECT_NEAR(Cell(report, 1, "RoundTripRMSPercent"),
    100.0 * std::sqrt((1.0 * 1.0 + 3.0 * 1.5 * 1.5) / 12.0), 1e-10);
  EXPECT_TRUE(std::isnan(Cell(report, 1, "RMSPercent")));
}

//------------------------------------------------------------------------------
// Two splines over the same place; labels tell which of them counts where.
TEST(ReconstructionReport, ComparesEachVoxelWithTheSplineOfItsSegment)
{
  const TSplineModel low = Moved(RandomBox({ 2, 1, 1 }, 3, 1), 0.0, 1);
  const TSplineModel high = Moved(RandomBox({ 2, 1, 1 }, 3, 2), 0.0, 4);
  const auto both = Together(low, high);
  const auto lowImage = Sampled(MakeGrid(low), Lattice(17, 9, 9));
  const auto highImage = Sampled(MakeGrid(high), Lattice(17, 9, 9));
  auto image = Lattice(17, 9, 9);
  vtkIntArray* labels =
    AddArray<vtkIntArray>(image, "Segment", [](const double* x) { return x[0] < 5.5 ? 4.0 : 1.0; });
  vtkDataArray* values[2] = { lowImage->GetPointData()->GetArray("Value"),
    highImage->GetPointData()->GetArray("Value") };
  vtkDoubleArray* mixed =
    AddArray<vtkDoubleArray>(image, "Value", [](const double*) { return 0.0; });
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    mixed->SetValue(i, values[labels->GetValue(i) == 4]->GetTuple1(i));
  }
  auto report = MakeReport(image, "Value", both);
  report->Update();
  ASSERT_EQ(report->GetOutput()->GetNumberOfRows(), 3);
  const double segments[3] = { 1.0, 4.0, -1.0 }, voxels[3] = { 11.0 * 81, 6.0 * 81, 17.0 * 81 };
  const double points[3] = { double(low.Spline.Size()), double(high.Spline.Size()),
    double(low.Spline.Size() + high.Spline.Size()) };
  for (int row = 0; row < 3; ++row)
  {
    EXPECT_EQ(Cell(report, row, "Segment"), segments[row]);
    EXPECT_EQ(Cell(report, row, "Voxels"), voxels[row]);
    EXPECT_EQ(Cell(report, row, "ControlPoints"), points[row]);
    EXPECT_LT(Cell(report, row, "RoundTripRMSPercent"), 1e-11);
    EXPECT_LT(Cell(report, row, "RMSPercent"), 1e-11);
    EXPECT_EQ(Cell(report, row, "FoundPercent"), 100.0);
    EXPECT_EQ(Cell(report, row, "LabelBytes") > 0.0, row == 2);
    EXPECT_EQ(DomainIn(report, row), "SegmentBox");
  }
  EXPECT_EQ(Cell(report, 2, "RawBytes"), Cell(report, 0, "RawBytes") + Cell(report, 1, "RawBytes"));
  EXPECT_LT(Cell(report, 2, "SplineBytes"),
    Cell(report, 0, "SplineBytes") + Cell(report, 1, "SplineBytes"));

  // Without labels the higher segment counts everywhere.
  image->GetPointData()->RemoveArray("Segment");
  const auto resampled = Sampled(both, image);
  EXPECT_NEAR(
    resampled->GetPointData()->GetArray("Value")->GetTuple1(16), values[1]->GetTuple1(16), 1e-12);

  // A segment that the spline does not have is not found.
  AddArray<vtkIntArray>(image, "Segment", [](const double*) { return 3.0; });
  report->Modified();
  image->Modified();
  report->Update();
  EXPECT_EQ(Cell(report, 0, "FoundPercent"), 0.0);
  EXPECT_TRUE(std::isnan(Cell(report, 0, "ControlPoints")));
  EXPECT_EQ(DomainIn(report, 0), "None");
}

//------------------------------------------------------------------------------
// On the annulus, whose attribute is (1 + u)^2 at (u, v, w).
TEST(ReconstructionReport, TakesTheVoxelsOwnParameters)
{
  auto image = Lattice(17, 17, 5);
  image->SetSpacing(0.125, 0.125, 0.25);
  const auto radius = [](const double* x) { return std::hypot(x[0], x[1]); };
  const auto inside = [radius](const double* x) { return radius(x) > 1.05 && radius(x) < 1.95; };
  AddArray<vtkDoubleArray>(
    image, "Radial", [radius](const double* x) { return std::pow(radius(x), 2); });
  AddArray<vtkIntArray>(
    image, "Segment", [inside](const double* x) { return inside(x) ? 1.0 : 0.0; });
  AddArray<vtkUnsignedCharArray>(image, "ParameterMask", inside);
  vtkNew<vtkDoubleArray> parameter;
  parameter->SetName("Parameter");
  parameter->SetNumberOfComponents(3);
  double squares = 0.0, count = 0.0;
  for (vtkIdType i = 0; i < image->GetNumberOfPoints(); ++i)
  {
    double x[3];
    image->GetPoint(i, x);
    const double r = radius(x);
    parameter->InsertNextTuple3(inside(x) ? r - 0.99 : 7.0, 0.5, 0.5);
    if (inside(x))
    {
      squares += std::pow(((r + 0.01) * (r + 0.01) - r * r) / 8.0, 2); // the range is 8
      ++count;
    }
  }
  image->GetPointData()->AddArray(parameter);
  TSplineModel model = QuarterAnnulus(3, 1);
  model.Segment.assign(model.Spline.Size(), 1);
  auto report = MakeReport(image, "Radial", MakeGrid(model));
  report->Update();
  ASSERT_EQ(report->GetOutput()->GetNumberOfRows(), 3);
  EXPECT_EQ(Cell(report, 1, "Voxels"), count);
  EXPECT_NEAR(Cell(report, 1, "RMSPercent"), 100.0 * std::sqrt(squares / count), 1e-9);
  EXPECT_LT(Cell(report, 1, "RoundTripRMSPercent"), 1e-9);
  EXPECT_EQ(Cell(report, 1, "FoundPercent"), 100.0);
  EXPECT_TRUE(std::isnan(Cell(report, 0, "RMSPercent")));
  EXPECT_EQ(Cell(report, 2, "NumbersStored"), double(model.Spline.Size() * 6));
  EXPECT_EQ(DomainIn(report, 1), "Cubes"); // what is not affine, without rounds that tell more
  EXPECT_NEAR(Cell(report, 2, "MinimumScaledJacobian"), 1.0, 1e-9);
}

//------------------------------------------------------------------------------
// Where the image has no parameters the rounds tell: the last ones of each segment, in percent of
// the segment's range.
TEST(ReconstructionReport, TakesErrorsAndDomainsOverCubesFromTheRounds)
{
  const auto grid =
    Together(Moved(QuarterAnnulus(3, 1), 0.0, 1), Moved(QuarterAnnulus(2, 1), 0.0, 2));
  auto image = Lattice(9, 9, 5);
  image->SetSpacing(0.25, 0.25, 0.25);
  AddArray<vtkDoubleArray>(image, "Radial", [](const double* x) { return 10.0 * x[0]; }); // to 20
  AddArray<vtkIntArray>(image, "Segment", [](const double* x) { return x[2] < 0.1 ? 1.0 : 2.0; });
  vtkNew<vtkTable> rounds;
  const std::map<const char*, std::array<double, 3>> columns = { { "Segment", { 1.0, 1.0, 2.0 } },
    { "RMS", { 9.0, 2.0, 5.0 } }, { "Seconds", { 1.0, 3.0, 4.0 } },
    { "Range", { 8.0, 8.0, 2.0 } } };
  for (const auto& [name, values] : columns)
  {
    vtkNew<vtkDoubleArray> column;
    column->SetName(name);
    for (const double value : values)
    {
      column->InsertNextValue(value);
    }
    rounds->AddColumn(column);
  }
  vtkNew<vtkStringArray> domains;
  domains->SetName("Domain");
  for (const char* name : { "LayeredCubes", "LayeredCubes", "Cubes" })
  {
    domains->InsertNextValue(name);
  }
  rounds->AddColumn(domains);
  auto report = MakeReport(image, "Radial", grid);
  report->SetInputData(3, rounds);
  report->Update();
  const double first = 100.0 * 0.02 * 8.0 / 20.0, second = 100.0 * 0.05 * 2.0 / 20.0;
  EXPECT_NEAR(Cell(report, 0, "RMSPercent"), first, 1e-12);
  EXPECT_NEAR(Cell(report, 1, "RMSPercent"), second, 1e-12);
  EXPECT_NEAR(Cell(report, 2, "RMSPercent"),
    std::sqrt((first * first + 4.0 * second * second) / 5.0), 1e-12); // one of five layers
  EXPECT_EQ(DomainIn(report, 0), "LayeredCubes");
  EXPECT_EQ(DomainIn(report, 1), "Cubes");
  EXPECT_EQ(DomainIn(report, 2), "Mixed");
  EXPECT_EQ(Cell(report, 2, "Seconds"), 7.0);

  // Without the range nothing is known of the errors.
  rounds->RemoveColumnByName("Range");
  report->Modified();
  report->Update();
  EXPECT_TRUE(std::isnan(Cell(report, 0, "RMSPercent")));
}

//------------------------------------------------------------------------------
// Two blocks side by side: the face between them is no boundary. The surface is a box that sticks
// out by 0.5 along y, where voxels are half as long.
TEST(ReconstructionReport, MeasuresTheDistanceOfBoundariesInVoxels)
{
  const TSplineModel box = RandomBox({ 1, 1, 1 }, 0, 6);
  const auto grid = Together(Moved(box, 0.0, 1), Moved(box, 8.0, 1));
  auto image = Lattice(17, 17, 9);
  image->SetSpacing(1.0, 0.5, 1.0);
  AddArray<vtkDoubleArray>(image, "Value", [](const double* x) { return x[0]; });
  vtkNew<vtkCubeSource> cube;
  cube->SetBounds(0.0, 16.0, 0.0, 8.5, 0.0, 8.0);
  vtkNew<vtkTriangleFilter> triangles;
  triangles->SetInputConnection(cube->GetOutputPort());
  triangles->Update();
  vtkPolyData* surface = triangles->GetOutput();
  vtkNew<vtkIntArray> corners, labels;
  corners->SetName("CornerId");
  corners->SetNumberOfTuples(surface->GetNumberOfPoints());
  corners->Fill(-1);
  corners->SetValue(3, 7);
  corners->SetValue(5, 9);
  surface->GetPointData()->AddArray(corners);
  labels->SetName("BoundaryLabels");
  labels->SetNumberOfComponents(2);
  for (vtkIdType i = 0; i < surface->GetNumberOfCells(); ++i)
  {
    labels->InsertNextTuple2(i % 2, 1 - i % 2);
  }
  surface->GetCellData()->AddArray(labels);
  auto report = MakeReport(image, "Value", grid);
  report->SetInputData(2, surface);
  AddArray<vtkIntArray>(image, "Segment", [](const double*) { return 1.0; });
  report->Update();
  EXPECT_NEAR(Cell(report, 1, "HausdorffVoxels"), 1.0, 1e-9);
  EXPECT_EQ(Cell(report, 1, "Corners"), 2.0);

  // A surface with other labels is not this segment's. One spline stands for all labels, though.
  labels->Fill(5);
  surface->Modified();
  report->Update();
  EXPECT_TRUE(std::isnan(Cell(report, 1, "HausdorffVoxels")));
}
