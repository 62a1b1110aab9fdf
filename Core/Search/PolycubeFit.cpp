// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "PolycubeFit.h"

#include "Domain/ClosestRotation.h"

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>
#include <map>

namespace trivariate
{
namespace
{
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double LeastCosine = 0.1; // of normals that face a side
constexpr Index MostSamples = 1500; // of the surface
constexpr Index WantedNodes = 300;
constexpr int MostPerEdge = 8; // parts of an edge of the polycube
constexpr int LeastPerEdge = 3;
constexpr int Rounds = 16;
constexpr double FirstPull = 0.02, LastPull = 20.0; // against the rigidity
constexpr double Sideways = 0.05;                   // of the pull, along the surface
constexpr double LeastStretch = 0.05;               // singular values are not taken for less

// The faces of a polycube cut into n x n quadrilaterals.
class Sheet
{
public:
  Sheet(const Polycube& polycube, const std::vector<Vector3d>& corners)
    : Cubes(polycube)
    , Parts(std::clamp(
        static_cast<int>(std::lround(std::sqrt(WantedNodes / double(polycube.Faces.size())))),
        LeastPerEdge, MostPerEdge))
  {
    std::map<LatticePoint, Index> numbers; // by the lattice times Parts
    for (std::size_t f = 0; f < polycube.Faces.size(); ++f)
    {
      const std::array<Index, 4>& c = polycube.Faces[f].Corners;
      std::vector<Index> nodes;
      for (int j = 0; j <= this->Parts; ++j)
      {
        for (int i = 0; i <= this->Parts; ++i)
        {
          LatticePoint at;
          for (int axis = 0; axis < 3; ++axis)
          {
            const int o = polycube.Points[c[0]][axis];
            at[axis] = this->Parts * o + i * (polycube.Points[c[1]][axis] - o) +
                       j * (polycube.Points[c[3]][axis] - o);
          }
          const auto added = numbers.emplace(at, static_cast<Index>(this->Places.size()));
          if (added.second)
          {
            const double s = double(i) / this->Parts, t = double(j) / this->Parts;
            this->Places.push_back((1 - s) * (1 - t) * corners[c[0]] + s * (1 - t) * corners[c[1]] +
                                   s * t * corners[c[2]] + (1 - s) * t * corners[c[3]]);
            this->Lattice.push_back(at);
            this->Sides.push_back(-1);
          }
          const bool within = i > 0 && j > 0 && i < this->Parts && j < this->Parts;
          if (within)
          {
            this->Sides[added.first->second] = 2 * polycube.Faces[f].Axis + polycube.Faces[f].Side;
          }
          nodes.push_back(added.first->second);
        }
      }
      for (int j = 0; j < this->Parts; ++j)
      {
        for (int i = 0; i < this->Parts; ++i)
        {
          const int low = i + j * (this->Parts + 1), up = low + this->Parts + 1;
          this->Quads.push_back({ nodes[low], nodes[low + 1], nodes[up + 1], nodes[up] });
        }
      }
    }
    for (Index corner = 0; corner < polycube.NumberOfCorners; ++corner)
    {
      LatticePoint at = polycube.Points[corner];
      for (int& x : at)
      {
        x *= this->Parts;
      }
      this->Corners.push_back(numbers.at(at));
    }
  }

  // The slab of an edge of a quadrilateral: its axis, and the lattice's interval.
  std::array<int, 2> SlabOf(Index a, Index b) const
  {
    int axis = 0;
    while (this->Lattice[a][axis] == this->Lattice[b][axis])
    {
      ++axis;
    }
    return { axis,
      static_cast<int>(std::floor(
        double(std::min(this->Lattice[a][axis], this->Lattice[b][axis])) / this->Parts)) };
  }

  const Polycube& Cubes;
  int Parts;
  std::vector<Vector3d> Places;
  std::vector<LatticePoint> Lattice; // times Parts
  std::vector<int> Sides;            // 2 axis + side; -1 on the polycube's edges
  std::vector<std::array<Index, 4>> Quads;
  std::vector<Index> Corners;
};

// Lengths of a part of each slab along each axis, [axis][slab]: those of the sheet in the mean.
using SlabLengths = std::map<std::array<int, 2>, double>;

SlabLengths LengthsOf(const Sheet& sheet)
{
  std::map<std::array<int, 2>, std::array<double, 2>> sums;
  for (const std::array<Index, 4>& quad : sheet.Quads)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Index a = quad[k], b = quad[(k + 1) % 4];
      std::array<double, 2>& sum = sums[sheet.SlabOf(a, b)];
      sum[0] += (sheet.Places[a] - sheet.Places[b]).norm();
      sum[1] += 1.0;
    }
  }
  SlabLengths lengths;
  for (const auto& [slab, sum] : sums)
  {
    lengths[slab] = std::max(sum[0] / sum[1], 1e-12);
  }
  return lengths;
}

