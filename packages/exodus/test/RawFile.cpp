#include "RawFile.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

namespace {

void require(int status) {
  if (status != NC_NOERR) throw std::runtime_error(nc_strerror(status));
}

/// Closes the file, or gives it up where it could not be written.
struct OpenFile {
  explicit OpenFile(int id_) : id(id_) {}
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;
  ~OpenFile() {
    if (open) nc_abort(id);
  }
  void close() {
    open = false;
    require(nc_close(id));
  }
  int id = 0;
  bool open = true;
};

std::size_t sizeOf(nc_type type) {
  static constexpr std::array<std::size_t, 12> sizes{0, 1, 1, 2, 4, 4, 8, 1, 2, 4, 8, 8};
  return sizes.at(static_cast<std::size_t>(type));
}

std::vector<RawFile::Attribute> attributesOf(int id, int variable, int count) {
  std::vector<RawFile::Attribute> all;
  for (int a = 0; a < count; ++a) {
    std::array<char, NC_MAX_NAME + 1> name{};
    std::size_t length = 0;
    RawFile::Attribute& attribute = all.emplace_back();
    require(nc_inq_attname(id, variable, a, name.data()));
    require(nc_inq_att(id, variable, name.data(), &attribute.type, &length));
    attribute.name = name.data();
    attribute.bytes.resize(length * sizeOf(attribute.type));
    require(nc_get_att(id, variable, name.data(), attribute.bytes.data()));
  }
  return all;
}

void put(int id, int variable, const std::vector<RawFile::Attribute>& attributes) {
  for (const RawFile::Attribute& a : attributes)
    require(
        nc_put_att(id, variable, a.name.c_str(), a.type, a.bytes.size() / sizeOf(a.type), a.bytes.data()));
}

}  // namespace

RawFile RawFile::read(const std::string& file) {
  RawFile raw;
  int dimensions = 0, variables = 0, attributes = 0, unlimited = -1, id = 0;
  require(nc_open(file.c_str(), NC_NOWRITE, &id));
  OpenFile open(id);
  require(nc_inq(id, &dimensions, &variables, &attributes, &unlimited));
  std::array<char, NC_MAX_NAME + 1> name{};
  for (int d = 0; d < dimensions; ++d) {
    std::size_t length = 0;
    require(nc_inq_dim(id, d, name.data(), &length));
    raw.dimensions.push_back({name.data(), length, d == unlimited});
  }
  raw.attributes = attributesOf(id, NC_GLOBAL, attributes);
  for (int v = 0; v < variables; ++v) {
    Variable& variable = raw.variables.emplace_back();
    int rank = 0, count = 0;
    std::array<int, NC_MAX_VAR_DIMS> of{};
    require(nc_inq_var(id, v, name.data(), &variable.type, &rank, of.data(), &count));
    variable.name = name.data();
    variable.dimensions.assign(of.begin(), of.begin() + rank);
    variable.attributes = attributesOf(id, v, count);
    variable.bytes.resize(raw.size(variable));
    if (!variable.bytes.empty()) require(nc_get_var(id, v, variable.bytes.data()));
  }
  open.close();
  return raw;
}

void RawFile::write(const std::string& file, int mode) const {
  int id = 0;
  require(nc_create(file.c_str(), NC_CLOBBER | mode, &id));
  OpenFile open(id);
  std::vector<int> dimensionIds(dimensions.size()), variableIds(variables.size());
  for (std::size_t d = 0; d < dimensions.size(); ++d)
    require(nc_def_dim(id, dimensions[d].name.c_str(),
                       dimensions[d].unlimited ? NC_UNLIMITED : dimensions[d].length, &dimensionIds[d]));
  put(id, NC_GLOBAL, attributes);
  for (std::size_t v = 0; v < variables.size(); ++v) {
    std::vector<int> of;
    for (const std::size_t d : variables[v].dimensions) of.push_back(dimensionIds[d]);
    require(nc_def_var(id, variables[v].name.c_str(), variables[v].type, static_cast<int>(of.size()),
                       of.data(), &variableIds[v]));
    if (mode == NC_NETCDF4 && !of.empty()) require(nc_def_var_deflate(id, variableIds[v], 0, 1, 9));
    put(id, variableIds[v], variables[v].attributes);
  }
  require(nc_enddef(id));
  for (std::size_t v = 0; v < variables.size(); ++v) {
    std::vector<char> bytes = variables[v].bytes;
    bytes.resize(size(variables[v]));
    if (bytes.empty()) continue;
    std::vector<std::size_t> start, count;  // an unlimited dimension has no length yet
    for (const std::size_t d : variables[v].dimensions) {
      start.push_back(0);
      count.push_back(dimensions[d].length);
    }
    require(nc_put_vara(id, variableIds[v], start.data(), count.data(), bytes.data()));
  }
  open.close();
}

RawFile::Variable& RawFile::variable(const std::string& name) {
  const auto at =
      std::find_if(variables.begin(), variables.end(), [&](const Variable& v) { return v.name == name; });
  if (at == variables.end()) throw std::runtime_error("no variable " + name);
  return *at;
}

std::size_t RawFile::size(const Variable& variable) const {
  std::size_t bytes = sizeOf(variable.type);
  for (const std::size_t d : variable.dimensions) bytes *= dimensions[d].length;
  return bytes;
}

void RawFile::stretch(Variable& variable, std::size_t place, std::size_t length) {
  variable.dimensions[place] = dimensions.size();
  dimensions.push_back({"zz" + std::to_string(dimensions.size()), length, false});
}
