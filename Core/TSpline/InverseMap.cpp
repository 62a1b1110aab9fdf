// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "InverseMap.h"

#include "BezierExtraction.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Vector = std::array<double, 3>;

constexpr double BestResidual = 1e-15; // as shares of the size of the geometry
constexpr double AffineTolerance = 1e-12;

double Length(const Vector& x)
{
  return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]);
}

constexpr double Infinity = std::numeric_limits<double>::infinity();

// Widens the box [low, high] to enclose another one.
void Enclose(const Vector& otherLow, const Vector& otherHigh, Vector& low, Vector& high)
{
  for (int a = 0; a < 3; ++a)
  {
    low[a] = std::min(low[a], otherLow[a]);
    high[a] = std::max(high[a], otherHigh[a]);
  }
}

// Solves m x = b for a 3 x 3 matrix given row by row; false when it is singular to rounding.
bool Solve(const std::array<double, 9>& m, const Vector& b, Vector& x)
{
  const Vector rows[3] = { { m[0], m[1], m[2] }, { m[3], m[4], m[5] }, { m[6], m[7], m[8] } };
  const auto cross = [](const Vector& p, const Vector& q)
  {
    return Vector{ p[1] * q[2] - p[2] * q[1], p[2] * q[0] - p[0] * q[2],
      p[0] * q[1] - p[1] * q[0] };
  };
  const Vector columns[3] = { cross(rows[1], rows[2]), cross(rows[2], rows[0]),
    cross(rows[0], rows[1]) };
  const double determinant = JacobianDeterminant(m.data());
  const double scale = Length(rows[0]) * Length(rows[1]) * Length(rows[2]);
  if (!(std::abs(determinant) > 1e-14 * scale))
  {
    return false;
  }
  for (int a = 0; a < 3; ++a)
  {
    x[a] = (columns[0][a] * b[0] + columns[1][a] * b[1] + columns[2][a] * b[2]) / determinant;
  }
  return true;
}
}

//------------------------------------------------------------------------------
InverseMap::InverseMap(const TSpline& spline, const BezierMesh& mesh, const Execution& execution)
  : Cells(&mesh)
{
  if (mesh.Size() == 0)
  {
    throw std::invalid_argument("A T-spline without blending functions has no inverse map.");
  }
  Vector low, high;
  low.fill(Infinity);
  high.fill(-Infinity);
  for (Index i = 0; i < spline.Size(); ++i)
  {
    const double* p = spline.ControlPoint(i);
    const Vector x = { p[0], p[1], p[2] };
    Enclose(x, x, low, high);
  }
  this->Size = Length({ high[0] - low[0], high[1] - low[1], high[2] - low[2] });
  this->IsAffine = this->DetectAffine(spline, execution.Part(0.0, 0.4));
  if (this->IsAffine)
  {
    return;
  }
  this->Geometry.emplace(spline, mesh, std::vector<int>{ 0, 1, 2 }, execution.Part(0.4, 0.9));
  std::vector<Node> leaves = this->MakeLeaves();
  this->Tree.reserve(2 * leaves.size());
  this->BuildTree(leaves, 0, leaves.size());
}

//------------------------------------------------------------------------------
std::vector<InverseMap::Node> InverseMap::MakeLeaves() const
{
  std::vector<Node> leaves(this->Cells->Size());
  for (Index cell = 0; cell < this->Cells->Size(); ++cell)
  {
    Node& leaf = leaves[cell];
    leaf.Low.fill(Infinity);
    leaf.High.fill(-Infinity);
    leaf.Children = { -1 - static_cast<std::int32_t>(cell), -1 };
    const double* c = this->Geometry->Coefficients(cell);
    for (int n = 0; n < 64; ++n)
    {
      const double weight = this->Geometry->Rational() ? c[3 * 64 + n] : 1.0;
      if (weight > 0.0)
      {
        const Vector x = { c[n] / weight, c[64 + n] / weight, c[128 + n] / weight };
        Enclose(x, x, leaf.Low, leaf.High);
      }
    }
  }
  return leaves;
}

