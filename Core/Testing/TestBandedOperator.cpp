// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "RandomArrays.h"
#include "RandomRefinement.h"

#include <gtest/gtest.h>

#include <algorithm>

using namespace trivariate;

TEST(BandedOperator, ActsLikeItsMatrixAlongEachDirection)
{
  std::mt19937 random(1);
  for (int width = 1; width <= 10; ++width)
  {
    for (const Index columns : { Index(1), Index(4), Index(11), Index(23) })
    {
      // Bands that wander, that are cut short, and that stick out at the end.
      std::vector<std::pair<std::int32_t, std::vector<double>>> rows(1 + random() % 17);
      for (auto& row : rows)
      {
        row.first = static_cast<std::int32_t>(random() % columns);
        row.second.resize(std::min<Index>(1 + random() % width, columns - row.first));
        std::generate(
          row.second.begin(), row.second.end(), [&random] { return Random(random, -1.0, 1.0); });
      }
      const BandedOperator op = BandedOperator::FromRows(columns, rows);
      const BandedOperator transposed = op.Transposed();
      const auto matrix = [&rows](Index r, Index c)
      {
        const Index at = c - rows[r].first;
        return at < 0 || at >= Index(rows[r].second.size()) ? 0.0 : rows[r].second[at];
      };
      for (Index r = 0; r < op.Rows; ++r)
      {
        for (Index c = 0; c < columns; ++c)
        {
          ASSERT_EQ(Entry(op, r, c), matrix(r, c));
          ASSERT_EQ(Entry(transposed, c, r), matrix(r, c));
        }
      }
      for (int a = 0; a < 3; ++a)
      {
        std::array<Index, 3> size = { 5, 3, 4 };
        size[a] = columns;
        const Array3 in = RandomArray(size, random);
        const Array3 out = Apply(op, a, in, {});
        ASSERT_EQ(out.Size[a], op.Rows);
        for (Index z = 0; z < out.Size[2]; ++z)
        {
          for (Index y = 0; y < out.Size[1]; ++y)
          {
            for (Index x = 0; x < out.Size[0]; ++x)
            {
              std::array<Index, 3> at = { x, y, z };
              const Index r = at[a];
              double sum = 0.0;
              for (at[a] = 0; at[a] < columns; ++at[a])
              {
                sum += matrix(r, at[a]) * At(in, at[0], at[1], at[2]);
              }
              ASSERT_NEAR(At(out, x, y, z), sum, 1e-13) << "width " << width << ", direction " << a;
            }
          }
        }
      }
    }
  }
}

// Lines longer than the pieces in which the operator works through them.
TEST(BandedOperator, ActsOnLongLines)
{
  std::mt19937 random(2);
  const BandedOperator op = BandedOperator::FromRows(
    6, { { 0, { 1, 2, 3, 4, 5 } }, { 1, { -1, 1 } }, { 5, { 2 } }, { 2, { 1, -2, 1, 0.5 } } });
  const Array3 in = RandomArray({ 1500, 2, 6 }, random);
  const Array3 out = Apply(op, 2, in, {});
  for (Index i = 0; i < 3000; ++i)
  {
    for (Index r = 0; r < 4; ++r)
    {
      double sum = 0.0;
      for (Index c = 0; c < 6; ++c)
      {
        sum += Entry(op, r, c) * in.Values[c * 3000 + i];
      }
      ASSERT_NEAR(out.Values[r * 3000 + i], sum, 1e-13);
    }
  }
}

TEST(ArrayPool, KeepsArraysApart)
{
  const auto pool = std::make_shared<ArrayPool>();
  const double* first = nullptr;
  {
    Array3 a({ 10, 10, 10 }, pool);
    first = a.Values.data();
  }
  Array3 b({ 9, 10, 10 }, pool);
  EXPECT_EQ(b.Values.data(), first) << "memory is used again";
  EXPECT_EQ(b.Values.size(), 900u);
  std::fill(b.Values.begin(), b.Values.end(), 1.0);
  Array3 c = b.Clone();
  c.Values[0] = 2.0;
  EXPECT_NE(c.Values.data(), b.Values.data());
  EXPECT_EQ(b.Values[0], 1.0);
  Array3 tiny({ 1, 1, 1 }, pool);
  EXPECT_NE(tiny.Values.data(), b.Values.data());
}
