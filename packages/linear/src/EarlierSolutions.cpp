#include "EarlierSolutions.hpp"

#include <Tpetra_Vector.hpp>

#include "atrapos/linear/Dot.hpp"

namespace atrapos::linear {

void EarlierSolutions::combine(const Vector& b, Vector& x) const {
  x.putScalar(0);
  Vector left(b, Teuchos::Copy);
  for (const Pair& pair : pairs_) {
    const double share = dot(*pair.product, left);
    left.update(-share, *pair.product, 1);
    x.update(share, *pair.solution, 1);
  }
}

void EarlierSolutions::add(const Vector& x, const Vector& product) {
  if (most_ == 0) return;
  const auto z = rcp(new Vector(x, Teuchos::Copy)), q = rcp(new Vector(product, Teuchos::Copy));
  const double size = q->norm2();
  for (const Pair& pair : pairs_) {
    const double share = dot(*pair.product, *q);
    q->update(-share, *pair.product, 1);
    z->update(-share, *pair.solution, 1);
  }
  // What is left of a dependent product is rounding and would make large, wrong combinations.
  constexpr double dependent = 1e-10;
  const double norm = q->norm2();
  if (!(norm > dependent * size)) return;
  q->scale(1 / norm);
  z->scale(1 / norm);
  if (static_cast<int>(pairs_.size()) == most_) pairs_.pop_front();
  pairs_.push_back({z, q});
}

}  // namespace atrapos::linear
