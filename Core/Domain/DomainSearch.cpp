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
constexpr Index FewTriangles = 2000;     // enough to tell how much a surface is stretched
constexpr double StretchCost = 0.4;      // in alignment, of e times the stretch, from StretchUnit
constexpr double StretchUnit = 0.05;
constexpr double LeastStretch = 0.1;  // that is worth a search for more cubes
constexpr double LessStretch = 0.5;   // of one cube's that can be had of more
constexpr double UnsoundCost = 0.05;  // in alignment, of cubes inverted between their corners
constexpr double CoarseMargin = 0.03; // so much better must a coarse polycube be: no cubes for
                                      // what is only rough
constexpr Index MostForBends = 8;     // cubes
constexpr Index LeastPerFace = 100;   // triangles of the surface
constexpr int MostTries = 3;          // to lay out a coarse polycube
constexpr int MostWorse = 4;          // polycubes in a row, each with more corners
constexpr double SheetCost = 1.5;     // in alignment, of a sheet's stretch and
constexpr double DistanceCost = 5.0;  // so many times its distance from the surface

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
  std::unique_ptr<SegmentDomain> Domain;
  Polycube Cubes;
  std::vector<Vector3d> Corners;
  double Alignment, Stretch;
  bool IsSound;
  double Margin; // by which it must be better than others
  bool IsOfCharts;
};

