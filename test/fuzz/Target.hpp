#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>

#include <unistd.h>

/// What fuzz targets share. A target is one LLVMFuzzerTestOneInput; what must not happen ends it by a signal,
/// which libFuzzer reports with the input.
namespace atrapos::fuzz {

inline std::string textOf(const std::uint8_t* data, std::size_t size) {
  return {reinterpret_cast<const char*>(data), size};
}

[[noreturn]] inline void fail(const std::string& what) {
  std::fprintf(stderr, "atrapos: %s\n", what.c_str());
  std::abort();
}

/// What a user is told: one line without control characters, which begins with the name of what was read.
inline void requireOneLine(const std::string& error, const std::string& name) {
  const auto moves = [](char c) { return (c >= 0 && c < ' ') || c == '\x7f'; };
  if (std::any_of(error.begin(), error.end(), moves) || error.rfind(name, 0) != 0)
    fail("no line of an error: " + error);
}

/// A folder of this process alone, in memory where the system has files there; it goes with the process.
class Folder {
 public:
  Folder() {
    const char* const memory = "/dev/shm";
    const auto above =
        access(memory, W_OK) == 0 ? std::filesystem::path(memory) : std::filesystem::temp_directory_path();
    std::string name = (above / "atrapos-fuzz-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no folder for a fuzz target");
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string path() const { return path_.string(); }
  /// Writes the file anew and returns its name.
  std::string write(const std::string& name, const std::string& content) const {
    const std::string file = *this / name;
    std::ofstream(file, std::ios::binary | std::ios::trunc) << content;
    return file;
  }

 private:
  std::filesystem::path path_;
};

inline const Folder& folder() {
  static const Folder own;
  return own;
}

}  // namespace atrapos::fuzz

// Of libFuzzer: a mutation of its own, of bytes.
extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);
