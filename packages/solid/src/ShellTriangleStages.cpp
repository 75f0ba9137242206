#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/solid/ShellStages.hpp"

ATRAPOS_SHELL_STAGES(ATRAPOS_POINT_LAW, TiedShell<atrapos::solid::Mitc3>)
ATRAPOS_SHELL_STAGES(ATRAPOS_POINT_LAW, TiedShell<atrapos::solid::Mitc6>)
