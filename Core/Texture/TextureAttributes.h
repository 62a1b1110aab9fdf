// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// clang-format off
/**
 * Haralick's texture attributes of a co-occurrence matrix.
 *
 * R. M. Haralick, K. Shanmugam, I. Dinstein: Textural features for image classification. IEEE
 * Trans. Systems, Man, Cybernetics 3 (1973), 610-621, numbers f1 to f14; definitions, names and the
 * other attributes as in A. Zwanenburg et al.: The Image Biomarker Standardisation Initiative
 * (IBSI), reference manual, section "Grey level co-occurrence based features".
 *
 * With p the symmetric matrix normalised to sum 1, levels counted from 1 to G, mu the mean level,
 * sigma^2 its variance, d = |i - j| and s = i + j; entropies in bits:
 *
 *   attribute                          number  value                            from .. to
 *   JointMaximum                               max p                            1/G^2 .. 1
 *   JointAverage                               E[i]                             1 .. G
 *   JointVariance                      f4      E[(i - mu)^2]                    0 .. (G-1)^2 / 4
 *   JointEntropy                       f9      H(i, j)                          0 .. 2 log2 G
 *   DifferenceAverage                          E[d]                             0 .. G-1
 *   DifferenceVariance                 f10     E[(d - E[d])^2]                  0 .. (G-1)^2 / 4
 *   DifferenceEntropy                  f11     H(d)                             0 .. log2 G
 *   SumAverage                         f6      E[s]                             2 .. 2 G
 *   SumVariance                        f7      E[(s - E[s])^2]                  0 .. (G-1)^2
 *   SumEntropy                         f8      H(s)                             0 .. log2(2 G - 1)
 *   AngularSecondMoment                f1      sum p^2                          1/G^2 .. 1
 *   Contrast                           f2      E[d^2]                           0 .. (G-1)^2
 *   Dissimilarity                              E[d]                             0 .. G-1
 *   InverseDifference                          E[1 / (1 + d)]                   1/G .. 1
 *   NormalisedInverseDifference                E[1 / (1 + d/G)]                 G/(2G-1) .. 1
 *   InverseDifferenceMoment            f5      E[1 / (1 + d^2)]                 1/(1+(G-1)^2) .. 1
 *   NormalisedInverseDifferenceMoment          E[1 / (1 + (d/G)^2)]             1/(1+(1-1/G)^2) .. 1
 *   InverseVariance                            E[1 / d^2; d > 0]                0 .. 1
 *   Correlation                        f3      E[(i - mu)(j - mu)] / sigma^2    -1 .. 1
 *   Autocorrelation                            E[i j]                           1 .. G^2
 *   ClusterTendency                            E[(s - 2 mu)^2]                  0 .. (G-1)^2
 *   ClusterShade                               E[(s - 2 mu)^3]                  -+ R^3 / (6 sqrt 3)
 *   ClusterProminence                          E[(s - 2 mu)^4]                  0 .. R^4 / 12
 *   InformationCorrelation1            f12     (H(i, j) - 2 H(i)) / H(i)        -1 .. 0
 *   InformationCorrelation2            f13     sqrt(1 - exp(-2 (2 H(i) - H(i, j))))
 *                                                             0 .. sqrt(1 - exp(-2 log2 G))
 *   MaximalCorrelationCoefficient      f14     second singular value of
 *                                              p(i, j) / sqrt(p(i) p(j))        0 .. 1
 *
 * R = 2 (G - 1) is the range of s. The bounds hold for every symmetric matrix of G levels, and
 * every one is attained. The matrix being symmetric, the entropies HXY1 and HXY2 of f12 and f13 are
 * both 2 H(i), exactly. A matrix with one level only has the value 0 / 0 for four attributes: there
 * the correlations f3 and f14 are 1, the information correlations f12 and f13 are 0, as in
 * PyRadiomics. A matrix without any pair has the attributes of one with the lowest level only.
 */
// clang-format on
#ifndef trivariate_TextureAttributes_h
#define trivariate_TextureAttributes_h

#include "CooccurrenceMatrix.h"

#include <array>
#include <utility>
#include <vector>

namespace trivariate
{
enum class TextureAttribute
{
  JointMaximum,
  JointAverage,
  JointVariance,
  JointEntropy,
  DifferenceAverage,
  DifferenceVariance,
  DifferenceEntropy,
  SumAverage,
  SumVariance,
  SumEntropy,
  AngularSecondMoment,
  Contrast,
  Dissimilarity,
  InverseDifference,
  NormalisedInverseDifference,
  InverseDifferenceMoment,
  NormalisedInverseDifferenceMoment,
  InverseVariance,
  Correlation,
  Autocorrelation,
  ClusterTendency,
  ClusterShade,
  ClusterProminence,
  InformationCorrelation1,
  InformationCorrelation2,
  MaximalCorrelationCoefficient
};

constexpr int TextureAttributeCount = 26;

/// One value an attribute, in the order of the enumeration.
using TextureAttributeValues = std::array<double, TextureAttributeCount>;

/// The name of the attribute's array, as spelled in the enumeration.
const char* TextureAttributeName(TextureAttribute attribute);

/**
 * 22 attributes: all but one of each pair that is the same under a symmetric matrix (JointAverage
 * is half SumAverage, DifferenceAverage is Dissimilarity, ClusterTendency is SumVariance), and but
 * MaximalCorrelationCoefficient, an eigenproblem for every voxel and direction.
 */
const std::vector<TextureAttribute>& DefaultTextureAttributes();

/// The least and the largest value of an attribute for G = levels >= 1; equal if G is 1 and so.
std::pair<double, double> TextureAttributeBounds(TextureAttribute attribute, int levels);

/// value from its bounds to [0, 1]; 0 where the bounds are equal.
double NormalisedTextureAttribute(TextureAttribute attribute, int levels, double value);

/// All attributes but f14, which these sums do not tell (it becomes 0).
void ComputeTextureAttributes(const CooccurrenceSums& sums, TextureAttributeValues& values);

/// All attributes.
TextureAttributeValues ComputeTextureAttributes(const CooccurrenceMatrix& matrix);

/// f14, by the eigenvalues of a symmetric matrix as large as the number of levels that occur.
double MaximalCorrelationCoefficient(const CooccurrenceMatrix& matrix);
}

#endif
