#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/ShellMetal.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::AssumedShearMetal<false>)
ATRAPOS_POINT_LAW(atrapos::solid::AssumedShearMetal<true>)
