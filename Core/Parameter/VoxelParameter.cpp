// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "VoxelParameter.h"

#include "Domain/ClosestRotation.h"
#include "MonotoneMap.h"
#include "Multigrid.h"
#include "PolynomialGradient.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <stdexcept>

namespace trivariate
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

namespace
{
constexpr int MostIterations = 500;

// Of the penalty that holds a parameter to its planes, in parts of what a voxel resists. Ten times
// as much takes three times as many iterations; a tenth leaves ten times as large deviations.
constexpr double Stiffness = 100.0;

// Of the trilinear energy beside that of polynomials, against the modes that these do not see.
constexpr double TrilinearShare = 0.3;

class Solver
{
public:
  Solver(const ParameterVoxels& voxels, const ParameterSurface& surface,
    const ParameterOptions& options, const Execution& execution)
    : Voxels(voxels)
    , Options(options)
    , Cells(BoxOfCells(voxels, surface))
  {
    execution.Check(0.0);
    execution.ParallelFor(3,
      [&](Index begin, Index end)
      {
        for (Index axis = begin; axis < end; ++axis)
        {
          this->Samples[axis] = SamplePlanes(this->Cells, surface, static_cast<int>(axis));
        }
      });
    std::vector<Index> sampled;
    for (const PlaneSamples& samples : this->Samples)
    {
      for (const PlaneSample& sample : samples.Samples)
      {
        sampled.push_back(sample.Cell);
      }
    }
    const bool polynomial = options.Gradient == ParameterGradient::Polynomial;
    FindCells(voxels, surface, sampled, this->Cells, execution.Part(0.3, polynomial ? 0.5 : 1.0));
    if (polynomial)
    {
      this->Polynomials =
        std::make_unique<PolynomialGradient>(this->Cells, execution.Part(0.5, 1.0));
    }
    this->Result.Low = this->Cells.Low;
    this->Result.Size = this->Cells.Size;
    this->Result.Spacing = voxels.Spacing;
    this->Result.Values.assign(3 * this->Cells.Nodes(), 0.0);
  }

  void SolveAxis(int axis, const Execution& execution)
  {
    const PlaneSamples& samples = this->Samples[axis];
    const double epsilon = this->Options.Epsilon;
    const TargetField targets =
      FillTargets(this->Cells, this->Voxels, axis, execution.Part(0.0, 0.02));
    const auto matrixFor = [&](double energy, const Execution& part)
    { return AssembleMatrix(this->Cells, samples, targets, epsilon, energy, Stiffness, part); };
    const StencilMatrix matrix = matrixFor(1.0, execution.Part(0.02, 0.04));
    std::vector<double> b = AssembleRightHandSide(
      this->Cells, targets, epsilon, matrix.Planes(), execution.Part(0.04, 0.06));
    LinearOperator times = [&matrix](const double* x, double* y, const Execution& here)
    { Multiply(matrix, x, y, here); };
    StencilMatrix held; // what is left of the trilinear energy beside the polynomials'
    if (this->Polynomials)
    {
      held = matrixFor(TrilinearShare, execution.Part(0.06, 0.08));
      for (double& value : b)
      {
        value *= TrilinearShare;
      }
      this->Polynomials->AddRightHandSide(targets, epsilon, b, execution.Part(0.08, 0.1));
      times = [&](const double* x, double* y, const Execution& here)
      {
        Multiply(held, x, y, here);
        this->Polynomials->AddEnergy(targets, epsilon, x, y, here);
      };
    }
    Multigrid multigrid(matrix, execution.Part(0.1, 0.2));
    std::vector<double> u(matrix.Length(), 0.0);
    ParameterSolve& record = this->Result.Solves[axis];
    std::vector<double>& lengths = this->Result.Lengths[axis];
    this->Result.Coordinates[axis] = samples.Coordinates;
    const LinearSolve solve = SolveConjugateGradients(
      times, multigrid, b, this->Options.Tolerance, MostIterations, u, execution.Part(0.2, 1.0));
    record.Iterations = solve.Iterations;
    record.Residual = solve.Residual;
    lengths.assign(1, 0.0);
    lengths.insert(lengths.end(), u.begin() + matrix.Nodes(), u.end());
    this->Measure(samples, u, record);
    execution.ParallelFor(this->Cells.Nodes(),
      [&](Index begin, Index end)
      {
        for (Index node = begin; node < end; ++node)
        {
          this->Result.Values[3 * node + axis] = u[node];
        }
      });
  }

