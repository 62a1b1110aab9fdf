// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DataErrors.h"

#include "TSpline/Evaluator.h"
#include "TSpline/InverseJacobian.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace trivariate
{
namespace
{
// Slopes per voxel, as shares of the range: what is steeper comes from a cell that is nearly flat.
constexpr double Steepest = 2.0;

// How far the attributes are fitted to what a shape changes.
constexpr double ProjectionTolerance = 1e-2;
constexpr int ProjectionIterations = 60;

// What about is left when the attributes have followed, and each axis' share.
constexpr double LeftOver = 0.3;

std::vector<Index> ChooseFew(const ScatteredSystem& attributes, Index all, Index ofPoint)
{
  const Index enough = ofPoint * attributes.Points().Count();
  return attributes.EveryOnce(std::max<Index>(1, all / enough));
}

ScatteredSamples Choose(const ScatteredSamples& samples, const std::vector<Index>& few)
{
  ScatteredSamples chosen;
  for (const Index i : few)
  {
    const double* parameters = &samples.Parameters[3 * i];
    chosen.Parameters.insert(chosen.Parameters.end(), parameters, parameters + 3);
  }
  const double count = static_cast<double>(samples.Count()) / static_cast<double>(few.size());
  chosen.Weights.assign(few.size(), static_cast<float>(count));
  return chosen;
}
}

//------------------------------------------------------------------------------
DataErrors::DataErrors(const TSpline& spline, const TSpline& shape, const BlockSpline& layout,
  const ScatteredSamples& samples, const ScatteredSystem& attributes,
  const std::vector<double>& ranges, const DataErrorOptions& options, const Execution& execution)
  : Run(execution)
  , Layout(layout)
  , Shape(shape)
  , Weight(options.Weight)
  , Damping(options.Damping / (options.Spacing * options.Spacing))
  , Few(ChooseFew(attributes, samples.Count(), options.VoxelsOfPoint))
  , Voxels(Choose(samples, this->Few))
  , Attributes(this->Voxels, 3, layout, execution)
  , OfShape(this->Voxels, 0, layout, execution)
{
  const Gradients slopes =
    FindSlopes(spline, attributes.Mesh(), samples, ranges, options.Spacing, execution);
  Eigen::Matrix3Xd forces = Eigen::Matrix3Xd::Zero(3, samples.Count());
  for (std::size_t c = 0; c < slopes.size(); ++c)
  {
    const std::vector<double> residuals = attributes.ResidualsOf(static_cast<int>(c));
    for (Index i = 0; i < samples.Count(); ++i)
    {
      forces.col(i) += residuals[i] / ranges[c] * slopes[c].col(i);
    }
  }
  const ScatteredSamples all{ samples.Parameters, 0, {}, {} };
  ScatteredSystem ofShape(all, 0, layout, execution);
  ofShape.Update(shape);
  this->Gradient = this->Weight * ofShape.SumsOf(forces);

  for (const Eigen::Matrix3Xd& slope : slopes)
  {
    this->Slopes.push_back(slope(Eigen::all, this->Few));
  }
  this->Attributes.Update(spline);
  this->Gram = std::make_unique<GramMatrix>(this->Attributes.Assemble());
  this->OfShape.Update(shape);
}

//------------------------------------------------------------------------------
DataErrors::Gradients DataErrors::FindSlopes(const TSpline& spline, const BezierMesh& mesh,
  const ScatteredSamples& samples, const std::vector<double>& ranges, double spacing,
  const Execution& execution)
{
  const int columns = 3 + samples.Components;
  std::vector<int> components(columns);
  std::iota(components.begin(), components.end(), 0);
  const Evaluator evaluator(spline, mesh, components, execution);
  const Index n = samples.Count();
  Gradients slopes(samples.Components, Eigen::Matrix3Xd(3, n));
  constexpr Index Batch = 1 << 16; // points whose gradients are kept at a time
  std::vector<double> gradients;
  for (Index first = 0; first < n; first += Batch)
  {
    const Index count = std::min(Batch, n - first);
    gradients.resize(3 * columns * count);
    EvaluatorOutput output;
    output.Gradients = gradients.data();
    evaluator.Evaluate(count, &samples.Parameters[3 * first], output, execution);
    for (Index i = 0; i < count; ++i)
    {
      const double* gradient = &gradients[3 * columns * i];
      const InverseJacobian inverse(gradient);
      for (int c = 0; c < samples.Components; ++c)
      {
        const auto slope = inverse.Gradient(gradient + 3 * (3 + c));
        const double steepness = std::hypot(slope[0], slope[1], slope[2]) * spacing / ranges[c];
        const double scale = std::min(1.0, Steepest / std::max(steepness, 1e-300)) / ranges[c];
        for (int a = 0; a < 3; ++a)
        {
          slopes[c](a, first + i) = scale * slope[a];
        }
      }
    }
  }
  return slopes;
}

//------------------------------------------------------------------------------
void DataErrors::TakeOffAttributes(ColumnsOfSamples& values) const
{
  const ColumnsOfPoints sums = this->Attributes.SumsOf(values);
  std::vector<double> fit;
  this->Gram->Solve({ sums.data(), sums.data() + sums.size() }, ProjectionTolerance,
    ProjectionIterations, fit, this->Run);
  values -= this->Attributes.ValuesOf(Eigen::Map<const Eigen::VectorXd>(fit.data(), sums.rows()));
}

//------------------------------------------------------------------------------
ShapeNet DataErrors::Curve(const ShapeNet& direction) const
{
  const Eigen::Matrix3Xd ways = this->OfShape.ValuesOf(direction);
  Eigen::Matrix3Xd forces = this->Damping * ways;
  for (const Eigen::Matrix3Xd& slopes : this->Slopes)
  {
    ColumnsOfSamples changes = slopes.cwiseProduct(ways).colwise().sum();
    this->TakeOffAttributes(changes);
    forces += slopes * changes.row(0).asDiagonal();
  }
  return this->Weight * this->OfShape.SumsOf(forces);
}

//------------------------------------------------------------------------------
GramMatrix DataErrors::Bound() const
{
  ScatteredSamples weighted = this->Voxels;
  for (Index i = 0; i < weighted.Count(); ++i)
  {
    double square = 0.0;
    for (const Eigen::Matrix3Xd& slopes : this->Slopes)
    {
      square += slopes.col(i).squaredNorm();
    }
    weighted.Weights[i] *= static_cast<float>(this->Weight * (LeftOver * square + this->Damping));
  }
  ScatteredSystem system(weighted, 0, this->Layout, this->Run);
  system.Update(this->Shape);
  return system.Assemble();
}
}
