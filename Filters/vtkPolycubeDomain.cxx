// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkPolycubeDomain.h"

#include "CornerGuess.h"
#include "DomainOutput.h"
#include "FilterRun.h"
#include "ListProperty.h"
#include "PickedCorners.h"
#include "SMPExecution.h"
#include "SegmentDomains.h"
#include "SegmentSurface.h"
#include "SharedPieces.h"

#include "vtkDoubleArray.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <iterator>
#include <stdexcept>
#include <string>

using namespace trivariate;

vtkStandardNewMacro(vtkPolycubeDomain);
vtkCxxSetObjectMacro(vtkPolycubeDomain, Controller, vtkMultiProcessController);

namespace
{
constexpr const char* OwnCornersOnly =
  " Here a process was asked for all, and knows only the corners that it has itself: update the "
  "filter on all processes first.";

std::vector<Eigen::Vector3d> PointsOf(const std::vector<double>& coordinates)
{
  std::vector<Eigen::Vector3d> points;
  for (std::size_t i = 0; i + 2 < coordinates.size(); i += 3)
  {
    points.emplace_back(coordinates[i], coordinates[i + 1], coordinates[i + 2]);
  }
  return points;
}

// In their order, each once.
std::vector<int> Unique(const std::vector<int>& segments)
{
  std::vector<int> unique;
  std::copy_if(segments.begin(), segments.end(), std::back_inserter(unique),
    [&unique](int segment)
    { return std::find(unique.begin(), unique.end(), segment) == unique.end(); });
  return unique;
}
}

// What is kept from one update to the next: the surface of the only segment and its corners.
struct vtkPolycubeDomain::Internals
{
  // Keeps the guess as long as surface, segment and options are the same.
  void GuessFor(
    const LabelledSurface& surface, const std::vector<int>& chosen, const DomainOptions& options)
  {
    std::vector<SurfacePiece> pieces;
    try
    {
      if (chosen.size() == 1)
      {
        pieces = PiecesOf(surface, chosen[0]);
      }
    }
    catch (const std::invalid_argument&) // told where domains are made
    {
    }
    if (pieces.size() != 1)
    {
      this->Guess.reset();
      return;
    }
    SurfaceMesh& mesh = pieces[0].Mesh;
    if (!this->Guess || !this->Guess->IsFor(mesh, options))
    {
      this->Guess = std::make_unique<CornerGuess>(std::move(mesh), options);
    }
  }

  // A domain with picked corners; with those of the guess where there are none.
  DomainSet ByHand(const LabelledSurface& surface, int segment, const DomainSettings& settings,
    vtkPolycubeDomain* self, const std::vector<Eigen::Vector3d>& picked)
  {
    OnlyPieceOf(surface, segment); // or there is no guess
    CornerGuess& guess = *this->Guess;
    const Polycube shape =
      guess.Shape(self->NumberOfCubes, self->SwitchedOffCubes, SMPExecution(self, 0.0, 0.5));
    const std::vector<Eigen::Vector3d> corners =
      picked.empty() ? guess.Corners(shape, SMPExecution(self, 0.5, 0.6)) : picked;
    DomainSet set;
    AddDomainFromCorners(surface, segment, shape, corners, self->SnapLimit, settings,
      SMPExecution(self, 0.6, 1.0), set);
    return set;
  }

  // Those of the guess, which searches for them the first time.
  std::vector<Eigen::Vector3d> FindStartCorners(vtkPolycubeDomain* self)
  {
    const Polycube shape =
      this->Guess->Shape(self->NumberOfCubes, self->SwitchedOffCubes, SMPExecution(self, 0.0, 0.5));
    return this->Guess->Corners(shape, SMPExecution(self, 0.5, 1.0));
  }

  std::unique_ptr<CornerGuess> Guess;
  vtkNew<vtkDoubleArray> StartCorners;
};