  // The frames become the rotations closest to the gradients of what was solved.
  void FollowGradients(const Execution& execution)
  {
    const ParameterCells& cells = this->Cells;
    this->Followed.resize(cells.Nodes());
    ForEachSlab(cells.Size, cells.Size[2], execution,
      [&](Index k)
      {
        const Index begin = cells.NodeAt(0, 0, k);
        for (Index node = begin; node < begin + cells.Size[0] * cells.Size[1]; ++node)
        {
          if (cells.Known[node] == 2)
          {
            Matrix3d gradients;
            for (int a = 0; a < 3; ++a)
            {
              const Index step = a == 0   ? 1
                                 : a == 1 ? cells.Size[0]
                                          : cells.Size[0] * cells.Size[1];
              const double *low = &this->Result.Values[3 * (node - step)],
                           *high = &this->Result.Values[3 * (node + step)];
              for (int p = 0; p < 3; ++p)
              {
                gradients(p, a) = (high[p] - low[p]) / (2.0 * cells.Spacing[a]);
              }
            }
            this->Followed[node] = Eigen::Quaternionf(ClosestRotation(gradients).cast<float>());
          }
        }
      });
    this->Voxels.FrameAt = [this, size = this->Voxels.Size](Index id) -> Matrix3d
    {
      const Index node =
        this->Result.At({ id % size[0], id / size[0] % size[1], id / size[0] / size[1] });
      return this->Followed[node].cast<double>().toRotationMatrix();
    };
  }

  VoxelParameter Finish(const Execution& execution)
  {
    for (int axis = 0; axis < 3; ++axis)
    {
      const std::vector<double>& lengths = this->Result.Lengths[axis];
      const std::vector<int>& planes = this->Result.Coordinates[axis];
      for (std::size_t p = 1; p < planes.size(); ++p)
      {
        if (!(lengths[p] > lengths[p - 1]))
        {
          std::ostringstream message;
          message << "The cubes between "
                  << "uvw"[axis] << " = " << planes[p - 1] << " and " << planes[p] << " come out "
                  << lengths[p] - lengths[p - 1]
                  << " long: the frames were not made with these patches, or are left-handed.";
          throw std::runtime_error(message.str());
        }
      }
      const MonotoneMap map(lengths, std::vector<double>(planes.begin(), planes.end()));
      const std::array<Index, 3>& size = this->Cells.Size;
      ForEachSlab(size, size[2], execution.Part(axis / 3.0, (axis + 1) / 3.0),
        [&](Index k)
        {
          const Index begin = this->Cells.NodeAt(0, 0, k);
          for (Index node = begin; node < begin + size[0] * size[1]; ++node)
          {
            double& value = this->Result.Values[3 * node + axis];
            value = this->Cells.Known[node] == 0 ? 0.0 : map(value);
          }
        });
    }
    this->Result.Known = std::move(this->Cells.Known);
    return std::move(this->Result);
  }

private:
  void Measure(const PlaneSamples& samples, const std::vector<double>& u, ParameterSolve& record)
  {
    record.Deviation = 0.0;
    double squares = 0.0, weights = 0.0;
    const std::vector<double> deviations = DeviationsAt(this->Cells, samples, u);
    for (std::size_t s = 0; s < deviations.size(); ++s)
    {
      record.Deviation = std::max(record.Deviation, std::abs(deviations[s]));
      squares += samples.Samples[s].Weight * deviations[s] * deviations[s];
      weights += samples.Samples[s].Weight;
    }
    record.MeanDeviation = std::sqrt(squares / weights);
  }

  ParameterVoxels Voxels;
  const ParameterOptions& Options;
  ParameterCells Cells;
  std::array<PlaneSamples, 3> Samples;
  std::unique_ptr<PolynomialGradient> Polynomials;
  std::vector<Eigen::Quaternionf> Followed;
  VoxelParameter Result;
};
}

//------------------------------------------------------------------------------
VoxelParameter SolveVoxelParameter(const ParameterVoxels& voxels, const ParameterSurface& surface,
  const ParameterOptions& options, const Execution& execution)
{
  if (!(options.Epsilon > 0.0 && options.Epsilon <= 1.0))
  {
    throw std::invalid_argument(
      "Epsilon is " + std::to_string(options.Epsilon) + "; it must be above 0 and at most 1.");
  }
  if (!(options.Tolerance >= 1e-14 && options.Tolerance <= 0.1))
  {
    throw std::invalid_argument(
      "Tolerance is " + std::to_string(options.Tolerance) + "; it must be from 1e-14 to 0.1.");
  }
  if (options.Rounds < 0)
  {
    throw std::invalid_argument("There cannot be " + std::to_string(options.Rounds) + " rounds.");
  }
  Solver solver(voxels, surface, options, execution.Part(0.0, 0.05));
  const double share = 0.93 / (3.0 * (options.Rounds + 1));
  for (int step = 0; step < 3 * (options.Rounds + 1); ++step)
  {
    const Execution part = execution.Part(0.05 + share * step, 0.05 + share * (step + 1));
    if (step > 0 && step % 3 == 0)
    {
      solver.FollowGradients(part.Part(0.0, 0.1));
    }
    solver.SolveAxis(step % 3, part.Part(0.1, 1.0));
  }
  return solver.Finish(execution.Part(0.98, 1.0));
}

