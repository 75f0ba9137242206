#include "atrapos/solid/Gent.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_MATERIAL(atrapos::solid::Gent)
