// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * A T-spline's attributes, evaluated into VTK point arrays.
 *
 * One array an attribute under its own name, and on request `<name>Gradient` (3 numbers a
 * component: d/dx, d/dy, d/dz in space) and `JacobianDeterminant` (of X, Y, Z by u, v, w). All
 * double. Where a point has no parameters everything is zero; so are gradients where the Jacobian
 * is singular.
 */
#ifndef FieldSampler_h
#define FieldSampler_h

#include "Execution.h"
#include "TSpline/BezierMesh.h"
#include "TSpline/Evaluator.h"
#include "TSpline/TSplineModel.h"

#include "vtkDoubleArray.h"
#include "vtkSmartPointer.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

class vtkPointData;
class vtkPoints;

namespace trivariate
{
/// A T-spline, its cells, and what is wanted beside its attributes.
struct TSplineView
{
  const TSplineModel& Model;
  const BezierMesh& Mesh;
  bool Gradients;
  bool Jacobian;
  double Reach = 0.0; ///< points not so far outside take the value at the nearest point inside
};

class FieldSampler
{
public:
  /// Prepares the evaluation, see Evaluator; with `positions` X, Y and Z are evaluated as well.
  /// The view's mesh must outlive this object.
  FieldSampler(const TSplineView& view, bool positions, const Execution& execution);

  /// Bytes that the arrays take for each point.
  double BytesPerPoint() const;

  /// Allocates the arrays of n points.
  void Allocate(Index n);

  /// Fills the arrays from point `first` on: n points at parameters (u, v, w). Points whose
  /// found[i] is 0 get zeros; found may be null.
  void Sample(Index first, Index n, const double* parameters, const std::uint8_t* found,
    const Execution& execution);

  /// Fills the arrays with the lattice of all (us[i], vs[j], ws[k]); inside[i] is set to 0 or 1.
  void SampleLattice(const std::array<std::vector<double>, 3>& coordinates, std::uint8_t* inside,
    const Execution& execution);

  /// Adds the arrays to the point data and makes the first attribute the active scalars; gives the
  /// points their positions if these were asked for.
  void AddTo(vtkPointData* pointData, vtkPoints* points = nullptr) const;

private:
  // One array and how it is made of what the evaluator gives.
  struct Attribute
  {
    int First; // component of the evaluator
    vtkSmartPointer<vtkDoubleArray> Values;
    vtkSmartPointer<vtkDoubleArray> Gradient; // null if not wanted
  };

  struct Buffers;

  bool Differentiates;
  std::unique_ptr<Evaluator> Spline;
  vtkSmartPointer<vtkDoubleArray> Positions, Jacobian;
  std::vector<Attribute> Attributes;

  void Scatter(Index first, Index n, const EvaluatorOutput& source, const std::uint8_t* found,
    const Execution& execution) const;
  void ScatterPoint(Index point, const double* values, const double* gradients) const;
};
}

#endif
