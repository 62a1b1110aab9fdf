// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTextureSegmentation.h"

#include "FilterRun.h"
#include "ListProperty.h"
#include "SMPExecution.h"
#include "SegmentationInput.h"
#include "SharedPieces.h"

#include "vtkDoubleArray.h"
#include "vtkExtentTranslator.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

using namespace trivariate;

vtkStandardNewMacro(vtkTextureSegmentation);
vtkCxxSetObjectMacro(vtkTextureSegmentation, Controller, vtkMultiProcessController);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

//------------------------------------------------------------------------------
std::vector<TextureAttribute> AttributesOf(const std::vector<std::string>& names)
{
  std::vector<TextureAttribute> attributes;
  for (const std::string& name : names)
  {
    int a = 0;
    while (a < TextureAttributeCount && name != TextureAttributeName(TextureAttribute(a)))
    {
      ++a;
    }
    if (a == TextureAttributeCount)
    {
      throw std::invalid_argument("There is no texture attribute \"" + name +
                                  "\"; the names are those of IBSI, for example "
                                  "AngularSecondMoment.");
    }
    const TextureAttribute attribute = static_cast<TextureAttribute>(a);
    if (std::find(attributes.begin(), attributes.end(), attribute) == attributes.end())
    {
      attributes.push_back(attribute);
    }
  }
  return attributes;
}

//------------------------------------------------------------------------------
// The points that a piece of the whole has to have, with the ghost levels that were asked for.
std::array<int, 6> RequestedExtent(vtkInformation* outInfo, const std::array<int, 6>& whole)
{
  vtkNew<vtkExtentTranslator> translator;
  translator->SetWholeExtent(const_cast<int*>(whole.data()));
  translator->SetPiece(outInfo->Get(Pipeline::UPDATE_PIECE_NUMBER()));
  translator->SetNumberOfPieces(outInfo->Get(Pipeline::UPDATE_NUMBER_OF_PIECES()));
  translator->SetGhostLevel(outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()));
  std::array<int, 6> extent = { 0, -1, 0, -1, 0, -1 };
  if (translator->PieceToExtent())
  {
    translator->GetExtent(extent.data());
  }
  return extent;
}

//------------------------------------------------------------------------------
// Whether any process has a fault. Process 0 keeps the first one to tell, the others none.
bool AnyFault(std::string& fault, const GatherBytes& gather, int process)
{
  std::vector<std::uint8_t> mine(fault.begin(), fault.end());
  if (!fault.empty())
  {
    mine.push_back(0);
  }
  const std::vector<std::uint8_t> all = gather(mine);
  fault = process == 0 ? std::string(all.begin(), std::find(all.begin(), all.end(), 0)) : "";
  return !all.empty();
}

//------------------------------------------------------------------------------
void AddTable(vtkFieldData* data, const char* name, int components,
  const std::vector<double>& values, const std::vector<std::string>& names = {})
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / std::max(1, components));
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  for (std::size_t c = 0; c < names.size(); ++c)
  {
    array->SetComponentName(static_cast<vtkIdType>(c), names[c].c_str());
  }
  data->AddArray(array);
}

void ToOutput(const SegmentationResult& result, double offset, vtkImageData* output)
{
  vtkNew<vtkIntArray> segment;
  segment->SetName("Segment");
  segment->SetNumberOfTuples(static_cast<vtkIdType>(result.Labels.size()));
  std::copy(result.Labels.begin(), result.Labels.end(), segment->GetPointer(0));
  output->GetPointData()->AddArray(segment);
  for (std::size_t a = 0; a < result.Attributes.size(); ++a)
  {
    vtkNew<vtkFloatArray> attribute;
    attribute->SetName(result.AttributeNames[a].c_str());
    attribute->SetNumberOfTuples(static_cast<vtkIdType>(result.Attributes[a].size()));
    std::copy(result.Attributes[a].begin(), result.Attributes[a].end(), attribute->GetPointer(0));
    output->GetPointData()->AddArray(attribute);
  }

  const int attributes = static_cast<int>(result.AttributeNames.size());
  std::vector<double> centres = result.Centres, means = result.MeanDensities, criterion;
  for (double& mean : means)
  {
    mean += offset;
  }
  for (int a = 0; a < attributes; ++a)
  {
    for (int s = 0; s < result.Segments && result.AttributeNames[a] == "Density"; ++s)
    {
      centres[s * attributes + a] += offset;
    }
  }
  for (const auto& [segments, silhouette] : result.Criterion)
  {
    criterion.insert(criterion.end(), { static_cast<double>(segments), silhouette });
  }
  vtkFieldData* data = output->GetFieldData();
  AddTable(data, "SegmentCentres", attributes, centres, result.AttributeNames);
  AddTable(data, "SegmentMeanDensity", 1, means);
  AddTable(data, "SegmentCriterion", 2, criterion);
  vtkNew<vtkIdTypeArray> sizes;
  sizes->SetName("SegmentSize");
  for (const Index size : result.Sizes)
  {
    sizes->InsertNextValue(size);
  }
  data->AddArray(sizes);
}
}

