#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/physics/FlowLaw.hpp"

ATRAPOS_POINT_LAW(atrapos::physics::FlowLaw<2, false>)
ATRAPOS_POINT_LAW(atrapos::physics::FlowLaw<2, true>)
ATRAPOS_POINT_LAW(atrapos::physics::FlowLaw<3, false>)
