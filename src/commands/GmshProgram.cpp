#include "commands/GmshProgram.hpp"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <filesystem>
#include <vector>

#include "deck/Characters.hpp"
#include "import/Import.hpp"

extern char** environ;

namespace atrapos {
namespace {

/// All that comes out of a pipe until it is closed, a line's worth of it.
std::string lineFrom(int descriptor) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (;;) {
    const ssize_t n = read(descriptor, buffer.data(), buffer.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    if (text.size() < buffer.size()) text.append(buffer.data(), static_cast<std::size_t>(n));
  }
  const std::size_t end = text.find('\n');
  return deck::plainLine(text.substr(0, end));
}

}  // namespace

void runGmshProgram(const std::string& file, const std::string& mesh, bool shells, bool quiet) {
  std::error_code error;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", error).parent_path() / "atrapos-gmsh";
  if (error || !std::filesystem::exists(program, error))
    throw importer::Error(file +
                          ": meshes of Gmsh are read by atrapos-gmsh, which this installation does not have "
                          "(docs/install.md); expected .inp");
  std::array<int, 2> ends{};
  if (pipe2(ends.data(), O_CLOEXEC) != 0) throw importer::Error(file + ": no pipe for reading it");
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, ends[1], STDERR_FILENO);
  std::vector<std::string> words{program.string(), file, mesh, shells ? "shells" : "plane"};
  if (quiet) words.emplace_back("quiet");
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t child = -1;
  const int failure = posix_spawn(&child, program.c_str(), &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  close(ends[1]);
  const std::string told = failure == 0 ? lineFrom(ends[0]) : std::string();
  close(ends[0]);
  if (failure != 0) throw importer::Error(file + ": atrapos-gmsh could not be started");
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return;
  const bool refused = WIFEXITED(status) && WEXITSTATUS(status) == 2 && !told.empty();
  throw importer::Error(
      refused ? told
              : file +
                    ": is damaged: Gmsh's library does not come to an end with it in the time and memory "
                    "that a file of its length may take");
}

}  // namespace atrapos
