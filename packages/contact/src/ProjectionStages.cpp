#include "CompiledStages.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Plane>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Cylinder>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Sphere>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Cone>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Torus>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::TaperedRoll>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::CrownedRoll>)
ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::TabulatedRoll>)
