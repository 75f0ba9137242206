#include "atrapos/solid/ThinStages.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_THIN_STAGES(ATRAPOS_POINT_LAW)
