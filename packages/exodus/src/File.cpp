#include "File.hpp"

#include <fcntl.h>
#include <netcdf.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <utility>

#include "FileCheck.hpp"
#include "FileLayout.hpp"
#include "Hdf5Check.hpp"

namespace atrapos::exodus {

namespace {

void silence() { ex_opts(0); }

// Where an HDF5 file cannot be opened, ex_open prints a (wrong) reason to stderr, whatever ex_opts says.
class NoStderr {
 public:
  NoStderr() : saved_(dup(STDERR_FILENO)) {
    const int null = ::open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (null < 0) return;
    if (saved_ >= 0) dup2(null, STDERR_FILENO);
    ::close(null);
  }
  NoStderr(const NoStderr&) = delete;
  NoStderr& operator=(const NoStderr&) = delete;
  ~NoStderr() {
    if (saved_ < 0) return;
    std::fflush(stderr);
    dup2(saved_, STDERR_FILENO);
    ::close(saved_);
  }

 private:
  int saved_;
};

}  // namespace

File File::open(const std::string& name) {
  const Format format = checkFile(name);
  if (format == Format::Hdf5)
    checkHdf5(name);
  else
    checkLayout(name, std::filesystem::file_size(name));
  silence();
  int computeWords = sizeof(double), fileWords = 0;
  float version = 0.0F;
  const auto openFile = [&] {
    return ex_open(name.c_str(), EX_READ | EX_ALL_INT64_API, &computeWords, &fileWords, &version);
  };
  int id = -1;
  if (format == Format::Hdf5) {
    const NoStderr quiet;
    id = openFile();
  } else {
    id = openFile();
  }
  if (id < 0) throw Error(name + ": not an Exodus file, or a damaged one");
  File file(id, name);
  // Names are cut at 32 characters unless asked for otherwise.
  const auto longest = ex_inquire_int(id, EX_INQ_DB_MAX_USED_NAME_LENGTH);
  if (longest > MAX_NAME_LENGTH) ex_set_max_name_length(id, static_cast<int>(longest));
  return file;
}

File File::create(const std::string& name, const std::string& shown) {
  silence();
  int computeWords = sizeof(double), fileWords = sizeof(double);
  errno = 0;
  const int id = ex_create(name.c_str(), EX_CLOBBER | EX_LARGE_MODEL | EX_NOSHARE | EX_ALL_INT64_API,
                           &computeWords, &fileWords);
  if (id < 0)
    throw Error(shown + ": the file cannot be created" +
                (errno != 0 ? std::string(" (") + std::strerror(errno) + ")" : ""));
  return File(id, shown);
}

File::File(File&& other) noexcept : id_(std::exchange(other.id_, -1)), name_(std::move(other.name_)) {}

File& File::operator=(File&& other) noexcept {
  std::swap(id_, other.id_);
  std::swap(name_, other.name_);
  return *this;
}

File::~File() {
  if (id_ >= 0) ex_close(id_);
}

void File::check(int status, const std::string& doing) const {
  if (status >= 0) return;
  // The library keeps the reason: numbers of the system from 1, of NetCDF below 0, its own from 1000.
  const bool known = exerrval != 0 && exerrval < EX_MEMFAIL;
  throw Error(name_ + ": " + doing + " failed (" +
              (known ? std::string(nc_strerror(exerrval)) : "library status " + std::to_string(status)) +
              ")");
}

void File::close() {
  const int id = std::exchange(id_, -1);
  if (id >= 0) check(ex_close(id), "closing the file");
}

Strings::Strings(std::size_t count, std::size_t length) : rows_(count, std::vector<char>(length + 1, '\0')) {
  for (auto& row : rows_) pointers_.push_back(row.data());
}

Strings::Strings(const std::vector<std::string>& strings) {
  for (const std::string& s : strings) {
    rows_.emplace_back(s.begin(), s.end());
    rows_.back().push_back('\0');
  }
  for (auto& row : rows_) pointers_.push_back(row.data());
}

std::vector<std::string> Strings::get() const {
  std::vector<std::string> result;
  for (const char* row : pointers_) result.emplace_back(row);
  return result;
}

}  // namespace atrapos::exodus
