#include "FileLayout.hpp"

#include <netcdf.h>

#include <array>
#include <cctype>
#include <cstring>
#include <limits>
#include <optional>
#include <vector>

#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {

namespace {

enum class Kind {
  integer,
  real,
  name,    ///< texts of at most 256 characters and a zero, a further dimension
  record,  ///< the same of 32
  line     ///< of 80
};

/// A variable of Exodus II. '#' stands for a number, in the names of dimensions for the last one of the
/// variable's.
struct Shape {
  const char* variable;
  Kind kind;
  std::vector<const char*> dimensions;
  /// Must be there where its dimensions are and none is 0; for names with a number those up to this
  /// dimension, "" for the others; null: need not be there.
  const char* needed = nullptr;
};

/// Those that the library reads for this package.
const std::vector<Shape>& shapes() {
  static const std::vector<Shape> all{
      {"eb_prop1", Kind::integer, {"num_el_blk"}, ""},
      {"ns_prop1", Kind::integer, {"num_node_sets"}, ""},
      {"ss_prop1", Kind::integer, {"num_side_sets"}, ""},
      {"eb_prop#", Kind::integer, {"num_el_blk"}},
      {"ns_prop#", Kind::integer, {"num_node_sets"}},
      {"ss_prop#", Kind::integer, {"num_side_sets"}},
      {"eb_status", Kind::integer, {"num_el_blk"}},
      {"ns_status", Kind::integer, {"num_node_sets"}},
      {"ss_status", Kind::integer, {"num_side_sets"}},
      {"eb_names", Kind::name, {"num_el_blk"}},
      {"ns_names", Kind::name, {"num_node_sets"}},
      {"ss_names", Kind::name, {"num_side_sets"}},
      {"coord", Kind::real, {"num_dim", "num_nodes"}},
      {"coordx", Kind::real, {"num_nodes"}},
      {"coordy", Kind::real, {"num_nodes"}},
      {"coordz", Kind::real, {"num_nodes"}},
      {"connect#", Kind::integer, {"num_el_in_blk#", "num_nod_per_el#"}, "num_el_blk"},
      {"attrib#", Kind::real, {"num_el_in_blk#", "num_att_in_blk#"}, "num_el_blk"},
      {"attrib_name#", Kind::name, {"num_att_in_blk#"}},
      {"node_ns#", Kind::integer, {"num_nod_ns#"}, "num_node_sets"},
      {"dist_fact_ns#", Kind::real, {"num_nod_ns#"}},
      {"elem_ss#", Kind::integer, {"num_side_ss#"}, "num_side_sets"},
      {"side_ss#", Kind::integer, {"num_side_ss#"}, "num_side_sets"},
      {"node_num_map", Kind::integer, {"num_nodes"}},
      {"elem_num_map", Kind::integer, {"num_elem"}},
      {"elem_map", Kind::integer, {"num_elem"}},
      {"qa_records", Kind::record, {"num_qa_rec", "four"}, ""},
      {"info_records", Kind::line, {"num_info"}, ""},
      {"time_whole", Kind::real, {"time_step"}, ""},
      {"name_glo_var", Kind::name, {"num_glo_var"}, ""},
      {"name_nod_var", Kind::name, {"num_nod_var"}, ""},
      {"name_elem_var", Kind::name, {"num_elem_var"}, ""},
      {"elem_var_tab", Kind::integer, {"num_el_blk", "num_elem_var"}},
      {"vals_glo_var", Kind::real, {"time_step", "num_glo_var"}},
      {"vals_nod_var", Kind::real, {"time_step", "num_nod_var", "num_nodes"}},
      {"vals_nod_var#", Kind::real, {"time_step", "num_nodes"}},
      {"vals_elem_var#eb#", Kind::real, {"time_step", "num_el_in_blk#"}},
      // parts (Nemesis)
      {"nem_ftype", Kind::integer, {}},
      {"el_blk_ids_global", Kind::integer, {"num_el_blk_global"}},
      {"el_blk_cnt_global", Kind::integer, {"num_el_blk_global"}},
      {"ns_ids_global", Kind::integer, {"num_ns_global"}},
      {"ns_node_cnt_global", Kind::integer, {"num_ns_global"}},
      {"ns_df_cnt_global", Kind::integer, {"num_ns_global"}},
      {"ss_ids_global", Kind::integer, {"num_ss_global"}},
      {"ss_side_cnt_global", Kind::integer, {"num_ss_global"}},
      {"ss_df_cnt_global", Kind::integer, {"num_ss_global"}},
      {"int_n_stat", Kind::integer, {"num_procs_file"}},
      {"bor_n_stat", Kind::integer, {"num_procs_file"}},
      {"ext_n_stat", Kind::integer, {"num_procs_file"}},
      {"int_e_stat", Kind::integer, {"num_procs_file"}},
      {"bor_e_stat", Kind::integer, {"num_procs_file"}},
      {"n_comm_ids", Kind::integer, {"num_n_cmaps"}, ""},
      {"n_comm_stat", Kind::integer, {"num_n_cmaps"}},
      {"n_comm_data_idx", Kind::integer, {"num_n_cmaps"}},
      {"n_comm_nids", Kind::integer, {"ncnt_cmap"}, ""},
      {"n_comm_proc", Kind::integer, {"ncnt_cmap"}, ""},
      {"e_comm_ids", Kind::integer, {"num_e_cmaps"}, ""},
      {"e_comm_stat", Kind::integer, {"num_e_cmaps"}},
      {"e_comm_data_idx", Kind::integer, {"num_e_cmaps"}}};
  return all;
}

/// Texts of at most this many characters, or one number.
struct AttributeShape {
  const char* name;
  std::size_t mostCharacters;
};
constexpr std::array<AttributeShape, 8> fileAttributes{{{"api_version", 0},
                                                        {"api version", 0},
                                                        {"version", 0},
                                                        {"file_size", 0},
                                                        {"floating_point_word_size", 0},
                                                        {"floating point word size", 0},
                                                        {"maximum_name_length", 0},
                                                        {"int64_status", 0}}};
constexpr std::array<AttributeShape, 2> variableAttributes{{{"elem_type", 32}, {"name", NC_MAX_NAME}}};

/// The last number in a name that is made like the pattern, "" where the pattern has none; empty: it is not.
std::optional<std::string> numberIn(const char* pattern, const char* name) {
  std::string number;
  for (; *pattern != '\0'; ++pattern) {
    if (*pattern != '#') {
      if (*name++ != *pattern) return {};
      continue;
    }
    number.clear();
    while (std::isdigit(static_cast<unsigned char>(*name)) != 0) number += *name++;
    if (number.empty()) return {};
  }
  return *name == '\0' ? std::optional(number) : std::nullopt;
}

std::string withNumber(const char* pattern, const std::string& number) {
  std::string name = pattern;
  if (const auto at = name.find('#'); at != std::string::npos) name.replace(at, 1, number);
  return name;
}

class Layout {
 public:
  Layout(const std::string& file, std::uint64_t mostBytes) : file_(file), mostBytes_(mostBytes) {
    if (nc_open(file.c_str(), NC_NOWRITE, &id_) != NC_NOERR) {
      id_ = -1;
      fail("not an Exodus file, or a damaged one");
    }
  }
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;
  ~Layout() {
    if (id_ >= 0) nc_close(id_);
  }

