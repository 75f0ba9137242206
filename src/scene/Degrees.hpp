#pragma once

#include <cmath>

namespace atrapos {

// Angles of decks and monitors are in degrees, those of problems are not.
inline double radians(double degrees) { return degrees * M_PI / 180; }

}  // namespace atrapos
