// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Properties of filters that are lists, as VTK's wrapping and ParaView's panels want them: Add...,
 * Clear..., GetNumberOf..., Get...(i).
 */
#ifndef ListProperty_h
#define ListProperty_h

#include "vtkObject.h"

#include <vector>

namespace trivariate
{
template <typename T>
void AddEntry(vtkObject* filter, std::vector<T>& list, T entry)
{
  list.push_back(std::move(entry));
  filter->Modified();
}

template <typename T>
void ClearEntries(vtkObject* filter, std::vector<T>& list)
{
  if (!list.empty())
  {
    list.clear();
    filter->Modified();
  }
}

/// An entry, or `none` where there is none with this number.
template <typename T>
T EntryOf(const std::vector<T>& list, int i, T none)
{
  return i >= 0 && i < static_cast<int>(list.size()) ? list[i] : none;
}
}

#endif
