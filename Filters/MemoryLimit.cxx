// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "MemoryLimit.h"

#include "vtksys/SystemInformation.hxx"

#include <cmath>

namespace trivariate
{
std::string MemoryFault(const std::string& what, double bytes)
{
  vtksys::SystemInformation system;
  const double available = 1024.0 * static_cast<double>(system.GetProcMemoryAvailable());
  if (bytes <= available)
  {
    return {};
  }
  const auto mebibytes = [](double b)
  { return std::to_string(static_cast<long long>(std::ceil(b / (1024.0 * 1024.0)))) + " MiB"; };
  return what + " would need " + mebibytes(bytes) + " of memory, but only " + mebibytes(available) +
         " are there; ask for fewer points.";
}
}
