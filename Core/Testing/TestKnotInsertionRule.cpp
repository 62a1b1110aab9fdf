// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "TSpline/KnotFaces.h"
#include "RandomRefinement.h"
#include "RefinementShapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

using namespace trivariate;

namespace
{
// A tensor product whose attributes are random coefficients and a random polynomial.
TSpline RandomRoot(const Shape& shape, const TricubicPolynomial& polynomial, std::mt19937& random)
{
  TSpline spline = RandomTensorProduct(shape.RootCells, shape.Depth, random);
  for (int a = 0; a < 3; ++a)
  {
    // The unit box, so that the polynomial's monomials are of one size.
    KnotLine& line = spline.KnotLines[a];
    const double low = line.front(), length = line.back() - low;
    std::for_each(line.begin(), line.end(), [=](double& x) { x = (x - low) / length; });
  }
  for (Index i = 0; i < spline.Size(); ++i)
  {
    for (int a = 0; a < 3; ++a)
    {
      spline.ControlPoint(i)[a] = Greville(spline.LocalKnotValues(i, a));
    }
    spline.ControlPoint(i)[4] = polynomial.Coefficient(spline, i);
  }
  return spline;
}

// At random points, on random knots, and in corners of the domain.
Point RandomPointOrKnot(const TSpline& spline, std::mt19937& random)
{
  Point x = RandomPoint(spline, random);
  for (int a = 0; a < 3; ++a)
  {
    if (random() % 3 == 0)
    {
      x[a] = spline.KnotLines[a][random() % spline.KnotLines[a].size()];
    }
  }
  return x;
}

void CheckPromises(const TSpline& coarse, const TSpline& spline,
  const TricubicPolynomial& polynomial, std::mt19937& random)
{
  ASSERT_EQ(Validate(spline), "");
  ASSERT_TRUE(
    std::all_of(spline.Weights.begin(), spline.Weights.end(), [](double w) { return w > 0.0; }));
  ASSERT_TRUE(std::set<BlendingFunction>(spline.Functions.begin(), spline.Functions.end()).size() ==
              spline.Functions.size())
    << "a function is there twice";
  for (int sample = 0; sample < 40; ++sample)
  {
    const Point x = RandomPointOrKnot(spline, random);
    const auto before = HomogeneousValue(coarse, x), after = HomogeneousValue(spline, x);
    ASSERT_NEAR(after.back(), 1.0, 1e-12);
    for (int c = 0; c < spline.Components; ++c)
    {
      ASSERT_NEAR(after[c], before[c], 1e-12) << "component " << c;
    }
    for (int a = 0; a < 3; ++a)
    {
      ASSERT_NEAR(after[a], x[a], 1e-12);
    }
    ASSERT_NEAR(after[4], polynomial(x), 1e-9);
  }
}

// The definition of minimal support, face by face, from the functions alone.
bool HasMinimalSupports(const TSpline& spline)
{
  const auto faceCovers = [&spline](int a, std::int32_t knot, std::int32_t j, std::int32_t k)
  {
    const int b = (a + 1) % 3, c = (a + 2) % 3;
    return std::any_of(spline.Functions.begin(), spline.Functions.end(),
      [&](const BlendingFunction& g)
      {
        return std::find(g[a].begin(), g[a].end(), knot) != g[a].end() && g[b][0] <= j &&
               j < g[b][4] && g[c][0] <= k && k < g[c][4];
      });
  };
  for (const BlendingFunction& f : spline.Functions)
  {
    for (int a = 0; a < 3; ++a)
    {
      const LocalKnots &u = f[a], &v = f[(a + 1) % 3], &w = f[(a + 2) % 3];
      for (std::int32_t knot = u[0] + 1; knot < u[4]; ++knot)
      {
        bool crossed = std::find(u.begin(), u.end(), knot) == u.end();
        for (std::int32_t j = v[0]; crossed && j < v[4]; ++j)
        {
          for (std::int32_t k = w[0]; crossed && k < w[4]; ++k)
          {
            crossed = faceCovers(a, knot, j, k);
          }
        }
        if (crossed)
        {
          return false;
        }
      }
    }
  }
  return true;
}

void ExpectSameSpline(const TSpline& a, const TSpline& b, double tolerance)
{
  ASSERT_EQ(a.Functions, b.Functions);
  for (Index i = 0; i < a.Size(); ++i)
  {
    ASSERT_NEAR(a.Weights[i], b.Weights[i], tolerance);
    for (int c = 0; c < a.Components; ++c)
    {
      ASSERT_NEAR(a.ControlPoint(i)[c], b.ControlPoint(i)[c], tolerance);
    }
  }
}
}

