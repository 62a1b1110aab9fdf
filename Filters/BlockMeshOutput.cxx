// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockMeshOutput.h"

#include "NamedArray.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
// The arrays on cells, filled block by block.
struct CellArrays
{
  void Add(const BlockMesh& mesh, const BlockLabels& labels, Index block, const BlockPoints& cell)
  {
    this->Segment->InsertNextValue(labels.Segments[block]);
    this->Block->InsertNextValue(labels.Groups[block]);
    this->Jacobian->InsertNextValue(ScaledJacobian(mesh.Places, cell));
  }

  void AddTo(vtkCellData* data) const
  {
    data->AddArray(this->Segment);
    data->AddArray(this->Block);
    data->AddArray(this->Jacobian);
  }

  vtkNew<vtkIntArray> Segment = Named<vtkIntArray>("Segment");
  vtkNew<vtkIntArray> Block = Named<vtkIntArray>("Block");
  vtkNew<vtkDoubleArray> Jacobian = Named<vtkDoubleArray>("ScaledJacobian");
};

template <typename Function>
void ForCells(const std::array<int, 3>& size, const Function& function)
{
  for (int k = 0; k < size[2]; ++k)
  {
    for (int j = 0; j < size[1]; ++j)
    {
      for (int i = 0; i < size[0]; ++i)
      {
        function(i, j, k);
      }
    }
  }
}

void WriteBlock(const BlockMesh& mesh, const BlockLabels& labels, Index block,
  vtkPointData* attributes, vtkStructuredGrid* grid)
{
  const std::array<int, 3>& n = mesh.Sizes[block];
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  const auto node = Named<vtkIdTypeArray>("Node");
  const auto parameter = Named<vtkDoubleArray>("Parameter", 3);
  const LatticePoint origin = labels.Origins.empty() ? LatticePoint{} : labels.Origins[block];
  vtkPointData* const data = grid->GetPointData();
  data->CopyAllocate(attributes, static_cast<vtkIdType>(mesh.Nodes[block].size()));
  ForCells({ n[0] + 1, n[1] + 1, n[2] + 1 },
    [&](int i, int j, int k)
    {
      const Index number = mesh.Node(block, i, j, k);
      const vtkIdType point = points->InsertNextPoint(mesh.Places[number].data());
      node->InsertNextValue(number);
      parameter->InsertNextTuple3(
        origin[0] + double(i) / n[0], origin[1] + double(j) / n[1], origin[2] + double(k) / n[2]);
      data->CopyData(attributes, number, point);
    });
  CellArrays cells;
  ForCells(
    n, [&](int i, int j, int k) { cells.Add(mesh, labels, block, mesh.Cell(block, i, j, k)); });
  grid->SetDimensions(n[0] + 1, n[1] + 1, n[2] + 1);
  grid->SetPoints(points);
  data->AddArray(node);
  data->AddArray(parameter);
  cells.AddTo(grid->GetCellData());
}
}

//------------------------------------------------------------------------------
void WriteBlockMesh(const BlockMesh& mesh, const BlockLabels& labels, vtkPointData* attributes,
  vtkPartitionedDataSetCollection* output)
{
  output->SetNumberOfPartitionedDataSets(static_cast<unsigned int>(mesh.Sizes.size()));
  for (std::size_t b = 0; b < mesh.Sizes.size(); ++b)
  {
    vtkNew<vtkStructuredGrid> grid;
    WriteBlock(mesh, labels, static_cast<Index>(b), attributes, grid);
    output->SetPartition(static_cast<unsigned int>(b), 0, grid);
    output->GetMetaData(static_cast<unsigned int>(b))
      ->Set(vtkCompositeDataSet::NAME(), ("Block " + std::to_string(b)).c_str());
  }
}

void WriteHexahedra(const BlockMesh& mesh, const BlockLabels& labels, vtkPointData* attributes,
  vtkUnstructuredGrid* output)
{
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const Eigen::Vector3d& place : mesh.Places)
  {
    points->InsertNextPoint(place.data());
  }
  output->SetPoints(points);
  output->GetPointData()->ShallowCopy(attributes);
  output->Allocate(mesh.NumberOfCells());
  CellArrays cells;
  for (std::size_t b = 0; b < mesh.Sizes.size(); ++b)
  {
    ForCells(mesh.Sizes[b],
      [&](int i, int j, int k)
      {
        const BlockPoints cell = mesh.Cell(static_cast<Index>(b), i, j, k);
        vtkIdType ids[8];
        std::copy(cell.begin(), cell.end(), ids);
        output->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
        cells.Add(mesh, labels, static_cast<Index>(b), cell);
      });
  }
  cells.AddTo(output->GetCellData());
  // VTK's Exodus writer looks for that name.
  const auto elementBlocks = Named<vtkIntArray>("ElementBlockIds");
  elementBlocks->DeepCopy(output->GetCellData()->GetArray("Segment"));
  elementBlocks->SetName("ElementBlockIds");
  output->GetCellData()->AddArray(elementBlocks);
}

