// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// What speaks for a box to be part of a shape, and what against it.
#ifndef trivariate_SolidGrid_h
#define trivariate_SolidGrid_h

#include "Domain/SurfaceMesh.h"
#include "Execution.h"

namespace trivariate
{
/**
 * Cells of a grid around a closed surface, counted in boxes: those with their middles inside, and
 * those outside. A cell in a cleft, with cells inside before and behind it along some axis, counts
 * several times: what a shape like a cube has to stretch into a cleft is far more than where its
 * corners are rounded.
 */
class SolidGrid
{
public:
  /**
   * Rows of `frame`: the grid's axes. `cells`: so many along the surface's longest extent; the
   * other axes have fewer. A cell whose middle has a positive winding number is inside. O(n +
   * cells^3).
   */
  SolidGrid(const SurfaceMesh& mesh, const Eigen::Matrix3d& frame, int cells);

  const std::array<int, 3>& Size() const { return this->Cells; }

  /// How many cells from `low` up to, not including, `high` are inside. O(1).
  double Inside(const std::array<int, 3>& low, const std::array<int, 3>& high) const
  {
    return this->Sum(this->InsideSums, low, high);
  }

  /// What those outside weigh. O(1).
  double Outside(const std::array<int, 3>& low, const std::array<int, 3>& high) const
  {
    return this->Sum(this->OutsideSums, low, high);
  }

  /// Where a corner of cells is in space.
  Eigen::Vector3d Place(const Eigen::Vector3d& corner) const
  {
    return this->Frame.transpose() * (this->Low + this->Width * corner);
  }

private:
  std::vector<char> FindInside(const SurfaceMesh& mesh) const;
  std::vector<float> Weights(const std::vector<char>& inside) const;
  double Sum(const std::vector<double>& sums, const std::array<int, 3>& low,
    const std::array<int, 3>& high) const;
  // Of a corner; of the cell above it.
  Index At(int i, int j, int k) const
  {
    return i + (this->Cells[0] + Index(1)) * (j + (this->Cells[1] + Index(1)) * k);
  }

  Eigen::Matrix3d Frame;
  Eigen::Vector3d Low; // in the frame
  double Width = 1.0;  // of a cell
  std::array<int, 3> Cells{ 1, 1, 1 };
  std::vector<double> InsideSums, OutsideSums; // from the low corner to each
};
}

#endif
