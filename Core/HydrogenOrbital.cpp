// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HydrogenOrbital.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr double Pi = 3.14159265358979323846;

double Factorial(int n)
{
  return n < 2 ? 1.0 : n * Factorial(n - 1);
}

double Square(double x)
{
  return x * x;
}

// Associated Laguerre polynomial L_k^a(x).
double Laguerre(int k, int a, double x)
{
  double previous = 0.0, value = 1.0;
  for (int i = 0; i < k; ++i)
  {
    const double next = ((2 * i + 1 + a - x) * value - (i + a) * previous) / (i + 1);
    previous = value;
    value = next;
  }
  return value;
}

// Associated Legendre function P_l^m(x), m >= 0, without the sign (-1)^m.
double Legendre(int l, int m, double x)
{
  const double sine = std::sqrt(std::max(0.0, 1.0 - x * x));
  double previous = 0.0, value = 1.0;
  for (int i = 1; i <= m; ++i)
  {
    value *= (2 * i - 1) * sine;
  }
  for (int i = m + 1; i <= l; ++i)
  {
    const double next = ((2 * i - 1) * x * value - (i + m - 1) * previous) / (i - m);
    previous = value;
    value = next;
  }
  return value;
}

// Largest value of f on [a, b]: the best of a dense row of samples, then golden section around it.
template <typename Function>
double Maximum(const Function& f, double a, double b)
{
  constexpr int samples = 4096;
  const double step = (b - a) / samples;
  int best = 0;
  for (int i = 1; i <= samples; ++i)
  {
    if (f(a + i * step) > f(a + best * step))
    {
      best = i;
    }
  }
  double low = std::max(a, a + (best - 1) * step), high = std::min(b, a + (best + 1) * step);
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  for (int i = 0; i < 40; ++i)
  {
    const double left = high - golden * (high - low), right = low + golden * (high - low);
    if (f(left) < f(right))
    {
      low = left;
    }
    else
    {
      high = right;
    }
  }
  // The end of the interval may be the maximum itself (the nucleus, the pole).
  return std::max({ f(0.5 * (low + high)), f(a), f(b) });
}
}

std::string HydrogenOrbital::Validate(int n, int l, int m)
{
  if (n < 1 || n > MaximumN)
  {
    return "The principal quantum number n is " + std::to_string(n) + "; it must be 1 to " +
           std::to_string(MaximumN) + ".";
  }
  if (l < 0 || l >= n)
  {
    return "The quantum number l is " + std::to_string(l) + "; with n = " + std::to_string(n) +
           " it must be 0 to " + std::to_string(n - 1) + ".";
  }
  if (std::abs(m) > l)
  {
    return "The quantum number m is " + std::to_string(m) + "; with l = " + std::to_string(l) +
           " it must be " + std::to_string(-l) + " to " + std::to_string(l) + ".";
  }
  return {};
}

HydrogenOrbital::HydrogenOrbital(int n, int l, int m, OrbitalForm form)
  : N(n)
  , L(l)
  , M(m)
  , Form(form)
{
  const std::string fault = Validate(n, l, m);
  if (!fault.empty())
  {
    throw std::invalid_argument(fault);
  }
  const double scale = 2.0 / n;
  this->RadialFactor = scale * scale * scale * Factorial(n - l - 1) / (2.0 * n * Factorial(n + l));
  const int am = std::abs(m);
  this->PolarFactor = (2 * l + 1) / (4.0 * Pi) * Factorial(l - am) / Factorial(l + am);
}

double HydrogenOrbital::Radial(double r) const
{
  const double rho = 2.0 * r / this->N;
  return this->RadialFactor * std::exp(-rho) *
         Square(std::pow(rho, this->L) * Laguerre(this->N - this->L - 1, 2 * this->L + 1, rho));
}

double HydrogenOrbital::Polar(double cosine) const
{
  return this->PolarFactor * Square(Legendre(this->L, std::abs(this->M), cosine));
}

double HydrogenOrbital::Azimuthal(double x, double y) const
{
  if (this->Form == OrbitalForm::Complex || this->M == 0)
  {
    return 1.0;
  }
  const double angle = this->M * std::atan2(y, x);
  return 2.0 * Square(this->M > 0 ? std::cos(angle) : std::sin(angle));
}

double HydrogenOrbital::Density(double x, double y, double z) const
{
  const double r = std::sqrt(x * x + y * y + z * z);
  return this->Radial(r) * this->Polar(r > 0.0 ? z / r : 1.0) * this->Azimuthal(x, y);
}

double HydrogenOrbital::MaximumDensity() const
{
  const double radial =
    Maximum([this](double r) { return this->Radial(r); }, 0.0, DefaultHalfWidth(this->N));
  const double polar = Maximum([this](double c) { return this->Polar(c); }, 0.0, 1.0);
  return radial * polar * (this->Form == OrbitalForm::Real && this->M != 0 ? 2.0 : 1.0);
}
}
