// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Finds the blending functions whose supports overlap a box, in ascending order of their ids.
 *
 * A binary tree of bounding boxes over consecutive functions; it prunes well because the refinement
 * rules order functions along a space-filling curve.
 */
#ifndef trivariate_SupportTree_h
#define trivariate_SupportTree_h

#include "IndexBox.h"

#include <algorithm>
#include <vector>

namespace trivariate
{
class SupportTree
{
public:
  explicit SupportTree(const std::vector<BlendingFunction>& functions)
  {
    for (const BlendingFunction& f : functions)
    {
      this->Leaves.push_back(SupportOf(f));
    }
    while (this->FirstOfNode << 1 < static_cast<Index>(this->Leaves.size()))
    {
      this->FirstOfNode <<= 1;
    }
    this->FirstOfNode <<= 1;
    // Nodes as in a binary heap; node n >= FirstOfNode is leaf n - FirstOfNode.
    const IndexBox nothing{ { 1, 1, 1 }, { 0, 0, 0 } };
    this->Nodes.assign(this->FirstOfNode, nothing);
    for (Index n = this->FirstOfNode - 1; n > 0; --n)
    {
      this->Nodes[n] = Join(this->Box(2 * n, nothing), this->Box(2 * n + 1, nothing));
    }
  }

  /// Calls visit(id) for every function whose support overlaps `box`.
  template <typename Visit>
  void Query(const IndexBox& box, const Visit& visit) const
  {
    std::array<Index, 64> stack;
    int depth = 0;
    stack[depth++] = 1;
    while (depth > 0)
    {
      const Index n = stack[--depth];
      if (n >= this->FirstOfNode)
      {
        const Index id = n - this->FirstOfNode;
        if (id < static_cast<Index>(this->Leaves.size()) && this->Leaves[id].Overlaps(box))
        {
          visit(id);
        }
      }
      else if (this->Nodes[n].Overlaps(box))
      {
        stack[depth++] = 2 * n + 1;
        stack[depth++] = 2 * n;
      }
    }
  }

  /**
   * Calls visit(i, j) for every pair of functions with overlapping supports, i in [begin, end), all
   * j of one i after the other. One descent serves a cluster of consecutive functions.
   */
  template <typename Visit>
  void QueryPairs(Index begin, Index end, const Visit& visit) const
  {
    constexpr Index clusterSize = 16;
    std::vector<Index> candidates;
    for (Index first = begin; first < end; first += clusterSize)
    {
      const Index last = std::min(end, first + clusterSize);
      IndexBox cluster = this->Leaves[first];
      for (Index i = first + 1; i < last; ++i)
      {
        cluster = Join(cluster, this->Leaves[i]);
      }
      candidates.clear();
      this->Query(cluster, [&candidates](Index j) { candidates.push_back(j); });
      for (Index i = first; i < last; ++i)
      {
        for (const Index j : candidates)
        {
          if (this->Leaves[i].Overlaps(this->Leaves[j]))
          {
            visit(i, j);
          }
        }
      }
    }
  }

private:
  const IndexBox& Box(Index n, const IndexBox& nothing) const
  {
    if (n < this->FirstOfNode)
    {
      return this->Nodes[n];
    }
    const Index leaf = n - this->FirstOfNode;
    return leaf < static_cast<Index>(this->Leaves.size()) ? this->Leaves[leaf] : nothing;
  }

  static IndexBox Join(const IndexBox& a, const IndexBox& b)
  {
    if (a.Low[0] > a.High[0])
    {
      return b;
    }
    if (b.Low[0] > b.High[0])
    {
      return a;
    }
    IndexBox both;
    for (int d = 0; d < 3; ++d)
    {
      both.Low[d] = std::min(a.Low[d], b.Low[d]);
      both.High[d] = std::max(a.High[d], b.High[d]);
    }
    return both;
  }

  Index FirstOfNode = 1;
  std::vector<IndexBox> Leaves;
  std::vector<IndexBox> Nodes;
};
}

#endif
