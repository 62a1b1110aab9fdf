// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Domains as VTK's data sets.
#ifndef DomainOutput_h
#define DomainOutput_h

#include "PickedCorners.h"

class vtkPolyData;
class vtkUnstructuredGrid;

namespace trivariate
{
/**
 * The three outputs of vtkPolycubeDomain. Numbers of corners and patches count through all
 * surfaces, in order of the segments; what two segments share has one number. `picked`: the places
 * that were asked for, of some segments' corners; none: SnapDistance is left out.
 */
void WriteDomains(const LabelledSurface& surface, const DomainSet& domains,
  const PickedCorners& picked, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  vtkPolyData* borders);
}

#endif
