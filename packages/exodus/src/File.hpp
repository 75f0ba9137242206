#pragma once

#include <exodusII.h>

#include <string>
#include <vector>

#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {

/// An open Exodus file; all integers pass the library as 64-bit ones, all reals as doubles, and the library
/// prints nothing.
class File {
 public:
  /// Opens for reading, after checkFile.
  static File open(const std::string& name);

  /// Makes a new NetCDF 64-bit-offset file, over one with that name; messages speak of it as `shown`.
  ///
  /// It is opened unshared, and must not be opened again for writing steps, where the library shares by
  /// default: a shared file counts a step in its header as soon as the first value of the step is there, an
  /// unshared one at ex_update and after all values, so that a kill in between leaves the earlier steps
  /// valid.
  static File create(const std::string& name, const std::string& shown);

  File(File&& other) noexcept;
  File& operator=(File&& other) noexcept;
  ~File();

  int id() const { return id_; }
  const std::string& name() const { return name_; }

  /// Tells under which name messages shall speak of the file.
  void rename(const std::string& name) { name_ = name; }

  /// Throws Error where a library call failed, saying what was being done ("reading the coordinates").
  void check(int status, const std::string& doing) const;

  /// Flushes and closes; unlike the destructor it reports failure.
  void close();

 private:
  File(int id, std::string name) : id_(id), name_(std::move(name)) {}

  int id_ = -1;
  std::string name_;
};

/// Rows of characters as the library's char** arguments want them.
class Strings {
 public:
  Strings(std::size_t count, std::size_t length);  ///< empty, to be filled by the library
  explicit Strings(const std::vector<std::string>& strings);
  Strings(const Strings&) = delete;
  Strings& operator=(const Strings&) = delete;

  char** data() { return pointers_.data(); }
  std::vector<std::string> get() const;

 private:
  std::vector<std::vector<char>> rows_;
  std::vector<char*> pointers_;
};

}  // namespace atrapos::exodus
