// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentationInput.h"

#include "MemoryLimit.h"
#include "Texture/GreyLevels.h"

#include "vtkArrayDispatch.h"
#include "vtkDataArray.h"
#include "vtkDataArrayRange.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace trivariate
{
namespace
{
using Extent = std::array<int, 6>;

Index PointsOf(const Extent& e, int axis)
{
  return std::max<Index>(0, static_cast<Index>(e[2 * axis + 1]) - e[2 * axis] + 1);
}

Index CountOf(const Extent& e)
{
  return PointsOf(e, 0) * PointsOf(e, 1) * PointsOf(e, 2);
}

std::string ExtentWords(const Extent& e)
{
  std::ostringstream words;
  words << PointsOf(e, 0) << " x " << PointsOf(e, 1) << " x " << PointsOf(e, 2);
  return words.str();
}

//------------------------------------------------------------------------------
struct CopyValues
{
  template <typename ArrayT>
  void operator()(ArrayT* array, std::vector<double>& values) const
  {
    const auto range = vtk::DataArrayValueRange<1>(array);
    values.assign(range.begin(), range.end());
  }
};

std::vector<double> ValuesOf(vtkDataArray* array)
{
  std::vector<double> values;
  const CopyValues worker;
  if (!vtkArrayDispatch::Dispatch::Execute(array, worker, values))
  {
    worker(array, values);
  }
  return values;
}

// The first value that is no number, or empty.
struct FindBadValue
{
  template <typename ArrayT>
  void operator()(ArrayT* array, vtkIdType& id) const
  {
    const auto range = vtk::DataArrayValueRange<1>(array);
    const auto bad = std::find_if(range.begin(), range.end(),
      [](double value) { return !(std::abs(value) <= std::numeric_limits<float>::max() / 4.0f); });
    id = bad == range.end() ? -1 : static_cast<vtkIdType>(bad - range.begin());
  }
};

std::string BadValue(vtkImageData* image, vtkDataArray* array, const std::string& name)
{
  vtkIdType id = -1;
  const FindBadValue worker;
  if (!vtkArrayDispatch::Dispatch::Execute(array, worker, id))
  {
    worker(array, id);
  }
  if (id < 0)
  {
    return {};
  }
  Extent e;
  image->GetExtent(e.data());
  std::ostringstream words;
  words << "The array \"" << name << "\" has the value " << array->GetComponent(id, 0)
        << " at the point (" << e[0] + id % PointsOf(e, 0) << ", "
        << e[2] + id / PointsOf(e, 0) % PointsOf(e, 1) << ", "
        << e[4] + id / (PointsOf(e, 0) * PointsOf(e, 1))
        << "); only finite values that a float can hold have a texture. Replace it first.";
  return words.str();
}

//------------------------------------------------------------------------------
// The values of the own points that are in no earlier process's piece.
std::vector<double> CountedValues(const std::vector<double>& values, const Extent& held,
  const Extent& own, const std::vector<Extent>& pieces, int process)
{
  std::vector<double> counted;
  for (int k = own[4]; k <= own[5]; ++k)
  {
    for (int j = own[2]; j <= own[3]; ++j)
    {
      const Index row =
        PointsOf(held, 0) * (j - held[2] + PointsOf(held, 1) * static_cast<Index>(k - held[4]));
      for (int i = own[0]; i <= own[1]; ++i)
      {
        const bool earlier = std::any_of(pieces.begin(), pieces.begin() + process,
          [=](const Extent& e)
          { return i >= e[0] && i <= e[1] && j >= e[2] && j <= e[3] && k >= e[4] && k <= e[5]; });
        if (!earlier)
        {
          counted.push_back(values[row + i - held[0]]);
        }
      }
    }
  }
  return counted;
}

//------------------------------------------------------------------------------
// The decision that one process with the whole image would make.
GreyLevels DecideLevels(const std::vector<double>& counted, const GreyLevelOptions& options,
  const GatherBytes& gather, ValueRange& range)
{
  range.Add(counted.data(), static_cast<Index>(counted.size()));
  struct Limits
  {
    double Low, High;
    int Integers;
  };
  for (const Limits& l : GatherAll(gather,
         std::vector<Limits>{ { range.Low, range.High, static_cast<int>(range.Integers) } }))
  {
    range.Low = std::min(range.Low, l.Low);
    range.High = std::max(range.High, l.High);
    range.Integers = range.Integers && l.Integers;
  }
  if (!options.AutomaticRange)
  {
    return UniformGreyLevels(options.Range[0], options.Range[1], options.Count);
  }
  ValueHistogram histogram(range);
  histogram.Add(counted.data(), static_cast<Index>(counted.size()));
  const std::vector<Index> all = GatherAll(gather, histogram.Counts);
  const std::size_t bins = histogram.Counts.size();
  std::fill(histogram.Counts.begin(), histogram.Counts.end(), 0);
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    histogram.Counts[i % bins] += all[i];
  }
  return AutomaticGreyLevels(histogram, options.Count);
}
}

