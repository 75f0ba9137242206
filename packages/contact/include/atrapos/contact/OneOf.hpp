#pragma once

#include <Kokkos_Macros.hpp>
#include <cstddef>
#include <string>
#include <tuple>
#include <type_traits>
#include <utility>

#include "atrapos/contact/ExponentialPressure.hpp"
#include "atrapos/contact/PowerBarrier.hpp"
#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/contact/SmoothedPenalty.hpp"
#include "atrapos/contact/Tools.hpp"

namespace atrapos::contact {

namespace detail {
/// A value that all of a list share.
template <class T>
constexpr T shared(T first) {
  return first;
}
template <class T, class... Rest>
constexpr T shared(T first, T second, Rest... rest) {
  return first == second ? shared(second, rest...) : throw "the alternatives differ";
}
template <class Law, class = void>
struct Unknowns : std::integral_constant<int, 1> {};
template <class Law>
struct Unknowns<Law, std::void_t<decltype(Law::numUnknowns)>>
    : std::integral_constant<int, Law::numUnknowns> {};
template <class Law, class = void>
struct Symmetric : std::true_type {};
template <class Law>
struct Symmetric<Law, std::void_t<decltype(Law::symmetric)>> : std::integral_constant<bool, Law::symmetric> {
};
}  // namespace detail

/// One of several tools, or one of several pressure laws, chosen at run time: a program that offers all of
/// them compiles its element loops once. The choice is a member, the same at all points, so the order of
/// operations is that of the chosen one. All alternatives have the same number of unknowns.
template <class... Laws>
struct OneOf {
  static constexpr int numUnknowns = detail::shared(detail::Unknowns<Laws>::value...);
  static constexpr bool symmetric = (detail::Symmetric<Laws>::value && ...);

  OneOf() = default;
  template <class Law, class = std::enable_if_t<(std::is_same_v<Law, Laws> || ...)>>
  OneOf(const Law& law) {
    std::get<Law>(laws_) = law;
    chosen_ = position<Law>(std::index_sequence_for<Laws...>());
  }

  /// The equation of a tool.
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    with([&](const auto& law) { evaluate(law, x, y, g); });
  }
  /// The equation of a pressure.
  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, const taylor::Passive<T>* data, T* g) const {
    with([&](const auto& law) { evaluate(law, x, y, data, g); });
  }
  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    with([&](const auto& law) { law.start(x, y); });
  }
  KOKKOS_INLINE_FUNCTION void start(const double* x, const double* data, double* y) const {
    with([&](const auto& law) { law.start(x, data, y); });
  }

  void validate() const {
    with([](const auto& law) { law.validate(); });
  }
  std::string ambiguity(const double* x) const {
    std::string text;
    with([&](const auto& law) { text = law.ambiguity(x); });
    return text;
  }

  /// f(the chosen law).
  template <class F, std::size_t I = 0>
  KOKKOS_INLINE_FUNCTION void with(const F& f) const {
    if constexpr (I + 1 == sizeof...(Laws)) {
      f(std::get<I>(laws_));
    } else if (chosen_ == static_cast<int>(I)) {
      f(std::get<I>(laws_));
    } else {
      with<F, I + 1>(f);
    }
  }

 private:
  // Compiled once for each scalar, not once for every law and pass in which the alternatives stand: inlined,
  // all of them together take compilers minutes.
  template <class Law, class... Arguments>
  ATRAPOS_NOINLINE KOKKOS_FUNCTION static void evaluate(const Law& law, Arguments... arguments) {
    law(arguments...);
  }

  template <class Law, std::size_t... I>
  static constexpr int position(std::index_sequence<I...>) {
    int at = 0;
    ((std::is_same_v<Law, Laws> ? void(at = static_cast<int>(I)) : void()), ...);
    return at;
  }

  int chosen_ = 0;
  std::tuple<Laws...> laws_;
};

/// Any tool without surface parameters whose normal is the gradient of the gap.
using AnyTool = OneOf<Plane, Cylinder, Sphere, Cone, Torus, TaperedRoll, CrownedRoll, TabulatedRoll>;
/// Any pressure law.
using AnyPressure = OneOf<RegularisedPressure, PowerBarrier, ExponentialPressure, SmoothedPenalty>;

}  // namespace atrapos::contact
