// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "BlockRepair.h"

#include "CornerEnergy.h"
#include "FacingFaces.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int MostHalvings = 8;
constexpr Index MovedAtOnce = 8192;      // nodes, less than a second of work, before the next check
constexpr double AtEnd = 0.99;           // of the freedom off the surface
constexpr int AssignEvery = 3;           // sweeps
constexpr double LateFitting = 0.1;      // where folds stay
constexpr double LongestStep = 1.0;      // in wanted lengths
constexpr double Sharp = 1e-8;           // the regularisation where nothing is inverted
constexpr double BluntestAtFirst = 0.01; // regularisation of flat cells, times
constexpr double Sharpening = 0.93;      // this with each sweep,
constexpr int SweepsOfRound = 100;       // then from the start, first with
constexpr int Spreads = 3;               // sweeps that spread nodes
constexpr double Flat = 0.01;            // a determinant so small is treated as if it were inverted
constexpr int WholeSweeps = 20;          // before only nodes near inverted cells move,
constexpr int WholeEvery = 4;            // but for some sweeps
constexpr int Rings = 3;                 // of cells around those,
constexpr int SpreadRings = 1;           // fewer when nodes spread: more would give up whole limbs

// By the least determinant around a node: where cells are inverted large enough that the energy
// pulls them out. It is each node's own, so that one hopeless cell does not blunt it everywhere.
// Beside flat cells, which push back, an inverted one would come to rest just below zero if
// `bluntest` did not shrink from sweep to sweep; that it starts anew shakes up what is stuck.
double Regularisation(double least, double bluntest)
{
  return least > Flat ? Sharp : std::hypot(bluntest, 0.2 * std::min(least, 0.0));
}

bool IsActive(const BlockPoints& cell, const std::vector<char>& active)
{
  return std::any_of(cell.begin(), cell.end(), [&active](Index node) { return active[node]; });
}

class Sweeper
{
public:
  Sweeper(BlockMesh& mesh, SlidingNodes& sliding, BoundaryFit& fit,
    const std::vector<Vector3d>& targets, const RepairOptions& options)
    : Fitting(options.Fitting)
    , Evenness(options.Evenness)
    , FacingWeight(options.Facing)
    , Mesh(mesh)
    , Sliding(sliding)
    , Fit(fit)
    , Targets(targets)
    , Facing(sliding, mesh, targets)
    , Cells(mesh)
    , Active(mesh.Places.size(), 1)
    , Determinants(this->Cells.Cells.size())
    , Twisted(this->Cells.Cells.size(), 0)
  {
  }

  /// One move of each active node, or a spread; done: what is reported as the share of the work.
  void Sweep(bool spreading, double done, const Execution& execution);

  /// Only nodes in some rings around cells that are inverted; or all of them.
  void Activate(bool all, int rings = Rings);

  Index CountInverted(const Execution& execution);
  Index CountCells() const { return static_cast<Index>(this->Cells.Cells.size()); }

  double Energy(double epsilon, const Execution& execution) const;

  double Fitting;
  double Bluntest = BluntestAtFirst;

private:
  const double Evenness, FacingWeight;

  // What the energy around a node is made of.
  struct NodeTerms
  {
    std::vector<CornerTerm> Corners;
    std::vector<FacingFaces::Term> Faces;
  };

  void Terms(Index node, std::vector<CornerTerm>& terms) const;
  void Move(Index node, NodeTerms& terms);
  void Spread(Index node);

  BlockMesh& Mesh;
  SlidingNodes& Sliding;
  BoundaryFit& Fit;
  const std::vector<Vector3d>& Targets;
  const FacingFaces Facing;
  BlockCells Cells;
  std::vector<char> Active;
  std::vector<double> Determinants; // the least of each cell, of its target
  std::vector<char> Twisted;        // cells that were inverted: their inside counts as well
};

