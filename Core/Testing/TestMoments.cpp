// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
// DyadicAxis and MomentPyramid against plain sums.
#include "Fit/FunctionTable.h"
#include "Fit/MomentPyramid.h"
#include "RandomArrays.h"
#include "RandomRefinement.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace trivariate;

namespace
{
struct AxisShape
{
  Index Samples;
  int Root, Levels;
};

// Knots at the samples, between them, finer and coarser than them; a single interval.
const std::vector<AxisShape> Shapes = { { 2, 1, 0 }, { 2, 1, 1 }, { 5, 1, 2 }, { 5, 3, 2 },
  { 9, 1, 3 }, { 37, 5, 3 }, { 64, 4, 4 }, { 100, 3, 2 }, { 8, 4, 3 } };

// Function q of level l, from the definition of a clamped uniform knot vector.
LocalKnots LevelKnots(const AxisShape& shape, int l, Index q)
{
  const Index intervals = Index(shape.Root) << l;
  LocalKnots k;
  for (int i = 0; i < 5; ++i)
  {
    k[i] =
      static_cast<std::int32_t>(std::clamp<Index>(q + i - 3, 0, intervals) << (shape.Levels - l));
  }
  return k;
}

double Value(const DyadicAxis& axis, const LocalKnots& k, double x)
{
  Knots5 t;
  std::transform(k.begin(), k.end(), t.begin(), [&axis](int i) { return axis.Line()[i]; });
  return x < t[0] || x > t[4] ? 0.0 : EvaluateBSpline(t, x)[0];
}

// A local knot vector as refinement makes them: any knots, repeated at the domain's ends only.
LocalKnots RandomKnots(const AxisShape& shape, std::mt19937& random)
{
  const int intervals = shape.Root << shape.Levels;
  std::vector<std::int32_t> knots = { 0, 0, 0, 0 };
  for (int k = 1; k < intervals; ++k)
  {
    if (random() % 3 != 0)
    {
      knots.push_back(k);
    }
  }
  knots.insert(knots.end(), 4, intervals);
  const std::size_t first = random() % (knots.size() - 4);
  return { knots[first], knots[first + 1], knots[first + 2], knots[first + 3], knots[first + 4] };
}

// A randomly refined spline over unequal axes, with what the fit knows about its functions.
struct RefinedOnAxes
{
  std::array<AxisShape, 3> Shape;
  Axes Grid;
  TSpline Spline;
  FunctionTable Table{ Grid };
  std::vector<LevelFunction> Functions;
  Levels Finest;

  RefinedOnAxes(std::array<AxisShape, 3> shape, std::mt19937& random)
    : Shape(shape)
    , Grid{ DyadicAxis(shape[0].Samples, shape[0].Root, shape[0].Levels),
      DyadicAxis(shape[1].Samples, shape[1].Root, shape[1].Levels),
      DyadicAxis(shape[2].Samples, shape[2].Root, shape[2].Levels) }
    , Finest{ shape[0].Levels, shape[1].Levels, shape[2].Levels }
  {
    this->Spline =
      MakeTensorProduct({ this->Grid[0].Line(), this->Grid[1].Line(), this->Grid[2].Line() },
        { 1 << shape[0].Levels, 1 << shape[1].Levels, 1 << shape[2].Levels }, 1);
    const auto rule = MakeKnotInsertionRule(this->Spline);
    for (int round = 0; round < 4; ++round)
    {
      rule->Refine(this->Spline, RandomMarks(this->Spline, 4, random));
    }
    this->Table.Update(this->Spline);
    for (Index i = 0; i < this->Spline.Size(); ++i)
    {
      this->Functions.push_back(this->Table.Expansion(i));
    }
  }

  // The sum over all voxels of values times function i.
  double Moment(const Array3& values, Index i) const
  {
    double sum = 0.0;
    for (Index z = 0; z < values.Size[2]; ++z)
    {
      for (Index y = 0; y < values.Size[1]; ++y)
      {
        for (Index x = 0; x < values.Size[0]; ++x)
        {
          sum +=
            At(values, x, y, z) * ValueOf(this->Spline, i, { double(x), double(y), double(z) });
        }
      }
    }
    return sum;
  }

  std::array<Index, 3> Samples() const
  {
    return { this->Shape[0].Samples, this->Shape[1].Samples, this->Shape[2].Samples };
  }

  Array3 FinestMoments(const Array3& values) const
  {
    Array3 moments = values.Clone();
    for (int a = 0; a < 3; ++a)
    {
      moments = Apply(this->Grid[a].Moments, a, moments, {});
    }
    return moments;
  }
};

const std::vector<std::array<AxisShape, 3>> Volumes = {
  { { { 9, 2, 2 }, { 12, 3, 2 }, { 7, 1, 3 } } },
  { { { 2, 1, 0 }, { 17, 4, 2 }, { 10, 2, 3 } } },
  { { { 13, 3, 2 }, { 2, 1, 1 }, { 5, 1, 2 } } },
};
}

