// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A parameterized ball as Volume Parameterization would hand it on, in closed form.
#ifndef BallDomain_h
#define BallDomain_h

#include "Testing/BallBlocks.h"

#include "vtkCellData.h"
#include "vtkCellType.h"
#include "vtkDoubleArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkStructuredGrid.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

namespace trivariate_testing
{
template <typename ArrayT>
vtkNew<ArrayT> NamedArray(const char* name, int components, vtkIdType tuples)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(tuples);
  array->Fill(0.0);
  return array;
}

struct BallDomain
{
  vtkNew<vtkImageData> Image; ///< n^3 voxels: Density, Parameter, ParameterMask
  vtkNew<vtkUnstructuredGrid> Polycube;
  vtkNew<vtkPartitionedDataSetCollection> Meshes;
  trivariate::BallMap Map;
  vtkIdType NumberOfVoxels = 0;

  explicit BallDomain(int n, int cells = 12)
  {
    this->MakeImage(n);
    this->MakePolycube();
    for (trivariate::Index b = 0; b < this->Map.Blocks.Size(); ++b)
    {
      this->MakeMesh(b, cells);
    }
  }

private:
  void MakeImage(int n)
  {
    const trivariate::BallPhantom phantom(n);
    this->Map = phantom.Map;
    this->Image->SetDimensions(n, n, n);
    const double low = -0.5 * (n - 1);
    this->Image->SetOrigin(low, low, low);
    const vtkIdType count = this->Image->GetNumberOfPoints();
    const auto density = NamedArray<vtkDoubleArray>("Density", 1, count);
    const auto parameter = NamedArray<vtkDoubleArray>("Parameter", 3, count);
    const auto mask = NamedArray<vtkUnsignedCharArray>("ParameterMask", 1, count);
    for (vtkIdType id = 0; id < count; ++id)
    {
      density->SetValue(id, phantom.Grid[id]);
      if (phantom.Mask[id])
      {
        mask->SetValue(id, 1);
        parameter->SetTypedTuple(id, &phantom.Voxels.Parameters[3 * this->NumberOfVoxels++]);
      }
    }
    this->Image->GetPointData()->SetScalars(density);
    this->Image->GetPointData()->AddArray(parameter);
    this->Image->GetPointData()->AddArray(mask);
  }

  void MakePolycube()
  {
    const vtkIdType blocks = static_cast<vtkIdType>(this->Map.Blocks.Size());
    vtkNew<vtkPoints> points;
    points->SetNumberOfPoints(16);
    const auto coordinates = NamedArray<vtkIntArray>("DomainCoordinates", 3, 16);
    const auto segment = NamedArray<vtkIntArray>("Segment", 1, blocks);
    const auto group = NamedArray<vtkIntArray>("Block", 1, blocks);
    this->Polycube->Allocate();
    for (vtkIdType b = 0; b < blocks; ++b)
    {
      const auto& corners = this->Map.Blocks.Blocks[b];
      const trivariate::LatticePoint& o = this->Map.Blocks.Origins[b];
      vtkIdType ids[8];
      for (int ends = 0; ends < 8; ++ends)
      {
        const int corner = trivariate::HexahedronCorner(ends);
        ids[corner] = corners[corner];
        const auto place = this->Map.Place(
          b, { o[0] + double(ends & 1), o[1] + double(ends >> 1 & 1), o[2] + double(ends >> 2) });
        points->SetPoint(ids[corner], place.data());
      }
      this->Polycube->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
      segment->SetValue(b, 1);
      group->SetValue(b, static_cast<int>(b));
    }
    this->Polycube->SetPoints(points);
    this->Polycube->GetPointData()->AddArray(coordinates);
    this->Polycube->GetCellData()->AddArray(segment);
    this->Polycube->GetCellData()->AddArray(group);
  }

  void MakeMesh(trivariate::Index b, int cells)
  {
    const trivariate::LatticePoint& o = this->Map.Blocks.Origins[b];
    vtkNew<vtkPoints> points;
    points->SetDataTypeToDouble();
    for (int k = 0; k <= cells; ++k)
    {
      for (int j = 0; j <= cells; ++j)
      {
        for (int i = 0; i <= cells; ++i)
        {
          const auto place = this->Map.Place(
            b, { o[0] + double(i) / cells, o[1] + double(j) / cells, o[2] + double(k) / cells });
          points->InsertNextPoint(place.data());
        }
      }
    }
    vtkNew<vtkStructuredGrid> grid;
    grid->SetDimensions(cells + 1, cells + 1, cells + 1);
    grid->SetPoints(points);
    this->Meshes->SetPartition(static_cast<unsigned int>(b), 0, grid);
  }
};
}

#endif
