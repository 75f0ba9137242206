#include "atrapos/solid/Ogden.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_MATERIAL(atrapos::solid::Ogden)
