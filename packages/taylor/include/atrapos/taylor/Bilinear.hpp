#pragma once

#include <array>
#include <utility>

#include "atrapos/taylor/Sweep.hpp"

/// Several sums of products at once: out_o = sum of +-a_m b_n over a list of terms known at compile time. One
/// loop over the orders reads every coefficient once and feeds all sums; scalar statements would read it once
/// a product.
namespace atrapos::taylor::detail {

/// out[out] += sign a[left] b[right]
struct BilinearTerm {
  int out, left, right, sign;
};

/// out = sum of terms at order 0, for any type with + - *. Terms of one output stand in the order of the
/// list.
template <class Terms, class T, std::size_t... t>
ATRAPOS_FORCEINLINE void addTerms(const T* a, const T* b, T* out, std::index_sequence<t...>) {
  ((Terms::list[t].sign > 0
        ? void(out[Terms::list[t].out] += a[Terms::list[t].left] * b[Terms::list[t].right])
        : void(out[Terms::list[t].out] -= a[Terms::list[t].left] * b[Terms::list[t].right])),
   ...);
}

template <class Terms>
using TermIndices = std::make_index_sequence<Terms::list.size()>;

template <int N>
using Entries = std::make_index_sequence<N>;

// A value loaded once and held in a register where that pays.
template <int L>
ATRAPOS_FORCEINLINE Lanes<L> held(Lanes<L> a) {
  Lanes<L>::Register::hold(a.v);
  return a;
}

template <int L>
ATRAPOS_FORCEINLINE Lanes<L> loadHeld(const double* p, int entry) {
  return held(Lanes<L>::load(p + entry * L));
}

// Loops over the entries of local arrays are written as folds: only then do the arrays become registers.
template <int L, std::size_t... n>
ATRAPOS_FORCEINLINE void loadBlock(const double* p, Lanes<L>* a, std::index_sequence<n...>) {
  ((a[n] = loadHeld<L>(p, n)), ...);
}

template <int L, std::size_t... n>
ATRAPOS_FORCEINLINE void storeBlock(const Lanes<L>* a, double* p, std::index_sequence<n...>) {
  (a[n].store(p + n * L), ...);
}

template <int L, std::size_t... n>
ATRAPOS_FORCEINLINE void clearEntries(Lanes<L>* a, std::index_sequence<n...>) {
  ((a[n] = Lanes<L>(0.0)), ...);
}

template <int L, std::size_t... n>
ATRAPOS_FORCEINLINE void copyEntries(const Lanes<L>* a, Lanes<L>* out, std::index_sequence<n...>) {
  ((out[n] = a[n]), ...);
}

template <int L, std::size_t... n>
ATRAPOS_FORCEINLINE void addEntries(const Lanes<L>* a, Lanes<L>* out, std::index_sequence<n...>) {
  ((out[n] += a[n]), ...);
}

/// Fetches the cache lines of N lanes of doubles; those that reach into one line more, where they do not
/// begin with a line, fetch that as well.
template <int L, std::size_t... n>
ATRAPOS_FORCEINLINE void fetch([[maybe_unused]] const double* p, std::index_sequence<n...>) {
#if defined(__GNUC__) && !defined(__CUDACC__) && !defined(__HIPCC__)
  constexpr int line = 8, end = L * static_cast<int>(sizeof...(n));
  ((L * n % line == 0 ? __builtin_prefetch(p + L * n) : void()), ...);
  if constexpr (L % line != 0) __builtin_prefetch(p + end - 1);
#endif
}

// Whether term t is the first one of the list that reads entry `entry` of the left or the right block, or of
// either where both are one.
template <class Terms>
constexpr bool readsFirst(std::size_t t, int entry, bool left, bool right) {
  for (std::size_t s = 0; s < t; ++s)
    if ((left && Terms::list[s].left == entry) || (right && Terms::list[s].right == entry)) return false;
  return true;
}

/// The terms of two different blocks, each entry loaded where the first term reads it: with all loads in
/// front, more values than a small register file holds would be alive at once.
template <class Terms, int L>
struct LoadedTerms {
  const double *p, *q;
  Lanes<L> x[Terms::numLeft], y[Terms::numRight];

