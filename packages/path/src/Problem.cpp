#include "atrapos/path/Problem.hpp"

#include <Tpetra_Vector.hpp>

namespace atrapos::path {

double Problem::inner(const Increment& x, const Increment& y) const { return x.u->dot(*y.u); }

}  // namespace atrapos::path
