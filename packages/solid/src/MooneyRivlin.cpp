#include "atrapos/solid/MooneyRivlin.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_MATERIAL(atrapos::solid::MooneyRivlin)
