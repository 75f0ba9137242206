#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// A view with these numbers, first touched by the threads of the loops.
template <class T>
View<T*> upload(const std::string& name, const std::vector<T>& host) {
  View<T*> view(name, host.size());
  auto mirror = Kokkos::create_mirror_view(view);
  std::copy(host.begin(), host.end(), mirror.data());
  Kokkos::deep_copy(view, mirror);
  return view;
}

}  // namespace atrapos::fem
