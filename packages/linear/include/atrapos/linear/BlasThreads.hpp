#pragma once

#include <string>

namespace atrapos::linear {

/// Sets how many threads the BLAS under the direct solvers uses, process-wide; n >= 1. A MUMPS with OpenMP of
/// its own takes as many (ICNTL(16)) where it is made after that.
///
/// A threaded BLAS that takes all cores makes MUMPS 5 to 10 times slower on a loaded machine or with several
/// ranks on one node, because its dense blocks are small. Applications call this once at start, before the
/// first factorization, typically with 1.
///
/// The control is looked up at run time among the libraries the process has loaded (OpenBLAS, MKL, BLIS), so
/// exchanging the BLAS needs no rebuild. Returns false where none of them is there, as with the reference
/// BLAS, which has one thread anyway. n < 1 throws SolverError.
bool setBlasThreads(int n);

/// Number of threads the BLAS uses at most; 0 where it offers no control.
int blasThreads();

/// Sets the BLAS' threads while it lives; where they cannot be controlled it does nothing.
class BlasThreadsHere {
 public:
  explicit BlasThreadsHere(int n) : before_(blasThreads()) {
    if (before_ > 0) setBlasThreads(n);
  }
  ~BlasThreadsHere() {
    if (before_ > 0) setBlasThreads(before_);
  }
  BlasThreadsHere(const BlasThreadsHere&) = delete;
  BlasThreadsHere& operator=(const BlasThreadsHere&) = delete;

 private:
  int before_;
};

/// The BLAS whose threads are controlled: OpenBLAS, MKL or BLIS; empty where there is none of them.
std::string blasName();

}  // namespace atrapos::linear
