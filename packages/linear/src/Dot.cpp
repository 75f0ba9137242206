#include "atrapos/linear/Dot.hpp"

#include <Kokkos_Core.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::linear {

double dot(const Vector& x, const Vector& y) {
  constexpr int chunk = 4096;  // long enough to be worth a thread's while, short enough to share out
  const auto xs = x.getLocalViewDevice(Tpetra::Access::ReadOnly);
  const auto ys = y.getLocalViewDevice(Tpetra::Access::ReadOnly);
  const int n = static_cast<int>(xs.extent(0));
  const int chunks = (n + chunk - 1) / chunk;
  Kokkos::View<double*, Vector::node_type::device_type> sums("sums", chunks);
  Kokkos::parallel_for(
      "dot", Kokkos::RangePolicy<Vector::execution_space>(0, chunks), KOKKOS_LAMBDA(int c) {
        const int end = (c + 1) * chunk < n ? (c + 1) * chunk : n;
        double sum = 0;
        for (int i = c * chunk; i < end; ++i) sum += xs(i, 0) * ys(i, 0);
        sums(c) = sum;
      });
  const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), sums);
  double local = 0, global = 0;
  for (int c = 0; c < chunks; ++c) local += host(c);
  Teuchos::reduceAll(*x.getMap()->getComm(), Teuchos::REDUCE_SUM, local, Teuchos::outArg(global));
  return global;
}

}  // namespace atrapos::linear