  std::uint64_t check() {
    checkFileAttributes();
    int variables = 0;
    require(nc_inq_nvars(id_, &variables), "its variables");
    for (int v = 0; v < variables; ++v) checkVariable(v);
    checkNeeded();
    return total_;
  }

  void read() const {
    std::vector<char> values;
    for (const Known& k : known_) {
      values.resize(static_cast<std::size_t>(k.bytes));
      if (k.bytes > 0 && nc_get_var(id_, k.variable, values.data()) != NC_NOERR)
        fail("the values of " + k.name + " are damaged");
    }
  }

 private:
  struct Known {
    int variable;
    std::string name;
    std::uint64_t bytes;
  };

  [[noreturn]] void fail(const std::string& what) const { throw Error(file_ + ": " + what); }

  void require(int status, const std::string& what) const {
    if (status != NC_NOERR) fail(what + " cannot be read (" + nc_strerror(status) + ")");
  }

  std::optional<std::uint64_t> length(const std::string& dimension) const {
    int id = 0;
    std::size_t length = 0;
    if (nc_inq_dimid(id_, dimension.c_str(), &id) != NC_NOERR || nc_inq_dimlen(id_, id, &length) != NC_NOERR)
      return {};
    return length;
  }

  bool has(const std::string& variable) const {
    int id = 0;
    return nc_inq_varid(id_, variable.c_str(), &id) == NC_NOERR;
  }

