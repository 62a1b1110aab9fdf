// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineReader
 * @brief   reads a trivariate T-spline from a .tspline file
 *
 * The file is HDF5; Documentation/FileFormat.md describes it, with an example in Python that needs
 * nothing of this library. Nothing in the file is trusted: sizes, types and ranges are checked
 * before memory is used, links out of the file are not followed, and a file that is damaged, cut
 * short or hostile gives one error message and an empty output.
 *
 * @par Output
 * Port 0: a T-spline grid, a vtkUnstructuredGrid with one vertex cell a control point and the point
 * arrays
 * - one array an attribute (double, its own number of components), none of them active;
 * - "KnotsU", "KnotsV", "KnotsW" (double x 5): the local knot vectors of the blending functions;
 * - "Weight" (double, positive): the weights;
 * - "Segment", "Block" (int32): where the control points belong.
 *
 * Control points, weights and knots are bit for bit those that vtkTSplineWriter was given. In the
 * field data there is "RootCells" (int32 x 3) when the writer knew the cells of the coarsest mesh.
 *
 * @par Distributed
 * A T-spline is one thing: piece 0 holds all of it, the other pieces are empty.
 *
 * @par Cost
 * O(n) time. Memory: the output and, while reading, once more as much.
 *
 * @sa vtkTSplineWriter vtkTSplineSource
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
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to read. There is no default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  /**
   * 1 if the file is there and says of itself that it is a T-spline file, otherwise 0. Whether all
   * of it is sound is seen only when it is read. Prints nothing.
   */
  static int CanReadFile(const char* fileName);

protected:
  vtkTSplineReader();
  ~vtkTSplineReader() override;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTSplineReader(const vtkTSplineReader&) = delete;
  void operator=(const vtkTSplineReader&) = delete;

  char* FileName = nullptr;
};

#endif
