// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A T-spline with the names of what it carries: all that a file or a T-spline grid holds.
 */
#ifndef trivariate_TSplineModel_h
#define trivariate_TSplineModel_h

#include "TSpline.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace trivariate
{
/// One attribute of the control points, e.g. the density.
struct TSplineAttribute
{
  std::string Name;   ///< UTF-8; not empty, no name of the T-spline grid's own arrays, unique
  int Components = 1; ///< >= 1
};

/// Plain data; Validate says whether it makes sense.
struct TSplineModel
{
  TSpline Spline; ///< Components = 3 (X, Y, Z) + those of the attributes, in their order
  std::vector<TSplineAttribute> Attributes;
  std::vector<std::int32_t> Segment; ///< one a function
  std::vector<std::int32_t> Block;   ///< one a function
  /// Cells of the coarsest T-mesh in u, v, w (level 0 of T-mesh cells); zeros when unknown.
  std::array<std::int32_t, 3> RootCells = { 0, 0, 0 };
};

/// The T-spline grid's own point arrays; no attribute may have one of these names.
inline const std::array<const char*, 6> TSplineArrayNames = { "KnotsU", "KnotsV", "KnotsW",
  "Weight", "Segment", "Block" };

/// Whether `name` is one of TSplineArrayNames.
bool IsTSplineArrayName(const std::string& name);

/// The segments that have blending functions, ascending.
std::vector<std::int32_t> SegmentsOf(const TSplineModel& model);

/// The blending functions of one segment. The functions of a segment do not overlap those of
/// another in parameter space, so this is the whole spline there. Knot lines end where they do.
TSplineModel SegmentPart(const TSplineModel& model, std::int32_t segment);

/**
 * Brings two splines with the same attributes together: the second one lies at least one beyond the
 * first one along u in parameter space, and its blocks are numbered after the first one's. Does
 * nothing but return the other where one has no functions.
 */
TSplineModel JoinParts(const TSplineModel& first, const TSplineModel& second);

/// The same spline with one attribute only, counted from 0.
TSplineModel AttributePart(const TSplineModel& model, int attribute);

/// Empty when the spline and all beside it are sound; otherwise one sentence that names the first
/// fault and its place.
std::string Validate(const TSplineModel& model);
}

#endif
