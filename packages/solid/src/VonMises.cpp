#include "atrapos/solid/VonMises.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::VonMises<false>)
ATRAPOS_POINT_LAW(atrapos::solid::VonMises<true>)
