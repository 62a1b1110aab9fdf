// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The little that the .tspline code needs around the HDF5 C library: handles that close themselves
 * and errors that become one sentence instead of a page on the terminal.
 */
#ifndef trivariate_Hdf5_h
#define trivariate_Hdf5_h

#include <hdf5.h>

#include <exception>
#include <stdexcept>
#include <string>
#include <utility>

namespace trivariate
{
namespace hdf5
{
/// Owns an identifier of HDF5.
class Handle
{
public:
  using Closer = herr_t (*)(hid_t);

  Handle() = default;
  Handle(hid_t id, Closer close)
    : Id(id)
    , Close(close)
  {
  }
  Handle(Handle&& other) noexcept { *this = std::move(other); }
  Handle& operator=(Handle&& other) noexcept
  {
    std::swap(this->Id, other.Id);
    std::swap(this->Close, other.Close);
    return *this;
  }
  ~Handle() { this->Reset(); }

  /// Closes it now; negative when that failed.
  herr_t Reset()
  {
    const hid_t id = std::exchange(this->Id, -1);
    return id >= 0 ? this->Close(id) : 0;
  }

  operator hid_t() const { return this->Id; }
  explicit operator bool() const { return this->Id >= 0; }

private:
  hid_t Id = -1;
  Closer Close = nullptr;
};

/// Keeps HDF5 from printing its errors while it lives (in this thread), and ever after when an
/// exception ends it: HDF5 1.10 loses memory of a damaged file and would complain about that, on
/// the terminal, when the process ends.
class Quiet
{
public:
  Quiet()
  {
    H5Eget_auto2(H5E_DEFAULT, &this->Print, &this->Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Quiet()
  {
    if (std::uncaught_exceptions() == 0)
    {
      H5Eset_auto2(H5E_DEFAULT, this->Print, this->Data);
    }
  }
  Quiet(const Quiet&) = delete;
  void operator=(const Quiet&) = delete;

private:
  H5E_auto2_t Print = nullptr;
  void* Data = nullptr;
};

/// HDF5's own words for what went wrong deepest down, empty when it had no complaint.
inline std::string Reason()
{
  std::string reason;
  H5Ewalk2(
    H5E_DEFAULT, H5E_WALK_UPWARD,
    [](unsigned int level, const H5E_error2_t* error, void* data) -> herr_t
    {
      if (level == 0 && error->desc)
      {
        *static_cast<std::string*>(data) = error->desc;
      }
      return 0;
    },
    &reason);
  return reason;
}

/// Throws `sentence` with HDF5's reason when `good` is false.
inline void Require(bool good, const std::string& sentence)
{
  if (!good)
  {
    const std::string reason = Reason();
    throw std::runtime_error(sentence + (reason.empty() ? "" : " (HDF5: " + reason + ")"));
  }
}
}
}

#endif
