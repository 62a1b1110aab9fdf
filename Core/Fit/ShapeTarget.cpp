// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeTarget.h"

#include "TSpline/Evaluator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trivariate
{
namespace
{
// Of samples on the surface; one inside has one.
constexpr float SurfaceWeight = 25.0f, HeldWeight = 1600.0f;
}

//------------------------------------------------------------------------------
ShapeTarget::ShapeTarget(const BlockComplex& blocks, const ShapeSamples& shape, double margin)
{
  const Index n = static_cast<Index>(shape.Parameters.size() / 3);
  this->Targets.Parameters = shape.Parameters;
  this->Targets.Components = 3;
  for (Index i = 0; i < n; ++i)
  {
    this->Points.emplace_back(Eigen::Map<const Eigen::Vector3d>(&shape.Places[3 * i]));
  }
  for (const Triangle& triangle : shape.Surface)
  {
    std::array<double, 3> middle{};
    for (int a = 0; a < 3; ++a)
    {
      for (const Index corner : triangle)
      {
        middle[a] += shape.Parameters[3 * corner + a];
      }
      // Exact where all three are the same, on the face.
      const double first = shape.Parameters[3 * triangle[0] + a];
      middle[a] = middle[a] == 3.0 * first ? first : middle[a] / 3.0;
    }
    for (const SheetKey& key : this->SheetsAt(blocks, middle.data()))
    {
      Sheet& sheet = this->Sheets[key];
      sheet.Triangles.push_back(triangle);
      sheet.Margin = key.first < 0 ? margin : 0.0;
    }
  }
  for (auto& [key, sheet] : this->Sheets)
  {
    sheet.Tree = std::make_unique<TriangleTree>(this->Points, sheet.Triangles);
  }

  this->Targets.Values.resize(3 * n);
  for (Index i = 0; i < n; ++i)
  {
    const auto keys = this->SheetsAt(blocks, &shape.Parameters[3 * i]);
    this->Targets.Weights.push_back(1.0f);
    if (!keys.empty())
    {
      this->OnSurface.push_back(i);
    }
    const auto sheet = keys.size() == 1 ? this->Sheets.find(keys[0]) : this->Sheets.end();
    this->SheetOf.push_back(sheet == this->Sheets.end() ? nullptr : &sheet->second);
    const Eigen::Vector3d target =
      this->SheetOf[i] ? this->NearestTarget(*this->SheetOf[i], this->Points[i]) : this->Points[i];
    for (int a = 0; a < 3; ++a)
    {
      this->Targets.Values[a * n + i] = target[a];
    }
  }
  this->WeighSurface(SurfaceWeight);
  this->Distances.Rms = this->Distances.Maximum = std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
// The sheets that the surface at a parameter belongs to, each once; none inside.
std::vector<ShapeTarget::SheetKey> ShapeTarget::SheetsAt(
  const BlockComplex& blocks, const double* parameter) const
{
  std::vector<SheetKey> keys;
  for (const Index b : blocks.BlocksAt({ parameter[0], parameter[1], parameter[2] }))
  {
    for (int face = 0; face < 6; ++face)
    {
      const int a = face / 2, side = face % 2;
      const FaceTwin& twin = blocks.Twin({ b, a, side });
      const int own = blocks.Segments[b];
      const int other = twin.Exists() ? blocks.Segments[twin.Face.Block] : -1;
      if (other != own && parameter[a] == blocks.Origins[b][a] + side)
      {
        const SheetKey key = std::minmax(own, other);
        if (std::find(keys.begin(), keys.end(), key) == keys.end())
        {
          keys.push_back(key);
        }
      }
    }
  }
  return keys;
}

//------------------------------------------------------------------------------
Eigen::Vector3d ShapeTarget::NearestTarget(const Sheet& sheet, const Eigen::Vector3d& place) const
{
  const TriangleTree::Foot foot = sheet.Tree->Nearest(place);
  const Triangle& t = sheet.Triangles[foot.Triangle];
  const Eigen::Vector3d &p = this->Points[t[0]], &q = this->Points[t[1]], &r = this->Points[t[2]];
  return foot.Place + sheet.Margin * (q - p).cross(r - p).normalized();
}

//------------------------------------------------------------------------------
void ShapeTarget::WeighSurface(float weight)
{
  for (const Index i : this->OnSurface)
  {
    this->Targets.Weights[i] = weight;
  }
}

//------------------------------------------------------------------------------
void ShapeTarget::Pull(const std::vector<double>& parameters, const std::vector<double>& places)
{
  const Index before = this->Targets.Count(), more = static_cast<Index>(places.size() / 3);
  std::vector<double> values;
  for (int a = 0; a < 3; ++a)
  {
    const auto begin = this->Targets.Values.begin() + a * before;
    values.insert(values.end(), begin, begin + before);
    for (Index i = 0; i < more; ++i)
    {
      values.push_back(places[3 * i + a]);
    }
  }
  this->Targets.Values = std::move(values);
  std::vector<double>& all = this->Targets.Parameters;
  all.insert(all.end(), parameters.begin(), parameters.end());
  this->Targets.Weights.resize(before + more, SurfaceWeight);
  this->SheetOf.resize(before + more, nullptr);
  for (Index i = before; i < before + more; ++i)
  {
    this->OnSurface.push_back(i);
  }
}

//------------------------------------------------------------------------------
void ShapeTarget::Hold()
{
  this->WeighSurface(HeldWeight);
}

//------------------------------------------------------------------------------
void ShapeTarget::Release()
{
  this->WeighSurface(SurfaceWeight);
}

//------------------------------------------------------------------------------
void ShapeTarget::Slide(const TSpline& spline, const BezierMesh& mesh, const Execution& execution)
{
  const Index n = this->Targets.Count();
  const Evaluator evaluator(spline, mesh, { 0, 1, 2 }, execution);
  std::vector<double> places(3 * n);
  EvaluatorOutput output;
  output.Values = places.data();
  evaluator.Evaluate(n, this->Targets.Parameters.data(), output, execution);
  execution.ParallelFor(n,
    [&](Index begin, Index end)
    {
      for (Index i = begin; i < end; ++i)
      {
        if (this->SheetOf[i])
        {
          const Eigen::Vector3d target =
            this->NearestTarget(*this->SheetOf[i], Eigen::Map<Eigen::Vector3d>(&places[3 * i]));
          for (int a = 0; a < 3; ++a)
          {
            this->Targets.Values[a * n + i] = target[a];
          }
        }
      }
    });
  double squares = 0.0, largest = 0.0, count = 0.0;
  for (const Index i : this->OnSurface)
  {
    double square = 0.0;
    for (int a = 0; a < 3; ++a)
    {
      const double d = places[3 * i + a] - this->Targets.Values[a * n + i];
      square += d * d;
    }
    squares += square;
    largest = std::max(largest, square);
    count += 1.0;
  }
  this->Distances = { std::sqrt(squares / count), std::sqrt(largest) };
}
}
