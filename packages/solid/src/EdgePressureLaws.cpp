#include "atrapos/solid/EdgePressureLaws.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::EdgePressure<false>)
ATRAPOS_POINT_LAW(atrapos::solid::EdgePressure<true>)
