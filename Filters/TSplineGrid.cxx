// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSplineGrid.h"

#include "vtkCellArray.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Array5 = std::vector<Knots5>;

[[noreturn]] void Fail(const std::string& fault)
{
  throw std::invalid_argument(fault);
}

std::string Quoted(const char* name)
{
  return std::string("\"") + name + "\"";
}

//------------------------------------------------------------------------------
// An array of the grid's own point data of n tuples, described as `components` per tuple.
template <typename ArrayT>
typename ArrayT::ValueType* AddArray(
  vtkFieldData* data, const std::string& name, int components, vtkIdType n)
{
  vtkNew<ArrayT> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(n);
  data->AddArray(array);
  return array->GetPointer(0);
}

//------------------------------------------------------------------------------
void CheckTuples(vtkPointSet* grid, vtkDataArray* array, const char* name)
{
  if (array->GetNumberOfTuples() != grid->GetNumberOfPoints())
  {
    Fail("The point array " + Quoted(name) + " has " + std::to_string(array->GetNumberOfTuples()) +
         " tuples for " + std::to_string(grid->GetNumberOfPoints()) + " control points.");
  }
}

//------------------------------------------------------------------------------
// The point array `name`, checked for shape; null when it is missing and may be.
vtkDataArray* FindArray(vtkPointSet* grid, const char* name, int components, bool required)
{
  vtkDataArray* array = grid->GetPointData()->GetArray(name);
  if (!array)
  {
    if (required)
    {
      Fail(std::string("The input is no T-spline grid: it has no point array ") + Quoted(name) +
           ". Use the output of T-Spline Fit or of the T-spline reader.");
    }
    return nullptr;
  }
  CheckTuples(grid, array, name);
  if (array->GetNumberOfComponents() != components)
  {
    Fail("The point array " + Quoted(name) + " has " +
         std::to_string(array->GetNumberOfComponents()) + " components; " +
         std::to_string(components) + " are needed.");
  }
  return array;
}

//------------------------------------------------------------------------------
// Tuples of `array` into rows of numbers at `values`, `stride` apart.
void CopyTuples(vtkDataArray* array, const char* name, double* values, std::size_t stride)
{
  const vtkIdType n = array->GetNumberOfTuples();
  const int components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < n; ++i, values += stride)
  {
    array->GetTuple(i, values);
    if (!std::all_of(values, values + components, [](double x) { return std::isfinite(x); }))
    {
      Fail(std::string("Control point ") + std::to_string(i) + " has a value in " + name +
           " that is not finite.");
    }
  }
}

//------------------------------------------------------------------------------
std::vector<std::int32_t> CopyLabels(vtkPointSet* grid, const char* name)
{
  std::vector<std::int32_t> labels(grid->GetNumberOfPoints(), 0);
  if (vtkDataArray* array = FindArray(grid, name, 1, false))
  {
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      const double label = array->GetComponent(i, 0);
      if (!(std::abs(label) <= std::numeric_limits<std::int32_t>::max()))
      {
        Fail("Control point " + std::to_string(i) + " has the " + name + " " +
             std::to_string(label) + "; a 32-bit integer is needed.");
      }
      labels[i] = static_cast<std::int32_t>(label);
    }
  }
  return labels;
}

//------------------------------------------------------------------------------
// Remembers where values were last found. Local knots repeat the same few values over and over, so
// that most of them need no search.
class RecentValues
{
public:
  /// The slot of a value: its index when it is there, otherwise -1 for the caller to fill.
  std::int32_t& operator[](double value)
  {
    value += 0.0; // one zero only
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof(bits));
    Entry& entry = this->Entries[(bits * 0x9E3779B97F4A7C15ull) >> 52];
    if (entry.Index < 0 || entry.Value != value)
    {
      entry = { value, -1 };
    }
    return entry.Index;
  }

private:
  struct Entry
  {
    double Value = 0.0;
    std::int32_t Index = -1;
  };
  std::array<Entry, 4096> Entries;
};

//------------------------------------------------------------------------------
// Sorted distinct values.
KnotLine CollectKnotLine(const Array5& knots)
{
  KnotLine line;
  RecentValues seen;
  for (const Knots5& local : knots)
  {
    for (const double value : local)
    {
      std::int32_t& slot = seen[value];
      if (slot < 0)
      {
        slot = 0;
        line.push_back(value + 0.0);
      }
    }
  }
  std::sort(line.begin(), line.end());
  line.erase(std::unique(line.begin(), line.end()), line.end());
  return line;
}

