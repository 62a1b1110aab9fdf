// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SplineFacts.h"

#include "BoundaryDistance.h"
#include "File/TSplineFileWriter.h"
#include "SegmentReport.h"
#include "TSpline/BezierMesh.h"
#include "TSpline/Evaluator.h"
#include "TSpline/JacobianRange.h"

#include "vtkAbstractArray.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkMatrix4x4.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <vector>

namespace trivariate
{
namespace
{
constexpr int FileCompression = 5; // the writer's default

//------------------------------------------------------------------------------
// Equal control points, which glued blocks share, once.
double CountDistinct(const TSpline& spline)
{
  std::set<std::vector<double>> rows;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    rows.emplace(spline.ControlPoint(i), spline.ControlPoint(i) + spline.Components);
  }
  return static_cast<double>(rows.size());
}

// In units of voxels.
void ToIndices(const ImageSamples& image, TriangleList& surface)
{
  vtkNew<vtkMatrix4x4> toIndices;
  vtkMatrix4x4::Invert(image.IndexToPhysical.data(), toIndices->GetData());
  for (std::size_t i = 0; i < surface.Points.size(); i += 3)
  {
    double* p = &surface.Points[i];
    const double x[4] = { p[0], p[1], p[2], 1.0 };
    double index[4];
    toIndices->MultiplyPoint(x, index);
    std::copy_n(index, 3, p);
  }
}

// A right-handed spline in an image whose indices are a left hand has negative determinants.
TSpline InHandednessOf(const ImageSamples& image, TSpline spline)
{
  const auto& m = image.IndexToPhysical;
  const double linear[9] = { m[0], m[1], m[2], m[4], m[5], m[6], m[8], m[9], m[10] };
  for (Index i = 0; JacobianDeterminant(linear) < 0.0 && i < spline.Size(); ++i)
  {
    spline.ControlPoint(i)[0] *= -1.0;
  }
  return spline;
}

//------------------------------------------------------------------------------
LastRound LastRoundOverDomain(vtkFieldData* field, int segment, int component)
{
  LastRound last;
  vtkDataArray* segments = field->GetArray("FittedSegment");
  vtkDataArray* errors = field->GetArray("FittedSegmentRMS");
  vtkDataArray* ranges = field->GetArray("FittedRange");
  vtkDataArray* jump = field->GetArray("GradientJump");
  vtkAbstractArray* domains = field->GetAbstractArray("FittedDomain");
  const bool isTold =
    segments && errors && ranges && jump && component < ranges->GetNumberOfComponents();
  for (vtkIdType i = 0; isTold && i < segments->GetNumberOfTuples(); ++i)
  {
    if (static_cast<int>(segments->GetTuple1(i)) == segment)
    {
      const double range = ranges->GetComponent(0, component);
      last.Domain = domains ? domains->GetVariantValue(i).ToString() : "";
      last.Rms = errors->GetTuple1(i) / 100.0 * range;
      last.GradientJump = jump->GetComponent(0, 0) * range;
    }
  }
  return last;
}

template <typename Choose>
void Merge(double& mine, double other, const Choose& choose)
{
  mine = std::isnan(mine) ? other : std::isnan(other) ? mine : choose(mine, other);
}
}

//------------------------------------------------------------------------------
void SplineFacts::Add(const SplineFacts& other)
{
  const auto sum = [](double a, double b) { return a + b; };
  this->Affine = other.Affine;
  Merge(this->ControlPoints, other.ControlPoints, sum);
  Merge(this->DistinctControlPoints, other.DistinctControlPoints, sum);
  Merge(this->NumbersStored, other.NumbersStored, sum);
  Merge(this->Blocks, other.Blocks, sum);
  Merge(this->Bytes, other.Bytes, sum);
  Merge(this->MinimumScaledJacobian, other.MinimumScaledJacobian,
    [](double a, double b) { return std::min(a, b); });
  Merge(this->InvertedCells, other.InvertedCells, sum);
  const auto largest = [](double a, double b) { return std::max(a, b); };
  Merge(this->Hausdorff, other.Hausdorff, largest);
  Merge(this->GradientJump, other.GradientJump, largest);
}

//------------------------------------------------------------------------------
double StoredBytes(const TSplineModel& model, const Execution& execution)
{
  return static_cast<double>(TSplineFileImage(model, FileCompression, execution).size());
}

