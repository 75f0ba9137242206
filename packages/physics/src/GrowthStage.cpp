#include "atrapos/physics/GrowthStage.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::physics::GrowthStage)
