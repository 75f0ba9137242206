#include "CompiledStages.hpp"
#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::PatchTool>)
ATRAPOS_POINT_LAW(atrapos::contact::PullStage)
ATRAPOS_POINT_LAW(atrapos::contact::TurnStage)