void Sweeper::Terms(Index node, std::vector<CornerTerm>& terms) const
{
  terms.clear();
  for (const BlockCells::Use* use = this->Cells.UsesBegin(node); use != this->Cells.UsesEnd(node);
       ++use)
  {
    const BlockPoints& cell = this->Cells.Cells[use->Cell];
    const Vector3d& lengths = this->Targets[this->Cells.BlockOf[use->Cell]];
    terms.push_back(TermOf(this->Mesh.Places, cell, use->Corner, -1, lengths));
    for (int axis = 0; axis < 3; ++axis)
    {
      const int corner = AcrossAxis(use->Corner, axis);
      terms.push_back(TermOf(this->Mesh.Places, cell, corner, axis, lengths));
    }
    for (int i = 0; i < 27 && this->Twisted[use->Cell]; ++i)
    {
      terms.push_back(TermAt(this->Mesh.Places, cell, GaussPoint(i), use->Corner, lengths));
    }
  }
}

void Sweeper::Move(Index node, NodeTerms& terms)
{
  const SlidingNodes::Kind kind = this->Sliding.KindOf(node);
  if (kind == SlidingNodes::Fixed)
  {
    return;
  }
  this->Terms(node, terms.Corners);
  double least = 1.0;
  for (const CornerTerm& term : terms.Corners)
  {
    least = std::min(least, term.Determinant);
  }
  const double epsilon = Regularisation(least, this->Bluntest);
  double energy = 0.0;
  Vector3d gradient = Vector3d::Zero();
  Matrix3d hessian = Matrix3d::Zero();
  for (const CornerTerm& term : terms.Corners)
  {
    const EnergyDerivatives e =
      CornerDerivatives(term.Trace, term.Determinant, epsilon, this->Evenness);
    const Vector3d &t = term.TraceSlope, &c = term.DeterminantSlope;
    energy += e.Value;
    gradient += e.ByTrace * t + e.ByDeterminant * c;
    hessian += e.ByBoth * (t * c.transpose() + c * t.transpose()) +
               e.ByDeterminantTwice * (c * c.transpose());
    hessian.diagonal().array() += 2.0 * e.ByTrace * term.TraceCurve;
  }

  Vector3d& place = this->Mesh.Places[node];
  const Vector3d& lengths = this->Targets[this->Cells.BlockOf[this->Cells.UsesBegin(node)->Cell]];
  BoundaryFit::Term fit;
  if (kind != SlidingNodes::Free)
  {
    fit = this->Fit.TermOf(node, this->Mesh.Places);
    gradient += this->Fitting * fit.Slope;
    hessian += 2.0 * this->Fitting * fit.Curve;
  }
  if (this->FacingWeight > 0.0)
  {
    this->Facing.TermsOf(node, this->Mesh.Places, this->Sliding, terms.Faces);
  }
  for (const FacingFaces::Term& term : terms.Faces)
  {
    const double lack = term.LackAt(Vector3d::Zero());
    energy += this->FacingWeight * lack * lack;
    if (lack > 0.0)
    {
      gradient -= 2.0 * this->FacingWeight * lack * term.Slope;
      hessian += 2.0 * this->FacingWeight * term.Slope * term.Slope.transpose();
    }
  }
  const auto tryStep = [&](int freedom, const Matrix3d& basis)
  {
    const auto free = basis.leftCols(freedom);
    const Eigen::MatrixXd reduced = free.transpose() * hessian * free;
    const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(reduced);
    const Eigen::VectorXd slope = eigen.eigenvectors().transpose() * (free.transpose() * gradient);
    const Eigen::VectorXd curve = eigen.eigenvalues().cwiseAbs();
    const double flattest = std::max(1e-9 * curve.maxCoeff(), 1e-300);
    Vector3d step = -free * (eigen.eigenvectors() * slope.cwiseQuotient(curve.cwiseMax(flattest)));
    const double length = step.norm();
    if (!(length > 0.0) || !std::isfinite(length))
    {
      return false;
    }
    step *= std::min(1.0, LongestStep * lengths.maxCoeff() / length);
    for (int halving = 0; halving < MostHalvings; ++halving, step *= 0.5)
    {
      SurfaceFoot foot;
      const Vector3d candidate = this->Sliding.Allowed(node, place + step, foot);
      const Vector3d moved = candidate - place;
      double there = this->Fitting * fit.At(moved);
      for (const CornerTerm& term : terms.Corners)
      {
        there +=
          CornerEnergy(term.TraceAt(moved), term.DeterminantAt(moved), epsilon, this->Evenness);
      }
      for (const FacingFaces::Term& term : terms.Faces)
      {
        const double lack = term.LackAt(moved);
        there += this->FacingWeight * lack * lack;
      }
      if (there < energy * (1.0 - 1e-12))
      {
        place = candidate;
        this->Sliding.Step(node, foot);
        return true;
      }
    }
    return false;
  };
  const Matrix3d basis = this->Sliding.BasisAt(node, place);
  if (kind == SlidingNodes::OnSurface)
  {
    // Off the surface as far as that goes the step is along it, but where it wants to come back.
    const Vector3d off = place - this->Sliding.FootOf(node).Place;
    const bool isHeld = off.norm() >= AtEnd * this->Sliding.Freedom() && gradient.dot(off) < 0.0;
    const int first = isHeld ? 2 : 3;
    if (!tryStep(first, basis))
    {
      tryStep(5 - first, basis);
    }
  }
  else
  {
    tryStep(kind == SlidingNodes::OnBorder ? 1 : 3, basis);
  }
}

