// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainOutput.h"

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkSignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace trivariate
{
namespace
{
template <typename ArrayT>
vtkNew<ArrayT> Named(const char* name, int components = 1)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}

vtkNew<vtkPoints> DoublePoints()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  return points;
}

// Where the points, corners and patches of a surface begin in the output; -1: not there yet.
struct Bases
{
  vtkIdType Point = -1;
  int Corner = 0, Patch = 0;
};

class Writer
{
public:
  Writer(const LabelledSurface& surface, const DomainSet& domains)
    : Surface(surface)
    , Domains(domains)
    , Begin(domains.Surfaces.size())
  {
    for (const BlocksOfSegment& segment : domains.Segments)
    {
      this->Number(segment.Outer);
      if (segment.Inner >= 0)
      {
        this->Number(segment.Inner);
      }
    }
  }

  void Patches(vtkPolyData* output) const;
  void Polycubes(const std::vector<Eigen::Vector3d>& picked, vtkUnstructuredGrid* output) const;
  void Borders(vtkPolyData* output) const;

private:
  void Number(Index surface)
  {
    if (this->Begin[surface].Point < 0)
    {
      this->Begin[surface] = this->End;
      this->Order.push_back(surface);
      const SurfaceLayout& layout = this->Domains.Surfaces[surface].Domain.Layout;
      this->End.Point += static_cast<vtkIdType>(layout.Points.size());
      this->End.Corner += static_cast<int>(layout.Corners.size());
      this->End.Patch += static_cast<int>(layout.PatchLabels.size());
    }
  }

  const LabelledSurface& Surface;
  const DomainSet& Domains;
  std::vector<Bases> Begin;
  Bases End{ 0, 0, 0 };
  std::vector<Index> Order; // surfaces that segments have
};

//------------------------------------------------------------------------------
void Writer::Patches(vtkPolyData* output) const
{
  const vtkNew<vtkPoints> points = DoublePoints();
  const auto cornerId = Named<vtkIntArray>("CornerId");
  for (const Index number : this->Order)
  {
    const SurfaceLayout& layout = this->Domains.Surfaces[number].Domain.Layout;
    const vtkIdType begin = points->GetNumberOfPoints();
    for (const Eigen::Vector3d& point : layout.Points)
    {
      points->InsertNextPoint(point.data());
      cornerId->InsertNextValue(-1);
    }
    for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
    {
      cornerId->SetValue(
        begin + layout.Corners[corner], this->Begin[number].Corner + static_cast<int>(corner));
    }
  }

  vtkNew<vtkCellArray> cells;
  const auto patch = Named<vtkIntArray>("Patch");
  const auto axis = Named<vtkSignedCharArray>("PatchAxis");
  const auto side = Named<vtkSignedCharArray>("PatchSide");
  const auto owner = Named<vtkIntArray>("Segment");
  const auto labels = Named<vtkIntArray>("BoundaryLabels", 2);
  const auto append = [&](Index number, int segment, bool inner)
  {
    const DomainSurface& surface = this->Domains.Surfaces[number];
    const SurfaceLayout& layout = surface.Domain.Layout;
    const Bases& begin = this->Begin[number];
    for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
    {
      const Triangle& c = layout.Triangles[t];
      const vtkIdType ids[3] = { begin.Point + c[0], begin.Point + c[inner ? 2 : 1],
        begin.Point + c[inner ? 1 : 2] };
      cells->InsertNextCell(3, ids);
      const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
      patch->InsertNextValue(begin.Patch + static_cast<int>(layout.Patches[t]));
      axis->InsertNextValue(static_cast<signed char>(label / 2));
      side->InsertNextValue(static_cast<signed char>(inner ? 1 - label % 2 : label % 2));
      owner->InsertNextValue(segment);
      std::array<int, 2> sides = this->Surface.Labels[surface.Origins[layout.Origins[t]]];
      if (sides[0] != segment)
      {
        std::swap(sides[0], sides[1]);
      }
      labels->InsertNextTypedTuple(sides.data());
    }
  };
  for (const BlocksOfSegment& segment : this->Domains.Segments)
  {
    append(segment.Outer, segment.Segment, false);
    if (segment.Inner >= 0)
    {
      append(segment.Inner, segment.Segment, true);
    }
  }
  output->SetPoints(points);
  output->SetPolys(cells);
  output->GetPointData()->AddArray(cornerId);
  output->GetCellData()->SetScalars(patch); // ParaView's first choice for colors
  vtkDataArray* const arrays[] = { axis, side, owner, labels };
  for (vtkDataArray* array : arrays)
  {
    output->GetCellData()->AddArray(array);
  }
}

