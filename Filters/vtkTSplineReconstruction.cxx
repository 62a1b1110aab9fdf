// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineReconstruction.h"

#include "ChainStep.h"
#include "DomainOutput.h"
#include "DomainSelection.h"
#include "FilterRun.h"
#include "FittedPart.h"
#include "GivenDomains.h"
#include "LabelledImage.h"
#include "ListProperty.h"
#include "SMPExecution.h"
#include "SegmentFits.h"
#include "SegmentSurface.h"
#include "SharedPieces.h"
#include "SplitImage.h"
#include "TSplineGrid.h"
#include "vtkPolycubeDomain.h"
#include "vtkSegmentBoundary.h"
#include "vtkTSplineFit.h"

#include "vtkDataArray.h"
#include "vtkDataObject.h"
#include "vtkImageData.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkTable.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>

using namespace trivariate;

vtkStandardNewMacro(vtkTSplineReconstruction);

namespace
{
enum Outputs
{
  TSPLINE,
  ROUNDS,
  SEGMENTED,
  SURFACES,
  PATCHES,
  POLYCUBES,
  FIELDS,
  HEXAHEDRA,
  BLOCKS,
  NUMBER_OF_OUTPUTS
};

// Where the steps end, as shares of the progress.
constexpr double Whole = 0.23, Bounded = 0.27, LaidOut = 0.35, Filled = 0.5, FilledAgain = 0.6,
                 AllFitted = 0.9;

//------------------------------------------------------------------------------
// The image with these arrays only, and labels (or null: none).
vtkSmartPointer<vtkImageData> MakeImage(
  vtkImageData* like, const std::vector<vtkDataArray*>& arrays, vtkDataArray* labels)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->CopyStructure(like);
  for (vtkDataArray* array : arrays)
  {
    image->GetPointData()->AddArray(array);
  }
  image->GetPointData()->SetActiveScalars(arrays.front()->GetName());
  image->GetPointData()->AddArray(labels);
  return image;
}
}

//------------------------------------------------------------------------------
vtkTSplineReconstruction::vtkTSplineReconstruction()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(NUMBER_OF_OUTPUTS);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataSetAttributes::SCALARS);
  this->SetInputArrayToProcess(1, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS, "None");
}

vtkTSplineReconstruction::~vtkTSplineReconstruction() = default;

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::AddAttribute(const char* name)
{
  if (name && *name)
  {
    AddEntry(this, this->Attributes, std::string(name));
  }
}

void vtkTSplineReconstruction::ClearAttributes()
{
  ClearEntries(this, this->Attributes);
}

const char* vtkTSplineReconstruction::GetAttribute(int i) const
{
  return i >= 0 && i < this->GetNumberOfAttributes() ? this->Attributes[i].c_str() : nullptr;
}

//------------------------------------------------------------------------------
int vtkTSplineReconstruction::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(
    vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkUnstructuredGrid");
  info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), port);
  return 1;
}

int vtkTSplineReconstruction::FillOutputPortInformation(int port, vtkInformation* info)
{
  const char* types[] = { "vtkUnstructuredGrid", "vtkTable", "vtkImageData", "vtkPolyData",
    "vtkPolyData", "vtkUnstructuredGrid", "vtkImageData", "vtkUnstructuredGrid",
    "vtkPartitionedDataSetCollection" };
  info->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
// Images that are not made must not be asked for: whatever extent is wanted of them would never be
// there, and all be done again for it.
int vtkTSplineReconstruction::RequestInformation(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputVector)
{
  const int none[6] = { 0, -1, 0, -1, 0, -1 };
  for (const int port : { SEGMENTED, FIELDS })
  {
    if (this->Domain == BOX || (port == FIELDS && this->Domain == SEGMENTS))
    {
      outputVector->GetInformationObject(port)->Set(
        vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), none, 6);
    }
  }
  return 1;
}

//------------------------------------------------------------------------------
int vtkTSplineReconstruction::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector*)
{
  RequestWholeImage(inputVector[0]->GetInformationObject(0));
  if (inputVector[1]->GetNumberOfInformationObjects() > 0)
  {
    RequestAll(inputVector[1]->GetInformationObject(0));
  }
  return 1;
}

//------------------------------------------------------------------------------
// The arrays to fit, the first one the chosen one.
std::vector<vtkDataArray*> vtkTSplineReconstruction::ChosenArrays(vtkImageData* image)
{
  vtkDataArray* chosen = ChosenValues(this, image, this->GetInputArrayToProcess(0, image));
  if (!chosen->GetName())
  {
    throw std::invalid_argument("The chosen point array needs a name.");
  }
  std::vector<vtkDataArray*> arrays = { chosen };
  for (const std::string& further : this->Attributes)
  {
    vtkDataArray* array = image->GetPointData()->GetArray(further.c_str());
    if (!array)
    {
      throw std::invalid_argument("The image has no point array \"" + further + "\" to fit.");
    }
    if (array != chosen)
    {
      arrays.push_back(array);
    }
  }
  return arrays;
}

