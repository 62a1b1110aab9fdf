// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/// A hash map from blending functions (their knots) to ids.
#ifndef trivariate_BlendingFunctionMap_h
#define trivariate_BlendingFunctionMap_h

#include "TSpline.h"

#include <cstring>
#include <unordered_map>

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

class BlendingFunctionMap
{
public:
  /// The id stored for f, after storing `id` if there was none; and whether it was stored.
  std::pair<Index, bool> Insert(const BlendingFunction& f, Index id)
  {
    const auto result = this->Ids.emplace(f, id);
    return { result.first->second, result.second };
  }

  /// The id stored for f, or -1.
  Index Find(const BlendingFunction& f) const
  {
    const auto found = this->Ids.find(f);
    return found == this->Ids.end() ? -1 : found->second;
  }

  void Erase(const BlendingFunction& f) { this->Ids.erase(f); }

  void Reserve(std::size_t n) { this->Ids.reserve(n); }

private:
  struct Hash
  {
    std::size_t operator()(const BlendingFunction& f) const
    {
      return HashKnots(f[0]) * 31 + HashKnots(f[1]) * 17 + HashKnots(f[2]);
    }
  };
  std::unordered_map<BlendingFunction, Index, Hash> Ids;
};
}

#endif
