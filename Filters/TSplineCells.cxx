// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplineCells.h"

#include "TSpline/BezierExtraction.h"
#include "TSpline/BisectionMesh.h"
#include "MemoryLimit.h"
#include "TSpline/Tessellation.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkHigherOrderHexahedron.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkTypeInt64Array.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr int BezierPoints = 64; // of a tricubic cell

// Where functions were left out (a fit to some of the voxels) the denominator may vanish at a
// corner of a cell, and with it the numerators. VTK divides by it: it gets this share of the
// largest one.
constexpr double SmallestWeight = 1e-12;

// What a control point without weight stands for: the mean of the cell.
double Mean(const double* numerators, const double* denominators)
{
  return std::accumulate(numerators, numerators + BezierPoints, 0.0) /
         std::accumulate(denominators, denominators + BezierPoints, 0.0);
}

template <typename Array>
vtkSmartPointer<Array> MakeArray(const char* name, int components, Index tuples)
{
  auto array = vtkSmartPointer<Array>::New();
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  return array;
}

void RequireMemory(double bytes)
{
  const std::string fault = MemoryFault("The mesh", bytes);
  if (!fault.empty())
  {
    throw std::length_error(fault);
  }
}

// Cells of one size from point ids.
vtkSmartPointer<vtkCellArray> MakeCells(int pointsPerCell, const std::vector<Index>& ids)
{
  auto connectivity = vtkSmartPointer<vtkTypeInt64Array>::New();
  connectivity->SetNumberOfValues(static_cast<vtkIdType>(ids.size()));
  std::copy(ids.begin(), ids.end(), connectivity->GetPointer(0));
  auto cells = vtkSmartPointer<vtkCellArray>::New();
  cells->SetData(pointsPerCell, connectivity);
  return cells;
}

// The cell in parameter space: u low, u high, v low, v high, w low, w high.
std::array<double, 6> BoundsOf(const TSplineView& view, const IndexBox& box)
{
  std::array<double, 6> bounds;
  for (int a = 0; a < 3; ++a)
  {
    bounds[2 * a] = view.Mesh.KnotLines()[a][box.Low[a]];
    bounds[2 * a + 1] = view.Mesh.KnotLines()[a][box.High[a]];
  }
  return bounds;
}

// How often a cell of the coarsest mesh was halved to get one of the given bounds, from their
// widths. The coarsest cells are equal parts of the domain if their number is known, else as wide
// as the widest cell.
class LevelOfCell
{
public:
  explicit LevelOfCell(const TSplineView& view)
  {
    for (int a = 0; a < 3; ++a)
    {
      const KnotLine& line = view.Mesh.KnotLines()[a];
      const int roots = view.Model.RootCells[a];
      this->RootWidths[a] = roots > 0 ? (line.back() - line.front()) / roots : 0.0;
      for (Index cell = 0; cell < view.Mesh.Size() && roots <= 0; ++cell)
      {
        const auto bounds = view.Mesh.Bounds(cell);
        this->RootWidths[a] = std::max(this->RootWidths[a], bounds[2 * a + 1] - bounds[2 * a]);
      }
    }
  }

  int operator()(const std::array<double, 6>& bounds) const
  {
    int level = 0;
    for (int a = 0; a < 3; ++a)
    {
      const double ratio = this->RootWidths[a] / (bounds[2 * a + 1] - bounds[2 * a]);
      level += std::max(0, static_cast<int>(std::lround(std::log2(ratio))));
    }
    return level;
  }

private:
  std::array<double, 3> RootWidths;
};

// ParametricBounds and Level of the cell that each element lies in; boundsOf(cell) tells its
// bounds.
template <typename Bounds>
void AddCellArrays(const TSplineView& view, const std::vector<Index>& cells, const Bounds& boundsOf,
  vtkCellData* cellData)
{
  const Index count = static_cast<Index>(cells.size());
  const auto bounds = MakeArray<vtkDoubleArray>("ParametricBounds", 6, count);
  const auto levels = MakeArray<vtkIntArray>("Level", 1, count);
  const LevelOfCell level(view);
  for (Index i = 0; i < count; ++i)
  {
    const std::array<double, 6> box = boundsOf(cells[i]);
    bounds->SetTypedTuple(i, box.data());
    levels->SetValue(i, level(box));
  }
  cellData->AddArray(bounds);
  cellData->AddArray(levels);
}

