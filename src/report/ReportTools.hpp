#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace atrapos {

/// The rigid tools that a run wrote beside a result file (writeToolShapes): surfaces where they stand before
/// they move, as shapeOf has those of the body, and for each of the file's states a motion of every tool,
/// x = place + motion (R, row by row, then a shift). Null where there is no such file or it has other states
/// than the result file. Throws exodus::Error on files that are damaged.
nlohmann::json toolsOf(const std::string& file, int states);

}  // namespace atrapos
