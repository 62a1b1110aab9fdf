// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The cells and surfaces of a T-spline as VTK meshes; vtkTSplineSource documents what is in them.
 *
 * All functions throw Aborted when stopped and std::length_error with a sentence for the user when
 * the output does not fit into memory.
 */
#ifndef TSplineCells_h
#define TSplineCells_h

#include "FieldSampler.h"

#include <array>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace trivariate
{
/// Each Bezier cell as subdivisions^3 trilinear hexahedra.
void FillHexahedra(const TSplineView& view, int subdivisions, vtkUnstructuredGrid* output,
  const Execution& execution);

/// Each cell of the T-mesh as one trilinear hexahedron.
void FillTMesh(const TSplineView& view, vtkUnstructuredGrid* output, const Execution& execution);

/// Each Bezier cell as one rational tricubic VTK_BEZIER_HEXAHEDRON.
void FillBezierHexahedra(
  const TSplineView& view, vtkUnstructuredGrid* output, const Execution& execution);

/// The surfaces at positions[a] in direction a, as shares (0 to 1) of the parameter's range.
void FillSurfaces(const TSplineView& view, const std::array<std::vector<double>, 3>& positions,
  int subdivisions, vtkPolyData* output, const Execution& execution);
}

#endif
