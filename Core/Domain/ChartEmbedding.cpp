// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "LayoutCheck.h"

#include <algorithm>
#include <set>

namespace trivariate
{
namespace
{
using Messages = std::vector<std::string>;

// One step along the outline of a chart, with the chart on the left: a border and its direction.
struct Stretch
{
  Index Border;
  bool Forward;
  bool RightTurn = false; // at its end
};

struct Failure
{
  std::string Message;
};

// The integer polycube of charts: outlines, turns, directions, coordinates, in this order. Each
// step throws a Failure where it is impossible.
class ChartEmbedding
{
public:
  explicit ChartEmbedding(const SurfaceLayout& layout)
    : Layout(layout)
    , Outlines(layout.PatchLabels.size())
  {
    this->FindOutlines();
    this->FindTurns();
    this->FindDirections();
    this->FindCoordinates();
    if (this->LowestIsHigh())
    {
      // Turned inside out; directions are known but for the sign of them all.
      for (int& direction : this->Direction)
      {
        direction = -direction;
      }
      this->FindCoordinates();
    }
    for (int axis = 0; axis < 3; ++axis)
    {
      this->CheckLines(axis);
    }
  }

  std::vector<LatticePoint> Corners;

private:
  int AxisOf(Index chart) const { return this->Layout.PatchLabels[chart] / 2; }
  int SignOf(Index chart) const { return this->Layout.PatchLabels[chart] % 2 ? 1 : -1; }
  Index Start(const Stretch& s) const
  {
    return this->Layout.Borders[s.Border].Corners[s.Forward ? 0 : 1];
  }
  Index End(const Stretch& s) const
  {
    return this->Layout.Borders[s.Border].Corners[s.Forward ? 1 : 0];
  }
  Index Across(const Stretch& s) const
  {
    return this->Layout.Borders[s.Border].Patches[s.Forward ? 1 : 0];
  }
  // A border runs along the axis of neither of its charts.
  int AxisOfBorder(Index b) const
  {
    const auto& patches = this->Layout.Borders[b].Patches;
    return 3 - this->AxisOf(patches[0]) - this->AxisOf(patches[1]);
  }
  static int Permutation(int a, int b, int c)
  {
    return (b - a + 3) % 3 == 1 && c == (b + 1) % 3 ? 1 : -1;
  }

  void FindOutlines()
  {
    for (std::size_t b = 0; b < this->Layout.Borders.size(); ++b)
    {
      const auto& patches = this->Layout.Borders[b].Patches;
      if (this->AxisOf(patches[0]) == this->AxisOf(patches[1]))
      {
        throw Failure{ "Charts " + std::to_string(patches[0]) + " and " +
                       std::to_string(patches[1]) + " are neighbours, but of the same axis." };
      }
      this->Outlines[patches[0]].push_back({ static_cast<Index>(b), true });
      this->Outlines[patches[1]].push_back({ static_cast<Index>(b), false });
    }
    for (std::size_t chart = 0; chart < this->Outlines.size(); ++chart)
    {
      std::vector<Stretch>& outline = this->Outlines[chart];
      for (std::size_t i = 1; i < outline.size(); ++i)
      {
        const auto next = std::find_if(outline.begin() + i, outline.end(),
          [&](const Stretch& s) { return this->Start(s) == this->End(outline[i - 1]); });
        if (next == outline.end())
        {
          throw Failure{ "The outline of chart " + std::to_string(chart) + " is not closed." };
        }
        std::iter_swap(outline.begin() + i, next);
      }
      std::set<Index> neighbours;
      for (const Stretch& s : outline)
      {
        neighbours.insert(this->Across(s));
      }
      if (neighbours.size() < 4)
      {
        throw Failure{ "Chart " + std::to_string(chart) + " has " +
                       std::to_string(neighbours.size()) + " neighbours; it needs four." };
      }
      if (outline.size() % 2 != 0)
      {
        throw Failure{ "Chart " + std::to_string(chart) + " has an odd number of corners, " +
                       std::to_string(outline.size()) + "." };
      }
    }
  }