  ATRAPOS_FORCEINLINE LoadedTerms(const double* left, const double* right) : p(left), q(right) {}

  ATRAPOS_FORCEINLINE void addTo(Lanes<L>* sum) { addAll(sum, TermIndices<Terms>()); }

 private:
  template <std::size_t... t>
  ATRAPOS_FORCEINLINE void addAll(Lanes<L>* sum, std::index_sequence<t...>) {
    (add<t>(sum), ...);
  }
  template <std::size_t t>
  ATRAPOS_FORCEINLINE void add(Lanes<L>* sum) {
    constexpr BilinearTerm term = Terms::list[t];
    if constexpr (readsFirst<Terms>(t, term.left, true, false)) x[term.left] = loadHeld<L>(p, term.left);
    if constexpr (readsFirst<Terms>(t, term.right, false, true)) y[term.right] = loadHeld<L>(q, term.right);
    if constexpr (term.sign > 0)
      sum[term.out] += x[term.left] * y[term.right];
    else
      sum[term.out] -= x[term.left] * y[term.right];
  }
};

/// Adds the terms at (a_i, b_{k-i}), i = first..k-first, to out; a and b are different blocks of slots.
/// Meanwhile the same place of b's `ahead` doubles on is fetched (a's is where a meets itself).
template <class Terms, int L>
ATRAPOS_FORCEINLINE void convolveBlocks(const double* a, const double* b, std::ptrdiff_t stride, int k,
                                        int first, std::ptrdiff_t ahead, Lanes<L>* out) {
  Lanes<L> sum[Terms::numOut];
  clearEntries(sum, Entries<Terms::numOut>());
  const double* p = a + first * stride;
  const double* q = b + (k - first) * stride;
  for (int i = first; i <= k - first; ++i, p += stride, q -= stride) {
    fetch<L>(q + ahead, Entries<Terms::numRight>());
    LoadedTerms<Terms, L>(p, q).addTo(sum);
  }
  addEntries(sum, out, Entries<Terms::numOut>());
}

/// Adds the terms at (a_i, b_{k-i}) and at (a_{k-i}, b_i), i = 1..last, to out.
template <class Terms, int L>
ATRAPOS_FORCEINLINE void convolveEnds(const double* a, const double* b, std::ptrdiff_t stride, int k,
                                      int last, std::ptrdiff_t ahead, Lanes<L>* out) {
  Lanes<L> sum[Terms::numOut];
  clearEntries(sum, Entries<Terms::numOut>());
  for (int i = 1; i <= last; ++i) {
    const std::ptrdiff_t near = i * stride, far = (k - i) * stride;
    fetch<L>(b + near + ahead, Entries<Terms::numRight>());
    fetch<L>(b + far + ahead, Entries<Terms::numRight>());
    LoadedTerms<Terms, L>(a + near, b + far).addTo(sum);
    LoadedTerms<Terms, L>(a + far, b + near).addTo(sum);
  }
  addEntries(sum, out, Entries<Terms::numOut>());
}

// A term of a block with itself at (i, j) and (j, i). Where an output consists of squares alone both are the
// same: counted once here, doubled at the end (addBoth).
template <class Terms, std::size_t t, int L>
ATRAPOS_FORCEINLINE void addSymmetricTerm(const Lanes<L>* x, const Lanes<L>* y, Lanes<L>* forward,
                                          Lanes<L>* backward) {
  constexpr BilinearTerm term = Terms::list[t];
  if constexpr (term.sign > 0)
    forward[term.out] += x[term.left] * y[term.right];
  else
    forward[term.out] -= x[term.left] * y[term.right];
  if constexpr (!Terms::onlySquares(term.out)) {
    if constexpr (term.sign > 0)
      backward[term.out] += y[term.left] * x[term.right];
    else
      backward[term.out] -= y[term.left] * x[term.right];
  }
}
template <class Terms, int L, std::size_t... t>
ATRAPOS_FORCEINLINE void addSymmetricTerms(const Lanes<L>* x, const Lanes<L>* y, Lanes<L>* forward,
                                           Lanes<L>* backward, std::index_sequence<t...>) {
  (addSymmetricTerm<Terms, t>(x, y, forward, backward), ...);
}

template <class Terms, int L, std::size_t... o>
ATRAPOS_FORCEINLINE void addBoth(const Lanes<L>* forward, const Lanes<L>* backward, Lanes<L>* out,
                                 std::index_sequence<o...>) {
  ((out[o] += Terms::onlySquares(o) ? 2.0 * forward[o] : forward[o] + backward[o]), ...);
}

/// out += the terms at (x, y) and at (y, x).
template <class Terms, int L>
ATRAPOS_FORCEINLINE void addPairs(const Lanes<L>* x, const Lanes<L>* y, Lanes<L>* out) {
  Lanes<L> forward[Terms::numOut], backward[Terms::numOut];
  clearEntries(forward, Entries<Terms::numOut>());
  clearEntries(backward, Entries<Terms::numOut>());
  addSymmetricTerms<Terms>(x, y, forward, backward, TermIndices<Terms>());
  addBoth<Terms>(forward, backward, out, Entries<Terms::numOut>());
}

/// The terms of a block with itself at (x, y) and (y, x), loaded likewise.
template <class Terms, int L>
struct LoadedPairs {
  const double *p, *q;
  Lanes<L> x[Terms::numLeft], y[Terms::numLeft];