double StretchOf(const Sheet& sheet, const SlabLengths& lengths)
{
  double sum = 0.0, area = 0.0;
  for (const std::array<Index, 4>& quad : sheet.Quads)
  {
    const double a = lengths.at(sheet.SlabOf(quad[0], quad[1]));
    const double b = lengths.at(sheet.SlabOf(quad[1], quad[2]));
    for (int k = 0; k < 4; ++k)
    {
      const Vector3d along =
        (sheet.Places[quad[(k + 1) % 4]] - sheet.Places[quad[k]]) / (k % 2 ? b : a);
      const Vector3d across =
        (sheet.Places[quad[(k + 3) % 4]] - sheet.Places[quad[k]]) / (k % 2 ? a : b);
      const double squares = along.squaredNorm() + across.squaredNorm();
      const double product = std::max(along.cross(across).norm(), LeastStretch * LeastStretch);
      sum += a * b * 0.25 * (squares + squares / (product * product));
      area += a * b;
    }
  }
  return sum / area - 1.0;
}

struct Spring
{
  Index From, To;
  double Weight;
  std::array<int, 2> Slab;
};

// Those of rectangles: the sides of quadrilaterals, each weighed by the length across it.
std::vector<Spring> SpringsOf(const Sheet& sheet, const SlabLengths& lengths)
{
  std::vector<Spring> springs;
  for (const std::array<Index, 4>& quad : sheet.Quads)
  {
    for (int k = 0; k < 4; ++k)
    {
      const Index a = quad[k], b = quad[(k + 1) % 4];
      const std::array<int, 2> slab = sheet.SlabOf(a, b);
      const double across = lengths.at(sheet.SlabOf(b, quad[(k + 2) % 4]));
      springs.push_back({ a, b, 0.5 * across / lengths.at(slab), slab });
    }
  }
  return springs;
}

struct Pull
{
  Index Node;
  Vector3d Place, Normal;
  double Weight;
};

// One round: rotations of all nodes, then their places.
void Relax(
  Sheet& sheet, const Matrix3d& frame, const SlabLengths& lengths, const std::vector<Pull>& pulls)
{
  const Index n = static_cast<Index>(sheet.Places.size());
  const std::vector<Spring> springs = SpringsOf(sheet, lengths);
  const auto rest = [&](const Spring& s) -> Vector3d
  {
    const int axis = s.Slab[0];
    const double sign = sheet.Lattice[s.To][axis] > sheet.Lattice[s.From][axis] ? 1.0 : -1.0;
    return sign * lengths.at(s.Slab) * frame.row(axis).transpose();
  };
  std::vector<Matrix3d> turns(n, Matrix3d::Zero());
  for (const Spring& s : springs)
  {
    const Matrix3d m = s.Weight * (sheet.Places[s.To] - sheet.Places[s.From]) * rest(s).transpose();
    turns[s.From] += m;
    turns[s.To] += m;
  }
  std::transform(turns.begin(), turns.end(), turns.begin(), ClosestRotation);

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right = Eigen::VectorXd::Zero(3 * n);
  for (const Spring& s : springs)
  {
    const Vector3d wanted = 0.5 * s.Weight * ((turns[s.From] + turns[s.To]) * rest(s));
    right.segment<3>(3 * s.To) += wanted;
    right.segment<3>(3 * s.From) -= wanted;
    for (int k = 0; k < 3; ++k)
    {
      entries.emplace_back(3 * s.From + k, 3 * s.From + k, s.Weight);
      entries.emplace_back(3 * s.To + k, 3 * s.To + k, s.Weight);
      entries.emplace_back(3 * s.From + k, 3 * s.To + k, -s.Weight);
      entries.emplace_back(3 * s.To + k, 3 * s.From + k, -s.Weight);
    }
  }
  for (const Pull& pull : pulls)
  {
    const Matrix3d metric =
      pull.Weight * (pull.Normal * pull.Normal.transpose() + Sideways * Matrix3d::Identity());
    right.segment<3>(3 * pull.Node) += metric * pull.Place;
    for (int i = 0; i < 3; ++i)
    {
      for (int j = 0; j < 3; ++j)
      {
        entries.emplace_back(3 * pull.Node + i, 3 * pull.Node + j, metric(i, j));
      }
    }
  }
  Eigen::SparseMatrix<double> matrix(3 * n, 3 * n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>> solver(matrix);
  const Eigen::VectorXd places = solver.solve(right);
  if (solver.info() == Eigen::Success && places.allFinite())
  {
    for (Index i = 0; i < n; ++i)
    {
      sheet.Places[i] = places.segment<3>(3 * i);
    }
  }
}
}

