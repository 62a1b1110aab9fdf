// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
//
// Analysis-suitable refinement over blocks: a mesh for each group. On the end of a mesh the
// functions are those of the two-dimensional mesh that its cells make there, so equal meshes on
// both sides of a glued face have equal traces, with weights one. A cell that is wider along the
// face than one on the other side is halved, with what its closure asks for, until none is. That
// ends: at the latest where all cells are of the finest level.
#include "BlockSpline.h"
#include "TSpline/AnalysisSuitableRule.h"

#include <algorithm>

namespace trivariate
{
namespace
{
// Indices of knots of the group's own box. Where its blocks do not fill that, functions without
// support in a block stay in its own spline, with whatever control points: they change nothing in
// the blocks.
struct Group
{
  GridIndex Low; // where that box begins
  AnalysisSuitableRule Rule;
  TSpline Spline;
  std::vector<Index> Kept = {}; // the functions that have support in a block
  Index First = 0;              // their place among those of all
};

BlendingFunction Shifted(BlendingFunction f, const GridIndex& by)
{
  for (int a = 0; a < 3; ++a)
  {
    for (std::int32_t& knot : f[a])
    {
      knot += by[a];
    }
  }
  return f;
}

class AnalysisSuitableBlockRule : public RefinementRule
{
public:
  AnalysisSuitableBlockRule(const BlockSpline& layout, int cells)
    : Layout(&layout)
    , One(std::int32_t(1) << layout.Depth())
  {
    const BlockComplex& blocks = layout.Blocks();
    this->GroupOf.resize(blocks.Size());
    for (const auto& [group, box] : blocks.GroupBoxes())
    {
      const TSpline spline = layout.MakeCoarsestGroup(box, cells);
      GridIndex low;
      for (int a = 0; a < 3; ++a)
      {
        low[a] = box.first[a] * this->One;
      }
      for (Index b = 0; b < blocks.Size(); ++b)
      {
        this->GroupOf[b] =
          blocks.Groups[b] == group ? static_cast<int>(this->Groups.size()) : this->GroupOf[b];
      }
      this->Groups.push_back({ low, *MakeAnalysisSuitableRule(spline, Closure::Narrow), spline });
    }
    TSpline coarsest = layout.MakeCoarsest(cells, 0);
    this->Give(coarsest);
  }

  std::unique_ptr<RefinementRule> Clone() const override
  {
    return std::make_unique<AnalysisSuitableBlockRule>(*this);
  }

  void Refine(TSpline& spline, const std::vector<RefinementMark>& marks) override
  {
    this->Take(spline);
    std::vector<std::vector<RefinementMark>> marksOf(this->Groups.size());
    for (const RefinementMark& mark : marks)
    {
      const std::size_t g = this->GroupOfFunction(mark.Function);
      const Group& group = this->Groups[g];
      marksOf[g].push_back({ group.Kept[mark.Function - group.First], mark.Direction,
        mark.Knot - group.Low[mark.Direction] });
    }
    for (std::size_t g = 0; g < this->Groups.size(); ++g)
    {
      this->Groups[g].Rule.Bisect(this->Groups[g].Spline, marksOf[g]);
    }
    this->MatchFaces();
    for (Group& group : this->Groups)
    {
      group.Rule.Carry(group.Spline);
    }
    this->Give(spline);
    this->Layout->MakePointsEqual(spline);
  }

private:
  std::size_t GroupOfFunction(Index function) const
  {
    const auto after = std::upper_bound(this->Groups.begin(), this->Groups.end(), function,
      [](Index f, const Group& group) { return f < group.First; });
    return static_cast<std::size_t>(after - this->Groups.begin()) - 1;
  }

  // The control points of the spline into those of the groups, and back.
  void Take(const TSpline& spline)
  {
    for (Group& group : this->Groups)
    {
      group.Spline.Components = spline.Components;
      group.Spline.ControlPoints.assign(group.Spline.Size() * spline.Components, 0.0);
      for (std::size_t k = 0; k < group.Kept.size(); ++k)
      {
        std::copy_n(spline.ControlPoint(group.First + static_cast<Index>(k)), spline.Components,
          group.Spline.ControlPoint(group.Kept[k]));
      }
    }
  }

