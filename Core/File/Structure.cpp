// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Structure.h"

#include "SuperBlock.h"

#include <array>
#include <cstring>

namespace trivariate
{
//------------------------------------------------------------------------------
std::string StructureFault(std::uint64_t size, const ReadBytes& read)
{
  if (size < SuperBlock::Size)
  {
    return "It is no HDF5 file: it has only " + std::to_string(size) + " bytes.";
  }
  std::array<char, SuperBlock::Size> bytes;
  read(0, bytes.data(), bytes.size());
  const SuperBlock head(bytes.data());
  if (!head.IsHdf5())
  {
    return "It is no HDF5 file.";
  }
  if (head.Version() < 2 || head.Version() > 3 || !head.HasWideAddresses() ||
      head.BaseAddress() != 0 || head.Extension() != SuperBlock::Undefined)
  {
    return "It uses a variant of HDF5 without checksums or one of several files; write it in the "
           "format of HDF5 1.10 (in h5py: libver=\"v110\").";
  }
  if (head.EndOfFile() != size)
  {
    return "It has " + std::to_string(size) + " of " + std::to_string(head.EndOfFile()) +
           " bytes; it was cut short or damaged.";
  }
  std::array<char, 4> root = {};
  if (head.RootGroup() <= size - root.size())
  {
    read(head.RootGroup(), root.data(), root.size());
  }
  return std::memcmp(root.data(), "OHDR", root.size()) == 0 ? "" : "It is damaged.";
}
}