//------------------------------------------------------------------------------
// Halves the leaves along the longest side of the box of their middles; returns the node's place.
std::int32_t InverseMap::BuildTree(std::vector<Node>& leaves, std::size_t first, std::size_t last)
{
  const auto place = static_cast<std::int32_t>(this->Tree.size());
  this->Tree.push_back(leaves[first]);
  if (last - first == 1)
  {
    return place;
  }
  Node node = leaves[first];
  Vector low, high; // of the middles, doubled
  low.fill(Infinity);
  high.fill(-Infinity);
  for (std::size_t i = first; i < last; ++i)
  {
    const Node& leaf = leaves[i];
    Enclose(leaf.Low, leaf.High, node.Low, node.High);
    const Vector middle = { leaf.Low[0] + leaf.High[0], leaf.Low[1] + leaf.High[1],
      leaf.Low[2] + leaf.High[2] };
    Enclose(middle, middle, low, high);
  }
  int axis = 0;
  for (int a = 1; a < 3; ++a)
  {
    axis = high[a] - low[a] > high[axis] - low[axis] ? a : axis;
  }
  const std::size_t middle = first + (last - first) / 2;
  std::nth_element(leaves.begin() + first, leaves.begin() + middle, leaves.begin() + last,
    [axis](const Node& x, const Node& y)
    {
      const double p = x.Low[axis] + x.High[axis], q = y.Low[axis] + y.High[axis];
      return p < q || (p == q && x.Children[0] > y.Children[0]);
    });
  node.Children = { this->BuildTree(leaves, first, middle), 0 };
  node.Children[1] = this->BuildTree(leaves, middle, last);
  this->Tree[place] = node;
  return place;
}

//------------------------------------------------------------------------------
// The affine map through the corners of the largest cell is compared with all cells' control
// points: they lie at thirds of their cells if and only if the geometry is affine.
bool InverseMap::DetectAffine(const TSpline& spline, const Execution& execution)
{
  const std::vector<int> columns = { 0, 1, 2, Denominator };
  const Index count = this->Cells->Size();
  const auto volume = [this](Index cell)
  {
    const auto b = this->Cells->Bounds(cell);
    return (b[1] - b[0]) * (b[3] - b[2]) * (b[5] - b[4]);
  };
  Index largest = 0;
  for (Index cell = 1; cell < count; ++cell)
  {
    largest = volume(cell) > volume(largest) ? cell : largest;
  }
  this->SetAffine(ExtractBezier(spline, *this->Cells, columns, largest, largest + 1).data(),
    this->Cells->Bounds(largest));
  Vector ignored;
  if (!Solve(this->AffineMatrix, { 0.0, 0.0, 0.0 }, ignored))
  {
    return false;
  }
  constexpr Index Batch = 1 << 14;
  for (Index first = 0; first < count; first += Batch)
  {
    const Index last = std::min(first + Batch, count);
    const auto bezier = ExtractBezier(spline, *this->Cells, columns, first, last,
      execution.Part(1.0 * first / count, 1.0 * last / count));
    for (Index cell = first; cell < last; ++cell)
    {
      if (!this->IsAffineCell(&bezier[256 * (cell - first)], this->Cells->Bounds(cell)))
      {
        return false;
      }
    }
  }
  return true;
}