// Evaluates the spline at the given parameters and makes them the output's points, with the
// parameters themselves as the array Parameter.
void SamplePoints(const TSplineView& view, const std::vector<double>& parameters,
  vtkPointSet* output, const Execution& execution)
{
  const Index count = static_cast<Index>(parameters.size() / 3);
  FieldSampler sampler(view, true, execution.Part(0.0, 0.2));
  sampler.Allocate(count);
  sampler.Sample(0, count, parameters.data(), nullptr, execution.Part(0.2, 1.0));
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  sampler.AddTo(output->GetPointData(), points);
  output->SetPoints(points);

  const auto array = MakeArray<vtkDoubleArray>("Parameter", 3, count);
  std::copy(parameters.begin(), parameters.end(), array->GetPointer(0));
  output->GetPointData()->AddArray(array);
}

// The hexahedra of a tessellation.
template <typename Bounds>
void FillElements(const TSplineView& view, const Tessellation& mesh, const Bounds& boundsOf,
  vtkUnstructuredGrid* output, const Execution& execution)
{
  SamplePoints(view, mesh.Parameters, output, execution);
  output->SetCells(VTK_HEXAHEDRON, MakeCells(8, mesh.Elements));
  AddCellArrays(view, mesh.Cells, boundsOf, output->GetCellData());
}

// For each Bernstein coefficient, u fastest, its place among the points of VTK's cell.
std::array<int, BezierPoints> MakePointOrder()
{
  const int degrees[3] = { 3, 3, 3 };
  std::array<int, BezierPoints> order;
  for (int i = 0; i < BezierPoints; ++i)
  {
    order[i] = vtkHigherOrderHexahedron::PointIndexFromIJK(i % 4, i / 4 % 4, i / 16, degrees);
  }
  return order;
}
}

void FillHexahedra(const TSplineView& view, int subdivisions, vtkUnstructuredGrid* output,
  const Execution& execution)
{
  // At most as many points as (subdivisions + 1)^3 a cell, usually about one an element; the lists
  // of the tessellation and the output's arrays live at the same time.
  const double elements = 1.0 * view.Mesh.Size() * subdivisions * subdivisions * subdivisions;
  const double numbers = 3.0 + view.Model.Spline.Components * (view.Gradients ? 4.0 : 1.0);
  RequireMemory(elements * (250.0 + sizeof(double) * numbers));

  const Tessellation mesh = TessellateVolume(view.Mesh, subdivisions, execution.Part(0.0, 0.4));
  FillElements(
    view, mesh, [&view](Index cell) { return view.Mesh.Bounds(cell); }, output,
    execution.Part(0.4, 1.0));
}

void FillTMesh(const TSplineView& view, vtkUnstructuredGrid* output, const Execution& execution)
{
  const std::vector<IndexBox> cells =
    BisectionMesh::Recover(view.Model.Spline, view.Model.RootCells);
  if (cells.empty())
  {
    FillHexahedra(view, 1, output, execution);
    return;
  }
  const Tessellation mesh = TessellateBoxes(view.Mesh.KnotLines(), cells);
  FillElements(
    view, mesh, [&](Index cell) { return BoundsOf(view, cells[cell]); }, output, execution);
}

void FillSurfaces(const TSplineView& view, const std::array<std::vector<double>, 3>& positions,
  int subdivisions, vtkPolyData* output, const Execution& execution)
{
  std::vector<double> parameters, values;
  std::vector<Index> quads;
  std::vector<int> directions;
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = view.Mesh.KnotLines()[a];
    for (const double share : positions[a])
    {
      // Not front + share (back - front): that may miss the end by rounding.
      const double value = (1.0 - share) * line.front() + share * line.back();
      const Tessellation surface = TessellateSurface(view.Mesh, a, value, subdivisions, execution);
      const Index first = static_cast<Index>(parameters.size() / 3);
      parameters.insert(parameters.end(), surface.Parameters.begin(), surface.Parameters.end());
      for (const Index id : surface.Elements)
      {
        quads.push_back(first + id);
      }
      values.resize(values.size() + surface.Cells.size(), value);
      directions.resize(values.size(), a);
    }
  }
  SamplePoints(view, parameters, output, execution);
  output->SetPolys(MakeCells(4, quads));

  const Index count = static_cast<Index>(values.size());
  const auto valueArray = MakeArray<vtkDoubleArray>("SurfaceParameter", 1, count);
  const auto directionArray = MakeArray<vtkIntArray>("SurfaceDirection", 1, count);
  std::copy(values.begin(), values.end(), valueArray->GetPointer(0));
  std::copy(directions.begin(), directions.end(), directionArray->GetPointer(0));
  output->GetCellData()->AddArray(directionArray);
  output->GetCellData()->AddArray(valueArray);
}

