#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/Mitc4Metal.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::Mitc4Metal<false>)
