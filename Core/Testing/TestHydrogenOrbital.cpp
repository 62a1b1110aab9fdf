// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "HydrogenOrbital.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <stdexcept>

namespace
{
using trivariate::HydrogenOrbital;
using trivariate::OrbitalForm;

const double Pi = std::acos(-1.0);

// All orbitals of all forms up to principal quantum number `last`.
template <typename Body>
void ForEachOrbital(int last, const Body& body)
{
  for (int n = 1; n <= last; ++n)
  {
    for (int l = 0; l < n; ++l)
    {
      for (int m = -l; m <= l; ++m)
      {
        body(n, l, m, HydrogenOrbital(n, l, m, OrbitalForm::Complex));
        body(n, l, m, HydrogenOrbital(n, l, m, OrbitalForm::Real));
      }
    }
  }
}

TEST(HydrogenOrbital, EqualsTextbookFormulas)
{
  const HydrogenOrbital s1(1, 0, 0), s2(2, 0, 0), p0(2, 1, 0), p1(2, 1, 1), d0(3, 2, 0);
  const HydrogenOrbital px(2, 1, 1, OrbitalForm::Real), py(2, 1, -1, OrbitalForm::Real);
  const HydrogenOrbital dxy(3, 2, -2, OrbitalForm::Real);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> coordinate(-6.0, 6.0);
  for (int i = 0; i < 1000; ++i)
  {
    const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
    const double r = std::sqrt(x * x + y * y + z * z);
    const auto expect = [x, y, z](const HydrogenOrbital& orbital, double value)
    { EXPECT_NEAR(orbital.Density(x, y, z), value, 1e-13 * value + 1e-17); };
    expect(s1, std::exp(-2.0 * r) / Pi);
    expect(s2, (2.0 - r) * (2.0 - r) * std::exp(-r) / (32.0 * Pi));
    expect(p0, z * z * std::exp(-r) / (32.0 * Pi));
    expect(p1, (x * x + y * y) * std::exp(-r) / (64.0 * Pi));
    expect(px, x * x * std::exp(-r) / (32.0 * Pi));
    expect(py, y * y * std::exp(-r) / (32.0 * Pi));
    const double d = 3.0 * z * z - r * r;
    expect(d0, d * d * std::exp(-2.0 * r / 3.0) / (39366.0 * Pi));
    expect(dxy, 2.0 * x * x * y * y * std::exp(-2.0 * r / 3.0) / (6561.0 * Pi));
  }
}

// Midpoint rule in r and phi, and in cos(theta): the angular part is a polynomial of degree 2 l.
TEST(HydrogenOrbital, IntegratesToOne)
{
  const int steps = 4000, rings = 1600, sectors = 16;
  ForEachOrbital(5,
    [](int n, int l, int m, const HydrogenOrbital& orbital)
    {
      const double end = 3.0 * HydrogenOrbital::DefaultHalfWidth(n);
      // The density is a product of functions of r, theta and phi: three sums, not one triple sum.
      const double r0 = 0.37 * n * n, theta0 = 1.1, phi0 = 0.23;
      const auto at = [&orbital](double r, double theta, double phi)
      {
        return orbital.Density(r * std::sin(theta) * std::cos(phi),
          r * std::sin(theta) * std::sin(phi), r * std::cos(theta));
      };
      double radial = 0.0, polar = 0.0, azimuthal = 0.0;
      for (int i = 0; i < steps; ++i)
      {
        const double r = (i + 0.5) * end / steps;
        radial += at(r, theta0, phi0) * r * r * end / steps;
      }
      for (int i = 0; i < rings; ++i)
      {
        polar += at(r0, std::acos(-1.0 + (i + 0.5) * 2.0 / rings), phi0) * 2.0 / rings;
      }
      for (int i = 0; i < sectors; ++i)
      {
        azimuthal += at(r0, theta0, (i + 0.5) * 2.0 * Pi / sectors) * 2.0 * Pi / sectors;
      }
      const double product = at(r0, theta0, phi0);
      EXPECT_NEAR(radial * polar * azimuthal / (product * product), 1.0, 1e-4)
        << n << " " << l << " " << m;
    });
}

TEST(HydrogenOrbital, HasTheRightNumberOfNodes)
{
  ForEachOrbital(8,
    [](int n, int l, int m, const HydrogenOrbital& orbital)
    {
      // Along a ray that meets no angular node the square touches zero n - l - 1 times.
      const double direction[3] = { 0.31, 0.17, 0.935 };
      int minima = 0;
      double before = 0.0, last = 0.0;
      const double step = 1e-3 * n;
      for (double r = step; r < HydrogenOrbital::DefaultHalfWidth(n); r += step)
      {
        const double now = orbital.Density(r * direction[0], r * direction[1], r * direction[2]);
        minima += last < before && last < now;
        before = last;
        last = now;
      }
      EXPECT_EQ(minima, n - l - 1) << n << " " << l << " " << m;
    });
}

TEST(HydrogenOrbital, ComplexFormIsSymmetricAboutTheAxis)
{
  std::mt19937 random(2);
  std::uniform_real_distribution<double> coordinate(-8.0, 8.0), angle(0.0, 2.0 * Pi);
  ForEachOrbital(4,
    [&](int n, int l, int m, const HydrogenOrbital& orbital)
    {
      const double x = coordinate(random), y = coordinate(random), z = coordinate(random);
      const double value = orbital.Density(x, y, z);
      EXPECT_NEAR(orbital.Density(x, y, -z), value, 1e-12 * value);
      EXPECT_NEAR(orbital.Density(-x, -y, z), value, 1e-12 * value);
      const HydrogenOrbital turned(n, l, -m), complex(n, l, m);
      const double a = angle(random), c = std::cos(a), s = std::sin(a);
      const double expected = complex.Density(x, y, z);
      EXPECT_NEAR(complex.Density(c * x - s * y, s * x + c * y, z), expected, 1e-11 * expected);
      EXPECT_EQ(turned.Density(x, y, z), expected);
      // A sum rule: cos^2 + sin^2 of the two real forms.
      const HydrogenOrbital plus(n, l, m, OrbitalForm::Real), minus(n, l, -m, OrbitalForm::Real);
      EXPECT_NEAR(
        0.5 * (plus.Density(x, y, z) + minus.Density(x, y, z)), expected, 1e-12 * expected);
    });
}

TEST(HydrogenOrbital, MaximumIsReachedAndNeverExceeded)
{
  EXPECT_NEAR(HydrogenOrbital(1, 0, 0).MaximumDensity(), 1.0 / Pi, 1e-14);
  // 2p: z^2 exp(-r) is largest at z = r = 2.
  EXPECT_NEAR(HydrogenOrbital(2, 1, 0).MaximumDensity(), std::exp(-2.0) / (8.0 * Pi), 1e-12);
  std::mt19937 random(3);
  ForEachOrbital(6,
    [&random](int n, int l, int m, const HydrogenOrbital& orbital)
    {
      std::normal_distribution<double> coordinate(0.0, n * n);
      const double maximum = orbital.MaximumDensity();
      for (int i = 0; i < 2000; ++i)
      {
        EXPECT_LE(orbital.Density(coordinate(random), coordinate(random), coordinate(random)),
          maximum * (1.0 + 1e-10))
          << n << " " << l << " " << m;
      }
    });
}

TEST(HydrogenOrbital, DefaultCubeHoldsTheElectron)
{
  for (int n = 1; n <= HydrogenOrbital::MaximumN; ++n)
  {
    const HydrogenOrbital orbital(n, 0, 0);
    const double width = HydrogenOrbital::DefaultHalfWidth(n);
    const int steps = 20000;
    double inside = 0.0;
    for (int i = 0; i < steps; ++i)
    {
      const double r = (i + 0.5) * width / steps;
      inside += 4.0 * Pi * r * r * orbital.Density(0.0, 0.0, r) * width / steps;
    }
    EXPECT_GT(inside, 0.99) << n;
    EXPECT_LT(inside, 1.0) << n;
  }
}

TEST(HydrogenOrbital, RefusesImpossibleQuantumNumbers)
{
  const int wrong[][3] = { { 0, 0, 0 }, { 17, 0, 0 }, { 2, 2, 0 }, { 2, -1, 0 }, { 3, 1, 2 },
    { 3, 1, -2 }, { -1, 0, 0 } };
  for (const auto& w : wrong)
  {
    EXPECT_FALSE(HydrogenOrbital::Validate(w[0], w[1], w[2]).empty());
    EXPECT_THROW(HydrogenOrbital(w[0], w[1], w[2]), std::invalid_argument);
  }
  EXPECT_TRUE(HydrogenOrbital::Validate(16, 15, -15).empty());
}
}
