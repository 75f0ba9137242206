#include "atrapos/solid/EdgePressureLaws.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::EdgePressure<false, false>)
ATRAPOS_POINT_LAW(atrapos::solid::EdgePressure<false, true>)
ATRAPOS_POINT_LAW(atrapos::solid::EdgePressure<true, false>)
ATRAPOS_POINT_LAW(atrapos::solid::EdgePressure<true, true>)
