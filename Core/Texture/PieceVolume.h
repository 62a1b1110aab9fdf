// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// Where the own voxels of a piece lie in the piece and in the volume, and the volume from all.
#ifndef trivariate_PieceVolume_h
#define trivariate_PieceVolume_h

#include "TextureSegmentation.h"

#include <algorithm>
#include <cstring>

namespace trivariate
{
using Size3 = std::array<Index, 3>;

inline Index Volume(const Size3& size)
{
  return size[0] * size[1] * size[2];
}

inline Size3 OwnSize(const SegmentationPiece& piece)
{
  return { piece.End[0] - piece.Begin[0], piece.End[1] - piece.Begin[1],
    piece.End[2] - piece.Begin[2] };
}

// Calls f(place among the own voxels, place in the piece, place in the volume) row by row.
template <typename F>
void ForOwnRows(const SegmentationPiece& piece, const F& f)
{
  const Size3 own = OwnSize(piece);
  for (Index k = 0; k < own[2]; ++k)
  {
    for (Index j = 0; j < own[1]; ++j)
    {
      const Size3 p = { piece.Begin[0], piece.Begin[1] + j, piece.Begin[2] + k };
      f(own[0] * (j + own[1] * k), p[0] + piece.Size[0] * (p[1] + piece.Size[1] * p[2]),
        p[0] + piece.Low[0] +
          piece.Whole[0] * (p[1] + piece.Low[1] + piece.Whole[1] * (p[2] + piece.Low[2])));
    }
  }
}

// The own voxels of a piece as a part of the volume, half open.
struct PieceBox
{
  Size3 Low, High;

  bool Has(Index inVolume, const Size3& whole) const
  {
    const Size3 p = { inVolume % whole[0], inVolume / whole[0] % whole[1],
      inVolume / (whole[0] * whole[1]) };
    return p[0] >= this->Low[0] && p[0] < this->High[0] && p[1] >= this->Low[1] &&
           p[1] < this->High[1] && p[2] >= this->Low[2] && p[2] < this->High[2];
  }
};

inline PieceBox OwnBox(const SegmentationPiece& piece)
{
  PieceBox box;
  for (int a = 0; a < 3; ++a)
  {
    box.Low[a] = piece.Low[a] + piece.Begin[a];
    box.High[a] = piece.Low[a] + piece.End[a];
  }
  return box;
}

//------------------------------------------------------------------------------
// One byte a voxel of the whole volume, from what each process has of it.
inline std::vector<std::uint8_t> GatherVolume(
  const SegmentationPiece& piece, const std::vector<std::uint8_t>& mine, const GatherBytes& gather)
{
  const Size3 own = OwnSize(piece);
  std::vector<std::uint8_t> message;
  ForOwnRows(piece,
    [&](Index place, Index, Index inVolume)
    {
      const Index head[2] = { inVolume, own[0] };
      const std::size_t at = message.size();
      message.resize(at + sizeof(head) + own[0]);
      std::memcpy(&message[at], head, sizeof(head));
      std::copy_n(&mine[place], own[0], &message[at + sizeof(head)]);
    });
  const std::vector<std::uint8_t> all = gather(message);
  std::vector<std::uint8_t> volume(Volume(piece.Whole), 0);
  for (std::size_t at = 0; at < all.size();)
  {
    Index head[2];
    std::memcpy(head, &all[at], sizeof(head));
    std::copy_n(&all[at + sizeof(head)], head[1], &volume[head[0]]);
    at += sizeof(head) + head[1];
  }
  return volume;
}
}

#endif
