#pragma once

#include <string_view>

namespace atrapos::bundle {

/// The page's program with the libraries that it uses, as scripts/report-bundle makes it.
std::string_view script();

/// The licences of these libraries.
std::string_view licences();

}  // namespace atrapos::bundle
