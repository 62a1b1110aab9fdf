// SPDX-FileCopyrightText: Copyright (c) The Trivariate authors
// SPDX-License-Identifier: BSD-3-Clause
/**
 * Banded matrices that act along one direction of a three-dimensional array.
 *
 * Everything that the gridded fit does to a volume (sampling B-splines, their moments, Gram
 * matrices, subdivision and its adjoint) is a tensor product of three of these.
 */
#ifndef trivariate_BandedOperator_h
#define trivariate_BandedOperator_h

#include "Execution.h"

#include <array>
#include <memory>
#include <utility>
#include <vector>

namespace trivariate
{
/// A matrix whose row r has `Width` numbers from column First[r] on (zeros where it is narrower).
struct BandedOperator
{
  Index Rows = 0;
  Index Columns = 0;
  int Width = 0;
  std::vector<std::int32_t> First;
  std::vector<double> Coefficients; ///< Rows x Width

  /// Builds from rows of (first column, coefficients).
  static BandedOperator FromRows(
    Index columns, const std::vector<std::pair<std::int32_t, std::vector<double>>>& rows);

  BandedOperator Transposed() const;
};

/// std::allocator that leaves numbers uninitialised, for arrays that are written before being read.
template <typename T>
struct UninitializedAllocator : std::allocator<T>
{
  template <typename U>
  struct rebind
  {
    using other = UninitializedAllocator<U>;
  };
  template <typename U>
  void construct(U* p) noexcept
  {
    ::new (static_cast<void*>(p)) U;
  }
  template <typename U, typename... Args>
  void construct(U* p, Args&&... args)
  {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
};
using Buffer = std::vector<double, UninitializedAllocator<double>>;

/**
 * Memory of arrays that are no longer needed, kept for the next ones. A fit makes hundreds of large
 * short-lived arrays; fetching and clearing fresh pages for each takes as long as filling it. For
 * one thread.
 */
class ArrayPool
{
public:
  Buffer Take(Index n);
  void Give(Buffer&& buffer);

private:
  std::vector<Buffer> Free;
};

/// A dense array of Size[0] x Size[1] x Size[2] numbers, the first index fastest; made
/// uninitialised.
struct Array3
{
  std::array<Index, 3> Size{ 0, 0, 0 };
  Buffer Values;
  std::shared_ptr<ArrayPool> Pool;

  Array3() = default;
  Array3(const std::array<Index, 3>& size, const std::shared_ptr<ArrayPool>& pool)
    : Size(size)
    , Values(pool->Take(size[0] * size[1] * size[2]))
    , Pool(pool)
  {
  }
  Array3(Array3&& other) noexcept = default;
  Array3& operator=(Array3&& other) noexcept
  {
    std::swap(this->Size, other.Size);
    std::swap(this->Values, other.Values);
    std::swap(this->Pool, other.Pool);
    return *this;
  }
  Array3(const Array3&) = delete;
  Array3& operator=(const Array3&) = delete;
  ~Array3()
  {
    if (this->Pool)
    {
      this->Pool->Give(std::move(this->Values));
    }
  }
  bool Empty() const { return this->Values.empty(); }
  Array3 Clone() const;
};

/// out = op applied along direction a of in. `in` must have op.Columns entries in that direction.
Array3 Apply(const BandedOperator& op, int a, const Array3& in, const Execution& execution);
}

#endif
