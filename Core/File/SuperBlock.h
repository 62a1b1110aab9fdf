// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#ifndef trivariate_SuperBlock_h
#define trivariate_SuperBlock_h

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace trivariate
{
/// The beginning of an HDF5 file in its versions 2 and 3 (HDF5 File Format Specification 3.0,
/// section II.A), with addresses of eight bytes.
class SuperBlock
{
public:
  static constexpr std::size_t Size = 48;
  static constexpr std::uint64_t Undefined = std::numeric_limits<std::uint64_t>::max();

  /// Looks at the first Size bytes of a file; does not keep them.
  explicit SuperBlock(const char* bytes) { std::memcpy(this->Bytes, bytes, Size); }

  bool IsHdf5() const { return std::memcmp(this->Bytes, "\x89HDF\r\n\x1a\n", 8) == 0; }
  int Version() const { return this->Bytes[8]; }
  bool HasWideAddresses() const { return this->Bytes[9] == 8 && this->Bytes[10] == 8; }
  std::uint64_t BaseAddress() const { return this->Address(12); }
  std::uint64_t Extension() const { return this->Address(20); }
  std::uint64_t EndOfFile() const { return this->Address(28); }
  std::uint64_t RootGroup() const { return this->Address(36); }

private:
  std::uint64_t Address(std::size_t offset) const
  {
    std::uint64_t address = 0;
    for (std::size_t i = 8; i-- > 0;)
    {
      address = address << 8 | this->Bytes[offset + i];
    }
    return address;
  }

  unsigned char Bytes[Size];
};
}

#endif