TEST(KnotInsertionRule, KeepsItsPromisesOnRandomMeshes)
{
  for (std::size_t s = 0; s < Shapes.size(); ++s)
  {
    for (unsigned seed = 0; seed < 8; ++seed)
    {
      SCOPED_TRACE(testing::Message() << "shape " << s << ", seed " << seed);
      std::mt19937 random(static_cast<unsigned>(100 * s) + seed);
      const TricubicPolynomial polynomial(random);
      TSpline spline = RandomRoot(Shapes[s], polynomial, random);
      const auto rule = MakeKnotInsertionRule(spline);
      for (int round = 0; round < 5; ++round)
      {
        const TSpline coarse = spline;
        rule->Refine(spline, RandomMarks(spline, 2 + 3 * static_cast<int>(seed), random));
        ASSERT_GE(spline.Size(), coarse.Size());
        CheckPromises(coarse, spline, polynomial, random);
        const KnotFaces faces(spline);
        int direction = 0;
        for (const BlendingFunction& f : spline.Functions)
        {
          ASSERT_LT(faces.FindCrossing(f, direction), 0);
        }
        if (HasFatalFailure())
        {
          return;
        }
      }
    }
  }
}

// Many rounds at one place: neighbouring functions differ by several levels.
TEST(KnotInsertionRule, KeepsItsPromisesOnSteeplyGradedMeshes)
{
  for (unsigned seed = 0; seed < 4; ++seed)
  {
    std::mt19937 random(seed);
    const TricubicPolynomial polynomial(random);
    const TSpline root = RandomRoot({ { 3, 3, 3 }, { 6, 6, 6 } }, polynomial, random);
    const Point x = RandomPoint(root, random);
    TSpline spline = root;
    const auto rule = MakeKnotInsertionRule(spline);
    for (int round = 0; round < 16; ++round)
    {
      // The function that is largest at x, in the middle of its longest span.
      Index best = 0;
      for (Index i = 1; i < spline.Size(); ++i)
      {
        best = ValueOf(spline, i, x) > ValueOf(spline, best, x) ? i : best;
      }
      const LocalKnots& k = spline.Functions[best][round % 3];
      const std::int32_t knot =
        k[2] - k[1] > k[3] - k[2] ? DyadicMiddle(k[1], k[2]) : DyadicMiddle(k[2], k[3]);
      if (knot >= 0)
      {
        rule->Refine(spline, { { best, round % 3, knot } });
      }
    }
    EXPECT_GT(spline.Size(), root.Size());
    CheckPromises(root, spline, polynomial, random);
  }
}

TEST(KnotInsertionRule, SupportsAreMinimalByDefinition)
{
  for (unsigned seed = 0; seed < 6; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 2, 1, 2 }, { 2, 3, 2 }, random);
    const auto rule = MakeKnotInsertionRule(spline);
    for (int round = 0; round < 3; ++round)
    {
      rule->Refine(spline, RandomMarks(spline, 2, random));
      EXPECT_TRUE(HasMinimalSupports(spline)) << "seed " << seed << ", round " << round;
    }
  }
}

TEST(KnotInsertionRule, MeetsTheMarks)
{
  for (unsigned seed = 0; seed < 20; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 3, 4, 3 }, { 3, 2, 3 }, random);
    const auto rule = MakeKnotInsertionRule(spline);
    for (int round = 0; round < 3; ++round)
    {
      const TSpline coarse = spline;
      const auto marks = RandomMarks(spline, 4, random);
      rule->Refine(spline, marks);
      for (const RefinementMark& mark : marks)
      {
        // Every function that the new face crosses completely has its knot.
        const BlendingFunction& f = coarse.Functions[mark.Function];
        const int a = mark.Direction, b = (a + 1) % 3, c = (a + 2) % 3;
        for (const BlendingFunction& g : spline.Functions)
        {
          const bool crossed = g[a][0] < mark.Knot && mark.Knot < g[a][4] && f[b][0] <= g[b][0] &&
                               g[b][4] <= f[b][4] && f[c][0] <= g[c][0] && g[c][4] <= f[c][4];
          EXPECT_TRUE(!crossed || std::find(g[a].begin(), g[a].end(), mark.Knot) != g[a].end());
        }
      }
    }
  }
}

