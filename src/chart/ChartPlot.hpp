#pragma once

#include <string>
#include <vector>

namespace atrapos::chart {

/// A line of the picture, by its points: work and error, both above zero.
struct PlottedCurve {
  std::string name;
  std::vector<double> seconds, factorizations, errors;  ///< factorizations: empty where they are not known
};

/// Draws NAME.png and NAME.svg by the script NAME.gp, error over time and over factorizations: below and left
/// is better. Returns an empty text, or why there is no picture.
std::string plotChart(const std::string& title, const std::string& errorLabel,
                      const std::vector<PlottedCurve>& curves, const std::string& folder,
                      const std::string& name);

}  // namespace atrapos::chart
