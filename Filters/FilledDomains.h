// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Domains of cubes with all that a fit over them needs.
#ifndef FilledDomains_h
#define FilledDomains_h

#include "vtkImageData.h"
#include "vtkPartitionedDataSetCollection.h"
#include "vtkSmartPointer.h"
#include "vtkUnstructuredGrid.h"

#include <map>
#include <set>

class vtkPolyData;

namespace trivariate
{
struct Chain;

/// Frames, parameters and hexahedra of all segments with a domain.
struct FilledDomains
{
  vtkSmartPointer<vtkImageData> Fields;           ///< output 0 of vtkVolumeParameterization,
  vtkSmartPointer<vtkUnstructuredGrid> Polycubes; ///< its output 1
  vtkSmartPointer<vtkPartitionedDataSetCollection> Blocks; ///< and its output 2
  /// Output 1 of vtkHexRemesh, with the field data InvertedCells (before and after repair) and
  /// ScaledJacobian (least and mean); null where that failed, which is a warning.
  vtkSmartPointer<vtkUnstructuredGrid> Hexahedra;
  std::map<int, int> BlocksOf; ///< of the segments that have a domain: how many blocks
  std::set<int> Folded;        ///< those with an inverted cell in their blocks
};

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
}

#endif
