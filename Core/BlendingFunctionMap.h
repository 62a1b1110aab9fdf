// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A hash map from blending functions (their knots) to ids.
#ifndef trivariate_BlendingFunctionMap_h
#define trivariate_BlendingFunctionMap_h

#include "TSpline.h"

#include <algorithm>
#include <vector>

namespace trivariate
{
/// Mixes the bits of any number of knot indices (the finaliser of SplitMix64 after each).
template <typename Knots>
std::size_t HashKnots(const Knots& knots)
{
  std::uint64_t h = 0;
  for (const std::int32_t k : knots)
  {
    h += 0x9e3779b97f4a7c15u + static_cast<std::uint32_t>(k);
    h = (h ^ (h >> 30)) * 0xbf58476d1ce4e5b9u;
    h ^= h >> 27;
  }
  return static_cast<std::size_t>(h);
}

struct LocalKnotsHash
{
  std::size_t operator()(const LocalKnots& k) const { return HashKnots(k); }
};

/// Open addressing with linear probing; an erased entry leaves a tombstone until the table grows.
class BlendingFunctionMap
{
public:
  /// The id stored for f, after storing `id` (>= 0) if there was none; and whether it was stored.
  std::pair<Index, bool> Insert(const BlendingFunction& f, Index id)
  {
    if (2 * (this->Used + 1) > this->Slots.size())
    {
      this->Grow(2 * this->Slots.size());
    }
    Slot& slot = this->Slots[this->Locate(f)];
    if (slot.Id >= 0)
    {
      return { slot.Id, false };
    }
    slot = { f, id };
    ++this->Used;
    return { id, true };
  }

  /// The id stored for f, or -1.
  Index Find(const BlendingFunction& f) const
  {
    return std::max<Index>(-1, this->Slots[this->Locate(f)].Id);
  }

  void Erase(const BlendingFunction& f)
  {
    Slot& slot = this->Slots[this->Locate(f)];
    if (slot.Id >= 0)
    {
      slot.Id = Erased;
    }
  }

  void Reserve(std::size_t n)
  {
    std::size_t size = this->Slots.size();
    while (size < 2 * (n + 1))
    {
      size *= 2;
    }
    if (size > this->Slots.size())
    {
      this->Grow(size);
    }
  }

private:
  static constexpr Index Empty = -1, Erased = -2;
  struct Slot
  {
    BlendingFunction Function{};
    Index Id = Empty;
  };

  // The slot of f, or the empty slot where it belongs.
  std::size_t Locate(const BlendingFunction& f) const
  {
    const std::size_t mask = this->Slots.size() - 1;
    std::size_t at = (HashKnots(f[0]) * 31 + HashKnots(f[1]) * 17 + HashKnots(f[2])) & mask;
    while (
      this->Slots[at].Id == Erased || (this->Slots[at].Id >= 0 && this->Slots[at].Function != f))
    {
      at = (at + 1) & mask;
    }
    return at;
  }

  void Grow(std::size_t size)
  {
    std::vector<Slot> old(size);
    old.swap(this->Slots);
    this->Used = 0;
    for (const Slot& slot : old)
    {
      if (slot.Id >= 0)
      {
        this->Slots[this->Locate(slot.Function)] = slot;
        ++this->Used;
      }
    }
  }

  std::vector<Slot> Slots = std::vector<Slot>(64);
  std::size_t Used = 0; // with the tombstones
};
}

#endif
