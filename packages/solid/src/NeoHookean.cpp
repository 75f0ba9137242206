#include "atrapos/solid/NeoHookean.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_MATERIAL(atrapos::solid::NeoHookean)
