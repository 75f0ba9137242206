#include "atrapos/physics/Dielectric.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::physics::Dielectric<atrapos::solid::SaintVenantKirchhoff>)
ATRAPOS_POINT_LAW(atrapos::physics::Dielectric<atrapos::solid::NeoHookean>)
ATRAPOS_POINT_LAW(atrapos::physics::Dielectric<atrapos::solid::MooneyRivlin>)
