// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Products with the matrix of all functions at all samples, and with its transpose.
#include "ScatteredSystem.h"

#include "TSpline/BezierKernels.h"

#include <cmath>

namespace trivariate
{
namespace
{
// moments of column c += factors[c] * u x v x w.
TRIVARIATE_CLONES void AddProducts(
  int columns, const double* factors, const std::array<BernsteinForm, 3>& b, double* moments)
{
  double product[64];
  for (int k = 0; k < 4; ++k)
  {
    for (int j = 0; j < 4; ++j)
    {
      const double vw = b[2][k] * b[1][j];
      for (int i = 0; i < 4; ++i)
      {
        product[16 * k + 4 * j + i] = vw * b[0][i];
      }
    }
  }
  for (int c = 0; c < columns; ++c)
  {
    for (int m = 0; m < 64; ++m)
    {
      moments[64 * c + m] += factors[c] * product[m];
    }
  }
}

// The polynomials of all columns.
TRIVARIATE_CLONES void EvaluateProducts(
  int columns, const double* bezier, const std::array<BernsteinForm, 3>& b, double* values)
{
  for (int c = 0; c < columns; ++c)
  {
    double plane[16], line[4];
    Contract<16>(b[2].data(), bezier + 64 * c, plane);
    Contract<4>(b[1].data(), plane, line);
    Contract<1>(b[0].data(), line, &values[c]);
  }
}

// sums[i] += the sum against function i of the cell, for all of its functions.
void AddFunctionSums(const CellBasis& basis, const Moments64& moments, double* sums)
{
  const IdRange active = basis.Active();
  double plane[16], line[4] = {};
  int w = -1, v = -1;
  for (Index n = 0; n < active.size(); ++n)
  {
    const std::array<int, 3>& number = basis.Numbers[n];
    if (number[2] != w)
    {
      w = number[2];
      v = -1;
      ContractLast<16>(basis.Forms[2][w], moments.data(), plane);
    }
    if (number[1] != v)
    {
      v = number[1];
      ContractLast<4>(basis.Forms[1][v], plane, line);
    }
    double sum;
    ContractLast<1>(basis.Forms[0][number[0]], line, &sum);
    sums[active.First[n]] += sum;
  }
}
}

//------------------------------------------------------------------------------
// The negative gradient of the cell's fairness, as sums against its Bernstein polynomials.
void ScatteredSystem::AddFairness(Index cell, int component, Moments64& moments) const
{
  if (this->Fairness[cell] == 0.0f)
  {
    return;
  }
  const double* bezier = &this->Bezier[64 * (cell * this->Samples.Components + component)];
  VisitSecondDerivatives(
    [&](const std::array<BernsteinForm, 3>& d)
    {
      double plane[16], line[4], value;
      ContractLast<16>(d[2], bezier, plane);
      ContractLast<4>(d[1], plane, line);
      ContractLast<1>(d[0], line, &value);
      AddProduct(-this->Fairness[cell] * value, d[0], d[1], d[2], moments);
    });
}

//------------------------------------------------------------------------------
// The sums over samples of `values(at)` of each in Sorted, times its weight, and a function, for
// each column; addTo(cell, moments) may add to the sums against the Bernstein polynomials of a
// cell.
template <typename Values, typename Add>
ColumnsOfPoints ScatteredSystem::SumOverSamples(
  int columns, const Values& values, const Add& addTo) const
{
  const BezierMesh& mesh = *this->Cells;
  const Index functions = static_cast<Index>(this->Shared.PointOf.size());
  const std::vector<double> ofFunctions = SumOfParts(mesh.Size(), columns * functions, this->Run,
    [&](Index first, Index last, std::vector<double>& sums)
    {
      CellBasis basis(mesh);
      std::vector<Moments64> moments(columns);
      for (Index k = first; k < last; ++k)
      {
        const Index cell = this->Order[k];
        if (this->IsEmpty(cell))
        {
          continue;
        }
        basis.SetCell(cell);
        std::fill(moments.begin(), moments.end(), Moments64{});
        for (Index at = this->SampleBegin[cell]; at < this->SampleBegin[cell + 1]; ++at)
        {
          const Index sample = this->Sorted[at];
          const auto b = basis.BernsteinAt(&this->Samples.Parameters[3 * sample]);
          double factors[MostColumns];
          values(at, factors);
          for (int c = 0; c < columns; ++c)
          {
            factors[c] *= this->WeightOf(sample);
          }
          AddProducts(columns, factors, b, moments[0].data());
        }
        for (int c = 0; c < columns; ++c)
        {
          addTo(cell, moments[c]);
          AddFunctionSums(basis, moments[c], &sums[c * functions]);
        }
      }
    });
  ColumnsOfPoints sums = ColumnsOfPoints::Zero(this->Shared.Count(), columns);
  for (int c = 0; c < columns; ++c)
  {
    for (Index i = 0; i < functions; ++i)
    {
      sums(this->Shared.PointOf[i], c) += ofFunctions[c * functions + i];
    }
  }
  return sums;
}

//------------------------------------------------------------------------------
std::vector<double> ScatteredSystem::Gradient(int component) const
{
  const ColumnsOfPoints sums = this->SumOverSamples(
    1, [&](Index at, double* value) { *value = this->Residuals[component][at]; },
    [&](Index cell, Moments64& moments) { this->AddFairness(cell, component, moments); });
  return { sums.data(), sums.data() + sums.size() };
}

//------------------------------------------------------------------------------
ColumnsOfPoints ScatteredSystem::SumsOf(const ColumnsOfSamples& values) const
{
  const int columns = static_cast<int>(values.rows());
  return this->SumOverSamples(
    columns,
    [&](Index at, double* out) { std::copy_n(values.col(this->Sorted[at]).data(), columns, out); },
    [](Index, Moments64&) {});
}

//------------------------------------------------------------------------------
ColumnsOfSamples ScatteredSystem::ValuesOf(const ColumnsOfPoints& coefficients) const
{
  const BezierMesh& mesh = *this->Cells;
  const int columns = static_cast<int>(coefficients.cols());
  ColumnsOfSamples values(columns, this->Samples.Count());
  this->Run.ParallelFor(mesh.Size(),
    [&](Index begin, Index end)
    {
      CellBasis basis(mesh);
      std::vector<Moments64> bezier(columns);
      for (Index cell = begin; cell < end; ++cell)
      {
        if (this->SampleBegin[cell] == this->SampleBegin[cell + 1])
        {
          continue;
        }
        basis.SetCell(cell);
        std::fill(bezier.begin(), bezier.end(), Moments64{});
        const IdRange active = basis.Active();
        for (Index n = 0; n < active.size(); ++n)
        {
          const auto& [u, v, w] = basis.Numbers[n];
          double factors[MostColumns];
          for (int c = 0; c < columns; ++c)
          {
            factors[c] = coefficients(this->Shared.PointOf[active.First[n]], c);
          }
          AddProducts(columns, factors, { basis.Forms[0][u], basis.Forms[1][v], basis.Forms[2][w] },
            bezier[0].data());
        }
        for (Index at = this->SampleBegin[cell]; at < this->SampleBegin[cell + 1]; ++at)
        {
          const Index sample = this->Sorted[at];
          const auto b = basis.BernsteinAt(&this->Samples.Parameters[3 * sample]);
          EvaluateProducts(columns, bezier[0].data(), b, values.col(sample).data());
        }
      }
    });
  return values;
}

//------------------------------------------------------------------------------
std::vector<double> ScatteredSystem::ResidualsOf(int component) const
{
  std::vector<double> residuals(this->Samples.Count());
  for (std::size_t at = 0; at < this->Sorted.size(); ++at)
  {
    residuals[this->Sorted[at]] = this->Residuals[component][at];
  }
  return residuals;
}

//------------------------------------------------------------------------------
// Which of the `step`: by the golden ratio, for samples of a cell come in rows.
std::vector<Index> ScatteredSystem::EveryOnce(Index step) const
{
  constexpr double GoldenRatio = 0.6180339887498949;
  std::vector<Index> samples;
  for (Index first = 0; first < this->Samples.Count(); first += step)
  {
    const double turn = GoldenRatio * static_cast<double>(samples.size());
    const Index at = first + static_cast<Index>(step * (turn - std::floor(turn)));
    samples.push_back(this->Sorted[std::min(at, this->Samples.Count() - 1)]);
  }
  return samples;
}
}
