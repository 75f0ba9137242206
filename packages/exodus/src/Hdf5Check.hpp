#pragma once

#include <string>

namespace atrapos::exodus {

/// Opens and reads an HDF5 file as the library will, in a process of its own with limits of memory and time:
/// a damaged file may send HDF5 round in circles, and a small one may stand for any number of values. Throws
/// Error, one line, where that process does not come to a good end; otherwise the file is as checkLayout
/// wants it.
void checkHdf5(const std::string& file);

}  // namespace atrapos::exodus
