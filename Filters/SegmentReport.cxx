// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentReport.h"

#include "SegmentPoints.h"
#include "SplineFacts.h"
#include "TSpline/BezierMesh.h"
#include "TSpline/Evaluator.h"
#include "TSplinePoints.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkZLibDataCompressor.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr Index Stride = 1 << 18; // voxels at a time
constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

//------------------------------------------------------------------------------
// The voxels of each segment, ascending; of one without labels all.
std::map<int, std::vector<Index>> VoxelsOfSegments(const ReportInput& input)
{
  std::map<int, std::vector<Index>> voxels;
  const Index count = input.Image.Count();
  std::vector<Index>* own = nullptr;
  double last = NaN;
  for (Index i = 0; i < count; ++i)
  {
    const double label = input.Labels < 0 ? 0.0 : input.Image.Values[input.Labels * count + i];
    if (label != last)
    {
      if (!(label == std::floor(label)) || std::abs(label) > std::numeric_limits<int>::max())
      {
        throw std::invalid_argument(
          "A voxel has the label " + std::to_string(label) + "; labels are whole numbers.");
      }
      own = &voxels[static_cast<int>(label)];
      last = label;
    }
    own->push_back(i);
  }
  return voxels;
}

//------------------------------------------------------------------------------
// Bytes of voxels after deflation at the default level, in pieces so that the user is heard.
double DeflatedBytes(
  const double* values, const std::vector<Index>& voxels, int type, const Execution& execution)
{
  vtkNew<vtkZLibDataCompressor> compressor;
  const Index count = static_cast<Index>(voxels.size());
  double bytes = 0.0;
  for (Index begin = 0; begin < count; begin += 4 * Stride)
  {
    execution.Check(1.0 * begin / count);
    const Index n = std::min(4 * Stride, count - begin);
    const auto raw = vtk::TakeSmartPointer(vtkDataArray::CreateDataArray(type));
    raw->SetNumberOfTuples(n);
    for (Index i = 0; i < n; ++i)
    {
      raw->SetTuple1(i, values[voxels[begin + i]]);
    }
    const std::size_t size = n * raw->GetDataTypeSize();
    std::vector<unsigned char> packed(compressor->GetMaximumCompressionSpace(size));
    bytes += static_cast<double>(
      compressor->Compress(static_cast<const unsigned char*>(raw->GetVoidPointer(0)), size,
        packed.data(), packed.size()));
  }
  return bytes;
}

//------------------------------------------------------------------------------
// The attribute at each voxel by the inverse map.
struct RoundTrip
{
  vtkSmartPointer<vtkImageData> Image;
  vtkDataArray* Values;
  vtkDataArray* Found;
};

RoundTrip EvaluateImage(
  const ReportInput& input, const TSplineModel& model, bool bySegment, const Execution& execution)
{
  RoundTrip trip;
  trip.Image.TakeReference(input.Lattice->NewInstance());
  trip.Image->CopyStructure(input.Lattice);
  const BezierMesh mesh(model.Spline, execution.Part(0.0, 0.1));
  const TSplineView view{ model, mesh, false, false };
  if (bySegment)
  {
    vtkNew<vtkIntArray> labels;
    labels->SetName("Segment");
    const Index count = input.Image.Count();
    labels->SetNumberOfTuples(count);
    for (Index i = 0; i < count; ++i)
    {
      labels->SetValue(i, static_cast<int>(input.Image.Values[input.Labels * count + i]));
    }
    FillPointsOfSegments(view, labels, trip.Image, execution.Part(0.1, 1.0));
  }
  else
  {
    FillPoints(view, trip.Image, execution.Part(0.1, 1.0));
  }
  trip.Values = trip.Image->GetPointData()->GetArray(model.Attributes[0].Name.c_str());
  trip.Found = trip.Image->GetPointData()->GetArray("vtkValidPointMask");
  return trip;
}

//------------------------------------------------------------------------------
// Errors of some voxels, as shares of the image's range.
struct Errors
{
  Index Voxels = 0, Found = 0, Known = 0; ///< Known: with an error at their own parameters
  double Squares = 0.0, OwnSquares = 0.0, Largest = 0.0;

  void Add(double error, bool found, double ownError)
  {
    ++this->Voxels;
    this->Found += found;
    this->Squares += error * error;
    this->Largest = std::max(this->Largest, std::abs(error));
    if (!std::isnan(ownError))
    {
      ++this->Known;
      this->OwnSquares += ownError * ownError;
    }
  }

  void Add(const Errors& other)
  {
    this->Voxels += other.Voxels;
    this->Found += other.Found;
    this->Known += other.Known;
    this->Squares += other.Squares;
    this->OwnSquares += other.OwnSquares;
    this->Largest = std::max(this->Largest, other.Largest);
  }
};

