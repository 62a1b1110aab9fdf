// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "FarthestPoint.h"

#include <limits>
#include <queue>

namespace trivariate
{
//------------------------------------------------------------------------------
Index FarthestPoint(const SurfaceMesh& mesh, Index start)
{
  std::vector<double> way(mesh.Points.size(), std::numeric_limits<double>::infinity());
  using Entry = std::pair<double, Index>;
  std::priority_queue<Entry, std::vector<Entry>, std::greater<>> front;
  way[start] = 0.0;
  front.push({ 0.0, start });
  Index last = start;
  while (!front.empty())
  {
    const auto [length, p] = front.top();
    front.pop();
    if (length > way[p])
    {
      continue;
    }
    last = p;
    for (const Index* t = mesh.FanBegin(p); t != mesh.FanEnd(p); ++t)
    {
      const Index q = mesh.Triangles[*t][(mesh.CornerOf(*t, p) + 1) % 3];
      const double sum = length + (mesh.Points[q] - mesh.Points[p]).norm();
      if (sum < way[q])
      {
        way[q] = sum;
        front.push({ sum, q });
      }
    }
  }
  return last;
}
}
