#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace atrapos {

/// A JSON text that stands inside of an HTML element whatever strings it has: no `<`, `>` or `&` is left in
/// it, nor a line separator, and read as JSON it is the same. Bytes that are no UTF-8 become U+FFFD.
std::string jsonInHtml(const nlohmann::json& json);

/// A page of its own that shows this data: no other file, no network.
std::string reportPage(const nlohmann::json& data);

}  // namespace atrapos
