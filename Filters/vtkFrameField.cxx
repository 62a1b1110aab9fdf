// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkFrameField.h"

#include "FrameOutput.h"
#include "FrameSurface.h"
#include "LabelledImage.h"
#include "ListProperty.h"
#include "MemoryLimit.h"
#include "SMPExecution.h"
#include "SegmentSurface.h"
#include "SharedPieces.h"

#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"

#include <algorithm>
#include <cmath>
#include <new>
#include <stdexcept>

using namespace trivariate;

vtkStandardNewMacro(vtkFrameField);
vtkCxxSetObjectMacro(vtkFrameField, Controller, vtkMultiProcessController);

namespace
{
constexpr double BytesPerGridVoxel = 45.0; // frames, mask, numbers of voxels
constexpr double MostAstray = 0.5;         // share of a surface

std::vector<std::uint8_t> MaskOf(const LabelledImage& image, int segment)
{
  std::vector<std::uint8_t> mask(image.Labels.size());
  std::transform(image.Labels.begin(), image.Labels.end(), mask.begin(),
    [segment](std::int32_t label) { return static_cast<std::uint8_t>(label == segment ? 1 : 0); });
  return mask;
}

// The columns are the image's axes in space, with the spacing as their lengths.
Eigen::Matrix3d StepsOf(const LabelledImage& image)
{
  using Matrix = Eigen::Matrix<double, 4, 4, Eigen::RowMajor>;
  return Eigen::Map<const Matrix>(image.IndexToPhysical.data()).topLeftCorner<3, 3>();
}

SegmentField MakeField(const LabelledImage& image, int segment, const FrameSurfaces& surfaces,
  const FieldOptions& options, const Execution& execution)
{
  const auto surface = surfaces.find(segment);
  if (surface == surfaces.end())
  {
    throw std::invalid_argument("It has no patches; leave it out, or give it a domain.");
  }
  FrameVoxels voxels =
    CollectVoxels(image.View().Size, MaskOf(image, segment).data(), execution.Part(0.0, 0.05));
  voxels.Steps = StepsOf(image);
  SurfaceConstraints bound = ConstrainToSurface(voxels, surface->second, execution.Part(0.05, 0.1));
  if (bound.Astray > MostAstray)
  {
    throw std::invalid_argument("Of the area of its surface " +
                                std::to_string(std::lround(100.0 * bound.Astray)) +
                                " % is away from its voxels; the surface is of another image.");
  }
  return ComputeSegmentField(
    std::move(voxels), std::move(bound.Constraints), options, execution.Part(0.1, 1.0));
}
}

//------------------------------------------------------------------------------
vtkFrameField::vtkFrameField()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "Segment");
  this->SetController(vtkMultiProcessController::GetGlobalController());
}

vtkFrameField::~vtkFrameField()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkFrameField::AddSegment(int segment)
{
  AddEntry(this, this->Segments, segment);
}

void vtkFrameField::ClearSegments()
{
  ClearEntries(this, this->Segments);
}

int vtkFrameField::GetSegment(int i) const
{
  return EntryOf(this->Segments, i, -1);
}

//------------------------------------------------------------------------------
vtkPolyData* vtkFrameField::GetSingularGraph()
{
  return vtkPolyData::SafeDownCast(this->GetOutputDataObject(1));
}

vtkTable* vtkFrameField::GetEnergies()
{
  return vtkTable::SafeDownCast(this->GetOutputDataObject(2));
}

//------------------------------------------------------------------------------
int vtkFrameField::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkPolyData");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkFrameField::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* const types[3] = { "vtkImageData", "vtkPolyData", "vtkTable" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
int vtkFrameField::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  if (!gathering)
  {
    RequestWholeImage(inputVector[0]->GetInformationObject(0));
  }
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    RequestPiece(inputVector[1]->GetInformationObject(0), outputVector, gathering);
  }
  return 1;
}

//------------------------------------------------------------------------------
LabelledImage vtkFrameField::ReadImage(vtkImageData* input, std::string& fault)
{
  try
  {
    if (input->GetNumberOfPoints() > 0)
    {
      vtkDataArray* labels = ChosenLabels(input, this->GetInputArrayToProcess(0, input),
        this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME()));
      return ReadLabels(input, labels, nullptr);
    }
  }
  catch (const std::exception& error)
  {
    fault = error.what();
  }
  return {};
}

//------------------------------------------------------------------------------
// Collective: process 0 gets all. False where all processes are to end here, one with a fault.
bool vtkFrameField::Gather(LabelledImage& image, vtkPolyData* surface, std::string& fault)
{
  try
  {
    if (!GatherLabels(image, fault, this->Controller))
    {
      return false;
    }
  }
  catch (const std::exception& error)
  {
    fault = error.what(); // of process 0; the others go on
  }
  vtkNew<vtkPolyData> own;
  own->ShallowCopy(surface);
  surface->Initialize();
  GatherSurface(own, surface, this->Controller);
  if (fault.empty() && this->Controller->GetLocalProcessId() == 0)
  {
    vtkWarningMacro("Frames are made on one process: the pieces of "
                    << this->Controller->GetNumberOfProcesses()
                    << " processes were gathered to process 0.");
  }
  return true;
}