TEST(DyadicAxis, FinestIntervalsAreAboutOneSample)
{
  for (Index samples = 2; samples <= 300; samples += 1 + samples / 12)
  {
    for (const double rootCells : { 1.0, 2.0, 4.0 })
    {
      const DyadicAxis axis = DyadicAxis::ForSamples(samples, rootCells);
      const double spacing = axis.Line()[1] - axis.Line()[0];
      EXPECT_GT(spacing, 0.7) << samples << " samples, " << rootCells << " root cells";
      EXPECT_LT(spacing, 1.5) << samples << " samples, " << rootCells << " root cells";
      EXPECT_LT(axis.Root(), 1.5 * rootCells + 1.0);
      EXPECT_EQ(axis.Samples(), samples);
      EXPECT_EQ(axis.Line().back(), double(samples - 1));
    }
  }
}

TEST(DyadicAxis, LevelsAreNestedBSplineBases)
{
  std::mt19937 random(3);
  for (const AxisShape& shape : Shapes)
  {
    const DyadicAxis axis(shape.Samples, shape.Root, shape.Levels);
    for (int l = 0; l < shape.Levels; ++l)
    {
      ASSERT_EQ(axis.Restrict[l].Rows, axis.Functions(l));
      ASSERT_EQ(axis.Restrict[l].Columns, axis.Functions(l + 1));
      for (int sample = 0; sample < 20; ++sample)
      {
        const double x = Random(random, 0.0, double(shape.Samples - 1));
        for (Index q = 0; q < axis.Functions(l); ++q)
        {
          double sum = 0.0;
          for (Index p = 0; p < axis.Functions(l + 1); ++p)
          {
            EXPECT_EQ(Entry(axis.Prolong[l], p, q), Entry(axis.Restrict[l], q, p));
            sum += Entry(axis.Restrict[l], q, p) * Value(axis, LevelKnots(shape, l + 1, p), x);
          }
          ASSERT_NEAR(sum, Value(axis, LevelKnots(shape, l, q), x), 1e-14);
        }
      }
    }
  }
}

TEST(DyadicAxis, SamplesAndGramMatricesAreThoseOfTheFunctions)
{
  for (const AxisShape& shape : Shapes)
  {
    const DyadicAxis axis(shape.Samples, shape.Root, shape.Levels);
    for (int l = 0; l <= shape.Levels; ++l)
    {
      for (Index q = 0; q < axis.Functions(l); ++q)
      {
        const LocalKnots kq = LevelKnots(shape, l, q);
        if (l == shape.Levels)
        {
          for (Index x = 0; x < shape.Samples; ++x)
          {
            EXPECT_NEAR(Entry(axis.Collocation, x, q), Value(axis, kq, double(x)), 1e-15);
            EXPECT_EQ(Entry(axis.Moments, q, x), Entry(axis.Collocation, x, q));
          }
        }
        for (Index p = 0; p < axis.Functions(l); ++p)
        {
          double sum = 0.0;
          for (Index x = 0; x < shape.Samples; ++x)
          {
            sum += Value(axis, kq, double(x)) * Value(axis, LevelKnots(shape, l, p), double(x));
          }
          ASSERT_NEAR(Entry(axis.Gram[l], q, p), sum, 1e-13) << "level " << l;
        }
      }
    }
  }
}

TEST(DyadicAxis, ExpandsAnyLocalKnotVector)
{
  std::mt19937 random(4);
  for (const AxisShape& shape : Shapes)
  {
    const DyadicAxis axis(shape.Samples, shape.Root, shape.Levels);
    for (int trial = 0; trial < 100; ++trial)
    {
      const LocalKnots k = RandomKnots(shape, random);
      const int level = axis.LevelOf(k);
      EXPECT_TRUE(std::all_of(k.begin(), k.end(),
        [&](std::int32_t knot) { return knot % (1 << (shape.Levels - level)) == 0; }));
      EXPECT_TRUE(level == 0 ||
                  std::any_of(k.begin(), k.end(),
                    [&](std::int32_t knot) { return knot % (2 << (shape.Levels - level)) != 0; }))
        << "a coarser level would do";
      for (int l = level; l <= shape.Levels; ++l)
      {
        const LevelExpansion expansion = axis.Expand(k, l);
        EXPECT_EQ(expansion.Level, l);
        for (int sample = 0; sample < 10; ++sample)
        {
          const double x = Random(random, 0.0, double(shape.Samples - 1));
          double sum = 0.0;
          for (std::size_t q = 0; q < expansion.Coefficients.size(); ++q)
          {
            sum += expansion.Coefficients[q] *
                   Value(axis, LevelKnots(shape, l, expansion.First + Index(q)), x);
          }
          ASSERT_NEAR(sum, Value(axis, k, x), 1e-13);
        }
      }
      const SampledFunction sampled = axis.Sample(k),
                            other = axis.Sample(RandomKnots(shape, random));
      double norm2 = 0.0;
      for (Index x = 0; x < shape.Samples; ++x)
      {
        const Index at = x - sampled.first;
        const bool inside = at >= 0 && at < Index(sampled.second.size());
        const double value = Value(axis, k, double(x));
        ASSERT_NEAR(inside ? sampled.second[at] : 0.0, value, 1e-15);
        norm2 += value * value;
      }
      EXPECT_NEAR(Dot(sampled, sampled), norm2, 1e-13);
      EXPECT_EQ(Dot(sampled, other), Dot(other, sampled));
    }
  }
}

