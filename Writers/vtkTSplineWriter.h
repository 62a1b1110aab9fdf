// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineWriter
 * @brief   writes a trivariate T-spline to a .tspline file
 *
 * The file is HDF5, compact and compressed; Documentation/FileFormat.md describes it, with an
 * example in Python that needs nothing of this library. What vtkTSplineReader reads back is bit for
 * bit the same: control points, weights and knots.
 *
 * The file is replaced in one step at the very end. Whatever goes wrong before (no space, no
 * permission, a stop by the user, the end of the process) leaves an older file of this name whole
 * and nothing else behind.
 *
 * @par Input
 * Port 0: a T-spline grid, a vtkUnstructuredGrid with the point arrays "KnotsU", "KnotsV", "KnotsW"
 * (5 components, not decreasing), "Weight" (positive) and, when there are any, "Segment" and
 * "Block". All other point arrays of float or double are the attributes and written in their order;
 * integer and string arrays are not. Cells are not written: there is one vertex a control point.
 *
 * @par Errors
 * One message, and an ErrorCode other than vtkErrorCode::NoError: no input, no file name, an input
 * that is no valid T-spline grid or empty, or a file that cannot be written. Write() then returns
 * 0.
 *
 * @par Distributed
 * With several processes the pieces are gathered, in the order of the ranks, and process 0 writes.
 *
 * @par Cost
 * O(n) time, most of it compression. Memory: twice the input and twice the file.
 *
 * @sa vtkTSplineReader vtkTSplineFit
 */
#ifndef vtkTSplineWriter_h
#define vtkTSplineWriter_h

#include "vtkSmartPointer.h"            // for Controller
#include "vtkTrivariateWritersModule.h" // for export macro
#include "vtkWriter.h"

class vtkMultiProcessController;
class vtkUnstructuredGrid;

class VTKTRIVARIATEWRITERS_EXPORT vtkTSplineWriter : public vtkWriter
{
public:
  static vtkTSplineWriter* New();
  vtkTypeMacro(vtkTSplineWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write, usually with the ending .tspline. There is no default.
   */
  vtkSetFilePathMacro(FileName);
  vtkGetFilePathMacro(FileName);
  ///@}

  ///@{
  /**
   * How hard to compress: 0 is not at all, 9 gives the smallest file. The numbers in the file are
   * the same. Valid range [0, 9]. Default is 5.
   */
  vtkSetClampMacro(CompressionLevel, int, 0, 9);
  vtkGetMacro(CompressionLevel, int);
  ///@}

  ///@{
  /**
   * The processes among which the input is spread. The default is the global controller at the
   * time this object is made; without one the input is all there is.
   */
  void SetController(vtkMultiProcessController* controller);
  vtkMultiProcessController* GetController();
  ///@}

  /**
   * The input grid.
   */
  vtkUnstructuredGrid* GetInput();

protected:
  vtkTSplineWriter();
  ~vtkTSplineWriter() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  vtkTypeBool ProcessRequest(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  void WriteData() override;

private:
  vtkTSplineWriter(const vtkTSplineWriter&) = delete;
  void operator=(const vtkTSplineWriter&) = delete;

  vtkSmartPointer<vtkUnstructuredGrid> GatherInput();
  void WriteGrid(vtkUnstructuredGrid* grid);

  char* FileName = nullptr;
  int CompressionLevel = 5;
  vtkSmartPointer<vtkMultiProcessController> Controller;
};

#endif
