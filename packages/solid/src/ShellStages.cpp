#include "atrapos/solid/ShellStages.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_SHELL_STAGES(ATRAPOS_POINT_LAW, PlainShell)
ATRAPOS_SHELL_STAGES(ATRAPOS_POINT_LAW, AssumedShearShell)
ATRAPOS_SHELL_STAGES(ATRAPOS_POINT_LAW, TiedShell<atrapos::solid::Mitc4>)
