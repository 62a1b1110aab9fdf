// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryDistance.h"

#include "TSpline/BezierMesh.h"
#include "TSpline/Evaluator.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkGenericCell.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <set>

namespace trivariate
{
namespace
{
constexpr int Cuts = 4;                               // of a face along each edge
constexpr int Side = Cuts + 1, PerFace = Side * Side; // points
constexpr Index PointsAtATime = 4096;
constexpr double GlueTolerance = 1e-9; // as a share of the spline's size

struct Face
{
  Index Cell;
  int Axis, End;
};

// The faces without a cell on the other side in parameter space.
std::vector<Face> FreeFaces(const BezierMesh& mesh)
{
  std::vector<Face> faces;
  for (Index cell = 0; cell < mesh.Size(); ++cell)
  {
    const auto b = mesh.Bounds(cell);
    for (int axis = 0; axis < 3; ++axis)
    {
      for (int end = 0; end < 2; ++end)
      {
        double x[3];
        for (int a = 0; a < 3; ++a)
        {
          x[a] = 0.5 * (b[2 * a] + b[2 * a + 1]);
        }
        // The next number across the face.
        const double infinity = std::numeric_limits<double>::infinity();
        x[axis] = std::nextafter(b[2 * axis + end], end == 0 ? -infinity : infinity);
        if (mesh.FindCell(x[0], x[1], x[2]) < 0)
        {
          faces.push_back({ cell, axis, end });
        }
      }
    }
  }
  return faces;
}

// A lattice of points on each face, the faces' first tangential axis fastest.
std::vector<double> ParametersOn(const BezierMesh& mesh, const std::vector<Face>& faces)
{
  std::vector<double> parameters;
  parameters.reserve(3 * PerFace * faces.size());
  for (const Face& face : faces)
  {
    const auto b = mesh.Bounds(face.Cell);
    const int s = face.Axis == 0 ? 1 : 0, t = face.Axis == 2 ? 1 : 2;
    for (int j = 0; j < Side; ++j)
    {
      for (int i = 0; i < Side; ++i)
      {
        double x[3];
        const auto at = [&b](int a, int n)
        { return n == Cuts ? b[2 * a + 1] : b[2 * a] + n * (b[2 * a + 1] - b[2 * a]) / Cuts; };
        x[face.Axis] = b[2 * face.Axis + face.End];
        x[s] = at(s, i);
        x[t] = at(t, j);
        parameters.insert(parameters.end(), x, x + 3);
      }
    }
  }
  return parameters;
}

// Five points of a unit square in the plane of each face: corners and middle of the square that
// holds the middle of the face. Blocks are unit boxes, so this is a face of a block.
constexpr int Marks = 5;

std::vector<double> MarksOf(const BezierMesh& mesh, const std::vector<Face>& faces)
{
  constexpr double Shares[Marks][2] = { { 0, 0 }, { 1, 0 }, { 0, 1 }, { 1, 1 }, { 0.5, 0.5 } };
  std::vector<double> marks;
  for (const Face& face : faces)
  {
    const auto b = mesh.Bounds(face.Cell);
    const int s = face.Axis == 0 ? 1 : 0, t = face.Axis == 2 ? 1 : 2;
    for (const auto& share : Shares)
    {
      double x[3];
      x[face.Axis] = b[2 * face.Axis + face.End];
      x[s] = std::floor(0.5 * (b[2 * s] + b[2 * s + 1])) + share[0];
      x[t] = std::floor(0.5 * (b[2 * t] + b[2 * t + 1])) + share[1];
      marks.insert(marks.end(), x, x + 3);
    }
  }
  return marks;
}

// What two faces of blocks that are glued to each other have in common, however they are turned.
using GlueKey = std::array<std::array<long long, 3>, Marks>;

GlueKey KeyOf(const double* places, double tolerance)
{
  GlueKey key;
  for (int m = 0; m < Marks; ++m)
  {
    for (int a = 0; a < 3; ++a)
    {
      // Shifted, so that shares of the size such as 1/1024 are not where rounding decides.
      key[m][a] = std::llround(places[3 * m + a] / tolerance + 0.37);
    }
  }
  std::sort(key.begin(), key.end() - 1);
  return key;
}

// Which of the faces lie on a face of a block that is glued to another one.
std::vector<char> FindGlued(
  const Evaluator& geometry, const std::vector<Face>& faces, const Execution& execution)
{
  const BezierMesh& mesh = geometry.Mesh();
  const std::vector<double> marks = MarksOf(mesh, faces);
  std::vector<double> places(marks.size());
  std::vector<std::uint8_t> inside(marks.size() / 3);
  EvaluatorOutput output;
  output.Values = places.data();
  output.Inside = inside.data();
  geometry.Evaluate(static_cast<Index>(inside.size()), marks.data(), output, execution);
  std::vector<char> glued(faces.size(), 0);
  double size = 1e-300;
  for (const double x : places)
  {
    size = std::max(size, std::abs(x));
  }
  // Where the squares of both sides are: the same square twice is only one.
  std::map<GlueKey, std::set<std::array<double, 3>>> squares;
  for (const bool collecting : { true, false })
  {
    for (std::size_t f = 0; f < faces.size(); ++f)
    {
      const std::uint8_t* in = &inside[Marks * f];
      if (!std::all_of(in, in + Marks, [](std::uint8_t i) { return i != 0; }))
      {
        continue; // the domain is not made of unit boxes
      }
      auto& square = squares[KeyOf(&places[3 * Marks * f], size * GlueTolerance)];
      if (collecting)
      {
        const double* middle = &marks[3 * (Marks * f + Marks - 1)];
        square.insert({ middle[0], middle[1], middle[2] });
      }
      else if (square.size() > 1)
      {
        glued[f] = 1;
      }
    }
  }
  return glued;
}

vtkSmartPointer<vtkPolyData> ToPolyData(const TriangleList& list)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  points->SetNumberOfPoints(static_cast<vtkIdType>(list.Points.size() / 3));
  for (vtkIdType i = 0; i < points->GetNumberOfPoints(); ++i)
  {
    points->SetPoint(i, &list.Points[3 * i]);
  }
  vtkNew<vtkCellArray> cells;
  for (std::size_t t = 0; t < list.Triangles.size(); t += 3)
  {
    const vtkIdType ids[3] = { list.Triangles[t], list.Triangles[t + 1], list.Triangles[t + 2] };
    cells->InsertNextCell(3, ids);
  }
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(cells);
  return surface;
}

// The largest distance of a point of `from` from `to`.
double FarthestPoint(const TriangleList& from, const TriangleList& to, const Execution& execution)
{
  const vtkSmartPointer<vtkPolyData> target = ToPolyData(to);
  vtkNew<vtkStaticCellLocator> locator;
  locator->SetDataSet(target);
  locator->BuildLocator();
  const Index count = static_cast<Index>(from.Points.size() / 3);
  std::vector<double> squares(count);
  for (Index begin = 0; begin < count; begin += PointsAtATime)
  {
    execution.Check(1.0 * begin / count);
    execution.ParallelFor(std::min(PointsAtATime, count - begin),
      [&from, &squares, &locator, begin](Index first, Index last)
      {
        vtkNew<vtkGenericCell> cell;
        for (Index i = begin + first; i < begin + last; ++i)
        {
          double foot[3];
          vtkIdType triangle;
          int sub;
          locator->FindClosestPoint(&from.Points[3 * i], foot, cell, triangle, sub, squares[i]);
        }
      });
  }
  return std::sqrt(*std::max_element(squares.begin(), squares.end()));
}
}

