#pragma once

#include <type_traits>
#include <utility>

#include "atrapos/fem/KernelChoice.hpp"
#include "atrapos/fem/PointKernels.hpp"
#include "atrapos/fem/PointLaw.hpp"

/// A law written as a template (taylor/Law.hpp) as a PointLaw. It may show named values through
///     static constexpr int numObserved;  static std::vector<std::string> observedNames();
///     void observe(const double* in, const double* data, double* observed) const;
/// keeps internal variables as its last data and last outputs where it says `static constexpr int
/// numVariables` (their rates by taylor::solveRate), changes at events with `static constexpr int numEvents =
/// 1` (LawShape::events) and, where it has one, bool freeGrow() const (LawShape::freeGrow), has sizes
/// (PointLaw::sizes) by
///     void sizes(const double* in, const double* data, double* out) const;
/// says `static constexpr bool symmetric` when d out/d in is symmetric, and, where it
/// may have nothing to act on at a point, bool exists(const double* data) const.
///
/// A source with one line for each law, ATRAPOS_POINT_LAW(Law), compiles it (outside of namespaces).
namespace atrapos::fem {

namespace detail {
template <class Law, class = void>
struct NumObserved : std::integral_constant<int, 0> {};
template <class Law>
struct NumObserved<Law, std::void_t<decltype(Law::numObserved)>>
    : std::integral_constant<int, Law::numObserved> {};

template <class Law, class = void>
struct NumEvents : std::integral_constant<int, 0> {};
template <class Law>
struct NumEvents<Law, std::void_t<decltype(Law::numEvents)>> : std::integral_constant<int, Law::numEvents> {};

template <class Law, class = void>
struct HasFreeGrow : std::false_type {};
template <class Law>
struct HasFreeGrow<Law, std::void_t<decltype(std::declval<const Law&>().freeGrow())>> : std::true_type {};

template <class Law, class = void>
struct HasNames : std::false_type {};
template <class Law>
struct HasNames<Law, std::void_t<decltype(Law::observedNames())>> : std::true_type {};

template <class Law, class = void>
struct HasSizes : std::false_type {};
template <class Law>
struct HasSizes<Law, std::void_t<decltype(std::declval<const Law&>().sizes(
                         (const double*)nullptr, (const double*)nullptr, (double*)nullptr))>>
    : std::true_type {};

template <class Law, class = void>
struct HasExists : std::false_type {};
template <class Law>
struct HasExists<Law, std::void_t<decltype(std::declval<const Law&>().exists((const double*)nullptr))>>
    : std::true_type {};

}  // namespace detail

template <class Law>
class PointLawOf final : public PointLaw {
 public:
  explicit PointLawOf(const Law& law)
      : law_(law), histories_(taylor::historyShape(law)), kernels_(detail::chosenKernels([](auto lanes) {
          return detail::PointKernelsOf<Law, decltype(lanes)::value>::table();
        })) {}

  LawShape shape() const override {
    bool freeGrow = false;
    if constexpr (detail::HasFreeGrow<Law>::value) freeGrow = law_.freeGrow();
    return {Law::numInputs,
            Law::numOutputs,
            Law::numData,
            law_.symmetric,
            detail::NumObserved<Law>::value,
            detail::NumVariables<Law>::value,
            detail::NumEvents<Law>::value,
            detail::HasSizes<Law>::value,
            freeGrow};
  }
  std::size_t seriesDoubles(const SeriesOrder& order) const override {
    const bool scratch = order.maxOrder == 0 && detail::NumVariables<Law>::value > 0;
    return scratch ? histories_.doubles<kLanes>(taylor::chordOrder, 0)
                   : histories_.doubles<kLanes>(order.maxOrder, order.waiting);
  }

