#include "report/Report.hpp"

#include <nlohmann/json.hpp>

#include "machine/Ranks.hpp"
#include "output/Files.hpp"
#include "report/ReportData.hpp"
#include "report/ReportPage.hpp"

namespace atrapos {

void writeReport(const std::string& folder, const std::string& file) {
  if (!ranks::isFirst()) return;
  replaceFile(file, reportPage(reportData(folder)));
}

}  // namespace atrapos