  void checkAttribute(int variable, const AttributeShape& shape, const std::string& owner) const {
    nc_type type = 0;
    std::size_t count = 0;
    if (nc_inq_att(id_, variable, shape.name, &type, &count) != NC_NOERR) return;
    const std::string what = "attribute '" + std::string(shape.name) + "' " + owner;
    if (shape.mostCharacters == 0) {
      if (type < NC_BYTE || type > NC_UINT64 || type == NC_CHAR) fail(what + " is not a number");
      if (count != 1) fail(what + " has " + std::to_string(count) + " numbers, expected one");
      return;
    }
    if (type != NC_CHAR) fail(what + " is not a text");
    if (count <= shape.mostCharacters) return;
    std::vector<char> text(count);
    require(nc_get_att_text(id_, variable, shape.name, text.data()), what);
    if (count > shape.mostCharacters + 1 || text.back() != '\0')  // some writers count the zero
      fail(what + " has " + std::to_string(count) + " characters, expected at most " +
           std::to_string(shape.mostCharacters));
  }

  void checkFileAttributes() const {
    for (const AttributeShape& shape : fileAttributes) checkAttribute(NC_GLOBAL, shape, "of the file");
    checkAttribute(NC_GLOBAL, {"title", 80}, "of the file");
    // By it the library makes rows for names.
    double longest = 0;
    if (nc_get_att_double(id_, NC_GLOBAL, "maximum_name_length", &longest) == NC_NOERR &&
        !(longest >= 0 && longest <= NC_MAX_NAME))
      fail("attribute 'maximum_name_length' of the file is not within 0 and " + std::to_string(NC_MAX_NAME));
  }

  void checkVariable(int variable) {
    std::array<char, NC_MAX_NAME + 1> name{};
    require(nc_inq_varname(id_, variable, name.data()), "the name of a variable");
    for (const Shape& shape : shapes())
      if (const auto number = numberIn(shape.variable, name.data())) {
        checkShape(variable, name.data(), shape, *number);
        break;
      }
  }

  static std::string inWords(Kind kind) {
    return kind == Kind::integer ? "whole numbers" : kind == Kind::real ? "real numbers" : "texts";
  }

  static bool isOf(Kind kind, nc_type type) {
    if (kind == Kind::real) return type == NC_FLOAT || type == NC_DOUBLE;
    if (kind != Kind::integer) return type == NC_CHAR;
    return type != NC_CHAR && type != NC_FLOAT && type != NC_DOUBLE && type >= NC_BYTE && type <= NC_UINT64;
  }

  static std::size_t mostCharacters(Kind kind) {
    return kind == Kind::name ? NC_MAX_NAME + 1 : kind == Kind::record ? 33 : 81;
  }

  static std::string product(const std::vector<std::uint64_t>& lengths) {
    std::string text;
    for (const std::uint64_t n : lengths) text += (text.empty() ? "" : " x ") + std::to_string(n);
    return text.empty() ? "one value" : text;
  }

