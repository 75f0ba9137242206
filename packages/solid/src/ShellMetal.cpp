#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/ShellStages.hpp"

ATRAPOS_POINT_LAW(atrapos::solid::ShellMetalStage<false>)
ATRAPOS_POINT_LAW(atrapos::solid::ShellMetalStage<true>)
