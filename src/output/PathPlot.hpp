#pragma once

#include <string>
#include <vector>

namespace atrapos {

/// Draws path.csv and points.csv as path.png with gnuplot: the load factor over each of the first 36
/// monitors, a colour for each branch, dashed where the tangent has negative eigenvalues, limit and
/// bifurcation points marked. The script stays beside the tables as path.gp. Returns an empty text, or one
/// line that says why there is no picture, or not of all.
std::string plotPath(const std::string& directory, const std::string& title,
                     const std::vector<std::string>& monitors, int branches);

}  // namespace atrapos