TEST(KnotInsertionRule, OrderOfMarksDoesNotMatter)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    const TSpline root = RandomTensorProduct({ 3, 3, 2 }, { 3, 3, 3 }, random);
    auto marks = RandomMarks(root, 12, random);
    TSpline once = root;
    MakeKnotInsertionRule(root)->Refine(once, marks);

    std::shuffle(marks.begin(), marks.end(), random);
    TSpline shuffled = root;
    MakeKnotInsertionRule(root)->Refine(shuffled, marks);
    ExpectSameSpline(once, shuffled, 1e-13);

    // One after the other, as long as the marked functions are still there.
    TSpline stepwise = root;
    const auto rule = MakeKnotInsertionRule(root);
    std::vector<RefinementMark> met;
    for (RefinementMark mark : marks)
    {
      const auto same = std::find(
        stepwise.Functions.begin(), stepwise.Functions.end(), root.Functions[mark.Function]);
      if (same != stepwise.Functions.end())
      {
        met.push_back(mark);
        mark.Function = same - stepwise.Functions.begin();
        rule->Refine(stepwise, { mark });
      }
    }
    TSpline together = root;
    MakeKnotInsertionRule(root)->Refine(together, met);
    ExpectSameSpline(together, stepwise, 1e-12);
  }
}

// Nothing but the functions is needed to go on: a spline that was read from a file can be refined.
TEST(KnotInsertionRule, MeshAndFunctionsDetermineEachOther)
{
  for (unsigned seed = 0; seed < 10; ++seed)
  {
    std::mt19937 random(seed);
    TSpline spline = RandomTensorProduct({ 3, 2, 3 }, { 3, 3, 3 }, random);
    const auto rule = MakeKnotInsertionRule(spline);
    for (int round = 0; round < 4; ++round)
    {
      TSpline again = spline;
      const auto marks = RandomMarks(spline, 5, random);
      MakeKnotInsertionRule(again)->Refine(again, marks);
      rule->Refine(spline, marks);
      EXPECT_EQ(spline.Functions, again.Functions);
      EXPECT_EQ(spline.Weights, again.Weights);
      EXPECT_EQ(spline.ControlPoints, again.ControlPoints);
    }
  }
}

TEST(KnotInsertionRule, NoMarksChangeNothing)
{
  std::mt19937 random(2);
  TSpline spline = RandomTensorProduct({ 3, 3, 3 }, { 2, 2, 2 }, random);
  const auto rule = MakeKnotInsertionRule(spline);
  rule->Refine(spline, RandomMarks(spline, 5, random));
  const TSpline before = spline;
  rule->Refine(spline, {});
  ExpectSameSpline(before, spline, 1e-15);
}

TEST(KnotInsertionRule, CloneIsIndependent)
{
  std::mt19937 random(3);
  const TSpline root = RandomTensorProduct({ 3, 3, 3 }, { 3, 3, 3 }, random);
  const auto first = RandomMarks(root, 10, random), second = RandomMarks(root, 10, random);
  TSpline expected = root;
  MakeKnotInsertionRule(root)->Refine(expected, second);

  const auto rule = MakeKnotInsertionRule(root);
  TSpline tried = root;
  rule->Clone()->Refine(tried, first);
  ASSERT_GT(tried.Size(), root.Size());
  TSpline spline = root;
  rule->Refine(spline, second);
  EXPECT_EQ(spline.Functions, expected.Functions);
  EXPECT_EQ(spline.ControlPoints, expected.ControlPoints);
}

TEST(KnotInsertionRule, EndsInTheFinestTensorProduct)
{
  std::mt19937 random(1);
  TSpline spline = RandomTensorProduct({ 2, 3, 1 }, { 1, 0, 2 }, random);
  const auto rule = MakeKnotInsertionRule(spline);
  RefineToTheEnd(spline, *rule);
  TSpline finest = MakeTensorProduct(spline.KnotLines, { 1, 1, 1 }, 0);
  ASSERT_EQ(spline.Size(), finest.Size());
  std::sort(finest.Functions.begin(), finest.Functions.end());
  std::sort(spline.Functions.begin(), spline.Functions.end());
  EXPECT_EQ(spline.Functions, finest.Functions);
  for (const double w : spline.Weights)
  {
    EXPECT_NEAR(w, 1.0, 1e-13);
  }
}
