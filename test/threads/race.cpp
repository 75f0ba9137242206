// A loop with a race: each of its entries is added to by several threads at once. scripts/sanitize --threads
// runs it first: a sanitizer that finds nothing here has not looked at the loops of the tests either.
#include <Kokkos_Core.hpp>

#include <cstdio>

int main() {
  const Kokkos::ScopeGuard kokkos;
  if (Kokkos::DefaultExecutionSpace::concurrency() < 2) {
    std::puts("race: needs two threads");
    return 2;
  }
  double sums[4] = {0, 0, 0, 0};
  double* const s = sums;
  Kokkos::parallel_for(
      "race", Kokkos::RangePolicy<>(0, 100000), KOKKOS_LAMBDA(int i) { s[i % 4] += i; });
  std::printf("%g\n", sums[0]);
  return 0;
}
