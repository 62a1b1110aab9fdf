// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Writing a file so that it is there whole or not at all.
 */
#ifndef trivariate_AtomicFile_h
#define trivariate_AtomicFile_h

#include "Execution.h"

#include <cstddef>
#include <string>

namespace trivariate
{
/**
 * Makes `path` a file of the given bytes, in one step: they go into a temporary file beside it,
 * which is flushed to the disk and then renamed. Whatever fails or stops before leaves an older
 * file as it was and nothing else behind. (The temporary file has a name, PATH.PROCESS-COUNT.part,
 * only just before it is renamed where the file system knows nameless files, as the local ones of
 * Linux do; so a killed process, too, leaves nothing.) An older file keeps its permissions; a
 * symbolic link stays one.
 *
 * Throws std::system_error (no folder, no permission, no space, the name is that of a folder, ...),
 * Aborted when stopped.
 */
void ReplaceFile(
  const std::string& path, const void* bytes, std::size_t size, const Execution& execution = {});
}

#endif
