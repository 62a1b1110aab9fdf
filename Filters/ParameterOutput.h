// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Parameterized domains as VTK's data sets: the outputs of vtkVolumeParameterization.
#ifndef ParameterOutput_h
#define ParameterOutput_h

#include "ParameterDomain.h"

class vtkImageData;
class vtkMultiProcessController;

namespace trivariate
{
/// Parameter and FrameParameter with their masks and Block of the whole image, and field data.
void WriteParameters(const ParameterDomain& domain, vtkImageData* image);

/// Adds DomainPosition and BlockLengths, and replaces Block by the groups of the complex.
void WriteLengths(const ParameterDomain& domain, vtkUnstructuredGrid* polycube);

/// Adds the point arrays and field data of `whole` to an image, cut to its extent.
void AddParameters(vtkImageData* whole, vtkImageData* image);

/// Collective: the same with what process 0 has in `whole`.
void ShareParameters(
  vtkImageData* whole, vtkImageData* image, vtkMultiProcessController* controller);
}

#endif
