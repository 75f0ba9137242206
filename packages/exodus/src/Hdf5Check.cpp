#include "Hdf5Check.hpp"

#include <fcntl.h>
#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>

#include "FileLayout.hpp"
#include "atrapos/exodus/Error.hpp"

namespace atrapos::exodus {

namespace {

/// HDF5 packs equal values nearly without end; meshes and results were never seen packed closer than this.
std::uint64_t mostBytes(const std::string& file) {
  constexpr std::uint64_t small = std::uint64_t{64} << 20, packing = 200;
  return small + packing * std::filesystem::file_size(file);
}

/// Of processor time; the library reads hundreds of MB a second.
std::uint64_t secondsFor(std::uint64_t bytes) { return 2 + bytes / (std::uint64_t{50} << 20); }

std::uint64_t addressSpace() {
  unsigned long long pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return pages * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
}

void limit(int what, std::uint64_t most) {
  rlimit value{};
  getrlimit(what, &value);
  value.rlim_cur = std::min<rlim_t>(most, value.rlim_max);
  setrlimit(what, &value);
}

[[noreturn]] void readInChild(const std::string& file, int report) {
  for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGXCPU}) std::signal(signal, SIG_DFL);
  const int null = ::open("/dev/null", O_RDWR);
  if (null >= 0) {
    dup2(null, STDOUT_FILENO);
    dup2(null, STDERR_FILENO);
  }
  std::string trouble;
  try {
    const std::uint64_t most = mostBytes(file), room = std::uint64_t{512} << 20;
    limit(RLIMIT_CORE, 0);
    limit(RLIMIT_CPU, secondsFor(std::filesystem::file_size(file)));
    if (const std::uint64_t own = addressSpace(); own > 0) limit(RLIMIT_AS, own + room + 2 * most);
    const std::uint64_t announced = checkLayout(file, most);
    limit(RLIMIT_CPU, secondsFor(std::filesystem::file_size(file)) + secondsFor(announced));
    readThrough(file, most);
  } catch (const std::exception& e) {
    trouble =
        dynamic_cast<const Error*>(&e) != nullptr ? e.what() : file + ": reading it needs too much memory";
  }
  if (!trouble.empty() && write(report, trouble.data(), trouble.size()) < 0) _exit(2);
  _exit(trouble.empty() ? 0 : 1);
}

/// What the child reports until it ends; kills it where it takes longer than `seconds`.
std::string reportOf(int from, pid_t child, double seconds) {
  const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    const auto left =
        std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    pollfd ready{from, POLLIN, 0};
    const int events = left.count() > 0 ? poll(&ready, 1, static_cast<int>(left.count())) : 0;
    if (events < 0) continue;  // a signal
    if (events == 0) kill(child, SIGKILL);
    const ssize_t n = read(from, buffer.data(), buffer.size());
    if (n <= 0) return text;
    text.append(buffer.data(), static_cast<std::size_t>(n));
  }
}

}  // namespace

void checkHdf5(const std::string& file) {
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw Error(file + ": no pipe for checking it");
  std::fflush(nullptr);
  const pid_t child = fork();
  if (child == 0) readInChild(file, ends[1]);
  close(ends[1]);
  if (child < 0) {
    close(ends[0]);
    throw Error(file + ": no process for checking it");
  }
  // Others may have the processor too.
  const std::string report =
      reportOf(ends[0], child, 10.0 * static_cast<double>(secondsFor(mostBytes(file))));
  close(ends[0]);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (!report.empty()) throw Error(report);
  if (!WIFEXITED(status) || WEXITSTATUS(status) != 0)
    throw Error(
        file +
        ": damaged: the HDF5 library does not come to an end with it in the time and memory that a file of "
        "its length may take");
}

}  // namespace atrapos::exodus
