#include "commands/PlotCommand.hpp"

#include <fmt/format.h>

#include <ostream>
#include <stdexcept>

#include "output/Files.hpp"
#include "output/PathPlot.hpp"

namespace atrapos {

void plotResults(const PlotWords& words, std::ostream* progress) {
  const std::string name = words.output.empty() ? words.folder + "/path" : words.output;
  requireOwnPicture(name);
  const std::string why = plotPath({words.folder, name, words.x, words.y});
  if (why.find("not drawn") != std::string::npos) throw std::invalid_argument(why);
  if (progress)
    *progress << fmt::format("{0}.png, {0}.svg, {0}.gp{1}\n", name, why.empty() ? "" : "; " + why);
}

}  // namespace atrapos