//------------------------------------------------------------------------------
DomainSearch::DomainSearch(
  const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution)
  : Mesh(mesh)
  , Options(options)
  , Run(execution)
  , IsSphere(mesh.EulerCharacteristic() == 2)
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
  while (Candidate* best = this->Leader())
  {
    if (best->Domain)
    {
      SegmentDomain& domain = *best->Domain;
      if (this->Options.Relax &&
          Relax(domain.Layout, domain.Cubes, false, this->Run.Part(0.85, 1.0)))
      {
        best->IsOfCharts ? this->Charts->Measure(domain) : MeasureStraight(domain);
      }
      return std::move(domain);
    }
    this->Try([this, best]() { this->LayOut(*best); });
    if (!best->Domain)
    {
      this->Found.erase(this->Found.begin() + (best - this->Found.data()));
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
double DomainSearch::Value(double alignment, double stretch, Index corners) const
{
  return alignment - StretchCost * std::log(1.0 + stretch / StretchUnit) -
         this->Options.CornerCost * double(corners);
}

//------------------------------------------------------------------------------
// One cube, with whatever corners, and chains, which are cut from one, are stretched as a cube must
// be: what is left to choose among them is alignment.
double DomainSearch::StretchOf(const Candidate& candidate) const
{
  const bool isCube = candidate.IsOfCharts || candidate.Cubes.Cubes.size() == 1;
  return isCube ? std::min(candidate.Stretch, this->CubeStretch) : candidate.Stretch;
}

//------------------------------------------------------------------------------
double DomainSearch::Value(const Candidate& candidate) const
{
  const double stretch = this->StretchOf(candidate);
  return this->Value(candidate.Alignment, stretch, candidate.Cubes.NumberOfCorners) -
         (candidate.IsSound ? 0.0 : UnsoundCost) - candidate.Margin;
}

//------------------------------------------------------------------------------
// The best candidate; null where there is none.
DomainSearch::Candidate* DomainSearch::Leader()
{
  const auto best = std::max_element(this->Found.begin(), this->Found.end(),
    [this](const Candidate& a, const Candidate& b) { return this->Value(a) < this->Value(b); });
  return best == this->Found.end() ? nullptr : &*best;
}

//------------------------------------------------------------------------------
// Whether a domain with this many corners, and no less stretched, can be the best at all.
bool DomainSearch::IsWorthwhile(Index corners, double stretch)
{
  const Candidate* best = this->Leader();
  return !best || this->Value(1.0, stretch, corners) > this->Value(*best);
}

//------------------------------------------------------------------------------
// Whether the best domain would be bettered by a coarse polycube with this many corners, aligned
// like it and stretched half as much.
bool DomainSearch::IsWorthLessStretch(Index corners)
{
  const Candidate* best = this->Leader();
  return !best || this->Value(best->Alignment, LessStretch * this->StretchOf(*best), corners) -
                      CoarseMargin >
                    this->Value(*best);
}

//------------------------------------------------------------------------------
// One of charts, that is laid out on the surface already.
void DomainSearch::Offer(SegmentDomain domain, double stretch)
{
  RefuseInvalid(CheckLayout(domain.Layout, domain.Cubes));
  Candidate candidate{ nullptr, domain.Cubes, {}, domain.Alignment, stretch, IsSound(domain), 0.0,
    true };
  candidate.Domain = std::make_unique<SegmentDomain>(std::move(domain));
  this->Found.push_back(std::move(candidate));
}

//------------------------------------------------------------------------------
// One that is laid out only if it is the best. Returns its stretch.
double DomainSearch::OfferCorners(
  const Polycube& cubes, const std::vector<Vector3d>& corners, double margin)
{
  const Execution run = this->Run.Part(0.7, 0.7);
  const SegmentDomain small = DomainFromCorners(*this->Small, cubes, corners, run);
  const double stretch = RelaxedStretch(small.Layout, cubes, run);
  this->Found.push_back(
    { nullptr, cubes, corners, small.Alignment, stretch, IsSound(small), margin, false });
  if (cubes.Cubes.size() == 1)
  {
    this->CubeStretch = std::min(this->CubeStretch, stretch);
  }
  return stretch;
}

//------------------------------------------------------------------------------
void DomainSearch::LayOut(Candidate& candidate) const
{
  candidate.Domain = std::make_unique<SegmentDomain>(
    DomainFromCorners(this->Mesh, candidate.Cubes, candidate.Corners, this->Run.Part(0.8, 0.85)));
  candidate.Alignment = candidate.Domain->Alignment;
  candidate.IsSound = IsSound(*candidate.Domain);
}

//------------------------------------------------------------------------------
// On the surface itself or, where its triangles are too few for six charts, on one with each of
// them cut in four, `level` times.
void DomainSearch::TryCubeAndChains(int level)
{
  this->Charts = std::make_unique<ChartDomain>(
    this->Mesh, level, this->Options.Charts, this->Run.Part(0.1, 0.5));
  const ChartDomain& charts = *this->Charts;
  SegmentDomain cube = charts.Cube();
  const bool isCubeSound = IsSound(cube);
  double stretch = 1.0; // of chains as well: they are cut from the cube
  this->Try(
    [&]()
    {
      const SegmentDomain small =
        DomainFromCorners(*this->Small, cube.Cubes, CornersOf(cube), this->Run.Part(0.5, 0.5));
      stretch = RelaxedStretch(small.Layout, small.Cubes, this->Run.Part(0.5, 0.5));
    });
  this->Offer(std::move(cube), stretch);
  const auto isSoundInChain = [&](Index cubes)
  {
    const Index count = std::min(cubes, this->Options.MostCubes);
    if (count < 2 || !this->IsWorthwhile(4 * (count + 1), stretch))
    {
      return false;
    }
    SegmentDomain chain = charts.Chain(count, this->Run.Part(0.5, 0.55));
    const bool sound = IsSound(chain);
    this->Offer(std::move(chain), stretch);
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
  if (this->IsWorthwhile(flat.Cubes.NumberOfCorners, 0.0))
  {
    this->OfferCorners(flat.Cubes, flat.Corners, 0.0);
  }
}

//------------------------------------------------------------------------------
// A cube, and the one over which a sheet is stretched least, are laid out.
void DomainSearch::TryCoarsePolycubes()
{
  const Candidate* best = this->Leader();
  if (best && this->StretchOf(*best) < LeastStretch)
  {
    return;
  }
  std::vector<Fitted> fitted = this->FitCoarsePolycubes();
  std::stable_sort(fitted.begin(), fitted.end(),
    [](const Fitted& a, const Fitted& b) { return a.Value > b.Value; });
  const auto more = std::stable_partition(
    fitted.begin(), fitted.end(), [](const Fitted& fit) { return fit.Cubes.Cubes.size() == 1; });
  if (more != fitted.begin())
  {
    this->Try(
      [&]() { this->OfferCorners(fitted.front().Cubes, fitted.front().Corners, CoarseMargin); });
  }
  // The others in turn, until one can be laid out and mapped.
  double stretch = 1.0;
  const auto end = more + std::min<std::ptrdiff_t>(MostTries, fitted.end() - more);
  for (auto fit = more; fit != end && stretch == 1.0; ++fit)
  {
    this->Run.Check(0.7 + 0.1 * double(fit - more) / MostTries);
    if (this->IsWorthLessStretch(fit->Cubes.NumberOfCorners))
    {
      this->Try([&]() { stretch = this->OfferCorners(fit->Cubes, fit->Corners, CoarseMargin); });
    }
  }
}

//------------------------------------------------------------------------------
std::vector<DomainSearch::Fitted> DomainSearch::FitCoarsePolycubes()
{
  std::vector<Fitted> fitted;
  for (const Matrix3d& frame : FramesOf(*this->Small))
  {
    const PolycubeFitter fitter(*this->Small, frame);
    double best = -std::numeric_limits<double>::infinity();
    int worse = 0;
    for (const CoarsePolycube& coarse :
      FindCoarsePolycubes(*this->Small, frame, this->Options.MostCubes, this->Run.Part(0.7, 0.7)))
    {
      const Index corners = coarse.Cubes.NumberOfCorners;
      const Index faces = static_cast<Index>(coarse.Cubes.Faces.size());
      if (worse == MostWorse || faces * LeastPerFace > this->Mesh.NumberOfTriangles() ||
          !this->IsWorthLessStretch(corners))
      {
        break;
      }
      PolycubeFit fit = fitter.Fit(coarse.Cubes, coarse.Corners, this->Run.Part(0.7, 0.7));
      const double value =
        -SheetCost * (fit.Stretch / (1.0 + fit.Stretch) + DistanceCost * fit.Distance) -
        this->Options.CornerCost * double(corners);
      worse = value > best ? 0 : worse + 1;
      best = std::max(best, value);
      fitted.push_back({ coarse.Cubes, std::move(fit.Corners), value });
    }
  }
  return fitted;
}
}
