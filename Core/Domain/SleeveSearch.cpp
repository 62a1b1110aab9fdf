// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "Unfolding.h"

#include <array>
#include <memory>
#include <queue>
#include <vector>

namespace trivariate
{
namespace
{
constexpr int FarthestStep = 4; // triangles crossed in one step of the search
constexpr Crossing PageSize = 128;

// A* over the middles of edges, each reached in one direction.
class SleeveSearch
{
public:
  SleeveSearch(const LayoutMesh& mesh, const PathEnd& from, const PathEnd& to)
    : Mesh(mesh)
    , From(from)
    , To(to)
    , Target(mesh.Points[to.Point])
    , Goal(3 * mesh.NumberOfTriangles())
    , Found(Goal / PageSize + 1)
  {
  }

  std::vector<Crossing> Run()
  {
    for (const Index t : this->From.Sector)
    {
      const int corner = this->Mesh.CornerOf(t, this->From.Point);
      const Crossing first = 3 * t + (corner + 1) % 3;
      if (this->Mesh.Mark(t, first % 3) < 0)
      {
        this->Reach(
          first, (this->Middle(first) - this->Mesh.Points[this->From.Point]).norm(), -1, 1);
      }
    }
    while (!this->Waiting.empty())
    {
      const auto [estimate, h] = this->Waiting.top();
      this->Waiting.pop();
      if (h == this->Goal)
      {
        return this->WayToGoal();
      }
      State& state = this->StateOf(h);
      if (!state.Done)
      {
        state.Done = true;
        const double half = 0.5 * (this->Mesh.Points[LeftOf(this->Mesh, h)] -
                                    this->Mesh.Points[RightOf(this->Mesh, h)])
                                    .norm();
        const Point2 left(-half, 0.0), right(half, 0.0);
        this->Step({ h, 1, h, left, right, left, right }, FarthestStep);
      }
    }
    return {};
  }

private:
  struct State
  {
    double Distance = std::numeric_limits<double>::infinity();
    Crossing Parent = -1;
    unsigned char Turns = 1; // from the parent: a leading one, then 1 for left and 0 for right
    bool Done = false;
  };
  using Page = std::array<State, PageSize>;

  // A way straight on from the middle of an edge, at the origin, within a cone of view.
  struct View
  {
    Crossing Start;
    unsigned Turns;
    Crossing Last;
    Point2 Left, Right;       // the ends of the last edge
    Point2 LeftRay, RightRay; // what can be seen through all edges so far
  };

  State& StateOf(Crossing h)
  {
    std::unique_ptr<Page>& page = this->Found[h / PageSize];
    if (!page)
    {
      page = std::make_unique<Page>();
    }
    return (*page)[h % PageSize];
  }

  Eigen::Vector3d Middle(Crossing h) const
  {
    return 0.5 *
           (this->Mesh.Points[LeftOf(this->Mesh, h)] + this->Mesh.Points[RightOf(this->Mesh, h)]);
  }

  void Reach(Crossing h, double distance, Crossing parent, unsigned turns)
  {
    State& state = this->StateOf(h);
    if (distance < state.Distance)
    {
      state.Distance = distance;
      state.Parent = parent;
      state.Turns = static_cast<unsigned char>(turns);
      const double rest = h == this->Goal ? 0.0 : (this->Middle(h) - this->Target).norm();
      this->Waiting.push({ distance + rest, h });
    }
  }

  static bool Sees(const View& view, const Point2& place)
  {
    return Cross(view.RightRay, place) >= 0.0 && Cross(place, view.LeftRay) >= 0.0;
  }

  void Step(const View& view, int reach)
  {
    const Entered next = Enter(this->Mesh, view.Last);
    const Point2 apex = Unfold(this->Mesh, view.Last, next.Apex, view.Left, view.Right);
    const double before = this->StateOf(view.Start).Distance;
    if (next.Apex == this->To.Point && Sees(view, apex) &&
        std::binary_search(this->To.Sector.begin(), this->To.Sector.end(), next.LeftExit / 3))
    {
      this->Reach(this->Goal, before + apex.norm(), view.Start, view.Turns);
    }
    for (const bool left : { true, false })
    {
      const Crossing exit = left ? next.LeftExit : next.RightExit;
      if (this->Mesh.Mark(exit / 3, exit % 3) >= 0)
      {
        continue;
      }
      View on = view;
      on.Turns = 2 * view.Turns + left;
      on.Last = exit;
      (left ? on.Right : on.Left) = apex;
      const Point2 middle = 0.5 * (on.Left + on.Right);
      if (Sees(view, middle))
      {
        this->Reach(exit, before + middle.norm(), view.Start, on.Turns);
      }
      on.LeftRay = Cross(on.Left, view.LeftRay) >= 0.0 ? on.Left : view.LeftRay;
      on.RightRay = Cross(view.RightRay, on.Right) >= 0.0 ? on.Right : view.RightRay;
      if (reach > 1 && Cross(on.RightRay, on.LeftRay) > 0.0)
      {
        this->Step(on, reach - 1);
      }
    }
  }

  std::vector<Crossing> WayToGoal()
  {
    std::vector<Crossing> way;
    for (Crossing h = this->Goal; this->StateOf(h).Parent >= 0;)
    {
      const State& state = this->StateOf(h);
      std::vector<Crossing> step(1, state.Parent);
      int turns = 0;
      while (state.Turns >> (turns + 1))
      {
        ++turns;
      }
      while (turns-- > 0)
      {
        const Entered next = Enter(this->Mesh, step.back());
        step.push_back(state.Turns >> turns & 1 ? next.LeftExit : next.RightExit);
      }
      // The last crossing of a step is the first of the next; to the goal there is none.
      way.insert(way.end(), step.rbegin() + (h == this->Goal ? 0 : 1), step.rend());
      h = state.Parent;
    }
    std::reverse(way.begin(), way.end());
    return way;
  }

  const LayoutMesh& Mesh;
  const PathEnd& From;
  const PathEnd& To;
  const Eigen::Vector3d Target;
  const Crossing Goal;
  // In pages, and only those that the search comes to: a path sees a small part of a large surface.
  std::vector<std::unique_ptr<Page>> Found;
  using Candidate = std::pair<double, Crossing>;
  std::priority_queue<Candidate, std::vector<Candidate>, std::greater<Candidate>> Waiting;
};
}

//------------------------------------------------------------------------------
std::vector<Crossing> FindSleeve(const LayoutMesh& mesh, const PathEnd& from, const PathEnd& to)
{
  return SleeveSearch(mesh, from, to).Run();
}
}
