// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Arrays for outputs.
#ifndef NamedArray_h
#define NamedArray_h

#include "vtkNew.h"

namespace trivariate
{
/// An empty array: `Named<vtkIntArray>("Segment")`.
template <typename ArrayT>
vtkNew<ArrayT> Named(const char* name, int components = 1)
{
  vtkNew<ArrayT> array;
  array->SetName(name);
  array->SetNumberOfComponents(components);
  return array;
}
}

#endif
