// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineReader
 * @brief   reads a T-spline file
 */
#ifndef vtkTSplineReader_h
#define vtkTSplineReader_h

#include "vtkTrivariateReadersModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKTRIVARIATEREADERS_EXPORT vtkTSplineReader : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTSplineReader* New();
  vtkTypeMacro(vtkTSplineReader, vtkUnstructuredGridAlgorithm);

protected:
  vtkTSplineReader() = default;
  ~vtkTSplineReader() override = default;

private:
  vtkTSplineReader(const vtkTSplineReader&) = delete;
  void operator=(const vtkTSplineReader&) = delete;
};

#endif