//------------------------------------------------------------------------------
// The ends of holes in direction a, with the values for the knot line.
std::vector<std::array<double, 2>> HoleEnds(vtkPointSet* grid, int a)
{
  std::vector<std::array<double, 2>> ends;
  vtkDataArray* holes = grid->GetFieldData()->GetArray("Holes");
  if (!holes)
  {
    return ends;
  }
  if (holes->GetNumberOfComponents() != 6)
  {
    Fail("The field array \"Holes\" has " + std::to_string(holes->GetNumberOfComponents()) +
         " components; 6 are needed.");
  }
  for (vtkIdType i = 0; i < holes->GetNumberOfTuples(); ++i)
  {
    ends.push_back({ holes->GetComponent(i, 2 * a), holes->GetComponent(i, 2 * a + 1) });
    if (!std::isfinite(ends[i][0]) || !std::isfinite(ends[i][1]))
    {
      Fail("Hole " + std::to_string(i) + " has an end that is not finite.");
    }
  }
  return ends;
}

//------------------------------------------------------------------------------
// The local knots of direction a as indices into the line of their distinct values.
void CopyKnots(vtkPointSet* grid, int a, TSpline& spline)
{
  const char* name = TSplineArrayNames[a];
  vtkDataArray* array = FindArray(grid, name, 5, true);
  Array5 knots(grid->GetNumberOfPoints());
  CopyTuples(array, name, knots.data()->data(), 5);
  for (std::size_t i = 0; i < knots.size(); ++i)
  {
    if (!std::is_sorted(knots[i].begin(), knots[i].end()) || knots[i][0] == knots[i][4])
    {
      Fail(std::string("The local knots in ") + name + " of control point " + std::to_string(i) +
           " decrease or are all equal.");
    }
  }
  KnotLine& line = spline.KnotLines[a];
  line = CollectKnotLine(knots);
  const std::vector<std::array<double, 2>> holes = HoleEnds(grid, a);
  for (const auto& ends : holes)
  {
    line.insert(line.end(), ends.begin(), ends.end());
  }
  std::sort(line.begin(), line.end());
  line.erase(std::unique(line.begin(), line.end()), line.end());
  const auto numberOf = [&line](double value)
  {
    return static_cast<std::int32_t>(
      std::lower_bound(line.begin(), line.end(), value) - line.begin());
  };
  spline.Holes.resize(holes.size());
  for (std::size_t h = 0; h < holes.size(); ++h)
  {
    spline.Holes[h].Low[a] = numberOf(holes[h][0]);
    spline.Holes[h].High[a] = numberOf(holes[h][1]);
  }
  RecentValues found;
  for (std::size_t i = 0; i < knots.size(); ++i)
  {
    for (int k = 0; k < 5; ++k)
    {
      std::int32_t& slot = found[knots[i][k]];
      if (slot < 0)
      {
        slot = numberOf(knots[i][k]);
      }
      spline.Functions[i][a][k] = slot;
    }
  }
}

//------------------------------------------------------------------------------
// X, Y, Z and the attributes, with the attributes' names.
void CopyControlPoints(vtkPointSet* grid, TSplineModel& model)
{
  vtkPointData* data = grid->GetPointData();
  std::vector<vtkDataArray*> arrays = { grid->GetPoints()->GetData() };
  int components = 3;
  for (int a = 0; a < data->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = data->GetArray(a);
    const bool real =
      array && (array->GetDataType() == VTK_DOUBLE || array->GetDataType() == VTK_FLOAT);
    const char* name = real ? array->GetName() : nullptr;
    if (!real || (name && IsTSplineArrayName(name)))
    {
      continue;
    }
    if (!name || !*name)
    {
      Fail("A point array has no name, so it cannot be an attribute of the T-spline.");
    }
    CheckTuples(grid, array, name);
    arrays.push_back(array);
    model.Attributes.push_back({ name, array->GetNumberOfComponents() });
    components += array->GetNumberOfComponents();
  }
  TSpline& spline = model.Spline;
  spline.Components = components;
  spline.ControlPoints.resize(spline.Functions.size() * components);
  double* values = spline.ControlPoints.data();
  for (std::size_t a = 0; a < arrays.size(); ++a)
  {
    CopyTuples(arrays[a], a == 0 ? "X, Y, Z" : arrays[a]->GetName(), values, components);
    values += arrays[a]->GetNumberOfComponents();
  }
}
}

