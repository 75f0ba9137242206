#include "atrapos/solid/FiniteVonMises.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::FiniteVonMises)
