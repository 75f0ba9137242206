#pragma once

#include <vector>

#include "atrapos/contact/RegularisedPressure.hpp"
#include "atrapos/fem/Multipliers.hpp"

namespace atrapos::contact {

/// Gives the model a place t on its curve for every point, a parameter of the law; t is the law's last input
/// but for the load factor. `gaps`: Delta of every point. Throws std::invalid_argument for those that the law
/// cannot have.
fem::PointSet withCurves(fem::FeModel& model, const fem::PointSet& points,
                         const RegularisedPressure& pressure, const std::vector<double>& gaps);

}  // namespace atrapos::contact