//------------------------------------------------------------------------------
void TSplineToGrid(const TSplineModel& model, vtkUnstructuredGrid* grid)
{
  const TSpline& spline = model.Spline;
  const vtkIdType n = spline.Size();
  grid->Initialize();

  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(n);
  auto* positions = static_cast<double*>(points->GetVoidPointer(0));
  for (vtkIdType i = 0; i < n; ++i)
  {
    std::copy_n(spline.ControlPoint(i), 3, positions + 3 * i);
  }
  grid->SetPoints(points);

  vtkNew<vtkIdTypeArray> ids;
  ids->SetNumberOfValues(n);
  std::iota(ids->GetPointer(0), ids->GetPointer(0) + n, vtkIdType(0));
  vtkNew<vtkCellArray> vertices;
  vertices->SetData(1, ids);
  grid->SetCells(VTK_VERTEX, vertices);

  vtkPointData* data = grid->GetPointData();
  int first = 3;
  for (const TSplineAttribute& attribute : model.Attributes)
  {
    double* values = AddArray<vtkDoubleArray>(data, attribute.Name, attribute.Components, n);
    for (vtkIdType i = 0; i < n; ++i, values += attribute.Components)
    {
      std::copy_n(spline.ControlPoint(i) + first, attribute.Components, values);
    }
    first += attribute.Components;
  }
  for (int a = 0; a < 3; ++a)
  {
    double* values = AddArray<vtkDoubleArray>(data, TSplineArrayNames[a], 5, n);
    for (vtkIdType i = 0; i < n; ++i, values += 5)
    {
      const Knots5 knots = spline.LocalKnotValues(i, a);
      std::copy(knots.begin(), knots.end(), values);
    }
  }
  std::copy(
    spline.Weights.begin(), spline.Weights.end(), AddArray<vtkDoubleArray>(data, "Weight", 1, n));
  std::copy(
    model.Segment.begin(), model.Segment.end(), AddArray<vtkIntArray>(data, "Segment", 1, n));
  std::copy(model.Block.begin(), model.Block.end(), AddArray<vtkIntArray>(data, "Block", 1, n));
  if (model.RootCells[0] > 0)
  {
    std::copy(model.RootCells.begin(), model.RootCells.end(),
      AddArray<vtkIntArray>(grid->GetFieldData(), "RootCells", 3, 1));
  }
  if (!spline.Holes.empty())
  {
    double* ends = AddArray<vtkDoubleArray>(
      grid->GetFieldData(), "Holes", 6, static_cast<vtkIdType>(spline.Holes.size()));
    for (const IndexBox& hole : spline.Holes)
    {
      for (int a = 0; a < 3; ++a)
      {
        *ends++ = spline.KnotLines[a][hole.Low[a]];
        *ends++ = spline.KnotLines[a][hole.High[a]];
      }
    }
  }
}

//------------------------------------------------------------------------------
TSplineModel TSplineFromGrid(vtkPointSet* grid)
{
  const vtkIdType n = grid->GetNumberOfPoints();
  if (n == 0)
  {
    Fail("The T-spline grid has no control points.");
  }
  TSplineModel model;
  TSpline& spline = model.Spline;
  spline.Functions.resize(n);
  for (int a = 0; a < 3; ++a)
  {
    CopyKnots(grid, a, spline);
  }
  vtkDataArray* weights = FindArray(grid, "Weight", 1, true);
  spline.Weights.resize(n);
  CopyTuples(weights, "Weight", spline.Weights.data(), 1);
  CopyControlPoints(grid, model);
  model.Segment = CopyLabels(grid, "Segment");
  model.Block = CopyLabels(grid, "Block");
  vtkDataArray* rootCells = grid->GetFieldData()->GetArray("RootCells");
  if (rootCells && rootCells->GetNumberOfComponents() == 3 && rootCells->GetNumberOfTuples() > 0)
  {
    for (int a = 0; a < 3; ++a)
    {
      model.RootCells[a] = static_cast<std::int32_t>(rootCells->GetComponent(0, a));
    }
  }
  const std::string fault = Validate(model);
  if (!fault.empty())
  {
    Fail(fault);
  }
  return model;
}
}
