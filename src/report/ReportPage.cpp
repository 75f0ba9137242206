#include "report/ReportPage.hpp"

#include <nlohmann/json.hpp>

#include "report/Bundle.hpp"

namespace atrapos {

// Outside of strings JSON has none of these characters, inside it may write any as its number. What is left
// of
// `</script>`, `<!--` or a reference to a character means nothing to a browser.
std::string jsonInHtml(const nlohmann::json& json) {
  const std::string text = json.dump(-1, ' ', true, nlohmann::json::error_handler_t::replace);
  std::string safe;
  safe.reserve(text.size());
  for (const char c : text) switch (c) {
      case '<':
        safe += "\\u003c";
        break;
      case '>':
        safe += "\\u003e";
        break;
      case '&':
        safe += "\\u0026";
        break;
      default:
        safe += c;
    }
  return safe;
}

std::string reportPage(const nlohmann::json& data) {
  nlohmann::json all = data;
  all["licences"] = std::string(bundle::licences());
  std::string page = R"(<!doctype html>
<!-- atrapos report -->
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; base-uri 'none'; form-action 'none'">
<title>atrapos report</title>
</head>
<body>
<noscript>This report is drawn by JavaScript, which is switched off.</noscript>
<script type="application/json" id="data">)";
  page += jsonInHtml(all);
  page += "</script>\n<script>";
  page += bundle::script();
  return page + "</script>\n</body>\n</html>\n";
}

}  // namespace atrapos