//------------------------------------------------------------------------------
Index VoxelParameter::At(const std::array<Index, 3>& voxel) const
{
  Index at[3];
  for (int a = 0; a < 3; ++a)
  {
    at[a] = voxel[a] - this->Low[a];
    if (at[a] < 0 || at[a] >= this->Size[a])
    {
      return -1;
    }
  }
  return at[0] + this->Size[0] * (at[1] + this->Size[1] * at[2]);
}

//------------------------------------------------------------------------------
bool VoxelParameter::Evaluate(const Vector3d& point, Vector3d& value, Matrix3d* gradient) const
{
  Index low[3];
  double local[3];
  for (int a = 0; a < 3; ++a)
  {
    const double place = point[a] / this->Spacing[a] - static_cast<double>(this->Low[a]);
    if (!(place >= 0.0 && place < static_cast<double>(this->Size[a] - 1)))
    {
      return false;
    }
    low[a] = static_cast<Index>(place);
    local[a] = place - static_cast<double>(low[a]);
  }
  value.setZero();
  Matrix3d sum = Matrix3d::Zero();
  for (int c = 0; c < 8; ++c)
  {
    const Index node =
      low[0] + (c & 1) +
      this->Size[0] * (low[1] + (c >> 1 & 1) + this->Size[1] * (low[2] + (c >> 2)));
    if (this->Known[node] == 0)
    {
      return false;
    }
    Vector3d weight, slope;
    for (int a = 0; a < 3; ++a)
    {
      const bool high = (c >> a & 1) != 0;
      weight[a] = high ? local[a] : 1.0 - local[a];
      slope[a] = (high ? 1.0 : -1.0) / this->Spacing[a];
    }
    const Vector3d corner = Eigen::Map<const Vector3d>(&this->Values[3 * node]);
    value += weight.prod() * corner;
    sum += corner * Vector3d(slope[0] * weight[1] * weight[2], weight[0] * slope[1] * weight[2],
                      weight[0] * weight[1] * slope[2])
                      .transpose();
  }
  if (gradient)
  {
    *gradient = sum;
  }
  return true;
}

//------------------------------------------------------------------------------
ParameterFolds CountFolds(
  const VoxelParameter& solved, double orientation, const Execution& execution)
{
  const std::array<Index, 3>& size = solved.Size;
  const double toPoint = 0.5 / std::sqrt(3.0); // from the middle of a cell
  std::vector<ParameterFolds> ofLayer(size[2]);
  const auto isFolded = [&](const Vector3d& low)
  {
    for (int point = 0; point < 8; ++point)
    {
      Vector3d at = low, value;
      Matrix3d gradient;
      for (int a = 0; a < 3; ++a)
      {
        at[a] += 0.5 + ((point >> a & 1) != 0 ? toPoint : -toPoint);
      }
      solved.Evaluate(at.cwiseProduct(solved.Spacing), value, &gradient);
      if (!(gradient.determinant() * orientation > 0.0))
      {
        return true;
      }
    }
    return false;
  };
  execution.ParallelFor(size[2] - 1,
    [&](Index begin, Index end)
    {
      for (Index k = begin; k < end; ++k)
      {
        for (Index j = 0; j + 1 < size[1]; ++j)
        {
          for (Index i = 0; i + 1 < size[0]; ++i)
          {
            bool isWhole = true;
            for (int c = 0; c < 8; ++c)
            {
              const Index node =
                i + (c & 1) + size[0] * (j + (c >> 1 & 1) + size[1] * (k + (c >> 2)));
              isWhole = isWhole && solved.Known[node] == KnownInSegment;
            }
            if (isWhole)
            {
              ++ofLayer[k].Cells;
              ofLayer[k].Folded += isFolded(Vector3d(
                double(i + solved.Low[0]), double(j + solved.Low[1]), double(k + solved.Low[2])));
            }
          }
        }
      }
    });
  ParameterFolds sum;
  for (const ParameterFolds& layer : ofLayer)
  {
    sum.Cells += layer.Cells;
    sum.Folded += layer.Folded;
  }
  return sum;
}
}
