// Files that are whole for NetCDF and no Exodus files all the same: variables longer or shorter than their
// dimensions, of other types, attributes that are lists, numbers that are none, HDF5 that goes round in
// circles or stands for more than fits. Always one Error with the name of what is wrong.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <random>

#include "RawFile.hpp"
#include "RawMutator.hpp"
#include "SampleResults.hpp"
#include "atrapos/exodus/Decomposition.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"

using namespace atrapos;

namespace {

fem::Mesh readAll(const std::string& file) {
  fem::Mesh mesh = exodus::readMesh(file);
  readResults(file);
  return mesh;
}

/// What reading says; empty: nothing.
std::string errorOf(const std::string& file) {
  try {
    readAll(file);
    return {};
  } catch (const exodus::Error& e) {
    return e.what();
  }
}

std::string errorOf(const RawFile& raw, int mode = NC_64BIT_OFFSET) {
  const TempFile file;
  raw.write(file(), mode);
  const std::string error = errorOf(file());
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

void expectErrorAbout(const RawFile& raw, const std::string& word) {
  const std::string error = errorOf(raw);
  EXPECT_NE(error.find("'" + word + "'"), std::string::npos) << word << ": " << error;
}

/// Written but not read by this package.
bool isRead(const RawFile::Variable& v) { return v.name != "coor_names"; }

}  // namespace

TEST(ExodusHostile, whatIsLeftAloneReads) {
  const TempFile file;
  const RawFile raw = sampleResults();
  for (const int mode : {0, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4}) {
    SCOPED_TRACE(mode);
    raw.write(file(), mode);
    expectEqual(readAll(file()), sampleMesh(fem::Topology::Hex8));
  }
}

TEST(ExodusHostile, variablesThatAreNotAsLongAsTheirDimensions) {
  const RawFile raw = sampleResults();
  int tried = 0;
  for (const auto& variable : raw.variables)
    for (std::size_t d = 0; d < variable.dimensions.size(); ++d) {
      const auto& dimension = raw.dimensions[variable.dimensions[d]];
      if (!isRead(variable) || dimension.unlimited) continue;
      const bool letters = variable.type == NC_CHAR && d + 1 == variable.dimensions.size();
      for (const std::size_t length : {1000 * dimension.length, dimension.length + 1, dimension.length - 1}) {
        if (length == 0 || (letters && length != 1000 * dimension.length))
          continue;  // shorter names are names
        SCOPED_TRACE(variable.name + ": " + std::to_string(length) + " " + dimension.name);
        RawFile changed = raw;
        changed.stretch(changed.variable(variable.name), d, length);
        expectErrorAbout(changed, variable.name);
        ++tried;
      }
    }
  EXPECT_GT(tried, 150);
}

TEST(ExodusHostile, variablesOfOtherTypesAndRanks) {
  const RawFile raw = sampleResults();
  for (const auto& variable : raw.variables) {
    if (!isRead(variable)) continue;
    SCOPED_TRACE(variable.name);
    for (const nc_type type : {NC_CHAR, NC_INT, NC_DOUBLE}) {
      if (type == variable.type) continue;
      RawFile changed = raw;
      changed.variable(variable.name).type = type;
      expectErrorAbout(changed, variable.name);
    }
    RawFile more = raw;
    more.variable(variable.name).dimensions.push_back(more.dimensions.size());
    more.dimensions.push_back({"one", 1, false});
    expectErrorAbout(more, variable.name);
  }
}

// Names, ids and results may be missing; all else is asked for by a dimension.
TEST(ExodusHostile, withoutAVariable) {
  const RawFile raw = sampleResults();
  const auto mesh = sampleMesh(fem::Topology::Hex8);
  for (std::size_t v = 0; v < raw.variables.size(); ++v) {
    const std::string name = raw.variables[v].name;
    SCOPED_TRACE(name);
    RawFile changed = raw;
    changed.variables.erase(changed.variables.begin() + static_cast<long>(v));
    const std::string error = errorOf(changed);
    const auto begins = [&](const char* text) { return name.rfind(text, 0) == 0; };
    const bool needed = begins("coord") || begins("connect") || begins("attrib1") || begins("attrib2") ||
                        begins("node_ns") || begins("elem_ss") || begins("side_ss") || begins("eb_prop1") ||
                        begins("name_") || begins("time_whole") || begins("info") || begins("qa");
    if (needed) {
      EXPECT_NE(error.find("'" + name + "'"), std::string::npos) << error;
    }
  }
}

TEST(ExodusHostile, attributesThatAreLists) {
  const RawFile raw = sampleResults();
  int tried = 0;
  const auto longer = [](std::vector<char>& bytes) {
    const std::vector<char> once = bytes;
    for (int i = 0; i < 1500; ++i) bytes.insert(bytes.end(), once.begin(), once.end());
  };
  for (std::size_t a = 0; a < raw.attributes.size(); ++a) {
    SCOPED_TRACE(raw.attributes[a].name);
    RawFile changed = raw;
    longer(changed.attributes[a].bytes);
    expectErrorAbout(changed, raw.attributes[a].name);
    ++tried;
  }
  for (const auto& variable : raw.variables)
    for (std::size_t a = 0; a < variable.attributes.size(); ++a) {
      SCOPED_TRACE(variable.name);
      RawFile changed = raw;
      longer(changed.variable(variable.name).attributes[a].bytes);
      expectErrorAbout(changed, variable.attributes[a].name);
      ++tried;
    }
  EXPECT_EQ(tried, 7 + 5);  // of the file; names of three kinds of ids, types of two blocks
}

// A name of 300 characters, which NetCDF's own calls do not write: a header by hand.
TEST(ExodusHostile, namesLongerThanNetcdfsRows) {
  const TempFile file;
  const auto number = [](unsigned n) {
    return std::string{static_cast<char>(n >> 24), static_cast<char>(n >> 16), static_cast<char>(n >> 8),
                       static_cast<char>(n)};
  };
  for (const unsigned length : {256u, 300u, 4000u}) {
    std::ofstream(file(), std::ios::binary | std::ios::trunc)
        << "CDF\x01" << number(0) << number(10) << number(1) << number(length) << std::string(length, 'n')
        << number(3) << std::string(16, '\0');
    EXPECT_NE(errorOf(file()).find(length > 256 ? "damaged" : file()), std::string::npos) << errorOf(file());
  }
}

// Mutants of all bytes, each a file that NetCDF opens: a mesh or an Error.
TEST(ExodusHostile, valuesAtRandom) {
  const RawFile raw = sampleResults();
  std::mt19937 random(3);
  int errors = 0;
  for (int trial = 0; trial < 400; ++trial) {
    SCOPED_TRACE(trial);
    RawFile changed = raw;
    auto& variable = changed.variables[random() % changed.variables.size()];
    for (int i = 0; i < 3 && !variable.bytes.empty(); ++i)
      variable.bytes[random() % variable.bytes.size()] = static_cast<char>(random());
    errors += errorOf(changed).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 50);
}

// ATRAPOS_MUTANTS asks for more of them (scripts/fuzz).
TEST(ExodusHostile, mutants) {
  const char* const asked = std::getenv("ATRAPOS_MUTANTS");
  const int mutants = asked != nullptr ? std::atoi(asked) : 300;
  const TempFile file;
  const RawFile raw = sampleResults();
  RawMutator mutate(9);
  int read = 0, refused = 0;
  double slowest = 0;
  for (int m = 0; m < mutants; ++m) {
    try {
      mutate(raw).write(file(), mutate.below(40) == 0 ? NC_NETCDF4 : NC_64BIT_OFFSET);
    } catch (const std::runtime_error&) {
      continue;  // no NetCDF file
    }
    const auto start = std::chrono::steady_clock::now();
    const std::string error = errorOf(file());
    ASSERT_EQ(error.find('\n'), std::string::npos) << error;
    ++(error.empty() ? read : refused);
    slowest =
        std::max(slowest, std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  EXPECT_LT(slowest, 10);
  EXPECT_GT(read, mutants / 50);
  EXPECT_GT(refused, mutants / 4);
  std::cout << mutants << " mutants: " << read << " read, " << refused << " refused, the slowest in "
            << slowest << " s\n";
}

TEST(ExodusHostile, partsAtRandom) {
  const TempFile file;
  const auto mesh = sampleMesh(fem::Topology::Hex8);
  const exodus::Decomposition cut(mesh, {0, 0, 0, 1, 1, 1}, 2);
  exodus::writePart(cut.part(0), file("mesh.exo"));
  const std::string name = exodus::partName(file("mesh.exo"), 2, 0);
  const RawFile raw = RawFile::read(name);
  std::mt19937 random(4);
  for (std::size_t v = 0; v < raw.variables.size(); ++v)
    for (int trial = 0; trial < 12; ++trial) {
      RawFile changed = raw;
      auto& variable = changed.variables[v];
      if (trial % 3 == 0 && !variable.dimensions.empty())
        changed.stretch(variable, random() % variable.dimensions.size(), 1 + random() % 5000);
      else if (!variable.bytes.empty())
        variable.bytes[random() % variable.bytes.size()] = static_cast<char>(random());
      changed.write(name);
      try {
        exodus::readPart(name);
      } catch (const exodus::Error&) {
      }
    }
}

TEST(ExodusHostile, namesThatMoveCursors) {
  RawFile raw = sampleResults();
  for (RawFile::Attribute& attribute : raw.variable("connect1").attributes)
    if (attribute.name == "elem_type") {
      const std::string name = "H\x1b[2J\rX\xc2\x9b" + std::string(1, '\0');
      attribute.bytes.assign(name.begin(), name.end());
    }
  const std::string error = errorOf(raw);
  EXPECT_NE(error.find("element type 'H [2J X  '"), std::string::npos) << error;
}

TEST(ExodusHostile, numbersThatAreNone) {
  const TempFile file;
  const RawFile raw = sampleResults();
  for (const char* const name : {"coordx", "dist_fact_ns2", "attrib2"})
    for (const double value :
         {std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
      SCOPED_TRACE(name);
      RawFile changed = raw;
      const char* const bytes = reinterpret_cast<const char*>(&value);
      std::copy(bytes, bytes + sizeof value, changed.variable(name).bytes.begin() + 8);
      EXPECT_NE(errorOf(changed).find("not a finite number"), std::string::npos) << errorOf(changed);
    }
}

TEST(ExodusHostile, whatWouldCountTwice) {
  const TempFile file;
  RawFile raw = sampleResults();
  RawFile twins =
      raw;  // the last element of block 1 and the first one of block 2, with its nodes turned round
  const auto& first = raw.variable("connect1").bytes;
  std::rotate_copy(first.end() - 32, first.end() - 16, first.end(), twins.variable("connect2").bytes.begin());
  EXPECT_NE(errorOf(twins).find("elements 514 and 521 have the same nodes"), std::string::npos)
      << errorOf(twins);
  RawFile sides = raw;
  for (const char* const name : {"elem_ss1", "side_ss1"}) {
    auto& bytes = sides.variable(name).bytes;
    ASSERT_GE(bytes.size(), 8u);
    std::copy(bytes.begin(), bytes.begin() + 4, bytes.begin() + 4);
  }
  EXPECT_NE(errorOf(sides).find("has a side twice"), std::string::npos) << errorOf(sides);
}

TEST(ExodusHostile, smallFilesThatStandForMuch) {
  const TempFile file;
  int id = 0, dimension = 0, variable = 0;
  ASSERT_EQ(nc_create(file().c_str(), NC_CLOBBER | NC_NETCDF4, &id), NC_NOERR);
  ASSERT_EQ(nc_def_dim(id, "num_nodes", 120000000, &dimension), NC_NOERR);
  for (const char* const name : {"coordx", "coordy", "coordz"}) {
    ASSERT_EQ(nc_def_var(id, name, NC_DOUBLE, 1, &dimension, &variable), NC_NOERR);
    ASSERT_EQ(nc_def_var_deflate(id, variable, 0, 1, 1), NC_NOERR);
  }
  ASSERT_EQ(nc_close(id), NC_NOERR);
  EXPECT_LT(std::filesystem::file_size(file()), 100000u);
  EXPECT_NE(errorOf(file()).find("'coordx' the values take more than"), std::string::npos) << errorOf(file());
}

// Classic: a dimension that nothing is of must not be what memory is taken for.
TEST(ExodusHostile, dimensionsOfNothing) {
  for (const char* const name :
       {"num_nodes", "num_elem", "num_el_blk", "num_node_sets", "num_info", "num_nod_var"}) {
    SCOPED_TRACE(name);
    RawFile raw;
    raw.dimensions = {{"num_dim", 3, false}, {name, 2000000000, false}};
    const float version = 5.1F;
    const int one = 1, eight = 8;
    const auto bytes = [](const auto& v) {
      return std::vector<char>(reinterpret_cast<const char*>(&v),
                               reinterpret_cast<const char*>(&v) + sizeof v);
    };
    raw.attributes = {{"api_version", NC_FLOAT, bytes(version)},
                      {"version", NC_FLOAT, bytes(version)},
                      {"floating_point_word_size", NC_INT, bytes(eight)},
                      {"file_size", NC_INT, bytes(one)}};
    EXPECT_NE(errorOf(raw), "");
  }
}

// The library's number of times is -1 then, which was taken for a length (found by the fuzz target `mesh`).
TEST(ExodusHostile, withoutADimensionOfTimes) {
  RawFile raw = sampleResults();
  const auto varies = [&](const RawFile::Variable& v) {
    return std::any_of(v.dimensions.begin(), v.dimensions.end(),
                       [&](std::size_t d) { return raw.dimensions[d].unlimited; });
  };
  raw.variables.erase(std::remove_if(raw.variables.begin(), raw.variables.end(), varies),
                      raw.variables.end());
  for (auto& dimension : raw.dimensions)
    if (dimension.unlimited) dimension.name = "time_other";
  const TempFile file;
  raw.write(file());
  const exodus::ResultReader reader(file());
  EXPECT_EQ(reader.numSteps(), 0);
  EXPECT_TRUE(reader.times().empty());
}

// As other programs leave it where only some blocks have a variable.
TEST(ExodusHostile, elementVariablesThatABlockHasNot) {
  RawFile raw = sampleResults();
  auto& table = raw.variable("elem_var_tab");
  std::fill(table.bytes.begin(), table.bytes.end(), '\0');
  EXPECT_NE(errorOf(raw).find("has no element variable '"), std::string::npos);
}

TEST(ExodusHostile, hdf5InCircles) {
  const auto start = std::chrono::steady_clock::now();
  const std::string error = errorOf(std::string(ATRAPOS_TEST_DATA) + "/hdf5_loop.exo");
  EXPECT_NE(error.find("does not come to an end"), std::string::npos) << error;
  // Two seconds of processor time, read once: the second reading is not tried.
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(30));
}

TEST(ExodusHostile, hdf5AtRandom) {
  const TempFile file;
  sampleResults().write(file(), NC_NETCDF4);
  std::ifstream in(file(), std::ios::binary);
  const std::string content{std::istreambuf_iterator<char>(in), {}};
  std::mt19937 random(5);
  int errors = 0;
  for (int trial = 0; trial < 60; ++trial) {
    std::string changed = content;
    for (int i = 0; i < 40; ++i) changed[random() % changed.size()] = static_cast<char>(random());
    std::ofstream(file(), std::ios::binary | std::ios::trunc) << changed;
    errors += errorOf(file()).empty() ? 0 : 1;
  }
  EXPECT_GT(errors, 30);
}