// The attribute at the voxels' own parameters; NaN where there are none.
std::vector<double> EvaluateOwn(const ReportInput& input, const TSplineModel& model,
  const BezierMesh& mesh, const std::vector<Index>& voxels, const Execution& execution)
{
  const Index all = input.Image.Count(), count = static_cast<Index>(voxels.size());
  const double* values = input.Image.Values.data();
  const Evaluator evaluator(model.Spline, mesh, { 3 }, execution.Part(0.0, 0.2));
  std::vector<double> own(count), parameters;
  std::vector<std::uint8_t> inside(count);
  for (Index begin = 0; begin < count; begin += Stride)
  {
    const Index end = std::min(count, begin + Stride);
    parameters.clear();
    for (Index i = begin; i < end; ++i)
    {
      for (int a = 0; a < 3; ++a)
      {
        parameters.push_back(values[(input.Parameter + a) * all + voxels[i]]);
      }
    }
    EvaluatorOutput output;
    output.Values = &own[begin];
    output.Inside = &inside[begin];
    evaluator.Evaluate(end - begin, parameters.data(), output,
      execution.Part(0.2 + 0.8 * begin / count, 0.2 + 0.8 * end / count));
  }
  for (Index i = 0; i < count; ++i)
  {
    const bool has = input.Mask < 0 || values[input.Mask * all + voxels[i]] != 0.0;
    own[i] = has && inside[i] ? own[i] : NaN;
  }
  return own;
}

Errors Compare(const ReportInput& input, const RoundTrip& trip, double range, bool affine,
  const std::vector<Index>& voxels, const std::vector<double>& own)
{
  Errors errors;
  for (std::size_t i = 0; i < voxels.size(); ++i)
  {
    const double wanted = input.Image.Values[voxels[i]];
    const double error = (trip.Values->GetTuple1(voxels[i]) - wanted) / range;
    const bool found = trip.Found->GetTuple1(voxels[i]) != 0.0;
    // Where the map is affine, its inverse is exact: the parameters found are the voxel's own.
    const double ownError = !own.empty()      ? (own[i] - wanted) / range
                            : affine && found ? error
                                              : NaN;
    errors.Add(error, found, ownError);
  }
  return errors;
}

// Over what the spline of a segment was fitted, as the rounds tell, or else the spline.
std::string DomainOf(const SplineFacts& facts, bool bySegment, const LastRound& last)
{
  return std::isnan(facts.ControlPoints) ? "None"
         : facts.Affine                  ? bySegment ? "SegmentBox" : "ImageBox"
         : last.Domain.empty()           ? "Cubes"
                                         : last.Domain;
}

bool IsOverCubes(const std::string& domain)
{
  return domain == "Cubes" || domain == "LayeredCubes";
}

// `cubed`: those of the row's segments that were fitted over cubes.
ReportRow MakeRow(const ReportInput& input, int segment, const Errors& errors,
  const SplineFacts& facts, const std::set<int>& cubed, double raw, double deflated,
  double labelBytes)
{
  const double n = static_cast<double>(errors.Voxels);
  const double rms = std::sqrt(errors.Squares / n);
  ReportRow row;
  std::map<std::string, double>& numbers = row.Numbers;
  numbers["Segment"] = segment;
  numbers["Voxels"] = n;
  numbers["RMSPercent"] =
    errors.Known == errors.Voxels ? 100.0 * std::sqrt(errors.OwnSquares / n) : NaN;
  numbers["Corners"] = CountCorners(input.Surfaces, cubed);
  numbers["ControlPoints"] = facts.ControlPoints;
  numbers["DistinctControlPoints"] = facts.DistinctControlPoints;
  numbers["RoundTripRMSPercent"] = 100.0 * rms;
  numbers["FoundPercent"] = 100.0 * static_cast<double>(errors.Found) / n;
  numbers["MaximumErrorPercent"] = 100.0 * errors.Largest;
  numbers["PSNRDecibels"] = -20.0 * std::log10(rms);
  numbers["HausdorffVoxels"] = facts.Hausdorff;
  numbers["GradientJumpPercent"] = 100.0 * facts.GradientJump;
  numbers["MinimumScaledJacobian"] = facts.MinimumScaledJacobian;
  numbers["InvertedCells"] = facts.InvertedCells;
  numbers["Blocks"] = facts.Blocks;
  numbers["NumbersStored"] = facts.NumbersStored;
  numbers["SplineBytes"] = facts.Bytes;
  numbers["LabelBytes"] = labelBytes;
  numbers["RawBytes"] = raw;
  numbers["ZLibBytes"] = deflated;
  numbers["Seconds"] = SecondsOf(input.Rounds, segment);
  return row;
}
}

//------------------------------------------------------------------------------
const std::vector<std::string>& ReportColumns()
{
  static const std::vector<std::string> columns = { "Segment", "Voxels", "RMSPercent", "Corners",
    "ControlPoints", "DistinctControlPoints", "RoundTripRMSPercent", "FoundPercent",
    "MaximumErrorPercent", "PSNRDecibels", "HausdorffVoxels", "GradientJumpPercent",
    "MinimumScaledJacobian", "InvertedCells", "Blocks", "NumbersStored", "SplineBytes",
    "LabelBytes", "RawBytes", "ZLibBytes", "Seconds", "Domain" };
  return columns;
}

