#pragma once

#include <stdexcept>
#include <string>

namespace atrapos {

/// A file could not be written, made or locked: one line, the file's name first, the system's reason last.
class FileError : public std::runtime_error {
 public:
  FileError(const std::string& file, const std::string& what, int systemError);
};

/// A file that grows by whole pieces: each is in it, or nothing of it.
class OutputFile {
 public:
  OutputFile() = default;  ///< none
  /// Empties the file, or appends to it. Throws FileError; also where it is no regular file.
  OutputFile(std::string file, bool append);
  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&& other) noexcept;
  ~OutputFile();

  /// Hands the bytes to the system; takes back what is written of them where that fails, and throws
  /// FileError.
  void write(const std::string& bytes);
  /// Returns when the file would outlast a loss of power. Throws FileError.
  void sync() const;
  /// Puts it in the place of another, whose name errors have from then on. Throws FileError.
  void rename(const std::string& to);

 private:
  std::string file_;
  int descriptor_ = -1;
};

/// The same for a file that others write, and for the names in a folder.
void syncFile(const std::string& file);

/// Throws FileError.
void renameFile(const std::string& from, const std::string& to);

/// Nothing where there is none. Throws FileError.
void removeFile(const std::string& file);

/// A folder that this process alone writes into, or that nobody does while it is read. Where the file system
/// knows no locks there is none.
class FolderLock {
 public:
  enum class For { writing, reading };
  /// Throws std::invalid_argument, one line, where another process has it. A folder that does not exist has
  /// no lock.
  FolderLock(const std::string& folder, For purpose);
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  ~FolderLock();

 private:
  int descriptor_ = -1;
};

}  // namespace atrapos
