// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentDomain.h"

#include "ChainLayout.h"
#include "ClosestRotation.h"
#include "FlatPolycube.h"
#include "HandleLoop.h"
#include "InnerCorners.h"
#include "LayoutCheck.h"
#include "RelaxedLayout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int MostRefinement = 2;
constexpr Index EnoughTriangles = 20000; // six charts need no more
constexpr double StretchInEdges = 3.0;   // so far chart borders are straightened
constexpr double UnsoundCost = 0.05;     // in alignment, of cubes inverted between their corners
constexpr Index MostForBends = 8;        // cubes

double MeanEdgeLength(const SurfaceMesh& mesh)
{
  double sum = 0.0;
  for (const Triangle& c : mesh.Triangles)
  {
    for (int k = 0; k < 3; ++k)
    {
      sum += (mesh.Points[c[(k + 1) % 3]] - mesh.Points[c[k]]).norm();
    }
  }
  return sum / (3.0 * double(mesh.Triangles.size()));
}

double SignOf(ChartLabel label)
{
  return label % 2 ? 1.0 : -1.0;
}

// Twice the area vectors of the layout's triangles.
Vector3d AreaVector(const SurfaceLayout& layout, std::size_t t)
{
  const Triangle& c = layout.Triangles[t];
  const Vector3d& origin = layout.Points[c[0]];
  return (layout.Points[c[1]] - origin).cross(layout.Points[c[2]] - origin);
}

// `frame` tells the directions (rows) for a triangle of the layout.
template <typename Frame>
double AlignmentOf(const SurfaceLayout& layout, const Frame& frame)
{
  double sum = 0.0, area = 0.0;
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const Vector3d n = AreaVector(layout, t);
    const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
    sum += SignOf(label) * frame(t).row(label / 2).dot(n);
    area += n.norm();
  }
  return sum / area;
}

// The rotation toward whose rows the normals of the patches point most.
Matrix3d BestFrame(const SurfaceLayout& layout)
{
  Matrix3d correlation = Matrix3d::Zero();
  for (std::size_t t = 0; t < layout.Triangles.size(); ++t)
  {
    const ChartLabel label = layout.PatchLabels[layout.Patches[t]];
    correlation.row(label / 2) += SignOf(label) * AreaVector(layout, t).transpose();
  }
  return ClosestRotation(correlation);
}

// Corners where the layout has them, inner points in the middle of their neighbours.
std::vector<Vector3d> PlacesOf(const SurfaceLayout& layout, const Polycube& cubes)
{
  std::vector<Vector3d> places(cubes.Points.size(), Vector3d::Zero());
  for (Index corner = 0; corner < cubes.NumberOfCorners; ++corner)
  {
    places[corner] = layout.Points[layout.Corners[corner]];
  }
  std::map<LatticePoint, Index> numbers;
  for (std::size_t p = 0; p < cubes.Points.size(); ++p)
  {
    numbers[cubes.Points[p]] = static_cast<Index>(p);
  }
  // An inner point has all six neighbours. Gauss-Seidel; lattices are small.
  double change = 1.0;
  for (int round = 0; round < 10000 && change > 0.0; ++round)
  {
    change = 0.0;
    for (std::size_t p = cubes.NumberOfCorners; p < cubes.Points.size(); ++p)
    {
      Vector3d sum = Vector3d::Zero();
      for (int axis = 0; axis < 3; ++axis)
      {
        for (const int step : { -1, 1 })
        {
          LatticePoint neighbour = cubes.Points[p];
          neighbour[axis] += step;
          sum += places[numbers.at(neighbour)];
        }
      }
      change = std::max(change, (sum / 6.0 - places[p]).norm());
      places[p] = sum / 6.0;
    }
  }
  return places;
}

