#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/TiedShellMetal.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::Mitc4Metal<true>)
