// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The boxes into which the knot faces of a set of blending functions cut the domain.
 *
 * A plane sweep over the layers of the index grid along its longest direction. It keeps one layer
 * only: which unit squares of the layer have a face at their low sides, which are covered by a
 * function's support, and which box of the layer below began where. Each layer is cut into
 * rectangles, and a rectangle that continues one below without a face between makes its box higher.
 */
#ifndef trivariate_BoxPartition_h
#define trivariate_BoxPartition_h

#include "BezierMesh.h"

namespace trivariate
{
/**
 * Boxes in ascending order of their intervals in w, then v, then u. No face crosses a box, and the
 * supports' union is covered exactly. They are as few as can be when the regions between the faces
 * are boxes. Throws std::length_error beyond BezierMesh's limits.
 */
std::vector<IndexBox> PartitionIntoBoxes(const TSpline& spline, const Execution& execution);
}

#endif
