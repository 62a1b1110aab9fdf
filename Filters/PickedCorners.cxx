// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PickedCorners.h"

#include "vtkAppendPolyData.h"
#include "vtkDataArray.h"
#include "vtkMultiProcessController.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
std::string NameOf(int segment)
{
  return "Segment " + std::to_string(segment);
}

// The same places of the same segments in the same order.
bool AreSame(vtkPolyData* a, vtkPolyData* b)
{
  const auto same = [](vtkDataArray* first, vtkDataArray* second)
  {
    bool equal = (first == nullptr) == (second == nullptr);
    equal =
      equal && (!first || (first->GetNumberOfTuples() == second->GetNumberOfTuples() &&
                            first->GetNumberOfComponents() == second->GetNumberOfComponents()));
    for (vtkIdType i = 0; equal && first && i < first->GetNumberOfTuples(); ++i)
    {
      for (int c = 0; c < first->GetNumberOfComponents(); ++c)
      {
        equal = equal && first->GetComponent(i, c) == second->GetComponent(i, c);
      }
    }
    return equal;
  };
  const auto placesOf = [](vtkPolyData* corners)
  { return corners->GetPoints() ? corners->GetPoints()->GetData() : nullptr; };
  return same(placesOf(a), placesOf(b)) && same(a->GetPointData()->GetArray(CornerSegmentName),
                                             b->GetPointData()->GetArray(CornerSegmentName));
}

//------------------------------------------------------------------------------
void RemarkOnSeparate(const LabelledSurface& surface, const PickedCorners& picked, DomainSet& set)
{
  std::set<int> there;
  for (const BlocksOfSegment& segment : set.Segments)
  {
    there.insert(segment.Segment);
  }
  std::set<std::array<int, 2>> touching;
  for (const auto& [inner, outer] : surface.Labels)
  {
    if (inner != outer && there.count(inner) > 0 && there.count(outer) > 0 &&
        (picked.count(inner) > 0 || picked.count(outer) > 0))
    {
      touching.insert({ std::min(inner, outer), std::max(inner, outer) });
    }
  }
  for (const auto& [a, b] : touching)
  {
    set.Remarks.push_back("Segments " + std::to_string(a) + " and " + std::to_string(b) +
                          " touch but have separate domains there: corners are picked for " +
                          (picked.count(a) == 0    ? std::to_string(b)
                            : picked.count(b) == 0 ? std::to_string(a)
                                                   : "both") +
                          ".");
  }
}
}

//------------------------------------------------------------------------------
bool HaveSegments(vtkPointSet* points)
{
  return points && points->GetPointData()->GetArray(CornerSegmentName);
}

//------------------------------------------------------------------------------
vtkSmartPointer<vtkPolyData> GatherCorners(vtkPolyData* own, vtkMultiProcessController* controller)
{
  std::vector<vtkSmartPointer<vtkDataObject>> parts;
  controller->Gather(own, parts, 0);
  vtkNew<vtkAppendPolyData> append;
  vtkPolyData* first = nullptr;
  bool same = true;
  for (vtkDataObject* part : parts)
  {
    vtkPolyData* corners = vtkPolyData::SafeDownCast(part);
    first = first ? first : corners;
    same = same && corners && AreSame(first, corners);
    if (corners && corners->GetNumberOfPoints() > 0)
    {
      append->AddInputData(corners);
    }
  }
  if (same && first)
  {
    return first;
  }
  if (append->GetNumberOfInputConnections(0) == 0)
  {
    return vtkSmartPointer<vtkPolyData>::New();
  }
  append->Update();
  return append->GetOutput();
}

//------------------------------------------------------------------------------
PickedCorners CornersBySegment(vtkPointSet* points, const std::vector<int>& chosen)
{
  vtkDataArray* owners = points->GetPointData()->GetArray(CornerSegmentName);
  if (owners->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("The array Segment of the corners has " +
                                std::to_string(owners->GetNumberOfComponents()) +
                                " components; it needs one, the segment's number.");
  }
  const std::vector<Eigen::Vector3d> places = ReadPoints(points);
  PickedCorners picked;
  for (std::size_t i = 0; i < places.size(); ++i)
  {
    const double owner = owners->GetComponent(static_cast<vtkIdType>(i), 0);
    const auto found = std::find(chosen.begin(), chosen.end(), owner);
    if (found == chosen.end())
    {
      std::string labels;
      for (const int segment : chosen)
      {
        labels += (labels.empty() ? "" : ", ") + std::to_string(segment);
      }
      std::string name = std::to_string(owner);
      name.erase(name.find_last_not_of('0') + 1);
      name.erase(name.find_last_not_of('.') + 1);
      throw std::invalid_argument("Corner " + std::to_string(i) + " is of segment " + name +
                                  ", which is not among those that get a domain: " + labels + ".");
    }
    picked[*found].push_back(places[i]);
  }
  return picked;
}

//------------------------------------------------------------------------------
DomainSet DomainsFromCorners(const LabelledSurface& surface, const std::vector<int>& chosen,
  const PickedCorners& picked,
  const std::function<Polycube(const SurfaceMesh&, const Execution&)>& shapeOf, double snapLimit,
  const DomainSettings& settings, const Execution& execution)
{
  std::vector<int> others;
  std::copy_if(chosen.begin(), chosen.end(), std::back_inserter(others),
    [&picked](int segment) { return picked.count(segment) == 0; });

  // What is picked comes first: it may be wrong, and the search takes long.
  DomainSet byHand;
  double from = 0.0;
  const double share = 1.0 / static_cast<double>(picked.size() + others.size());
  for (const auto& [segment, corners] : picked)
  {
    try
    {
      const Polycube cubes =
        shapeOf(OnlyPieceOf(surface, segment).Mesh, execution.Part(from, from + 0.5 * share));
      AddDomainFromCorners(surface, segment, cubes, corners, snapLimit, settings,
        execution.Part(from + 0.5 * share, from + share), byHand);
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument(NameOf(segment) + ": " + error.what());
    }
    catch (const std::runtime_error& error)
    {
      throw std::runtime_error(NameOf(segment) + ": " + error.what());
    }
    from += share;
  }
  if (others.empty())
  {
    RemarkOnSeparate(surface, picked, byHand);
    return byHand;
  }

  DomainSet set = FindDomains(surface, others, settings, execution.Part(from, 1.0));
  const auto found = static_cast<Index>(set.Surfaces.size());
  std::move(byHand.Surfaces.begin(), byHand.Surfaces.end(), std::back_inserter(set.Surfaces));
  for (BlocksOfSegment& segment : byHand.Segments)
  {
    segment.Outer += found; // they have no inner surface
    set.Segments.push_back(std::move(segment));
  }
  set.Remarks.insert(set.Remarks.begin(), byHand.Remarks.begin(), byHand.Remarks.end());
  std::sort(set.Segments.begin(), set.Segments.end(),
    [](const BlocksOfSegment& a, const BlocksOfSegment& b) { return a.Segment < b.Segment; });
  RemarkOnSeparate(surface, picked, set);
  return set;
}
}
