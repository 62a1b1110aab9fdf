// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Tricubic polynomials in Bernstein form: value and derivatives, and those of a quotient of two.
 *
 * A jet is a value and its derivatives up to Order, in the order
 *   f | fu fv fw | fuu fvv fww fuv fvw fuw.
 */
#ifndef trivariate_BezierKernels_h
#define trivariate_BezierKernels_h

#include "TargetClones.h"

namespace trivariate
{
/// Numbers in a jet.
template <int Order>
constexpr int JetSize = Order == 0   ? 1
                        : Order == 1 ? 4
                                     : 10;

/// The derivatives (du, dv, dw) that a jet holds, in its order.
constexpr int JetDerivatives[10][3] = { { 0, 0, 0 }, { 1, 0, 0 }, { 0, 1, 0 }, { 0, 0, 1 },
  { 2, 0, 0 }, { 0, 2, 0 }, { 0, 0, 2 }, { 1, 1, 0 }, { 0, 1, 1 }, { 1, 0, 1 } };

/// The cubic Bernstein polynomials [0] and their first [1] and second [2] derivatives at a
/// parameter.
template <int Order>
struct BernsteinJet
{
  double B[Order + 1][4];

  /// At s in [0, 1] of an interval of the width 1 / inverseWidth.
  TRIVARIATE_INLINE BernsteinJet(double s, double inverseWidth)
  {
    const double r = 1.0 - s;
    this->B[0][0] = r * r * r;
    this->B[0][1] = 3.0 * r * r * s;
    this->B[0][2] = 3.0 * r * s * s;
    this->B[0][3] = s * s * s;
    if constexpr (Order > 0)
    {
      const double q = 3.0 * inverseWidth;
      this->B[1][0] = -q * r * r;
      this->B[1][1] = q * r * (r - 2.0 * s);
      this->B[1][2] = q * s * (2.0 * r - s);
      this->B[1][3] = q * s * s;
    }
    if constexpr (Order > 1)
    {
      const double q = 6.0 * inverseWidth * inverseWidth;
      this->B[2][0] = q * r;
      this->B[2][1] = q * (s - 2.0 * r);
      this->B[2][2] = q * (r - 2.0 * s);
      this->B[2][3] = q * s;
    }
  }
};

/// out[i] = sum over k of b[k] c[k N + i]: contracts the slowest direction.
template <int N>
TRIVARIATE_INLINE void Contract(const double* b, const double* c, double* out)
{
  for (int i = 0; i < N; ++i)
  {
    out[i] = b[0] * c[i] + b[1] * c[N + i] + b[2] * c[2 * N + i] + b[3] * c[3 * N + i];
  }
}

/// The contractions over w, for each derivative in w.
template <int Order>
struct ContractedW
{
  double A[Order + 1][16];

  TRIVARIATE_INLINE void Set(const double* c, const BernsteinJet<Order>& w)
  {
    for (int dw = 0; dw <= Order; ++dw)
    {
      Contract<16>(w.B[dw], c, this->A[dw]);
    }
  }
};

/// The contractions over w and v, for each derivative in v and w.
template <int Order>
struct ContractedVW
{
  double A[Order + 1][Order + 1][4];

  TRIVARIATE_INLINE void Set(const ContractedW<Order>& c, const BernsteinJet<Order>& v)
  {
    for (int dv = 0; dv <= Order; ++dv)
    {
      for (int dw = 0; dv + dw <= Order; ++dw)
      {
        Contract<4>(v.B[dv], c.A[dw], this->A[dv][dw]);
      }
    }
  }
};

/// The jet of the polynomial with the coefficients c (u fastest).
template <int Order>
TRIVARIATE_INLINE void PolynomialJet(const double* c, const BernsteinJet<Order>& u,
  const BernsteinJet<Order>& v, const BernsteinJet<Order>& w, double* jet)
{
  ContractedW<Order> plane;
  plane.Set(c, w);
  ContractedVW<Order> row;
  row.Set(plane, v);
  for (int n = 0; n < JetSize<Order>; ++n)
  {
    const auto& d = JetDerivatives[n];
    const double* b = u.B[d[0]];
    const double* a = row.A[d[1]][d[2]];
    jet[n] = (b[0] * a[0] + b[1] * a[1]) + (b[2] * a[2] + b[3] * a[3]);
  }
}

/// The jet of a quotient from the jets of numerator (overwritten) and denominator.
template <int Order>
TRIVARIATE_INLINE void QuotientJet(double* n, const double* d)
{
  const double inverse = 1.0 / d[0];
  n[0] *= inverse;
  if constexpr (Order > 0)
  {
    for (int a = 1; a < 4; ++a)
    {
      n[a] = (n[a] - n[0] * d[a]) * inverse;
    }
  }
  if constexpr (Order > 1)
  {
    constexpr int First[6] = { 1, 2, 3, 1, 2, 1 };
    constexpr int Second[6] = { 1, 2, 3, 2, 3, 3 };
    for (int m = 0; m < 6; ++m)
    {
      const int a = First[m], b = Second[m];
      n[4 + m] = (n[4 + m] - n[a] * d[b] - n[b] * d[a] - n[0] * d[4 + m]) * inverse;
    }
  }
}
}

#endif
