#pragma once

#include <cmath>

#include "deck/Deck.hpp"

/// Vectors in space of set-up and output, as decks have them.
namespace atrapos::vectors {

using deck::Vector3;

/// a + t b
inline Vector3 sum(const Vector3& a, double t, const Vector3& b) {
  return {a[0] + t * b[0], a[1] + t * b[1], a[2] + t * b[2]};
}
inline double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(const Vector3& v) { return std::sqrt(dot(v, v)); }
inline Vector3 unit(const Vector3& v) { return sum({}, 1 / length(v), v); }

}  // namespace atrapos::vectors