//------------------------------------------------------------------------------
void WriteQuality(const BlockMeshReport& report, vtkFieldData* field)
{
  const auto inverted = Named<vtkIdTypeArray>("InvertedCells", 2);
  const vtkIdType counts[2] = { report.Start.Inverted, report.End.Inverted };
  inverted->InsertNextTypedTuple(counts);
  field->AddArray(inverted);
  const auto addPair = [field](const char* name, double first, double second)
  {
    const auto pair = Named<vtkDoubleArray>(name, 2);
    pair->InsertNextTuple2(first, second);
    field->AddArray(pair);
  };
  const auto& [toFaces, fromFaces] = report.Distances;
  addPair("ScaledJacobian", report.End.LeastJacobian, report.End.MeanJacobian);
  addPair("CellVolumeRatio", report.End.LowRatio, report.End.HighRatio);
  addPair("PatchDistance", toFaces.Mean, toFaces.Largest);
  addPair("FaceDistance", fromFaces.Mean, fromFaces.Largest);
}

//------------------------------------------------------------------------------
BlockMesh ReadBlockMesh(
  vtkPartitionedDataSetCollection* input, const std::vector<BlockPoints>& blocks)
{
  const auto refuse = [](std::size_t block, const std::string& why)
  {
    return std::invalid_argument("Block " + std::to_string(block) +
                                 " of the block meshes does not fit the polycube: " + why + ".");
  };
  if (input->GetNumberOfPartitionedDataSets() != blocks.size())
  {
    throw std::invalid_argument("There are " +
                                std::to_string(input->GetNumberOfPartitionedDataSets()) +
                                " block meshes for " + std::to_string(blocks.size()) + " blocks.");
  }
  std::vector<vtkStructuredGrid*> grids;
  std::vector<std::array<int, 3>> sizes;
  Index points = 0;
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    grids.push_back(
      vtkStructuredGrid::SafeDownCast(input->GetPartition(static_cast<unsigned int>(b), 0)));
    if (!grids.back())
    {
      throw refuse(b, "it is no structured grid");
    }
    std::array<int, 3>& size = sizes.emplace_back();
    grids.back()->GetDimensions(size.data());
    std::for_each(size.begin(), size.end(), [](int& n) { --n; });
    if (*std::min_element(size.begin(), size.end()) < 1)
    {
      throw refuse(b, "it has no cells");
    }
    points = std::max(points, *std::max_element(blocks[b].begin(), blocks[b].end()) + 1);
  }
  BlockMesh mesh = NumberNodes(blocks, points, sizes);
  std::vector<char> placed(mesh.Places.size(), 0);
  for (std::size_t b = 0; b < blocks.size(); ++b)
  {
    for (std::size_t p = 0; p < mesh.Nodes[b].size(); ++p)
    {
      const Index node = mesh.Nodes[b][p];
      const Eigen::Vector3d place(grids[b]->GetPoint(static_cast<vtkIdType>(p)));
      if (placed[node] && place != mesh.Places[node])
      {
        throw refuse(b, "a node that it shares with another block is elsewhere");
      }
      placed[node] = 1;
      mesh.Places[node] = place;
    }
  }
  return mesh;
}

//------------------------------------------------------------------------------
void SampleImage(
  vtkImageData* image, const std::vector<Eigen::Vector3d>& places, vtkPointData* attributes)
{
  static const std::set<std::string> labels{ "Segment", "Block", "Parameter", "ParameterMask",
    "FrameParameter", "FrameParameterMask", "FrameU", "FrameV", "FrameW", "vtkValidPointMask",
    "vtkGhostType" };
  vtkPointData* const input = image->GetPointData();
  vtkNew<vtkPointData> sampled;
  for (int a = 0; a < input->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* const array = input->GetArray(a);
    if (array && array->GetName() && !labels.count(array->GetName()))
    {
      vtkNew<vtkDoubleArray> output;
      output->SetName(array->GetName());
      output->SetNumberOfComponents(array->GetNumberOfComponents());
      output->SetNumberOfTuples(static_cast<vtkIdType>(places.size()));
      sampled->AddArray(array);
      attributes->AddArray(output);
    }
  }
  const int* extent = image->GetExtent();
  for (std::size_t p = 0; p < places.size(); ++p)
  {
    double index[3];
    image->TransformPhysicalPointToContinuousIndex(places[p].data(), index);
    std::array<int, 3> low;
    std::array<double, 3> share;
    for (int axis = 0; axis < 3; ++axis)
    {
      const int first = extent[2 * axis], last = extent[2 * axis + 1];
      const double inside = std::clamp<double>(index[axis], first, last);
      low[axis] =
        std::clamp(static_cast<int>(std::floor(inside)), first, std::max(first, last - 1));
      share[axis] = inside - low[axis];
    }
    for (int a = 0; a < sampled->GetNumberOfArrays(); ++a)
    {
      vtkDataArray* const from = sampled->GetArray(a);
      vtkDataArray* const to = attributes->GetArray(from->GetName());
      for (int component = 0; component < from->GetNumberOfComponents(); ++component)
      {
        double value = 0.0;
        for (int corner = 0; corner < 8; ++corner)
        {
          double weight = 1.0;
          std::array<int, 3> at = low;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int end = EndOfCorner(corner, axis);
            weight *= end ? share[axis] : 1.0 - share[axis];
            at[axis] = std::min(at[axis] + end, extent[2 * axis + 1]);
          }
          value += weight * from->GetComponent(image->ComputePointId(at.data()), component);
        }
        to->SetComponent(static_cast<vtkIdType>(p), component, value);
      }
    }
  }
}
}