//------------------------------------------------------------------------------
// The affine map through four corners of a cell; the identity if it is that to rounding.
void InverseMap::SetAffine(const double* bezier, const std::array<double, 6>& bounds)
{
  constexpr int Corner[3] = { 3, 12, 48 }; // the control points at the far ends of the edges
  double offIdentity = 0.0;
  for (int a = 0; a < 3; ++a)
  {
    const double* c = bezier + 64 * a;
    this->AffineOrigin[a] = c[0];
    for (int b = 0; b < 3; ++b)
    {
      double& m = this->AffineMatrix[3 * a + b];
      m = (c[Corner[b]] - c[0]) / (bounds[2 * b + 1] - bounds[2 * b]);
      this->AffineOrigin[a] -= m * bounds[2 * b];
      offIdentity = std::max(offIdentity, std::abs(m - (a == b ? 1.0 : 0.0)));
    }
    offIdentity = std::max(offIdentity, std::abs(this->AffineOrigin[a]) / this->Size);
  }
  if (offIdentity <= AffineTolerance)
  {
    this->AffineOrigin = {};
    this->AffineMatrix = { 1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0 };
  }
}

//------------------------------------------------------------------------------
// Whether a cell's 64 x (X, Y, Z, denominator) are those of the affine map.
bool InverseMap::IsAffineCell(const double* bezier, const std::array<double, 6>& bounds) const
{
  for (int n = 0; n < 64; ++n)
  {
    const int third[3] = { n % 4, n / 4 % 4, n / 16 };
    Vector u;
    for (int a = 0; a < 3; ++a)
    {
      u[a] = bounds[2 * a] + (bounds[2 * a + 1] - bounds[2 * a]) * third[a] / 3.0;
    }
    const Vector x = this->AffineImage(u);
    for (int a = 0; a < 3; ++a)
    {
      if (!(std::abs(bezier[64 * a + n] - x[a]) <= AffineTolerance * this->Size))
      {
        return false;
      }
    }
    if (!(std::abs(bezier[192 + n] - 1.0) <= AffineTolerance))
    {
      return false;
    }
  }
  return true;
}

//------------------------------------------------------------------------------
InverseMap::Vector InverseMap::AffineImage(const Vector& parameters) const
{
  Vector x = this->AffineOrigin;
  for (int a = 0; a < 3; ++a)
  {
    for (int b = 0; b < 3; ++b)
    {
      x[a] += this->AffineMatrix[3 * a + b] * parameters[b];
    }
  }
  return x;
}

//------------------------------------------------------------------------------
// A point may be outside by rounding: it is moved into the domain, and the move measured in space.
bool InverseMap::FindAffine(const Vector& point, Vector& parameters) const
{
  Vector offset;
  for (int a = 0; a < 3; ++a)
  {
    offset[a] = point[a] - this->AffineOrigin[a];
  }
  Solve(this->AffineMatrix, offset, parameters);
  this->ClampToDomain(parameters);
  Vector image = this->AffineImage(parameters);
  for (int a = 0; a < 3; ++a)
  {
    image[a] -= point[a];
  }
  return Length(image) <= AcceptedResidual * this->Size &&
         this->Cells->FindCell(parameters[0], parameters[1], parameters[2]) >= 0;
}

//------------------------------------------------------------------------------
void InverseMap::ClampToDomain(Vector& parameters) const
{
  for (int a = 0; a < 3; ++a)
  {
    const KnotLine& line = this->Cells->KnotLines()[a];
    parameters[a] = std::clamp(parameters[a], line.front(), line.back());
  }
}

//------------------------------------------------------------------------------
// Fills in all of the place but its parameters; false outside the domain.
bool InverseMap::Evaluate(const Vector& point, Place& place) const
{
  EvaluatorOutput output;
  output.Values = place.Residual.data();
  output.Gradients = place.Jacobian.data();
  if (!this->Geometry->Evaluate(place.Parameters.data(), output))
  {
    return false;
  }
  for (int a = 0; a < 3; ++a)
  {
    place.Residual[a] -= point[a];
  }
  place.Distance = Length(place.Residual);
  return true;
}