//------------------------------------------------------------------------------
vtkTextureSegmentation::vtkTextureSegmentation()
{
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetController(vtkMultiProcessController::GetGlobalController());
  for (const TextureAttribute attribute : DefaultTextureAttributes())
  {
    this->TextureAttributes.emplace_back(TextureAttributeName(attribute));
  }
}

vtkTextureSegmentation::~vtkTextureSegmentation()
{
  this->SetController(nullptr);
}

//------------------------------------------------------------------------------
void vtkTextureSegmentation::AddTextureAttribute(const char* name)
{
  if (name && *name)
  {
    AddEntry(this, this->TextureAttributes, std::string(name));
  }
}

void vtkTextureSegmentation::ClearTextureAttributes()
{
  ClearEntries(this, this->TextureAttributes);
}

const char* vtkTextureSegmentation::GetTextureAttribute(int i) const
{
  return i >= 0 && i < this->GetNumberOfTextureAttributes() ? this->TextureAttributes[i].c_str()
                                                            : nullptr;
}

// The array of SetInputArrayToProcess(0, ...); the active scalars as long as nothing was chosen,
// which a proxy says with an empty name.
vtkDataArray* vtkTextureSegmentation::ChosenArray(vtkImageData* image)
{
  const char* name = this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME());
  return name && !*name ? image->GetPointData()->GetScalars()
                        : this->GetInputArrayToProcess(0, image);
}

//------------------------------------------------------------------------------
// The properties as the core's options; throws std::invalid_argument where they make no sense.
SegmentationOptions vtkTextureSegmentation::Options() const
{
  SegmentationOptions options;
  options.Segments = this->NumberOfSegments;
  options.Texture.Radius = this->WindowRadius;
  options.Texture.GreyLevels = this->GreyLevels;
  options.Texture.Merged = this->MergeDirections;
  options.Texture.Range = this->DirectionRange;
  options.Texture.DirectionResolved = this->DirectionResolved;
  options.Texture.Attributes = AttributesOf(this->TextureAttributes);
  options.DensityWeight = this->DensityWeight;
  options.GradientWeight = this->GradientWeight;
  options.MinimumSegmentSize = this->MinimumSegmentSize;
  options.KeepAttributes = this->OutputAttributes;
  if (options.Texture.Attributes.empty() && this->DensityWeight + this->GradientWeight == 0.0)
  {
    throw std::invalid_argument("There is nothing to tell segments by: choose a texture "
                                "attribute, or give density or gradient a weight.");
  }
  if (!this->AutomaticGreyLevelRange && !(this->GreyLevelRange[0] < this->GreyLevelRange[1]))
  {
    std::ostringstream words;
    words << "The grey-level range is empty: its first value " << this->GreyLevelRange[0]
          << " is not below its second value " << this->GreyLevelRange[1] << ".";
    throw std::invalid_argument(words.str());
  }
  if (!this->AutomaticGreyLevelRange &&
      !std::isfinite(this->GreyLevelRange[1] - this->GreyLevelRange[0]))
  {
    std::ostringstream words;
    words << "The grey-level range from " << this->GreyLevelRange[0] << " to "
          << this->GreyLevelRange[1] << " is not finite.";
    throw std::invalid_argument(words.str());
  }
  return options;
}

