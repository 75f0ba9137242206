#include "import/ReadStl.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "import/Import.hpp"

namespace atrapos::importer {
namespace {

constexpr std::size_t kMostBytes = std::size_t{1} << 30;
constexpr std::size_t kHeader = 84, kRecord = 50;  // of binary files: 80 bytes of text, the count; a facet

std::string bytesOf(const std::string& file) {
  std::error_code error;
  if (!std::filesystem::is_regular_file(file, error)) throw Error(file + ": cannot be read: no such file");
  if (std::filesystem::file_size(file, error) > kMostBytes || error)
    throw Error(file + ": is too large; expected at most 1 GiB");
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw Error(file + ": cannot be read");
  return text.str();
}

/// Files of both kinds may begin with "solid": what has the size that its count says is binary.
bool isBinary(const std::string& bytes) {
  if (bytes.size() < kHeader) return false;
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + kHeader - sizeof count, sizeof count);
  return bytes.size() == kHeader + kRecord * std::size_t{count};
}

std::vector<Facet> binaryFacets(const std::string& bytes) {
  std::vector<Facet> facets;
  for (std::size_t at = kHeader; at < bytes.size(); at += kRecord) {
    float numbers[12];  // a normal, three corners
    std::memcpy(numbers, bytes.data() + at, sizeof numbers);
    Facet& facet = facets.emplace_back();
    for (int corner = 0; corner < 3; ++corner)
      for (int i = 0; i < 3; ++i) facet[corner][i] = numbers[3 + 3 * corner + i];
  }
  return facets;
}

std::vector<Facet> asciiFacets(const std::string& bytes, const std::string& file) {
  std::vector<Facet> facets;
  std::istringstream lines(bytes);
  int number = 0, corner = 0;
  for (std::string line, word; std::getline(lines, line);) {
    ++number;
    std::istringstream words(line);
    if (!(words >> word)) continue;
    if (number == 1 && word != "solid")
      throw Error(file + ": is no STL file; expected 'solid' or a binary one");
    if (word == "facet" || word == "endfacet") {
      if (corner != 0)
        throw Error(fmt::format("{}:{}: a facet with {} corners; expected 3", file, number, corner));
      continue;
    }
    if (word != "vertex") continue;
    if (corner == 0) facets.emplace_back();
    auto& x = facets.back()[corner];
    if (!(words >> x[0] >> x[1] >> x[2]))
      throw Error(fmt::format("{}:{}: a corner without three numbers", file, number));
    corner = (corner + 1) % 3;
  }
  if (corner != 0) throw Error(file + ": ends within a facet");
  return facets;
}

}  // namespace

std::vector<Facet> readStl(const std::string& file) {
  const std::string bytes = bytesOf(file);
  const std::vector<Facet> facets = isBinary(bytes) ? binaryFacets(bytes) : asciiFacets(bytes, file);
  if (facets.empty()) throw Error(file + ": has no facet");
  for (const Facet& facet : facets)
    for (const auto& x : facet)
      for (const double number : x)
        if (!std::isfinite(number)) throw Error(file + ": a corner is not finite");
  return facets;
}

}  // namespace atrapos::importer
