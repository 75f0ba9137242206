#include "atrapos/solid/MixedLaw.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::NeoHookean>)
ATRAPOS_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::MooneyRivlin>)
ATRAPOS_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::Yeoh>)
ATRAPOS_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::Gent>)
ATRAPOS_POINT_LAW(atrapos::solid::MixedLaw<atrapos::solid::Ogden>)
