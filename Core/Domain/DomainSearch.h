// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Candidates for the domain of a segment, and the best of them.
#ifndef trivariate_DomainSearch_h
#define trivariate_DomainSearch_h

#include "ChartDomain.h"

#include <limits>
#include <memory>
#include <string>

namespace trivariate
{
class DomainSearch
{
public:
  DomainSearch(const SurfaceMesh& mesh, const DomainOptions& options, const Execution& execution);
  ~DomainSearch();

  /// Throws std::runtime_error with the reasons where there is none.
  SegmentDomain Best();

private:
  struct Candidate;

  template <typename Attempt>
  void Try(const Attempt& attempt);
  void TryCubeAndChains(int level);
  void TryFlatPolycube();
  void TryCoarsePolycubes();
  void Offer(SegmentDomain domain);
  void OfferCorners(const Polycube& cubes, const std::vector<Eigen::Vector3d>& corners);
  double Value(double alignment, double stretch, Index corners, bool sound) const;
  bool IsWorthwhile(Index corners) const;
  bool IsWorthLessStretch(Index corners) const;
  void Note(double value, double alignment);
  std::string Handles() const;

  const SurfaceMesh& Mesh;
  const DomainOptions& Options;
  const Execution& Run;
  const bool IsSphere;
  std::unique_ptr<SurfaceMesh> Small; // of fewer triangles
  std::unique_ptr<ChartDomain> Charts;
  std::vector<Candidate> Found;
  double MostValue;
  double BestAlignment = 1.0; // of the domain with that value
  std::string Reasons;
};
}

#endif
