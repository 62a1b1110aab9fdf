// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Opens datasets of an HDF5 file that may be hostile, and reads them row by row.
 */
#ifndef trivariate_DatasetReader_h
#define trivariate_DatasetReader_h

#include "Execution.h"
#include "Hdf5.h"

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

namespace trivariate
{
/// A dataset of one or two dimensions that has been found safe to read.
struct Dataset
{
  hdf5::Handle Id;
  std::string Name;
  std::uint64_t Rows = 0;
  std::uint64_t Columns = 1;  ///< 1 for one dimension
  std::uint64_t SlabRows = 1; ///< read at once: whole chunks, about half a megabyte
  double ProgressBegin = 0.0, ProgressEnd = 1.0; ///< share of the file before and with this dataset

  /// Calls store(row, numbers of the row) for each row; asks `execution` between slabs.
  template <typename T, typename Store>
  void ReadRows(hid_t memoryType, const Execution& execution, const Store& store) const
  {
    std::vector<T> slab(std::min(this->SlabRows, this->Rows) * this->Columns);
    for (std::uint64_t begin = 0; begin < this->Rows; begin += this->SlabRows)
    {
      const double done = static_cast<double>(begin) / static_cast<double>(this->Rows);
      execution.Check(this->ProgressBegin + done * (this->ProgressEnd - this->ProgressBegin));
      const std::uint64_t rows = std::min(this->SlabRows, this->Rows - begin);
      this->ReadSlab(memoryType, begin, rows, slab.data());
      for (std::uint64_t i = 0; i < rows; ++i)
      {
        store(begin + i, &slab[i * this->Columns]);
      }
    }
  }

private:
  void ReadSlab(hid_t memoryType, std::uint64_t begin, std::uint64_t rows, void* values) const;
};

/// The string attribute `name` of an object; empty when there is none of fixed length, or it is
/// longer than a name may be.
std::string ReadString(hid_t object, const char* name);

/// Whether the integer attribute `name` of exactly `count` numbers is there; fills `values` if so.
bool ReadIntegers(hid_t object, const char* name, std::int32_t* values, std::size_t count);

class DatasetReader
{
public:
  enum Type
  {
    Float64,
    Int32,
    UnsignedInteger ///< 8, 16 or 32 bits
  };

  /// `fileSize` in bytes bounds what all datasets together may claim to be stored in.
  DatasetReader(hid_t file, std::uint64_t fileSize);

  /// Whether there is something at a path of one or two names. Throws std::runtime_error when a
  /// name on the way is a soft or external link, which may lead anywhere, or is damaged.
  bool Has(const std::string& path) const;

  /**
   * Opens the dataset at `path` after checking: hard links only, one of the type's encodings
   * (little endian), the wanted shape (0 = any size from 1), stored in the file itself, in chunks
   * of acceptable size or in one piece, by known filters only, and no larger than its storage can
   * hold. Throws std::runtime_error that names the dataset otherwise.
   */
  Dataset Open(const std::string& path, Type type, const std::vector<std::uint64_t>& shape);

private:
  hid_t File;
  std::uint64_t FileSize;
  std::uint64_t UnclaimedBytes; ///< of the file, not yet the storage of any opened dataset
};
}

#endif