  void value(const PointBatch& points, const double* in, double* out) const override {
    kernels_.tangent(&law_, histories_, points, 0, 0, in, out, nullptr);
  }
  void tangent(const PointBatch& points, const double* in, double* out, double* jacobian) const override {
    kernels_.tangent(&law_, histories_, points, 0, Law::numInputs, in, out, jacobian);
  }
  void derivative(const PointBatch& points, int input, const double* in, double* out,
                  double* derivative) const override {
    kernels_.tangent(&law_, histories_, points, input, 1, in, out, derivative);
  }
  void start(const PointBatch& points, const SeriesOrder& order, const double* in, double* out,
             PointFailure& failure) const override {
    kernels_.start(&law_, histories_, points, order, in, out, failure);
  }
  void advance(const PointBatch& points, const SeriesOrder& order, In in, Out out) const override {
    kernels_.advance(&law_, histories_, points, order, in, out);
  }
  void carry(const PointBatch& points, const double* from, const double* to, double* variables,
             PointFailure& failure) const override {
    if (kernels_.carry == nullptr) return PointLaw::carry(points, from, to, variables, failure);
    kernels_.carry(&law_, histories_, points, from, to, variables, failure);
  }

  void sizes(const PointBatch& points, const double* in, double* out) const override {
    constexpr int O = Law::numOutputs;
    if constexpr (detail::HasSizes<Law>::value)
      forEachPoint(points, in, [&](int q, int lane, const double* x, const double* data) {
        double size[O];
        law_.sizes(x, data, size);
        for (int m = 0; m < O; ++m) out[(q * O + m) * kLanes + lane] = size[m];
      });
    else
      PointLaw::sizes(points, in, out);
  }

  std::vector<std::string> observedNames() const override {
    if constexpr (detail::HasNames<Law>::value)
      return Law::observedNames();
    else
      return {};
  }
  void observe([[maybe_unused]] const PointBatch& points, [[maybe_unused]] const double* in,
               [[maybe_unused]] double* values) const override {
    constexpr int V = detail::NumObserved<Law>::value;
    if constexpr (V > 0)
      forEachPoint(points, in, [&](int q, int lane, const double* x, const double* data) {
        double shown[V];
        law_.observe(x, data, shown);
        for (int v = 0; v < V; ++v) values[(q * V + v) * kLanes + lane] = shown[v];
      });
  }
  bool exists([[maybe_unused]] const double* data) const override {
    if constexpr (detail::HasExists<Law>::value)
      return law_.exists(data);
    else
      return true;
  }

 private:
  /// f(point, lane, inputs, data) one point after the other.
  template <class F>
  static void forEachPoint(const PointBatch& points, const double* in, const F& f) {
    constexpr int I = Law::numInputs, D = Law::numData;
    for (int q = 0; q < points.numPoints; ++q)
      for (int lane = 0; lane < points.lanes; ++lane) {
        double x[I], data[D + 1] = {};
        for (int m = 0; m < I; ++m) x[m] = in[(q * I + m) * kLanes + lane];
        for (int d = 0; d < D; ++d) data[d] = points.data[(q * D + d) * kLanes + lane];
        f(q, lane, x, data);
      }
  }

  Law law_;
  taylor::HistoryShape histories_;
  detail::PointKernels kernels_;
};

template <class Law>
std::unique_ptr<PointLaw> pointLaw(const Law& law) {
  return std::make_unique<PointLawOf<Law>>(law);
}

}  // namespace atrapos::fem

// A source with kernels is compiled once without a level, for all but the kernels, and once for each level
// with ATRAPOS_KERNEL_LEVEL, for the kernels alone (cmake/AtraposKernels.cmake); or once for both, for one
// instruction set.
#if defined(ATRAPOS_KERNEL_LEVEL)
#define ATRAPOS_POINT_LAW(...)                \
  template atrapos::fem::detail::PointKernels \
  atrapos::fem::detail::PointKernelsOf<__VA_ARGS__, atrapos::taylor::nativeLanes>::table();
#else
#define ATRAPOS_POINT_LAW(...) \
  template std::unique_ptr<atrapos::fem::PointLaw> atrapos::fem::pointLaw(const __VA_ARGS__&);
#endif
