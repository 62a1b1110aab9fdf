// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "OwnAxes.h"

#include "Domain/ClosestRotation.h"
#include "NormalAxes.h"

#include <Eigen/Geometry>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <limits>
#include <numeric>

namespace trivariate
{
namespace
{
using Eigen::AngleAxisd;
using Eigen::Matrix3d;
using Eigen::Vector3d;
using Vector9d = Eigen::Matrix<double, 9, 1>;
using Matrix9d = Eigen::Matrix<double, 9, 9>;

constexpr double Pi = 3.14159265358979323846;
constexpr double LeastGap = 1e-4;      // between moments along principal axes, of the largest
constexpr double LeastHarmonic = 1e-4; // of what it could be
constexpr double Stronger = 1.01;      // of harmonics as strong the lowest counts
constexpr int LowestHarmonic = 3, HighestHarmonic = 8;
constexpr double LeastFourth = 1e-4; // above those of a ball, of these
constexpr double SmallShare = 1e-5;  // of moments that count where third ones along axes are zero
constexpr double Same = 1e-13;       // of symmetric points
constexpr int Starts = 32;
constexpr int MostRounds = 1000;
constexpr double Arrived = 1e-15;

// Points about their middle, in units of their root mean square distance from it; weights of sum 1.
struct Cloud
{
  Cloud(const std::vector<double>& weights, const std::vector<Vector3d>& points)
    : Weights(weights)
    , Points(points)
  {
    const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
    Vector3d middle = Vector3d::Zero();
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      this->Weights[i] /= sum;
      middle += this->Weights[i] * points[i];
    }
    double square = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i)
    {
      this->Points[i] -= middle;
      square += this->Weights[i] * this->Points[i].squaredNorm();
    }
    for (Vector3d& point : this->Points)
    {
      point /= std::sqrt(square);
    }
  }

  std::vector<double> Weights;
  std::vector<Vector3d> Points;
};

// The mean of p . axis to the third power along the first two axes, and a little of what no
// symmetry leaves alone.
double Lopsidedness(const Cloud& cloud, const Matrix3d& frame)
{
  const Vector3d askew(0.8, -0.5, 0.33);
  double sum = 0.0;
  for (std::size_t i = 0; i < cloud.Points.size(); ++i)
  {
    const Vector3d p = frame * cloud.Points[i];
    const double s = askew.dot(p);
    const double any = s * s * s * (1.0 + s + s * s);
    sum += cloud.Weights[i] * (p.x() * p.x() * p.x() + p.y() * p.y() * p.y() + SmallShare * any);
  }
  return sum;
}

// Of those that are as lopsided, the one that turns the points least.
Matrix3d MostLopsided(const Cloud& cloud, const std::vector<Matrix3d>& frames)
{
  std::vector<double> values;
  for (const Matrix3d& frame : frames)
  {
    values.push_back(Lopsidedness(cloud, frame));
  }
  const double most = *std::max_element(values.begin(), values.end());
  Matrix3d best = -Matrix3d::Identity();
  for (std::size_t i = 0; i < frames.size(); ++i)
  {
    best = values[i] >= most - Same && frames[i].trace() > best.trace() ? frames[i] : best;
  }
  return best;
}

// The same axes with other ends first.
std::vector<Matrix3d> Flips(const Matrix3d& frame)
{
  std::vector<Matrix3d> flips;
  for (const Vector3d& signs :
    { Vector3d(1, 1, 1), Vector3d(1, -1, -1), Vector3d(-1, 1, -1), Vector3d(-1, -1, 1) })
  {
    flips.push_back(signs.asDiagonal() * frame);
  }
  return flips;
}

// Also with other axes first.
std::vector<Matrix3d> Turns(const Matrix3d& frame)
{
  std::vector<Matrix3d> turns;
  const Matrix3d third =
    AngleAxisd(2.0 * Pi / 3.0, Vector3d(1.0, 1.0, 1.0).normalized()).toRotationMatrix();
  const Matrix3d quarter = AngleAxisd(0.5 * Pi, Vector3d::UnitZ()).toRotationMatrix();
  Matrix3d turned = frame;
  for (int i = 0; i < 6; ++i)
  {
    const std::vector<Matrix3d> flips = Flips(turned);
    turns.insert(turns.end(), flips.begin(), flips.end());
    turned = (i == 2 ? Matrix3d(quarter * third) : third) * turned;
  }
  return turns;
}