// Nodes that have come together have no slope to part along: to the means of their neighbours.
void Sweeper::Spread(Index node)
{
  Vector3d sum = Vector3d::Zero();
  double count = 0.0;
  for (const BlockCells::Use* use = this->Cells.UsesBegin(node); use != this->Cells.UsesEnd(node);
       ++use)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      sum += this->Mesh.Places[this->Cells.Cells[use->Cell][AcrossAxis(use->Corner, axis)]];
      count += 1.0;
    }
  }
  SurfaceFoot foot;
  this->Mesh.Places[node] = this->Sliding.Allowed(node, sum / count, foot);
  this->Sliding.Step(node, foot);
}

void Sweeper::Sweep(bool spreading, double done, const Execution& execution)
{
  for (const std::vector<Index>& nodes : this->Cells.Colours)
  {
    const Index count = static_cast<Index>(nodes.size());
    for (Index first = 0; first < count; first += MovedAtOnce)
    {
      execution.Check(done);
      execution.ParallelFor(std::min(MovedAtOnce, count - first),
        [&](Index begin, Index end)
        {
          NodeTerms terms;
          for (Index i = first + begin; i < first + end; ++i)
          {
            if (!this->Active[nodes[i]])
            {
              continue;
            }
            if (spreading)
            {
              this->Spread(nodes[i]);
            }
            else
            {
              this->Move(nodes[i], terms);
            }
          }
        });
    }
  }
}

void Sweeper::Activate(bool all, int rings)
{
  std::fill(this->Active.begin(), this->Active.end(), all);
  for (std::size_t c = 0; c < this->Determinants.size(); ++c)
  {
    if (this->Determinants[c] <= 0.0)
    {
      for (const Index node : this->Cells.Cells[c])
      {
        this->Active[node] = 1;
      }
    }
  }
  for (int ring = 0; ring < rings && !all; ++ring)
  {
    const std::vector<char> before = this->Active;
    for (const BlockPoints& cell : this->Cells.Cells)
    {
      if (IsActive(cell, before))
      {
        for (const Index node : cell)
        {
          this->Active[node] = 1;
        }
      }
    }
  }
}

Index Sweeper::CountInverted(const Execution& execution)
{
  execution.ParallelFor(this->CountCells(),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        if (IsActive(this->Cells.Cells[c], this->Active)) // else none of its nodes has moved
        {
          const double target = this->Targets[this->Cells.BlockOf[c]].prod();
          this->Determinants[c] =
            LeastDeterminant(this->Mesh.Places, this->Cells.Cells[c]) / target;
          this->Twisted[c] = this->Twisted[c] || this->Determinants[c] <= 0.0;
        }
      }
    });
  return std::count_if(this->Determinants.begin(), this->Determinants.end(),
    [](double determinant) { return determinant <= 0.0; });
}