// A layout whose charts are the unit faces of a polycube, put into the polycube's order. `at`: the
// lattice point of each corner.
SurfaceLayout InOrderOf(
  const Polycube& cubes, const SurfaceLayout& charts, const std::vector<LatticePoint>& at)
{
  SurfaceLayout layout = charts;
  std::vector<Index> newCorner(at.size());
  for (std::size_t corner = 0; corner < at.size(); ++corner)
  {
    const auto end = cubes.Points.begin() + cubes.NumberOfCorners;
    newCorner[corner] = std::find(cubes.Points.begin(), end, at[corner]) - cubes.Points.begin();
    layout.Corners.at(newCorner[corner]) = charts.Corners[corner];
  }
  std::vector<Index> newPatch(charts.PatchLabels.size(), -1);
  for (const LayoutBorder& border : charts.Borders)
  {
    const Index from = newCorner[border.Corners[0]], to = newCorner[border.Corners[1]];
    for (std::size_t e = 0; e < cubes.Edges.size(); ++e)
    {
      const Polycube::Edge& edge = cubes.Edges[e];
      if (edge.From == from && edge.To == to)
      {
        layout.Borders[e] = { { from, to }, { edge.Left, edge.Right }, border.Points };
        newPatch[border.Patches[0]] = edge.Left;
        newPatch[border.Patches[1]] = edge.Right;
      }
      else if (edge.From == to && edge.To == from)
      {
        layout.Borders[e] = { { to, from }, { edge.Left, edge.Right },
          std::vector<Index>(border.Points.rbegin(), border.Points.rend()) };
        newPatch[border.Patches[1]] = edge.Left;
        newPatch[border.Patches[0]] = edge.Right;
      }
    }
  }
  for (std::size_t patch = 0; patch < newPatch.size(); ++patch)
  {
    layout.PatchLabels.at(newPatch[patch]) = charts.PatchLabels[patch];
  }
  for (Index& patch : layout.Patches)
  {
    patch = newPatch[patch];
  }
  return layout;
}

// Places, and the alignment with the directions that are best for the whole segment.
void MeasureStraight(SegmentDomain& domain)
{
  domain.Places = PlacesOf(domain.Layout, domain.Cubes);
  const Matrix3d frame = BestFrame(domain.Layout);
  domain.Alignment =
    AlignmentOf(domain.Layout, [&frame](std::size_t) -> const Matrix3d& { return frame; });
}

void RefuseInvalid(const std::vector<std::string>& messages)
{
  if (!messages.empty())
  {
    throw std::runtime_error("The layout found is not valid: " + messages.front());
  }
}

// Triangle t becomes 4 t to 4 t + 3; points keep their numbers.
SurfaceMesh CutInFour(const SurfaceMesh& mesh)
{
  std::vector<Vector3d> points = mesh.Points;
  std::vector<std::array<Index, 3>> middles(mesh.Triangles.size());
  std::vector<Triangle> triangles;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Triangle& c = mesh.Triangles[t];
    for (int k = 0; k < 3; ++k)
    {
      const Index across = mesh.Neighbour(t, k);
      if (across > t)
      {
        middles[t][k] = static_cast<Index>(points.size());
        points.push_back(0.5 * (mesh.Points[c[k]] + mesh.Points[c[(k + 1) % 3]]));
      }
      else
      {
        middles[t][k] = middles[across][mesh.CornerOf(across, c[(k + 1) % 3])];
      }
    }
    const std::array<Index, 3>& m = middles[t];
    triangles.insert(triangles.end(),
      { { c[0], m[0], m[2] }, { c[1], m[1], m[0] }, { c[2], m[2], m[1] }, { m[0], m[1], m[2] } });
  }
  return SurfaceMesh(std::move(points), std::move(triangles));
}