//------------------------------------------------------------------------------
std::vector<ReportRow> MakeReport(const ReportInput& input, const Execution& execution)
{
  const std::map<int, std::vector<Index>> voxels = VoxelsOfSegments(input);
  const TSplineModel model = AttributePart(input.Model, input.Attribute);
  const double* values = input.Image.Values.data();
  const auto [low, high] = std::minmax_element(values, values + input.Image.Count());
  const double range = *high > *low ? *high - *low : 1.0;
  int component = 0; // of the array, among those of all attributes
  for (int a = 0; a < input.Attribute; ++a)
  {
    component += input.Model.Attributes[a].Components;
  }
  const double scalarBytes = vtkDataArray::GetDataTypeSize(input.ScalarType);

  const std::vector<std::int32_t> segments = SegmentsOf(model);
  const bool bySegment = GoBySegments(model, input.Labels >= 0);
  const RoundTrip trip = EvaluateImage(input, model, bySegment, execution.Part(0.0, 0.4));
  std::vector<ReportRow> rows;
  Errors total;
  SplineFacts totalFacts;
  std::string totalDomain;
  std::set<int> allCubed;
  double totalRaw = 0.0, totalDeflated = 0.0;
  Index done = 0;
  for (const auto& [segment, own] : voxels)
  {
    const Index next = done + static_cast<Index>(own.size());
    const Execution part = execution.Part(
      0.4 + 0.6 * done / input.Image.Count(), 0.4 + 0.6 * next / input.Image.Count());
    done = next;
    const double raw = scalarBytes * static_cast<double>(own.size());
    const double deflated = DeflatedBytes(values, own, input.ScalarType, part.Part(0.0, 0.2));
    const bool exists =
      !bySegment || std::find(segments.begin(), segments.end(), segment) != segments.end();
    // One spline for all segments is told of once: with the first, and then not in its row.
    SplineFacts facts;
    Errors errors;
    std::string domain = "None";
    if (exists)
    {
      const TSplineModel fitted = bySegment ? SegmentPart(model, segment) : model;
      const BezierMesh mesh(fitted.Spline, part.Part(0.2, 0.25));
      const int whose = bySegment ? segment : segments.front();
      const LastRound last = LastRoundOf(input.Rounds, whose, component);
      if (bySegment || rows.empty())
      {
        const TSplineModel stored = bySegment ? SegmentPart(input.Model, segment) : input.Model;
        facts = DescribeSpline(stored, mesh, whose, input, part.Part(0.25, 0.8));
        facts.GradientJump =
          facts.Affine ? 0.0 : LastRoundOf(input.Rounds, whose, component).GradientJump / range;
        totalFacts.Add(facts);
      }
      const SplineFacts& described = bySegment ? facts : totalFacts;
      domain = DomainOf(described, bySegment, last);
      // A fit over a domain moves the parameters of voxels: its own word comes before the array's.
      const bool isTold = IsOverCubes(domain) && !std::isnan(last.Rms);
      const std::vector<double> ownValues =
        input.Parameter < 0 || described.Affine || isTold
          ? std::vector<double>()
          : EvaluateOwn(input, fitted, mesh, own, part.Part(0.8, 1.0));
      errors = Compare(input, trip, range, described.Affine, own, ownValues);
      if (isTold)
      {
        errors.Known = errors.Voxels;
        errors.OwnSquares = std::pow(last.Rms / range, 2) * static_cast<double>(errors.Voxels);
      }
    }
    else
    {
      errors = Compare(input, trip, range, false, own, {});
    }
    total.Add(errors);
    totalRaw += raw;
    totalDeflated += deflated;
    const bool isOwn = bySegment || voxels.size() == 1;
    std::set<int> cubed;
    if (IsOverCubes(domain))
    {
      cubed.insert(segment);
      allCubed.insert(segment);
    }
    totalDomain = totalDomain.empty() || totalDomain == domain ? domain : "Mixed";
    rows.push_back(
      MakeRow(input, segment, errors, isOwn ? facts : SplineFacts(), cubed, raw, deflated, 0.0));
    rows.back().Domain = domain;
  }
  double labelBytes = 0.0;
  if (bySegment)
  {
    totalFacts.Bytes = StoredBytes(input.Model, execution.Part(1.0, 1.0));
    const double* labels = values + input.Labels * input.Image.Count();
    std::vector<Index> everywhere(input.Image.Count());
    std::iota(everywhere.begin(), everywhere.end(), Index(0));
    labelBytes = DeflatedBytes(labels, everywhere, VTK_INT, execution.Part(1.0, 1.0));
  }
  rows.push_back(
    MakeRow(input, AllSegments, total, totalFacts, allCubed, totalRaw, totalDeflated, labelBytes));
  rows.back().Domain = totalDomain;
  return rows;
}
}