// With an axis of the frame where the strongest harmonic around another one has its peaks.
std::vector<Matrix3d> AtPeaks(const Cloud& cloud, const Matrix3d& frame, int around)
{
  std::array<std::complex<double>, HighestHarmonic + 1> harmonics{};
  std::array<double, HighestHarmonic + 1> most{};
  for (std::size_t i = 0; i < cloud.Points.size(); ++i)
  {
    const Vector3d p = frame * cloud.Points[i];
    const std::complex<double> z(p[(around + 1) % 3], p[(around + 2) % 3]);
    std::complex<double> power = z * z;
    for (int k = LowestHarmonic; k <= HighestHarmonic; ++k)
    {
      power *= z;
      harmonics[k] += cloud.Weights[i] * power;
      most[k] += cloud.Weights[i] * std::abs(power);
    }
  }
  int strongest = LowestHarmonic;
  const auto strength = [&](int k) { return std::abs(harmonics[k]) / most[k]; };
  for (int k = LowestHarmonic; k <= HighestHarmonic; ++k)
  {
    strongest = strength(k) > Stronger * strength(strongest) ? k : strongest;
  }
  std::vector<Matrix3d> frames;
  for (int peak = 0; peak < strongest && strength(strongest) > LeastHarmonic; ++peak)
  {
    const double angle = (std::arg(harmonics[strongest]) + 2.0 * Pi * peak) / strongest;
    const Vector3d axis = Vector3d::Unit(around), peaked = Vector3d::Unit((around + 1) % 3);
    frames.push_back(AngleAxisd(-angle, axis).toRotationMatrix() * frame);
    frames.push_back((2.0 * peaked - Vector3d::Ones()).asDiagonal() * frames.back());
  }
  return frames;
}

// The sum of the fourth moments along the axes of a frame, and its gradient over 4. It is convex,
// so that the rotation closest to the gradient raises it.
class FourthMoments
{
public:
  explicit FourthMoments(const Cloud& cloud)
  {
    for (std::size_t i = 0; i < cloud.Points.size(); ++i)
    {
      const Vector9d square = Square(cloud.Points[i]);
      this->Moments += cloud.Weights[i] * square * square.transpose();
    }
  }

  double Value(const Matrix3d& frame) const
  {
    return frame.cwiseProduct(this->Gradient(frame)).sum();
  }

  Matrix3d Gradient(const Matrix3d& frame) const
  {
    Matrix3d gradient;
    for (int axis = 0; axis < 3; ++axis)
    {
      const Vector9d g = this->Moments * Square(frame.row(axis));
      gradient.row(axis) = frame.row(axis) * Eigen::Map<const Matrix3d>(g.data());
    }
    return gradient;
  }

  // That of a ball with the same squares and fourth powers of distances.
  double OfBall() const
  {
    const Vector9d trace = Eigen::Map<const Vector9d>(Identity().data());
    return 0.6 * trace.dot(this->Moments * trace);
  }

private:
  static const Matrix3d& Identity()
  {
    static const Matrix3d identity = Matrix3d::Identity();
    return identity;
  }

  static Vector9d Square(const Vector3d& p)
  {
    const Matrix3d square = p * p.transpose();
    return Eigen::Map<const Vector9d>(square.data());
  }

  Matrix9d Moments = Matrix9d::Zero();
};

std::vector<Matrix3d> AtFourthMoments(const Cloud& cloud)
{
  const FourthMoments moments(cloud);
  Matrix3d best = Matrix3d::Identity();
  double most = moments.OfBall() * (1.0 + LeastFourth);
  bool found = false;
  for (int start = 0; start < Starts; ++start)
  {
    const double turn = 2.4 * start, height = 1.0 - (2.0 * start + 1.0) / Starts;
    const double radius = std::sqrt(1.0 - height * height);
    Matrix3d frame =
      AngleAxisd(0.1 * start, Vector3d(radius * std::cos(turn), radius * std::sin(turn), height))
        .toRotationMatrix();
    Matrix3d before = Matrix3d::Zero();
    for (int round = 0; round < MostRounds && (frame - before).norm() > Arrived; ++round)
    {
      before = frame;
      frame = ClosestRotation(moments.Gradient(frame));
    }
    if (moments.Value(frame) > most)
    {
      most = moments.Value(frame);
      best = frame;
      found = true;
    }
  }
  return found ? Turns(best) : std::vector<Matrix3d>();
}
}

//------------------------------------------------------------------------------
std::optional<OwnAxes> FindOwnAxes(
  const std::vector<double>& weights, const std::vector<Vector3d>& points)
{
  const Cloud cloud(weights, points);
  const Matrix3d frame = PrincipalFrame(cloud.Weights, cloud.Points);
  Vector3d moments = Vector3d::Zero();
  for (std::size_t i = 0; i < points.size(); ++i)
  {
    moments += cloud.Weights[i] * (frame * cloud.Points[i]).cwiseAbs2();
  }
  const bool firstTwo = moments[1] - moments[0] <= LeastGap * moments[2];
  const bool lastTwo = moments[2] - moments[1] <= LeastGap * moments[2];
  const std::vector<Matrix3d> frames = firstTwo && lastTwo ? AtFourthMoments(cloud)
                                       : firstTwo          ? AtPeaks(cloud, frame, 2)
                                       : lastTwo           ? AtPeaks(cloud, frame, 0)
                                                           : Flips(frame);
  if (frames.empty())
  {
    return std::nullopt;
  }
  return OwnAxes{ MostLopsided(cloud, frames), !firstTwo && !lastTwo };
}
}
