#pragma once

#include "atrapos/contact/CurveContactLaw.hpp"
#include "atrapos/contact/HardContactLaw.hpp"
#include "atrapos/contact/MovingTool.hpp"
#include "atrapos/contact/OneOf.hpp"
#include "atrapos/contact/PatchTool.hpp"
#include "atrapos/contact/SharpenedContact.hpp"
#include "atrapos/fem/PointLawOf.hpp"

/// Compiles the laws of RigidToolOf<Tool> (ATRAPOS_POINT_LAW).
#define ATRAPOS_TOOL_LAWS(Tool)                                                        \
  ATRAPOS_POINT_LAW(atrapos::contact::ContactLaw<Tool, atrapos::contact::AnyPressure>) \
  ATRAPOS_POINT_LAW(atrapos::contact::SharpenedContact<Tool>)                          \
  ATRAPOS_POINT_LAW(atrapos::contact::HardContactLaw<Tool>)                            \
  ATRAPOS_POINT_LAW(atrapos::contact::CurveContactLaw<Tool>)
