// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainOutput.h"

#include "NamedArray.h"

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
#include <map>

namespace trivariate
{
namespace
{
vtkNew<vtkPoints> DoublePoints()
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  return points;
}

// The numbers of a surface's points, corners and patches in the output.
struct Numbers
{
  std::vector<vtkIdType> Points;
  std::vector<int> Corners, Patches;
};

class Writer
{
public:
  Writer(const LabelledSurface& surface, const DomainSet& domains)
    : Surface(surface)
    , Domains(domains)
    , Of(domains.Surfaces.size())
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
  void Polycubes(const PickedCorners& picked, vtkUnstructuredGrid* output) const;
  void Borders(vtkPolyData* output) const;

private:
  void Number(Index surface)
  {
    Numbers& own = this->Of[surface];
    if (!own.Points.empty())
    {
      return;
    }
    const SurfaceLayout& layout = this->Domains.Surfaces[surface].Domain.Layout;
    own.Points.assign(layout.Points.size(), -1);
    own.Corners.assign(layout.Corners.size(), -1);
    own.Patches.assign(layout.PatchLabels.size(), -1);
    for (const SharedPatch& patch : this->Domains.Shared)
    {
      const bool first = patch.First == surface;
      const Index other = first ? patch.Second : patch.First;
      if ((first || patch.Second == surface) && !this->Of[other].Points.empty())
      {
        this->TakeOver(surface, first ? patch.FirstPatch : patch.SecondPatch, other,
          first ? patch.SecondPatch : patch.FirstPatch);
      }
    }
    const auto fill = [](auto& numbers, auto& next)
    {
      for (auto& number : numbers)
      {
        number = number < 0 ? next++ : number;
      }
    };
    fill(own.Points, this->NumberOfPoints);
    fill(own.Corners, this->NumberOfCorners);
    fill(own.Patches, this->NumberOfPatches);
    this->Order.push_back(surface);
  }

  // The numbers that a patch, its corners and points have on another surface already.
  void TakeOver(Index surface, Index patch, Index other, Index otherPatch)
  {
    const LaidOutSurface &to = this->Domains.Surfaces[surface],
                         &from = this->Domains.Surfaces[other];
    const SurfaceLayout &layout = to.Domain.Layout, &there = from.Domain.Layout;
    Numbers &own = this->Of[surface], &given = this->Of[other];
    own.Patches[patch] = given.Patches[otherPatch];
    std::map<Index, std::size_t> triangleOf; // of the labelled surface; uncut on both sides
    for (std::size_t t = 0; t < there.Triangles.size(); ++t)
    {
      if (there.Patches[t] == otherPatch)
      {
        triangleOf[from.Origins[there.Origins[t]]] = t;
      }
    }
    for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
    {
      if (layout.Patches[t] == patch)
      {
        const Triangle& twin = there.Triangles[triangleOf.at(to.Origins[layout.Origins[t]])];
        for (const Index p : layout.Triangles[t])
        {
          own.Points[p] = given.Points[*std::find_if(twin.begin(), twin.end(),
            [&](Index q) { return there.Points[q] == layout.Points[p]; })];
        }
      }
    }
    for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
    {
      for (std::size_t twin = 0; twin < there.Corners.size(); ++twin)
      {
        if (own.Points[layout.Corners[corner]] == given.Points[there.Corners[twin]])
        {
          own.Corners[corner] = given.Corners[twin];
        }
      }
    }
  }

