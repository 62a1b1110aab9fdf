// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DomainSearch.h"

#include "CoarsePolycube.h"
#include "Domain/DomainMeasures.h"
#include "Domain/InnerCorners.h"
#include "Domain/LayoutCheck.h"
#include "Domain/SurfaceReduction.h"
#include "FlatPolycube.h"
#include "HandleLoop.h"
#include "NormalAxes.h"
#include "Parameter/CoarseHexahedra.h"
#include "PolycubeFit.h"

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
constexpr Index FewTriangles = 2000;     // enough to tell how good hexahedra become
constexpr double GoodHexahedra = 0.83;   // of one cube: more are not looked for
constexpr double WantingShare = 0.25;    // of what one cube's want to 1: more cubes' want as much
constexpr double Margin = 0.035;         // in hexahedra, see MarginOf
constexpr double EdgedCube = 0.9;        // aligned so well, the surface has the edges of a cube
constexpr double AlignmentRate = 3.0;    // what a mean scaled Jacobian is worth in alignment
constexpr double UnsoundCost = 0.05;     // in alignment, of cubes inverted between their corners
constexpr Index MostForBends = 8;        // cubes
constexpr Index LeastPerFace = 100;      // triangles of the surface
constexpr int MostTries = 4;             // of coarse polycubes with more than one cube
constexpr int MostWorse = 4;             // polycubes in a row, each with more corners
constexpr double SheetCost = 1.5;        // in alignment, of a sheet's stretch and
constexpr double DistanceCost = 5.0;     // so many times its distance from the surface

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
  Polycube Cubes;
  std::vector<Vector3d> Corners;
  double Quality; // of its hexahedra
  std::unique_ptr<SegmentDomain> Domain;
  bool IsOfCharts;
};

