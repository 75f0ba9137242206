#include "atrapos/linear/BlasThreads.hpp"

#include <dlfcn.h>
#include <fmt/format.h>

#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {
namespace {

// Looked up when called: the BLAS behind libblas.so.3 is chosen by the loader, so a link-time reference, even
// a weak one, may stay null although the library is there.
template <class Function>
Function* loaded(const char* symbol) {
  return reinterpret_cast<Function*>(dlsym(RTLD_DEFAULT, symbol));
}

}  // namespace

bool setBlasThreads(int n) {
  if (n < 1) throw SolverError(fmt::format("setBlasThreads: {} threads; at least 1 is needed", n));
  bool found = false;
  for (const char* symbol : {"openblas_set_num_threads", "MKL_Set_Num_Threads"})
    if (auto* set = loaded<void(int)>(symbol)) {
      set(n);
      found = true;
    }
  // BLIS' dim_t is 64-bit in its usual builds; a small positive int is passed the same way in either case.
  if (auto* set = loaded<void(long)>("bli_thread_set_num_threads")) {
    set(n);
    found = true;
  }
  return found;
}

int blasThreads() {
  for (const char* symbol : {"openblas_get_num_threads", "MKL_Get_Max_Threads"})
    if (auto* get = loaded<int()>(symbol)) return get();
  if (auto* get = loaded<long()>("bli_thread_get_num_threads")) return static_cast<int>(get());
  return 0;
}

std::string blasName() {
  if (loaded<void(int)>("openblas_set_num_threads")) return "OpenBLAS";
  if (loaded<void(int)>("MKL_Set_Num_Threads")) return "MKL";
  if (loaded<void(long)>("bli_thread_set_num_threads")) return "BLIS";
  return "";
}

}  // namespace atrapos::linear