//------------------------------------------------------------------------------
double CountCorners(vtkPolyData* surface, const std::set<int>& segments)
{
  vtkDataArray* corners = surface ? surface->GetPointData()->GetArray("CornerId") : nullptr;
  if (!corners || segments.empty())
  {
    return SplineFacts::NaN;
  }
  vtkDataArray* owners = surface->GetCellData()->GetArray("Segment");
  std::set<double> ids;
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    if (owners && segments.count(static_cast<int>(owners->GetTuple1(cell))) == 0)
    {
      continue;
    }
    surface->GetCellPoints(cell, points);
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      ids.insert(corners->GetTuple1(points->GetId(i)));
    }
  }
  ids.erase(-1.0);
  return static_cast<double>(ids.size());
}

//------------------------------------------------------------------------------
double SecondsOf(vtkTable* rounds, int segment)
{
  const auto columnOf = [rounds](const char* name)
  { return rounds ? vtkDataArray::SafeDownCast(rounds->GetColumnByName(name)) : nullptr; };
  vtkDataArray* seconds = columnOf("Seconds");
  vtkDataArray* segments = columnOf("Segment");
  vtkDataArray* together = columnOf("Together");
  std::map<double, double> last;
  for (vtkIdType row = 0; seconds && row < rounds->GetNumberOfRows(); ++row)
  {
    // The time of a fit of several counts once.
    const double own = segments ? segments->GetTuple1(row) : AllSegments;
    const bool isFirst = !together || together->GetTuple1(row) == own;
    if (segment != AllSegments || isFirst)
    {
      last[own] = seconds->GetTuple1(row);
    }
  }
  double sum = 0.0;
  bool known = false;
  for (const auto& [s, value] : last)
  {
    if (segment == AllSegments || s == segment)
    {
      sum += value;
      known = true;
    }
  }
  return known ? sum : SplineFacts::NaN;
}

//------------------------------------------------------------------------------
LastRound LastRoundOf(vtkTable* rounds, int segment, int component)
{
  LastRound last =
    rounds ? LastRoundOverDomain(rounds->GetFieldData(), segment, component) : LastRound();
  const bool isTold = rounds && rounds->GetColumnByName("Segment") &&
                      rounds->GetColumnByName("Domain") && rounds->GetColumnByName("Range");
  for (vtkIdType row = 0; isTold && row < rounds->GetNumberOfRows(); ++row)
  {
    if (rounds->GetValueByName(row, "Segment").ToInt() == segment)
    {
      last.Domain = rounds->GetValueByName(row, "Domain").ToString();
      const double range = rounds->GetValueByName(row, "Range").ToDouble();
      const char* rms = rounds->GetColumnByName("SegmentRMS") ? "SegmentRMS" : "RMS";
      last.Rms = rounds->GetValueByName(row, rms).ToDouble() / 100.0 * range;
      last.GradientJump = rounds->GetColumnByName("GradientJump")
                            ? rounds->GetValueByName(row, "GradientJump").ToDouble() * range
                            : SplineFacts::NaN;
    }
  }
  return last;
}

//------------------------------------------------------------------------------
SplineFacts DescribeSpline(const TSplineModel& part, const BezierMesh& mesh, int segment,
  const ReportInput& input, const Execution& execution)
{
  SplineFacts facts;
  facts.ControlPoints = static_cast<double>(part.Spline.Size());
  facts.Blocks = static_cast<double>(std::set(part.Block.begin(), part.Block.end()).size());
  facts.Bytes = StoredBytes(part, execution.Part(0.0, 0.2));
  const JacobianRange jacobian =
    MeasureJacobian(InHandednessOf(input.Image, part.Spline), mesh, execution.Part(0.2, 0.6));
  facts.MinimumScaledJacobian = jacobian.Minimum;
  facts.InvertedCells = static_cast<double>(jacobian.Inverted);
  facts.Affine = jacobian.Constant && facts.Blocks == 1.0;
  const double distinct = CountDistinct(part.Spline);
  facts.DistinctControlPoints = distinct;
  const int components = part.Spline.Components; // X, Y, Z and the attributes
  facts.NumbersStored = facts.Affine ? 12.0 + distinct * (components - 3) : distinct * components;
  // The box that an image's index space is has no boundary in common with a segment.
  if (input.Surfaces && !facts.Affine)
  {
    TriangleList surface = SegmentTriangles(input.Surfaces, segment);
    TriangleList boundary = SplineBoundary(part.Spline, mesh, execution.Part(0.6, 0.7));
    ToIndices(input.Image, surface);
    ToIndices(input.Image, boundary);
    facts.Hausdorff = HausdorffDistance(surface, boundary, execution.Part(0.7, 1.0));
  }
  return facts;
}
}