//------------------------------------------------------------------------------
void Writer::Polycubes(
  const std::vector<Eigen::Vector3d>& picked, vtkUnstructuredGrid* output) const
{
  const vtkNew<vtkPoints> points = DoublePoints();
  const auto coordinates = Named<vtkIntArray>("DomainCoordinates", 3);
  const auto cornerId = Named<vtkIntArray>("CornerId");
  const auto snapped = Named<vtkDoubleArray>("SnapDistance");
  const auto owner = Named<vtkIntArray>("Segment");
  const auto block = Named<vtkIntArray>("Block");
  const auto patch = Named<vtkIntArray>("Patch");
  std::vector<vtkIdType> pointOfCorner(this->End.Corner, -1);
  int blocks = 0;
  output->Allocate();
  for (const BlocksOfSegment& segment : this->Domains.Segments)
  {
    const auto cornersOf = [this](Index surface)
    { return static_cast<Index>(this->Domains.Surfaces[surface].Domain.Layout.Corners.size()); };
    const Index outer = cornersOf(segment.Outer);
    const Index inner = segment.Inner < 0 ? 0 : cornersOf(segment.Inner);
    std::vector<vtkIdType> ids;
    for (std::size_t p = 0; p < segment.Blocks.Places.size(); ++p)
    {
      const Index i = static_cast<Index>(p);
      const int corner = i < outer           ? this->Begin[segment.Outer].Corner + int(i)
                         : i < outer + inner ? this->Begin[segment.Inner].Corner + int(i - outer)
                                             : -1;
      if (corner >= 0 && pointOfCorner[corner] >= 0)
      {
        ids.push_back(pointOfCorner[corner]);
        continue;
      }
      const Eigen::Vector3d& place = segment.Blocks.Places[p];
      ids.push_back(points->InsertNextPoint(place.data()));
      coordinates->InsertNextTypedTuple(segment.Blocks.Coordinates[p].data());
      cornerId->InsertNextValue(corner);
      snapped->InsertNextValue(p < picked.size() ? (picked[p] - place).norm() : 0.0);
      if (corner >= 0)
      {
        pointOfCorner[corner] = ids.back();
      }
    }
    const bool grid =
      segment.Inner < 0 && std::all_of(segment.Blocks.Blocks.begin(), segment.Blocks.Blocks.end(),
                             [](const DomainBlock& b) { return b.Face < 0; });
    for (const DomainBlock& hexahedron : segment.Blocks.Blocks)
    {
      vtkIdType corners[8];
      std::transform(hexahedron.Points.begin(), hexahedron.Points.end(), corners,
        [&ids](Index point) { return ids[point]; });
      output->InsertNextCell(VTK_HEXAHEDRON, 8, corners);
      owner->InsertNextValue(segment.Segment);
      block->InsertNextValue(blocks);
      blocks += grid ? 0 : 1;
      patch->InsertNextValue(
        hexahedron.Face < 0 ? -1
                            : this->Begin[segment.Outer].Patch + static_cast<int>(hexahedron.Face));
    }
    blocks += grid ? 1 : 0;
  }
  output->SetPoints(points);
  output->GetPointData()->AddArray(coordinates);
  output->GetPointData()->AddArray(cornerId);
  if (!picked.empty())
  {
    output->GetPointData()->AddArray(snapped);
  }
  output->GetCellData()->AddArray(owner);
  output->GetCellData()->AddArray(block);
  output->GetCellData()->AddArray(patch);
}

//------------------------------------------------------------------------------
void Writer::Borders(vtkPolyData* output) const
{
  const vtkNew<vtkPoints> points = DoublePoints();
  const auto cornerId = Named<vtkIntArray>("CornerId");
  const auto sides = Named<vtkIntArray>("BorderPatches", 2);
  vtkNew<vtkCellArray> lines;
  for (const Index number : this->Order)
  {
    const SurfaceLayout& layout = this->Domains.Surfaces[number].Domain.Layout;
    const Bases& begin = this->Begin[number];
    std::vector<vtkIdType> pointOf(layout.Points.size(), -1);
    for (const LayoutBorder& border : layout.Borders)
    {
      std::vector<vtkIdType> line;
      for (const Index point : border.Points)
      {
        if (pointOf[point] < 0)
        {
          pointOf[point] = points->InsertNextPoint(layout.Points[point].data());
          cornerId->InsertNextValue(-1);
        }
        line.push_back(pointOf[point]);
      }
      cornerId->SetValue(line.front(), begin.Corner + static_cast<int>(border.Corners[0]));
      cornerId->SetValue(line.back(), begin.Corner + static_cast<int>(border.Corners[1]));
      lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
      const int pair[2] = { begin.Patch + static_cast<int>(border.Patches[0]),
        begin.Patch + static_cast<int>(border.Patches[1]) };
      sides->InsertNextTypedTuple(pair);
    }
  }
  output->SetPoints(points);
  output->SetLines(lines);
  output->GetPointData()->AddArray(cornerId);
  output->GetCellData()->AddArray(sides);
}
}

//------------------------------------------------------------------------------
void WriteDomains(const LabelledSurface& surface, const DomainSet& domains,
  const std::vector<Eigen::Vector3d>& picked, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  vtkPolyData* borders)
{
  const Writer writer(surface, domains);
  writer.Patches(patches);
  writer.Polycubes(picked, polycubes);
  writer.Borders(borders);
}
}
