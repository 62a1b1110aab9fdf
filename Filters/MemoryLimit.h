// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Whether an output can be allocated at all. Linux grants any request and kills the process when
 * the pages are touched, so std::bad_alloc alone does not protect a user from a mistyped size.
 */
#ifndef MemoryLimit_h
#define MemoryLimit_h

#include <string>

namespace trivariate
{
/// Empty when `bytes` fit into the memory of this machine (or the limit of this process);
/// otherwise a sentence for the user that begins with `what`, e.g. "The image".
std::string MemoryFault(const std::string& what, double bytes);
}

#endif
