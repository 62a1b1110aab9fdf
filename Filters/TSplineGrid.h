// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The T-spline grid: how a T-spline travels through a VTK pipeline.
 *
 * A vtkUnstructuredGrid whose points (double) are the control points X, Y, Z, with one vertex cell
 * each, and with these point arrays, all plain ones, so that they survive every filter and every
 * move between processes:
 *
 *   KnotsU, KnotsV, KnotsW   double x 5   local knot vectors of the blending function
 *   Weight                   double       w_i > 0 of F = sum w_i p_i B_i / sum w_i B_i
 *   Segment, Block           int32        see Documentation/Arrays.md
 *   any other name           double x c   one array an attribute, c >= 1 components
 *
 * No array is the active scalars: the attributes are control values, which range wider than the
 * field, and no colors that anyone should see without asking.
 *
 * Beside them the field array RootCells (int32 x 3) where the coarsest T-mesh is known, and Holes
 * (double x 6: u low, u high, v low, ...) where functions reach out of the domain.
 */
#ifndef TSplineGrid_h
#define TSplineGrid_h

#include "TSpline/TSplineModel.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

class vtkPointSet;
class vtkUnstructuredGrid;

namespace trivariate
{
/// Makes `grid` the T-spline grid of `model`, which Validate finds sound. O(n) time; the grid's
/// arrays are copies.
VTKTRIVARIATEFILTERS_EXPORT void TSplineToGrid(
  const TSplineModel& model, vtkUnstructuredGrid* grid);

/**
 * The T-spline of a T-spline grid: the inverse of TSplineToGrid up to knot lines, which are rebuilt
 * as the sorted distinct values of the local knots (a line value no function uses is gone).
 *
 * Points and arrays of any real type are converted to double. Attributes are all other point arrays
 * of float or double, in the order of the point data; integer and string arrays (such as VTK's own
 * vtkOriginalPointIds) are left out. Segment and Block are zero where they are missing.
 *
 * Throws std::invalid_argument with one sentence for the user that names the first fault: no
 * points, a missing array, a wrong number of components or tuples, NaN or infinity, decreasing or
 * all equal local knots, a weight that is not positive, an attribute without a name.
 *
 * About O(n) time; a million control points take about half a second.
 */
VTKTRIVARIATEFILTERS_EXPORT TSplineModel TSplineFromGrid(vtkPointSet* grid);
}

#endif