namespace
{
// In place of a length: that a process has given up.
constexpr vtkIdType Failed = -1, Stopped = -2;

struct AbortedElsewhere : Aborted
{
};

std::vector<vtkIdType> GatherLengths(vtkIdType own, vtkMultiProcessController* controller)
{
  std::vector<vtkIdType> lengths(controller->GetNumberOfProcesses());
  controller->AllGather(&own, lengths.data(), 1);
  if (own >= 0 && *std::min_element(lengths.begin(), lengths.end()) < 0)
  {
    if (std::find(lengths.begin(), lengths.end(), Stopped) != lengths.end())
    {
      throw AbortedElsewhere();
    }
    throw StoppedElsewhere();
  }
  return lengths;
}
}

//------------------------------------------------------------------------------
void RunTogether(vtkMultiProcessController* controller, const std::function<void()>& work)
{
  if (!controller)
  {
    work();
    return;
  }
  try
  {
    work();
    GatherLengths(0, controller); // one may have failed after what it sent last
  }
  catch (const StoppedElsewhere&)
  {
    throw;
  }
  catch (const AbortedElsewhere&)
  {
    throw;
  }
  catch (const Aborted&)
  {
    GatherLengths(Stopped, controller);
    throw;
  }
  catch (...)
  {
    GatherLengths(Failed, controller);
    throw;
  }
}

//------------------------------------------------------------------------------
GatherBytes GatherBytesOf(vtkMultiProcessController* controller)
{
  if (!controller)
  {
    return [](const std::vector<std::uint8_t>& mine) { return mine; };
  }
  return [controller](const std::vector<std::uint8_t>& mine)
  {
    const int processes = controller->GetNumberOfProcesses();
    const vtkIdType length = static_cast<vtkIdType>(mine.size());
    std::vector<vtkIdType> offsets(processes, 0);
    std::vector<vtkIdType> lengths = GatherLengths(length, controller);
    for (int p = 1; p < processes; ++p)
    {
      offsets[p] = offsets[p - 1] + lengths[p - 1];
    }
    std::vector<std::uint8_t> all(offsets.back() + lengths.back());
    controller->AllGatherV(mine.data(), all.data(), length, lengths.data(), offsets.data());
    return all;
  };
}

namespace
{
// What grows with the number of segments: two probabilities a segment for each point near an
// interface, at the worst all of them, and how often grey levels are neighbours in 13 directions.
double BytesOfSegments(const SegmentationOptions& options, Index points)
{
  const double segments = options.Segments > 0 ? options.Segments : MaximumAutomaticSegments;
  const double levels = options.Texture.GreyLevels;
  return segments * (8.0 * static_cast<double>(points) + 12.0 * 13.0 * levels * levels);
}
}

