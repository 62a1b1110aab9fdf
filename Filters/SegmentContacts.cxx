// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
#include "SegmentContacts.h"

#include "Domain/ContactPatch.h"

#include <algorithm>
#include <set>
#include <stdexcept>

namespace trivariate
{
namespace
{
constexpr double ClearOverlap = 0.5; // of a face of several cubes with the disc
constexpr double LeastOverlap = 0.2; // of any face

struct Side
{
  Index Solid;
  std::vector<Index> Triangles, Outline; // of the solid's mesh
  Index Face = -1;
  std::array<Index, 4> Corners{}; // where in the outline
};

struct Contact
{
  std::array<Side, 2> Sides;
  double Area = 0.0;
  Index Shift = 0; // of CommonCorners
  std::string Refused;
};

LatticeMotion Product(const LatticeMotion& a, const LatticeMotion& b)
{
  return { a.Turn * b.Turn, a.Turn * b.Shift + a.Shift };
}

class Sharing
{
public:
  Sharing(const LabelledSurface& surface, std::vector<SolidSegment>& solids,
    const DomainOptions& options, const Execution& execution)
    : Solids(solids)
    , Options(options)
    , Run(execution)
  {
    this->FindContacts(surface);
  }

  SegmentContacts Result()
  {
    this->ChooseBases();
    for (Contact& contact : this->Contacts)
    {
      if (contact.Refused.empty())
      {
        this->Match(contact);
      }
    }
    std::vector<SegmentDomain> domains;
    std::vector<SharedPatch> shared;
    while (!this->LayOut(domains, shared)) // one contact fewer each time
    {
    }
    SegmentContacts result{ std::move(shared), {} };
    for (const Contact& contact : this->Contacts)
    {
      if (!contact.Refused.empty())
      {
        result.Reasons[this->NamesOf(contact)] = contact.Refused;
      }
    }
    for (std::size_t i = 0; i < domains.size(); ++i)
    {
      this->Solids[i].Domain = std::move(domains[i]);
    }
    return result;
  }

private:
  std::array<int, 2> NamesOf(const Contact& contact) const
  {
    const auto [low, high] = std::minmax(
      this->Solids[contact.Sides[0].Solid].Segment, this->Solids[contact.Sides[1].Solid].Segment);
    return { low, high };
  }

  void FindContacts(const LabelledSurface& surface)
  {
    std::map<int, Index> solidOf;
    for (std::size_t i = 0; i < this->Solids.size(); ++i)
    {
      solidOf[this->Solids[i].Segment] = static_cast<Index>(i);
    }
    std::map<std::array<Index, 2>, std::vector<Index>> common;
    for (std::size_t t = 0; t < surface.Labels.size(); ++t)
    {
      const auto a = solidOf.find(surface.Labels[t][0]), b = solidOf.find(surface.Labels[t][1]);
      if (a != solidOf.end() && b != solidOf.end() && a != b)
      {
        common[{ std::min(a->second, b->second), std::max(a->second, b->second) }].push_back(
          static_cast<Index>(t));
      }
    }
    for (const auto& [pair, triangles] : common)
    {
      this->Contacts.push_back(this->ContactOf(pair, triangles));
    }
    std::stable_sort(this->Contacts.begin(), this->Contacts.end(),
      [](const Contact& a, const Contact& b) { return a.Area > b.Area; });
  }

  // The same points around the disc on both sides, in the order of the first one.
  Contact ContactOf(const std::array<Index, 2>& pair, const std::vector<Index>& triangles) const
  {
    Contact contact;
    for (int side = 0; side < 2; ++side)
    {
      const SurfacePiece& piece = this->Solids[pair[side]].Piece;
      contact.Sides[side].Solid = pair[side];
      for (const Index t : triangles) // origins ascend
      {
        const auto place = std::lower_bound(piece.Origins.begin(), piece.Origins.end(), t);
        contact.Sides[side].Triangles.push_back(place - piece.Origins.begin());
      }
    }
    Side &first = contact.Sides[0], &second = contact.Sides[1];
    const SurfaceMesh &mesh = this->Solids[first.Solid].Piece.Mesh,
                      &other = this->Solids[second.Solid].Piece.Mesh;
    std::map<Index, Index> twin; // of points
    for (std::size_t i = 0; i < triangles.size(); ++i)
    {
      const Index t = first.Triangles[i];
      contact.Area += mesh.AreaVector(t).norm();
      for (const Index p : mesh.Triangles[t])
      {
        const Triangle& c = other.Triangles[second.Triangles[i]];
        twin[p] = *std::find_if(
          c.begin(), c.end(), [&](Index q) { return other.Points[q] == mesh.Points[p]; });
      }
    }
    try
    {
      first.Outline = OutlineOfDisc(mesh, first.Triangles);
      second.Outline.resize(first.Outline.size());
      std::transform(first.Outline.begin(), first.Outline.end(), second.Outline.rbegin(),
        [&twin](Index p) { return twin.at(p); });
    }
    catch (const std::invalid_argument& error)
    {
      contact.Refused = error.what();
    }
    return contact;
  }

