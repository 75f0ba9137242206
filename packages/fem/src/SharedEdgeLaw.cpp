#include "SharedEdgeLaw.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::fem::SharedEdgeLaw)
