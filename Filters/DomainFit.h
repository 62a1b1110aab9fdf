// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The T-splines of segments over their domains of cubes.
 */
#ifndef DomainFit_h
#define DomainFit_h

#include "SegmentFits.h"

#include "vtkSmartPointer.h"

#include <set>
#include <string>
#include <vector>

class vtkPolyData;
class vtkTSplineFit;
class vtkTable;
class vtkUnstructuredGrid;

namespace trivariate
{
/**
 * What the filters vtkFrameField, vtkVolumeParameterization and vtkHexRemesh make of patches and
 * polycubes, with their defaults but for the length of cells: at most 30,000 of them would fill the
 * image. Throws as ChainStep does.
 */
FilledDomains FillDomains(vtkImageData* image, vtkPolyData* patches, vtkUnstructuredGrid* polycubes,
  Chain& chain, double from, double to);

/**
 * The same domains without layers, where they have some, and without hexahedra. Where half of the
 * cubes are inverted there is none.
 */
FilledDomains FillCubesAlone(
  const FilledDomains& filled, vtkPolyData* patches, Chain& chain, double from, double to);

struct FittedPart
{
  TSplineModel Model;
  vtkSmartPointer<vtkTable> Rounds;
  double Range = 0.0;   ///< of the array, of which the errors of Rounds are parts
  double Squares = 0.0; ///< sum of the squared errors of the round trip
  std::string Domain;   ///< SegmentBox, Cubes or LayeredCubes
};

/// Adds the rounds of a fit to those of all, under a label.
void AddRounds(const FittedPart& fitted, int segment, vtkTable* all);

/// The error that a fit ended with, in percent of the range of what it fitted.
double LastRms(vtkTable* rounds);

/**
 * Runs a fit that has its inputs, for the voxels that `mask` names and as the options want it. Its
 * time is that of the `step`.
 * Throws as ChainStep does.
 */
FittedPart RunFit(vtkTSplineFit* fit, const char* mask, const std::string& step,
  const SegmentFitOptions& options, Chain& chain, double from, double to);

/// Sets of two or more segments, from `lowest` on and without folds, whose blocks have faces in
/// common.
std::vector<std::set<int>> TouchingSegments(const FilledDomains& domains, int lowest);

/**
 * Segments over their blocks alone. `image` has the arrays to fit, Parameter and ParameterMask of
 * the domains, and a mask of the voxels that count; its Parameter is changed to that of the blocks
 * alone. Throws as ChainStep does, and std::runtime_error where a segment is folded.
 */
FittedPart FitOverDomain(const FilledDomains& domains, vtkImageData* image, const char* mask,
  const std::set<int>& segments, const SegmentFitOptions& options, Chain& chain, double from,
  double to);

/// How a spline stands for some voxels by its inverse map.
struct PartErrors
{
  double Squares = 0.0;          ///< sum of squared errors of the first array, where it was found
  std::vector<vtkIdType> Missed; ///< voxels that were not found
};

/// The errors of a spline of one segment at voxels of an image.
PartErrors MeasurePart(vtkImageData* image, const std::string& array, const TSplineModel& model,
  const std::vector<vtkIdType>& voxels, Chain& chain, double from, double to);
}

#endif
