// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "GatherSamples.h"

#include "vtkMultiProcessController.h"
#include "vtkMultiProcessStream.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <stdexcept>

namespace trivariate
{
namespace
{
//------------------------------------------------------------------------------
// What a process must know of another's piece before the values are sent.
struct PieceHeader
{
  enum Field
  {
    FAULTY = 6,
    COMPONENTS,
    MASKED,
    LENGTH
  };
  std::array<int, LENGTH> Numbers;

  Index Count() const
  {
    Index count = 1;
    for (int a = 0; a < 3; ++a)
    {
      count *= std::max(0, this->Numbers[2 * a + 1] - this->Numbers[2 * a] + 1);
    }
    return count;
  }
};

//------------------------------------------------------------------------------
// Copies `components` blocks of a piece to their places in the blocks of the whole.
template <typename T>
void Assemble(const T* piece, const PieceHeader& header, int components, const ImageSamples& whole,
  std::vector<T>& values)
{
  const auto& e = header.Numbers;
  const Index row = e[1] - e[0] + 1;
  for (int c = 0; c < components; ++c)
  {
    for (int k = e[4]; k <= e[5]; ++k)
    {
      for (int j = e[2]; j <= e[3]; ++j, piece += row)
      {
        const Index at =
          e[0] - whole.Extent[0] +
          whole.Points(0) * (j - whole.Extent[2] +
                              whole.Points(1) * (k - whole.Extent[4] + whole.Points(2) * Index(c)));
        std::copy_n(piece, row, &values[at]);
      }
    }
  }
}

//------------------------------------------------------------------------------
// Sends everybody's numbers to process 0, one piece after another. `all` has room for them there.
template <typename T>
void GatherToRoot(const std::vector<T>& own, std::vector<vtkIdType> lengths,
  vtkMultiProcessController* controller, std::vector<T>& all)
{
  std::vector<vtkIdType> offsets(lengths.size(), 0);
  std::partial_sum(lengths.begin(), lengths.end() - 1, offsets.begin() + 1);
  controller->GatherV(
    own.data(), all.data(), static_cast<vtkIdType>(own.size()), lengths.data(), offsets.data(), 0);
}
}

//------------------------------------------------------------------------------
bool GatherSamples(ImageSamples& samples, std::string& fault, vtkMultiProcessController* controller)
{
  const int processes = controller->GetNumberOfProcesses();
  const int me = controller->GetLocalProcessId();
  PieceHeader own;
  std::copy(samples.Extent.begin(), samples.Extent.end(), own.Numbers.begin());
  own.Numbers[PieceHeader::FAULTY] = !fault.empty();
  own.Numbers[PieceHeader::COMPONENTS] = samples.Components();
  own.Numbers[PieceHeader::MASKED] = !samples.Mask.empty();
  std::vector<PieceHeader> headers(processes);
  controller->AllGather(own.Numbers.data(), headers.front().Numbers.data(), PieceHeader::LENGTH);

  ImageSamples whole;
  int first = -1; // a process whose piece is not empty: it knows the arrays
  for (int p = 0; p < processes; ++p)
  {
    const auto& e = headers[p].Numbers;
    if (e[PieceHeader::FAULTY])
    {
      fault = p == me ? fault : "";
      return false;
    }
    if (headers[p].Count() == 0)
    {
      continue;
    }
    const auto& reference = headers[first < 0 ? p : first].Numbers;
    if (e[PieceHeader::COMPONENTS] != reference[PieceHeader::COMPONENTS] ||
        e[PieceHeader::MASKED] != reference[PieceHeader::MASKED])
    {
      fault = me == 0 ? "The pieces of the image do not have the same arrays." : "";
      return false;
    }
    for (int a = 0; a < 3; ++a)
    {
      int* extent = &whole.Extent[2 * a];
      extent[0] = first < 0 ? e[2 * a] : std::min(extent[0], e[2 * a]);
      extent[1] = first < 0 ? e[2 * a + 1] : std::max(extent[1], e[2 * a + 1]);
    }
    first = first < 0 ? p : first;
  }
  if (first < 0)
  {
    samples = ImageSamples();
    return true;
  }

  controller->Broadcast(samples.IndexToPhysical.data(), 16, first);
  whole.IndexToPhysical = samples.IndexToPhysical;
  vtkMultiProcessStream names;
  for (const TSplineAttribute& attribute : samples.Attributes)
  {
    names << attribute.Name << attribute.Components;
  }
  controller->Broadcast(names, first);
  while (!names.Empty())
  {
    TSplineAttribute attribute;
    names >> attribute.Name >> attribute.Components;
    whole.Attributes.push_back(attribute);
  }

  const int components = whole.Components();
  const bool masked = headers[first].Numbers[PieceHeader::MASKED] != 0;
  std::vector<vtkIdType> counts, lengths;
  for (const PieceHeader& header : headers)
  {
    counts.push_back(masked ? header.Count() : 0);
    lengths.push_back(components * header.Count());
  }
  // All that process 0 needs, before others send to it: if it fails then, they wait for ever.
  std::vector<double> values;
  std::vector<std::uint8_t> mask;
  int hasRoom = 1;
  if (me == 0)
  {
    try
    {
      values.resize(std::accumulate(lengths.begin(), lengths.end(), vtkIdType(0)));
      mask.resize(std::accumulate(counts.begin(), counts.end(), vtkIdType(0)));
      // A hole between the pieces stays NaN, which the fit refuses.
      whole.Values.assign(components * whole.Count(), std::numeric_limits<double>::quiet_NaN());
      whole.Mask.assign(masked ? whole.Count() : 0, 1);
    }
    catch (const std::exception&) // bad_alloc, length_error
    {
      hasRoom = 0;
    }
  }
  controller->Broadcast(&hasRoom, 1, 0);
  if (!hasRoom)
  {
    fault = me == 0 ? "Out of memory on the process that gathers the pieces; crop or coarsen the "
                      "image."
                    : "";
    samples = ImageSamples();
    return false;
  }
  GatherToRoot(samples.Values, lengths, controller, values);
  GatherToRoot(samples.Mask, counts, controller, mask);
  samples = ImageSamples();
  if (me != 0)
  {
    return true;
  }
  const double* pieceValues = values.data();
  const std::uint8_t* pieceMask = mask.data();
  for (int p = 0; p < processes; ++p)
  {
    Assemble(pieceValues, headers[p], components, whole, whole.Values);
    Assemble(pieceMask, headers[p], masked ? 1 : 0, whole, whole.Mask);
    pieceValues += lengths[p];
    pieceMask += counts[p];
  }
  samples = std::move(whole);
  return true;
}
}
