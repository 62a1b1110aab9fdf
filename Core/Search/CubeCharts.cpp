// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CubeCharts.h"

#include "ConformalCylinder.h"
#include "CylinderCharts.h"
#include "Domain/ClosestRotation.h"
#include "FarthestPoint.h"
#include "NormalAxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double Hopeless = 0.04; // charts so much worse than others are not worked on
constexpr int Turns = 2;          // through a quarter of the circle
constexpr int CentringRounds = 3;
constexpr int FrameSmoothing = 4; // rounds
constexpr double TwoPi = 6.283185307179586;

double SignOf(ChartLabel label)
{
  return label % 2 ? 1.0 : -1.0;
}

class Search
{
public:
  Search(const SurfaceMesh& mesh, const CubeChartOptions& options, const Execution& execution)
    : Mesh(mesh)
    , Options(options)
    , Run(execution)
    , Cylinder(mesh, execution.Part(0.0, 0.2))
  {
    const Index m = mesh.NumberOfTriangles();
    for (Index t = 0; t < m; ++t)
    {
      const Triangle& c = mesh.Triangles[t];
      const Vector3d area = mesh.AreaVector(t);
      this->Areas.push_back(area.norm());
      this->Normals.push_back(area.normalized());
      this->Centres.push_back((mesh.Points[c[0]] + mesh.Points[c[1]] + mesh.Points[c[2]]) / 3.0);
      this->Area += this->Areas[t];
      this->Centre += this->Areas[t] * this->Centres[t];
    }
    this->Centre /= this->Area;
    for (int round = 0; round < options.NormalSmoothing; ++round)
    {
      this->SmoothNormals();
    }
  }

  CubeCharts Best()
  {
    std::vector<std::array<Index, 2>> poles{ this->FarthestPoints() };
    for (const Vector3d& axis : this->Axes())
    {
      poles.push_back({ this->Extreme(-axis), this->Extreme(axis) });
    }
    for (std::size_t i = 0; i < poles.size(); ++i)
    {
      this->Done = 0.2 + 0.6 * i / poles.size();
      this->Try(poles[i][0], poles[i][1]);
    }
    if (this->Most == -2.0)
    {
      throw std::runtime_error("No cube could be laid on the surface.");
    }
    // Poles in the middle of faces bring out what a cube can be better than those at its extremes.
    for (int round = 0; round < CentringRounds; ++round)
    {
      const std::vector<ChartLabel> labels = this->Found.Labels;
      for (ChartLabel low : { 0, 2, 4 })
      {
        this->Done = 0.8 + 0.2 * (round + low / 6.0) / CentringRounds;
        this->Try(this->MiddleOf(labels, low), this->MiddleOf(labels, low + 1));
      }
      if (labels == this->Found.Labels)
      {
        break;
      }
    }
    return std::move(this->Found);
  }

private:
  // Keeps the charts between two poles if they are the best so far.
  void Try(Index low, Index high)
  {
    if (low == high)
    {
      return;
    }
    this->Run.Check(this->Done);
    const std::vector<CylinderCell> cells = this->CellsOf(this->Cylinder.Map(low, high));
    const std::vector<std::size_t> order = OrderByHeight(cells);
    const Vector3d axis = (this->Mesh.Points[high] - this->Mesh.Points[low]).normalized();
    for (const bool bent : { false, true })
    {
      CubeCharts charts = bent ? this->BentFrames(cells, order) : this->StraightFrames(axis);
      this->LabelAndRelabel(cells, order, charts);
      const double value = charts.Alignment - (bent ? this->Options.BendingGain : 0.0);
      if (value > this->Most && AreCubeCharts(this->Mesh, charts.Labels))
      {
        this->Most = value;
        this->Found = std::move(charts);
      }
    }
  }

