#include "LineStages.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::fem::CurveStage<1>)
ATRAPOS_POINT_LAW(atrapos::fem::CurveStage<2>)
ATRAPOS_POINT_LAW(atrapos::fem::SlopeStage)
ATRAPOS_POINT_LAW(atrapos::fem::CubatureStage<1>)
ATRAPOS_POINT_LAW(atrapos::fem::CubatureStage<2>)
ATRAPOS_POINT_LAW(atrapos::fem::ForceStage<1>)
ATRAPOS_POINT_LAW(atrapos::fem::ForceStage<2>)
