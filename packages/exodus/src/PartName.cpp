#include <algorithm>
#include <filesystem>

#include "atrapos/exodus/Error.hpp"
#include "atrapos/exodus/MeshPart.hpp"

namespace atrapos::exodus {
namespace {

/// A whole number without a sign, at most nine digits; -1: it is none.
int number(const std::string& text) {
  const bool digits = !text.empty() && text.size() <= 9 &&
                      std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  return digits ? std::stoi(text) : -1;
}

}  // namespace

std::string partName(const std::string& file, int parts, int part) {
  const std::string count = std::to_string(parts), number = std::to_string(part);
  const std::size_t zeros = count.size() - std::min(count.size(), number.size());
  return file + '.' + count + '.' + std::string(zeros, '0') + number;
}

PartName parsePartName(const std::string& name) {
  const std::size_t last = name.rfind('.');
  const std::size_t before = last == std::string::npos || last == 0 ? last : name.rfind('.', last - 1);
  PartName result;
  if (before != std::string::npos && before > 0 && before < last) {
    result.file = name.substr(0, before);
    result.parts = number(name.substr(before + 1, last - before - 1));
    result.part = number(name.substr(last + 1));
  }
  if (result.file.empty() || result.parts < 1 || result.part < 0 || result.part >= result.parts ||
      partName(result.file, result.parts, result.part) != name)
    throw Error(name + ": is not the name of a part file; expected <file>.<parts>.<part>, as mesh.exo.4.0");
  return result;
}

std::vector<int> findParts(const std::string& file) {
  const std::filesystem::path path(file);
  const auto folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
  const std::string own = path.filename().string();
  std::vector<int> found;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(folder, error)) {
    const std::string name = entry.path().filename().string();
    if (name.size() <= own.size() || name.compare(0, own.size(), own) != 0) continue;
    try {
      const PartName parsed = parsePartName(name);
      if (parsed.file == own) found.push_back(parsed.parts);
    } catch (const Error&) {
      continue;  // another file
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

}  // namespace atrapos::exodus