//------------------------------------------------------------------------------
DomainSearch::DomainSearch(const SurfaceMesh& mesh, const PosedSurface& posed,
  const DomainOptions& options, const Execution& execution)
  : Mesh(mesh)
  , Posed(posed)
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
  if (this->IsSphere)
  {
    this->OfferCubeOrChain();
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
      this->IsOfCharts = best->IsOfCharts;
      return std::move(*best->Domain);
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
void DomainSearch::Measure(SegmentDomain& domain) const
{
  this->IsOfCharts ? this->Charts->Measure(domain) : MeasureStraight(domain);
}

//------------------------------------------------------------------------------
std::string DomainSearch::Handles() const
{
  if (this->IsSphere)
  {
    return "";
  }
  const HandleLoop handle = FindHandle(this->Mesh);
  const Vector3d place = this->Posed.ToGiven(handle.Place);
  const auto text = [](double x) { return std::to_string(x); };
  return " A loop around a handle, " + text(handle.Length) + " long, passes (" + text(place.x()) +
         ", " + text(place.y()) + ", " + text(place.z()) + ").";
}

//------------------------------------------------------------------------------
double DomainSearch::Value(double quality, Index corners) const
{
  return quality - this->Options.CornerCost * double(corners);
}

//------------------------------------------------------------------------------
// The best candidate; null where there is none.
DomainSearch::Candidate* DomainSearch::Leader()
{
  const auto valueOf = [this](const Candidate& c)
  { return this->Value(c.Quality, c.Cubes.NumberOfCorners); };
  const auto best = std::max_element(this->Found.begin(), this->Found.end(),
    [&](const Candidate& a, const Candidate& b) { return valueOf(a) < valueOf(b); });
  return best == this->Found.end() ? nullptr : &*best;
}

//------------------------------------------------------------------------------
// Whether a domain with this many corners can be the best, if its hexahedra are as good as can be
// hoped for.
bool DomainSearch::IsWorthwhile(Index corners)
{
  const Candidate* best = this->Leader();
  return !best || this->Value(1.0 - WantingShare * (1.0 - best->Quality), corners) >
                    this->Value(best->Quality, best->Cubes.NumberOfCorners);
}

//------------------------------------------------------------------------------
// By which hexahedra must be better than those of the others. Between cubes whose hexahedra are as
// good but for that, alignment decides. Hexahedra under a border along an edge of the surface are
// sheared, so they are better where borders stay away from edges; where charts have found those of
// a cube, what is lost in alignment has to be made good in full.
double DomainSearch::MarginOf(const SegmentDomain& domain, bool isCoarse) const
{
  const double lost = this->ChartAlignment - domain.Alignment;
  const double edges = this->ChartAlignment > EdgedCube ? std::max(0.0, lost) : 0.0;
  if (domain.Cubes.Cubes.size() == 1 && this->Charts)
  {
    return edges + (lost < 0.0 ? -Margin : Margin);
  }
  return edges + (isCoarse ? Margin : 0.0);
}

//------------------------------------------------------------------------------
// One that is laid out only if it is the best. Returns whether it is so far.
bool DomainSearch::OfferCorners(
  const Polycube& cubes, const std::vector<Vector3d>& corners, bool isCoarse)
{
  double quality = 0.0; // the only one where there are handles
  if (this->IsSphere)
  {
    const Execution run = this->Run.Part(0.7, 0.7);
    const SegmentDomain small = DomainFromCorners(*this->Small, cubes, corners, run);
    if (!isCoarse && !IsSound(small)) // that has no margin to make good
    {
      return false;
    }
    quality = CoarseHexahedra(small, run) - this->MarginOf(small, isCoarse);
  }
  this->Found.push_back({ cubes, corners, quality, nullptr, false });
  return this->Leader() == &this->Found.back();
}

//------------------------------------------------------------------------------
void DomainSearch::LayOut(Candidate& candidate)
{
  if (candidate.IsOfCharts)
  {
    candidate.Domain = this->FindCubeOrChain(this->Mesh);
    if (candidate.Domain)
    {
      candidate.Cubes = candidate.Domain->Cubes;
      candidate.Quality = this->QualityOfCube(this->Charts->Cube()); // its charts may be others
    }
    return;
  }
  candidate.Domain = std::make_unique<SegmentDomain>(
    DomainFromCorners(this->Mesh, candidate.Cubes, candidate.Corners, this->Run.Part(0.8, 0.85)));
}

//------------------------------------------------------------------------------
// What decides between a cube and chains cut from it, whose hexahedra are the same.
double DomainSearch::AlignmentValue(const SegmentDomain& domain) const
{
  return domain.Alignment - (IsSound(domain) ? 0.0 : UnsoundCost) -
         AlignmentRate * this->Options.CornerCost * double(domain.Cubes.NumberOfCorners);
}

//------------------------------------------------------------------------------
// A cube from charts, or a chain cut from it: of the surface of few triangles, if it has charts,
// and laid out on the surface itself only if it is the best.
void DomainSearch::OfferCubeOrChain()
{
  const bool isFew = this->Mesh.NumberOfTriangles() <= 3 * FewTriangles;
  const SurfaceMesh* on = isFew ? &this->Mesh : this->Small.get();
  std::unique_ptr<SegmentDomain> domain = this->FindCubeOrChain(*on);
  if (!domain && !isFew)
  {
    on = &this->Mesh;
    domain = this->FindCubeOrChain(*on);
  }
  if (domain)
  {
    this->ChartAlignment = domain->Alignment;
    const double quality = this->QualityOfCube(this->Charts->Cube());
    this->Found.push_back({ domain->Cubes, {}, quality, nullptr, true });
    if (on == &this->Mesh)
    {
      this->Found.back().Domain = std::move(domain);
    }
  }
}

//------------------------------------------------------------------------------
// On a surface as it is or, where its triangles are too few for six charts, with each of them cut
// in four once or twice. Null where there is none.
std::unique_ptr<SegmentDomain> DomainSearch::FindCubeOrChain(const SurfaceMesh& mesh)
{
  std::unique_ptr<SegmentDomain> found;
  Index triangles = mesh.NumberOfTriangles();
  for (int level = 0; level <= MostRefinement && !found; ++level)
  {
    if (level > 0 && triangles > EnoughTriangles)
    {
      break;
    }
    triangles *= 4;
    this->Try(
      [&]()
      {
        this->Charts = std::make_unique<ChartDomain>(
          mesh, level, this->Options.Charts, this->Run.Part(0.1, 0.5));
        found = std::make_unique<SegmentDomain>(this->CubeOrChain());
      });
  }
  if (!found)
  {
    this->Charts.reset();
  }
  return found;
}

//------------------------------------------------------------------------------
SegmentDomain DomainSearch::CubeOrChain()
{
  const ChartDomain& charts = *this->Charts;
  SegmentDomain best = charts.Cube();
  RefuseInvalid(CheckLayout(best.Layout, best.Cubes));
  const bool isCubeSound = IsSound(best);
  const auto isSoundInChain = [&](Index cubes)
  {
    bool sound = false;
    const Index count = std::min(cubes, this->Options.MostCubes);
    const double most = 1.0 - AlignmentRate * this->Options.CornerCost * double(4 * (count + 1));
    if (count >= 2 && most > this->AlignmentValue(best))
    {
      this->Try(
        [&]()
        {
          SegmentDomain chain = charts.Chain(count, this->Run.Part(0.5, 0.55));
          RefuseInvalid(CheckLayout(chain.Layout, chain.Cubes));
          sound = IsSound(chain);
          if (this->AlignmentValue(chain) > this->AlignmentValue(best))
          {
            best = std::move(chain);
          }
        });
    }
    return sound;
  };
  // As many cubes as it is long and, where it is bent, as few as are sound.
  isSoundInChain(std::lround(charts.Length()));
  for (Index cubes = 2; !isCubeSound && cubes <= MostForBends && !isSoundInChain(cubes); ++cubes)
  {
  }
  return best;
}

//------------------------------------------------------------------------------
// As it is or, if its triangles are many, with geodesics between its corners on the surface of few
// triangles. 0 where it cannot be laid out there.
double DomainSearch::QualityOfCube(const SegmentDomain& cube)
{
  double quality = 0.0;
  const Execution run = this->Run.Part(0.5, 0.5);
  this->Try(
    [&]()
    {
      const bool isFew = cube.Layout.Triangles.size() <= std::size_t(4 * FewTriangles);
      quality = CoarseHexahedra(
        isFew ? cube : DomainFromCorners(*this->Small, cube.Cubes, CornersOf(cube), run), run);
    });
  return quality;
}

//------------------------------------------------------------------------------
void DomainSearch::TryFlatPolycube()
{
  const FlatPolycube flat =
    FindFlatPolycube(this->Mesh, this->Options.MostCubes, this->Run.Part(0.55, 0.6));
  if (this->IsWorthwhile(flat.Cubes.NumberOfCorners))
  {
    this->OfferCorners(flat.Cubes, flat.Corners, false);
  }
}

//------------------------------------------------------------------------------
// One cube, with the corners of a sheet, and the polycubes over which a sheet is stretched least,
// until one is the best.
void DomainSearch::TryCoarsePolycubes()
{
  const Candidate* best = this->Leader();
  if (best && best->Quality > GoodHexahedra)
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
    this->Try([&]() { this->OfferCorners(fitted.front().Cubes, fitted.front().Corners, true); });
  }
  bool found = false;
  const auto end = more + std::min<std::ptrdiff_t>(MostTries, fitted.end() - more);
  for (auto fit = more; fit != end && !found; ++fit)
  {
    this->Run.Check(0.7 + 0.1 * double(fit - more) / MostTries);
    if (this->IsWorthwhile(fit->Cubes.NumberOfCorners))
    {
      this->Try([&]() { found = this->OfferCorners(fit->Cubes, fit->Corners, true); });
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
          !this->IsWorthwhile(corners))
      {
        break;
      }
      PolycubeFit fit = fitter.Fit(coarse.Cubes, coarse.Corners, this->Run.Part(0.7, 0.7));
      const double value =
        -SheetCost * (fit.Stretch / (1.0 + fit.Stretch) + DistanceCost * fit.Distance) -
        AlignmentRate * this->Options.CornerCost * double(corners);
      worse = value > best ? 0 : worse + 1;
      best = std::max(best, value);
      fitted.push_back({ coarse.Cubes, std::move(fit.Corners), value });
    }
  }
  return fitted;
}
}
