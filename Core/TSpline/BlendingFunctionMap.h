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

/**
 * Open addressing with linear probing over small slots; the functions themselves stand in the order
 * of their insertion, near their neighbours. An erased entry stays as a tombstone until the table
 * grows.
 */
class BlendingFunctionMap
{
public:
  /// The id stored for f, after storing `id` (>= 0) if there was none; and whether it was stored.
  std::pair<Index, bool> Insert(const BlendingFunction& f, Index id)
  {
    if (2 * (this->Entries.size() + 1) > this->Slots.size())
    {
      this->Rebuild(2 * this->Slots.size());
    }
    Slot& slot = this->Slots[this->Locate(f)];
    if (slot.Entry != Empty)
    {
      return { this->Entries[slot.Entry].Id, false };
    }
    slot = { TagOf(f), static_cast<std::int32_t>(this->Entries.size()) };
    this->Entries.push_back({ f, id });
    return { id, true };
  }

  /// The id stored for f, or -1.
  Index Find(const BlendingFunction& f) const
  {
    const Slot& slot = this->Slots[this->Locate(f)];
    return slot.Entry == Empty ? -1 : this->Entries[slot.Entry].Id;
  }

  void Erase(const BlendingFunction& f)
  {
    const Slot& slot = this->Slots[this->Locate(f)];
    if (slot.Entry != Empty)
    {
      this->Entries[slot.Entry].Id = Erased;
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
      this->Rebuild(size);
    }
    this->Entries.reserve(n);
  }

private:
  static constexpr std::int32_t Empty = -1;
  static constexpr Index Erased = -1;
  struct Slot
  {
    std::uint32_t Tag = 0; // of the function, so that few others are looked at
    std::int32_t Entry = Empty;
  };
  struct Entry
  {
    BlendingFunction Function;
    Index Id;
  };

  static std::uint32_t TagOf(const BlendingFunction& f)
  {
    return static_cast<std::uint32_t>(
      HashKnots(f[0]) * 31 + HashKnots(f[1]) * 17 + HashKnots(f[2]));
  }

  // The slot of f, or the empty slot where it belongs.
  std::size_t Locate(const BlendingFunction& f) const
  {
    const std::size_t mask = this->Slots.size() - 1;
    const std::uint32_t tag = TagOf(f);
    std::size_t at = tag & mask;
    while (this->Slots[at].Entry != Empty && !this->Holds(this->Slots[at], tag, f))
    {
      at = (at + 1) & mask;
    }
    return at;
  }

  bool Holds(const Slot& slot, std::uint32_t tag, const BlendingFunction& f) const
  {
    return slot.Tag == tag && this->Entries[slot.Entry].Id != Erased &&
           this->Entries[slot.Entry].Function == f;
  }

  void Rebuild(std::size_t size)
  {
    std::vector<Entry> old;
    old.reserve(size / 2);
    old.swap(this->Entries);
    this->Slots.assign(size, {});
    for (const Entry& entry : old)
    {
      if (entry.Id != Erased)
      {
        this->Slots[this->Locate(entry.Function)] = { TagOf(entry.Function),
          static_cast<std::int32_t>(this->Entries.size()) };
        this->Entries.push_back(entry);
      }
    }
  }

  std::vector<Slot> Slots = std::vector<Slot>(64);
  std::vector<Entry> Entries; // with the tombstones
};
}

#endif
