// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineFit
 * @brief   adaptive T-spline through a volume image
 */
#ifndef vtkTSplineFit_h
#define vtkTSplineFit_h

#include "vtkTrivariateFiltersModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKTRIVARIATEFILTERS_EXPORT vtkTSplineFit : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTSplineFit* New();
  vtkTypeMacro(vtkTSplineFit, vtkUnstructuredGridAlgorithm);

protected:
  vtkTSplineFit() = default;
  ~vtkTSplineFit() override = default;

private:
  vtkTSplineFit(const vtkTSplineFit&) = delete;
  void operator=(const vtkTSplineFit&) = delete;
};

#endif
