#pragma once

#include <iosfwd>
#include <string>
#include <vector>

namespace atrapos {

struct PlotWords {
  std::string folder;
  std::string output;          ///< without .png and .svg; empty: `path` in the folder
  std::string x;               ///< quantity; empty: by the run
  std::vector<std::string> y;  ///< the same
};

/// `atrapos plot`: NAME.png, NAME.svg and the script NAME.gp of the results in a folder. Throws
/// std::invalid_argument, one line, where there is nothing to draw or no picture came out.
void plotResults(const PlotWords& words, std::ostream* progress);

}  // namespace atrapos
