// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSamples.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDataArray.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSet.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkStructuredGrid.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
// Samples of the shape along an edge of a block, at least: what is fitted with cubics needs some.
constexpr int FewestIntervals = 8;

//------------------------------------------------------------------------------
vtkDataArray* WholeNumbers(vtkDataSetAttributes* attributes, const char* name, int components)
{
  vtkDataArray* array = attributes->GetArray(name);
  if (!array || array->GetNumberOfComponents() != components)
  {
    throw std::invalid_argument("The polycube has no array " + std::string(name) + " with " +
                                std::to_string(components) +
                                " component(s); it comes from Volume Parameterization.");
  }
  return array;
}

//------------------------------------------------------------------------------
// The cell of a coordinate x in [0, 1] of n cells, and the place in it.
std::pair<int, double> CellOf(double x, int n)
{
  const int cell = std::min(static_cast<int>(x * n), n - 1);
  return { cell, x * n - cell };
}

//------------------------------------------------------------------------------
std::array<double, 3> PlaceIn(
  vtkStructuredGrid* grid, const std::array<int, 3>& cells, const std::array<double, 3>& local)
{
  std::array<double, 3> place{ 0.0, 0.0, 0.0 };
  for (int corner = 0; corner < 8; ++corner)
  {
    double weight = 1.0;
    vtkIdType id = 0, step = 1;
    for (int a = 0; a < 3; ++a)
    {
      const auto [cell, t] = CellOf(local[a], cells[a]);
      const int end = corner >> a & 1;
      weight *= end ? t : 1.0 - t;
      id += step * (cell + end);
      step *= cells[a] + 1;
    }
    if (weight != 0.0)
    {
      double node[3];
      grid->GetPoint(id, node);
      for (int a = 0; a < 3; ++a)
      {
        place[a] += weight * node[a];
      }
    }
  }
  return place;
}
}

//------------------------------------------------------------------------------
BlockComplex ReadBlocks(vtkUnstructuredGrid* polycube)
{
  vtkDataArray* segment = WholeNumbers(polycube->GetCellData(), "Segment", 1);
  vtkDataArray* group = WholeNumbers(polycube->GetCellData(), "Block", 1);
  vtkDataArray* coordinates = WholeNumbers(polycube->GetPointData(), "DomainCoordinates", 3);
  std::vector<std::array<Index, 8>> blocks;
  std::vector<int> segments, groups;
  std::vector<LatticePoint> places;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < polycube->GetNumberOfCells(); ++cell)
  {
    if (polycube->GetCellType(cell) != VTK_HEXAHEDRON)
    {
      throw std::invalid_argument(
        "Cell " + std::to_string(cell) + " of the polycube is no hexahedron.");
    }
    polycube->GetCellPoints(cell, ids);
    std::copy_n(ids->begin(), 8, blocks.emplace_back().begin());
    segments.push_back(static_cast<int>(segment->GetComponent(cell, 0)));
    groups.push_back(static_cast<int>(group->GetComponent(cell, 0)));
    for (int a = 0; a < 3; ++a)
    {
      (a == 0 ? places.emplace_back() : places.back())[a] =
        static_cast<int>(coordinates->GetComponent(ids->GetId(0), a));
    }
  }
  return BlockComplex(std::move(blocks), std::move(segments), std::move(groups), std::move(places));
}

//------------------------------------------------------------------------------
std::set<int> LayeredSegments(vtkUnstructuredGrid* polycube)
{
  vtkDataArray* segments = polycube->GetCellData()->GetArray("Segment");
  vtkDataArray* patches = polycube->GetCellData()->GetArray("Patch");
  std::set<int> layered;
  for (vtkIdType cell = 0; patches && cell < polycube->GetNumberOfCells(); ++cell)
  {
    if (patches->GetTuple1(cell) >= 0.0)
    {
      layered.insert(static_cast<int>(segments->GetTuple1(cell)));
    }
  }
  return layered;
}

