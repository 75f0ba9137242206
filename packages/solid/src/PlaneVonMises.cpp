#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/VonMises.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::VonMises<false, true>)
ATRAPOS_POINT_LAW(atrapos::solid::VonMises<true, true>)