  // Outlines turn left at corners, except that one of the three charts turns right where the three
  // labels around a corner are left-handed. Four more left than right turns close an outline.
  void FindTurns()
  {
    std::vector<std::vector<std::array<Index, 2>>> choices(this->Layout.Corners.size());
    std::vector<Index> wanted;
    for (std::size_t chart = 0; chart < this->Outlines.size(); ++chart)
    {
      const std::vector<Stretch>& outline = this->Outlines[chart];
      wanted.push_back((static_cast<Index>(outline.size()) - 4) / 2);
      for (std::size_t i = 0; i < outline.size(); ++i)
      {
        const Index own = static_cast<Index>(chart), before = this->Across(outline[i]);
        const Index after = this->Across(outline[(i + 1) % outline.size()]);
        if (this->AxisOf(before) == this->AxisOf(after))
        {
          throw Failure{ "The charts at corner " + std::to_string(this->End(outline[i])) +
                         " are not of three axes." };
        }
        const int hand = this->SignOf(own) * this->SignOf(before) * this->SignOf(after) *
                         Permutation(this->AxisOf(own), this->AxisOf(before), this->AxisOf(after));
        if (hand < 0)
        {
          choices[this->End(outline[i])].push_back({ own, static_cast<Index>(i) });
        }
      }
    }
    this->Match(choices, wanted);
  }

  // Each left-handed corner chooses one of its charts, each chart is chosen as often as it wants:
  // augmenting paths.
  void Match(
    const std::vector<std::vector<std::array<Index, 2>>>& choices, const std::vector<Index>& wanted)
  {
    std::vector<std::vector<Index>> chosenBy(wanted.size());
    std::vector<char> tried;
    const auto choose = [&](const auto& self, Index corner) -> bool
    {
      for (const auto& choice : choices[corner])
      {
        const Index chart = choice[0];
        if (tried[chart])
        {
          continue;
        }
        tried[chart] = 1;
        if (static_cast<Index>(chosenBy[chart].size()) < wanted[chart])
        {
          chosenBy[chart].push_back(corner);
          return true;
        }
        for (Index& other : chosenBy[chart])
        {
          if (self(self, other))
          {
            other = corner;
            return true;
          }
        }
      }
      return false;
    };
    for (std::size_t corner = 0; corner < choices.size(); ++corner)
    {
      tried.assign(wanted.size(), 0);
      if (!choices[corner].empty() && !choose(choose, static_cast<Index>(corner)))
      {
        throw Failure{
          "At corner " + std::to_string(corner) +
          " no chart can turn outward: the charts there are mirrored, or have too few corners."
        };
      }
    }
    for (std::size_t chart = 0; chart < wanted.size(); ++chart)
    {
      if (static_cast<Index>(chosenBy[chart].size()) != wanted[chart])
      {
        throw Failure{
          "Chart " + std::to_string(chart) + " has " +
          std::to_string(this->Outlines[chart].size()) + " corners, but can turn outward at " +
          std::to_string(chosenBy[chart].size()) + " only; its outline does not close."
        };
      }
      for (Stretch& s : this->Outlines[chart])
      {
        const auto& corners = chosenBy[chart];
        s.RightTurn = std::find(corners.begin(), corners.end(), this->End(s)) != corners.end();
      }
    }
  }

  // A left turn in a chart with normal n takes direction d to n x d.
  void FindDirections()
  {
    this->Direction.assign(this->Layout.Borders.size(), 0);
    this->Direction[0] = 1;
    for (bool changed = true; changed;)
    {
      changed = false;
      for (std::size_t chart = 0; chart < this->Outlines.size(); ++chart)
      {
        const std::vector<Stretch>& outline = this->Outlines[chart];
        for (std::size_t i = 0; i < 2 * outline.size(); ++i)
        {
          const Stretch& s = outline[i % outline.size()];
          const Stretch& next = outline[(i + 1) % outline.size()];
          const int now = this->Direction[s.Border] * (s.Forward ? 1 : -1);
          const int turned = now * this->SignOf(static_cast<Index>(chart)) *
                             (s.RightTurn ? -1 : 1) *
                             Permutation(this->AxisOf(static_cast<Index>(chart)),
                               this->AxisOfBorder(s.Border), this->AxisOfBorder(next.Border));
          const int wanted = turned * (next.Forward ? 1 : -1);
          int& known = this->Direction[next.Border];
          if (now != 0 && known == 0)
          {
            known = wanted;
            changed = true;
          }
          else if (now != 0 && known != wanted)
          {
            throw Failure{ "Border " + std::to_string(next.Border) +
                           " would have to run both ways along its axis." };
          }
        }
      }
    }
  }