void FillBezierHexahedra(
  const TSplineView& view, vtkUnstructuredGrid* output, const Execution& execution)
{
  const TSplineModel& model = view.Model;
  const Index cellCount = view.Mesh.Size(), pointCount = cellCount * BezierPoints;
  const int components = model.Spline.Components, stride = components + 1;
  // Coefficients and output at the same time, with two arrays of weights and the connectivity.
  RequireMemory(1.0 * pointCount * sizeof(double) * (2.0 * stride + 2.0));

  std::vector<int> wanted(stride, Denominator);
  for (int c = 0; c < components; ++c)
  {
    wanted[c] = c;
  }
  const std::vector<double> coefficients =
    ExtractBezier(model.Spline, view.Mesh, wanted, execution.Part(0.0, 0.6));

  // The points and attributes are one list of arrays to fill from the list of components.
  std::vector<vtkSmartPointer<vtkDoubleArray>> arrays = { MakeArray<vtkDoubleArray>(
    "Points", 3, pointCount) };
  for (const TSplineAttribute& attribute : model.Attributes)
  {
    arrays.push_back(
      MakeArray<vtkDoubleArray>(attribute.Name.c_str(), attribute.Components, pointCount));
  }
  const auto weights = MakeArray<vtkDoubleArray>("RationalWeights", 1, pointCount);
  const std::array<int, BezierPoints> order = MakePointOrder();
  execution.ParallelFor(cellCount,
    [&coefficients, &arrays, &weights, &order, stride](Index begin, Index end)
    {
      for (Index cell = begin; cell < end; ++cell)
      {
        const double* numerators = &coefficients[cell * stride * BezierPoints];
        const double* denominator = numerators + (stride - 1) * BezierPoints;
        const double smallest =
          SmallestWeight * *std::max_element(denominator, denominator + BezierPoints);
        for (int i = 0; i < BezierPoints; ++i)
        {
          const Index point = cell * BezierPoints + order[i];
          const bool vanishing = denominator[i] <= smallest;
          weights->SetValue(point, vanishing ? smallest : denominator[i]);
          const double* numerator = numerators;
          for (const auto& array : arrays)
          {
            for (int c = 0; c < array->GetNumberOfComponents(); ++c, numerator += BezierPoints)
            {
              array->SetTypedComponent(
                point, c, vanishing ? Mean(numerator, denominator) : numerator[i] / denominator[i]);
            }
          }
        }
      }
    });
  execution.Check(0.8);

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetData(arrays.front());
  output->SetPoints(points);
  vtkPointData* pointData = output->GetPointData();
  for (std::size_t i = 1; i < arrays.size(); ++i)
  {
    pointData->AddArray(arrays[i]);
  }
  pointData->SetRationalWeights(weights);
  const auto plainWeights = MakeArray<vtkDoubleArray>("BezierWeights", 1, pointCount);
  plainWeights->DeepCopy(weights);
  plainWeights->SetName("BezierWeights");
  pointData->AddArray(plainWeights);
  if (!model.Attributes.empty())
  {
    pointData->SetActiveScalars(model.Attributes.front().Name.c_str());
  }

  std::vector<Index> ids(pointCount), cells(cellCount);
  for (Index i = 0; i < pointCount; ++i)
  {
    ids[i] = i;
  }
  std::copy_n(ids.begin(), cellCount, cells.begin());
  output->SetCells(VTK_BEZIER_HEXAHEDRON, MakeCells(BezierPoints, ids));
  AddCellArrays(
    view, cells, [&view](Index cell) { return view.Mesh.Bounds(cell); }, output->GetCellData());
  for (const char* name : { "HigherOrderDegrees", "BezierDegrees" })
  {
    const auto degrees = MakeArray<vtkIntArray>(name, 3, cellCount);
    degrees->Fill(3);
    output->GetCellData()->AddArray(degrees);
  }
  output->GetCellData()->SetActiveHigherOrderDegrees("HigherOrderDegrees");
}
}