//------------------------------------------------------------------------------
BlockSamples TakeVoxels(ImageSamples& samples, const BlockComplex& blocks)
{
  const std::size_t attributes = samples.Attributes.size();
  if (attributes < 3 || samples.Attributes[attributes - 2].Components != 3 ||
      samples.Attributes[attributes - 1].Components != 1)
  {
    throw std::invalid_argument("The arrays " + std::string(ParameterArrayName) + " and " +
                                ParameterMaskName +
                                " of the image need three components and one; they come from "
                                "Volume Parameterization and cannot be fitted themselves.");
  }
  samples.Attributes.resize(attributes - 2);
  const Index count = samples.Count();
  const double* parameter = &samples.Values[samples.Components() * count];
  const double* hasParameter = parameter + 3 * count;
  std::vector<Index> voxels;
  for (Index i = 0; i < count; ++i)
  {
    if (hasParameter[i] != 0.0 && (samples.Mask.empty() || samples.Mask[i]))
    {
      voxels.push_back(i);
    }
  }
  if (voxels.empty())
  {
    throw std::invalid_argument("No voxel that counts has a parameter in the domain.");
  }
  BlockSamples result;
  result.Components = samples.Components();
  for (const Index i : voxels)
  {
    std::array<double, 3> p;
    for (int a = 0; a < 3; ++a)
    {
      p[a] = parameter[a * count + i];
    }
    if (blocks.BlockAt(p) < 0)
    {
      throw std::invalid_argument("The parameter of voxel " + std::to_string(i) + ", (" +
                                  std::to_string(p[0]) + ", " + std::to_string(p[1]) + ", " +
                                  std::to_string(p[2]) +
                                  "), is in no block; image and polycube must come from the same "
                                  "Volume Parameterization.");
    }
    const double index[3] = { double(i % samples.Points(0)),
      double(i / samples.Points(0) % samples.Points(1)),
      double(i / samples.Points(0) / samples.Points(1)) };
    const std::array<double, 3> place = samples.ToPhysical(index);
    result.Parameters.insert(result.Parameters.end(), p.begin(), p.end());
    result.Places.insert(result.Places.end(), place.begin(), place.end());
  }
  for (int c = 0; c < result.Components; ++c)
  {
    for (const Index i : voxels)
    {
      result.Values.push_back(samples.Values[c * count + i]);
    }
  }
  return result;
}

//------------------------------------------------------------------------------
ShapeSamples ReadShape(vtkPartitionedDataSetCollection* meshes, const BlockComplex& blocks)
{
  ShapeSamples shape;
  const Index count = meshes ? meshes->GetNumberOfPartitionedDataSets() : 0;
  if (count == 0)
  {
    return shape;
  }
  if (count != blocks.Size())
  {
    throw std::invalid_argument("There are " + std::to_string(count) + " block meshes for " +
                                std::to_string(blocks.Size()) + " blocks of the polycube.");
  }
  for (Index b = 0; b < count; ++b)
  {
    vtkStructuredGrid* grid =
      vtkStructuredGrid::SafeDownCast(meshes->GetPartition(static_cast<unsigned int>(b), 0));
    std::array<int, 3> cells{ 0, 0, 0 };
    if (grid)
    {
      grid->GetDimensions(cells.data());
    }
    for (int& n : cells)
    {
      if (--n < 1)
      {
        throw std::invalid_argument(
          "The mesh of block " + std::to_string(b) + " is no structured grid of hexahedra.");
      }
    }
    std::array<int, 3> intervals;
    for (int a = 0; a < 3; ++a)
    {
      intervals[a] = cells[a] * ((FewestIntervals + cells[a] - 1) / cells[a]);
    }
    AddSamplesOfBlock(
      blocks, b, intervals,
      [grid, &cells](const std::array<double, 3>& local) { return PlaceIn(grid, cells, local); },
      shape);
  }
  return shape;
}

//------------------------------------------------------------------------------
double VoxelSpacing(const ImageSamples& samples)
{
  const auto& m = samples.IndexToPhysical;
  const double volume = m[0] * (m[5] * m[10] - m[6] * m[9]) - m[1] * (m[4] * m[10] - m[6] * m[8]) +
                        m[2] * (m[4] * m[9] - m[5] * m[8]);
  return std::cbrt(std::abs(volume));
}
}
