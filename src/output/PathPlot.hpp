#pragma once

#include <string>
#include <vector>

namespace atrapos {

/// What a picture of paths shows.
struct PlotRequest {
  std::string folder;            ///< results of a run
  std::string output{};          ///< without .png and .svg; empty: `path` in the folder
  std::string x{};               ///< quantity of the abscissa; empty: by the run
  std::vector<std::string> y{};  ///< quantities of the ordinate, in one panel; empty: by the run
};

/// Draws the paths in a result folder with gnuplot, as PNG and SVG; the script, with its data, stays beside
/// them (.gp). By itself it draws the load factor over each of the first 36 monitors, or, where the load
/// factor moves supports or tools and scales no force, the forces over the displacements. A colour for each
/// branch, dotted where the tangent has negative eigenvalues, up to the point where they were located; limit
/// and bifurcation points with their load factors. Returns an empty text, or one line that says why there is
/// no picture, or not of all. Throws std::invalid_argument, one line, where the folder holds no path or the
/// request names what it does not have.
std::string plotPath(const PlotRequest& request);

}  // namespace atrapos
