// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BoundaryFit.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
using Eigen::Vector3d;
using Eigen::Vector4d;

constexpr double FarMiddle = 0.25; // in sides of quadrilaterals: middles nearer than that are free
constexpr double SamplesOfQuad = 16.0; // about so many, where there are as many triangles

// The nearest point of a triangle by barycentric coordinates.
Vector3d Barycentric(const Vector3d& p, const Vector3d& a, const Vector3d& b, const Vector3d& c)
{
  const Vector3d place = NearestOfTriangle(p, a, b, c);
  const Vector3d normal = (b - a).cross(c - a);
  const double square = std::max(normal.squaredNorm(), 1e-300);
  Vector3d weights((b - place).cross(c - place).dot(normal) / square,
    (c - place).cross(a - place).dot(normal) / square, 0.0);
  weights = weights.cwiseMax(0.0).cwiseMin(1.0);
  weights[2] = std::max(0.0, 1.0 - weights[0] - weights[1]);
  return weights;
}

// The nearest point of the four triangles between the sides of a quadrilateral and its middle;
// inside: not on a side.
double NearestOfQuad(
  const std::array<Vector3d, 4>& q, const Vector3d& p, Vector4d& weights, bool& inside)
{
  const Vector3d middle = 0.25 * (q[0] + q[1] + q[2] + q[3]);
  double least = std::numeric_limits<double>::infinity();
  for (int side = 0; side < 4; ++side)
  {
    const Vector3d &a = q[side], &b = q[(side + 1) % 4];
    const double distance = (NearestOfTriangle(p, a, b, middle) - p).squaredNorm();
    if (distance < least)
    {
      least = distance;
      const Vector3d of = Barycentric(p, a, b, middle);
      weights.setConstant(0.25 * of[2]);
      weights[side] += of[0];
      weights[(side + 1) % 4] += of[1];
      inside = of[2] > 1e-9;
    }
  }
  return least;
}
}

//------------------------------------------------------------------------------
BoundaryFit::BoundaryFit(const DomainSurface& surface, const BlockMesh& mesh)
  : Surface(&surface)
{
  this->FindQuads(mesh);
  const BlockDomain& domain = surface.Domain;
  const std::size_t triangles = domain.Triangles.size();
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const Triangle& c = domain.Triangles[t];
    const Vector3d &p = domain.SurfacePoints[c[0]], &q = domain.SurfacePoints[c[1]],
                   &r = domain.SurfacePoints[c[2]];
    this->Samples.push_back({ (p + q + r) / 3.0, 0.0, -1 });
  }
  std::vector<TriangleTree> trees;
  std::vector<std::vector<Triangle>> halves(this->Faces.size());
  for (std::size_t patch = 0; patch < this->Faces.size(); ++patch)
  {
    const Index end = patch + 1 < this->FirstQuad.size() ? this->FirstQuad[patch + 1]
                                                         : static_cast<Index>(this->Quads.size());
    for (Index q = this->FirstQuad[patch]; q < end; ++q)
    {
      const std::array<Index, 4>& n = this->Quads[q].Nodes;
      halves[patch].push_back({ n[0], n[1], n[2] });
      halves[patch].push_back({ n[0], n[2], n[3] });
    }
    trees.emplace_back(mesh.Places, halves[patch]);
  }
  for (std::size_t t = 0; t < triangles; ++t)
  {
    const Index patch = domain.PatchOf[t];
    this->Samples[t].Quad =
      this->FirstQuad[patch] + trees[patch].Nearest(this->Samples[t].Place).Triangle / 2;
  }
}

BoundaryFit::BoundaryFit(const BlockMesh& mesh, const BoundaryFit& coarse)
  : Surface(coarse.Surface)
  , Samples(coarse.Samples)
{
  this->FindQuads(mesh);
  for (Sample& sample : this->Samples)
  {
    const Quad& from = coarse.Quads[sample.Quad];
    const Index number = sample.Quad - coarse.FirstQuad[from.Patch];
    const auto [ms, mt] = coarse.Faces[from.Patch].Cells;
    const auto [ns, nt] = this->Faces[from.Patch].Cells;
    const Vector4d& w = sample.Weights;
    const double s = (double(number % ms) + w[1] + w[2]) / ms;
    const double t = (double(number / ms) + w[2] + w[3]) / mt;
    const Index i = std::min(static_cast<int>(s * ns), ns - 1);
    const Index j = std::min(static_cast<int>(t * nt), nt - 1);
    sample.Quad = this->FirstQuad[from.Patch] + i + ns * j;
  }
}