//------------------------------------------------------------------------------
PolycubeFitter::PolycubeFitter(const SurfaceMesh& mesh, const Matrix3d& frame)
  : Mesh(mesh)
  , Frame(frame)
{
  double volume = 0.0;
  for (Index t = 0; t < mesh.NumberOfTriangles(); ++t)
  {
    const Vector3d area = mesh.AreaVector(t), normal = frame * area.normalized();
    volume += mesh.Points[mesh.Triangles[t][0]].dot(area) / 3.0;
    for (int side = 0; side < 6; ++side)
    {
      if ((side % 2 ? 1.0 : -1.0) * normal[side / 2] > LeastCosine)
      {
        this->Facing[side].push_back(mesh.Triangles[t]);
      }
    }
  }
  this->Size = std::cbrt(std::max(volume, 0.0));
  for (int side = 0; side < 6; ++side)
  {
    this->Trees[side] = std::make_unique<TriangleTree>(mesh.Points, this->Facing[side]);
  }
  const Index step = 1 + mesh.NumberOfTriangles() / MostSamples;
  for (Index t = 0; t < mesh.NumberOfTriangles(); t += step)
  {
    this->Samples.push_back(t);
  }
}

//------------------------------------------------------------------------------
PolycubeFit PolycubeFitter::Fit(
  const Polycube& polycube, const std::vector<Vector3d>& corners, const Execution& execution) const
{
  Sheet sheet(polycube, corners);
  SlabLengths lengths = LengthsOf(sheet);
  const auto middleOf = [this](Index t) -> Vector3d
  {
    const Triangle& c = this->Mesh.Triangles[t];
    return (this->Mesh.Points[c[0]] + this->Mesh.Points[c[1]] + this->Mesh.Points[c[2]]) / 3.0;
  };
  // Two triangles for each quadrilateral: 2 q and 2 q + 1.
  std::vector<Triangle> all;
  for (std::size_t q = 0; q < sheet.Quads.size(); ++q)
  {
    const std::array<Index, 4>& quad = sheet.Quads[q];
    all.push_back({ quad[0], quad[1], quad[2] });
    all.push_back({ quad[0], quad[2], quad[3] });
  }
  double distance = 0.0;
  const double perSample = double(sheet.Places.size()) / double(this->Samples.size());
  for (int round = 0; round <= Rounds; ++round)
  {
    execution.Check(double(round) / Rounds);
    const double pull = FirstPull * std::pow(LastPull / FirstPull, double(round) / Rounds);
    std::vector<Pull> pulls;
    for (std::size_t i = 0; i < sheet.Places.size(); ++i)
    {
      if (sheet.Sides[i] >= 0)
      {
        const std::vector<Triangle>& facing = this->Facing[sheet.Sides[i]];
        const TriangleTree::Foot foot = this->Trees[sheet.Sides[i]]->Nearest(sheet.Places[i]);
        const Triangle& c = facing[foot.Triangle];
        const Vector3d normal = (this->Mesh.Points[c[1]] - this->Mesh.Points[c[0]])
                                  .cross(this->Mesh.Points[c[2]] - this->Mesh.Points[c[0]])
                                  .normalized();
        pulls.push_back({ static_cast<Index>(i), foot.Place, normal, pull });
      }
    }
    const TriangleTree tree(sheet.Places, all);
    double sum = 0.0, weight = 0.0;
    for (const Index t : this->Samples)
    {
      const Vector3d place = middleOf(t);
      const TriangleTree::Foot foot = tree.Nearest(place);
      const Vector3d areaVector = this->Mesh.AreaVector(t);
      sum += areaVector.norm() * foot.Distance * foot.Distance;
      weight += areaVector.norm();
      const Triangle& c = all[foot.Triangle];
      const Vector3d normal =
        (sheet.Places[c[1]] - sheet.Places[c[0]]).cross(sheet.Places[c[2]] - sheet.Places[c[0]]);
      if (normal.dot(areaVector) > 0.0)
      {
        Index node = c[0];
        for (const Index other : c)
        {
          node = (sheet.Places[other] - foot.Place).squaredNorm() <
                     (sheet.Places[node] - foot.Place).squaredNorm()
                   ? other
                   : node;
        }
        pulls.push_back({ node, place + sheet.Places[node] - foot.Place, areaVector.normalized(),
          pull * perSample });
      }
    }
    distance = std::sqrt(sum / weight);
    if (round < Rounds)
    {
      Relax(sheet, this->Frame, lengths, pulls);
      lengths = LengthsOf(sheet);
    }
  }
  PolycubeFit fit{ {}, StretchOf(sheet, lengths), distance / this->Size };
  for (const Index node : sheet.Corners)
  {
    fit.Corners.push_back(sheet.Places[node]);
  }
  return fit;
}
}