TEST(MomentPyramid, MomentsAreSumsOverTheVoxels)
{
  for (std::size_t v = 0; v < Volumes.size(); ++v)
  {
    for (unsigned seed = 0; seed < 3; ++seed)
    {
      std::mt19937 random(seed);
      const RefinedOnAxes refined(Volumes[v], random);
      const Array3 values = RandomArray(refined.Samples(), random);
      const auto groups = GroupByLevel(refined.Functions);
      std::vector<int> visits(refined.Functions.size(), 0);
      std::vector<double> line;
      VisitMoments(refined.Grid, refined.FinestMoments(values), refined.Finest, groups,
        [&](const LevelGroup& group, const Array3& moments)
        {
          for (const Index i : group.Functions)
          {
            ++visits[i];
            const LevelFunction& f = refined.Functions[i];
            ASSERT_EQ(f.Level(), group.Level);
            const double expected = refined.Moment(values, i);
            for (int a = 0; a < 3; ++a)
            {
              ContractLine(moments, f, a, line);
              double sum = 0.0;
              for (std::size_t q = 0; q < line.size(); ++q)
              {
                sum += f.Factors[a]->Coefficients[q] * line[q];
              }
              ASSERT_NEAR(sum, expected, 1e-12) << "function " << i << ", direction " << a;
            }
          }
        },
        {});
      EXPECT_TRUE(std::all_of(visits.begin(), visits.end(), [](int n) { return n == 1; }));
    }
  }
}

TEST(MomentPyramid, SynthesisIsTheSpline)
{
  for (std::size_t v = 0; v < Volumes.size(); ++v)
  {
    std::mt19937 random(static_cast<unsigned>(v));
    const RefinedOnAxes refined(Volumes[v], random);
    std::vector<double> d(refined.Functions.size());
    std::generate(d.begin(), d.end(), [&random] { return Random(random, -1.0, 1.0); });
    Array3 fitted = Synthesize(refined.Grid, refined.Functions, GroupByLevel(refined.Functions), d,
      refined.Finest, std::make_shared<ArrayPool>(), {});
    for (int a = 0; a < 3; ++a)
    {
      fitted = Apply(refined.Grid[a].Collocation, a, fitted, {});
    }
    ASSERT_EQ(fitted.Size, refined.Samples());
    for (Index z = 0; z < fitted.Size[2]; ++z)
    {
      for (Index y = 0; y < fitted.Size[1]; ++y)
      {
        for (Index x = 0; x < fitted.Size[0]; ++x)
        {
          double sum = 0.0;
          for (std::size_t i = 0; i < d.size(); ++i)
          {
            sum += d[i] * ValueOf(refined.Spline, Index(i), { double(x), double(y), double(z) });
          }
          ASSERT_NEAR(At(fitted, x, y, z), sum, 1e-12);
        }
      }
    }
  }
}

TEST(MomentPyramid, RestrictGivesTheMomentsOfTheCoarserBasis)
{
  std::mt19937 random(6);
  const RefinedOnAxes refined(Volumes[0], random);
  const Array3 values = RandomArray(refined.Samples(), random);
  const Array3 finest = refined.FinestMoments(values);
  for (const Levels& to :
    { Levels{ 0, 0, 0 }, Levels{ 2, 1, 0 }, Levels{ 1, 2, 3 }, refined.Finest })
  {
    const Array3 moments = Restrict(refined.Grid, finest, refined.Finest, to, {});
    for (int trial = 0; trial < 50; ++trial)
    {
      std::array<Index, 3> at;
      TSpline one = refined.Spline;
      one.Functions.resize(1);
      for (int a = 0; a < 3; ++a)
      {
        ASSERT_EQ(moments.Size[a], refined.Grid[a].Functions(to[a]));
        at[a] = static_cast<Index>(random() % moments.Size[a]);
        one.Functions[0][a] = LevelKnots(refined.Shape[a], to[a], at[a]);
      }
      double sum = 0.0;
      for (Index z = 0; z < values.Size[2]; ++z)
      {
        for (Index y = 0; y < values.Size[1]; ++y)
        {
          for (Index x = 0; x < values.Size[0]; ++x)
          {
            sum += At(values, x, y, z) * ValueOf(one, 0, { double(x), double(y), double(z) });
          }
        }
      }
      ASSERT_NEAR(At(moments, at[0], at[1], at[2]), sum, 1e-12);
    }
  }
}
