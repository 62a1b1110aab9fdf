// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ParameterOutput.h"

#include "BlockMeshOutput.h"
#include "CutToExtent.h"
#include "NamedArray.h"

#include "vtkCellData.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>

namespace trivariate
{
namespace
{
template <typename ArrayT, typename T>
vtkNew<ArrayT> Copied(const char* name, int components, const std::vector<T>& values)
{
  vtkNew<ArrayT> array = Named<ArrayT>(name, components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  return array;
}

// The mean length of a block's grid lines along its axes.
Eigen::Vector3d LengthsOf(const BlockMesh& mesh, Index block)
{
  Eigen::Vector3d lengths;
  const std::array<int, 3>& n = mesh.Sizes[block];
  for (int axis = 0; axis < 3; ++axis)
  {
    double sum = 0.0;
    int lines = 0;
    std::array<int, 3> at{};
    const int s = (axis + 1) % 3, t = (axis + 2) % 3;
    for (at[s] = 0; at[s] <= n[s]; ++at[s])
    {
      for (at[t] = 0; at[t] <= n[t]; ++at[t], ++lines)
      {
        for (at[axis] = 0; at[axis] < n[axis]; ++at[axis])
        {
          std::array<int, 3> next = at;
          ++next[axis];
          sum += (mesh.Places[mesh.Node(block, next[0], next[1], next[2])] -
                  mesh.Places[mesh.Node(block, at[0], at[1], at[2])])
                   .norm();
        }
      }
    }
    lengths[axis] = sum / lines;
  }
  return lengths;
}

void AddFieldData(const ParameterDomain& domain, vtkFieldData* fields)
{
  WriteQuality(domain.Report, fields);
  std::vector<int> segments, iterations;
  std::vector<vtkIdType> folds;
  std::vector<std::uint8_t> refined;
  std::vector<double> residuals, deviations, largest, lengths;
  for (const auto& [segment, solved] : domain.Solved)
  {
    segments.push_back(segment);
    refined.push_back(domain.Thin.at(segment).Refined ? 1 : 0);
    const ParameterFolds& folded = domain.Folds.at(segment);
    folds.insert(folds.end(), { folded.Folded, folded.Cells });
    for (int axis = 0; axis < 3; ++axis)
    {
      const ParameterSolve& solve = solved.Solves[axis];
      iterations.push_back(solve.Iterations);
      residuals.push_back(solve.Residual);
      const double length = solved.Lengths[axis].back();
      deviations.push_back(solve.MeanDeviation / length);
      largest.push_back(solve.Deviation / length);
      lengths.push_back(length);
    }
  }
  fields->AddArray(Copied<vtkIntArray>("ParameterSegment", 1, segments));
  fields->AddArray(Copied<vtkUnsignedCharArray>("ParameterRefined", 1, refined));
  fields->AddArray(Copied<vtkIdTypeArray>("ParameterFolds", 2, folds));
  fields->AddArray(Copied<vtkIntArray>("ParameterIterations", 3, iterations));
  fields->AddArray(Copied<vtkDoubleArray>("ParameterResidual", 3, residuals));
  fields->AddArray(Copied<vtkDoubleArray>("ParameterDeviation", 3, deviations));
  fields->AddArray(Copied<vtkDoubleArray>("ParameterLargestDeviation", 3, largest));
  fields->AddArray(Copied<vtkDoubleArray>("ParameterLengths", 3, lengths));
}
}

//------------------------------------------------------------------------------
void WriteParameters(const ParameterDomain& domain, vtkImageData* image)
{
  image->GetPointData()->AddArray(Copied<vtkDoubleArray>("Parameter", 3, domain.Parameter));
  image->GetPointData()->AddArray(Copied<vtkUnsignedCharArray>("ParameterMask", 1, domain.Mask));
  image->GetPointData()->AddArray(Copied<vtkIntArray>("Block", 1, domain.Block));
  image->GetPointData()->AddArray(
    Copied<vtkDoubleArray>("FrameParameter", 3, domain.FrameParameter));
  image->GetPointData()->AddArray(
    Copied<vtkUnsignedCharArray>("FrameParameterMask", 1, domain.FrameMask));
  AddFieldData(domain, image->GetFieldData());
}

//------------------------------------------------------------------------------
void WriteLengths(const ParameterDomain& domain, vtkUnstructuredGrid* polycube)
{
  const auto positions = Named<vtkDoubleArray>("DomainPosition", 3);
  positions->SetNumberOfTuples(polycube->GetNumberOfPoints());
  positions->Fill(0.0);
  const DomainInput& input = domain.Input;
  for (Index block = 0; block < domain.Complex.Size(); ++block)
  {
    const auto solved = domain.Solved.find(domain.Complex.Segments[block]);
    for (const Index point : input.Domain.Blocks[block])
    {
      for (int axis = 0; axis < 3 && solved != domain.Solved.end(); ++axis)
      {
        const std::vector<int>& planes = solved->second.Coordinates[axis];
        const auto at =
          std::lower_bound(planes.begin(), planes.end(), input.Coordinates[point][axis]);
        if (at != planes.end())
        {
          positions->SetComponent(point, axis, solved->second.Lengths[axis][at - planes.begin()]);
        }
      }
    }
  }
  const auto lengths = Named<vtkDoubleArray>("BlockLengths", 3);
  lengths->SetNumberOfTuples(polycube->GetNumberOfCells());
  for (Index block = 0; block < domain.Complex.Size(); ++block)
  {
    lengths->SetTuple(block, LengthsOf(domain.Mesh, block).data());
  }
  polycube->GetPointData()->AddArray(positions);
  polycube->GetCellData()->AddArray(lengths);
  polycube->GetCellData()->AddArray(Copied<vtkIntArray>("Block", 1, domain.Complex.Groups));
}

//------------------------------------------------------------------------------
void AddParameters(vtkImageData* whole, vtkImageData* image)
{
  const bool isWhole = std::equal(whole->GetExtent(), whole->GetExtent() + 6, image->GetExtent());
  for (int a = 0; a < whole->GetPointData()->GetNumberOfArrays(); ++a)
  {
    const vtkSmartPointer<vtkDataArray> array = whole->GetPointData()->GetArray(a);
    image->GetPointData()->AddArray(
      isWhole ? array : CutToExtent(array, whole->GetExtent(), image->GetExtent()));
  }
  for (int a = 0; a < whole->GetFieldData()->GetNumberOfArrays(); ++a)
  {
    image->GetFieldData()->AddArray(whole->GetFieldData()->GetAbstractArray(a));
  }
}

//------------------------------------------------------------------------------
void ShareParameters(
  vtkImageData* whole, vtkImageData* image, vtkMultiProcessController* controller)
{
  controller->Broadcast(whole, 0);
  AddParameters(whole, image);
}
}