//------------------------------------------------------------------------------
// The labels as the steps of the chain want them; null: none are chosen.
vtkSmartPointer<vtkDataArray> vtkTSplineReconstruction::ChosenLabels(vtkImageData* image)
{
  const char* chosen = this->GetInputArrayInformation(1)->Get(vtkDataObject::FIELD_NAME());
  const std::string name = chosen && *chosen ? chosen : "None";
  if (name == "None")
  {
    return nullptr;
  }
  vtkDataArray* labels = this->GetInputArrayToProcess(1, image);
  if (!labels)
  {
    throw std::invalid_argument("The image has no point array \"" + name + "\" of labels.");
  }
  const std::vector<std::int32_t> read = ReadLabels(image, labels, nullptr).Labels;
  auto segments = vtkSmartPointer<vtkIntArray>::New();
  segments->SetName("Segment");
  segments->SetNumberOfValues(static_cast<vtkIdType>(read.size()));
  std::copy(read.begin(), read.end(), segments->GetPointer(0));
  return segments;
}

//------------------------------------------------------------------------------
// Those of all segments together.
SegmentFitOptions vtkTSplineReconstruction::FitOptions(vtkImageData* image)
{
  SegmentFitOptions options;
  options.Array = image->GetPointData()->GetArrayName(0);
  options.Further = this->Attributes;
  options.MaximumControlPoints = this->MaximumNumberOfControlPoints;
  options.RmsTolerance = this->RMSTolerance;
  return options;
}

//------------------------------------------------------------------------------
// One spline over the whole image.
vtkSmartPointer<vtkTSplineFit> vtkTSplineReconstruction::FitBox(
  vtkImageData* image, Chain& chain, double from, double to)
{
  auto fit = vtkSmartPointer<vtkTSplineFit>::New();
  fit->SetInputData(image);
  RunFit(fit, nullptr, "FitOverBox", this->FitOptions(image), chain, from, to);
  return fit;
}

//------------------------------------------------------------------------------
// A sentence where one spline over the whole image does better than one for each segment.
std::string vtkTSplineReconstruction::WhyBox(vtkTSplineFit* box, const SegmentFits& segments)
{
  const double rms = LastRms(vtkTable::SafeDownCast(box->GetOutputDataObject(1)));
  const Index points = box->GetOutput()->GetNumberOfPoints(), others = segments.ControlPoints;
  const bool meetTolerance = std::max(rms, segments.RmsPercent) <= this->RMSTolerance;
  const bool better = meetTolerance ? points <= others : rms <= segments.RmsPercent;
  std::ostringstream why;
  why << "One spline stands for all segments: its error is " << rms << " % at " << points
      << " control points, that of one for each " << segments.RmsPercent << " % at " << others
      << ".";
  return better ? why.str() : "";
}

//------------------------------------------------------------------------------
// The domains that were given, or those that are found.
void vtkTSplineReconstruction::LayOut(vtkPolyData* surfaces, const std::vector<GivenDomain>& given,
  Chain& chain, vtkPolyData* patches, vtkUnstructuredGrid* polycubes)
{
  if (given.empty())
  {
    vtkNew<vtkPolycubeDomain> domain;
    domain->SetController(nullptr);
    domain->SetInputData(surfaces);
    ChainStep(domain, chain, Bounded, LaidOut).RunTelling();
    patches->ShallowCopy(domain->GetPatches());
    polycubes->ShallowCopy(domain->GetPolycube());
    this->Warn(LeaveOutInverted(patches, polycubes));
    return;
  }
  const LabelledSurface surface = ReadSurface(surfaces);
  const DomainSet domains =
    LayOutGivenDomains(surface, given, SMPExecution(this, Bounded, LaidOut));
  this->Warn(domains.Remarks);
  vtkNew<vtkPolyData> borders;
  WriteDomains(surface, domains, {}, patches, polycubes, borders);
}

