// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FittedPart.h"

#include "ChainStep.h"
#include "TSplineGrid.h"
#include "vtkTSplineFit.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <cmath>

namespace trivariate
{
//------------------------------------------------------------------------------
FittedPart RunFit(vtkTSplineFit* fit, const char* mask, const std::string& step,
  const SegmentFitOptions& options, Chain& chain, double from, double to)
{
  fit->SetController(nullptr);
  fit->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, options.Array.c_str());
  fit->SetMaskArray(mask);
  for (const std::string& name : options.Further)
  {
    fit->AddAttribute(name.c_str());
  }
  fit->SetMaximumNumberOfControlPoints(options.MaximumControlPoints);
  fit->SetRMSTolerance(options.RmsTolerance);
  fit->SetLargestShapeDistance(options.LargestShapeDistance);
  ChainStep(fit, chain, from, to, step).Run();
  FittedPart part;
  part.Model = TSplineFromGrid(fit->GetOutput());
  part.Rounds = vtkTable::SafeDownCast(fit->GetOutputDataObject(1));
  return part;
}

//------------------------------------------------------------------------------
FittedPart FitOverBox(const Cut& cut, const Part& part, const SegmentFitOptions& options,
  Chain& chain, double from, double to)
{
  vtkNew<vtkTSplineFit> fit;
  fit->SetInputData(cut.Image);
  FittedPart fitted = RunFit(fit, CutMaskName, "FitOverBox", options, chain, from, to);
  fitted.Model.Segment.assign(fitted.Model.Spline.Size(), part.Label);
  fitted.Together = part.Label;
  fitted.Range = part.High - part.Low;
  // Its geometry is affine: the error of the round trip is that of the fit.
  fitted.Squares = SquaresOf(fitted, static_cast<double>(cut.Voxels.size()));
  return fitted;
}

namespace
{
//------------------------------------------------------------------------------
vtkVariant LastOf(vtkTable* rounds, const char* column)
{
  return rounds->GetValueByName(rounds->GetNumberOfRows() - 1, column);
}

//------------------------------------------------------------------------------
// The error of a segment's own voxels, and over what it was fitted.
struct OwnFit
{
  double Rms;
  std::string Domain; ///< SegmentBox, Cubes or LayeredCubes
};

// What a fit over cubes tells of the segment; that over its box is of all voxels.
OwnFit OwnFitOf(vtkTable* rounds, int segment)
{
  vtkFieldData* told = rounds->GetFieldData();
  vtkDataArray* segments = told->GetArray("FittedSegment");
  for (vtkIdType i = 0; segments && i < segments->GetNumberOfTuples(); ++i)
  {
    if (static_cast<int>(segments->GetTuple1(i)) == segment)
    {
      return { told->GetArray("FittedSegmentRMS")->GetTuple1(i),
        told->GetAbstractArray("FittedDomain")->GetVariantValue(i).ToString() };
    }
  }
  return { LastRms(rounds), "SegmentBox" };
}

// Appends to a column; a new one goes into the table with its rows, of which all have as many.
template <typename ArrayT, typename Value>
void AddColumn(vtkTable* all, const char* name, vtkIdType rows, const Value& value)
{
  vtkSmartPointer<ArrayT> column = ArrayT::SafeDownCast(all->GetColumnByName(name));
  const bool isNew = !column;
  if (isNew)
  {
    column = vtkSmartPointer<ArrayT>::New();
    column->SetName(name);
  }
  for (vtkIdType row = 0; row < rows; ++row)
  {
    column->InsertNextValue(value(row));
  }
  if (isNew)
  {
    all->AddColumn(column);
  }
}
}

//------------------------------------------------------------------------------
double SquaresOf(const FittedPart& part, double voxels)
{
  const double rms = part.Range > 0.0 ? LastRms(part.Rounds) / 100.0 * part.Range : 0.0;
  return rms * rms * voxels;
}

//------------------------------------------------------------------------------
double LastRms(vtkTable* rounds)
{
  return LastOf(rounds, "RMS").ToDouble();
}

//------------------------------------------------------------------------------
vtkIdType LastControlPoints(vtkTable* rounds)
{
  return LastOf(rounds, "ControlPoints").ToTypeInt64();
}

//------------------------------------------------------------------------------
double RmsWith(vtkTable* rounds, double controlPoints)
{
  double from = 0.0, above = 0.0; // the round before: its control points, its error
  for (vtkIdType row = 0; row < rounds->GetNumberOfRows(); ++row)
  {
    const double to = rounds->GetValueByName(row, "ControlPoints").ToDouble();
    const double below = rounds->GetValueByName(row, "RMS").ToDouble();
    if (to >= controlPoints)
    {
      const bool isBetween = from > 0.0 && from < controlPoints && above > 0.0 && below > 0.0;
      return isBetween ? above * std::pow(below / above,
                                   std::log(controlPoints / from) / std::log(to / from))
                       : below;
    }
    from = to;
    above = below;
  }
  return above;
}

//------------------------------------------------------------------------------
void AddRounds(const FittedPart& fitted, int segment, bool isSingle, vtkTable* all)
{
  vtkTable* own = fitted.Rounds;
  const vtkIdType rows = own->GetNumberOfRows();
  const OwnFit fit = OwnFitOf(own, segment);
  const double rms = isSingle ? fit.Rms : std::nan("");
  vtkDataArray* jumps = own->GetFieldData()->GetArray("GradientJump");
  const double jump = jumps ? jumps->GetComponent(0, 0) : 0.0; // a box has no faces inside
  AddColumn<vtkIntArray>(all, "Segment", rows, [=](vtkIdType) { return segment; });
  AddColumn<vtkIntArray>(all, "Together", rows, [&](vtkIdType) { return fitted.Together; });
  AddColumn<vtkIdTypeArray>(all, "ControlPoints", rows,
    [own](vtkIdType row) { return own->GetValueByName(row, "ControlPoints").ToTypeInt64(); });
  for (const char* name : { "RMS", "MaximumError", "Seconds" })
  {
    AddColumn<vtkDoubleArray>(all, name, rows,
      [own, name](vtkIdType row) { return own->GetValueByName(row, name).ToDouble(); });
  }
  AddColumn<vtkDoubleArray>(all, "Range", rows, [&](vtkIdType) { return fitted.Range; });
  AddColumn<vtkDoubleArray>(all, "SegmentRMS", rows, [=](vtkIdType) { return rms; });
  AddColumn<vtkDoubleArray>(all, "GradientJump", rows, [=](vtkIdType) { return jump; });
  AddColumn<vtkStringArray>(all, "Domain", rows, [&](vtkIdType) { return fit.Domain; });
}
}
