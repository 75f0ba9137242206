#pragma once

#include <utility>

#include "atrapos/taylor/Context.hpp"
#include "atrapos/taylor/Convolution.hpp"

/// Expression templates of sums and products: a statement is evaluated in one go. Linear parts are never
/// stored, and all products of the statement share one loop over the orders, each with its own sums in
/// registers; only operands of products get a history, once each.
///
/// As with Sacado's types: an expression refers to its variables, so store it in a T, never in an auto.
namespace atrapos::taylor {

template <class X>
class Sweep;

/// Base of everything that can stand in a statement: a Sweep<X>, or a sum or product of such.
template <class E, class X>
struct Expression {
  ATRAPOS_FORCEINLINE const E& self() const { return static_cast<const E&>(*this); }
};

namespace detail {

template <class X>
ATRAPOS_FORCEINLINE const Sweep<X>& variable(const Sweep<X>& a);
template <class E, class X>
ATRAPOS_FORCEINLINE Sweep<X> variable(const Expression<E, X>& e);

// Variables are referred to (their history must be theirs), everything else is small and copied.
template <class E>
struct Operand {
  using Type = const E;
};
template <class X>
struct Operand<Sweep<X>> {
  using Type = const Sweep<X>&;
};

/// What every node's `prepare()` returns. known: this pass's coefficient but for the sums over
/// i = 1..k-1. The products of the node are numbered from 0; forward and backward are their sums.
template <class X>
struct PreparedValue {
  static constexpr int products = 0;
  LanesOf<X> known;
};

template <class E>
struct ProductsOf {
  static constexpr int value = decltype(std::declval<const E&>().prepare())::products;
};

// Beyond this many products, two sums each, registers spill: the parts of the statement get a loop each.
constexpr int maxProductsPerLoop = 6;

template <class X, class P>
ATRAPOS_FORCEINLINE LanesOf<X> sumOverOrders(const Context<X::lanes>& context, const P& p) {
  static_assert(P::products > 0);
  if (context.order < 2) return LanesOf<X>(0.0);
  if (!p.active()) return p.oneByOne(context);
  const int k = context.order;
  LanesOf<X> forward[P::products], backward[P::products];
  for (int n = 0; n < P::products; ++n) forward[n] = backward[n] = LanesOf<X>(0.0);
  const int half = (k - 1) / 2;
  if (p.squares()) {
    for (int i = 1; i <= half; ++i) p.addSquares(i * context.stride, (k - i) * context.stride, forward);
    for (int n = 0; n < P::products; ++n) forward[n] *= 2.0;
  } else {
    for (int i = 1; i <= half; ++i)
      p.addPairs(i * context.stride, (k - i) * context.stride, forward, backward);
  }
  if (k % 2 == 0) p.addSquares(k / 2 * context.stride, k / 2 * context.stride, backward);
  for (int n = 0; n < P::products; ++n) forward[n] += backward[n];
  return p.combine(forward);
}

/// The coefficient of an expression in this pass. Without context it is a constant, whose value it is.
template <class E, class X>
ATRAPOS_FORCEINLINE LanesOf<X> evaluate(const Expression<E, X>& e, const Context<X::lanes>* context) {
  if (context == nullptr) return e.self().constant();
  const auto p = e.self().prepare();
  if constexpr (X::pass == Pass::Sweep && decltype(p)::products > 0)
    return p.known + sumOverOrders<X>(*context, p);
  else
    return p.known;
}

// ------------------------------------------------------------------------------------------ the nodes

/// A passive number: counts in Start only.
template <class X>
struct Constant : Expression<Constant<X>, X> {
  LanesOf<X> value;
  ATRAPOS_FORCEINLINE explicit Constant(const LanesOf<X>& v) : value(v) {}
  ATRAPOS_FORCEINLINE Context<X::lanes>* context() const { return nullptr; }
  ATRAPOS_FORCEINLINE PreparedValue<X> prepare() const {
    return {X::pass == Pass::Start ? value : LanesOf<X>(0.0)};
  }
  ATRAPOS_FORCEINLINE const LanesOf<X>& constant() const { return value; }
};

template <class P, class F, class X>
struct PreparedScaled {
  static constexpr int products = P::products;
  P x;
  F factor;
  LanesOf<X> known;
  ATRAPOS_FORCEINLINE bool active() const { return x.active(); }
  ATRAPOS_FORCEINLINE bool squares() const { return x.squares(); }
  ATRAPOS_FORCEINLINE void addPairs(std::ptrdiff_t i, std::ptrdiff_t j, LanesOf<X>* f, LanesOf<X>* b) const {
    x.addPairs(i, j, f, b);
  }
  ATRAPOS_FORCEINLINE void addSquares(std::ptrdiff_t i, std::ptrdiff_t j, LanesOf<X>* f) const {
    x.addSquares(i, j, f);
  }
  ATRAPOS_FORCEINLINE LanesOf<X> combine(const LanesOf<X>* f) const { return x.combine(f) * factor; }
  ATRAPOS_FORCEINLINE LanesOf<X> oneByOne(const Context<X::lanes>& c) const { return x.oneByOne(c) * factor; }
};

/// x times a passive factor (double or Lanes).
template <class E, class F, class X>
struct Scaled : Expression<Scaled<E, F, X>, X> {
  typename Operand<E>::Type x;
  F factor;
  ATRAPOS_FORCEINLINE Scaled(const E& e, const F& f) : x(e), factor(f) {}
  ATRAPOS_FORCEINLINE LanesOf<X> constant() const { return x.constant() * factor; }
  ATRAPOS_FORCEINLINE Context<X::lanes>* context() const { return x.context(); }
  ATRAPOS_FORCEINLINE auto prepare() const {
    auto p = x.prepare();
    const LanesOf<X> known = p.known * factor;
    if constexpr (decltype(p)::products > 0)
      return PreparedScaled<decltype(p), F, X>{p, factor, known};
    else
      return PreparedValue<X>{known};
  }
};

template <class A, class B, int Sign, class X>
struct PreparedSum {
  static constexpr int products = A::products + B::products;
  A a;
  B b;
  LanesOf<X> known;
  ATRAPOS_FORCEINLINE bool active() const {
    if constexpr (A::products == 0)
      return b.active();
    else if constexpr (B::products == 0)
      return a.active();
    else
      return a.active() && b.active();
  }
  ATRAPOS_FORCEINLINE bool squares() const {
    if constexpr (A::products == 0)
      return b.squares();
    else if constexpr (B::products == 0)
      return a.squares();
    else
      return a.squares() && b.squares();
  }
  ATRAPOS_FORCEINLINE void addPairs(std::ptrdiff_t i, std::ptrdiff_t j, LanesOf<X>* f,
                                    LanesOf<X>* back) const {
    if constexpr (A::products > 0) a.addPairs(i, j, f, back);
    if constexpr (B::products > 0) b.addPairs(i, j, f + A::products, back + A::products);
  }
  ATRAPOS_FORCEINLINE void addSquares(std::ptrdiff_t i, std::ptrdiff_t j, LanesOf<X>* f) const {
    if constexpr (A::products > 0) a.addSquares(i, j, f);
    if constexpr (B::products > 0) b.addSquares(i, j, f + A::products);
  }
  static ATRAPOS_FORCEINLINE LanesOf<X> add(const LanesOf<X>& x, const LanesOf<X>& y) {
    if constexpr (Sign > 0)
      return x + y;
    else
      return x - y;
  }
  ATRAPOS_FORCEINLINE LanesOf<X> combine(const LanesOf<X>* f) const {
    if constexpr (A::products == 0)
      return Sign > 0 ? b.combine(f) : -b.combine(f);
    else if constexpr (B::products == 0)
      return a.combine(f);
    else
      return add(a.combine(f), b.combine(f + A::products));
  }
  ATRAPOS_FORCEINLINE LanesOf<X> oneByOne(const Context<X::lanes>& c) const {
    if constexpr (A::products == 0)
      return Sign > 0 ? b.oneByOne(c) : -b.oneByOne(c);
    else if constexpr (B::products == 0)
      return a.oneByOne(c);
    else
      return add(a.oneByOne(c), b.oneByOne(c));
  }
};

/// a + b or a - b.
template <class A, class B, int Sign, class X>
struct Sum : Expression<Sum<A, B, Sign, X>, X> {
  typename Operand<A>::Type a;
  typename Operand<B>::Type b;
  ATRAPOS_FORCEINLINE Sum(const A& x, const B& y) : a(x), b(y) {}
  ATRAPOS_FORCEINLINE LanesOf<X> constant() const {
    return Sign > 0 ? a.constant() + b.constant() : a.constant() - b.constant();
  }
  ATRAPOS_FORCEINLINE Context<X::lanes>* context() const {
    Context<X::lanes>* c = a.context();
    return c != nullptr ? c : b.context();
  }
  ATRAPOS_FORCEINLINE auto prepare() const {
    constexpr int products = ProductsOf<A>::value + ProductsOf<B>::value;
    if constexpr (products == 0 || products > maxProductsPerLoop) {
      const LanesOf<X> x = evaluate(a, context()), y = evaluate(b, context());
      return PreparedValue<X>{Sign > 0 ? x + y : x - y};
    } else {
      auto p = a.prepare();
      auto q = b.prepare();
      const LanesOf<X> known = Sign > 0 ? p.known + q.known : p.known - q.known;
      return PreparedSum<decltype(p), decltype(q), Sign, X>{p, q, known};
    }
  }
};

template <class X>
struct PreparedProduct {
  static constexpr int products = 1;
  const double* a;  ///< order-0 lanes of the operands' histories; null where one operand is passive
  const double* b;
  LanesOf<X> known;
  ATRAPOS_FORCEINLINE bool active() const { return a != nullptr; }
  ATRAPOS_FORCEINLINE bool squares() const { return a == b; }
  ATRAPOS_FORCEINLINE void addPairs(std::ptrdiff_t i, std::ptrdiff_t j, LanesOf<X>* f,
                                    LanesOf<X>* back) const {
    *f += LanesOf<X>::load(a + i) * LanesOf<X>::load(b + j);
    *back += LanesOf<X>::load(a + j) * LanesOf<X>::load(b + i);
  }
  ATRAPOS_FORCEINLINE void addSquares(std::ptrdiff_t i, std::ptrdiff_t j, LanesOf<X>* f) const {
    *f += LanesOf<X>::load(a + i) * LanesOf<X>::load(b + j);
  }
  ATRAPOS_FORCEINLINE LanesOf<X> combine(const LanesOf<X>* f) const { return *f; }
  ATRAPOS_FORCEINLINE LanesOf<X> oneByOne(const Context<X::lanes>& c) const {
    return active() ? convolve<X::lanes>(a, b, c.stride, c.order) : LanesOf<X>(0.0);
  }
};

/// c = a b: c_k = a_0 b_k + a_k b_0 + sum_{i=1..k-1} a_i b_{k-i}
template <class A, class B, class X>
struct Product : Expression<Product<A, B, X>, X> {
  typename Operand<A>::Type a;
  typename Operand<B>::Type b;
  ATRAPOS_FORCEINLINE Product(const A& x, const B& y) : a(x), b(y) {}
  ATRAPOS_FORCEINLINE LanesOf<X> constant() const { return a.constant() * b.constant(); }
  ATRAPOS_FORCEINLINE Context<X::lanes>* context() const {
    Context<X::lanes>* c = a.context();
    return c != nullptr ? c : b.context();
  }
  ATRAPOS_FORCEINLINE PreparedProduct<X> prepare() const {
    const auto& x = variable(a);
    const auto& y = variable(b);
    if (x.isPassive() || y.isPassive()) {
      const bool constant = x.isPassive() && y.isPassive();
      return {nullptr, nullptr, constant && X::pass != Pass::Start ? LanesOf<X>(0.0) : x.value() * y.value()};
    }
    const double* p = x.slot();
    const double* q = y.slot();
    if constexpr (X::pass == Pass::Start) return {p, q, x.value() * y.value()};
    LanesOf<X> known(0.0);
    if (!y.isZero()) known += LanesOf<X>::load(p) * y.value();
    if (!x.isZero()) known += x.value() * LanesOf<X>::load(q);
    return {p, q, known};
  }
};

}  // namespace detail
}  // namespace atrapos::taylor