//------------------------------------------------------------------------------
// Fields and hexahedra over domains of cubes; none, and a warning that says why, where there is no
// domain. A domain that was given has to be one.
std::vector<FilledDomains> vtkTSplineReconstruction::Fill(vtkImageData* segments,
  vtkPolyData* surfaces, const std::vector<GivenDomain>& given, Chain& chain,
  vtkInformationVector* outputVector)
{
  std::vector<FilledDomains> domains;
  vtkPolyData* patches = vtkPolyData::GetData(outputVector, PATCHES);
  vtkUnstructuredGrid* polycubes = vtkUnstructuredGrid::GetData(outputVector, POLYCUBES);
  bool isLaidOut = false;
  try
  {
    this->LayOut(surfaces, given, chain, patches, polycubes);
    isLaidOut = true;
    if (polycubes->GetNumberOfCells() > 0)
    {
      const FilledDomains& filled =
        domains.emplace_back(FillDomains(segments, patches, polycubes, chain, LaidOut, Filled));
      polycubes->ShallowCopy(filled.Polycubes);
      vtkImageData::GetData(outputVector, FIELDS)->ShallowCopy(filled.Fields);
      if (filled.Hexahedra)
      {
        vtkUnstructuredGrid::GetData(outputVector, HEXAHEDRA)->ShallowCopy(filled.Hexahedra);
      }
      vtkPartitionedDataSetCollection::GetData(outputVector, BLOCKS)->ShallowCopy(filled.Blocks);
      if (given.empty())
      {
        domains.push_back(FillCubesAlone(filled, patches, chain, Filled, FilledAgain));
      }
    }
  }
  catch (const std::runtime_error& reason)
  {
    if (!given.empty() && !isLaidOut)
    {
      throw;
    }
    vtkWarningMacro("No segment is fitted over cubes"
                    << (domains.empty() ? ": " : " without layers: ") << reason.what());
  }
  return domains;
}

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::Warn(const std::vector<std::string>& warnings)
{
  for (const std::string& warning : warnings)
  {
    vtkWarningMacro(<< warning);
  }
}

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::FitParts(vtkImageData* image, bool labelled,
  const std::vector<GivenDomain>& given, Chain& chain, vtkInformationVector* outputVector)
{
  vtkImageData* segments = vtkImageData::GetData(outputVector, SEGMENTED);
  segments->ShallowCopy(SplitImage(image, { labelled, this->NumberOfSegments }, chain, Whole));
  if (this->Domain != SEGMENTS)
  {
    vtkImageData::GetData(outputVector, FIELDS)->ShallowCopy(segments);
  }
  SegmentFitOptions options = this->FitOptions(image);
  double range[2];
  segments->GetPointData()->GetArray("Segment")->GetRange(range);
  if (range[0] < range[1])
  {
    vtkNew<vtkSegmentBoundary> boundary;
    boundary->SetController(nullptr);
    boundary->SetInputData(segments);
    ChainStep(boundary, chain, Whole, Bounded).RunTelling();
    vtkPolyData* surfaces = vtkPolyData::GetData(outputVector, SURFACES);
    surfaces->ShallowCopy(boundary->GetOutput());
    if (this->Domain != SEGMENTS)
    {
      options.Domains = this->Fill(segments, surfaces, given, chain, outputVector);
    }
  }
  options.Compared = given.empty();
  std::vector<std::string> why;
  vtkTable* rounds = vtkTable::GetData(outputVector, ROUNDS);
  vtkUnstructuredGrid* output = vtkUnstructuredGrid::GetData(outputVector, TSPLINE);
  const double end = this->Domain == AUTOMATIC ? AllFitted : 1.0;
  const SegmentFits fits =
    FitSegments(segments, options, rounds, why, chain, this->GetProgress(), end);
  if (end < 1.0)
  {
    const auto box = this->FitBox(image, chain, AllFitted, 1.0);
    chain.Remark = this->WhyBox(box, fits);
    if (!chain.Remark.empty())
    {
      output->ShallowCopy(box->GetOutput());
      rounds->ShallowCopy(box->GetOutputDataObject(1));
      return;
    }
  }
  this->Warn(why);
  TSplineToGrid(fits.Model, output);
}

//------------------------------------------------------------------------------
int vtkTSplineReconstruction::RequestData(
  vtkInformation*, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkImageData* input = vtkImageData::GetData(inputVector[0]);
  if (outputVector->GetInformationObject(0)->Get(
        vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER()) > 0)
  {
    return 1; // the first piece is all
  }
  return RunTellingErrors(this,
    "crop or coarsen the image, or allow fewer than " +
      std::to_string(this->MaximumNumberOfControlPoints) + " control points.",
    [&]()
    {
      if (input->GetNumberOfPoints() == 0)
      {
        throw std::invalid_argument("The image has no points.");
      }
      Chain chain{ this, {}, {} };
      const std::vector<vtkDataArray*> arrays = this->ChosenArrays(input);
      if (this->Domain == BOX)
      {
        const auto fit = this->FitBox(MakeImage(input, arrays, nullptr), chain, 0.0, 1.0);
        vtkUnstructuredGrid::GetData(outputVector, TSPLINE)->ShallowCopy(fit->GetOutput());
        vtkTable::GetData(outputVector, ROUNDS)->ShallowCopy(fit->GetOutputDataObject(1));
      }
      else
      {
        const auto labels = this->ChosenLabels(input);
        const auto given = this->Domain == GIVEN
                             ? ReadGivenDomains(vtkUnstructuredGrid::GetData(inputVector[1]))
                             : std::vector<GivenDomain>();
        this->FitParts(
          MakeImage(input, arrays, labels), labels != nullptr, given, chain, outputVector);
      }
      this->Warn(chain.Warnings);
      WriteCourse(chain, vtkTable::GetData(outputVector, ROUNDS));
      return 1;
    });
}

//------------------------------------------------------------------------------
void vtkTSplineReconstruction::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Domain: " << this->Domain << "\n";
  os << indent << "NumberOfSegments: " << this->NumberOfSegments << "\n";
  os << indent << "MaximumNumberOfControlPoints: " << this->MaximumNumberOfControlPoints << "\n";
  os << indent << "RMSTolerance: " << this->RMSTolerance << "\n";
  os << indent << "Attributes:";
  for (const std::string& name : this->Attributes)
  {
    os << " " << name;
  }
  os << "\n";
}