  ATRAPOS_FORCEINLINE LoadedPairs(const double* one, const double* other) : p(one), q(other) {}

  ATRAPOS_FORCEINLINE void addTo(Lanes<L>* forward, Lanes<L>* backward) {
    addAll(forward, backward, TermIndices<Terms>());
  }

 private:
  template <std::size_t... t>
  ATRAPOS_FORCEINLINE void addAll(Lanes<L>* forward, Lanes<L>* backward, std::index_sequence<t...>) {
    (add<t>(forward, backward), ...);
  }
  template <std::size_t t>
  ATRAPOS_FORCEINLINE void add(Lanes<L>* forward, Lanes<L>* backward) {
    constexpr BilinearTerm term = Terms::list[t];
    if constexpr (readsFirst<Terms>(t, term.left, true, true)) load<term.left>();
    if constexpr (term.right != term.left && readsFirst<Terms>(t, term.right, true, true)) load<term.right>();
    addSymmetricTerm<Terms, t>(x, y, forward, backward);
  }
  template <int entry>
  ATRAPOS_FORCEINLINE void load() {
    x[entry] = loadHeld<L>(p, entry);
    y[entry] = loadHeld<L>(q, entry);
  }
};

/// convolveBlocks where both blocks are one.
template <class Terms, int L>
ATRAPOS_FORCEINLINE void convolveBlock(const double* a, std::ptrdiff_t stride, int k, int first,
                                       std::ptrdiff_t ahead, Lanes<L>* out) {
  using All = Entries<Terms::numLeft>;
  using Outputs = Entries<Terms::numOut>;
  Lanes<L> forward[Terms::numOut], backward[Terms::numOut];
  clearEntries(forward, Outputs());
  clearEntries(backward, Outputs());
  const double* p = a + first * stride;
  const double* q = a + (k - first) * stride;
  for (; p < q; p += stride, q -= stride) {
    fetch<L>(p + ahead, All());
    fetch<L>(q + ahead, All());
    LoadedPairs<Terms, L>(p, q).addTo(forward, backward);
  }
  addBoth<Terms>(forward, backward, out, Outputs());
  if (p == q) {
    fetch<L>(p + ahead, All());
    Lanes<L> x[Terms::numLeft];
    loadBlock(p, x, All());
    addTerms<Terms>(x, x, out, TermIndices<Terms>());
  }
}

/// convolveEnds where both blocks are one.
template <class Terms, int L>
ATRAPOS_FORCEINLINE void convolveBlockEnds(const double* a, std::ptrdiff_t stride, int k, int last,
                                           std::ptrdiff_t ahead, Lanes<L>* out) {
  using All = Entries<Terms::numLeft>;
  using Outputs = Entries<Terms::numOut>;
  Lanes<L> forward[Terms::numOut], backward[Terms::numOut];
  clearEntries(forward, Outputs());
  clearEntries(backward, Outputs());
  for (int i = 1; i <= last; ++i) {
    const double* p = a + i * stride;
    const double* q = a + (k - i) * stride;
    fetch<L>(p + ahead, All());
    fetch<L>(q + ahead, All());
    LoadedPairs<Terms, L>(p, q).addTo(forward, backward);
  }
  addBoth<Terms>(forward, backward, out, Outputs());
}

/// The sums over i = 1..k-1 of order k = context.order, added to out. The first order of a block adds the
/// pairs of orders below it for the whole block, and leaves the sums of later orders in `waiting`; those add
/// the pairs that were not known then.
template <class Terms, class X>
ATRAPOS_FORCEINLINE void convolveTerms(const Context<X::lanes>& c, const double* p, const double* q,
                                       double* waiting, LanesOf<X>* out) {
  using Outputs = Entries<Terms::numOut>;
  const int k = c.order;
  const std::ptrdiff_t perOrder = static_cast<std::ptrdiff_t>(c.shape.sums) * X::lanes;
  // The loops below fetch what they read; order 0 and the order to be written come besides.
  fetch<X::lanes>(q + c.ahead, Entries<Terms::numRight>());
  fetch<X::lanes>(q + k * c.stride + c.ahead, Entries<Terms::numRight>());
  if (c.block.begin != 0 && k > c.block.begin) {
    const int last = k - c.block.begin;
    LanesOf<X> begun[Terms::numOut];
    fetch<X::lanes>(waiting + (last - 1) * perOrder + c.ahead, Outputs());
    loadBlock(waiting + (last - 1) * perOrder, begun, Outputs());
    addEntries(begun, out, Outputs());
    if constexpr (Terms::ofOneBlock)
      convolveBlockEnds<Terms>(p, c.stride, k, last, c.ahead, out);
    else
      convolveEnds<Terms>(p, q, c.stride, k, last, c.ahead, out);
    return;
  }
  if constexpr (Terms::ofOneBlock)
    convolveBlock<Terms>(p, c.stride, k, 1, c.ahead, out);
  else
    convolveBlocks<Terms>(p, q, c.stride, k, 1, c.ahead, out);
  for (int n = k + 1; n < c.block.end; ++n) {
    fetch<X::lanes>(waiting + (n - k - 1) * perOrder + c.ahead, Outputs());
    LanesOf<X> sum[Terms::numOut];
    clearEntries(sum, Outputs());
    if constexpr (Terms::ofOneBlock)
      convolveBlock<Terms>(p, c.stride, n, n - k + 1, 0, sum);
    else
      convolveBlocks<Terms>(p, q, c.stride, n, n - k + 1, 0, sum);
    storeBlock(sum, waiting + (n - k - 1) * perOrder, Outputs());
  }
}

/// N values of a pass that are kept together: one context and, once an operation needs their histories, N
/// consecutive slots.
template <class X, int N>
struct Block {
  LanesOf<X> v[N];                       ///< coefficients of this pass
  Context<X::lanes>* context = nullptr;  ///< null: constants, and v are their values
  mutable double* slots = nullptr;       ///< order-0 lanes of the first; null: no histories
  bool zero = false;                     ///< all coefficients of this pass are zero: inputs not known yet

