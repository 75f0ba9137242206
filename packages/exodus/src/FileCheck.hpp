#pragma once

#include <cstdint>
#include <string>

namespace atrapos::exodus {

enum class Format { Classic, Hdf5 };

/// Throws Error where a file is missing, is neither NetCDF classic (all three variants) nor HDF5, or is
/// shorter than its header says it must be to hold every value that the header announces.
///
/// The NetCDF library opens a classic file that was cut short and gives zeros for what is missing, and trusts
/// a damaged header; so the header is read here first, number by number.
/// HDF5 files carry their length, which the HDF5 library compares with the real one on opening.
/// Returns the format that was found.
Format checkFile(const std::string& file);

/// Gives a classic file the length that its header asks for, with zeros at the end. The library writes
/// names without the zeros that fill their rows, and so leaves the end of a file out until it closes it.
void padFile(const std::string& file);

/// Makes a classic file that the library could not write to its end (full disk) one of so many records: the library counts
/// a record whose values are not all there. Needs no room.
void cutRecords(const std::string& file, std::uint32_t records);

}  // namespace atrapos::exodus
