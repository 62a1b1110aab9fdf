// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// The samples of many processes brought together on one.
#ifndef GatherSamples_h
#define GatherSamples_h

#include "ImageSamples.h"

#include <string>

class vtkMultiProcessController;

namespace trivariate
{
/**
 * Collective. Process 0 gets the samples of all, the others an empty object; pieces may overlap.
 * `fault` is why this process has no samples, empty when all is well. When it is not empty
 * everywhere, or the pieces do not have the same arrays, or process 0 has no room for them, returns
 * false, and leaves the fault to be told on one process only. Memory of process 0: twice its
 * result.
 */
bool GatherSamples(
  ImageSamples& samples, std::string& fault, vtkMultiProcessController* controller);
}

#endif