//------------------------------------------------------------------------------
std::string SegmentationFault(vtkImageData* image, vtkDataArray* array, const char* wanted,
  const Extent& own, const Extent& whole, const SegmentationOptions& options)
{
  if (CountOf(whole) == 0)
  {
    return "The image has no points.";
  }
  if (image->GetNumberOfPoints() == 0 || CountOf(own) == 0)
  {
    return {}; // more processes than there are pieces
  }
  if (!array)
  {
    return std::string("The image does not have ") +
           (wanted && *wanted ? "the point array \"" + std::string(wanted) + "\""
                              : "active point scalars") +
           "; choose an array by SetInputArrayToProcess(0, ...), or make one of a cell array by "
           "Cell Data to Point Data.";
  }
  const std::string name = array->GetName() ? array->GetName() : "ImageScalars";
  if (array->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    return "The array \"" + name + "\" has " + std::to_string(array->GetNumberOfTuples()) +
           " values for " + std::to_string(image->GetNumberOfPoints()) +
           " points; choose a point array of the image.";
  }
  if (array->GetNumberOfComponents() != 1)
  {
    return "The array \"" + name + "\" has " + std::to_string(array->GetNumberOfComponents()) +
           " components; one is needed. Take one of them, or the magnitude, first.";
  }
  const Index window = 2 * options.Texture.Radius + 1;
  for (int a = 0; a < 3; ++a)
  {
    if (PointsOf(whole, a) < 2)
    {
      return "The image has " + ExtentWords(whole) +
             " points; a volume needs two or more along each axis.";
    }
    if (PointsOf(whole, a) < window)
    {
      return "The window of a WindowRadius of " + std::to_string(options.Texture.Radius) + " has " +
             std::to_string(window) + " points along each axis, more than the image of " +
             ExtentWords(whole) + "; choose a smaller radius.";
    }
  }
  if (CountOf(whole) > std::numeric_limits<std::int32_t>::max())
  {
    return "The image has " + ExtentWords(whole) +
           " points, more than the 2147483647 that can be segmented; crop or coarsen it.";
  }
  const double* spacing = image->GetSpacing();
  if (options.GradientWeight > 0.0 &&
      std::any_of(spacing, spacing + 3, [](double h) { return !std::isfinite(1.0 / h); }))
  {
    std::ostringstream words;
    words << "There is no gradient in an image with the spacing " << spacing[0] << ", "
          << spacing[1] << ", " << spacing[2] << "; give it another, or gradients no weight.";
    return words.str();
  }
  const int reach = SegmentationNeighbourhood(options);
  Extent held;
  image->GetExtent(held.data());
  for (int a = 0; a < 3; ++a)
  {
    if (held[2 * a] > std::max(whole[2 * a], own[2 * a] - reach) ||
        held[2 * a + 1] < std::min(whole[2 * a + 1], own[2 * a + 1] + reach))
    {
      return "The source of the image does not give the " + std::to_string(reach) +
             " ghost levels that the windows need; use one process, or a source that does.";
    }
  }
  const double attributes = options.Texture.Attributes.empty()
                              ? 0.0
                              : static_cast<double>(TextureOutputNames(options.Texture).size());
  const std::string memory = MemoryFault("The segmentation",
    static_cast<double>(CountOf(held)) *
        (48.0 + attributes * (options.KeepAttributes ? 8.0 : 4.0)) +
      25.0 * static_cast<double>(CountOf(whole)) + BytesOfSegments(options, CountOf(whole)));
  return memory.empty() ? BadValue(image, array, name) : memory;
}

//------------------------------------------------------------------------------
SegmentationInput ReadSegmentationInput(vtkImageData* image, vtkDataArray* array, const Extent& own,
  const Extent& whole, const GreyLevelOptions& options, const GatherBytes& gather, int process)
{
  const bool empty = image->GetNumberOfPoints() == 0 || CountOf(own) == 0;
  Extent held = { 0, -1, 0, -1, 0, -1 };
  std::vector<double> values;
  if (!empty)
  {
    image->GetExtent(held.data());
    values = ValuesOf(array);
  }
  const std::vector<Extent> pieces = GatherAll(gather, std::vector<Extent>{ empty ? held : own });
  ValueRange range;
  const GreyLevels levels = DecideLevels(
    CountedValues(values, held, empty ? held : own, pieces, process), options, gather, range);

  SegmentationInput input;
  input.Offset = range.Low;
  input.Constant = range.Low == range.High;
  input.Piece.Process = process;
  image->GetSpacing(input.Piece.Spacing.data());
  for (int a = 0; a < 3; ++a)
  {
    input.Piece.Whole[a] = PointsOf(whole, a);
    if (!empty)
    {
      input.Piece.Low[a] = held[2 * a] - whole[2 * a];
      input.Piece.Size[a] = PointsOf(held, a);
      input.Piece.Begin[a] = own[2 * a] - held[2 * a];
      input.Piece.End[a] = own[2 * a + 1] - held[2 * a] + 1;
    }
  }
  input.Piece.Levels.resize(values.size());
  Discretise(values.data(), static_cast<Index>(values.size()), levels, input.Piece.Levels.data());
  input.Piece.Density.resize(values.size());
  std::transform(values.begin(), values.end(), input.Piece.Density.begin(),
    [&range](double value) { return static_cast<float>(value - range.Low); });
  return input;
}
}
