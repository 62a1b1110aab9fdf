// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkHexRemesh.h"

#include "BlockMeshOutput.h"
#include "DomainInput.h"
#include "FilterRun.h"
#include "Parameter/BlockMeshing.h"
#include "SMPExecution.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using namespace trivariate;

namespace
{
// Of equal volumes beside right angles: less brings no better angles but cells of a third the size.
constexpr double Evenness = 0.35;
constexpr int Patience = 6;     // sweeps, within which nearest points are found anew twice
constexpr double Facing = 10.0; // less leaves pleats, more keeps faces off limbs
}

vtkStandardNewMacro(vtkHexRemesh);

//------------------------------------------------------------------------------
vtkHexRemesh::vtkHexRemesh()
{
  this->SetNumberOfInputPorts(4);
  this->SetNumberOfOutputPorts(2);
}

vtkUnstructuredGrid* vtkHexRemesh::GetHexahedra()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(1));
}

//------------------------------------------------------------------------------
int vtkHexRemesh::FillInputPortInformation(int port, vtkInformation* info)
{
  const char* const types[4] = { "vtkImageData", "vtkPolyData", "vtkUnstructuredGrid",
    "vtkPartitionedDataSetCollection" };
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), types[port]);
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port == 3);
  return 1;
}

int vtkHexRemesh::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(),
    port == 0 ? "vtkPartitionedDataSetCollection" : "vtkUnstructuredGrid");
  return 1;
}