//------------------------------------------------------------------------------
// Newton's iteration with steps halved until they come closer. Parameters may wander through the
// whole domain: the map is smooth across cells. Gives up where it is slow, as it is outside.
bool InverseMap::Newton(const Vector& point, Vector& parameters) const
{
  constexpr int MaximumSteps = 50, MaximumHalvings = 8, MaximumSlowSteps = 4;
  Place here;
  here.Parameters = parameters;
  if (!this->Evaluate(point, here))
  {
    return false;
  }
  int slow = 0;
  for (int step = 0;
       step < MaximumSteps && slow < MaximumSlowSteps && here.Distance > BestResidual * this->Size;
       ++step)
  {
    Vector move;
    if (!Solve(here.Jacobian, here.Residual, move))
    {
      break;
    }
    // Close enough, only full steps are worth their while.
    const int halvings = here.Distance <= AcceptedResidual * this->Size ? 1 : MaximumHalvings;
    Place there;
    bool closer = false;
    double damping = 1.0;
    for (int halving = 0; halving < halvings && !closer; ++halving, damping *= 0.5)
    {
      for (int a = 0; a < 3; ++a)
      {
        there.Parameters[a] = here.Parameters[a] - damping * move[a];
      }
      this->ClampToDomain(there.Parameters);
      closer = this->Evaluate(point, there) && there.Distance < here.Distance;
    }
    if (!closer)
    {
      break;
    }
    slow += there.Distance > 0.9 * here.Distance;
    here = there;
  }
  parameters = here.Parameters;
  return here.Distance <= AcceptedResidual * this->Size;
}

//------------------------------------------------------------------------------
// Tries startsAnAxis^3 starts in each cell below the node whose box holds the point.
bool InverseMap::FindBelow(
  std::int32_t node, const Vector& point, int startsAnAxis, Vector& parameters) const
{
  const Node& here = this->Tree[node];
  const double margin = AcceptedResidual * this->Size;
  for (int a = 0; a < 3; ++a)
  {
    if (!(point[a] >= here.Low[a] - margin && point[a] <= here.High[a] + margin))
    {
      return false;
    }
  }
  if (here.Children[0] >= 0)
  {
    return this->FindBelow(here.Children[0], point, startsAnAxis, parameters) ||
           this->FindBelow(here.Children[1], point, startsAnAxis, parameters);
  }
  const auto b = this->Cells->Bounds(-1 - here.Children[0]);
  const auto start = [&](int a, int i)
  { return b[2 * a] + (b[2 * a + 1] - b[2 * a]) * (i + 0.5) / startsAnAxis; };
  for (int k = 0; k < startsAnAxis; ++k)
  {
    for (int j = 0; j < startsAnAxis; ++j)
    {
      for (int i = 0; i < startsAnAxis; ++i)
      {
        parameters = { start(0, i), start(1, j), start(2, k) };
        if (this->Newton(point, parameters))
        {
          return true;
        }
      }
    }
  }
  return false;
}

//------------------------------------------------------------------------------
bool InverseMap::Find(const double point[3], double parameters[3]) const
{
  const Vector x = { point[0], point[1], point[2] };
  Vector found;
  const bool exists = this->IsAffine
                        ? this->FindAffine(x, found)
                        : this->FindBelow(0, x, 1, found) || this->FindBelow(0, x, 2, found);
  if (exists)
  {
    std::copy(found.begin(), found.end(), parameters);
  }
  return exists;
}

//------------------------------------------------------------------------------
void InverseMap::Find(Index n, const double* points, double* parameters, std::uint8_t* found,
  const Execution& execution, double reach) const
{
  constexpr Index Batch = 1 << 15; // points between two looks at the abort flag
  for (Index first = 0; first < n; first += Batch)
  {
    execution.Check(static_cast<double>(first) / n);
    execution.ParallelFor(std::min(Batch, n - first),
      [&](Index begin, Index end)
      {
        for (Index i = first + begin; i < first + end; ++i)
        {
          std::fill_n(parameters + 3 * i, 3, 0.0);
          found[i] = reach > 0.0 ? this->FindNearest(points + 3 * i, reach, parameters + 3 * i)
                                 : this->Find(points + 3 * i, parameters + 3 * i);
        }
      });
  }
}
}