//------------------------------------------------------------------------------
vtkPolycubeDomain::vtkPolycubeDomain()
  : Internal(new Internals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkPolycubeDomain::~vtkPolycubeDomain()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkPolycubeDomain::AddSegment(int segment)
{
  AddEntry(this, this->Segments, segment);
}

void vtkPolycubeDomain::ClearSegments()
{
  ClearEntries(this, this->Segments);
}

int vtkPolycubeDomain::GetSegment(int i) const
{
  return EntryOf(this->Segments, i, -1);
}

//------------------------------------------------------------------------------
void vtkPolycubeDomain::AddSwitchedOffCube(int cube)
{
  AddEntry(this, this->SwitchedOffCubes, cube);
}

void vtkPolycubeDomain::ClearSwitchedOffCubes()
{
  ClearEntries(this, this->SwitchedOffCubes);
}

int vtkPolycubeDomain::GetSwitchedOffCube(int i) const
{
  return EntryOf(this->SwitchedOffCubes, i, -1);
}

//------------------------------------------------------------------------------
void vtkPolycubeDomain::AddCornerPosition(double x, double y, double z)
{
  this->CornerPositions.insert(this->CornerPositions.end(), { x, y, z });
  this->Modified();
}

void vtkPolycubeDomain::ClearCornerPositions()
{
  ClearEntries(this, this->CornerPositions);
}

//------------------------------------------------------------------------------
vtkDoubleArray* vtkPolycubeDomain::GetStartCorners()
{
  vtkDoubleArray* corners = this->Internal->StartCorners;
  corners->SetNumberOfComponents(3);
  corners->SetNumberOfTuples(0);
  if (this->Internal->Guess)
  {
    // Nobody asked this search to stop yet, nor, once it has, the next update.
    const auto forgetAborts = [this]()
    {
      this->AbortExecute = 0;
      this->SetAbortOutput(false);
    };
    forgetAborts();
    try
    {
      for (const Eigen::Vector3d& corner : this->Internal->FindStartCorners(this))
      {
        corners->InsertNextTuple(corner.data());
      }
    }
    catch (const Aborted&)
    {
      forgetAborts();
    }
    catch (const std::exception&)
    {
      // The next update tells what is wrong with the shape.
    }
    this->UpdateProgress(1.0);
  }
  if (corners->GetNumberOfTuples() == 0)
  {
    corners->InsertNextTuple3(0.0, 0.0, 0.0);
  }
  return corners;
}

//------------------------------------------------------------------------------
vtkPolyData* vtkPolycubeDomain::GetPatches()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(0));
}

vtkUnstructuredGrid* vtkPolycubeDomain::GetPolycube()
{
  return vtkUnstructuredGrid::SafeDownCast(this->GetOutputDataObject(1));
}

vtkPolyData* vtkPolycubeDomain::GetBorders()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(2));
}

