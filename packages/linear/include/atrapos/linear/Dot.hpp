#pragma once

#include "atrapos/linear/Types.hpp"

namespace atrapos::linear {

/// x . y, summed in an order that depends on the vectors' distribution only: the same bits for any number of
/// threads (Tpetra's own dot is not). Collective.
double dot(const Vector& x, const Vector& y);

}  // namespace atrapos::linear
