// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineWriter
 * @brief   writes a T-spline file
 */
#ifndef vtkTSplineWriter_h
#define vtkTSplineWriter_h

#include "vtkTrivariateWritersModule.h" // for export macro
#include "vtkUnstructuredGridAlgorithm.h"

class VTKTRIVARIATEWRITERS_EXPORT vtkTSplineWriter : public vtkUnstructuredGridAlgorithm
{
public:
  static vtkTSplineWriter* New();
  vtkTypeMacro(vtkTSplineWriter, vtkUnstructuredGridAlgorithm);

protected:
  vtkTSplineWriter() = default;
  ~vtkTSplineWriter() override = default;

private:
  vtkTSplineWriter(const vtkTSplineWriter&) = delete;
  void operator=(const vtkTSplineWriter&) = delete;
};

#endif
