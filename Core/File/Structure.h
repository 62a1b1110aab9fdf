// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * What a file must be before the HDF5 library is let near it.
 *
 * HDF5 checks sums over all of its newer structures (format 1.10) before it looks at what is in
 * them, so that damage is an error. Its older ones have no sums, and a few wrong bytes in them
 * crash the library (1.10.8: attributes, virtual layouts, shared messages). So only the newer are
 * let in.
 */
#ifndef trivariate_Structure_h
#define trivariate_Structure_h

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>

namespace trivariate
{
/// Copies `count` bytes of the file from `offset` on, which are there.
using ReadBytes = std::function<void(std::uint64_t offset, char* bytes, std::size_t count)>;

/// Empty when the file of `size` bytes begins with a superblock of version 3 (or 2) of one plain
/// file, is as long as that says and has a root group with a checksum; otherwise a sentence.
std::string StructureFault(std::uint64_t size, const ReadBytes& read);
}

#endif
