// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Probability density of the electron of a hydrogen atom, in atomic units (lengths in Bohr).
 *
 *   psi_nlm(r, theta, phi) = R_nl(r) Y_lm(theta, phi)
 *
 * A smooth, analytic, normalised function with known nodes and symmetries: the volume on which
 * fits and evaluations are tested.
 */
#ifndef trivariate_HydrogenOrbital_h
#define trivariate_HydrogenOrbital_h

#include <string>

namespace trivariate
{
/// Which of the eigenfunctions of energy -1/(2 n^2) is meant.
enum class OrbitalForm
{
  Complex, ///< eigenfunction of L_z: the density is symmetric about the z axis
  Real     ///< m > 0: sqrt(2) Re psi_nlm, m < 0: sqrt(2) Im psi_nl|m|: the chemist's lobes
};

class HydrogenOrbital
{
public:
  /// Beyond this principal quantum number the recurrences were not tested.
  static constexpr int MaximumN = 16;

  /// Empty when 1 <= n <= MaximumN, 0 <= l < n and -l <= m <= l; otherwise a sentence for the user.
  static std::string Validate(int n, int l, int m);

  /// Throws std::invalid_argument with Validate's sentence.
  HydrogenOrbital(int n, int l, int m, OrbitalForm form = OrbitalForm::Complex);

  /// |psi|^2 at a point in Bohr; its integral over space is 1. O(n) time.
  double Density(double x, double y, double z) const;

  /// The largest value of Density in all of space, to 10 digits.
  double MaximumDensity() const;

  /// Half width of a cube about the nucleus that holds 99 % of the electron or more (n = 4: 99.9
  /// %): 2 n (n + 2).
  static double DefaultHalfWidth(int n) { return 2.0 * n * (n + 2.0); }

private:
  double Radial(double r) const;     ///< R_nl(r)^2, its integral with r^2 is 1
  double Polar(double cosine) const; ///< |Y_lm|^2 without the factor of the real form
  double Azimuthal(
    double x, double y) const; ///< that factor: 1 or 2 cos^2(m phi) or 2 sin^2(m phi)

  int N, L, M;
  OrbitalForm Form;
  double RadialFactor, PolarFactor; ///< normalisations, squared
};
}

#endif