  void checkShape(int variable, const std::string& name, const Shape& shape, const std::string& number) {
    const std::string what = "variable '" + name + "'";
    nc_type type = 0;
    int rank = 0;
    require(nc_inq_vartype(id_, variable, &type), what);
    require(nc_inq_varndims(id_, variable, &rank), what);
    if (!isOf(shape.kind, type)) fail(what + " has not the type it must have, " + inWords(shape.kind));
    const bool text = shape.kind != Kind::integer && shape.kind != Kind::real;
    std::vector<std::uint64_t> expected, found;
    for (const char* const pattern : shape.dimensions) {
      const std::string dimension = withNumber(pattern, number);
      const auto n = length(dimension);
      if (!n) fail(what + " is there without dimension '" + dimension + "'");
      expected.push_back(*n);
    }
    if (rank != static_cast<int>(expected.size()) + (text ? 1 : 0))
      fail(what + " has " + std::to_string(rank) + " dimensions, expected " +
           std::to_string(expected.size() + (text ? 1 : 0)));
    std::vector<int> dimensions(static_cast<std::size_t>(rank));
    require(nc_inq_vardimid(id_, variable, dimensions.data()), what);
    for (const int d : dimensions) {
      std::size_t n = 0;
      require(nc_inq_dimlen(id_, d, &n), what);
      found.push_back(n);
    }
    if (text) {
      const std::size_t most = mostCharacters(shape.kind);
      if (found.back() < 1 || found.back() > most)
        fail(what + " has texts of " + std::to_string(found.back()) + " characters, expected 1 to " +
             std::to_string(most));
      expected.push_back(found.back());
    }
    if (found != expected)
      fail(what + " is " + product(found) + ", by its dimensions it must be " + product(expected));
    for (const AttributeShape& attribute : variableAttributes)
      checkAttribute(variable, attribute, "of " + what);
    count(variable, what, type, found);
  }

  void count(int variable, const std::string& what, nc_type type, const std::vector<std::uint64_t>& lengths) {
    std::size_t size = 0;
    require(nc_inq_type(id_, type, nullptr, &size), what);
    std::uint64_t bytes = size;
    for (const std::uint64_t n : lengths)
      bytes = n != 0 && bytes > std::numeric_limits<std::uint64_t>::max() / n ? mostBytes_ + 1 : bytes * n;
    if (bytes > mostBytes_ || total_ > mostBytes_ - bytes)
      fail("up to " + what + " the values take more than " + std::to_string(mostBytes_) +
           " bytes, the most that is read of a file of this length");
    total_ += bytes;
    known_.push_back({variable, what, bytes});
  }

  void checkNeeded() const {
    if (length("num_nodes").value_or(0) > 0 && !has("coord"))
      for (const char* const name : {"coordx", "coordy", "coordz"})
        if (!has(name) && (name[5] != 'z' || length("num_dim") == 3u))
          fail("has nodes, but no variable '" + std::string(name) + "'");
    for (const Shape& shape : shapes()) {
      if (shape.needed == nullptr) continue;
      const bool numbered = *shape.needed != '\0';
      const std::uint64_t numbers = numbered ? length(shape.needed).value_or(0) : 1;
      for (std::uint64_t i = 1; i <= numbers; ++i) checkThere(shape, numbered ? std::to_string(i) : "");
    }
  }

  void checkThere(const Shape& shape, const std::string& number) const {
    for (const char* const pattern : shape.dimensions)
      if (length(withNumber(pattern, number)).value_or(0) == 0) return;
    const std::string name = withNumber(shape.variable, number);
    if (!has(name))
      fail("has dimension '" + withNumber(shape.dimensions[0], number) + "', but no variable '" + name + "'");
  }

  const std::string& file_;
  std::uint64_t mostBytes_, total_ = 0;
  int id_ = -1;
  std::vector<Known> known_;
};

}  // namespace

std::uint64_t checkLayout(const std::string& file, std::uint64_t mostBytes) {
  Layout layout(file, mostBytes);
  return layout.check();
}

void readThrough(const std::string& file, std::uint64_t mostBytes) {
  Layout layout(file, mostBytes);
  layout.check();
  layout.read();
}

}  // namespace atrapos::exodus
