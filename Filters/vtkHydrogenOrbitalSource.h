// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkHydrogenOrbitalSource
 * @brief   probability density of a hydrogen orbital on an image of any size
 *
 * Samples |psi_nlm|^2 of the hydrogen atom, in atomic units, on a cube centred at the nucleus. The
 * function is smooth, analytic and normalised, with n - l - 1 spherical nodes, l - |m| conical ones
 * and, in the real form, |m| planar ones: an input whose fit can be judged without a data file.
 *
 * @par Output
 * Port 0: a vtkImageData of `Dimensions` points on [-HalfWidth, HalfWidth]^3 (Bohr), with the point
 * array "Density" (float, 1 component) as scalars: 1/Bohr^3, or in [0, 1] with ScaleToUnit.
 *
 * @par Cost
 * O(n) time and 4 bytes a point. Threaded with vtkSMPTools. Any sub-extent can be asked for (MPI
 * ranks, ghost levels, streaming); its values equal those of the whole image bit by bit.
 *
 * @par Errors
 * Quantum numbers without an orbital, fewer than two points along an axis, a half width that is
 * negative or not finite, an image that does not fit into memory.
 *
 * @sa vtkTSplineFit vtkRTAnalyticSource
 */
#ifndef vtkHydrogenOrbitalSource_h
#define vtkHydrogenOrbitalSource_h

#include "vtkImageAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

class VTKTRIVARIATEFILTERS_EXPORT vtkHydrogenOrbitalSource : public vtkImageAlgorithm
{
public:
  static vtkHydrogenOrbitalSource* New();
  vtkTypeMacro(vtkHydrogenOrbitalSource, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Principal quantum number: the energy. Valid range [1, 16]. Default is 4.
   */
  vtkSetClampMacro(N, int, 1, 16);
  vtkGetMacro(N, int);
  ///@}

  ///@{
  /**
   * Quantum number of the angular momentum. Valid range [0, N - 1], checked when the source runs
   * (so that N and L can be set in any order). Default is 2.
   */
  vtkSetClampMacro(L, int, 0, 15);
  vtkGetMacro(L, int);
  ///@}

  ///@{
  /**
   * Magnetic quantum number. Valid range [-L, L], checked when the source runs. Default is 0.
   */
  vtkSetClampMacro(M, int, -15, 15);
  vtkGetMacro(M, int);
  ///@}

  ///@{
  /**
   * Off: the complex orbital, an eigenfunction of the angular momentum about z, whose density is
   * symmetric about the z axis and the same for M and -M. On: the real orbital, proportional to
   * cos(M phi) for M > 0 and to sin(|M| phi) for M < 0. The same for M = 0. Default is off.
   */
  vtkSetMacro(RealForm, bool);
  vtkGetMacro(RealForm, bool);
  vtkBooleanMacro(RealForm, bool);
  ///@}

  ///@{
  /**
   * Number of points along x, y and z, two or more each. Default is 64, 64, 64.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * Half the edge of the cube, in Bohr. 0 chooses 2 N (N + 2), which holds at least 99 % of the
   * electron: 48 for N = 4 (99.9 %). Default is 0.
   */
  vtkSetMacro(HalfWidth, double);
  vtkGetMacro(HalfWidth, double);
  ///@}

  ///@{
  /**
   * On: the density is divided by its largest value in space, so that it lies in [0, 1] whatever
   * the sampling. Off: its integral over space is one. Default is off.
   */
  vtkSetMacro(ScaleToUnit, bool);
  vtkGetMacro(ScaleToUnit, bool);
  vtkBooleanMacro(ScaleToUnit, bool);
  ///@}

protected:
  vtkHydrogenOrbitalSource();
  ~vtkHydrogenOrbitalSource() override = default;

  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkHydrogenOrbitalSource(const vtkHydrogenOrbitalSource&) = delete;
  void operator=(const vtkHydrogenOrbitalSource&) = delete;

  int N = 4;
  int L = 2;
  int M = 0;
  bool RealForm = false;
  int Dimensions[3] = { 64, 64, 64 };
  double HalfWidth = 0.0;
  bool ScaleToUnit = false;
};

#endif
