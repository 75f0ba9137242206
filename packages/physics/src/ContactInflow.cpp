#include "atrapos/physics/ContactInflow.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::physics::ContactInflow)
