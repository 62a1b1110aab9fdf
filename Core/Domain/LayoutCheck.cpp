// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutCheck.h"

#include <algorithm>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Messages = std::vector<std::string>;

// Twice V - E + F of each patch, and the number of its connected pieces.
void CheckDiscs(const SurfaceLayout& layout, const SurfaceMesh& mesh, Messages& messages)
{
  const std::size_t count = layout.PatchLabels.size();
  std::vector<Index> doubled(count, 0), pieces(count, 0), waiting;
  std::vector<char> reached(layout.Triangles.size(), 0);
  for (Index seed = 0; seed < mesh.NumberOfTriangles(); ++seed)
  {
    const Index patch = layout.Patches[seed];
    doubled[patch] += 2;
    for (int k = 0; k < 3; ++k)
    {
      doubled[patch] -= layout.Patches[mesh.Neighbour(seed, k)] == patch ? 1 : 2;
    }
    if (reached[seed])
    {
      continue;
    }
    ++pieces[patch];
    reached[seed] = 1;
    waiting.push_back(seed);
    while (!waiting.empty())
    {
      const Index t = waiting.back();
      waiting.pop_back();
      for (int k = 0; k < 3; ++k)
      {
        const Index next = mesh.Neighbour(t, k);
        if (!reached[next] && layout.Patches[next] == patch)
        {
          reached[next] = 1;
          waiting.push_back(next);
        }
      }
    }
  }
  for (Index p = 0; p < mesh.NumberOfPoints(); ++p)
  {
    // A point counts once for each run of a patch around it.
    bool inside = mesh.FanBegin(p) != mesh.FanEnd(p);
    for (const Index* t = mesh.FanBegin(p); t != mesh.FanEnd(p); ++t)
    {
      const Index before = layout.Patches[t == mesh.FanBegin(p) ? mesh.FanEnd(p)[-1] : t[-1]];
      if (before != layout.Patches[*t])
      {
        doubled[layout.Patches[*t]] += 2;
        inside = false;
      }
    }
    if (inside)
    {
      doubled[layout.Patches[*mesh.FanBegin(p)]] += 2;
    }
  }
  for (std::size_t patch = 0; patch < count; ++patch)
  {
    if (pieces[patch] != 1 || doubled[patch] != 2)
    {
      messages.push_back("Patch " + std::to_string(patch) + " is not a disc: it has " +
                         std::to_string(pieces[patch]) + " pieces and Euler characteristic " +
                         std::to_string(doubled[patch] / 2) + ".");
    }
  }
}

// The triangle on the left of an edge from p to q, or -1.
Index LeftOf(const SurfaceMesh& mesh, Index p, Index q)
{
  const auto found = std::find_if(mesh.FanBegin(p), mesh.FanEnd(p),
    [&](Index t) { return mesh.Triangles[t][(mesh.CornerOf(t, p) + 1) % 3] == q; });
  return found == mesh.FanEnd(p) ? -1 : *found;
}

void CheckBorders(const SurfaceLayout& layout, const SurfaceMesh& mesh, Messages& messages)
{
  std::vector<Index> owner(layout.Points.size(), -1); // of a point: -2 - corner, or its border
  for (std::size_t c = 0; c < layout.Corners.size(); ++c)
  {
    if (owner[layout.Corners[c]] != -1)
    {
      messages.push_back("Corners " + std::to_string(-2 - owner[layout.Corners[c]]) + " and " +
                         std::to_string(c) + " are at one point.");
    }
    owner[layout.Corners[c]] = -2 - static_cast<Index>(c);
  }
  Index borderSides = 0;
  for (std::size_t b = 0; b < layout.Borders.size(); ++b)
  {
    const LayoutBorder& border = layout.Borders[b];
    const std::string name = "Border " + std::to_string(b);
    const std::vector<Index>& points = border.Points;
    if (points.size() < 2 || points.front() != layout.Corners[border.Corners[0]] ||
        points.back() != layout.Corners[border.Corners[1]])
    {
      messages.push_back(name + " does not run between its corners " +
                         std::to_string(border.Corners[0]) + " and " +
                         std::to_string(border.Corners[1]) + ".");
      continue;
    }
    for (std::size_t i = 1; i + 1 < points.size(); ++i)
    {
      if (owner[points[i]] != -1)
      {
        messages.push_back(
          name + " touches " +
          (owner[points[i]] >= 0 ? "border " + std::to_string(owner[points[i]])
                                 : "corner " + std::to_string(-2 - owner[points[i]])) +
          " at point " + std::to_string(points[i]) + ".");
      }
      owner[points[i]] = static_cast<Index>(b);
    }
    borderSides += 2 * (static_cast<Index>(points.size()) - 1);
    for (std::size_t i = 0; i + 1 < points.size(); ++i)
    {
      const Index left = LeftOf(mesh, points[i], points[i + 1]);
      const Index right = LeftOf(mesh, points[i + 1], points[i]);
      if (left < 0 || right < 0 || layout.Patches[left] != border.Patches[0] ||
          layout.Patches[right] != border.Patches[1])
      {
        messages.push_back(name + " does not run between its patches " +
                           std::to_string(border.Patches[0]) + " and " +
                           std::to_string(border.Patches[1]) + " at point " +
                           std::to_string(points[i]) + ".");
        break;
      }
    }
  }
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    for (int k = 0; k < 3; ++k)
    {
      borderSides -= layout.Patches[t] != layout.Patches[mesh.Neighbour(t, k)];
    }
  }
  if (borderSides != 0)
  {
    messages.push_back("Patches meet at edges that belong to no border, or borders run within "
                       "patches.");
  }
}

