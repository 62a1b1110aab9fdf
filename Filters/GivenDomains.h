// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Cubes and corners that a user gives, as the domains of segments.
 */
#ifndef GivenDomains_h
#define GivenDomains_h

#include "SegmentDomains.h"

class vtkUnstructuredGrid;

namespace trivariate
{
struct GivenDomain
{
  int Segment;
  Polycube Cubes;
  std::vector<Eigen::Vector3d> Corners; ///< the wanted places of the corners of Cubes, in its order
  bool Layered;                         ///< whether there are blocks along the surface
};

/**
 * Reads hexahedra with the cell array Segment and the point array DomainCoordinates, as
 * vtkPolycubeDomain writes them. Cubes are the cells whose Patch, if there is that array, is -1.
 * The place of a corner is that of the point with its coordinates; if there is an array CornerId,
 * points without one (-1) are no corners. In order of the segments.
 *
 * Throws std::invalid_argument with a sentence for the user, which names the cell or the corner: no
 * grid (null) or no cells, cells that are no unit cubes of the lattice, cubes that are no Polycube,
 * a corner without a point or with two.
 */
std::vector<GivenDomain> ReadGivenDomains(vtkUnstructuredGrid* grid);

/**
 * Lays the domains out on the surfaces of their segments. Throws std::invalid_argument and
 * std::runtime_error with the segment's number where that is not possible, for the reasons of
 * DomainFromCorners: a corner too far away, mirrored corners, paths that cross.
 */
DomainSet LayOutGivenDomains(const LabelledSurface& surface, const std::vector<GivenDomain>& given,
  const Execution& execution);
}

#endif
