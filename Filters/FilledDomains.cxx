// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FilledDomains.h"

#include "ChainStep.h"
#include "DomainSelection.h"
#include "Parameter/BlockCells.h"
#include "vtkFrameField.h"
#include "vtkHexRemesh.h"
#include "vtkVolumeParameterization.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStructuredGrid.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
// Where the steps end, as shares of their progress.
constexpr double Framed = 0.25, Parameterized = 0.7;

// Of cells, in voxels: two, or longer where more cells would fill the image than are untangled
// within half a minute.
double CellLength(vtkImageData* image)
{
  constexpr double mostCells = 30000.0;
  return std::max(2.0, std::cbrt(static_cast<double>(image->GetNumberOfPoints()) / mostCells));
}

//------------------------------------------------------------------------------
// Segments with a cell that is inverted somewhere.
std::set<int> FoldedSegments(const FilledDomains& domains)
{
  std::set<int> folded;
  vtkDataArray* owners = domains.Polycubes->GetCellData()->GetArray("Segment");
  vtkNew<vtkIdList> ids;
  for (unsigned int b = 0; b < domains.Blocks->GetNumberOfPartitionedDataSets(); ++b)
  {
    auto* grid = vtkStructuredGrid::SafeDownCast(domains.Blocks->GetPartition(b, 0));
    std::vector<Eigen::Vector3d> places(grid->GetNumberOfPoints());
    for (std::size_t p = 0; p < places.size(); ++p)
    {
      grid->GetPoint(static_cast<vtkIdType>(p), places[p].data());
    }
    for (vtkIdType cell = 0; cell < grid->GetNumberOfCells(); ++cell)
    {
      grid->GetCellPoints(cell, ids);
      BlockPoints corners;
      std::copy_n(ids->begin(), 8, corners.begin());
      if (!(LeastDeterminant(places, corners) > 0.0))
      {
        folded.insert(static_cast<int>(owners->GetTuple1(b)));
      }
    }
  }
  return folded;
}

//------------------------------------------------------------------------------
// Parameters of the segments with cubes, from an image with frames.
FilledDomains Parameterize(vtkImageData* frames, vtkPolyData* patches,
  vtkUnstructuredGrid* polycubes, Chain& chain, double from, double to)
{
  vtkNew<vtkVolumeParameterization> parameters;
  parameters->SetController(nullptr);
  parameters->SetInputData(0, frames);
  parameters->SetInputData(1, patches);
  parameters->SetInputData(2, polycubes);
  parameters->SetCellLength(CellLength(frames));
  parameters->RefineThinPartsOff(); // fits do not take FrameParameter
  ChainStep(parameters, chain, from, to).RunTelling();
  FilledDomains domains;
  domains.Fields = vtkImageData::SafeDownCast(parameters->GetOutputDataObject(0));
  domains.Polycubes = parameters->GetPolycube();
  domains.Blocks = parameters->GetBlocks();
  domains.Folded = FoldedSegments(domains);
  vtkDataArray* owners = domains.Polycubes->GetCellData()->GetArray("Segment");
  for (vtkIdType block = 0; block < domains.Polycubes->GetNumberOfCells(); ++block)
  {
    ++domains.BlocksOf[static_cast<int>(owners->GetTuple1(block))];
  }
  return domains;
}

//------------------------------------------------------------------------------
FilledDomains FillAll(vtkImageData* image, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  Chain& chain, double from, double to)
{
  const auto at = [from, to](double share) { return from + (to - from) * share; };
  vtkNew<vtkFrameField> frames;
  frames->SetController(nullptr);
  frames->SetInputData(0, image);
  frames->SetInputData(1, patches);
  ChainStep(frames, chain, from, at(Framed)).Run();
  FilledDomains domains = Parameterize(vtkImageData::SafeDownCast(frames->GetOutputDataObject(0)),
    patches, polycubes, chain, at(Framed), at(Parameterized));

  // Not the blocks of the parameters, whose layers are thin: those for a solver have better angles.
  const double* spacing = image->GetSpacing();
  vtkNew<vtkHexRemesh> hexahedra;
  hexahedra->SetEdgeLength(CellLength(image) * std::cbrt(spacing[0] * spacing[1] * spacing[2]));
  hexahedra->SetInputDataObject(0, image);
  hexahedra->SetInputDataObject(1, patches);
  hexahedra->SetInputDataObject(2, polycubes);
  try
  {
    ChainStep(hexahedra, chain, at(Parameterized), to).RunTelling();
    domains.Hexahedra = hexahedra->GetHexahedra();
  }
  catch (const std::runtime_error& reason) // no fit needs them
  {
    chain.Warnings.push_back(std::string("There are no hexahedra: ") + reason.what());
  }
  return domains;
}

// The segment that a message begins with; -1: none.
int SegmentNamed(const std::string& message)
{
  int segment = -1;
  return std::sscanf(message.c_str(), "Segment %d:", &segment) == 1 ? segment : -1;
}
}

//------------------------------------------------------------------------------
FilledDomains FillDomains(vtkImageData* image, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  Chain& chain, double from, double to)
{
  while (true)
  {
    try
    {
      return FillAll(image, patches, polycubes, chain, from, to);
    }
    catch (const std::runtime_error& reason)
    {
      const int segment = SegmentNamed(reason.what());
      const vtkIdType before = polycubes->GetNumberOfCells();
      LeaveOut({ segment }, patches, polycubes);
      const vtkIdType left = polycubes->GetNumberOfCells();
      if (left == 0 || left == before)
      {
        throw;
      }
      const std::string why = reason.what();
      chain.Warnings.push_back("Segment " + std::to_string(segment) +
                               " is fitted over its bounding box" + why.substr(why.find(':')));
    }
  }
}

//------------------------------------------------------------------------------
FilledDomains FillCubesAlone(
  const FilledDomains& filled, vtkPolyData* patches, Chain& chain, double from, double to)
{
  const vtkNew<vtkUnstructuredGrid> cubes = WithoutLayers(filled.Polycubes);
  vtkNew<vtkPolyData> theirs;
  theirs->ShallowCopy(patches);
  LeaveOutInverted(theirs, cubes);
  return cubes->GetNumberOfCells() > 0 ? Parameterize(filled.Fields, theirs, cubes, chain, from, to)
                                       : FilledDomains();
}
}
