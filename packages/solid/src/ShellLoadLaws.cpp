#include "atrapos/solid/ShellLoadLaws.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::FollowerPressure)
ATRAPOS_POINT_LAW(atrapos::solid::FollowerEdgeLoad)
ATRAPOS_POINT_LAW(atrapos::solid::DeadEdgeMoment)
