// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutRelaxation.h"

#include "StretchEnergy.h"
#include "UnfoldingLevels.h"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trivariate
{
namespace
{
using Eigen::Matrix2d;
using Eigen::Vector2d;

constexpr Index FewTriangles = 5000; // of the coarsest level
constexpr double LargestStep = 0.9;  // of that which flattens the first triangle
constexpr double Descent = 1e-4;     // Armijo's condition
constexpr double LeastStep = 1e-10;
constexpr int Patience = 2; // rounds with little fall, before the end
constexpr int MostGradients = 12;
constexpr double Exactness = 1e-4; // of the squared residual of conjugate gradients

double Determinant(const Vector2d& a, const Vector2d& b)
{
  return a.x() * b.y() - a.y() * b.x();
}

class Newton
{
public:
  using ChartTriangle = LayoutUnfolding::ChartTriangle;

  Newton(LayoutUnfolding& unfolding, const std::vector<ChartTriangle>& triangles,
    const Execution& execution)
    : Map(unfolding)
    , Triangles(triangles)
    , Run(execution)
    , Energies(triangles.size())
    , Gradients(triangles.size())
    , Hessians(triangles.size())
  {
    for (const ChartTriangle& triangle : triangles)
    {
      const Triangle& c = triangle.Points;
      const std::vector<Eigen::Vector3d>& points = unfolding.Mesh.Points;
      this->Pieces.emplace_back(points[c[0]], points[c[1]], points[c[2]]);
      this->Area += this->Pieces.back().Area();
    }
    this->NumberUnknowns();
    this->FindPattern();
  }

  double EnergyAt(const std::vector<double>& values)
  {
    this->Run.ParallelFor(static_cast<Index>(this->Triangles.size()),
      [&](Index begin, Index end)
      {
        for (Index t = begin; t < end; ++t)
        {
          this->Energies[t] = this->Pieces[t].Energy(this->Edges(values, t));
        }
      });
    double sum = 0.0;
    for (const double energy : this->Energies)
    {
      sum += energy;
    }
    return sum / this->Area;
  }

  // Returns the energy after a step; the same as before where there is none.
  double Step(double before, bool exact)
  {
    this->Differentiate();
    this->Assemble();
    const Eigen::VectorXd way = this->Direction(exact);
    const double slope = way.dot(this->Slope);
    if (!(slope < 0.0))
    {
      return before;
    }
    std::vector<double> direction(this->Map.Values.size(), 0.0);
    for (Index i = 0; i < way.size(); ++i)
    {
      direction[this->Variables[i]] = way[i];
    }
    double step = std::min(1.0, LargestStep * this->FlatteningStep(direction));
    std::vector<double> values = this->Map.Values;
    for (; step > LeastStep; step *= 0.5)
    {
      for (const Index i : this->Variables)
      {
        values[i] = this->Map.Values[i] + step * direction[i];
      }
      const double energy = this->EnergyAt(values);
      if (energy <= before + Descent * step * slope / this->Area)
      {
        this->Map.Values = values;
        return energy;
      }
    }
    return before;
  }

private:
  // Solves for Newton's step by conjugate gradients, preconditioned with the last factors; factors
  // anew where that takes long.
  Eigen::VectorXd Direction(bool exact)
  {
    const Eigen::VectorXd right = -this->Slope;
    if (this->Factored && !exact)
    {
      const auto matrix = this->Matrix.selfadjointView<Eigen::Lower>();
      Eigen::VectorXd way = Eigen::VectorXd::Zero(right.size()), rest = right;
      Eigen::VectorXd better = this->Factors.solve(rest), along = better, image;
      const double first = rest.dot(better);
      double product = first;
      for (int i = 0; i < MostGradients; ++i)
      {
        image = matrix * along;
        const double step = product / along.dot(image);
        way += step * along;
        rest -= step * image;
        better = this->Factors.solve(rest);
        const double next = rest.dot(better);
        if (next < Exactness * first)
        {
          return way;
        }
        along = better + next / product * along;
        product = next;
      }
    }
    if (!this->Factored)
    {
      this->Factors.analyzePattern(this->Matrix);
    }
    this->Factors.factorize(this->Matrix);
    this->Factored = this->Factors.info() == Eigen::Success;
    return this->Factored ? Eigen::VectorXd(this->Factors.solve(right))
                          : Eigen::VectorXd::Zero(right.size());
  }

  Matrix2d Edges(const std::vector<double>& values, Index t) const
  {
    const Vector2d origin = this->Map.Place(values, this->Triangles[t], 0);
    Matrix2d edges;
    edges << this->Map.Place(values, this->Triangles[t], 1) - origin,
      this->Map.Place(values, this->Triangles[t], 2) - origin;
    return edges;
  }

  void Differentiate()
  {
    this->Run.ParallelFor(static_cast<Index>(this->Triangles.size()),
      [this](Index begin, Index end)
      {
        for (Index t = begin; t < end; ++t)
        {
          this->Pieces[t].Differentiate(
            this->Edges(this->Map.Values, t), this->Gradients[t], this->Hessians[t]);
        }
      });
  }

  // Calls entry(i, j, a, b, sign) for each pair of variables, j <= i, of coordinates a and b.
  template <typename Entry>
  void ForEntries(Index t, const Entry& entry) const
  {
    std::array<std::pair<Index, double>, 3> terms[6];
    int counts[6];
    for (int a = 0; a < 6; ++a)
    {
      counts[a] = 0;
      this->Map.ForTerms(this->Triangles[t], a / 2, a % 2,
        [&](Index variable, double sign)
        {
          if (this->Unknowns[variable] >= 0)
          {
            terms[a][counts[a]++] = { this->Unknowns[variable], sign };
          }
        });
    }
    for (int a = 0; a < 6; ++a)
    {
      for (int b = 0; b < 6; ++b)
      {
        for (int i = 0; i < counts[a]; ++i)
        {
          for (int j = 0; j < counts[b]; ++j)
          {
            if (terms[b][j].first <= terms[a][i].first)
            {
              entry(terms[a][i].first, terms[b][j].first, a, b,
                terms[a][i].second * terms[b][j].second);
            }
          }
        }
      }
    }
  }

  void NumberUnknowns()
  {
    this->Unknowns.assign(this->Map.Values.size(), -1);
    for (std::size_t t = 0; t < this->Triangles.size(); ++t)
    {
      for (int a = 0; a < 6; ++a)
      {
        this->Map.ForTerms(this->Triangles[t], a / 2, a % 2,
          [this](Index variable, double)
          { this->Unknowns[variable] = variable < this->Map.NumberOfFree ? 0 : -1; });
      }
    }
    for (std::size_t variable = 0; variable < this->Unknowns.size(); ++variable)
    {
      if (this->Unknowns[variable] == 0)
      {
        this->Unknowns[variable] = static_cast<Index>(this->Variables.size());
        this->Variables.push_back(static_cast<Index>(variable));
      }
    }
  }

  void FindPattern()
  {
    std::vector<Eigen::Triplet<double>> entries;
    for (Index t = 0; t < static_cast<Index>(this->Triangles.size()); ++t)
    {
      this->ForEntries(
        t, [&](Index i, Index j, int, int, double) { entries.emplace_back(i, j, 0.0); });
    }
    const auto unknowns = static_cast<Index>(this->Variables.size());
    this->Matrix.resize(unknowns, unknowns);
    this->Matrix.setFromTriplets(entries.begin(), entries.end());
    const auto* outer = this->Matrix.outerIndexPtr();
    const auto* inner = this->Matrix.innerIndexPtr();
    this->Positions.reserve(entries.size());
    for (const Eigen::Triplet<double>& entry : entries)
    {
      this->Positions.push_back(static_cast<int>(
        std::lower_bound(inner + outer[entry.col()], inner + outer[entry.col() + 1], entry.row()) -
        inner));
    }
  }

  void Assemble()
  {
    this->Slope.setZero(static_cast<Index>(this->Variables.size()));
    std::fill(this->Matrix.valuePtr(), this->Matrix.valuePtr() + this->Matrix.nonZeros(), 0.0);
    std::size_t next = 0;
    for (Index t = 0; t < static_cast<Index>(this->Triangles.size()); ++t)
    {
      const StretchTriangle::Hessian& hessian = this->Hessians[t];
      this->ForEntries(t, [&](Index, Index, int a, int b, double sign)
        { this->Matrix.valuePtr()[this->Positions[next++]] += sign * hessian(a, b); });
      for (int a = 0; a < 6; ++a)
      {
        this->Map.ForTerms(this->Triangles[t], a / 2, a % 2,
          [&](Index variable, double sign)
          {
            if (this->Unknowns[variable] >= 0)
            {
              this->Slope[this->Unknowns[variable]] += sign * this->Gradients[t][a];
            }
          });
      }
    }
  }

  // The least positive step at which a triangle's area, quadratic in the step, is zero.
  double FlatteningStep(const std::vector<double>& direction) const
  {
    double least = std::numeric_limits<double>::infinity();
    for (Index t = 0; t < static_cast<Index>(this->Triangles.size()); ++t)
    {
      const Matrix2d edges = this->Edges(this->Map.Values, t), change = this->Edges(direction, t);
      const double a = change.determinant(), c = edges.determinant();
      const double b =
        Determinant(edges.col(0), change.col(1)) + Determinant(change.col(0), edges.col(1));
      const double under = b * b - 4.0 * a * c;
      if (under >= 0.0)
      {
        // c > 0. The stable forms of both roots.
        const double q = -0.5 * (b + std::copysign(std::sqrt(under), b));
        for (const double root : { q / a, c / q })
        {
          least = root > 0.0 ? std::min(least, root) : least;
        }
      }
    }
    return least;
  }

  LayoutUnfolding& Map;
  const std::vector<ChartTriangle>& Triangles;
  const Execution& Run;
  std::vector<Index> Unknowns;  // of each variable: which unknown it is; -1: none
  std::vector<Index> Variables; // of each unknown
  std::vector<StretchTriangle> Pieces;
  double Area = 0.0;
  std::vector<double> Energies;
  std::vector<StretchTriangle::Gradient> Gradients;
  std::vector<StretchTriangle::Hessian> Hessians;
  Eigen::SparseMatrix<double> Matrix; // the lower half
  std::vector<int> Positions;         // where the entries of triangles go, in order
  Eigen::VectorXd Slope;
  Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> Factors;
  bool Factored = false;
};
}

//------------------------------------------------------------------------------
RelaxationReport RelaxUnfolding(
  LayoutUnfolding& unfolding, const RelaxationOptions& options, const Execution& execution)
{
  const std::vector<double> start = unfolding.Values;
  UnfoldingLevels levels(unfolding, FewTriangles);
  const Index coarsest = levels.NumberOfLevels() - 1;
  RelaxationReport report;
  for (Index level = coarsest; level >= 0; --level)
  {
    const double done = double(coarsest - level) / double(coarsest + 1);
    const Execution run = execution.Part(done, done + 1.0 / double(coarsest + 1));
    if (level == coarsest)
    {
      unfolding.PlaceInside(levels.Triangles(level));
    }
    else
    {
      levels.PlaceAgain(level);
    }
    Newton newton(unfolding, levels.Triangles(level), run);
    double energy = newton.EnergyAt(unfolding.Values);
    if (!std::isfinite(energy))
    {
      throw std::runtime_error("A patch is too narrow to be mapped to its face.");
    }
    report.Before = level == coarsest ? energy : report.Before;
    const int most = level == coarsest ? options.MostRounds : options.FinerRounds;
    int idle = 0;
    for (int round = 0; idle < Patience && round < most; ++round)
    {
      run.Check(double(round) / most);
      report.After = newton.Step(energy, level == coarsest);
      idle = energy - report.After > options.Tolerance * (energy - 1.0) ? 0 : idle + 1;
      energy = report.After;
      ++report.Rounds;
    }
  }
  unfolding.SpaceLines(start);
  return report;
}
}