//------------------------------------------------------------------------------
int vtkPolycubeDomain::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkPolyData" : "vtkPointSet");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkPolycubeDomain::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 1 ? "vtkUnstructuredGrid" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkPolycubeDomain::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  for (int port = 0; port < 2; ++port)
  {
    if (inputVector[port]->GetNumberOfInformationObjects() > 0)
    {
      RequestPiece(inputVector[port]->GetInformationObject(0), outputVector, gathering);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkPolycubeDomain::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkPolyData* input = vtkPolyData::GetData(inputVector[0]);
  vtkPointSet* points = vtkPointSet::GetData(inputVector[1]);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  const int piece = outputVector->GetInformationObject(0)->Get(
    vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER());
  if (!gathering && piece > 0)
  {
    return 1; // the first piece is all
  }
  return RunTellingErrors(this, "coarsen the surface.",
    [&]()
    {
      vtkNew<vtkPolyData> surface, corners;
      surface->ShallowCopy(input);
      if (points)
      {
        corners->SetPoints(points->GetPoints());
        corners->GetPointData()->AddArray(points->GetPointData()->GetArray(CornerSegmentName));
      }
      if (gathering)
      {
        surface->Initialize();
        GatherSurface(input, surface, this->Controller);
        corners->ShallowCopy(GatherCorners(corners, this->Controller));
        if (const auto answer =
              AnswerElsewhere(this, "Domains are made on one process", true, "", this->Controller))
        {
          return *answer;
        }
      }
      try
      {
        this->MakeDomains(surface, points ? corners.Get() : nullptr, outputVector);
      }
      catch (const std::invalid_argument& error)
      {
        const bool ownOnly = this->Mode == MANUAL && points && !gathering && this->Controller &&
                             this->Controller->GetNumberOfProcesses() > 1;
        throw std::invalid_argument(error.what() + std::string(ownOnly ? OwnCornersOnly : ""));
      }
      catch (const Aborted&)
      {
        this->Internal->Guess.reset(); // or GetStartCorners() would search in place of it
        throw;
      }
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkPolycubeDomain::MakeDomains(
  vtkPolyData* input, vtkPolyData* corners, vtkInformationVector* outputVector)
{
  const LabelledSurface surface = ReadSurface(input);
  const std::vector<int> chosen =
    this->Segments.empty() ? SegmentsIn(surface) : Unique(this->Segments);
  DomainSettings settings;
  settings.Options.CornerCost = this->CornerCost;
  settings.Options.MostCubes = this->MostCubes;
  settings.Options.Relax = this->RelaxBorders;
  settings.Layered = this->Layered;
  settings.LayerDepth = this->LayerDepth;
  settings.Voxel = surface.Voxel;
  this->Internal->GuessFor(surface, chosen, settings.Options);

  DomainSet domains;
  PickedCorners picked;
  if (this->Mode == MANUAL && corners && corners->GetNumberOfPoints() == 0)
  {
    throw std::invalid_argument("The second input has no corners.");
  }
  if (this->Mode == AUTOMATIC)
  {
    domains = FindDomains(surface, chosen, settings, SMPExecution(this));
    if (this->Internal->Guess && domains.Segments.size() == 1)
    {
      this->Internal->Guess->SetAutomatic(domains.Surfaces[0].Domain);
    }
    else if (this->Internal->Guess && !domains.Failures.empty())
    {
      const std::string name = "Segment " + std::to_string(chosen[0]) + ": ";
      this->Internal->Guess->SetFailure(domains.Failures.front().substr(name.size()));
    }
  }
  else if (chosen.size() != 1 && HaveSegments(corners))
  {
    picked = CornersBySegment(corners, chosen);
    const auto shapeOf = [&](const SurfaceMesh& mesh, const Execution& execution)
    {
      return CornerGuess(mesh, settings.Options)
        .Shape(this->NumberOfCubes, this->SwitchedOffCubes, execution);
    };
    domains = DomainsFromCorners(
      surface, chosen, picked, shapeOf, this->SnapLimit, settings, SMPExecution(this));
  }
  else if (chosen.size() != 1)
  {
    std::string labels;
    for (const int segment : chosen)
    {
      labels += (labels.empty() ? "" : ", ") + std::to_string(segment);
    }
    throw std::invalid_argument(
      "Corners are picked for one segment; of " + labels +
      " enter one as Segments, apply the automatic mode, then pick. Points "
      "of a second input may be for several: their array Segment says "
      "whose each is.");
  }
  else
  {
    try
    {
      std::vector<Eigen::Vector3d>& own = picked[chosen[0]];
      own = HaveSegments(corners)                     ? CornersBySegment(corners, chosen)[chosen[0]]
            : corners                                 ? ReadPoints(corners)
            : this->GetNumberOfCornerPositions() == 1 ? std::vector<Eigen::Vector3d>()
                                                      : PointsOf(this->CornerPositions);
      domains = this->Internal->ByHand(surface, chosen[0], settings, this, own);
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument("Segment " + std::to_string(chosen[0]) + ": " + error.what());
    }
    catch (const std::runtime_error& error)
    {
      throw std::runtime_error("Segment " + std::to_string(chosen[0]) + ": " + error.what());
    }
  }
  std::string failures;
  for (const std::string& failure : domains.Failures)
  {
    failures += (failures.empty() ? "" : "\n") + failure;
  }
  if (domains.Segments.empty())
  {
    throw std::runtime_error("There is no domain. " + failures);
  }
  for (const std::string& remark : domains.Remarks)
  {
    failures += (failures.empty() ? "" : "\n") + remark;
  }
  if (!failures.empty())
  {
    vtkWarningMacro(<< failures);
  }
  WriteDomains(surface, domains, picked, vtkPolyData::GetData(outputVector, 0),
    vtkUnstructuredGrid::GetData(outputVector, 1), vtkPolyData::GetData(outputVector, 2));
}

//------------------------------------------------------------------------------
void vtkPolycubeDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Mode: " << (this->Mode == AUTOMATIC ? "Automatic" : "Manual") << "\n";
  os << indent << "Segments:";
  for (const int segment : this->Segments)
  {
    os << " " << segment;
  }
  os << "\n"
     << indent << "NumberOfCubes: " << this->NumberOfCubes[0] << " " << this->NumberOfCubes[1]
     << " " << this->NumberOfCubes[2] << "\n";
  os << indent << "SwitchedOffCubes:";
  for (const int cube : this->SwitchedOffCubes)
  {
    os << " " << cube;
  }
  os << "\n" << indent << "CornerPositions: " << this->GetNumberOfCornerPositions() << "\n";
  os << indent << "SnapLimit: " << this->SnapLimit << "\n";
  os << indent << "CornerCost: " << this->CornerCost << "\n";
  os << indent << "MostCubes: " << this->MostCubes << "\n";
  os << indent << "RelaxBorders: " << this->RelaxBorders << "\n";
  os << indent << "Layered: " << this->Layered << "\n";
  os << indent << "LayerDepth: " << this->LayerDepth << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
