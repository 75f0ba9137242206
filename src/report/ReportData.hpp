#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace atrapos {

/// All that a page shows of the results in a folder: paths, points, steps, events, shape, summary and deck.
/// What there is too much of is thinned, and `notes` says so. Throws std::invalid_argument or exodus::Error,
/// one line, where the folder holds no path or a damaged one.
nlohmann::json reportData(const std::string& folder);

}  // namespace atrapos
