#pragma once

#include <netcdf.h>

#include <string>
#include <vector>

/// A NetCDF file as it stands, to be changed at any place and written again.
struct RawFile {
  struct Dimension {
    std::string name;
    std::size_t length = 0;
    bool unlimited = false;
  };
  struct Attribute {
    std::string name;
    nc_type type = NC_CHAR;
    std::vector<char> bytes;
  };
  struct Variable {
    std::string name;
    nc_type type = NC_DOUBLE;
    std::vector<std::size_t> dimensions;  ///< of the file's
    std::vector<Attribute> attributes;
    std::vector<char> bytes;
  };

  std::vector<Dimension> dimensions;
  std::vector<Attribute> attributes;
  std::vector<Variable> variables;

  /// Throw std::runtime_error.
  static RawFile read(const std::string& file);
  /// `mode`: NC_64BIT_OFFSET, NC_NETCDF4, ...; the values of NetCDF-4 files are packed. Values that a
  /// variable has too few of are zeros.
  void write(const std::string& file, int mode = NC_64BIT_OFFSET) const;

  Variable& variable(const std::string& name);
  std::size_t size(const Variable& variable) const;  ///< bytes that its dimensions ask for
  /// Gives the variable's dimension `place` another length: a new dimension of it alone.
  void stretch(Variable& variable, std::size_t place, std::size_t length);
};
