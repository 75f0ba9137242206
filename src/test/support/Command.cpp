#include "support/Command.hpp"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <sstream>
#include <stdexcept>
#include <thread>

extern char** environ;

namespace atrapos::test {
namespace {

bool startsWith(const char* text, const char* prefix) {
  return std::strncmp(text, prefix, std::strlen(prefix)) == 0;
}

std::vector<char*> userEnvironment() {
  std::vector<char*> kept;
  for (char** entry = environ; *entry != nullptr; ++entry) {
    bool dropped = false;
    for (const char* prefix : {"OMP_", "OMPI_", "PMIX_", "PMI_", "KOKKOS_"})
      dropped = dropped || startsWith(*entry, prefix);
    if (!dropped) kept.push_back(*entry);
  }
  kept.push_back(nullptr);
  return kept;
}

}  // namespace

/// A file without a name: a pipe would block a command that says more than it holds.
struct Command::Capture {
  Capture() : file(std::tmpfile()) {
    if (file == nullptr) throw std::runtime_error("no temporary file");
  }
  ~Capture() { std::fclose(file); }

  std::string text() const {
    std::rewind(file);
    std::string all;
    char buffer[4096];
    for (std::size_t n; (n = std::fread(buffer, 1, sizeof buffer, file)) > 0;) all.append(buffer, n);
    return all;
  }

  std::FILE* file;
};

std::vector<std::string> CommandResult::errorLines() const {
  std::vector<std::string> lines;
  std::istringstream in(err);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

Command::Command(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int ranks)
    : out_(std::make_unique<Capture>()), err_(std::make_unique<Capture>()) {
  // All that allocates comes before fork: between it and exec only plain system calls are safe.
  std::string program = ranks > 0 ? ATRAPOS_MPIEXEC : ATRAPOS_COMMAND;
  std::vector<std::string> words = arguments;
  if (ranks > 0)
    words.insert(words.begin(),
                 {"--oversubscribe", "--bind-to", "none", "-np", std::to_string(ranks), ATRAPOS_COMMAND});
  std::vector<char*> argv{program.data()};
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::vector<char*> environment = userEnvironment();
  // Open MPI's mpirun refuses the superuser, whom test machines often run as.
  std::string asRoot = "OMPI_ALLOW_RUN_AS_ROOT=1", confirmed = "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1";
  // There may be less cores than ranks, and other tests on them: who waits makes room.
  std::string yields = "OMPI_MCA_mpi_yield_when_idle=1";
  if (ranks > 0) environment.insert(environment.begin(), {asRoot.data(), confirmed.data(), yields.data()});
  const std::string directory = folder.string();
  const int out = fileno(out_->file), err = fileno(err_->file);

  pid_ = fork();
  if (pid_ < 0) throw std::runtime_error("fork failed");
  if (pid_ == 0) {
    const int nothing = open("/dev/null", O_RDONLY);
    if (chdir(directory.c_str()) == 0 && dup2(nothing, 0) >= 0 && dup2(out, 1) >= 0 && dup2(err, 2) >= 0)
      execve(program.c_str(), argv.data(), environment.data());
    _exit(127);
  }
}

Command::~Command() {
  if (pid_ < 0) return;
  kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
}

void Command::collect(int status) {
  pid_ = -1;
  if (WIFEXITED(status)) result_.exitCode = WEXITSTATUS(status);
  if (WIFSIGNALED(status)) result_.signal = WTERMSIG(status);
  result_.out = out_->text();
  result_.err = err_->text();
}

bool Command::running() {
  int status = 0;
  if (pid_ >= 0 && waitpid(pid_, &status, WNOHANG) == pid_) collect(status);
  return pid_ >= 0;
}

void Command::send(int signal) {
  if (pid_ < 0 || kill(pid_, signal) != 0) throw std::runtime_error("the command has ended already");
}

CommandResult Command::wait(double seconds) {
  const auto limit = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
  while (running()) {
    if (std::chrono::steady_clock::now() > limit) {
      kill(pid_, SIGKILL);
      waitpid(pid_, nullptr, 0);
      pid_ = -1;
      throw std::runtime_error("the command ran longer than " + std::to_string(seconds) + " s");
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return result_;
}

CommandResult runAtrapos(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                         double seconds) {
  return Command(arguments, folder).wait(seconds);
}

CommandResult runAtraposOnRanks(int ranks, const std::vector<std::string>& arguments,
                                const std::filesystem::path& folder, double seconds) {
  return Command(arguments, folder, ranks).wait(seconds);
}

CommandResult runDeck(const std::vector<std::string>& more, const std::filesystem::path& folder) {
  std::vector<std::string> words{"run", "-q", "deck.yaml"};
  words.insert(words.end(), more.begin(), more.end());
  return runAtrapos(words, folder);
}

}  // namespace atrapos::test
