// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Candidates for the domain of a segment, and the best of them.
#ifndef trivariate_DomainSearch_h
#define trivariate_DomainSearch_h

#include "ChartDomain.h"
#include "FindDomain.h"
#include "PosedSurface.h"

#include <memory>
#include <string>

namespace trivariate
{
class DomainSearch
{
public:
  /// On a posed surface or one of fewer triangles.
  DomainSearch(const SurfaceMesh& mesh, const PosedSurface& posed, const DomainOptions& options,
    const Execution& execution);
  ~DomainSearch();

  /// Throws std::runtime_error with the reasons where there is none.
  SegmentDomain Best();

  /// Gives a domain that Best found, but on other borders, places and alignment. Triangles of the
  /// surface are its origins.
  void Measure(SegmentDomain& domain) const;

  /// Whether its borders are those of charts, not paths between corners.
  bool FoundCharts() const { return this->IsOfCharts; }

private:
  struct Candidate;
  struct Fitted
  {
    Polycube Cubes;
    std::vector<Eigen::Vector3d> Corners;
    double Value;
  };

  template <typename Attempt>
  void Try(const Attempt& attempt);
  void OfferCubeOrChain();
  std::unique_ptr<SegmentDomain> FindCubeOrChain(const SurfaceMesh& mesh);
  SegmentDomain CubeOrChain();
  void TryFlatPolycube();
  void TryCoarsePolycubes();
  std::vector<Fitted> FitCoarsePolycubes();
  bool OfferCorners(
    const Polycube& cubes, const std::vector<Eigen::Vector3d>& corners, bool isCoarse);
  double MarginOf(const SegmentDomain& domain, bool isCoarse) const;
  void LayOut(Candidate& candidate);
  double Value(double quality, Index corners) const;
  double AlignmentValue(const SegmentDomain& domain) const;
  double QualityOfCube(const SegmentDomain& cube);
  Candidate* Leader();
  bool IsWorthwhile(Index corners);
  std::string Handles() const;

  const SurfaceMesh& Mesh;
  const PosedSurface& Posed;
  const DomainOptions& Options;
  const Execution& Run;
  const bool IsSphere;
  std::unique_ptr<SurfaceMesh> Small;  // of fewer triangles
  std::unique_ptr<ChartDomain> Charts; // of the surface or of that of fewer triangles
  double ChartAlignment = 0.0;
  bool IsOfCharts = false; // the one returned
  std::vector<Candidate> Found;
  std::string Reasons;
};
}

#endif