  Block() = default;

  /// From variables; their slots serve where they lie side by side.
  ATRAPOS_FORCEINLINE explicit Block(const Sweep<X>* a) : Block(a, std::make_index_sequence<N>()) {}

  ATRAPOS_FORCEINLINE Sweep<X> entry(int n) const {
    if (context == nullptr) return Sweep<X>(v[n]);
    return Sweep<X>(v[n], context, slots == nullptr ? nullptr : slots + n * X::lanes);
  }

  /// An entry is written over: the histories are no longer those of the block.
  ATRAPOS_FORCEINLINE void set(int n, const Sweep<X>& a) {
    if (context == nullptr && a.context() != nullptr) {
      context = a.context();
      if constexpr (X::pass != Pass::Start) clearEntries(v, std::make_index_sequence<N>());
    }
    v[n] = context == nullptr ? a.value() : a.coefficient();
    slots = nullptr;
    zero = false;
  }

  /// The order-0 lanes of the histories, taken the first time.
  ATRAPOS_FORCEINLINE const double* histories(Context<X::lanes>& c) const {
    if (slots == nullptr) {
      slots = takeSlots<X>(c, N);
      recordAll(c, std::make_index_sequence<N>());
    }
    return slots;
  }

  /// Coefficients of this pass beside active values: constants count in Start only.
  ATRAPOS_FORCEINLINE bool counts() const { return X::pass == Pass::Start || context != nullptr; }

