#include "Files.hpp"

#include <fmt/format.h>

#include <cstdio>
#include <fstream>
#include <stdexcept>

namespace atrapos {

void replaceFile(const std::string& file, const std::string& content) {
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

}  // namespace atrapos
