#include "CompiledStages.hpp"
#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::RegularisedPressure>)
ATRAPOS_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::PowerBarrier>)
ATRAPOS_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::ExponentialPressure>)
ATRAPOS_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::SmoothedPenalty>)
ATRAPOS_POINT_LAW(atrapos::contact::SharpenedStage)
ATRAPOS_POINT_LAW(atrapos::contact::HardStage)
ATRAPOS_POINT_LAW(atrapos::contact::CurveStage)
ATRAPOS_POINT_LAW(atrapos::contact::OverclosureStage)
ATRAPOS_POINT_LAW(atrapos::contact::PassageStage)