  // Domains that have a face for each disc: those found, or of one cube.
  void ChooseBases()
  {
    for (std::size_t i = 0; i < this->Solids.size(); ++i)
    {
      const SolidSegment& solid = this->Solids[i];
      bool clear = true, touching = false;
      for (const Contact& contact : this->Contacts)
      {
        for (const Side& side : contact.Sides)
        {
          if (contact.Refused.empty() && side.Solid == static_cast<Index>(i))
          {
            touching = true;
            clear = clear && FaceOver(solid.Domain, side.Triangles).Overlap > ClearOverlap;
          }
        }
      }
      const bool other = touching && !clear && solid.Domain.Cubes.Cubes.size() > 1;
      this->Bases.push_back(other ? this->OneCube(solid) : solid.Domain);
    }
  }

  SegmentDomain OneCube(const SolidSegment& solid) const
  {
    DomainOptions options = this->Options;
    options.MostCubes = 1;
    try
    {
      return FindDomain(solid.Piece.Mesh, options, this->Run.Part(0.0, 0.3));
    }
    catch (const std::runtime_error&) // handles
    {
      return solid.Domain;
    }
  }

  // A face on each side, and common corners.
  void Match(Contact& contact) const
  {
    std::array<std::array<Eigen::Vector3d, 4>, 2> corners;
    for (int i = 0; i < 2; ++i)
    {
      Side& side = contact.Sides[i];
      const SegmentDomain& base = this->Bases[side.Solid];
      const FaceMatch match = FaceOver(base, side.Triangles);
      side.Face = match.Face;
      if (match.Overlap < LeastOverlap)
      {
        contact.Refused = "the common surface is no face of segment " +
                          std::to_string(this->Solids[side.Solid].Segment) + "'s cubes";
        return;
      }
      for (int k = 0; k < 4; ++k)
      {
        corners[i][k] = base.Places[base.Cubes.Faces[match.Face].Corners[k]];
      }
    }
    std::vector<Eigen::Vector3d> outline;
    const Side& first = contact.Sides[0];
    for (const Index p : first.Outline)
    {
      outline.push_back(this->Solids[first.Solid].Piece.Mesh.Points[p]);
    }
    try
    {
      const CommonCorners common = MeetCorners(outline, corners[0], corners[1]);
      contact.Shift = common.Shift;
      for (Index k = 0; k < 4; ++k)
      {
        contact.Sides[0].Corners[k] = common.Places[k];
        contact.Sides[1].Corners[(common.Shift - k + 4) % 4] =
          static_cast<Index>(outline.size()) - 1 - common.Places[k];
      }
    }
    catch (const std::invalid_argument& error)
    {
      contact.Refused = error.what();
    }
  }

  // Whether the disc or its face meets those of other contacts of the same solid.
  bool IsApart(const Side& side, const std::vector<const Side*>& others) const
  {
    const auto points = [this](const Side& s)
    { return std::set<Index>(s.Outline.begin(), s.Outline.end()); };
    const auto corners = [this](const Side& s)
    {
      const auto& all = this->Bases[s.Solid].Cubes.Faces[s.Face].Corners;
      return std::set<Index>(all.begin(), all.end());
    };
    const auto meet = [](const std::set<Index>& a, const std::set<Index>& b)
    { return std::any_of(a.begin(), a.end(), [&b](Index value) { return b.count(value) > 0; }); };
    return std::none_of(others.begin(), others.end(),
      [&](const Side* other)
      { return meet(points(side), points(*other)) || meet(corners(side), corners(*other)); });
  }

  // The cubes of a cluster, moved once more.
  std::set<LatticePoint> CubesOf(Index wanted, const std::vector<Index>& cluster,
    const std::vector<LatticeMotion>& motions, const LatticeMotion& step) const
  {
    std::set<LatticePoint> cubes;
    for (std::size_t i = 0; i < cluster.size(); ++i)
    {
      for (const LatticePoint& low : this->Bases[i].Cubes.Cubes)
      {
        if (cluster[i] == wanted)
        {
          cubes.insert(Product(step, motions[i]).OfCube(low));
        }
      }
    }
    return cubes;
  }