void BoundaryFit::FindQuads(const BlockMesh& mesh)
{
  this->Faces = PatchFaces(this->Surface->Domain, mesh);
  this->AroundStart.assign(mesh.Places.size() + 1, 0);
  for (std::size_t patch = 0; patch < this->Faces.size(); ++patch)
  {
    const PatchFace& face = this->Faces[patch];
    this->FirstQuad.push_back(static_cast<Index>(this->Quads.size()));
    for (int t = 0; t < face.Cells[1]; ++t)
    {
      for (int s = 0; s < face.Cells[0]; ++s)
      {
        Quad quad;
        quad.Nodes = { face.NodeAt(s, t), face.NodeAt(s + 1, t), face.NodeAt(s + 1, t + 1),
          face.NodeAt(s, t + 1) };
        quad.Patch = static_cast<Index>(patch);
        for (const Index node : quad.Nodes)
        {
          ++this->AroundStart[node + 1];
        }
        this->Quads.push_back(quad);
      }
    }
    for (const Index t : this->Surface->Domain.Patches[patch].Triangles)
    {
      this->Area += this->TriangleArea(t);
    }
  }
  for (std::size_t node = 0; node < mesh.Places.size(); ++node)
  {
    this->AroundStart[node + 1] += this->AroundStart[node];
  }
  this->Middles.resize(this->Quads.size());
  this->Feet.resize(this->Quads.size());
  this->Around.resize(4 * this->Quads.size());
  std::vector<Index> end(this->AroundStart.begin(), this->AroundStart.end() - 1);
  for (std::size_t q = 0; q < this->Quads.size(); ++q)
  {
    for (const Index node : this->Quads[q].Nodes)
    {
      this->Around[end[node]++] = static_cast<Index>(q);
    }
  }
}

//------------------------------------------------------------------------------
void BoundaryFit::AssignSample(Sample& sample, const std::vector<Vector3d>& places) const
{
  const auto cornersOf = [&](Index quad) -> std::array<Vector3d, 4>
  {
    const std::array<Index, 4>& n = this->Quads[quad].Nodes;
    return { places[n[0]], places[n[1]], places[n[2]], places[n[3]] };
  };
  const auto pieceOf = [this](Index quad)
  { return this->Surface->PieceOfPatch(this->Quads[quad].Patch); };
  bool inside = false;
  double least = NearestOfQuad(cornersOf(sample.Quad), sample.Place, sample.Weights, inside);
  const Index piece = pieceOf(sample.Quad);
  for (Index at = -1; at != sample.Quad && !inside;)
  {
    at = sample.Quad;
    for (const Index node : this->Quads[at].Nodes)
    {
      for (Index k = this->AroundStart[node]; k < this->AroundStart[node + 1]; ++k)
      {
        const Index quad = this->Around[k];
        if (quad == at || pieceOf(quad) != piece)
        {
          continue;
        }
        Vector4d weights;
        bool within = false;
        const double distance = NearestOfQuad(cornersOf(quad), sample.Place, weights, within);
        if (distance < least)
        {
          least = distance;
          inside = within;
          sample.Quad = quad;
          sample.Weights = weights;
        }
      }
    }
  }
  const std::array<Vector3d, 4> q = cornersOf(sample.Quad);
  const Vector3d normal = (q[2] - q[0]).cross(q[3] - q[1]);
  Vector3d way = sample.Place;
  for (int i = 0; i < 4; ++i)
  {
    way -= sample.Weights[i] * q[i];
  }
  const double length = way.norm();
  sample.Direction = inside || length < 1e-6 * std::sqrt(normal.norm()) ? normal : way;
  sample.Direction.normalize();
}

