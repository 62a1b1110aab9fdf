// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Some of the domains that vtkPolycubeDomain has found.
#ifndef DomainSelection_h
#define DomainSelection_h

#include "vtkNew.h"
#include "vtkType.h"

#include <set>
#include <string>
#include <vector>

class vtkPolyData;
class vtkUnstructuredGrid;

namespace trivariate
{
/// Cells of polycubes, over the same points.
vtkNew<vtkUnstructuredGrid> CubesOf(
  vtkUnstructuredGrid* polycubes, const std::vector<vtkIdType>& cells);

/// Of solid segments with layers, the cubes alone, with corners on the surface; no others.
vtkNew<vtkUnstructuredGrid> WithoutLayers(vtkUnstructuredGrid* polycubes);

/// Takes the blocks of some segments out, and patches of those without blocks.
void LeaveOut(const std::set<int>& segments, vtkPolyData* patches, vtkUnstructuredGrid* polycubes);

/**
 * Takes the segments out of which half of the blocks or more are inverted or flat between their
 * corners, since their block meshes would keep folds after minutes, and patches of those without
 * blocks. Sentences say which of the first and why.
 */
std::vector<std::string> LeaveOutInverted(vtkPolyData* patches, vtkUnstructuredGrid* polycubes);
}

#endif
