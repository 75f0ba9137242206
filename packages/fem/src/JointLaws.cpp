#include "JointLaws.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::fem::JointAngle)
ATRAPOS_POINT_LAW(atrapos::fem::JointDirection)
