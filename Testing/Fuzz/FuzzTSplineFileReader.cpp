// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// Whatever the bytes: a sound model or one exception, within the memory allowed.
#include "File/TSplineFileReader.h"

#include <cstdint>
#include <cstdlib>
#include <stdexcept>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size)
{
  constexpr double MaximumBytes = 64.0 * 1024 * 1024;
  try
  {
    const trivariate::TSplineModel model = trivariate::ParseTSplineFile(bytes, size, MaximumBytes);
    if (!trivariate::Validate(model).empty())
    {
      std::abort();
    }
  }
  catch (const std::runtime_error&)
  {
  }
  return 0;
}
