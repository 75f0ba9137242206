#include "atrapos/solid/Yeoh.hpp"

#include "atrapos/fem/PointLawOf.hpp"

ATRAPOS_MATERIAL(atrapos::solid::Yeoh)
