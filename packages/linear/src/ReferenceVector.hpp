#pragma once

#include <Tpetra_Vector.hpp>
#include <cstdint>

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// Fills v with pseudo-random values in [-1, 1) that depend on global index and seed only, so that checks
/// give the same answer in every run and on any number of ranks.
inline void fillReference(Vector& v, std::uint64_t seed) {
  const auto map = v.getMap();
  const auto view = v.getLocalViewHost(Tpetra::Access::OverwriteAll);
  for (std::size_t i = 0; i < view.extent(0); ++i) {
    // splitmix64
    std::uint64_t z = static_cast<std::uint64_t>(map->getGlobalElement(static_cast<LocalIndex>(i))) +
                      (seed << 40) + 0x9e3779b97f4a7c15ull;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ull;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebull;
    z ^= z >> 31;
    view(i, 0) = static_cast<double>(z >> 11) * 0x1p-52 - 1.0;
  }
}

}  // namespace atrapos::linear
