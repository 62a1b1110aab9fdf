// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * The data side of a fit to scattered samples: residuals, gradients, normal equations, indicator.
 *
 * Samples are sorted into the Bezier cells of the spline, and everything is done cell by cell:
 * residuals from the cell's Bezier form, sums over samples first against the 64 Bernstein
 * polynomials of the cell and then, by its univariate factors, against its functions. Unknowns are
 * the homogeneous coefficients w_i p_i of control points, which several functions may share.
 */
#ifndef trivariate_ScatteredSystem_h
#define trivariate_ScatteredSystem_h

#include "BlockSpline.h"
#include "CellBasis.h"
#include "GramMatrix.h"
#include "RefinementMarks.h"

#include <Eigen/Core>

#include <algorithm>
#include <functional>
#include <memory>
#include <vector>

namespace trivariate
{
/// Samples at parameters of a BlockComplex.
struct ScatteredSamples
{
  std::vector<double> Parameters; ///< (u, v, w) of each
  int Components = 0;
  std::vector<double> Values; ///< Components blocks, each with a number for each sample
  std::vector<float> Weights; ///< of the squared errors; empty: all one

  Index Count() const { return static_cast<Index>(this->Parameters.size() / 3); }
};

/// Functions with coefficients, one a column; and their values at all samples, one a row.
using ColumnsOfPoints = Eigen::MatrixXd;
using ColumnsOfSamples = Eigen::MatrixXd;
constexpr int MostColumns = 3;

/// The error of one component, in the samples' own unit.
struct ScatteredError
{
  double Rms = 0.0; ///< weighted
  double Maximum = 0.0;
};

class ScatteredSystem
{
public:
  /**
   * The samples are fitted with the components firstComponent, ... of the spline: 0 for places, 3
   * for attributes, which tells what functions share. Samples and layout must outlive this object.
   * Throws std::invalid_argument, naming the sample, for a
   * parameter outside of all blocks or a number that is not finite.
   */
  ScatteredSystem(const ScatteredSamples& samples, int firstComponent, const BlockSpline& layout,
    const Execution& execution);

  /// The spline's functions have changed.
  void Update(const TSpline& spline);

  Sharing Shares() const
  {
    return this->FirstComponent < 3 ? Sharing::Places : Sharing::Attributes;
  }
  const SharedPoints& Points() const { return this->Shared; }
  const BezierMesh& Mesh() const { return *this->Cells; }

  /// Largest minus smallest sample of a component; where they are equal their size, or one.
  double Range(int component) const { return this->Ranges[component]; }
  double Mean(int component) const { return this->Means[component]; }

  /**
   * Adds to the squared error of each component, in every cell, Fairness times the squared second
   * derivatives (of the cell scaled to a unit cube, at 2 x 2 x 2 points): a little where a cell has
   * fewer samples than its share of a function needs, so that nothing is left open. `stiffness`
   * (one a cell, or empty) is added to that, in parts of the samples' weight in the cell. Update
   * takes it back.
   */
  void SetStiffness(const std::vector<float>& stiffness);

  /// Takes the residuals of all components.
  void ComputeResiduals(const TSpline& spline);
  ScatteredError Error(int component) const;
  /// The weighted sum of squared residuals.
  double SquaredError(int component) const;

  /// The weighted sums of residual times function of each control point: the negative gradient.
  std::vector<double> Gradient(int component) const;

  /// The residuals of a component at all samples, in their order.
  std::vector<double> ResidualsOf(int component) const;

  /// One of every `step` samples along the cells, so that each cell has its share of them.
  std::vector<Index> EveryOnce(Index step) const;

  /// At all samples, in their order, the function with a coefficient for each control point; and
  /// the transposed map, for each control point the weighted sum of values times its function.
  /// Both of up to MostColumns columns at once.
  ColumnsOfSamples ValuesOf(const ColumnsOfPoints& coefficients) const;
  ColumnsOfPoints SumsOf(const ColumnsOfSamples& values) const;

  /// The normal equations, with squared norms of all functions kept for AddGains.
  GramMatrix Assemble();

  /// What splits bring (see GridFitSystem): adds `factor` times the squared error by which each
  /// split of each function would lower that of a component. The first call makes the list.
  void AddGains(int component, double factor, std::vector<SplitGain>& gains) const;

private:
  struct LocalMatrix;

  void CheckSamples() const;
  double WeightOf(Index sample) const
  {
    return this->Samples.Weights.empty() ? 1.0 : this->Samples.Weights[sample];
  }
  bool IsEmpty(Index cell) const
  {
    return this->SampleBegin[cell] == this->SampleBegin[cell + 1] && this->Fairness[cell] == 0.0f;
  }
  void AddCell(CellBasis& basis, LocalMatrix& matrix) const;
  void AddFairness(Index cell, int component, Moments64& moments) const;
  template <typename Values, typename Add>
  ColumnsOfPoints SumOverSamples(int columns, const Values& values, const Add& addTo) const;
  LocalMatrix AssembleBlock(Index firstCell, Index lastCell) const;
  void SumLines(CellBasis& basis, int component, std::vector<double>& sums) const;

  const ScatteredSamples& Samples;
  int FirstComponent;
  const BlockSpline& Layout;
  const Execution& Run;
  std::vector<double> Ranges, Means;
  std::unique_ptr<BezierMesh> Cells;
  SharedPoints Shared;
  std::vector<Index> SplitsMade;    // together, see BlockSpline::LinkSplits
  std::vector<Index> SplitsUnknown; // what they add to
  std::vector<Index> Order;         // cells along a space-filling curve
  std::vector<Index> SampleBegin;   // of each cell in Sorted
  std::vector<std::int32_t> Sorted;
  std::vector<std::vector<double>> Residuals; // of each component, in the order of Sorted
  std::vector<double> SquaredNorms;           // of each function over the samples
  std::vector<float> Fairness;                // of each cell, the weight of its second derivatives
  std::vector<double> Bezier;                 // of all components, cell by cell
};

/// Cells are summed in as many parts, whatever the number of threads.
constexpr Index SumParts = 16;

/// The sums of `part(first, last, sums)` over parts of [0, cells), `size` numbers each.
template <typename Part>
std::vector<double> SumOfParts(
  Index cells, Index size, const Execution& execution, const Part& part)
{
  std::vector<std::vector<double>> sums(SumParts);
  execution.ParallelFor(SumParts,
    [&](Index begin, Index end)
    {
      for (Index p = begin; p < end; ++p)
      {
        sums[p].assign(size, 0.0);
        part(p * cells / SumParts, (p + 1) * cells / SumParts, sums[p]);
      }
    });
  for (Index p = 1; p < SumParts; ++p)
  {
    std::transform(sums[p].begin(), sums[p].end(), sums[0].begin(), sums[0].begin(), std::plus<>());
  }
  return std::move(sums[0]);
}
}

#endif
