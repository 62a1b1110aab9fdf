// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Fit/ShapeJacobian.h"
#include "RandomRefinement.h"
#include "TSpline/Evaluator.h"

#include <gtest/gtest.h>

namespace
{
using namespace trivariate;

// One tricubic whose determinant is d at the middle of v = 1 and positive elsewhere on that side.
TSpline Bent(double depth)
{
  TSpline spline =
    MakeTensorProduct({ KnotLine{ 0, 1 }, KnotLine{ 0, 1 }, KnotLine{ 0, 1 } }, { 1, 1, 1 }, 0);
  // Y = v (1 - depth * 4 u (1 - u)): degree 2 in u, whose cubic control values are 0, 2/3, 2/3, 0.
  const std::array<double, 4> bump{ 0.0, 4.0 / 3.0, 4.0 / 3.0, 0.0 };
  for (Index i = 0; i < spline.Size(); ++i)
  {
    spline.ControlPoint(i)[1] *= 1.0 - depth * bump[i % 4];
  }
  return spline;
}

TEST(ShapeJacobian, CertifiesWhatIsPositiveAndFindsFolds)
{
  // det = 1 - depth * 4 u (1 - u), least at u = 1/2.
  for (const double depth : { 0.0, 0.5, 0.99 })
  {
    const TSpline spline = Bent(depth);
    const auto bounds = BoundJacobian(spline, BezierMesh(spline));
    ASSERT_EQ(bounds.size(), 1u);
    EXPECT_NEAR(bounds[0].Sampled, 1.0 - depth, 1e-12);
    EXPECT_TRUE(bounds[0].Certified) << depth;
  }
  const TSpline folded = Bent(1.01);
  const auto bounds = BoundJacobian(folded, BezierMesh(folded));
  EXPECT_NEAR(bounds[0].Sampled, -0.01, 1e-12);
  EXPECT_FALSE(bounds[0].Certified);
}

// A certificate is never wrong: no point of a certified cell has a determinant that is not
// positive.
TEST(ShapeJacobian, NeverCertifiesAFold)
{
  int certified = 0, folded = 0;
  for (unsigned seed = 0; seed < 60; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = MakeTensorProduct(
      { MakeUniformKnotLine(0, 2, 2), MakeUniformKnotLine(0, 1, 1), MakeUniformKnotLine(0, 1, 1) },
      { 1, 1, 1 }, 0);
    for (double& x : spline.ControlPoints)
    {
      x += Random(random, -0.22, 0.22);
    }
    const BezierMesh mesh(spline);
    const Evaluator evaluator(spline, mesh, { 0, 1, 2 });
    const auto bounds = BoundJacobian(spline, mesh);
    for (Index cell = 0; cell < mesh.Size(); ++cell)
    {
      double least = 1e300;
      const auto box = mesh.Bounds(cell);
      for (int trial = 0; trial < 300; ++trial)
      {
        double p[3], gradients[9];
        for (int a = 0; a < 3; ++a)
        {
          p[a] = Random(random, box[2 * a], box[2 * a + 1]);
        }
        EvaluatorOutput output;
        output.Gradients = gradients;
        ASSERT_TRUE(evaluator.Evaluate(p, output));
        least = std::min(least, JacobianDeterminant(gradients));
      }
      EXPECT_TRUE(!bounds[cell].Certified || least > 0.0);
      certified += bounds[cell].Certified;
      folded += bounds[cell].Sampled <= 0.0;
    }
  }
  EXPECT_GT(certified, 10);
  EXPECT_GT(folded, 10);
}
}
