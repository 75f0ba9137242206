#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/physics/BalanceLaw.hpp"

// One source: they share the steps of formulas, which are most of what there is to compile.
ATRAPOS_POINT_LAW(atrapos::physics::BalanceLaw<1>)
ATRAPOS_POINT_LAW(atrapos::physics::BalanceLaw<2>)
ATRAPOS_POINT_LAW(atrapos::physics::BalanceLaw<3>)
ATRAPOS_POINT_LAW(atrapos::physics::BalanceLaw<4>)
ATRAPOS_POINT_LAW(atrapos::physics::InflowLaw<1>)
ATRAPOS_POINT_LAW(atrapos::physics::InflowLaw<2>)
ATRAPOS_POINT_LAW(atrapos::physics::InflowLaw<3>)
ATRAPOS_POINT_LAW(atrapos::physics::InflowLaw<4>)
