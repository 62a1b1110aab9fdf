// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "DensityLevels.h"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace trivariate
{
using Eigen::Vector3d;

//------------------------------------------------------------------------------
// Count, sum and sum of squares of the densities of one segment.
class DensityLevels::Sums
{
public:
  void Add(double x)
  {
    this->Count += 1.0;
    this->Sum += x;
    this->Squares += x * x;
  }
  void Add(const Sums& other)
  {
    this->Count += other.Count;
    this->Sum += other.Sum;
    this->Squares += other.Squares;
  }
  Statistics Result() const
  {
    Statistics result;
    if (this->Count > 0.0)
    {
      result.Count = this->Count;
      result.Mean = this->Sum / this->Count;
      const double variance = this->Squares / this->Count - result.Mean * result.Mean;
      result.Deviation = std::sqrt(std::max(variance, 0.0));
    }
    return result;
  }

private:
  double Count = 0.0, Sum = 0.0, Squares = 0.0;
};

//------------------------------------------------------------------------------
DensityLevels::DensityLevels(const LabelVolume& labels, const float* density,
  const BoundaryNet& net, const NetTopology& topology, const Execution& execution)
  : Labels(labels)
  , Values(density)
  , Net(net)
  , Topology(topology)
{
  const std::vector<std::pair<std::int32_t, Statistics>> segments =
    this->SegmentStatistics(execution.Part(0.0, 0.4));
  const Index size = static_cast<Index>(net.Vertices.size());
  // In blocks, each with a list of its own: one after another they are the levels of all vertices.
  const Index block = 4096, blocks = (size + block - 1) / block;
  std::vector<std::vector<Level>> found(blocks);
  this->LevelBegin.assign(size + 1, 0);
  const auto work = [&](Index begin, Index end)
  {
    std::vector<std::array<std::int32_t, 2>> pairs;
    std::vector<std::pair<std::int32_t, Sums>> around;
    for (Index v = begin * block; v < std::min(end * block, size); ++v)
    {
      pairs.clear();
      around.clear();
      for (Index n = topology.FaceBegin[v]; n < topology.FaceBegin[v + 1]; ++n)
      {
        const std::array<std::int32_t, 2>& pair = net.Faces[topology.Faces[n]].Labels;
        if (pair[0] >= 0 && std::find(pairs.begin(), pairs.end(), pair) == pairs.end())
        {
          pairs.push_back(pair);
        }
      }
      std::sort(pairs.begin(), pairs.end());
      for (const auto& pair : pairs)
      {
        for (std::int32_t label : pair)
        {
          if (std::none_of(around.begin(), around.end(),
                [label](const auto& entry) { return entry.first == label; }))
          {
            around.emplace_back(label, Sums());
          }
        }
      }
      std::array<Index, 3> corner;
      for (int a = 0; a < 3; ++a)
      {
        corner[a] = static_cast<Index>(std::floor(net.Vertices[v].Anchor[a])) + 1;
      }
      const auto& n = labels.Size;
      for (Index k = std::max<Index>(corner[2] - 3, 0); k < std::min(corner[2] + 3, n[2]); ++k)
      {
        for (Index j = std::max<Index>(corner[1] - 3, 0); j < std::min(corner[1] + 3, n[1]); ++j)
        {
          for (Index i = std::max<Index>(corner[0] - 3, 0); i < std::min(corner[0] + 3, n[0]); ++i)
          {
            const Index id = i + n[0] * (j + n[1] * k);
            for (auto& [label, sums] : around)
            {
              if (labels.Labels[id] == label && this->IsInner(i, j, k))
              {
                sums.Add(density[id]);
              }
            }
          }
        }
      }
      const auto statistics = [&](std::int32_t label)
      {
        const auto sums = std::find_if(around.begin(), around.end(),
          [label](const auto& entry) { return entry.first == label; });
        const Statistics local = sums->second.Result();
        const auto whole = std::lower_bound(segments.begin(), segments.end(), label,
          [](const auto& entry, std::int32_t wanted) { return entry.first < wanted; });
        return local.Count < 4.0 ? whole->second : local;
      };
      for (const auto& pair : pairs)
      {
        const Statistics a = statistics(pair[0]), b = statistics(pair[1]);
        const double difference = b.Mean - a.Mean;
        if (std::abs(difference) > a.Deviation + b.Deviation)
        {
          found[v / block].push_back(
            { pair, 0.5 * (a.Mean + b.Mean), difference > 0.0 ? 1.0 : -1.0 });
          ++this->LevelBegin[v + 1];
        }
      }
    }
  };
  const Index atOnce = 64;
  for (Index start = 0; start < blocks; start += atOnce)
  {
    execution.Check(0.4 + 0.6 * start / blocks);
    execution.ParallelFor(std::min(atOnce, blocks - start),
      [&](Index begin, Index end) { work(start + begin, start + end); });
  }
  std::partial_sum(this->LevelBegin.begin(), this->LevelBegin.end(), this->LevelBegin.begin());
  this->Levels.reserve(this->LevelBegin.back());
  for (const std::vector<Level>& levels : found)
  {
    this->Levels.insert(this->Levels.end(), levels.begin(), levels.end());
  }
}

//------------------------------------------------------------------------------
// Whether all neighbours have the voxel's label; the border of the volume does not matter.
bool DensityLevels::IsInner(Index i, Index j, Index k) const
{
  const auto& n = this->Labels.Size;
  const std::int32_t* p = this->Labels.Labels + i + n[0] * (j + n[1] * k);
  const Index y = n[0], z = n[0] * n[1];
  return (i == 0 || p[-1] == *p) && (i + 1 == n[0] || p[1] == *p) && (j == 0 || p[-y] == *p) &&
         (j + 1 == n[1] || p[y] == *p) && (k == 0 || p[-z] == *p) && (k + 1 == n[2] || p[z] == *p);
}

//------------------------------------------------------------------------------
// Of the inner voxels of every segment, of all its voxels where it has no inner ones; by label.
std::vector<std::pair<std::int32_t, DensityLevels::Statistics>> DensityLevels::SegmentStatistics(
  const Execution& execution) const
{
  using SumsOfSegments = std::map<std::int32_t, std::array<Sums, 2>>; // of inner and other voxels
  const auto& n = this->Labels.Size;
  std::vector<SumsOfSegments> layers(n[2]);
  const Index atOnce = 64;
  for (Index start = 0; start < n[2]; start += atOnce)
  {
    execution.Check(static_cast<double>(start) / n[2]);
    execution.ParallelFor(std::min(atOnce, n[2] - start),
      [&](Index begin, Index end)
      {
        for (Index k = start + begin; k < start + end; ++k)
        {
          auto current = layers[k].end();
          Index id = n[0] * n[1] * k;
          for (Index j = 0; j < n[1]; ++j)
          {
            for (Index i = 0; i < n[0]; ++i, ++id)
            {
              const std::int32_t label = this->Labels.Labels[id];
              if (current == layers[k].end() || current->first != label)
              {
                current = layers[k].try_emplace(label).first;
              }
              current->second[this->IsInner(i, j, k) ? 0 : 1].Add(this->Values[id]);
            }
          }
        }
      });
  }
  SumsOfSegments all;
  for (const SumsOfSegments& layer : layers)
  {
    for (const auto& [label, sums] : layer)
    {
      all[label][0].Add(sums[0]);
      all[label][1].Add(sums[1]);
    }
  }
  std::vector<std::pair<std::int32_t, Statistics>> result;
  for (const auto& [label, sums] : all)
  {
    const Statistics inner = sums[0].Result();
    result.emplace_back(label, inner.Count > 0.0 ? inner : sums[1].Result());
  }
  return result;
}

//------------------------------------------------------------------------------
double DensityLevels::Density(const Vector3d& point) const
{
  const auto& n = this->Labels.Size;
  Index low[3], step[3];
  double share[3];
  Index stride = 1, id = 0;
  for (int a = 0; a < 3; ++a)
  {
    const double x = std::clamp(point[a], 0.0, static_cast<double>(n[a] - 1));
    low[a] = std::min(static_cast<Index>(x), std::max<Index>(n[a] - 2, 0));
    share[a] = x - low[a];
    step[a] = n[a] > 1 ? stride : 0;
    id += low[a] * stride;
    stride *= n[a];
  }
  double sum = 0.0;
  for (int o = 0; o < 8; ++o)
  {
    double weight = 1.0;
    Index at = id;
    for (int a = 0; a < 3; ++a)
    {
      const bool up = o >> a & 1;
      weight *= up ? share[a] : 1.0 - share[a];
      at += up ? step[a] : 0;
    }
    sum += weight * this->Values[at];
  }
  return sum;
}

//------------------------------------------------------------------------------
bool DensityLevels::FindCrossing(
  const Level& level, const Vector3d& point, const Vector3d& normal, double width, double& t) const
{
  const auto excess = [&](double s)
  {
    const Vector3d at = point + s * normal, shift = width * normal;
    const double mean =
      0.5 * this->Density(at) + 0.25 * (this->Density(at - shift) + this->Density(at + shift));
    return level.Sign * (mean - level.Value);
  };
  // Outwards in steps on both sides; the excess grows along the normal where the order is right.
  const double step = 0.1;
  double up = excess(0.0), down = up;
  for (int i = 1; i <= 9; ++i)
  {
    const double nextUp = excess(i * step), nextDown = excess(-i * step);
    if (up <= 0.0 && nextUp > 0.0)
    {
      t = (i - 1 + up / (up - nextUp)) * step;
      return true;
    }
    if (nextDown <= 0.0 && down > 0.0)
    {
      t = -(i - 1 + down / (down - nextDown)) * step;
      return true;
    }
    up = nextUp;
    down = nextDown;
  }
  return false;
}

//------------------------------------------------------------------------------
void DensityLevels::Settle(Points& points, const Execution& execution) const
{
  Points moved(points.size());
  execution.ParallelFor(static_cast<Index>(points.size()),
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        // The least squares solution for the tangent planes, drawn to the vertex a little.
        Eigen::Matrix3d matrix = 0.01 * Eigen::Matrix3d::Identity();
        Vector3d right = Vector3d::Zero();
        int found = 0;
        Vector3d single = Vector3d::Zero();
        for (Index l = this->LevelBegin[v]; l < this->LevelBegin[v + 1]; ++l)
        {
          const Level& level = this->Levels[l];
          Vector3d normal = Vector3d::Zero();
          for (Index n = this->Topology.FaceBegin[v]; n < this->Topology.FaceBegin[v + 1]; ++n)
          {
            const BoundaryFace& face = this->Net.Faces[this->Topology.Faces[n]];
            if (face.Labels == level.Labels)
            {
              normal += AreaVector(face, points);
            }
          }
          for (int a = 0; a < 3; ++a)
          {
            normal[a] = this->Net.Vertices[v].FixedAxes >> a & 1 ? 0.0 : normal[a];
          }
          double t = 0.0;
          normal.normalize();
          // The mean over some way along the normal levels the waves that the kinks of the
          // interpolant make, but a sheet one voxel thick is lost in it.
          if (this->FindCrossing(level, points[v], normal, 0.75, t) ||
              this->FindCrossing(level, points[v], normal, 0.0, t))
          {
            matrix += normal * normal.transpose();
            right += t * normal;
            single = t * normal;
            ++found;
          }
        }
        const Vector3d move = found > 1 ? Vector3d(matrix.ldlt().solve(right)) : single;
        moved[v] = Constrain(this->Net.Vertices[v], points[v] + move);
      }
    });
  points.swap(moved);
}