// The corner that follows each corner of a patch along its outline, anticlockwise.
std::vector<Index> Outline(const SurfaceLayout& layout, Index patch, Index start)
{
  std::vector<Index> outline(1, start);
  while (outline.size() <= layout.Corners.size())
  {
    Index next = -1;
    for (const LayoutBorder& border : layout.Borders)
    {
      for (const int end : { 0, 1 })
      {
        if (border.Patches[end] == patch && border.Corners[end] == outline.back())
        {
          next = border.Corners[1 - end];
        }
      }
    }
    if (next < 0 || next == start)
    {
      break;
    }
    outline.push_back(next);
  }
  return outline;
}
}

//------------------------------------------------------------------------------
Messages CheckPatches(const SurfaceLayout& layout)
{
  Messages messages;
  const Index count = static_cast<Index>(layout.PatchLabels.size());
  if (layout.Patches.size() != layout.Triangles.size())
  {
    messages.push_back("Not every triangle has a patch.");
    return messages;
  }
  for (std::size_t t = 0; t < layout.Patches.size(); ++t)
  {
    if (layout.Patches[t] < 0 || layout.Patches[t] >= count)
    {
      messages.push_back("Triangle " + std::to_string(t) + " belongs to no patch.");
      return messages;
    }
  }
  try
  {
    const SurfaceMesh mesh(layout.Points, layout.Triangles);
    CheckDiscs(layout, mesh, messages);
    CheckBorders(layout, mesh, messages);
  }
  catch (const std::invalid_argument& error)
  {
    messages.push_back(error.what());
  }
  return messages;
}

//------------------------------------------------------------------------------
Messages CheckLayout(const SurfaceLayout& layout, const Polycube& polycube)
{
  Messages messages = CheckPatches(layout);
  const auto compare = [&messages](const char* what, std::size_t has, std::size_t needed)
  {
    if (has != needed)
    {
      messages.push_back("The layout has " + std::to_string(has) + " " + what +
                         ", its polycube needs " + std::to_string(needed) + ".");
    }
  };
  compare("corners", layout.Corners.size(), polycube.NumberOfCorners);
  compare("patches", layout.PatchLabels.size(), polycube.Faces.size());
  compare("borders", layout.Borders.size(), polycube.Edges.size());
  if (!messages.empty())
  {
    return messages;
  }
  std::size_t mirrored = 0;
  for (std::size_t f = 0; f < polycube.Faces.size(); ++f)
  {
    const Polycube::Face& face = polycube.Faces[f];
    if (layout.PatchLabels[f] != 2 * face.Axis + face.Side)
    {
      messages.push_back("Patch " + std::to_string(f) + " has label " +
                         std::to_string(layout.PatchLabels[f]) + ", its face " +
                         std::to_string(2 * face.Axis + face.Side) + ".");
    }
    const std::vector<Index> wanted(face.Corners.begin(), face.Corners.end());
    std::vector<Index> outline = Outline(layout, static_cast<Index>(f), wanted[0]);
    if (outline != wanted)
    {
      messages.push_back("Patch " + std::to_string(f) + " has " + std::to_string(outline.size()) +
                         " corners in a row, not the four of its face in their order.");
      std::reverse(outline.begin() + 1, outline.end());
      mirrored += outline == wanted;
    }
  }
  if (mirrored == polycube.Faces.size())
  {
    messages.assign(1, "The layout is mirrored: all patches have their corners clockwise.");
  }
  return messages;
}
}