  const LabelledSurface& Surface;
  const DomainSet& Domains;
  std::vector<Numbers> Of; // each surface; empty: of no segment
  vtkIdType NumberOfPoints = 0;
  int NumberOfCorners = 0, NumberOfPatches = 0;
  std::vector<Index> Order; // surfaces that segments have
};

//------------------------------------------------------------------------------
void Writer::Patches(vtkPolyData* output) const
{
  const vtkNew<vtkPoints> points = DoublePoints();
  const auto cornerId = Named<vtkIntArray>("CornerId");
  const auto parameter = Named<vtkDoubleArray>("Parameter", 3);
  parameter->SetNumberOfTuples(this->NumberOfPoints);
  parameter->Fill(0.0);
  bool mapped = false;
  points->SetNumberOfPoints(this->NumberOfPoints);
  cornerId->SetNumberOfValues(this->NumberOfPoints);
  cornerId->FillValue(-1);
  for (const Index number : this->Order)
  {
    const SurfaceLayout& layout = this->Domains.Surfaces[number].Domain.Layout;
    const Numbers& own = this->Of[number];
    for (std::size_t p = 0; p < layout.Points.size(); ++p)
    {
      points->SetPoint(own.Points[p], layout.Points[p].data());
    }
    for (std::size_t p = 0; p < layout.Parameters.size(); ++p)
    {
      parameter->SetTypedTuple(own.Points[p], layout.Parameters[p].data());
    }
    mapped |= !layout.Parameters.empty();
    for (std::size_t corner = 0; corner < layout.Corners.size(); ++corner)
    {
      cornerId->SetValue(own.Points[layout.Corners[corner]], own.Corners[corner]);
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
    const LaidOutSurface& surface = this->Domains.Surfaces[number];
    const SurfaceLayout& layout = surface.Domain.Layout;
    const Numbers& own = this->Of[number];
    for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
    {
      const Triangle& c = layout.Triangles[t];
      const vtkIdType ids[3] = { own.Points[c[0]], own.Points[c[inner ? 2 : 1]],
        own.Points[c[inner ? 1 : 2]] };
      cells->InsertNextCell(3, ids);
      const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
      patch->InsertNextValue(own.Patches[layout.Patches[t]]);
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
  if (mapped)
  {
    output->GetPointData()->AddArray(parameter);
  }
  output->GetCellData()->SetScalars(patch); // ParaView's first choice for colors
  vtkDataArray* const arrays[] = { axis, side, owner, labels };
  for (vtkDataArray* array : arrays)
  {
    output->GetCellData()->AddArray(array);
  }
}

//------------------------------------------------------------------------------
void Writer::Polycubes(const PickedCorners& picked, vtkUnstructuredGrid* output) const
{
  const vtkNew<vtkPoints> points = DoublePoints();
  const auto coordinates = Named<vtkIntArray>("DomainCoordinates", 3);
  const auto cornerId = Named<vtkIntArray>("CornerId");
  const auto snapped = Named<vtkDoubleArray>("SnapDistance");
  const auto owner = Named<vtkIntArray>("Segment");
  const auto block = Named<vtkIntArray>("Block");
  const auto patch = Named<vtkIntArray>("Patch");
  const auto alignment = Named<vtkDoubleArray>("Alignment");
  std::vector<vtkIdType> pointOfCorner(this->NumberOfCorners, -1);
  int blocks = 0;
  output->Allocate();
  for (const BlocksOfSegment& segment : this->Domains.Segments)
  {
    std::vector<int> corners = this->Of[segment.Outer].Corners;
    if (segment.Inner >= 0)
    {
      const std::vector<int>& inner = this->Of[segment.Inner].Corners;
      corners.insert(corners.end(), inner.begin(), inner.end());
    }
    corners.resize(segment.Blocks.Places.size(), -1);
    const auto own = picked.find(segment.Segment);
    const auto& wanted = own == picked.end() ? std::vector<Eigen::Vector3d>() : own->second;
    std::vector<vtkIdType> ids;
    for (std::size_t p = 0; p < segment.Blocks.Places.size(); ++p)
    {
      const int corner = corners[p];
      if (corner >= 0 && pointOfCorner[corner] >= 0)
      {
        ids.push_back(pointOfCorner[corner]);
        continue;
      }
      const Eigen::Vector3d& place = segment.Blocks.Places[p];
      ids.push_back(points->InsertNextPoint(place.data()));
      coordinates->InsertNextTypedTuple(segment.Blocks.Coordinates[p].data());
      cornerId->InsertNextValue(corner);
      snapped->InsertNextValue(p < wanted.size() ? (wanted[p] - place).norm() : 0.0);
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
      vtkIdType eight[8];
      std::transform(hexahedron.Points.begin(), hexahedron.Points.end(), eight,
        [&ids](Index point) { return ids[point]; });
      output->InsertNextCell(VTK_HEXAHEDRON, 8, eight);
      owner->InsertNextValue(segment.Segment);
      alignment->InsertNextValue(this->Domains.Surfaces[segment.Outer].Domain.Alignment);
      block->InsertNextValue(blocks);
      blocks += grid ? 0 : 1;
      patch->InsertNextValue(
        hexahedron.Face < 0 ? -1 : this->Of[segment.Outer].Patches[hexahedron.Face]);
    }
    blocks += grid ? 1 : 0;
  }
  output->SetPoints(points);
  output->GetPointData()->AddArray(coordinates);
  output->GetPointData()->AddArray(cornerId);
  if (std::any_of(
        picked.begin(), picked.end(), [](const auto& own) { return !own.second.empty(); }))
  {
    output->GetPointData()->AddArray(snapped);
  }
  output->GetCellData()->AddArray(owner);
  output->GetCellData()->AddArray(block);
  output->GetCellData()->AddArray(patch);
  output->GetCellData()->AddArray(alignment);
}

//------------------------------------------------------------------------------
void Writer::Borders(vtkPolyData* output) const
{
  const vtkNew<vtkPoints> points = DoublePoints();
  const auto cornerId = Named<vtkIntArray>("CornerId");
  const auto sides = Named<vtkIntArray>("BorderPatches", 2);
  vtkNew<vtkCellArray> lines;
  std::vector<vtkIdType> pointOf(this->NumberOfPoints, -1); // of those of the patches
  for (const Index number : this->Order)
  {
    const SurfaceLayout& layout = this->Domains.Surfaces[number].Domain.Layout;
    const Numbers& own = this->Of[number];
    for (const LayoutBorder& border : layout.Borders)
    {
      std::vector<vtkIdType> line;
      for (const Index point : border.Points)
      {
        vtkIdType& number = pointOf[own.Points[point]];
        if (number < 0)
        {
          number = points->InsertNextPoint(layout.Points[point].data());
          cornerId->InsertNextValue(-1);
        }
        line.push_back(number);
      }
      cornerId->SetValue(line.front(), own.Corners[border.Corners[0]]);
      cornerId->SetValue(line.back(), own.Corners[border.Corners[1]]);
      lines->InsertNextCell(static_cast<vtkIdType>(line.size()), line.data());
      const int pair[2] = { own.Patches[border.Patches[0]], own.Patches[border.Patches[1]] };
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
  const PickedCorners& picked, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  vtkPolyData* borders)
{
  const Writer writer(surface, domains);
  writer.Patches(patches);
  writer.Polycubes(picked, polycubes);
  writer.Borders(borders);
}
}
