// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSearch.h"

#include "CoarsePolycube.h"
#include "DomainMeasures.h"
#include "FlatPolycube.h"
#include "HandleLoop.h"
#include "InnerCorners.h"
#include "LayoutCheck.h"
#include "LayoutStretch.h"
#include "NormalAxes.h"
#include "PolycubeFit.h"
#include "RelaxedLayout.h"
#include "SurfaceReduction.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int MostRefinement = 2;
constexpr Index EnoughTriangles = 20000; // six charts need no more
constexpr Index FewTriangles = 3000;     // enough to tell how much a surface is stretched
constexpr double StretchCost = 1.5;      // in alignment
constexpr double LeastStretch = 0.01;    // that can be had of more cubes
constexpr double UnsoundCost = 0.05;     // in alignment, of cubes inverted between their corners
constexpr Index MostForBends = 8;        // cubes
constexpr Index LeastPerFace = 100;      // triangles of a surface, lest its roughness gets cubes
constexpr std::size_t MostLaidOut = 3;   // coarse polycubes
constexpr int MostWorse = 3;             // polycubes in a row, each with more corners
constexpr double DistanceCost = 5.0;     // in the stretch of a sheet laid over the surface

bool IsSound(const SegmentDomain& domain)
{
  return InvertedBlocks(CubeBlocks(domain)).empty();
}

std::vector<Vector3d> CornersOf(const SegmentDomain& domain)
{
  return { domain.Places.begin(), domain.Places.begin() + domain.Cubes.NumberOfCorners };
}

// The principal axes, and those to which the normals cling from there.
std::array<Matrix3d, 2> FramesOf(const SurfaceMesh& mesh)
{
  std::vector<double> areas;
  std::vector<Vector3d> normals, centres;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Triangle& c = mesh.Triangles[t];
    const Vector3d area = mesh.AreaVector(t);
    areas.push_back(area.norm());
    normals.push_back(area.normalized());
    centres.push_back((mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0);
  }
  const Matrix3d principal = PrincipalFrame(areas, centres);
  return { principal, ClingToNormals(areas, normals, principal) };
}
}

// Laid out on the surface, or corners from which it can be.
struct DomainSearch::Candidate
{
  double Value;
  std::unique_ptr<SegmentDomain> Domain;
  Polycube Cubes;
  std::vector<Vector3d> Corners;
  bool IsOfCharts;
};

