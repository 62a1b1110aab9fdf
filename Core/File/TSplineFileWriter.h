// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Writes the .tspline format (Documentation/FileFormat.md).
 */
#ifndef trivariate_TSplineFileWriter_h
#define trivariate_TSplineFileWriter_h

#include "Execution.h"
#include "TSpline/TSplineModel.h"

#include <string>
#include <vector>

namespace trivariate
{
/**
 * The bytes of a file that holds `model`, which Validate must find sound. The same model gives the
 * same bytes. `compression` is deflate's level, 0 (none) to 9 (smallest, slow). The file is made in
 * memory, because only so every failure of the disk is known and the old file survives it.
 *
 * O(n) time and memory. Throws std::invalid_argument with Validate's sentence, std::runtime_error
 * when HDF5 fails, Aborted when stopped.
 */
std::vector<char> TSplineFileImage(
  const TSplineModel& model, int compression, const Execution& execution = {});
}

#endif
