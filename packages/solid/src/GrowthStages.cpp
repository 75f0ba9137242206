#include "atrapos/solid/GrowthStages.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::ElasticStrainStage)
ATRAPOS_POINT_LAW(atrapos::solid::GrownStressStage)