//------------------------------------------------------------------------------
void DensityLevels::CompensateBlur(Points& points, const Execution& execution) const
{
  const Index size = static_cast<Index>(points.size());
  const auto isInSurface = [this](Index v)
  {
    return this->Topology.Kinds[v] == NetTopology::SURFACE &&
           this->LevelBegin[v] < this->LevelBegin[v + 1];
  };
  // On a ball of radius r a vertex stands out of its neighbours, about a voxel away, by 1 / (2 r).
  // The variance along each axis is 1/12 of the voxels and 1/6 of the interpolation, which draws
  // the level inwards by 1 / (4 r); the triangles cut the corners by about as much.
  Points bend(points.size(), Vector3d::Zero()), smooth(points.size());
  execution.ParallelFor(size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        if (isInSurface(v))
        {
          const Vector3d normal = NormalAt(this->Net, this->Topology, v, points);
          bend[v] = normal * normal.dot(points[v] - MeanOfNeighbours(this->Topology, v, points));
        }
      }
    });
  for (int pass = 0; pass < 8; ++pass)
  {
    execution.ParallelFor(size,
      [&](Index begin, Index end)
      {
        for (Index v = begin; v < end; ++v)
        {
          smooth[v] = 0.5 * (bend[v] + MeanOfNeighbours(this->Topology, v, bend));
        }
      });
    smooth.swap(bend);
  }
  execution.ParallelFor(size,
    [&](Index begin, Index end)
    {
      for (Index v = begin; v < end; ++v)
      {
        if (isInSurface(v))
        {
          points[v] = Constrain(this->Net.Vertices[v], points[v] + bend[v]);
        }
      }
    });
}
}
