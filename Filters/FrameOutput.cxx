// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FrameOutput.h"

#include "CutToExtent.h"
#include "LabelledImage.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"

#include <algorithm>

namespace trivariate
{
namespace
{
const char* const FrameNames[3] = { "FrameU", "FrameV", "FrameW" };

template <typename ArrayT>
void AddColumn(vtkTable* table, const char* name)
{
  vtkNew<ArrayT> column;
  column->SetName(name);
  table->AddColumn(column);
}

// A row of numbers, which the columns hold exactly.
void AddRow(vtkTable* table, std::initializer_list<double> values)
{
  vtkIdType column = 0;
  for (const double value : values)
  {
    vtkDataArray::SafeDownCast(table->GetColumn(column++))->InsertNextTuple1(value);
  }
}
}

//------------------------------------------------------------------------------
FrameOutput::FrameOutput(const LabelledImage& image)
  : Extent(image.Extent)
{
  for (int axis = 0; axis < 3; ++axis)
  {
    vtkFloatArray* array = this->Frames[axis];
    array->SetName(FrameNames[axis]);
    array->SetNumberOfComponents(3);
    array->SetNumberOfTuples(static_cast<vtkIdType>(image.Labels.size()));
    array->Fill(0.0);
  }
  for (const char* name : { "Segment", "Level", "Sweep" })
  {
    AddColumn<vtkIntArray>(this->Sweeps, name);
  }
  for (const char* name : { "HarmonicEnergy", "RegisteredEnergy" })
  {
    AddColumn<vtkDoubleArray>(this->Sweeps, name);
  }
  for (const char* name : { "FrameSegment", "FrameVoxels", "FrameSingularPlaquettes" })
  {
    AddColumn<vtkIdTypeArray>(this->Fields, name);
  }
  for (const char* name : { "FrameEnergy", "FrameAlignmentError" })
  {
    AddColumn<vtkDoubleArray>(this->Fields, name);
  }
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  this->Graph->SetPoints(points);
  vtkNew<vtkCellArray> lines;
  this->Graph->SetLines(lines);
  vtkNew<vtkIntArray> owner;
  owner->SetName("Segment");
  this->Graph->GetCellData()->AddArray(owner);
}

//------------------------------------------------------------------------------
void FrameOutput::Add(int segment, const SegmentField& field, const LabelledImage& image)
{
  for (Index v = 0; v < field.Voxels.Count(); ++v)
  {
    const Eigen::Matrix3f frame = field.Frames[v].toRotationMatrix();
    for (int axis = 0; axis < 3; ++axis)
    {
      Eigen::Map<Eigen::RowVector3f>(this->Frames[axis]->GetPointer(3 * field.Voxels.Ids[v])) =
        frame.row(axis);
    }
  }
  for (const SweepRecord& record : field.Records)
  {
    AddRow(this->Sweeps, { double(segment), double(record.Level), double(record.Sweep),
                           record.Energy.Harmonic, record.Energy.Registered });
  }
  AddRow(
    this->Fields, { double(segment), double(field.Voxels.Count()), double(field.Graph.Edges.size()),
                    field.Records.back().Energy.Harmonic, field.Alignment });

  const vtkIdType begin = this->Graph->GetNumberOfPoints();
  for (const std::array<double, 3>& point : field.Graph.Points)
  {
    this->Graph->GetPoints()->InsertNextPoint(image.ToPhysical(point).data());
  }
  vtkDataArray* owner = this->Graph->GetCellData()->GetArray("Segment");
  for (const std::vector<Index>& line : field.Graph.Lines)
  {
    this->Graph->GetLines()->InsertNextCell(static_cast<int>(line.size()));
    for (const Index point : line)
    {
      this->Graph->GetLines()->InsertCellPoint(begin + static_cast<vtkIdType>(point));
    }
    owner->InsertNextTuple1(segment);
  }
}

//------------------------------------------------------------------------------
void FrameOutput::Share(vtkMultiProcessController* controller)
{
  controller->Broadcast(this->Extent.data(), 6, 0);
  vtkIdType count = this->Frames[0]->GetNumberOfTuples();
  controller->Broadcast(&count, 1, 0);
  for (const auto& array : this->Frames)
  {
    array->SetNumberOfTuples(count);
    controller->Broadcast(array->GetPointer(0), 3 * count, 0);
  }
}

//------------------------------------------------------------------------------
void FrameOutput::AddTo(vtkImageData* image) const
{
  int extent[6];
  image->GetExtent(extent);
  const bool isWhole = std::equal(extent, extent + 6, this->Extent.begin());
  for (const auto& array : this->Frames)
  {
    if (isWhole)
    {
      image->GetPointData()->AddArray(array);
    }
    else
    {
      image->GetPointData()->AddArray(CutToExtent(array, this->Extent.data(), extent));
    }
  }
  for (vtkIdType column = 0; column < this->Fields->GetNumberOfColumns(); ++column)
  {
    image->GetFieldData()->AddArray(this->Fields->GetColumn(column));
  }
}
}