  // The point of a chart nearest to its centre.
  Index MiddleOf(const std::vector<ChartLabel>& labels, int label) const
  {
    Vector3d centre = Vector3d::Zero();
    double area = 0.0;
    for (std::size_t t = 0; t < labels.size(); ++t)
    {
      if (labels[t] == label)
      {
        centre += this->Areas[t] * this->Centres[t];
        area += this->Areas[t];
      }
    }
    centre /= area;
    Index nearest = -1;
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t t = 0; t < labels.size(); ++t)
    {
      for (const Index p : this->Mesh.Triangles[t])
      {
        const double distance = (this->Mesh.Points[p] - centre).squaredNorm();
        if (labels[t] == label && distance < least)
        {
          least = distance;
          nearest = p;
        }
      }
    }
    return nearest;
  }

  void SmoothNormals()
  {
    std::vector<Vector3d> smooth(this->Normals.size());
    for (Index t = 0; t < this->Mesh.NumberOfTriangles(); ++t)
    {
      Vector3d sum = this->Areas[t] * this->Normals[t];
      for (int k = 0; k < 3; ++k)
      {
        const Index other = this->Mesh.Neighbour(t, k);
        sum += this->Areas[other] * this->Normals[other];
      }
      smooth[t] = sum.normalized();
    }
    this->Normals = std::move(smooth);
  }

  // The axes to which the normals cling most, from two starts: the principal axes of the area, and
  // the same turned about the diagonal. Where the normals have no say, the starts themselves count.
  std::vector<Vector3d> Axes() const
  {
    const Matrix3d frame = PrincipalFrame(this->Areas, this->Centres);
    std::vector<Vector3d> axes;
    const auto add = [&axes](const Matrix3d& f)
    {
      for (int a = 2; a >= 0; --a)
      {
        axes.push_back(f.row(a));
      }
    };
    add(frame);
    add(ClingToNormals(this->Areas, this->Normals, frame));
    const Eigen::AngleAxisd turn(0.6, Vector3d(1.0, 1.0, 1.0).normalized());
    add(ClingToNormals(this->Areas, this->Normals, turn.toRotationMatrix() * frame));
    return axes;
  }

  // Far along the axis, but near it.
  Index Extreme(const Vector3d& axis) const
  {
    const auto value = [this, &axis](const Vector3d& point)
    {
      const Vector3d d = point - this->Centre;
      const double along = d.dot(axis);
      return along - 0.5 * (d - along * axis).norm();
    };
    const auto& points = this->Mesh.Points;
    return std::max_element(points.begin(), points.end(),
             [&value](const Vector3d& a, const Vector3d& b) { return value(a) < value(b); }) -
           points.begin();
  }

  // The ends of a longest way along the edges: two sweeps from the point farthest from the centre.
  std::array<Index, 2> FarthestPoints() const
  {
    const auto& points = this->Mesh.Points;
    const auto start = std::max_element(points.begin(), points.end(),
      [this](const Vector3d& a, const Vector3d& b)
      { return (a - this->Centre).squaredNorm() < (b - this->Centre).squaredNorm(); });
    const Index end = FarthestPoint(this->Mesh, start - points.begin());
    return { end, FarthestPoint(this->Mesh, end) };
  }

  std::vector<CylinderCell> CellsOf(const CylinderCoordinates& map) const
  {
    std::vector<CylinderCell> cells(this->Areas.size());
    for (std::size_t t = 0; t < cells.size(); ++t)
    {
      double x = 0.0, y = 0.0, height = 0.0;
      for (const Index p : this->Mesh.Triangles[t])
      {
        x += std::cos(map.Angle[p]);
        y += std::sin(map.Angle[p]);
        height += map.Height[p] / 3.0;
      }
      const double angle = std::atan2(y, x);
      cells[t] = { height, angle < 0.0 ? angle + TwoPi : angle };
    }
    return cells;
  }

  // Labels, frames and alignment from frames that have the third axis right.
  void LabelAndRelabel(const std::vector<CylinderCell>& cells,
    const std::vector<std::size_t>& order, CubeCharts& charts)
  {
    // How the four sides lie around the third axis is tried from several turns.
    this->TurnFrames(this->AngleOfU(cells, charts), charts);
    const CubeCharts start = charts;
    charts.Alignment = -2.0;
    for (int turn = 0; turn < Turns; ++turn)
    {
      CubeCharts trial = start;
      this->TurnFrames(0.25 * TwoPi * turn / Turns, trial);
      for (int round = 0; round < 3; ++round)
      {
        this->Run.Check(this->Done);
        trial.Labels = LabelCylinder(cells, order, this->Areas, this->Rewards(trial));
        this->Refit(trial);
      }
      trial.Alignment = this->AlignmentOf(trial);
      if (trial.Alignment > charts.Alignment)
      {
        charts = std::move(trial);
      }
    }
    KeepLargestPieces(this->Mesh, charts.Labels);
    for (int round = 0; round < 3; ++round)
    {
      RelabelTowardNormals(this->Mesh, this->Rewards(charts), this->Options.Stiffness,
        charts.Labels, this->Run.Part(this->Done, this->Done));
      this->Refit(charts);
      charts.Alignment = this->AlignmentOf(charts);
      if (charts.Alignment < this->Most - Hopeless)
      {
        return;
      }
    }
  }

  CubeCharts StraightFrames(const Vector3d& axis) const
  {
    CubeCharts charts;
    charts.Frames = { Matrix3d::Identity() };
    charts.Frames[0].row(2) = axis;
    charts.Frames[0].row(0) = axis.unitOrthogonal();
    charts.Frames[0].row(1) = axis.cross(axis.unitOrthogonal());
    charts.FrameOfTriangle.assign(this->Areas.size(), 0);
    return charts;
  }

  // Frames along the centres of slabs of equal area between the poles, each turned from the last as
  // little as possible.
  CubeCharts BentFrames(
    const std::vector<CylinderCell>& cells, const std::vector<std::size_t>& order) const
  {
    const int count = this->Options.BendingSegments;
    CubeCharts charts;
    charts.FrameOfTriangle.resize(cells.size());
    std::vector<Vector3d> centres(count, Vector3d::Zero());
    std::vector<double> areas(count, 0.0);
    double covered = 0.0;
    for (const std::size_t t : order)
    {
      const int slab = std::min(count - 1, static_cast<int>(count * covered / this->Area));
      charts.FrameOfTriangle[t] = slab;
      centres[slab] += this->Areas[t] * this->Centres[t];
      areas[slab] += this->Areas[t];
      covered += this->Areas[t];
    }
    for (int slab = 0; slab < count; ++slab)
    {
      centres[slab] /= std::max(areas[slab], 1e-300);
    }
    // The ends of the line stay, the rest is smoothed.
    for (int round = 0; round < count; ++round)
    {
      const std::vector<Vector3d> before = centres;
      for (int slab = 1; slab + 1 < count; ++slab)
      {
        centres[slab] = 0.25 * before[slab - 1] + 0.5 * before[slab] + 0.25 * before[slab + 1];
      }
    }
    Vector3d u = Vector3d::Zero();
    for (int slab = 0; slab < count; ++slab)
    {
      const Vector3d w =
        (centres[std::min(count - 1, slab + 1)] - centres[std::max(0, slab - 1)]).normalized();
      u -= u.dot(w) * w;
      u = u.norm() > 1e-6 ? Vector3d(u.normalized()) : w.unitOrthogonal();
      Matrix3d frame;
      frame << u.transpose(), w.cross(u).transpose(), w.transpose();
      charts.Frames.push_back(frame);
    }
    return charts;
  }

  // Where u is on the cylinder: at the angle whose sides look along it.
  double AngleOfU(const std::vector<CylinderCell>& cells, const CubeCharts& charts) const
  {
    double x = 0.0, y = 0.0;
    for (std::size_t t = 0; t < cells.size(); ++t)
    {
      const Vector3d n =
        this->Areas[t] * (charts.Frames[charts.FrameOfTriangle[t]] * this->Normals[t]);
      const double c = std::cos(cells[t].Angle), s = std::sin(cells[t].Angle);
      x += c * n[0] + s * n[1];
      y += c * n[1] - s * n[0];
    }
    return std::atan2(y, x);
  }

  // All frames about their third axes by one angle.
  static void TurnFrames(double angle, CubeCharts& charts)
  {
    const Matrix3d turn = Eigen::AngleAxisd(-angle, Vector3d::UnitZ()).toRotationMatrix();
    for (Matrix3d& frame : charts.Frames)
    {
      frame = turn * frame;
    }
  }

  // Turns each frame toward the normals of its labels, and less so of those of the frames before
  // and after it.
  void Refit(CubeCharts& charts) const
  {
    std::vector<Matrix3d> correlations(charts.Frames.size(), Matrix3d::Zero());
    for (std::size_t t = 0; t < charts.Labels.size(); ++t)
    {
      correlations[charts.FrameOfTriangle[t]].row(charts.Labels[t] / 2) +=
        SignOf(charts.Labels[t]) * this->Areas[t] * this->Normals[t].transpose();
    }
    const std::size_t last = correlations.size() - 1;
    for (int round = 0; round < FrameSmoothing; ++round)
    {
      const std::vector<Matrix3d> before = correlations;
      for (std::size_t i = 0; i <= last; ++i)
      {
        correlations[i] =
          0.25 * before[i > 0 ? i - 1 : i] + 0.5 * before[i] + 0.25 * before[std::min(last, i + 1)];
      }
    }
    std::transform(
      correlations.begin(), correlations.end(), charts.Frames.begin(), ClosestRotation);
  }

  ChartRewards Rewards(const CubeCharts& charts) const
  {
    ChartRewards rewards(this->Areas.size());
    for (std::size_t t = 0; t < rewards.size(); ++t)
    {
      const Vector3d n =
        this->Areas[t] * (charts.Frames[charts.FrameOfTriangle[t]] * this->Normals[t]);
      rewards[t] = { -n[0], n[0], -n[1], n[1], -n[2], n[2] };
    }
    return rewards;
  }

  // With the surface's own normals, not the smoothed ones.
  double AlignmentOf(const CubeCharts& charts) const
  {
    double sum = 0.0;
    for (Index t = 0; t < this->Mesh.NumberOfTriangles(); ++t)
    {
      const ChartLabel label = charts.Labels[t];
      sum += SignOf(label) *
             charts.Frames[charts.FrameOfTriangle[t]].row(label / 2).dot(this->Mesh.AreaVector(t));
    }
    return sum / this->Area;
  }

  const SurfaceMesh& Mesh;
  const CubeChartOptions& Options;
  const Execution& Run;
  ConformalCylinder Cylinder;
  std::vector<double> Areas;
  std::vector<Vector3d> Normals, Centres;
  double Area = 0.0;
  Vector3d Centre = Vector3d::Zero();
  CubeCharts Found;
  double Most = -2.0; // the value of what was found
  double Done = 0.0;  // share of the work
};
}

//------------------------------------------------------------------------------
CubeCharts FindCubeCharts(
  const SurfaceMesh& mesh, const CubeChartOptions& options, const Execution& execution)
{
  Index pieces = 0;
  mesh.Components(pieces);
  if (pieces != 1 || mesh.EulerCharacteristic() != 2)
  {
    throw std::invalid_argument(
      "The surface has " + std::to_string(pieces) + " piece(s) and Euler characteristic " +
      std::to_string(mesh.EulerCharacteristic()) +
      "; one cube needs one piece without handles (Euler characteristic 2).");
  }
  return Search(mesh, options, execution).Best();
}
}