//------------------------------------------------------------------------------
TriangleList SplineBoundary(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution)
{
  const std::vector<Face> faces = FreeFaces(mesh);
  const std::vector<double> parameters = ParametersOn(mesh, faces);
  std::vector<double> points(parameters.size());
  const Evaluator geometry(spline, mesh, { 0, 1, 2 }, execution.Part(0.0, 0.5));
  EvaluatorOutput output;
  output.Values = points.data();
  geometry.Evaluate(
    static_cast<Index>(parameters.size() / 3), parameters.data(), output, execution.Part(0.5, 0.8));

  const std::vector<char> glued = FindGlued(geometry, faces, execution.Part(0.8, 1.0));
  TriangleList surface;
  for (std::size_t f = 0; f < faces.size(); ++f)
  {
    if (glued[f])
    {
      continue;
    }
    const Index first = static_cast<Index>(surface.Points.size() / 3);
    const auto own = points.begin() + 3 * PerFace * f;
    surface.Points.insert(surface.Points.end(), own, own + 3 * PerFace);
    for (int n = 0; n < Cuts * Cuts; ++n)
    {
      const Index p = first + n % Cuts + Side * (n / Cuts);
      for (const Index corner : { p, p + 1, p + Side + 1, p, p + Side + 1, p + Side })
      {
        surface.Triangles.push_back(corner);
      }
    }
  }
  return surface;
}

//------------------------------------------------------------------------------
TriangleList SegmentTriangles(vtkPolyData* surface, int segment)
{
  TriangleList list;
  vtkDataArray* labels = surface->GetCellData()->GetArray("BoundaryLabels");
  std::map<vtkIdType, Index> numbers;
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    if (labels && labels->GetComponent(cell, 0) != segment &&
        labels->GetComponent(cell, 1) != segment)
    {
      continue;
    }
    surface->GetCellPoints(cell, points);
    for (vtkIdType corner = 2; corner < points->GetNumberOfIds(); ++corner)
    {
      for (const vtkIdType i : { vtkIdType(0), corner - 1, corner })
      {
        const vtkIdType point = points->GetId(i);
        const auto [known, isNew] = numbers.emplace(point, list.Points.size() / 3);
        if (isNew)
        {
          double x[3];
          surface->GetPoint(point, x);
          list.Points.insert(list.Points.end(), x, x + 3);
        }
        list.Triangles.push_back(known->second);
      }
    }
  }
  return list;
}

//------------------------------------------------------------------------------
double HausdorffDistance(const TriangleList& a, const TriangleList& b, const Execution& execution)
{
  if (a.Triangles.empty() || b.Triangles.empty())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  return std::max(
    FarthestPoint(a, b, execution.Part(0.0, 0.5)), FarthestPoint(b, a, execution.Part(0.5, 1.0)));
}
}
