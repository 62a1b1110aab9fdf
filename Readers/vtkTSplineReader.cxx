// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineReader.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkTSplineReader);