 private:
  template <std::size_t... n>
  ATRAPOS_FORCEINLINE Block(const Sweep<X>* a, std::index_sequence<n...>) {
    ((context = context != nullptr ? context : a[n].context()), ...);
    if (context == nullptr) {
      ((v[n] = a[n].value()), ...);
      return;
    }
    ((v[n] = a[n].coefficient()), ...);
    zero = (a[n].isZero() && ...);
    if ((a[n].hasSlot() && ...)) {
      double* first = a[0].slot();
      if (((a[n].slot() == first + n * X::lanes) && ...)) slots = first;
    }
  }
  template <std::size_t... n>
  ATRAPOS_FORCEINLINE void recordAll(const Context<X::lanes>& c, std::index_sequence<n...>) const {
    (record<X::pass>(c, slots + static_cast<std::ptrdiff_t>(n) * X::lanes, counts() ? v[n] : LanesOf<X>(0.0)),
     ...);
  }
};

/// out = the terms' sums of the first entries of two blocks (or of one with itself: Terms::ofOneBlock).
template <class Terms, class X, int M, int N>
ATRAPOS_FORCEINLINE void bilinear(const Block<X, M>& a, const Block<X, N>& b, Block<X, Terms::numOut>& out) {
  static_assert(Terms::numLeft <= M && Terms::numRight <= N);
  Context<X::lanes>* context = a.context != nullptr ? a.context : b.context;
  out.context = context;
  LanesOf<X> sum[Terms::numOut];
  clearEntries(sum, Entries<Terms::numOut>());
  if (context == nullptr) {
    addTerms<Terms>(a.v, b.v, sum, TermIndices<Terms>());
  } else {
    const double* p = a.histories(*context);
    const double* q = Terms::ofOneBlock ? p : b.histories(*context);
    [[maybe_unused]] double* waiting = nullptr;
    if constexpr (X::pass == Pass::Sweep || X::counting) waiting = takeSums<X>(*context, Terms::numOut);
    if constexpr (X::pass == Pass::Start) {
      addTerms<Terms>(a.v, b.v, sum, TermIndices<Terms>());
    } else {
      if (X::pass == Pass::Sweep && context->order > 1) convolveTerms<Terms, X>(*context, p, q, waiting, sum);
      LanesOf<X> a0[Terms::numLeft], b0[Terms::numRight];
      loadBlock(p, a0, Entries<Terms::numLeft>());
      loadBlock(q, b0, Entries<Terms::numRight>());
      if constexpr (Terms::ofOneBlock) {
        if (!a.zero) addPairs<Terms>(a0, a.v, sum);
      } else {
        if (!b.zero && b.context != nullptr) addTerms<Terms>(a0, b.v, sum, TermIndices<Terms>());
        if (!a.zero && a.context != nullptr) addTerms<Terms>(a.v, b0, sum, TermIndices<Terms>());
      }
    }
  }
  copyEntries(sum, out.v, Entries<Terms::numOut>());
}

}  // namespace atrapos::taylor::detail
