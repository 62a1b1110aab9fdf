// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeSolver.h"

#include "FoldEnergy.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
using SparseMatrix = Eigen::SparseMatrix<double>;

constexpr double Forcing = 0.1;     // by which the residual of a step is to fall
constexpr double Lowering = 0.1;    // of the barrier
constexpr int MostHalvings = 12;    // of a step
constexpr double Sufficient = 1e-4; // of what its slope promises must be won
constexpr double Clearance = 0.2;   // of the least determinant of each cell must be left
constexpr int MostFailures = 2;     // steps that lead nowhere
constexpr int SlideEvery = 2;       // steps
constexpr double Settled = 3e-3;    // the share that the last slide and its steps won

double Dot(const ShapeNet& a, const ShapeNet& b)
{
  return a.cwiseProduct(b).sum();
}

ShapeNet NetOf(const TSpline& spline, const SharedPoints& points)
{
  ShapeNet net(points.Count(), 3);
  for (Index i = 0; i < points.Count(); ++i)
  {
    const Index f = points.FirstOf[i];
    net.row(i) = spline.Weights[f] * Eigen::Map<const Eigen::RowVector3d>(spline.ControlPoint(f));
  }
  return net;
}

SparseMatrix ToSparse(const GramMatrix& gram)
{
  std::vector<Eigen::Triplet<double>> entries;
  gram.VisitEntries(
    [&entries](Index i, Index j, double value) { entries.emplace_back(i, j, value); });
  SparseMatrix matrix(gram.Size(), gram.Size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

class Solver
{
public:
  Solver(TSpline& spline, ScatteredSystem& system, ShapeTarget& target,
    const ShapeSolverOptions& options, const Execution& execution, const DataErrors* data)
    : Spline(spline)
    , System(system)
    , Target(target)
    , Run(execution)
    , Net(NetOf(spline, system.Points()))
    , Energy(system.Mesh(), system.Points(), this->Net, execution)
    , Samples(ToSparse(system.Assemble()))
    , Data(data)
    , Options(options)
  {
  }

  void Solve()
  {
    const auto& weights = this->Target.Samples().Weights;
    const double unit = 0.5 * this->Options.Spacing * this->Options.Spacing *
                        std::accumulate(weights.begin(), weights.end(), 0.0);
    this->Bound = this->Samples;
    this->DataSlope = ShapeNet::Zero(this->Net.rows(), 3);
    if (this->Data)
    {
      this->DataSlope = this->Data->Slope();
      this->Bound += ToSparse(this->Data->Bound());
    }
    for (double barrier = this->Options.FirstBarrier; barrier >= 0.99 * this->Options.LastBarrier;
         barrier *= Lowering)
    {
      this->Barrier = unit * barrier;
      if (!this->Minimise())
      {
        break; // a lower one does not take out folds that this has left
      }
    }
  }

private:
  // Whether that led to a shape without folds.
  bool Minimise()
  {
    double slid = std::numeric_limits<double>::max(); // the value when it slid last
    double shortest = 0.0;                            // step since then
    int failures = 0;                                 // one after the other
    int folded = 0;                                   // steps, which are counted by themselves
    const int most = this->Options.MostSteps;
    this->Slide();
    for (int step = 0; step - folded < most && folded < most && failures < MostFailures; ++step)
    {
      this->Run.Check(0.0);
      this->Energy.CountFinely(this->Net);
      FoldEnergy::Evaluation here = this->Energy.Evaluate(this->Net);
      const bool folds = here.Folds();
      if (folds)
      {
        ++folded;
        this->Energy.Regularise(here.Least);
        here = this->Energy.Evaluate(this->Net);
      }
      else if (step > 0 && step % SlideEvery == 0)
      {
        this->Slide();
      }
      const double now = this->ValueOf(here);
      if (!folds && step % SlideEvery == 0)
      {
        if (shortest == 1.0 && now > (1.0 - Settled) * slid)
        {
          break;
        }
        slid = now;
        shortest = 1.0;
      }
      const double length = this->Step(now, here.Least);
      shortest = std::min(shortest, length);
      failures = length > 0.0 || folds ? 0 : failures + 1;
    }
    this->Slide();
    return folded < most;
  }

  // Moves the samples along the surface, and writes their squared errors as constant plus half of
  // net Samples net minus Wanted net.
  void Slide()
  {
    const SharedPoints& points = this->System.Points();
    for (Index i = 0; i < this->Spline.Size(); ++i)
    {
      Eigen::Map<Eigen::RowVector3d>(this->Spline.ControlPoint(i)) =
        this->Net.row(points.PointOf[i]) / this->Spline.Weights[i];
    }
    if (this->Target.Slides())
    {
      this->Target.Slide(this->Spline, this->System.Mesh(), this->Run);
    }
    this->System.ComputeResiduals(this->Spline);
    const ShapeNet product = this->Samples * this->Net;
    this->Wanted = product;
    this->Constant = 0.0;
    for (int c = 0; c < 3; ++c)
    {
      const std::vector<double> slope = this->System.Gradient(c);
      this->Wanted.col(c) += Eigen::Map<const Eigen::VectorXd>(slope.data(), this->Net.rows());
    }
    this->Constant = Dot(this->Wanted, this->Net) - 0.5 * Dot(this->Net, product);
    for (int c = 0; c < 3; ++c)
    {
      this->Constant += 0.5 * this->System.SquaredError(c);
    }
  }

  // Of all that is minimised, where the shape is.
  double ValueOf(const FoldEnergy::Evaluation& here) const
  {
    return this->SamplesAt(this->Net) + this->DataValue + this->Barrier * here.Energy;
  }

  double SamplesAt(const ShapeNet& net) const
  {
    const ShapeNet product = this->Samples * net;
    return this->Constant + 0.5 * Dot(net, product) - Dot(this->Wanted, net);
  }

  // Towards the minimum of the convex part of the energy's second order, as far as it falls and no
  // cell comes too near to folding; the share of the way that was gone.
  double Step(double now, const std::vector<double>& least)
  {
    const ShapeNet slope = this->Samples * this->Net - this->Wanted + this->DataSlope +
                           this->Barrier * this->Energy.Differentiate(this->Net);
    this->Factors.compute(this->Bound + this->Barrier * this->Energy.Stiffness());
    ShapeNet step = ShapeNet::Zero(slope.rows(), 3), residual = -slope, dataStep = step;
    ShapeNet conditioned = this->Factors.solve(residual), direction = conditioned;
    double norm = Dot(residual, conditioned);
    const double goal = Forcing * Forcing * norm;
    for (int product = 0; product < this->Options.MostProducts && norm > goal; ++product)
    {
      this->Run.Check(0.0);
      const ShapeNet ofData = this->CurveData(direction);
      const ShapeNet curved =
        this->Samples * direction + ofData + this->Barrier * this->Energy.Curve(direction);
      const double rate = norm / Dot(direction, curved);
      step += rate * direction;
      dataStep += rate * ofData;
      residual -= rate * curved;
      conditioned = this->Factors.solve(residual);
      const double next = Dot(residual, conditioned);
      direction = conditioned + next / norm * direction;
      norm = next;
    }
    const double promised = Dot(slope, step);
    double length = 1.0;
    for (int halving = 0; halving < MostHalvings; ++halving, length *= 0.5)
    {
      const ShapeNet there = this->Net + length * step;
      const FoldEnergy::Evaluation found = this->Energy.Evaluate(there);
      const bool isClear = std::equal(least.begin(), least.end(), found.Least.begin(),
        [](double before, double after) { return before <= 0.0 || after >= Clearance * before; });
      const double data = this->DataValue + length * Dot(this->DataSlope, step) +
                          0.5 * length * length * Dot(dataStep, step);
      const double value = this->SamplesAt(there) + data + this->Barrier * found.Energy;
      if (isClear && value < now + Sufficient * length * promised)
      {
        if (this->StaysClear(there, least))
        {
          this->Net = there;
          this->DataValue = data;
          this->DataSlope += length * dataStep;
          return length;
        }
        now = this->ValueOf(this->Energy.Evaluate(this->Net)); // at more points
      }
    }
    return 0.0;
  }

  ShapeNet CurveData(const ShapeNet& direction) const
  {
    return this->Data ? this->Data->Curve(direction) : ShapeNet::Zero(direction.rows(), 3);
  }

  // Whether cells that do not fold do not there either, also where only more points show it. These
  // count from now on.
  bool StaysClear(const ShapeNet& there, const std::vector<double>& least)
  {
    this->Energy.CountFinely(there);
    const FoldEnergy::Evaluation found = this->Energy.Evaluate(there);
    return std::equal(least.begin(), least.end(), found.Least.begin(),
      [](double before, double after) { return before <= 0.0 || after > 0.0; });
  }

  TSpline& Spline;
  ScatteredSystem& System;
  ShapeTarget& Target;
  const Execution& Run;
  ShapeNet Net;
  FoldEnergy Energy;
  SparseMatrix Samples;
  SparseMatrix Bound; // of the curvature of samples and data
  ShapeNet Wanted;
  double Constant = 0.0;
  const DataErrors* Data;
  ShapeNet DataSlope;
  double DataValue = 0.0; // less that of the shape that it started from
  double Barrier = 0.0;   // times the weight of all samples
  const ShapeSolverOptions& Options;
  Eigen::SimplicialLLT<SparseMatrix> Factors;
};
}

//------------------------------------------------------------------------------
void SolveShape(TSpline& spline, ScatteredSystem& system, ShapeTarget& target,
  const ShapeSolverOptions& options, const Execution& execution, const DataErrors* data)
{
  Solver(spline, system, target, options, execution, data).Solve();
}
}
