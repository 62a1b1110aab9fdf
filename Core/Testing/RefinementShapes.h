// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Root meshes of all proportions, and refinement until nothing is left to refine.
#ifndef trivariate_RefinementShapes_h
#define trivariate_RefinementShapes_h

#include "TSpline/RefinementRule.h"

#include <array>
#include <vector>

namespace trivariate
{
/// Root cells of 2^Depth knot spans.
struct Shape
{
  std::array<int, 3> RootCells, Depth;
};

/// Cubes, thin slabs, rods, directions with less room or none, single cells.
inline const std::vector<Shape> Shapes = {
  { { 3, 3, 3 }, { 3, 3, 3 } },
  { { 5, 4, 3 }, { 2, 2, 2 } },
  { { 4, 5, 3 }, { 3, 2, 4 } },
  { { 4, 4, 4 }, { 3, 3, 1 } },
  { { 6, 5, 1 }, { 2, 3, 0 } },
  { { 3, 1, 4 }, { 1, 4, 2 } },
  { { 7, 1, 1 }, { 4, 0, 1 } },
  { { 1, 1, 1 }, { 4, 4, 4 } },
  { { 2, 6, 2 }, { 0, 3, 3 } },
  { { 4, 2, 3 }, { 4, 1, 0 } },
};

/// All marks that leave room for a knot.
inline std::vector<RefinementMark> AllMarks(const TSpline& spline)
{
  std::vector<RefinementMark> marks;
  for (Index i = 0; i < spline.Size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      const LocalKnots& k = spline.Functions[i][a];
      for (int s = 0; s < 4; ++s)
      {
        const std::int32_t knot = DyadicMiddle(k[s], k[s + 1]);
        if (knot >= 0)
        {
          marks.push_back({ i, a, knot });
        }
      }
    }
  }
  return marks;
}

inline void RefineToTheEnd(TSpline& spline, RefinementRule& rule)
{
  for (auto marks = AllMarks(spline); !marks.empty(); marks = AllMarks(spline))
  {
    rule.Refine(spline, marks);
  }
}
}

#endif