double Sweeper::Energy(double epsilon, const Execution& execution) const
{
  std::vector<double> energies(this->Cells.Cells.size(), 0.0);
  execution.ParallelFor(static_cast<Index>(energies.size()),
    [&](Index begin, Index end)
    {
      for (Index c = begin; c < end; ++c)
      {
        for (int corner = 0; corner < 8; ++corner)
        {
          const Matrix3d jacobian = CornerJacobian(
            this->Mesh.Places, this->Cells.Cells[c], corner, this->Targets[this->Cells.BlockOf[c]]);
          energies[c] +=
            CornerEnergy(jacobian.squaredNorm(), jacobian.determinant(), epsilon, this->Evenness);
        }
      }
    });
  const double facing =
    this->FacingWeight > 0.0 ? this->Facing.Energy(this->Mesh.Places, this->Sliding) : 0.0;
  return std::accumulate(energies.begin(), energies.end(), this->FacingWeight * facing);
}
}

//------------------------------------------------------------------------------
void Repair(BlockMesh& mesh, SlidingNodes& sliding, BoundaryFit& fit,
  const std::vector<Vector3d>& targets, const RepairOptions& options, const Execution& execution)
{
  Sweeper sweeper(mesh, sliding, fit, targets, options);
  // What the best round ended with, or what smoothing began its last sweep with.
  struct Kept
  {
    Index Inverted;
    std::vector<Vector3d> Places;
    SlidingNodes Sliding;
  };
  std::optional<Kept> kept;
  const int mostUntangling = options.MostRounds * SweepsOfRound;
  const double all = mostUntangling + options.MostSmoothing;
  double done = 0.0, untangled = 0.0;                      // shares of the work
  double energy = std::numeric_limits<double>::infinity(); // the least so far
  int settled = 0;                                         // sweeps in a row
  for (int sweep = 0, untangling = 0, smoothing = 0;; ++sweep)
  {
    if (sweep % AssignEvery == 0)
    {
      fit.Assign(mesh.Places, execution);
    }
    const Index inverted = sweeper.CountInverted(execution);
    const int since = untangling % SweepsOfRound;
    bool spreading = false;
    if (inverted > 0 && since == 0 && (untangling > 0 || mostUntangling == 0))
    {
      if (!kept || inverted < kept->Inverted)
      {
        kept = Kept{ inverted, mesh.Places, sliding };
      }
      const double most = options.MostInverted * double(sweeper.CountCells());
      if (untangling >= mostUntangling || double(inverted) > most || kept->Inverted == 0)
      {
        mesh.Places = std::move(kept->Places);
        sliding = std::move(kept->Sliding);
        break;
      }
    }
    if (inverted > 0)
    {
      // Where folds stay, the nodes around them may leave the surface uncovered.
      const bool late = untangling >= SweepsOfRound;
      sweeper.Fitting = late ? LateFitting * options.Fitting : options.Fitting;
      spreading = late && since < Spreads;
      sweeper.Activate(untangling < WholeSweeps || (!late && untangling % WholeEvery == 0),
        spreading ? SpreadRings : Rings);
      sweeper.Bluntest = BluntestAtFirst * std::pow(Sharpening, since);
      untangled = ++untangling / all;
      done = std::max(done, untangled);
    }
    else
    {
      sweeper.Fitting = options.Fitting;
      sweeper.Activate(true);
      const double now =
        sweeper.Energy(Sharp, execution) + options.Fitting * fit.Energy(mesh.Places);
      settled = now > (1.0 - options.Settled) * energy ? settled + 1 : 0;
      if (settled == options.Patience || smoothing == options.MostSmoothing)
      {
        break;
      }
      energy = std::min(energy, now);
      kept = Kept{ 0, mesh.Places, sliding };
      ++smoothing;
      done = std::max(done, untangled + (1.0 - untangled) * smoothing / options.MostSmoothing);
    }
    sweeper.Sweep(spreading, done, execution);
  }
}
}
