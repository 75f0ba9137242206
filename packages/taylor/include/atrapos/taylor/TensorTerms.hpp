#pragma once

#include <array>

#include "atrapos/taylor/Bilinear.hpp"

/// The lists of products behind the operations of Tensor.hpp.
namespace atrapos::taylor {

/// Position of entry (i, j) of a symmetric tensor: xx yy zz xy yz zx.
ATRAPOS_FORCEINLINE constexpr int symmetricIndex(int i, int j) {
  return i == j ? i : i + j == 1 ? 3 : i + j == 3 ? 4 : 5;
}

namespace detail {

template <int N>
struct TermList {
  std::array<BilinearTerm, N> terms{};
  int count = 0;
  constexpr void add(int out, int left, int right, int sign = 1) {
    terms[count++] = BilinearTerm{out, left, right, sign};
  }
};

/// (A^T A)_ij = sum_k A_ki A_kj
constexpr auto listGramianTerms() {
  TermList<18> t;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j) t.add(symmetricIndex(i, j), 3 * k + i, 3 * k + j);
  return t.terms;
}
struct GramianTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = 9, numRight = 9, numOut = 6;
  static constexpr bool onlySquares(int out) { return out < 3; }
  static constexpr auto list = listGramianTerms();
};

/// (A B)_ij = sum_k A_ik B_kj
constexpr auto listProductTerms() {
  TermList<27> t;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) t.add(3 * i + j, 3 * i + k, 3 * k + j);
  return t.terms;
}
struct ProductTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = 9, numRight = 9, numOut = 9;
  static constexpr auto list = listProductTerms();
};

/// (A S)_ij = sum_k A_ik S_kj
constexpr auto listSymmetricProductTerms() {
  TermList<27> t;
  for (int k = 0; k < 3; ++k)
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) t.add(3 * i + j, 3 * i + k, symmetricIndex(k, j));
  return t.terms;
}
struct SymmetricProductTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = 9, numRight = 6, numOut = 9;
  static constexpr auto list = listSymmetricProductTerms();
};

/// cof(A)_ij = A_{i+1,j+1} A_{i+2,j+2} - A_{i+1,j+2} A_{i+2,j+1}, indices modulo 3
constexpr auto listCofactorTerms() {
  TermList<18> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      t.add(3 * i + j, 3 * i1 + j1, 3 * i2 + j2);
      t.add(3 * i + j, 3 * i1 + j2, 3 * i2 + j1, -1);
    }
  return t.terms;
}
struct CofactorTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = 9, numRight = 9, numOut = 9;
  static constexpr bool onlySquares(int) { return false; }
  static constexpr auto list = listCofactorTerms();
};

/// cof(S) of a symmetric tensor
constexpr auto listSymmetricCofactorTerms() {
  TermList<12> t;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      const int i1 = (i + 1) % 3, i2 = (i + 2) % 3, j1 = (j + 1) % 3, j2 = (j + 2) % 3;
      t.add(symmetricIndex(i, j), symmetricIndex(i1, j1), symmetricIndex(i2, j2));
      t.add(symmetricIndex(i, j), symmetricIndex(i1, j2), symmetricIndex(i2, j1), -1);
    }
  return t.terms;
}
struct SymmetricCofactorTerms {
  static constexpr bool ofOneBlock = true;
  static constexpr int numLeft = 6, numRight = 6, numOut = 6;
  static constexpr bool onlySquares(int) { return false; }
  static constexpr auto list = listSymmetricCofactorTerms();
};

/// det(A) = sum_j A_0j cof_0j, symmetric with the entries xx, xy, zx of both
constexpr auto listDeterminantTerms() {
  TermList<3> t;
  for (int j = 0; j < 3; ++j) t.add(0, j, j);
  return t.terms;
}
struct DeterminantTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = 3, numRight = 3, numOut = 1;
  static constexpr auto list = listDeterminantTerms();
};

constexpr auto listSymmetricDeterminantTerms() {
  TermList<3> t;
  for (int j = 0; j < 3; ++j) t.add(0, symmetricIndex(0, j), symmetricIndex(0, j));
  return t.terms;
}
struct SymmetricDeterminantTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = 6, numRight = 6, numOut = 1;
  static constexpr auto list = listSymmetricDeterminantTerms();
};

/// Every entry times one number
template <int N>
constexpr auto listScaledTerms() {
  TermList<N> t;
  for (int n = 0; n < N; ++n) t.add(n, n, 0);
  return t.terms;
}
template <int N>
struct ScaledTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = N, numRight = 1, numOut = N;
  static constexpr auto list = listScaledTerms<N>();
};

/// A : B of symmetric tensors
constexpr auto listContractionTerms() {
  TermList<9> t;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) t.add(0, symmetricIndex(i, j), symmetricIndex(i, j));
  return t.terms;
}
struct ContractionTerms {
  static constexpr bool ofOneBlock = false;
  static constexpr int numLeft = 6, numRight = 6, numOut = 1;
  static constexpr auto list = listContractionTerms();
};

}  // namespace detail
}  // namespace atrapos::taylor
