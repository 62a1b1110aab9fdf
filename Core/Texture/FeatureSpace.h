// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The space in which attributes are compared: by how much they differ between regions, measured by
 * how much they differ within one.
 *
 * A window holds few voxels, so attributes of one and the same texture scatter. What two windows
 * side by side, one width apart, differ in is mostly that scatter: it is the noise by which the
 * attributes are measured. The texture attributes are rotated and scaled so that their noise is one
 * in every direction and uncorrelated (the minimum noise fraction transform), each new coordinate
 * is multiplied by its reliability (the share of its variance that is not noise), and all together
 * are scaled to the variance one. Attributes beside the texture (density, gradient) are divided by
 * their standard deviation and multiplied by their reliability and their weight: the density of a
 * voxel counts where it belongs to the region, not where it belongs to the texture.
 *
 * Reference: A. A. Green, M. Berman, P. Switzer, M. D. Craig. A transformation for ordering
 * multispectral data in terms of image quality. IEEE Trans. Geoscience Remote Sensing 26 (1988).
 */
#ifndef trivariate_FeatureSpace_h
#define trivariate_FeatureSpace_h

#include "KMeans.h"

#include <vector>

namespace trivariate
{
struct FeatureSamples
{
  PointRows Rows;              ///< attributes: the texture's first, then the others
  PointRows Left, Right;       ///< pairs of rows one window width apart
  std::vector<double> Weights; ///< of the attributes behind the texture's, 0 or more
};

/// A linear map from attributes to coordinates of which plain Euclidean distances are taken.
struct FeatureSpace
{
  int Attributes = 0;
  int Dimensions = 0;              ///< at most Attributes; 0 when no attribute varies
  std::vector<double> Map;         ///< Dimensions x Attributes, by rows
  std::vector<double> Mean;        ///< of the attributes, where the coordinates are zero
  std::vector<double> Reliability; ///< of each coordinate, in (0, 1]

  void Apply(const double* attributes, double* coordinates) const;
};

/// Cost: pairs x attributes^2 + attributes^3.
FeatureSpace MakeFeatureSpace(const FeatureSamples& samples);
}

#endif