// The first piece is all, from all of the inputs.
int vtkHexRemesh::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  using Pipeline = vtkStreamingDemandDrivenPipeline;
  for (int port = 0; port < 4; ++port)
  {
    for (int i = 0; i < inputVector[port]->GetNumberOfInformationObjects(); ++i)
    {
      vtkInformation* info = inputVector[port]->GetInformationObject(i);
      info->Set(Pipeline::UPDATE_PIECE_NUMBER(), 0);
      info->Set(Pipeline::UPDATE_NUMBER_OF_PIECES(), 1);
      info->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(), 0);
      if (info->Has(Pipeline::WHOLE_EXTENT()))
      {
        int extent[6];
        info->Get(Pipeline::WHOLE_EXTENT(), extent);
        info->Set(Pipeline::UPDATE_EXTENT(), extent, 6);
      }
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkHexRemesh::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  if (outputVector->GetInformationObject(0)->Get(
        vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1;
  }
  return RunTellingErrors(this, "choose a larger EdgeLength.",
    [&]()
    {
      this->Remesh(inputVector, outputVector);
      return 1;
    });
}

namespace
{
constexpr double FarthestOutside = 1.0; // of patches from their image, in voxels

// Whether the image is the one that the patches are of.
void CheckImage(vtkImageData* image, vtkPolyData* patches)
{
  if (image->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument("The image has no points.");
  }
  const int* extent = image->GetExtent();
  double outside = 0.0;
  for (vtkIdType p = 0; p < patches->GetNumberOfPoints(); ++p)
  {
    double x[3], index[3];
    patches->GetPoint(p, x);
    image->TransformPhysicalPointToContinuousIndex(x, index);
    for (int a = 0; a < 3; ++a)
    {
      const double beyond = std::max(extent[2 * a] - index[a], index[a] - extent[2 * a + 1]);
      if (std::isnan(beyond))
      {
        throw std::invalid_argument("A point of the patches is not finite.");
      }
      outside = std::max(beyond, outside);
    }
  }
  if (outside > FarthestOutside)
  {
    std::ostringstream fault;
    fault << "The patches reach " << outside
          << " voxels out of the image: it is not the one that they are of. Choose that one.";
    throw std::invalid_argument(fault.str());
  }
}

// " (segment 1: 3, segment 4: 2)"; nothing of the only segment.
std::string InvertedBySegment(const std::vector<Index>& inBlocks, const std::vector<int>& segments)
{
  std::map<int, Index> counts;
  for (std::size_t block = 0; block < segments.size(); ++block)
  {
    counts[segments[block]] += inBlocks[block];
  }
  std::string list;
  for (const auto& [segment, count] : counts)
  {
    if (count > 0 && counts.size() > 1)
    {
      list += (list.empty() ? " (segment " : ", segment ") + std::to_string(segment) + ": " +
              std::to_string(count);
    }
  }
  return list.empty() ? list : list + ")";
}

// A sentence where arrays at the nodes are not finite, or none.
std::string NotFiniteIn(vtkPointData* attributes)
{
  std::ostringstream warning;
  for (int a = 0; a < attributes->GetNumberOfArrays(); ++a)
  {
    vtkDataArray* array = attributes->GetArray(a);
    vtkIdType bad = 0;
    for (vtkIdType node = 0; node < array->GetNumberOfTuples(); ++node)
    {
      const double* tuple = array->GetTuple(node);
      bad += !std::all_of(tuple, tuple + array->GetNumberOfComponents(),
        [](double value) { return std::isfinite(value); });
    }
    if (bad > 0)
    {
      warning << "The array \"" << array->GetName() << "\" is not finite at " << bad << " of "
              << array->GetNumberOfTuples() << " nodes, nor in the image beside them. ";
    }
  }
  return warning.str();
}
}

//------------------------------------------------------------------------------
void vtkHexRemesh::Remesh(vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* image = vtkImageData::GetData(inputVector[0]);
  auto* given = vtkPartitionedDataSetCollection::GetData(inputVector[3]);
  this->InvertedBefore = this->InvertedCells = 0;
  this->LeastScaledJacobian = this->MeanScaledJacobian = 0.0;
  vtkPolyData* patches = vtkPolyData::GetData(inputVector[1]);
  CheckImage(image, patches);
  const DomainInput input = ReadDomain(patches, vtkUnstructuredGrid::GetData(inputVector[2]));
  const BlockDomain& domain = input.Domain;
  if (domain.Blocks.empty())
  {
    throw std::invalid_argument("The polycube is empty.");
  }

  const double* spacing = image->GetSpacing();
  const double voxel = std::min({ spacing[0], spacing[1], spacing[2] });
  BlockMeshOptions options;
  options.CellLength = this->EdgeLength > 0.0 ? this->EdgeLength : 2.0 * voxel;
  options.Freedom = FreedomOfNodes * voxel;
  options.CellsPerBlock = this->CellsPerBlock;
  options.LayerCells = this->CellsPerBlock > 0 ? 0.0 : options.CellLength;
  options.Repair.Evenness = Evenness;
  options.Repair.Patience = Patience;
  options.Repair.Facing = Facing;
  const double cells = CountCells(SizesOf(domain, options));
  if (cells > static_cast<double>(this->MostCells))
  {
    throw std::invalid_argument(
      "The mesh would have " + std::to_string(static_cast<vtkIdType>(cells)) +
      " cells, more than MostCells; choose " +
      (this->CellsPerBlock > 0 ? "fewer CellsPerBlock." : "a larger EdgeLength."));
  }
  const Execution execution = SMPExecution(this, 0.0, 0.95);
  BlockMeshReport report;
  const BlockMesh mesh = given ? RefineBlockMesh(domain, ReadBlockMesh(given, domain.Blocks),
                                   options, execution, &report)
                               : MakeBlockMesh(domain, options, execution, &report);
  this->InvertedBefore = report.Start.Inverted;
  this->InvertedCells = report.End.Inverted;
  this->LeastScaledJacobian = report.End.LeastJacobian;
  this->MeanScaledJacobian = report.End.MeanJacobian;
  if (report.End.Inverted > 0)
  {
    vtkWarningMacro(
      << report.End.Inverted << " of " << report.End.Cells << " cells are inverted"
      << InvertedBySegment(report.End.InvertedIn, domain.Segments)
      << ". Features thinner than four voxels, or corners that do "
         "not fit the shape, cause this; try a smaller EdgeLength, more cubes or other "
         "corners.");
  }
  const double farthest =
    std::max(report.Distances.ToFaces.Largest, report.Distances.FromFaces.Largest);
  if (this->CellsPerBlock == 0 && farthest > std::max(options.CellLength, voxel))
  {
    vtkWarningMacro(
      "The cells are up to "
      << farthest << " from the surface, more than they are long (" << options.CellLength
      << "), and may not hold its volume: the domain does not fit limbs or pits of the segment "
         "there. Try more cubes or other corners; PatchDistance and FaceDistance tell more.");
  }

  vtkNew<vtkPointData> attributes;
  SampleImage(image, mesh.Places, attributes);
  const std::string warning = NotFiniteIn(attributes);
  if (!warning.empty())
  {
    vtkWarningMacro(<< warning);
  }
  const BlockLabels labels{ domain.Segments, input.Groups, {} };
  WriteBlockMesh(
    mesh, labels, attributes, vtkPartitionedDataSetCollection::GetData(outputVector, 0));
  vtkUnstructuredGrid* hexahedra = vtkUnstructuredGrid::GetData(outputVector, 1);
  WriteHexahedra(mesh, labels, attributes, hexahedra);
  WriteQuality(report, hexahedra->GetFieldData());
}

//------------------------------------------------------------------------------
void vtkHexRemesh::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "EdgeLength: " << this->EdgeLength << "\n";
  os << indent << "CellsPerBlock: " << this->CellsPerBlock << "\n";
  os << indent << "MostCells: " << this->MostCells << "\n";
  os << indent << "InvertedBefore: " << this->InvertedBefore << "\n";
  os << indent << "InvertedCells: " << this->InvertedCells << "\n";
  os << indent << "LeastScaledJacobian: " << this->LeastScaledJacobian << "\n";
  os << indent << "MeanScaledJacobian: " << this->MeanScaledJacobian << "\n";
}
