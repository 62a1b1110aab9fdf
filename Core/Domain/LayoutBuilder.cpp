// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutBuilder.h"

#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
constexpr int Rounds = 3;
constexpr double Worthwhile = 0.999; // of the present length
constexpr Index MostCuts = 10;       // times the triangles given, and
constexpr Index CutsPerBorder = 50;

// The next point along a marked border, not the one that it comes from.
Index Follow(const LayoutMesh& mesh, Index border, Index from, Index point)
{
  const Index first = mesh.TriangleAt(point);
  Index t = first;
  do
  {
    const int corner = mesh.CornerOf(t, point);
    const Index next = mesh.Triangles[t][(corner + 1) % 3];
    if (mesh.Mark(t, corner) == border && next != from)
    {
      return next;
    }
    t = mesh.Anticlockwise(t, point);
  } while (t != first);
  throw std::logic_error("Border " + std::to_string(border) + " is interrupted.");
}

void MarkAll(LayoutMesh& mesh, const std::vector<Index>& points, Index mark)
{
  for (std::size_t i = 0; i + 1 < points.size(); ++i)
  {
    const Index t = mesh.TriangleLeftOf(points[i], points[i + 1]);
    mesh.SetMark(t, mesh.CornerOf(t, points[i]), mark);
    if (i > 0)
    {
      mesh.Occupied[points[i]] = mark >= 0;
    }
  }
}
}

//------------------------------------------------------------------------------
bool LayoutBuilder::IsShredded() const
{
  const Index borders = static_cast<Index>(this->Borders.size());
  return this->Mesh.NumberOfTriangles() > MostCuts * (this->Given + CutsPerBorder * borders);
}

//------------------------------------------------------------------------------
std::vector<Index> LayoutBuilder::PointsOf(Index border) const
{
  const Index end = this->Corners[this->Borders[border].Corners[1]];
  std::vector<Index> points(1, this->Corners[this->Borders[border].Corners[0]]);
  for (Index from = -1; points.back() != end;)
  {
    const Index next = Follow(this->Mesh, border, from, points.back());
    from = points.back();
    points.push_back(next);
  }
  return points;
}

//------------------------------------------------------------------------------
// Returns the border's length. Its first stretch may be of another length than the others.
double LayoutBuilder::StraightenBorder(Index border, double first, double stretch)
{
  const std::vector<Index> points = this->PointsOf(border);
  double length = 0.0;
  for (std::size_t begin = 0; begin + 1 < points.size();)
  {
    const double longest = begin == 0 ? first : stretch;
    std::vector<Index> part(points.begin() + begin, points.begin() + begin + 2);
    double run = PolylineLength(this->Mesh, part);
    for (std::size_t next = begin + 2; next < points.size(); ++next)
    {
      run += PolylineLength(this->Mesh, { points[next - 1], points[next] });
      if (run > longest)
      {
        break;
      }
      part.push_back(points[next]);
    }
    begin += part.size() - 1;
    length += this->StraightenStretch(border, part);
  }
  return length;
}

//------------------------------------------------------------------------------
// Returns the length of what runs between the same ends now.
double LayoutBuilder::StraightenStretch(Index border, const std::vector<Index>& points)
{
  const double length = PolylineLength(this->Mesh, points);
  const Index from = points.front(), to = points.back();
  MarkAll(this->Mesh, points, -1);
  const PathEnd start = SectorWith(this->Mesh, from, this->Mesh.TriangleLeftOf(from, points[1]));
  const PathEnd end =
    SectorWith(this->Mesh, to, this->Mesh.TriangleLeftOf(to, points[points.size() - 2]));
  const std::vector<Index> path = TracePath(this->Mesh, start, end, border, Worthwhile * length);
  if (path.empty())
  {
    MarkAll(this->Mesh, points, border);
    return length;
  }
  return PolylineLength(this->Mesh, path);
}

//------------------------------------------------------------------------------
// Returns the border's length.
double LayoutBuilder::TightenBorder(Index border)
{
  const std::vector<Index> points = this->PointsOf(border);
  const double length = PolylineLength(this->Mesh, points);
  MarkAll(this->Mesh, points, -1);
  const std::vector<Index> path = TightenPath(this->Mesh, points, border, Worthwhile * length);
  if (path.empty())
  {
    MarkAll(this->Mesh, points, border);
    return length;
  }
  return PolylineLength(this->Mesh, path);
}

//------------------------------------------------------------------------------
// `straighten` takes a border and a round, and returns the border's length then.
template <typename Border>
void LayoutBuilder::InRounds(const Border& straighten, const Execution& execution)
{
  double before = std::numeric_limits<double>::infinity();
  for (int round = 0; round < Rounds; ++round)
  {
    double length = 0.0;
    for (std::size_t border = 0; border < this->Borders.size(); ++border)
    {
      execution.Check((round + double(border) / double(this->Borders.size())) / Rounds);
      if (this->IsShredded())
      {
        return;
      }
      if (this->Fixed.count(static_cast<Index>(border)) == 0)
      {
        length += straighten(static_cast<Index>(border), round);
      }
    }
    if (length >= Worthwhile * before)
    {
      return;
    }
    before = length;
  }
}

//------------------------------------------------------------------------------
void LayoutBuilder::Straighten(double stretch, const Execution& execution)
{
  // Each second round straightens across the ends of the stretches of the round before.
  this->InRounds([this, stretch](Index border, int round)
    { return this->StraightenBorder(border, round % 2 ? 0.5 * stretch : stretch, stretch); },
    execution);
}

//------------------------------------------------------------------------------
void LayoutBuilder::Tighten(const Execution& execution)
{
  this->InRounds([this](Index border, int) { return this->TightenBorder(border); }, execution);
}

//------------------------------------------------------------------------------
SurfaceLayout LayoutBuilder::Result() const
{
  SurfaceLayout layout{ this->Mesh.Points, this->Mesh.Triangles, this->Mesh.Origins,
    std::vector<Index>(this->Mesh.Triangles.size(), -1), this->PatchLabels, this->Corners,
    this->Borders };
  std::vector<Index> waiting;
  const auto claim = [&layout, &waiting](Index t, Index patch)
  {
    if (layout.Patches[t] >= 0 && layout.Patches[t] != patch)
    {
      throw std::runtime_error("Patches " + std::to_string(layout.Patches[t]) + " and " +
                               std::to_string(patch) + " are not separated by borders.");
    }
    if (layout.Patches[t] < 0)
    {
      layout.Patches[t] = patch;
      waiting.push_back(t);
    }
  };
  for (std::size_t b = 0; b < this->Borders.size(); ++b)
  {
    LayoutBorder& border = layout.Borders[b];
    border.Points = this->PointsOf(static_cast<Index>(b));
    for (std::size_t i = 0; i + 1 < border.Points.size(); ++i)
    {
      claim(this->Mesh.TriangleLeftOf(border.Points[i], border.Points[i + 1]), border.Patches[0]);
      claim(this->Mesh.TriangleLeftOf(border.Points[i + 1], border.Points[i]), border.Patches[1]);
    }
  }
  while (!waiting.empty())
  {
    const Index t = waiting.back();
    waiting.pop_back();
    for (int k = 0; k < 3; ++k)
    {
      if (this->Mesh.Mark(t, k) < 0)
      {
        claim(this->Mesh.Neighbour(t, k), layout.Patches[t]);
      }
    }
  }
  return layout;
}
}
