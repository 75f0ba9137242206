#include "atrapos/solid/SaintVenantKirchhoff.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_MATERIAL(atrapos::solid::SaintVenantKirchhoff)
