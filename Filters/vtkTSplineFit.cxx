// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "vtkTSplineFit.h"

#include "vtkObjectFactory.h"

vtkStandardNewMacro(vtkTSplineFit);
