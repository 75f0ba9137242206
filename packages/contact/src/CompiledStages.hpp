#pragma once

#include "atrapos/contact/StageLaws.hpp"
#include "atrapos/contact/Tools.hpp"
#include "atrapos/fem/PointLaw.hpp"

// The stages that this package compiles.
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Plane>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Cylinder>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Sphere>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Cone>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::Torus>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::TaperedRoll>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::CrownedRoll>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::TabulatedRoll>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::ProjectionStage<atrapos::contact::PatchTool>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::PullStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::TurnStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::RegularisedPressure>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::PowerBarrier>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::ExponentialPressure>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::PressureStage<atrapos::contact::SmoothedPenalty>)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::SharpenedStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::HardStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::CurveStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::OverclosureStage)
ATRAPOS_DECLARE_POINT_LAW(atrapos::contact::PassageStage)