//------------------------------------------------------------------------------
DomainSearch::DomainSearch(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
  : Mesh(mesh)
  , Options(options)
  , Run(execution)
  , IsSphere(mesh.EulerCharacteristic() == 2)
  , MostValue(-std::numeric_limits<double>::infinity())
{
}

//------------------------------------------------------------------------------
DomainSearch::~DomainSearch() = default;

//------------------------------------------------------------------------------
template <typename Attempt>
void DomainSearch::Try(const Attempt& attempt)
{
  try
  {
    attempt();
  }
  catch (const std::invalid_argument& error)
  {
    this->Reasons += std::string(" ") + error.what();
  }
  catch (const std::runtime_error& error)
  {
    this->Reasons += std::string(" ") + error.what();
  }
}

//------------------------------------------------------------------------------
SegmentDomain DomainSearch::Best()
{
  this->Small =
    std::make_unique<SurfaceMesh>(Reduced(this->Mesh, FewTriangles, this->Run.Part(0.0, 0.1)));
  Index triangles = this->Mesh.NumberOfTriangles();
  for (int level = 0; this->IsSphere && level <= MostRefinement && this->Found.empty(); ++level)
  {
    if (level > 0 && triangles > EnoughTriangles)
    {
      break;
    }
    triangles *= 4;
    this->Try([this, level]() { this->TryCubeAndChains(level); });
  }
  this->Try([this]() { this->TryFlatPolycube(); });
  if (this->IsSphere)
  {
    this->Try([this]() { this->TryCoarsePolycubes(); });
  }
  std::stable_sort(this->Found.begin(), this->Found.end(),
    [](const Candidate& a, const Candidate& b) { return a.Value > b.Value; });
  for (Candidate& candidate : this->Found)
  {
    if (!candidate.Domain)
    {
      this->Try(
        [this, &candidate]()
        {
          candidate.Domain = std::make_unique<SegmentDomain>(DomainFromCorners(
            this->Mesh, candidate.Cubes, candidate.Corners, this->Run.Part(0.8, 0.85)));
        });
    }
    if (candidate.Domain)
    {
      SegmentDomain& domain = *candidate.Domain;
      if (this->Options.Relax && Relax(domain.Layout, domain.Cubes, false, this->Run.Part(0.85, 1.0)))
      {
        candidate.IsOfCharts ? this->Charts->Measure(domain) : MeasureStraight(domain);
      }
      return std::move(domain);
    }
  }
  throw std::runtime_error(
    "No domain was found for the surface." + this->Handles() + this->Reasons);
}

//------------------------------------------------------------------------------
std::string DomainSearch::Handles() const
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

//------------------------------------------------------------------------------
double DomainSearch::Value(double alignment, double stretch, Index corners, bool sound) const
{
  return alignment - StretchCost * stretch - this->Options.CornerCost * double(corners) -
         (sound ? 0.0 : UnsoundCost);
}

//------------------------------------------------------------------------------
// Whether a domain with this many corners can be the best at all.
bool DomainSearch::IsWorthwhile(Index corners) const
{
  return this->Value(1.0, 0.0, corners, true) > this->MostValue;
}

//------------------------------------------------------------------------------
// Whether the best domain would be bettered by one with this many corners, aligned like it and
// hardly stretched.
bool DomainSearch::IsWorthLessStretch(Index corners) const
{
  return this->Found.empty() ||
         this->Value(this->BestAlignment, LeastStretch, corners, true) > this->MostValue;
}

//------------------------------------------------------------------------------
void DomainSearch::Note(double value, double alignment)
{
  if (value > this->MostValue)
  {
    this->MostValue = value;
    this->BestAlignment = alignment;
  }
}

//------------------------------------------------------------------------------
// One that is laid out on the surface already.
void DomainSearch::Offer(SegmentDomain domain)
{
  RefuseInvalid(CheckLayout(domain.Layout, domain.Cubes));
  const std::vector<Vector3d> corners = CornersOf(domain);
  double stretch = 1.0;
  this->Try(
    [&]()
    {
      const SegmentDomain small = DomainFromCorners(*this->Small, domain.Cubes, corners, this->Run);
      stretch = RelaxedStretch(small.Layout, small.Cubes, this->Run);
    });
  const double value =
    this->Value(domain.Alignment, stretch, domain.Cubes.NumberOfCorners, IsSound(domain));
  this->Note(value, domain.Alignment);
  const Polycube cubes = domain.Cubes;
  this->Found.push_back(
    { value, std::make_unique<SegmentDomain>(std::move(domain)), cubes, corners, true });
}

//------------------------------------------------------------------------------
// One that is laid out only if it is the best.
void DomainSearch::OfferCorners(const Polycube& cubes, const std::vector<Vector3d>& corners)
{
  const SegmentDomain small = DomainFromCorners(*this->Small, cubes, corners, this->Run);
  const double value = this->Value(small.Alignment, RelaxedStretch(small.Layout, cubes, this->Run),
    cubes.NumberOfCorners, IsSound(small));
  this->Note(value, small.Alignment);
  this->Found.push_back({ value, nullptr, cubes, corners, false });
}

//------------------------------------------------------------------------------
// On the surface itself or, where its triangles are too few for six charts, on one with each of
// them cut in four, `level` times.
void DomainSearch::TryCubeAndChains(int level)
{
  this->Charts = std::make_unique<ChartDomain>(
    this->Mesh, level, this->Options.Charts, this->Run.Part(0.1, 0.5));
  const ChartDomain& charts = *this->Charts;
  const bool isCubeSound = IsSound(charts.Cube());
  this->Offer(charts.Cube());
  const auto isSoundInChain = [&](Index cubes)
  {
    const Index count = std::min(cubes, this->Options.MostCubes);
    if (count < 2 || !this->IsWorthwhile(4 * (count + 1)))
    {
      return false;
    }
    SegmentDomain chain = charts.Chain(count, this->Run.Part(0.5, 0.55));
    const bool sound = IsSound(chain);
    this->Offer(std::move(chain));
    return sound;
  };
  // As many cubes as it is long and, where it is bent, as few as are sound.
  isSoundInChain(std::lround(charts.Length()));
  for (Index cubes = 2; !isCubeSound && cubes <= MostForBends && !isSoundInChain(cubes); ++cubes)
  {
  }
}

//------------------------------------------------------------------------------
void DomainSearch::TryFlatPolycube()
{
  const FlatPolycube flat =
    FindFlatPolycube(this->Mesh, this->Options.MostCubes, this->Run.Part(0.55, 0.6));
  if (this->IsWorthwhile(flat.Cubes.NumberOfCorners))
  {
    this->OfferCorners(flat.Cubes, flat.Corners);
  }
}

//------------------------------------------------------------------------------
// Those over which a sheet is stretched least are laid out.
void DomainSearch::TryCoarsePolycubes()
{
  std::vector<Candidate> fitted;
  // A bent cube is stretched evenly along its bend; a lattice does not follow that.
  if ((this->Charts && this->Charts->IsBent()) || !this->IsWorthLessStretch(8))
  {
    return;
  }
  for (const Matrix3d& frame : FramesOf(*this->Small))
  {
    const PolycubeFitter fitter(*this->Small, frame);
    double best = -std::numeric_limits<double>::infinity();
    int worse = 0;
    for (const CoarsePolycube& coarse :
      FindCoarsePolycubes(*this->Small, frame, this->Options.MostCubes, this->Run.Part(0.6, 0.6)))
    {
      const Index faces = static_cast<Index>(coarse.Cubes.Faces.size());
      if (worse == MostWorse || faces * LeastPerFace > this->Mesh.NumberOfTriangles() ||
          !this->IsWorthLessStretch(coarse.Cubes.NumberOfCorners))
      {
        break;
      }
      PolycubeFit fit = fitter.Fit(coarse.Cubes, coarse.Corners, this->Run.Part(0.6, 0.6));
      const double value =
        this->Value(0.0, fit.Stretch / (1.0 + fit.Stretch) + DistanceCost * fit.Distance,
          coarse.Cubes.NumberOfCorners, true);
      worse = value > best ? 0 : worse + 1;
      best = std::max(best, value);
      fitted.push_back({ value, nullptr, coarse.Cubes, std::move(fit.Corners), false });
    }
  }
  std::stable_sort(fitted.begin(), fitted.end(),
    [](const Candidate& a, const Candidate& b) { return a.Value > b.Value; });
  for (std::size_t i = 0; i < std::min(MostLaidOut, fitted.size()); ++i)
  {
    this->Run.Check(0.65 + 0.15 * double(i) / MostLaidOut);
    if (this->IsWorthLessStretch(fitted[i].Cubes.NumberOfCorners))
    {
      this->Try([&]() { this->OfferCorners(fitted[i].Cubes, fitted[i].Corners); });
    }
  }
}
}
