#include "atrapos/solid/ShellMetal.hpp"
#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::ShellMetal<false>)
ATRAPOS_POINT_LAW(atrapos::solid::ShellMetal<true>)