  // The contacts that go together, with the place of each solid in the lattice of its cluster.
  // False where one more had to be refused.
  bool Arrange(std::vector<const Contact*>& chosen, std::vector<LatticeMotion>& motions)
  {
    std::vector<Index> cluster(this->Solids.size());
    std::vector<std::vector<const Side*>> sides(this->Solids.size());
    motions.assign(this->Solids.size(), {});
    for (std::size_t i = 0; i < cluster.size(); ++i)
    {
      cluster[i] = static_cast<Index>(i);
    }
    for (Contact& contact : this->Contacts)
    {
      if (!contact.Refused.empty())
      {
        continue;
      }
      const Side &first = contact.Sides[0], &second = contact.Sides[1];
      if (!this->IsApart(first, sides[first.Solid]) || !this->IsApart(second, sides[second.Solid]))
      {
        contact.Refused = "the common surface meets one with another segment";
      }
      else if (cluster[first.Solid] == cluster[second.Solid])
      {
        contact.Refused = "they share surfaces with others around a ring";
      }
      if (!contact.Refused.empty())
      {
        return false;
      }
      // All of the second one's cluster moves to the first one's.
      const LatticeMotion onto = Product(
        motions[first.Solid], MotionOnto(this->Bases[first.Solid].Cubes, first.Face,
                                this->Bases[second.Solid].Cubes, second.Face, contact.Shift));
      const Eigen::Matrix3i back = motions[second.Solid].Turn.transpose();
      const LatticeMotion step = Product(onto, { back, -back * motions[second.Solid].Shift });
      const Index from = cluster[second.Solid];
      const std::set<LatticePoint> there =
                                     this->CubesOf(cluster[first.Solid], cluster, motions, {}),
                                   added = this->CubesOf(from, cluster, motions, step);
      if (std::any_of(added.begin(), added.end(),
            [&there](const LatticePoint& cube) { return there.count(cube) > 0; }))
      {
        contact.Refused = "their cubes would overlap";
        return false;
      }
      for (std::size_t i = 0; i < cluster.size(); ++i)
      {
        if (cluster[i] == from)
        {
          cluster[i] = cluster[first.Solid];
          motions[i] = Product(step, motions[i]);
        }
      }
      sides[first.Solid].push_back(&first);
      sides[second.Solid].push_back(&second);
      chosen.push_back(&contact);
    }
    return true;
  }

  void Refuse(Index solid, const std::string& reason)
  {
    for (Contact& contact : this->Contacts)
    {
      for (const Side& side : contact.Sides)
      {
        if (side.Solid == solid && contact.Refused.empty())
        {
          contact.Refused = reason;
        }
      }
    }
  }

  // New domains for all solids with contacts; false where a contact had to be refused.
  bool LayOut(std::vector<SegmentDomain>& domains, std::vector<SharedPatch>& shared)
  {
    std::vector<const Contact*> chosen;
    std::vector<LatticeMotion> motions;
    if (!this->Arrange(chosen, motions))
    {
      return false;
    }
    domains.clear();
    shared.assign(chosen.size(), {});
    for (std::size_t i = 0; i < this->Solids.size(); ++i)
    {
      const Index solid = static_cast<Index>(i);
      std::vector<ContactPatch> patches;
      std::vector<Index*> faces; // of the shared patches, to be filled in
      for (std::size_t c = 0; c < chosen.size(); ++c)
      {
        for (int s = 0; s < 2; ++s)
        {
          const Side& side = chosen[c]->Sides[s];
          if (side.Solid == solid)
          {
            patches.push_back({ side.Face, side.Triangles, side.Outline, side.Corners });
            faces.push_back(s == 0 ? &shared[c].FirstPatch : &shared[c].SecondPatch);
            (s == 0 ? shared[c].First : shared[c].Second) = solid;
          }
        }
      }
      if (patches.empty())
      {
        domains.push_back(this->Solids[i].Domain);
        continue;
      }
      try
      {
        ContactDomain found = DomainWithContacts(this->Solids[i].Piece.Mesh, this->Bases[i],
          motions[i], patches, this->Run.Part(0.3 + 0.7 * i / this->Solids.size(), 1.0));
        for (std::size_t f = 0; f < faces.size(); ++f)
        {
          *faces[f] = found.Faces[f];
        }
        domains.push_back(std::move(found.Domain));
      }
      catch (const std::logic_error& error)
      {
        this->Refuse(solid, std::string("no domain has it as a patch: ") + error.what());
        return false;
      }
      catch (const std::runtime_error& error)
      {
        this->Refuse(solid, std::string("no domain has it as a patch: ") + error.what());
        return false;
      }
    }
    for (const SharedPatch& patch : shared)
    {
      const std::vector<std::string> messages = CheckContact(
        domains[patch.First], patch.FirstPatch, domains[patch.Second], patch.SecondPatch);
      if (!messages.empty())
      {
        this->Refuse(patch.Second, messages.front());
        return false;
      }
    }
    return true;
  }

  std::vector<SolidSegment>& Solids;
  const DomainOptions& Options;
  const Execution& Run;
  std::vector<SegmentDomain> Bases; // of each solid: what is laid out anew
  std::vector<Contact> Contacts;    // the largest first
};
}

//------------------------------------------------------------------------------
SegmentContacts ShareContacts(const LabelledSurface& surface, std::vector<SolidSegment>& solids,
  const DomainOptions& options, const Execution& execution)
{
  return Sharing(surface, solids, options, execution).Result();
}
}