//------------------------------------------------------------------------------
int vtkFrameField::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkPolyData* patches = vtkPolyData::GetData(inputVector[1]);
  const bool gathering = ArePiecesShared(this->Controller, outputVector);
  std::string fault;
  LabelledImage image = this->ReadImage(input, fault);
  vtkNew<vtkPolyData> surface;
  if (patches)
  {
    surface->ShallowCopy(patches);
  }
  const bool goesOn = !gathering || this->Gather(image, surface, fault);
  std::unique_ptr<FrameOutput> output;
  if (fault.empty() && goesOn && (!gathering || this->Controller->GetLocalProcessId() == 0))
  {
    try
    {
      output = this->MakeFields(image, patches ? surface.Get() : nullptr);
    }
    catch (const Aborted&) // the executive empties the outputs
    {
    }
    catch (const std::bad_alloc&)
    {
      fault = "Out of memory; crop or coarsen the image.";
    }
    catch (const std::exception& error)
    {
      fault = error.what();
    }
  }
  if (gathering && goesOn)
  {
    output = output ? std::move(output) : std::make_unique<FrameOutput>(LabelledImage());
    output->Share(this->Controller);
  }
  if (!fault.empty())
  {
    vtkErrorMacro(<< fault);
  }
  else if (output && !output->IsEmpty())
  {
    vtkImageData* result = vtkImageData::GetData(outputVector, 0);
    result->ShallowCopy(input);
    output->AddTo(result);
    if (outputVector->GetInformationObject(0)->Get(
          vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) == 0)
    {
      vtkPolyData::GetData(outputVector, 1)->ShallowCopy(output->Graph);
      vtkTable::GetData(outputVector, 2)->ShallowCopy(output->Sweeps);
    }
  }
  return fault.empty() && goesOn ? 1 : 0;
}

//------------------------------------------------------------------------------
FieldOptions vtkFrameField::Options() const
{
  FieldOptions options;
  options.Start = this->Start == PRINCIPAL_AXES         ? FieldStart::Constant
                  : this->Start == HARMONIC_COORDINATES ? FieldStart::HarmonicCoordinates
                                                        : FieldStart::Linear;
  options.ChooseStep = this->Step == AUTOMATIC;
  options.Smoothing.Step = this->Step == QUARTIC ? FrameStep::Quartic : FrameStep::Registration;
  options.Smoothing.Jumps = this->Step == REGISTRATION_WITH_JUMPS;
  options.Smoothing.Relaxed = this->Relaxed;
  options.Smoothing.Sweeps = this->Sweeps;
  options.Smoothing.Drop = this->EnergyDrop;
  options.CoarseToFine = this->CoarseToFine;
  return options;
}

//------------------------------------------------------------------------------
std::unique_ptr<FrameOutput> vtkFrameField::MakeFields(
  const LabelledImage& image, vtkPolyData* patches)
{
  if (image.Labels.empty())
  {
    throw std::invalid_argument("The image has no points.");
  }
  FrameSurfaces surfaces;
  std::set<int> chosen(this->Segments.begin(), this->Segments.end());
  if (patches)
  {
    surfaces = ReadFrameSurfaces(patches, image);
    for (auto named = surfaces.upper_bound(0); this->Segments.empty() && named != surfaces.end();
         ++named)
    {
      chosen.insert(named->first);
    }
  }
  const std::set<int> present = CheckSegments(image, { chosen.begin(), chosen.end() });
  if (chosen.empty())
  {
    chosen.insert(present.upper_bound(0), present.end());
  }
  if (chosen.empty())
  {
    throw std::invalid_argument("All voxels have the label 0, the background.");
  }
  const FieldOptions options = this->Options();
  std::map<int, Index> sizes;
  Index all = 0, largest = 0;
  for (const int segment : chosen)
  {
    sizes[segment] = std::count(image.Labels.begin(), image.Labels.end(), segment);
    all += sizes[segment];
    largest = std::max(largest, sizes[segment]);
  }
  const std::string lack =
    MemoryFault("The frame field", BytesPerGridVoxel * static_cast<double>(image.Labels.size()) +
                                     FieldBytesPerVoxel(options) * static_cast<double>(largest));
  if (!lack.empty())
  {
    throw std::invalid_argument(lack);
  }
  const double start = patches ? 0.0 : 0.1;
  if (!patches)
  {
    surfaces =
      MakeFrameSurfaces(image, { chosen.begin(), chosen.end() }, SMPExecution(this, 0.0, start));
  }
  auto output = std::make_unique<FrameOutput>(image);
  Index done = 0;
  for (const int segment : chosen)
  {
    const auto shareOf = [start, all](Index voxels)
    { return start + (1.0 - start) * static_cast<double>(voxels) / static_cast<double>(all); };
    const Execution execution = SMPExecution(this, shareOf(done), shareOf(done + sizes[segment]));
    try
    {
      output->Add(segment, MakeField(image, segment, surfaces, options, execution), image);
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument("Segment " + std::to_string(segment) + ": " + error.what());
    }
    done += sizes[segment];
  }
  return output;
}

//------------------------------------------------------------------------------
void vtkFrameField::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Segments:";
  for (int segment : this->Segments)
  {
    os << " " << segment;
  }
  os << "\n" << indent << "Step: " << this->Step << "\n";
  os << indent << "Start: " << this->Start << "\n";
  os << indent << "CoarseToFine: " << this->CoarseToFine << "\n";
  os << indent << "Relaxed: " << this->Relaxed << "\n";
  os << indent << "Sweeps: " << this->Sweeps << "\n";
  os << indent << "EnergyDrop: " << this->EnergyDrop << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
