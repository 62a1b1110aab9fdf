// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * One T-spline for each segment of an image, all of them in one parameter space.
 */
#ifndef SegmentFits_h
#define SegmentFits_h

#include "FilledDomains.h"
#include "TSpline/TSplineModel.h"

#include <string>
#include <vector>

class vtkImageData;
class vtkTable;

namespace trivariate
{
struct Chain;

struct SegmentFitOptions
{
  std::string Array;                ///< point array to fit
  std::vector<std::string> Further; ///< and those beside it
  int MaximumControlPoints = 0;     ///< of all segments together
  double RmsTolerance = 0.0;        ///< percent of each array's range over the whole image; 0: none
  std::vector<FilledDomains> Domains; ///< of cubes; several of a segment are compared
  double LargestShapeDistance = 0.0;  ///< as in vtkTSplineFit
  bool Compared = true; ///< whether a fit over a domain must be better than that over the box

  std::vector<std::string> Arrays() const
  {
    std::vector<std::string> arrays{ this->Array };
    arrays.insert(arrays.end(), this->Further.begin(), this->Further.end());
    return arrays;
  }
};

struct SegmentFits
{
  TSplineModel Model;
  vtkIdType ControlPoints; ///< distinct ones
  /// Of the round trip, of the range over the whole image; of several arrays the largest.
  double RmsPercent;
};

/**
 * Fits the voxels of each label in the point array Segment over the label's bounding box, the
 * others masked; and those with domains also over their cubes with as many control points. Labels
 * whose blocks have faces in common are fitted together over the first domains, so that there is no
 * gap between them; or each by itself where boxes are better, blocks are folded, that fit fails or
 * misses too many voxels. The best one by the round trip is kept, or where they are not compared
 * that over the cubes if it misses few voxels; `why` says for each label with a domain why it is
 * the box. Where they are compared, a fit over cubes begins with a trial with an eighth of the
 * control points, and ends with it if its shape stays away from its surface or the box was more
 * accurate with so many. Voxels that the spline over a domain misses get the lowest label.
 *
 * Control points are shared out by PointShares; what a segment leaves when it meets the tolerance
 * goes to those after it, those with small shares first. The rounds of all fits go to the table,
 * with a column Segment; labels that are fitted together have the same ones. Progress, abort and
 * messages are those of `chain`, from `from` to `to`. Throws as ChainStep does.
 */
SegmentFits FitSegments(vtkImageData* image, const SegmentFitOptions& options, vtkTable* rounds,
  std::vector<std::string>& why, Chain& chain, double from, double to);
}

#endif
