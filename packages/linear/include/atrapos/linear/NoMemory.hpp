#pragma once

#include <exception>
#include <new>
#include <string_view>

namespace atrapos::linear {

/// Whether an error says that memory is lacking: std::bad_alloc, or what Kokkos throws where it has none for
/// a view, a std::runtime_error of several lines.
inline bool isNoMemory(const std::exception& error) {
  constexpr std::string_view ofKokkos = "Kokkos failed to allocate memory";
  return dynamic_cast<const std::bad_alloc*>(&error) != nullptr ||
         std::string_view(error.what()).substr(0, ofKokkos.size()) == ofKokkos;
}

}  // namespace atrapos::linear
