#include "output/Files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "machine/Ranks.hpp"

namespace atrapos {

void replaceFile(const std::string& file, const std::string& content) {
  if (!ranks::isFirst()) return;
  const std::string beside = file + ".new";
  {
    std::ofstream out(beside, std::ios::binary | std::ios::trunc);
    out << content;
    out.flush();
    if (!out) throw std::runtime_error(fmt::format("{}: cannot be written", beside));
  }
  if (std::rename(beside.c_str(), file.c_str()) != 0)
    throw std::runtime_error(fmt::format("{}: cannot be replaced", file));
}

void prepareFolder(const std::string& folder, const std::vector<std::string>& files) {
  if (!ranks::isFirst()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error)
    throw std::invalid_argument(fmt::format("the folder {} cannot be made: {}", folder, error.message()));
  // Trying is the only sure answer: permissions, read-only and special file systems all say no in their own
  // way.
  std::string probe = folder + "/.writable.XXXXXX";
  const int file = mkstemp(probe.data());
  if (file < 0)
    throw std::invalid_argument(
        fmt::format("the folder {} cannot be written to: {}", folder, std::strerror(errno)));
  close(file);
  unlink(probe.c_str());
  for (const std::string& name : files)
    if (std::filesystem::is_directory(folder + "/" + name))
      throw std::invalid_argument(fmt::format("{}/{} is a folder; expected a file or nothing", folder, name));
}

}  // namespace atrapos
