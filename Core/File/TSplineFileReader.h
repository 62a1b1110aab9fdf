// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Reads the .tspline format (Documentation/FileFormat.md) without trusting the file.
 *
 * Whatever the bytes, these functions return a model that Validate finds sound or throw. Before
 * anything is allocated or read, each dataset's type, shape, storage and filters are checked: the
 * memory used is bounded by the file's size times deflate's largest ratio, plus one chunk. Links
 * and storage that lead out of the file, and filters that would load plugins, are refused.
 *
 * Errors: std::runtime_error with a sentence for the user (std::bad_alloc when memory is short),
 * Aborted when stopped.
 */
#ifndef trivariate_TSplineFileReader_h
#define trivariate_TSplineFileReader_h

#include "Execution.h"
#include "TSpline/TSplineModel.h"

#include <cstddef>
#include <string>

namespace trivariate
{
/// Whether `path` is a file that says of itself that it is in the .tspline format.
bool IsTSplineFile(const std::string& path);

/// Reads the file at `path`, unless the model would be larger than `maximumBytes`. O(file) time.
TSplineModel ReadTSplineFile(
  const std::string& path, double maximumBytes, const Execution& execution = {});

/// Reads a file that is in memory: `size` bytes at `bytes`.
TSplineModel ParseTSplineFile(
  const void* bytes, std::size_t size, double maximumBytes, const Execution& execution = {});
}

#endif
