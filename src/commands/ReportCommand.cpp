#include "commands/ReportCommand.hpp"

#include <ostream>

#include "output/Files.hpp"
#include "report/Report.hpp"

namespace atrapos {

void reportResults(const std::string& folder, const std::string& output, std::ostream* progress) {
  const std::string file = output.empty() ? folder + "/report.html" : output;
  requireOwn(file, Made::report, {});
  writeReport(folder, file);
  if (progress) *progress << file << '\n';
}

}  // namespace atrapos
