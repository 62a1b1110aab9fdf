// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkFrameGlyphs
 * @brief   frames as crosses of three lines
 *
 * Draws the frames of vtkFrameField at some of the voxels: a line along each of u, v, w through the
 * voxel's point, all equally far apart in space. Streamlines along u, v or w are VTK's own:
 * vtkStreamTracer with the vectors FrameU, FrameV or FrameW.
 *
 * @par Input
 * Port 0: vtkImageData with the point arrays FrameU, FrameV, FrameW (3 components). Where they are
 * zero, no lines are.
 *
 * @par Output
 * Port 0: vtkPolyData with lines of two points. Cell array FrameAxis (int8, the active scalars): 0,
 * 1, 2 for u, v, w.
 *
 * @par Cost
 * Next to none: the voxels that are drawn.
 *
 * @par Distributed data
 * Every process draws its piece; the voxels that are drawn are those that one process would.
 *
 * @par Errors
 * An image that lacks one of the arrays, or has one of other than 3 components.
 *
 * @sa vtkFrameField vtkStreamTracer
 */
#ifndef vtkFrameGlyphs_h
#define vtkFrameGlyphs_h

#include "vtkPolyDataAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

class VTKTRIVARIATEFILTERS_EXPORT vtkFrameGlyphs : public vtkPolyDataAlgorithm
{
public:
  static vtkFrameGlyphs* New();
  vtkTypeMacro(vtkFrameGlyphs, vtkPolyDataAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How far apart the frames are that are drawn, in voxels along the axis of the finest spacing;
   * fewer along others. Valid range [0, VTK_INT_MAX]. Default is 0, which means such that there are
   * about 32 along the longest side of the image.
   */
  vtkSetClampMacro(Stride, int, 0, VTK_INT_MAX);
  vtkGetMacro(Stride, int);
  ///@}

  ///@{
  /**
   * The length of the lines, as a share of the distance of the frames. Valid range [0, 100].
   * Default is 0.8.
   */
  vtkSetClampMacro(Length, double, 0.0, 100.0);
  vtkGetMacro(Length, double);
  ///@}

protected:
  vtkFrameGlyphs() = default;
  ~vtkFrameGlyphs() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkFrameGlyphs(const vtkFrameGlyphs&) = delete;
  void operator=(const vtkFrameGlyphs&) = delete;

  int Stride = 0;
  double Length = 0.8;
};

#endif