  void Give(TSpline& spline)
  {
    spline.Functions.clear();
    spline.ControlPoints.clear();
    for (Group& group : this->Groups)
    {
      group.First = spline.Size();
      group.Kept.clear();
      for (Index i = 0; i < group.Spline.Size(); ++i)
      {
        const BlendingFunction f = Shifted(group.Spline.Functions[i], group.Low);
        if (HasSupportOutside(spline.Holes, f))
        {
          const double* point = group.Spline.ControlPoint(i);
          group.Kept.push_back(i);
          spline.Functions.push_back(f);
          spline.ControlPoints.insert(
            spline.ControlPoints.end(), point, point + group.Spline.Components);
        }
      }
    }
    spline.Weights.assign(spline.Functions.size(), 1.0);
  }

  void MatchFaces()
  {
    const BlockComplex& blocks = this->Layout->Blocks();
    for (bool isChanged = true; isChanged;)
    {
      isChanged = false;
      for (Index b = 0; b < blocks.Size(); ++b)
      {
        for (int f = 0; f < 6; ++f)
        {
          const BlockFace face{ b, f / 2, f % 2 };
          if (blocks.IsGlued(face) && this->RefineTwin(face))
          {
            isChanged = true;
          }
        }
      }
    }
  }

  // Where a face begins, in knots of its group: the unit cells inside of the block next to it.
  GridIndex CornerOf(const BlockFace& face) const
  {
    const Group& group = this->Groups[this->GroupOf[face.Block]];
    GridIndex corner;
    for (int a = 0; a < 3; ++a)
    {
      corner[a] = this->Layout->Blocks().Origins[face.Block][a] * this->One - group.Low[a];
    }
    corner[face.Axis] += face.Side ? this->One - 1 : 0;
    return corner;
  }

  // Makes the cells on the other side of a face no wider along it than those on this side.
  bool RefineTwin(const BlockFace& face)
  {
    const FaceTwin& twin = this->Layout->Blocks().Twin(face);
    const auto [s, t] = TangentialAxes(face.Axis);
    const auto [twinS, twinT] = TangentialAxes(twin.Face.Axis);
    const GridIndex corner = this->CornerOf(face), twinCorner = this->CornerOf(twin.Face);
    IndexBox slab{ corner, corner };
    slab.High[face.Axis] += 1;
    slab.High[s] += this->One;
    slab.High[t] += this->One;
    AnalysisSuitableRule& other = this->Groups[this->GroupOf[twin.Face.Block]].Rule;
    bool isChanged = false;
    for (const IndexBox& cell : this->Groups[this->GroupOf[face.Block]].Rule.Cells().Cells(slab))
    {
      // The unit square at the cell's low corner, and the cell's widths as the twin sees them.
      const std::array<std::int32_t, 2> there =
        twin.Map<std::int32_t>({ cell.Low[s] - corner[s], cell.Low[t] - corner[t] }, this->One - 1);
      std::array<std::int32_t, 2> width{ cell.High[s] - cell.Low[s], cell.High[t] - cell.Low[t] };
      if (twin.Swapped)
      {
        std::swap(width[0], width[1]);
      }
      GridIndex at = twinCorner;
      at[twinS] += there[0];
      at[twinT] += there[1];
      const auto isWider = [&]()
      {
        const IndexBox box = other.Cells().Box(at, other.Cells().Find(at).Level);
        return box.High[twinS] - box.Low[twinS] > width[0] ||
               box.High[twinT] - box.Low[twinT] > width[1];
      };
      while (isWider() && other.Bisect(at))
      {
        isChanged = true;
      }
    }
    return isChanged;
  }

  const BlockSpline* Layout;
  std::int32_t One; // knots along the edge of a block
  std::vector<Group> Groups;
  std::vector<int> GroupOf; // of each block, in Groups
};
}

//------------------------------------------------------------------------------
std::unique_ptr<RefinementRule> MakeAnalysisSuitableBlockRule(const BlockSpline& layout, int cells)
{
  return std::make_unique<AnalysisSuitableBlockRule>(layout, cells);
}
}
