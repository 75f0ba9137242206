#include "machine/OutputFile.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

namespace atrapos {

FileError::FileError(const std::string& file, const std::string& what, int systemError)
    : std::runtime_error(fmt::format("{}: {}: {}", file, what, std::strerror(systemError))) {}

OutputFile::OutputFile(std::string file, bool append) : file_(std::move(file)) {
  // Not to wait where a FIFO has no reader.
  const int how = O_WRONLY | O_CREAT | O_CLOEXEC | O_NONBLOCK | (append ? O_APPEND : 0);
  descriptor_ = open(file_.c_str(), how, 0666);
  struct stat status {};
  if (descriptor_ < 0) throw FileError(file_, "cannot be written", errno);
  const bool regular = fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode);
  if (regular && (append || ftruncate(descriptor_, 0) == 0)) return;
  const int error = regular ? errno : EINVAL;
  close(descriptor_);
  throw FileError(file_, regular ? "cannot be written" : "is no regular file", error);
}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

OutputFile& OutputFile::operator=(OutputFile&& other) noexcept {
  std::swap(file_, other.file_);
  std::swap(descriptor_, other.descriptor_);
  return *this;
}

OutputFile::~OutputFile() {
  if (descriptor_ >= 0) close(descriptor_);
}

void OutputFile::write(const std::string& bytes) {
  const off_t before = lseek(descriptor_, 0, SEEK_END);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(descriptor_, bytes.data() + done, bytes.size() - done);
    if (n > 0) done += static_cast<std::size_t>(n);
    if (n > 0 || (n < 0 && errno == EINTR)) continue;
    const int error = n < 0 ? errno : ENOSPC;
    // Where this fails too, the cut row or record at the end is known by its length.
    if (before >= 0 && ftruncate(descriptor_, before) != 0) lseek(descriptor_, before, SEEK_SET);
    throw FileError(file_, "cannot be written", error);
  }
}

void OutputFile::sync() const {
  // File systems without it have nothing that outlasts anything.
  if (descriptor_ >= 0 && fdatasync(descriptor_) != 0 && errno != EINVAL && errno != EROFS)
    throw FileError(file_, "cannot be written", errno);
}

void OutputFile::rename(const std::string& to) {
  renameFile(file_, to);
  file_ = to;
}

void syncFile(const std::string& file) {
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) return;
  const int status = fsync(descriptor), error = errno;
  close(descriptor);
  if (status != 0 && error != EINVAL && error != EROFS) throw FileError(file, "cannot be written", error);
}

void renameFile(const std::string& from, const std::string& to) {
  if (std::rename(from.c_str(), to.c_str()) != 0) throw FileError(to, "cannot be put in its place", errno);
}

void removeFile(const std::string& file) {
  if (std::remove(file.c_str()) != 0 && errno != ENOENT) throw FileError(file, "cannot be removed", errno);
}

FolderLock::FolderLock(const std::string& folder, For purpose)
    : descriptor_(open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  const int kind = purpose == For::writing ? LOCK_EX : LOCK_SH;
  if (descriptor_ < 0 || flock(descriptor_, kind | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(descriptor_);
  throw std::invalid_argument(fmt::format("another run {} the folder {}; expected its end, or another folder",
                                          purpose == For::writing ? "uses" : "writes into", folder));
}

FolderLock::~FolderLock() {
  if (descriptor_ >= 0) close(descriptor_);
}

}  // namespace atrapos