  // Along a border the coordinate grows by at least one: the longest ways through that order.
  void FindCoordinates()
  {
    std::vector<std::array<Index, 2>> order; // charts: lower, higher
    std::vector<std::array<Index, 3>> chartAt(this->Layout.Corners.size(), { -1, -1, -1 });
    for (std::size_t chart = 0; chart < this->Outlines.size(); ++chart)
    {
      for (const Stretch& s : this->Outlines[chart])
      {
        chartAt[this->End(s)][this->AxisOf(static_cast<Index>(chart))] = static_cast<Index>(chart);
      }
    }
    for (std::size_t b = 0; b < this->Layout.Borders.size(); ++b)
    {
      const int axis = this->AxisOfBorder(static_cast<Index>(b));
      const auto& corners = this->Layout.Borders[b].Corners;
      const bool up = this->Direction[b] > 0;
      order.push_back({ chartAt[corners[up ? 0 : 1]][axis], chartAt[corners[up ? 1 : 0]][axis] });
    }
    this->Coordinate.assign(this->Outlines.size(), 0);
    std::size_t round = 0;
    for (bool changed = true; changed; ++round)
    {
      changed = false;
      for (const auto& [lower, higher] : order)
      {
        if (this->Coordinate[higher] <= this->Coordinate[lower])
        {
          this->Coordinate[higher] = this->Coordinate[lower] + 1;
          changed = true;
          if (round > this->Outlines.size())
          {
            throw Failure{ "Charts " + std::to_string(lower) + " and " + std::to_string(higher) +
                           " would each have to lie above the other." };
          }
        }
      }
    }
    this->Corners.clear();
    for (const auto& charts : chartAt)
    {
      this->Corners.push_back(
        { this->Coordinate[charts[0]], this->Coordinate[charts[1]], this->Coordinate[charts[2]] });
    }
  }

  bool LowestIsHigh() const
  {
    Index lowest = -1;
    for (std::size_t chart = 0; chart < this->Outlines.size(); ++chart)
    {
      const Index c = static_cast<Index>(chart);
      if (this->AxisOf(c) == 0 && (lowest < 0 || this->Coordinate[c] < this->Coordinate[lowest]))
      {
        lowest = c;
      }
    }
    return lowest >= 0 && this->SignOf(lowest) > 0;
  }

  // Whether a chart's outline goes around the middle of a unit square of its plane.
  bool Covers(Index chart, int v, int w, int row, int column) const
  {
    bool inside = false;
    for (const Stretch& s : this->Outlines[chart])
    {
      const LatticePoint &a = this->Corners[this->Start(s)], &b = this->Corners[this->End(s)];
      const bool beyond = a[v] > row && b[v] > row; // edges along w, on one side
      inside ^= beyond && std::min(a[w], b[w]) <= column && std::max(a[w], b[w]) > column;
    }
    return inside;
  }

  // Along every line of unit squares low and high charts take turns, low first.
  void CheckLines(int axis) const
  {
    const int v = (axis + 1) % 3, w = (axis + 2) % 3;
    LatticePoint size{ 0, 0, 0 };
    for (const LatticePoint& corner : this->Corners)
    {
      size = { std::max(size[0], corner[0]), std::max(size[1], corner[1]),
        std::max(size[2], corner[2]) };
    }
    for (int row = 0; row < size[v]; ++row)
    {
      for (int column = 0; column < size[w]; ++column)
      {
        std::vector<std::array<Index, 2>> met;
        for (std::size_t chart = 0; chart < this->Outlines.size(); ++chart)
        {
          const Index c = static_cast<Index>(chart);
          if (this->AxisOf(c) == axis && this->Covers(c, v, w, row, column))
          {
            met.push_back({ this->Coordinate[c], c });
          }
        }
        std::sort(met.begin(), met.end());
        for (std::size_t i = 0; i < met.size(); ++i)
        {
          const bool high = i % 2 == 1;
          if ((this->SignOf(met[i][1]) > 0) != high || (i > 0 && met[i][0] == met[i - 1][0]))
          {
            throw Failure{ "Chart " + std::to_string(met[i][1]) + " has no opposite along axis " +
                           std::to_string(axis) + ": low and high charts do not alternate." };
          }
        }
        if (met.size() % 2 != 0)
        {
          throw Failure{ "Chart " + std::to_string(met.back()[1]) + " has no opposite along axis " +
                         std::to_string(axis) + "." };
        }
      }
    }
  }

  const SurfaceLayout& Layout;
  std::vector<std::vector<Stretch>> Outlines;
  std::vector<int> Direction;  // of each border, along its axis
  std::vector<int> Coordinate; // of each chart, along its axis
};
}

//------------------------------------------------------------------------------
Messages CheckCharts(const SurfaceLayout& layout, std::vector<LatticePoint>* corners)
{
  Messages messages = CheckPatches(layout);
  if (messages.empty())
  {
    try
    {
      const ChartEmbedding embedding(layout);
      if (corners)
      {
        *corners = embedding.Corners;
      }
    }
    catch (const Failure& failure)
    {
      messages.push_back(failure.Message);
    }
  }
  return messages;
}
}
