#pragma once

#include <Kokkos_Core.hpp>
#include <cstddef>

#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// Memory of a fixed size for every thread of a loop: histories of order 0 that are needed only as long as a
/// point's values or tangent are worked out. Copied by value into the kernels.
class PointMemory {
  using Tokens = Kokkos::Experimental::UniqueToken<Execution>;

 public:
  /// The calling thread's, until this goes.
  class Held {
   public:
    KOKKOS_INLINE_FUNCTION explicit Held(const PointMemory& memory)
        : tokens_(memory.tokens_), token_(tokens_.acquire()), data_(&memory.data_(token_ * memory.size_)) {}
    KOKKOS_INLINE_FUNCTION ~Held() { tokens_.release(token_); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    KOKKOS_INLINE_FUNCTION double* data() const { return data_; }

   private:
    const Tokens& tokens_;
    int token_;
    double* data_;
  };

  explicit PointMemory(std::size_t doubles)
      : size_(doubles),
        data_(Kokkos::view_alloc("pointMemory", Kokkos::WithoutInitializing), doubles * tokens_.size() + 1) {}

 private:
  Tokens tokens_;
  std::size_t size_;
  View<double*> data_;
};

}  // namespace atrapos::fem
