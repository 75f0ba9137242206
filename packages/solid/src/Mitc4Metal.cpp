#include "atrapos/solid/Mitc4Metal.hpp"
#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::Mitc4Metal<false>)
