// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "ShapeJacobian.h"

#include "TSpline/BezierExtraction.h"
#include "TSpline/BezierKernels.h"
#include "TSpline/Evaluator.h"

#include <Eigen/Dense>

#include <algorithm>
#include <limits>

namespace trivariate
{
namespace
{
constexpr int N = 9; // coefficients of a polynomial of degree 8
using Matrix9 = Eigen::Matrix<double, N, N>;
using Coefficients = std::vector<double>; // N^3, u fastest

// Bernstein polynomials of degree 8 at s, by their recurrence.
Eigen::Matrix<double, 1, N> BernsteinRow(double s)
{
  Eigen::Matrix<double, 1, N> b = Eigen::Matrix<double, 1, N>::Zero();
  b[0] = 1.0;
  for (int degree = 1; degree < N; ++degree)
  {
    for (int i = degree; i >= 0; --i)
    {
      b[i] = (1.0 - s) * (i < degree ? b[i] : 0.0) + s * (i > 0 ? b[i - 1] : 0.0);
    }
  }
  return b;
}

// From values at i / 8 to Bernstein coefficients.
Matrix9 InverseCollocation()
{
  Matrix9 values;
  for (int i = 0; i < N; ++i)
  {
    values.row(i) = BernsteinRow(i / (N - 1.0));
  }
  return values.inverse();
}

// From the coefficients on [0, 1] to those on [0, 1/2]: de Casteljau's triangle.
Matrix9 LowerHalf()
{
  Matrix9 half = Matrix9::Zero();
  for (int i = 0; i < N; ++i)
  {
    double choose = 1.0;
    for (int j = 0; j <= i; ++j)
    {
      half(i, j) = choose / (1 << i);
      choose = choose * (i - j) / (j + 1);
    }
  }
  return half;
}

// Applies a matrix along direction a.
Coefficients Along(int a, const Matrix9& matrix, const Coefficients& in)
{
  const int step = a == 0 ? 1 : a == 1 ? N : N * N;
  Coefficients out(in.size());
  for (int line = 0; line < N * N; ++line)
  {
    const int begin = a == 0 ? line * N : a == 1 ? line / N * N * N + line % N : line;
    using Line = Eigen::Map<const Eigen::Matrix<double, N, 1>, 0, Eigen::InnerStride<>>;
    using OutLine = Eigen::Map<Eigen::Matrix<double, N, 1>, 0, Eigen::InnerStride<>>;
    OutLine(&out[begin], Eigen::InnerStride<>(step)).noalias() =
      matrix * Line(&in[begin], Eigen::InnerStride<>(step));
  }
  return out;
}

// Whether all coefficients, or those on all parts after so many halvings, are positive.
bool IsPositive(const Coefficients& c, int halvings)
{
  if (*std::min_element(c.begin(), c.end()) > 0.0)
  {
    return true;
  }
  if (halvings == 0)
  {
    return false;
  }
  static const Matrix9 lower = LowerHalf(), upper = lower.reverse();
  for (int part = 0; part < 8; ++part)
  {
    Coefficients half = c;
    for (int a = 0; a < 3; ++a)
    {
      half = Along(a, part >> a & 1 ? upper : lower, half);
    }
    if (!IsPositive(half, halvings - 1))
    {
      return false;
    }
  }
  return true;
}

constexpr int FinePoints = 33; // an axis, where nothing is proven

// The determinant at `points` a direction of a cell, the ends among them, u fastest.
std::vector<double> DeterminantsAt(
  int points, const std::array<double, 6>& box, const double* bezier)
{
  std::vector<BernsteinJet<1>> jets[3];
  for (int a = 0; a < 3; ++a)
  {
    for (int i = 0; i < points; ++i)
    {
      jets[a].emplace_back(i / (points - 1.0), 1.0 / (box[2 * a + 1] - box[2 * a]));
    }
  }
  std::vector<double> values(points * points * points);
  for (std::size_t m = 0; m < values.size(); ++m)
  {
    double gradients[9];
    for (int c = 0; c < 3; ++c)
    {
      double jet[4];
      PolynomialJet<1>(&bezier[64 * c], jets[0][m % points], jets[1][m / points % points],
        jets[2][m / (points * points)], jet);
      std::copy_n(jet + 1, 3, gradients + 3 * c);
    }
    values[m] = JacobianDeterminant(gradients);
  }
  return values;
}
}

//------------------------------------------------------------------------------
std::vector<CellJacobian> BoundJacobian(
  const TSpline& spline, const BezierMesh& mesh, const Execution& execution)
{
  const std::vector<double> bezier = ExtractBezier(spline, mesh, { 0, 1, 2 }, execution);
  const Matrix9 toCoefficients = InverseCollocation();
  std::vector<CellJacobian> bounds(mesh.Size());
  constexpr Index Batch = 1 << 11; // between two looks at the abort flag
  for (Index first = 0; first < mesh.Size(); first += Batch)
  {
    execution.Check(static_cast<double>(first) / mesh.Size());
    execution.ParallelFor(std::min(Batch, mesh.Size() - first),
      [&, first](Index begin, Index end)
      {
        for (Index cell = first + begin; cell < first + end; ++cell)
        {
          const auto box = mesh.Bounds(cell);
          Coefficients values = DeterminantsAt(N, box, &bezier[192 * cell]);
          bounds[cell].Sampled = *std::min_element(values.begin(), values.end());
          if (bounds[cell].Sampled > 0.0)
          {
            for (int a = 0; a < 3; ++a)
            {
              values = Along(a, toCoefficients, values);
            }
            bounds[cell].Certified = IsPositive(values, 2);
          }
          if (!bounds[cell].Certified)
          {
            values = DeterminantsAt(FinePoints, box, &bezier[192 * cell]);
            bounds[cell].Sampled = *std::min_element(values.begin(), values.end());
          }
        }
      });
  }
  return bounds;
}

//------------------------------------------------------------------------------
std::pair<double, double> JacobianAt(const TSpline& spline, const BezierMesh& mesh,
  const std::vector<double>& parameters, const Execution& execution)
{
  const auto n = static_cast<Index>(parameters.size() / 3);
  const Evaluator evaluator(spline, mesh, { 0, 1, 2 }, execution);
  std::vector<double> gradients(9 * n);
  EvaluatorOutput output;
  output.Gradients = gradients.data();
  evaluator.Evaluate(n, parameters.data(), output, execution);
  double sum = 0.0, least = std::numeric_limits<double>::max();
  for (Index i = 0; i < n; ++i)
  {
    const double determinant = JacobianDeterminant(&gradients[9 * i]);
    sum += determinant;
    least = std::min(least, determinant);
  }
  return { least, sum / static_cast<double>(n) };
}

//------------------------------------------------------------------------------
ShapeFolds FindFolds(
  const TSpline& spline, const std::vector<double>& parameters, const Execution& execution)
{
  const BezierMesh mesh(spline, execution);
  auto [least, mean] = JacobianAt(spline, mesh, parameters, execution);
  ShapeFolds folds;
  folds.Cells = mesh.Size();
  for (const CellJacobian& cell : BoundJacobian(spline, mesh, execution))
  {
    least = std::min(least, cell.Sampled);
    folds.Folded += cell.Sampled <= 0.0;
    folds.Certified += cell.Certified;
  }
  folds.SmallestJacobian = least / mean;
  return folds;
}
}