//------------------------------------------------------------------------------
int vtkTextureSegmentation::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  if (ArePiecesShared(this->Controller, outputVector))
  {
    SegmentationOptions options;
    options.Texture.Radius = this->WindowRadius;
    vtkInformation* outInfo = outputVector->GetInformationObject(0);
    inInfo->Set(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS(),
      outInfo->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) + SegmentationNeighbourhood(options));
  }
  else
  {
    RequestWholeImage(inInfo);
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTextureSegmentation::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkInformation* inInfo = inputVector[0]->GetInformationObject(0);
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  vtkImageData* output = vtkImageData::GetData(outputVector);
  const bool distributed = ArePiecesShared(this->Controller, outputVector);
  const GatherBytes gather = GatherBytesOf(distributed ? this->Controller : nullptr);
  const int process = distributed ? this->Controller->GetLocalProcessId() : 0;

  std::array<int, 6> own, whole;
  input->GetExtent(own.data());
  whole = own;
  if (distributed)
  {
    inInfo->Get(Pipeline::WHOLE_EXTENT(), whole.data());
    own = RequestedExtent(outputVector->GetInformationObject(0), whole);
  }
  vtkDataArray* array = this->ChosenArray(input);
  SegmentationOptions options;
  std::string fault = FaultOf(
    [&]()
    {
      options = this->Options();
      const std::string found = SegmentationFault(input, array,
        this->GetInputArrayInformation(0)->Get(vtkDataObject::FIELD_NAME()), own, whole, options);
      if (!found.empty())
      {
        throw std::invalid_argument(found);
      }
    });
  return RunTellingErrors(this, "crop or coarsen the image, or choose fewer attributes.",
    [&]()
    {
      if (AnyFault(fault, gather, process))
      {
        if (fault.empty())
        {
          return 0; // process 0 tells
        }
        throw std::invalid_argument(fault);
      }
      GreyLevelOptions levels;
      levels.Count = this->GreyLevels;
      levels.AutomaticRange = this->AutomaticGreyLevelRange;
      levels.Range = { this->GreyLevelRange[0], this->GreyLevelRange[1] };

      SegmentationInput segmentationInput;
      SegmentationResult result;
      try
      {
        RunTogether(distributed ? this->Controller : nullptr,
          [&]()
          {
            segmentationInput =
              ReadSegmentationInput(input, array, own, whole, levels, gather, process);
            result = SegmentByTexture(segmentationInput.Piece, options, gather, SMPExecution(this));
          });
      }
      catch (const StoppedElsewhere&)
      {
        return 0; // the other process tells
      }
      output->ShallowCopy(input);
      if (input->GetNumberOfPoints() > 0)
      {
        output->Crop(own.data());
      }
      ToOutput(result, segmentationInput.Offset, output);
      if (process == 0 && segmentationInput.Constant)
      {
        vtkWarningMacro("All values are " << segmentationInput.Offset << ": there is one segment.");
      }
      else if (process == 0 && result.Segments < this->NumberOfSegments)
      {
        vtkWarningMacro("The image has "
                        << result.Segments
                        << (result.Segments == 1 ? " segment" : " segments that differ") << ", not "
                        << this->NumberOfSegments << " as asked for.");
      }
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkTextureSegmentation::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "NumberOfSegments: " << this->NumberOfSegments << "\n";
  os << indent << "WindowRadius: " << this->WindowRadius << "\n";
  os << indent << "GreyLevels: " << this->GreyLevels << "\n";
  os << indent << "AutomaticGreyLevelRange: " << this->AutomaticGreyLevelRange << "\n";
  os << indent << "GreyLevelRange: " << this->GreyLevelRange[0] << " " << this->GreyLevelRange[1]
     << "\n";
  os << indent << "MinimumSegmentSize: " << this->MinimumSegmentSize << "\n";
  os << indent << "DensityWeight: " << this->DensityWeight << "\n";
  os << indent << "GradientWeight: " << this->GradientWeight << "\n";
  os << indent << "TextureAttributes:";
  for (const std::string& name : this->TextureAttributes)
  {
    os << " " << name;
  }
  os << "\n" << indent << "MergeDirections: " << this->MergeDirections << "\n";
  os << indent << "DirectionRange: " << this->DirectionRange << "\n";
  os << indent << "DirectionResolved: " << this->DirectionResolved << "\n";
  os << indent << "OutputAttributes: " << this->OutputAttributes << "\n";
  os << indent << "Controller: " << this->Controller << "\n";
}
