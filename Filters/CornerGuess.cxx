// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "CornerGuess.h"

#include "Domain/TriangleTree.h"
#include "SegmentDomains.h"

#include <algorithm>
#include <stdexcept>
#include <string>

namespace trivariate
{
namespace
{
Eigen::AlignedBox3d BoxOf(const SurfaceMesh& mesh)
{
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& point : mesh.Points)
  {
    box.extend(point);
  }
  return box;
}
}

//------------------------------------------------------------------------------
bool CornerGuess::IsFor(const SurfaceMesh& mesh, const DomainOptions& options) const
{
  return this->Mesh.Points == mesh.Points && this->Mesh.Triangles == mesh.Triangles &&
         this->Options.CornerCost == options.CornerCost &&
         this->Options.MostCubes == options.MostCubes && this->Options.Relax == options.Relax;
}

//------------------------------------------------------------------------------
const SegmentDomain& CornerGuess::Automatic(const Execution& execution)
{
  if (!this->Found && this->Failure.empty())
  {
    try
    {
      this->SetAutomatic(DomainOf(this->Mesh, this->Options, execution));
    }
    catch (const std::logic_error& error)
    {
      this->SetFailure(error.what());
    }
    catch (const std::runtime_error& error)
    {
      this->SetFailure(error.what());
    }
  }
  if (!this->Found)
  {
    throw std::runtime_error(this->Failure);
  }
  return *this->Found;
}

//------------------------------------------------------------------------------
void CornerGuess::SetAutomatic(SegmentDomain domain)
{
  this->Found = std::make_unique<SegmentDomain>(std::move(domain));
  this->Failure.clear();
}

//------------------------------------------------------------------------------
void CornerGuess::SetFailure(std::string why)
{
  this->Found.reset();
  this->Failure = std::move(why);
}

//------------------------------------------------------------------------------
Polycube CornerGuess::Shape(
  const int size[3], const std::vector<int>& switchedOff, const Execution& execution)
{
  if (size[0] == 0 && size[1] == 0 && size[2] == 0)
  {
    if (!switchedOff.empty())
    {
      throw std::invalid_argument(
        "Cubes can be switched off only where NumberOfCubes is given, not (0, 0, 0).");
    }
    return this->Automatic(execution).Cubes;
  }
  if (switchedOff.empty())
  {
    return Polycube::FromGrid({ size[0], size[1], size[2] });
  }
  const long count = long(std::max(size[0], 0)) * std::max(size[1], 0) * std::max(size[2], 0);
  std::vector<unsigned char> present(count, 1);
  for (const int cube : switchedOff)
  {
    if (cube < 0 || cube >= count)
    {
      throw std::invalid_argument("There is no cube " + std::to_string(cube) +
                                  " to be switched off; the shape has cubes 0 to " +
                                  std::to_string(count - 1) + ".");
    }
    present[cube] = 0;
  }
  return Polycube::FromGrid({ size[0], size[1], size[2] }, present);
}

//------------------------------------------------------------------------------
const CornerGuess::EightCorners& CornerGuess::OneCube(const Execution& execution)
{
  if (!this->FoundCube)
  {
    this->FoundCube = std::make_unique<EightCorners>(this->FindOneCube(execution));
  }
  return *this->FoundCube;
}

//------------------------------------------------------------------------------
CornerGuess::EightCorners CornerGuess::FindOneCube(const Execution& execution)
{
  EightCorners corners;
  try
  {
    const SegmentDomain* domain = &this->Automatic(execution.Part(0.0, 0.5));
    SegmentDomain single = *domain;
    if (domain->Cubes.Cubes.size() != 1)
    {
      DomainOptions oneCube = this->Options;
      oneCube.MostCubes = 1;
      single = FindDomain(this->Mesh, oneCube, execution.Part(0.5, 1.0));
    }
    std::copy_n(single.Places.begin(), 8, corners.begin());
  }
  catch (const Aborted&)
  {
    throw;
  }
  catch (const std::exception&) // handles, for one
  {
    const Eigen::AlignedBox3d box = BoxOf(this->Mesh);
    for (int i = 0; i < 8; ++i)
    {
      corners[i] = box.corner(static_cast<Eigen::AlignedBox3d::CornerType>(i));
    }
  }
  return corners;
}

//------------------------------------------------------------------------------
std::vector<Eigen::Vector3d> CornerGuess::Corners(const Polycube& shape, const Execution& execution)
{
  if (this->Found && this->Found->Cubes.Cubes == shape.Cubes)
  {
    const auto begin = this->Found->Places.begin();
    return { begin, begin + shape.NumberOfCorners };
  }
  const EightCorners& corners = this->OneCube(execution);
  Eigen::AlignedBox3d lattice;
  for (const LatticePoint& point : shape.Points)
  {
    lattice.extend(Eigen::Vector3d(point[0], point[1], point[2]));
  }
  const TriangleTree tree(this->Mesh.Points, this->Mesh.Triangles);
  std::vector<Eigen::Vector3d> places;
  for (Index i = 0; i < shape.NumberOfCorners; ++i)
  {
    const LatticePoint& point = shape.Points[i];
    const Eigen::Array3d share =
      (Eigen::Array3d(point[0], point[1], point[2]) - lattice.min().array()) /
      lattice.sizes().array();
    Eigen::Vector3d place = Eigen::Vector3d::Zero();
    for (int c = 0; c < 8; ++c)
    {
      place += (c & 1 ? share[0] : 1.0 - share[0]) * (c & 2 ? share[1] : 1.0 - share[1]) *
               (c & 4 ? share[2] : 1.0 - share[2]) * corners[c];
    }
    places.push_back(tree.Nearest(place).Place);
  }
  return places;
}
}
