#include "output/Files.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"

namespace atrapos {
namespace {

constexpr const char* kReportBegins = "<!doctype html>\n<!-- atrapos report";
constexpr const char* kScriptBegins = "set terminal pngcairo";

/// Results beside fields, and how they begin.
struct KnownFile {
  const char *name, *begin;
};
constexpr std::array<KnownFile, 12> knownFiles{{{"path.csv", "step,path_length,load_factor"},
                                                {"points.csv", "step,branch,path_length,load_factor,kind"},
                                                {"steps.csv", "step,branch,order,radius"},
                                                {"events.csv", "step,branch,path_length,load_factor,contact"},
                                                {"branches.csv", "branch,parent,depth,point"},
                                                {"sharpen.csv", "factor,"},
                                                {"restart.bin", "atrapos restart"},
                                                {"summary.json", "{\n  \"program\": \"atrapos "},
                                                {"path.png", "\x89PNG"},
                                                {"path.svg", "<?xml version"},
                                                {"report.html", kReportBegins},
                                                {"path.gp", kScriptBegins}}};
constexpr const char* kMapBegins = "problem,order,delta,pade,";
constexpr const char* kChartBegins = "curve,run,settings,";

bool begins(const std::string& file, const std::string& text) {
  std::ifstream in(file, std::ios::binary);
  std::string start(text.size(), '\0');
  in.read(start.data(), static_cast<std::streamsize>(start.size()));
  return in && start == text;
}

bool isOwnExodus(const std::string& file) {
  try {
    const auto records = exodus::ResultReader(file).qa();
    return std::any_of(records.begin(), records.end(),
                       [](const exodus::QaRecord& r) { return r.code == "Atrapos"; });
  } catch (const exodus::Error&) {
    return false;
  }
}

bool looksOwn(const std::string& file, Made as) {
  if (as == Made::map) return begins(file, kMapBegins);
  if (as == Made::chart) return begins(file, kChartBegins);
  if (as == Made::report) return begins(file, kReportBegins);
  if (as == Made::mesh) return isOwnExodus(file);
  const std::string name = std::filesystem::path(file).filename().string();
  for (const KnownFile& known : knownFiles)
    if (name == known.name) return begins(file, known.begin);
  return isOwnExodus(file);
}

}  // namespace

void replaceFile(const std::string& file, const std::string& content) {
  if (!ranks::isFirst()) return;
  const std::string beside = file + ".new";
  try {
    OutputFile out(beside, false);
    out.write(content);
    out.sync();
  } catch (...) {
    unlink(beside.c_str());
    throw;
  }
  renameFile(beside, file);
}

namespace {

/// The branch of STEM.exo or STEM_branchN.exo.
std::optional<int> branchOf(const std::string& name, const std::string& stem) {
  const std::string before = stem + "_branch", after = ".exo";
  if (name == stem + after) return 0;
  if (name.size() <= before.size() + after.size() || name.compare(0, before.size(), before) != 0) return {};
  const char *first = name.data() + before.size(), *end = name.data() + name.size() - after.size();
  int branch = 0;
  const auto read = std::from_chars(first, end, branch);
  if (read.ec != std::errc() || read.ptr != end || end != after || branch < 1 || *first == '0') return {};
  return branch;
}

}  // namespace

std::optional<int> branchOfFields(const std::string& name) { return branchOf(name, "results"); }

std::string toolsName(int branch) {
  return branch == 0 ? "tools.exo" : fmt::format("tools_branch{}.exo", branch);
}

bool isToolsName(const std::string& name) { return branchOf(name, "tools").has_value(); }

bool isResultName(const std::string& name) {
  if (std::any_of(knownFiles.begin(), knownFiles.end(),
                  [&](const KnownFile& known) { return name == known.name; }))
    return true;
  if (isToolsName(name)) return true;
  std::string whole = name;
  try {
    whole = exodus::parsePartName(name).file;
  } catch (const exodus::Error&) {  // no part
  }
  return branchOfFields(whole).has_value();
}

void requireOwn(const std::string& file, Made as, const std::vector<std::string>& inputs) {
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) return;
  if (std::filesystem::is_directory(status))
    throw std::invalid_argument(fmt::format("{} is a folder; expected a file or nothing", file));
  if (!std::filesystem::is_regular_file(status))
    throw std::invalid_argument(fmt::format("{} is no regular file, and is not written to", file));
  for (const std::string& input : inputs)
    if (std::filesystem::equivalent(file, input, error))
      throw std::invalid_argument(
          fmt::format("{} is read too, and would be replaced; expected another file or folder", file));
  if (std::filesystem::file_size(file, error) > 0 && !looksOwn(file, as))
    throw std::invalid_argument(fmt::format(
        "{} is there and was not made by atrapos; expected another file or folder, or that it is removed",
        file));
}

void requireOwnPicture(const std::string& name) {
  std::error_code error;
  const auto size = [&](const std::string& file) { return std::filesystem::file_size(file, error); };
  bool made = false;
  for (const char* const suffix : {".gp", ".png", ".svg"}) {
    const std::string file = name + suffix;
    const auto status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) continue;
    made = made || begins(name + ".gp", kScriptBegins);
    if (!std::filesystem::is_regular_file(status) || (size(file) > 0 && !made))
      throw std::invalid_argument(fmt::format(
          "{} is there and was not made by atrapos; expected another name, or that it is removed", file));
  }
}

void prepareFolder(const std::string& folder, const std::vector<std::string>& inputs) {
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
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (isResultName(entry.path().filename().string()))
      requireOwn(entry.path().string(), Made::result, inputs);
}

}  // namespace atrapos
