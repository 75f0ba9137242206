#include "atrapos/physics/Expanding.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::physics::Expanding<atrapos::solid::SaintVenantKirchhoff, 0>)
ATRAPOS_POINT_LAW(atrapos::physics::Expanding<atrapos::solid::SaintVenantKirchhoff, 1>)
ATRAPOS_POINT_LAW(atrapos::physics::Expanding<atrapos::solid::NeoHookean, 0>)
ATRAPOS_POINT_LAW(atrapos::physics::Expanding<atrapos::solid::NeoHookean, 1>)
ATRAPOS_POINT_LAW(atrapos::physics::Expanding<atrapos::solid::MooneyRivlin, 0>)
ATRAPOS_POINT_LAW(atrapos::physics::Expanding<atrapos::solid::MooneyRivlin, 1>)