void BoundaryFit::AssignMiddle(Index quad, const std::vector<Vector3d>& places)
{
  const std::array<Index, 4>& n = this->Quads[quad].Nodes;
  Vector3d middle = Vector3d::Zero();
  for (const Index node : n)
  {
    middle += 0.25 * places[node];
  }
  SurfaceFoot& foot = this->Feet[quad];
  foot = foot.Triangle >= 0 ? this->Surface->Walk.Nearest(foot.Triangle, middle)
                            : this->Surface->NearestOnPatch(this->Quads[quad].Patch, middle);
  const double side = std::sqrt(this->Area / double(this->Quads.size()));
  const bool counts = (foot.Place - middle).norm() > FarMiddle * side;
  this->Middles[quad] = { foot.Place, counts ? 1.0 / (side * side) : 0.0, quad,
    Vector4d::Constant(0.25), this->Surface->Walk.Normal(foot.Triangle) };
}

void BoundaryFit::Assign(const std::vector<Vector3d>& places, const Execution& execution)
{
  // As many samples as quadrilaterals can use, in turn.
  const auto step = static_cast<Index>(
    std::max(1.0, double(this->Samples.size()) / (SamplesOfQuad * double(this->Quads.size()))));
  const Index count = static_cast<Index>(this->Samples.size()) / step;
  const double scale =
    std::pow(double(this->Quads.size()) / this->Area, 2) * static_cast<double>(step);
  execution.ParallelFor(count,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        this->AssignSample(this->Samples[i * step], places);
        this->Samples[i * step].Area = scale * this->TriangleArea(i * step);
      }
    });
  execution.ParallelFor(static_cast<Index>(this->Quads.size()),
    [&](Index begin, Index end)
    {
      for (Index quad = begin; quad < end; ++quad)
      {
        this->AssignMiddle(quad, places);
      }
    });
  this->TakenStart.assign(this->Quads.size() + 1, 0);
  for (Index i = 0; i < count; ++i)
  {
    ++this->TakenStart[this->Samples[i * step].Quad + 1];
  }
  for (std::size_t q = 0; q < this->Quads.size(); ++q)
  {
    this->TakenStart[q + 1] += this->TakenStart[q];
  }
  this->Taken.resize(count);
  std::vector<Index> end(this->TakenStart.begin(), this->TakenStart.end() - 1);
  for (Index i = 0; i < count; ++i)
  {
    this->Taken[end[this->Samples[i * step].Quad]++] = i * step;
  }
}

double BoundaryFit::TriangleArea(Index t) const
{
  const Triangle& c = this->Surface->Domain.Triangles[t];
  const std::vector<Vector3d>& points = this->Surface->Domain.SurfacePoints;
  return 0.5 * (points[c[1]] - points[c[0]]).cross(points[c[2]] - points[c[0]]).norm();
}

double BoundaryFit::Residual(const Sample& sample, const std::vector<Vector3d>& places) const
{
  double residual = sample.Direction.dot(sample.Place);
  for (int i = 0; i < 4; ++i)
  {
    residual -= sample.Weights[i] * sample.Direction.dot(places[this->Quads[sample.Quad].Nodes[i]]);
  }
  return residual;
}

BoundaryFit::Term BoundaryFit::TermOf(Index node, const std::vector<Vector3d>& places) const
{
  Term term;
  for (Index k = this->AroundStart[node]; k < this->AroundStart[node + 1]; ++k)
  {
    const Index quad = this->Around[k];
    const std::array<Index, 4>& nodes = this->Quads[quad].Nodes;
    const auto at = std::find(nodes.begin(), nodes.end(), node) - nodes.begin();
    const auto add = [&](const Sample& sample)
    {
      const double weight = sample.Weights[at];
      const double residual = this->Residual(sample, places);
      term.Curve += sample.Area * weight * weight * sample.Direction * sample.Direction.transpose();
      term.Slope -= 2.0 * sample.Area * weight * residual * sample.Direction;
    };
    for (Index i = this->TakenStart[quad]; i < this->TakenStart[quad + 1]; ++i)
    {
      add(this->Samples[this->Taken[i]]);
    }
    add(this->Middles[quad]);
  }
  return term;
}

double BoundaryFit::Energy(const std::vector<Vector3d>& places) const
{
  const auto of = [&](const Sample& sample)
  {
    const double residual = this->Residual(sample, places);
    return sample.Area * residual * residual;
  };
  double energy = 0.0;
  for (const Index i : this->Taken)
  {
    energy += of(this->Samples[i]);
  }
  for (const Sample& middle : this->Middles)
  {
    energy += of(middle);
  }
  return energy;
}
}
