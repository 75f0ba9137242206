#pragma once

#include <Kokkos_Core.hpp>
#include <cstddef>

#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// Memory of a fixed size for every thread of a loop, aligned to cache lines: what is worked on in a batch.
class ThreadMemory {
  using Tokens = Kokkos::Experimental::UniqueToken<Execution>;

 public:
  /// The calling thread's, until this goes.
  class Held {
   public:
    explicit Held(const ThreadMemory& memory)
        : tokens_(memory.tokens_),
          token_(tokens_.acquire()),
          data_(memory.data_.data() + token_ * memory.size_) {}
    ~Held() { tokens_.release(token_); }
    Held(const Held&) = delete;
    Held& operator=(const Held&) = delete;
    double* data() const { return data_; }

   private:
    const Tokens& tokens_;
    int token_;
    double* data_;
  };

  explicit ThreadMemory(std::size_t doubles = 0)
      : size_((doubles + 7) / 8 * 8), data_("threadMemory", size_ * tokens_.size()) {}

 private:
  Tokens tokens_;
  std::size_t size_;
  View<double*> data_;
};

}  // namespace atrapos::fem
