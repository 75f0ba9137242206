#pragma once

#include <filesystem>
#include <map>
#include <string>

namespace atrapos::test {

/// A new empty folder, removed with all that is in it at the end of life.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

/// Whole content; throws std::runtime_error where the file cannot be read.
std::string readFile(const std::filesystem::path& file);
/// Replaces the file; throws std::runtime_error where it cannot be written.
void writeFile(const std::filesystem::path& file, const std::string& content);

/// The text with its one `from` made `to`. Throws std::logic_error where there is not exactly one: an edit of
/// a deck that no longer fits the deck must not pass unseen.
std::string edited(const std::string& text, const std::string& from, const std::string& to);

/// All that is below a folder: path -> content (of files), "<folder>" (of folders).
std::map<std::string, std::string> snapshot(const std::filesystem::path& folder);

}  // namespace atrapos::test
