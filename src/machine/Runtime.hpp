#pragma once

namespace atrapos {

/// MPI, Kokkos and Tpetra for as long as it lives, and the one place where numbers of threads are set: the
/// element loops take `threads` (0: a rank's share of the processors, or what the environment says;
/// Threads.hpp), BLAS and MUMPS one.
class Runtime {
 public:
  explicit Runtime(int threads);
  ~Runtime();
  Runtime(const Runtime&) = delete;
  Runtime& operator=(const Runtime&) = delete;
};

}  // namespace atrapos