// Candidates, and the best of them.
class Search
{
public:
  Search(const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
    : Mesh(mesh)
    , Options(options)
    , Run(execution)
    , IsSphere(mesh.EulerCharacteristic() == 2)
  {
  }

  SegmentDomain Best()
  {
    std::string reasons;
    const auto attempt = [&reasons](const auto& candidate)
    {
      try
      {
        candidate();
      }
      catch (const std::invalid_argument& error)
      {
        reasons += std::string(" ") + error.what();
      }
      catch (const std::runtime_error& error)
      {
        reasons += std::string(" ") + error.what();
      }
    };
    Index triangles = this->Mesh.NumberOfTriangles();
    for (int level = 0; this->IsSphere && level <= MostRefinement && !this->Found; ++level)
    {
      if (level > 0 && triangles > EnoughTriangles)
      {
        break;
      }
      triangles *= 4;
      attempt([this, level]() { this->TryCubeAndChain(level); });
    }
    attempt([this]() { this->TryFlatPolycube(); });
    if (!this->Found)
    {
      throw std::runtime_error("No domain was found for the surface." + this->Handles() + reasons);
    }
    SegmentDomain& domain = *this->Found;
    if (this->Options.Relax && Relax(domain.Layout, domain.Cubes, false, this->Run.Part(0.85, 1.0)))
    {
      this->Measure(domain);
    }
    return std::move(domain);
  }

private:
  std::string Handles() const
  {
    if (this->IsSphere)
    {
      return "";
    }
    const HandleLoop handle = FindHandle(this->Mesh);
    const auto text = [](double x) { return std::to_string(x); };
    return " It has " + std::to_string(1 - this->Mesh.EulerCharacteristic() / 2) +
           " handle(s); a loop around one, " + text(handle.Length) + " long, passes (" +
           text(handle.Place.x()) + ", " + text(handle.Place.y()) + ", " + text(handle.Place.z()) +
           "). Cut or close handles first.";
  }

  static bool IsSound(const SegmentDomain& domain)
  {
    return InvertedBlocks(CubeBlocks(domain)).empty();
  }

  double Value(const SegmentDomain& domain) const
  {
    return domain.Alignment - this->Options.CornerCost * double(domain.Cubes.NumberOfCorners) -
           (IsSound(domain) ? 0.0 : UnsoundCost);
  }

  // Whether a domain with this many corners can be the best at all.
  bool IsWorthwhile(Index corners) const
  {
    return !this->Found ||
           1.0 - this->Options.CornerCost * double(corners) > this->Value(*this->Found);
  }

  // `measure` gives a domain its places and alignment.
  void Offer(SegmentDomain domain, const std::function<void(SegmentDomain&)>& measure)
  {
    RefuseInvalid(CheckLayout(domain.Layout, domain.Cubes));
    if (!this->Found || this->Value(domain) > this->Value(*this->Found))
    {
      this->Found = std::make_unique<SegmentDomain>(std::move(domain));
      this->Measure = measure;
    }
  }

  // On the surface itself or, where its triangles are too few for six charts, on one with each of
  // them cut in four, `level` times.
  void TryCubeAndChain(int level)
  {
    SurfaceMesh refined = this->Mesh;
    for (int i = 0; i < level; ++i)
    {
      refined = CutInFour(refined);
    }
    const auto shared = std::make_shared<const CubeCharts>(
      FindCubeCharts(refined, this->Options.Charts, this->Run.Part(0.0, 0.5)));
    const CubeCharts& charts = *shared;
    const SurfaceLayout layout = LayoutFromCharts(
      refined, charts.Labels, this->Run.Part(0.5, 0.6), StretchInEdges * MeanEdgeLength(refined));
    const auto offer = [this, level, shared](SegmentDomain domain)
    {
      for (Index& origin : domain.Layout.Origins)
      {
        origin >>= 2 * level;
      }
      this->Offer(std::move(domain),
        [level, shared](SegmentDomain& found) { Finish(found, *shared, level); });
    };
    std::vector<LatticePoint> corners;
    RefuseInvalid(CheckCharts(layout, &corners));
    SegmentDomain cube{ {}, Chain(0, 1), {}, 0.0 };
    cube.Layout = InOrderOf(cube.Cubes, layout, corners);
    Finish(cube, charts, 0);
    offer(cube);

    const auto [axis, length] = Longest(cube.Layout);
    const auto isSoundInChain = [&, axis = axis](Index cubes)
    {
      const int count = static_cast<int>(std::min(cubes, this->Options.MostCubes));
      if (count < 2 || !this->IsWorthwhile(4 * (count + 1)))
      {
        return false;
      }
      SegmentDomain chain{ CutIntoChain(cube.Layout, axis, count, this->Run.Part(0.6, 0.65)),
        Chain(axis, count), {}, 0.0 };
      Finish(chain, charts, 0);
      const bool sound = IsSound(chain);
      offer(std::move(chain));
      return sound;
    };
    // As many cubes as it is long and, where it is bent, as few as are sound.
    isSoundInChain(std::lround(length));
    for (Index cubes = 2; !IsSound(cube) && cubes <= MostForBends && !isSoundInChain(cubes);
         ++cubes)
    {
    }
  }

  void TryFlatPolycube()
  {
    const FlatPolycube flat =
      FindFlatPolycube(this->Mesh, this->Options.MostCubes, this->Run.Part(0.65, 0.75));
    if (this->IsWorthwhile(flat.Cubes.NumberOfCorners))
    {
      this->Offer(
        DomainFromCorners(this->Mesh, flat.Cubes, flat.Corners, this->Run.Part(0.75, 0.85)),
        MeasureStraight);
    }
  }

  // Places and alignment, by the charts' directions, each cube's turned as a whole toward its own
  // normals. `level`: how often each of the layout's original triangles was cut for the charts.
  static void Finish(SegmentDomain& domain, const CubeCharts& charts, int level)
  {
    domain.Places = PlacesOf(domain.Layout, domain.Cubes);
    const auto charted = [&](std::size_t t) -> const Matrix3d&
    { return charts.Frames[charts.FrameOfTriangle[domain.Layout.Origins[t] << 2 * level]]; };
    const auto cubeOf = [&domain](std::size_t t)
    { return domain.Cubes.Faces[domain.Layout.Patches[t]].Cube; };
    std::vector<Matrix3d> turns(domain.Cubes.Cubes.size(), Matrix3d::Zero());
    for (std::size_t t = 0; t < domain.Layout.Triangles.size(); ++t)
    {
      const ChartLabel label = domain.Layout.PatchLabels[domain.Layout.Patches[t]];
      turns[cubeOf(t)].row(label / 2) +=
        SignOf(label) * (charted(t) * AreaVector(domain.Layout, t)).transpose();
    }
    std::transform(turns.begin(), turns.end(), turns.begin(), ClosestRotation);
    domain.Alignment = AlignmentOf(
      domain.Layout, [&](std::size_t t) -> Matrix3d { return turns[cubeOf(t)] * charted(t); });
  }

  // The axis along which a cube's borders are longest, and how long against the others.
  static std::pair<int, double> Longest(const SurfaceLayout& cube)
  {
    Vector3d lengths = Vector3d::Zero();
    for (const LayoutBorder& border : cube.Borders)
    {
      const int axis =
        3 - cube.PatchLabels[border.Patches[0]] / 2 - cube.PatchLabels[border.Patches[1]] / 2;
      for (std::size_t i = 0; i + 1 < border.Points.size(); ++i)
      {
        lengths[axis] += (cube.Points[border.Points[i + 1]] - cube.Points[border.Points[i]]).norm();
      }
    }
    int axis = 0;
    const double length = lengths.maxCoeff(&axis);
    return { axis, 2.0 * length / (lengths.sum() - length) };
  }

  const SurfaceMesh& Mesh;
  const DomainOptions& Options;
  const Execution& Run;
  const bool IsSphere;
  std::unique_ptr<SegmentDomain> Found;
  std::function<void(SegmentDomain&)> Measure; // of the domain found
};
}

//------------------------------------------------------------------------------
SegmentDomain FindDomain(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
{
  Index pieces = 0;
  mesh.Components(pieces);
  if (pieces != 1)
  {
    throw std::invalid_argument(
      "The surface has " + std::to_string(pieces) + " pieces; a domain is for one.");
  }
  return Search(mesh, options, execution).Best();
}

//------------------------------------------------------------------------------
SegmentDomain DomainFromCorners(const SurfaceMesh& mesh, const Polycube& polycube,
  const std::vector<Vector3d>& picked, const Execution& execution, double farthest,
  const std::vector<GivenBorder>& given)
{
  SegmentDomain domain{ LayoutFromCorners(mesh, polycube, picked, execution, farthest, given),
    polycube, {}, 0.0 };
  RefuseInvalid(CheckLayout(domain.Layout, polycube));
  MeasureStraight(domain);
  return domain;
}

//------------------------------------------------------------------------------
void RelaxDomain(SegmentDomain& domain, const Execution& execution)
{
  if (Relax(domain.Layout, domain.Cubes, true, execution))
  {
    MeasureStraight(domain);
  }
}
}
