// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * @class   vtkTSplineSource
 * @brief   evaluates a trivariate T-spline: image, hexahedra, Bezier cells, surfaces or points
 *
 * Makes of a T-spline grid what the rest of VTK works with. The spline alone decides; the grid's
 * cells are not looked at.
 *
 * @par Input
 * Port 0: the T-spline grid, as vtkTSplineFit and vtkTSplineReader make it: a vtkPointSet with the
 * point arrays "KnotsU", "KnotsV", "KnotsW" and "Weight"; all other arrays of real numbers are the
 * spline's attributes.
 * Port 1 (optional): for POINTS a vtkDataSet, at whose points the spline is evaluated; for IMAGE a
 * vtkImageData that gives the lattice (extent, origin, spacing, direction; its arrays are not
 * used but Segment, see below). Not used otherwise.
 *
 * @par Output
 * Port 0, by OutputType:
 * - IMAGE: vtkImageData, on the lattice of port 1 or with Dimensions points over the spline's
 * bounds (the box of its Bezier cells' control points);
 * - LINEAR_HEXES: vtkUnstructuredGrid, Subdivisions^3 hexahedra for each Bezier cell, on the
 * spline. They have true volumes and can be clipped, sliced and probed. Neighbours share their
 * points; where cells of different sizes meet at a curved place, a gap of second order in the size
 * of the hexahedra remains beside the additional points of the smaller ones;
 * - BEZIER_HEXES: vtkUnstructuredGrid, one VTK_BEZIER_HEXAHEDRON of degree 3 for each Bezier cell,
 *   exact; 64 points a cell, not shared. VTK cuts, clips and probes such cells wrongly: tessellate
 *   them first, or take LINEAR_HEXES;
 * - ISO_SURFACES: vtkPolyData, quadrilaterals on surfaces of constant parameter;
 * - TMESH: vtkUnstructuredGrid, one hexahedron for each cell of the T-mesh. Of an analysis-suitable
 *   spline these are the cells that bisection left, rebuilt from the functions and the grid's field
 *   array RootCells; functions can have knots inside of them, which cut them into Bezier cells. (A
 *   cell that makes no difference to the functions may be shown halved.) Of all other splines, of
 *   the compact rule, over several blocks, without RootCells or with functions left out under a
 * mask, they are the
 *   regions between the faces of all functions' knots: the Bezier cells themselves;
 * - POINTS: the data set of port 1 with the spline's values at its points.
 *
 * The splines of several segments overlap in space. For IMAGE and POINTS the point array Segment of
 * port 1 tells whose spline counts at a point; without it that of the highest segment that holds
 * the point does. The same holds for the spline of one segment, fitted over its domain, whose
 * number is not 0; that of a fit without domain stands for all points. A voxel with a label that
 * lies outside of its segment's spline, but not more than 1.5 times the largest of the voxels'
 * three spacings, takes the value at the nearest point of that: a smooth surface does not go around
 * every voxel.
 *
 * @par Arrays
 * All floating point arrays are double. Point arrays:
 * - each attribute under its own name; the first is the active scalars;
 * - "<name>Gradient", 3 numbers a component (by x, y, z in space), with ComputeGradients;
 * - "JacobianDeterminant", of (x, y, z) by (u, v, w), with ComputeJacobian;
 * - "Parameter" (u, v, w): LINEAR_HEXES, TMESH, ISO_SURFACES;
 * - "vtkValidPointMask" (char): IMAGE, POINTS: 1 in the spline (or near enough to it, see above), 0
 *   outside, where all is zero;
 * - "RationalWeights" (active attribute) and its plain twin "BezierWeights": BEZIER_HEXES. Points
 *   and attributes are the control values of the rational form, as VTK interpolates them.
 *   ComputeGradients and ComputeJacobian have no effect: these are no functions of that form.
 * Cell arrays:
 * - "ParametricBounds" (6: u, v, w low and high in turn), "Level" (int): LINEAR_HEXES, TMESH,
 *   BEZIER_HEXES: the Bezier or T-mesh cell, and how often a cell of the coarsest mesh was halved
 * to get it (of the widest cells where the grid has no field array RootCells);
 * - "HigherOrderDegrees" (active attribute) and its plain twin "BezierDegrees" (int, 3):
 *   BEZIER_HEXES. The twins survive moves between processes, which drop the active attributes;
 * - "SurfaceDirection" (int: 0, 1, 2 for u, v, w) and "SurfaceParameter": ISO_SURFACES.
 *
 * @par Cost
 * Time: the Bezier cells (about 70 active functions each), then some million points a second and
 * thread, a hundred million on a lattice aligned with a spline of affine geometry, such as the
 * image that the spline was fitted to. Memory: 512 bytes a cell and component beside the output.
 * Threaded with vtkSMPTools; the result does not depend on the number of threads.
 *
 * @par MPI
 * The spline lives on the rank that has piece 0, and so do all outputs but POINTS, for which it is
 * sent to all ranks: each evaluates its own piece of port 1. For IMAGE, where all ranks update, the
 * labels of port 1 are gathered to that rank.
 *
 * @par Errors
 * A grid without control points or that is no T-spline (see TSplineFromGrid), POINTS without a
 * second input, IMAGE with one that is no image, fewer than two points along an axis, a surface
 * outside of [0, 1], an output that does not fit into memory, a spline spread over several ranks.
 *
 * @sa vtkTSplineFit vtkTSplineReader vtkTessellatorFilter
 */
#ifndef vtkTSplineSource_h
#define vtkTSplineSource_h

#include "vtkDataObjectAlgorithm.h"
#include "vtkTrivariateFiltersModule.h" // for export macro

#include <array>  // for the positions of the surfaces
#include <vector> // for the positions of the surfaces

class vtkDataArray;
class vtkMultiProcessController;
class vtkPointSet;

class VTKTRIVARIATEFILTERS_EXPORT vtkTSplineSource : public vtkDataObjectAlgorithm
{
public:
  static vtkTSplineSource* New();
  vtkTypeMacro(vtkTSplineSource, vtkDataObjectAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputTypes
  {
    IMAGE = 0,
    LINEAR_HEXES = 1,
    BEZIER_HEXES = 2,
    ISO_SURFACES = 3,
    TMESH = 4,
    POINTS = 5
  };

  ///@{
  /**
   * What is made of the spline, see above. Default is LINEAR_HEXES.
   */
  vtkSetClampMacro(OutputType, int, IMAGE, POINTS);
  vtkGetMacro(OutputType, int);
  ///@}

  /**
   * The second input: the points to evaluate at, or the image whose lattice is taken.
   */
  void SetPointsConnection(vtkAlgorithmOutput* input) { this->SetInputConnection(1, input); }

  ///@{
  /**
   * Number of points of an image without a second input along x, y and z, two or more each.
   * Default is 64, 64, 64.
   */
  vtkSetVector3Macro(Dimensions, int);
  vtkGetVector3Macro(Dimensions, int);
  ///@}

  ///@{
  /**
   * Into how many hexahedra or quadrilaterals a Bezier cell is cut along each direction, for
   * LINEAR_HEXES and ISO_SURFACES. Valid range [1, 64]. Default is 2.
   */
  vtkSetClampMacro(Subdivisions, int, 1, 64);
  vtkGetMacro(Subdivisions, int);
  ///@}

  ///@{
  /**
   * Where ISO_SURFACES lie across each direction, as shares of the parameter's range: 0 and 1 are
   * the boundary faces. Valid range [0, 1]. Default is 0.5 in each direction. GetSurface gives NaN
   * for one that does not exist.
   */
  void AddSurfaceU(double share) { this->AddSurface(0, share); }
  void AddSurfaceV(double share) { this->AddSurface(1, share); }
  void AddSurfaceW(double share) { this->AddSurface(2, share); }
  void RemoveAllSurfacesU() { this->RemoveAllSurfaces(0); }
  void RemoveAllSurfacesV() { this->RemoveAllSurfaces(1); }
  void RemoveAllSurfacesW() { this->RemoveAllSurfaces(2); }
  int GetNumberOfSurfaces(int direction);
  double GetSurface(int direction, int index);
  ///@}

  ///@{
  /**
   * Whether to add the gradient of each attribute in space. Default is off.
   */
  vtkSetMacro(ComputeGradients, bool);
  vtkGetMacro(ComputeGradients, bool);
  vtkBooleanMacro(ComputeGradients, bool);
  ///@}

  ///@{
  /**
   * Whether to add the Jacobian determinant. Default is off.
   */
  vtkSetMacro(ComputeJacobian, bool);
  vtkGetMacro(ComputeJacobian, bool);
  vtkBooleanMacro(ComputeJacobian, bool);
  ///@}

  ///@{
  /**
   * The processes that share the work. Default is the global controller.
   */
  virtual void SetController(vtkMultiProcessController* controller);
  vtkGetObjectMacro(Controller, vtkMultiProcessController);
  ///@}

protected:
  vtkTSplineSource();
  ~vtkTSplineSource() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestDataObject(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestInformation(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;
  int RequestData(vtkInformation* request, vtkInformationVector** inputVector,
    vtkInformationVector* outputVector) override;

private:
  vtkTSplineSource(const vtkTSplineSource&) = delete;
  void operator=(const vtkTSplineSource&) = delete;

  void AddSurface(int direction, double share);
  void RemoveAllSurfaces(int direction);

  /// Throws std::invalid_argument with a sentence for the user when the settings make no sense.
  void CheckSettings(vtkDataObject* points) const;

  /// Fills the output from a T-spline grid with points.
  void Evaluate(
    vtkPointSet* grid, vtkInformation* pointsInfo, vtkDataArray* labels, vtkDataObject* output);

  int OutputType = LINEAR_HEXES;
  int Dimensions[3] = { 64, 64, 64 };
  int Subdivisions = 2;
  std::array<std::vector<double>, 3> Surfaces;
  bool ComputeGradients = false;
  bool ComputeJacobian = false;
  vtkMultiProcessController* Controller = nullptr;
};

#endif
