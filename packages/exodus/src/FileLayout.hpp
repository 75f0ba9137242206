#pragma once

#include <cstdint>
#include <string>

namespace atrapos::exodus {

/// Compares the variables and attributes that libexodusii reads with what Exodus II says of them: types,
/// ranks, and lengths against the dimensions that they are of. The library takes its buffers from the
/// dimensions and fills them with all that a variable has, so a longer one would overwrite memory and a
/// shorter one leave values out. Throws Error, one line; also where a dimension counts what the file does not
/// have, or the values together exceed `mostBytes`. Returns their bytes. The file is opened by netCDF.
std::uint64_t checkLayout(const std::string& file, std::uint64_t mostBytes);

/// The same, and reads every value of those variables once.
void readThrough(const std::string& file, std::uint64_t mostBytes);

}  // namespace atrapos::exodus
