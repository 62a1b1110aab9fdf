// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FacingFaces.h"

#include <algorithm>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;

// Whether the two axes of a face run anticlockwise as the surface is seen from outside.
bool IsAnticlockwise(const PatchFace& face, const BlockPatch& patch)
{
  const std::array<Index, 4>& corners = patch.Corners;
  const auto low = std::find(corners.begin(), corners.end(), face.NodeAt(0, 0)) - corners.begin();
  return corners[(low + 1) % 4] == face.NodeAt(face.Cells[0], 0);
}
}

//------------------------------------------------------------------------------
FacingFaces::FacingFaces(
  const SlidingNodes& sliding, const BlockMesh& mesh, const std::vector<Vector3d>& targets)
{
  const BlockDomain& domain = sliding.Surface().Domain;
  const std::vector<PatchFace> faces = PatchFaces(domain, mesh);
  for (std::size_t p = 0; p < faces.size(); ++p)
  {
    const PatchFace& face = faces[p];
    const bool anticlockwise = IsAnticlockwise(face, domain.Patches[p]);
    const Vector3d& lengths = targets[face.Block];
    for (int t = 0; t < face.Cells[1]; ++t)
    {
      for (int s = 0; s < face.Cells[0]; ++s)
      {
        for (int corner = 0; corner < 4; ++corner)
        {
          const int i = corner % 2, j = corner / 2;
          Corner at{ { face.NodeAt(s + i, t + j), face.NodeAt(s + 1 - i, t + j),
                       face.NodeAt(s + i, t + 1 - j) },
            { lengths[face.Axis == 0 ? 1 : 0], lengths[face.Axis == 2 ? 1 : 2] } };
          if ((i == j) != anticlockwise)
          {
            std::swap(at.Nodes[1], at.Nodes[2]);
            std::swap(at.Lengths[0], at.Lengths[1]);
          }
          if (sliding.KindOf(at.Nodes[0]) == SlidingNodes::OnSurface)
          {
            this->Corners.push_back(at);
          }
        }
      }
    }
  }
  this->AroundStart.assign(mesh.Places.size() + 1, 0);
  for (const Corner& corner : this->Corners)
  {
    for (const Index node : corner.Nodes)
    {
      ++this->AroundStart[node + 1];
    }
  }
  for (std::size_t node = 0; node < mesh.Places.size(); ++node)
  {
    this->AroundStart[node + 1] += this->AroundStart[node];
  }
  this->Around.resize(3 * this->Corners.size());
  std::vector<Index> end(this->AroundStart.begin(), this->AroundStart.end() - 1);
  for (std::size_t c = 0; c < this->Corners.size(); ++c)
  {
    for (const Index node : this->Corners[c].Nodes)
    {
      this->Around[end[node]++] = static_cast<Index>(c);
    }
  }
}

//------------------------------------------------------------------------------
FacingFaces::Term FacingFaces::TermOf(const Corner& corner, Index node,
  const std::vector<Vector3d>& places, const SlidingNodes& sliding) const
{
  const auto [at, next, last] = corner.Nodes;
  const Vector3d normal = sliding.Surface().Walk.Normal(sliding.FootOf(at).Triangle);
  const Vector3d a = (places[next] - places[at]) / corner.Lengths[0];
  const Vector3d b = (places[last] - places[at]) / corner.Lengths[1];
  const Vector3d byA = b.cross(normal) / corner.Lengths[0]; // D's slope as the end of a moves
  const Vector3d byB = normal.cross(a) / corner.Lengths[1];
  return { a.cross(b).dot(normal), node == next ? byA : node == last ? byB : -byA - byB };
}

void FacingFaces::TermsOf(Index node, const std::vector<Vector3d>& places,
  const SlidingNodes& sliding, std::vector<Term>& terms) const
{
  terms.clear();
  for (Index k = this->AroundStart[node]; k < this->AroundStart[node + 1]; ++k)
  {
    terms.push_back(this->TermOf(this->Corners[this->Around[k]], node, places, sliding));
  }
}

double FacingFaces::Energy(const std::vector<Vector3d>& places, const SlidingNodes& sliding) const
{
  double energy = 0.0;
  for (const Corner& corner : this->Corners)
  {
    const double lack =
      this->TermOf(corner, corner.Nodes[0], places, sliding).LackAt(Vector3d::Zero());
    energy += lack * lack;
  }
  return energy;
}
}
