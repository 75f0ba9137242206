#pragma once

#include <vector>

#include "atrapos/path/SeriesStep.hpp"

namespace atrapos::path {

struct PathUnderWay;

/// The series at the position, with as many orders as its end asks for (Options::fewerOrders); the functions
/// `zero` are zero at its start. Order, weight and sense are those of the path. Throws PathError as
/// buildSeries does.
Series seriesHere(const PathUnderWay& path, SeriesRequest request, const std::vector<int>& zero);

}  // namespace atrapos::path
