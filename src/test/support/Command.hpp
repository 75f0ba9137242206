#pragma once

#include <sys/types.h>

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace atrapos::test {

/// How an `atrapos` command ended.
struct CommandResult {
  int exitCode = -1;  ///< -1: a signal ended it
  int signal = 0;     ///< that signal, or 0
  std::string out, err;

  std::vector<std::string> errorLines() const;
};

/// The `atrapos` command of this build, started in a folder, with stdout and stderr caught.
///
/// It gets the environment of a user who has set nothing: no OMP_* and nothing of an MPI launcher that may
/// have started the test.
class Command {
 public:
  /// `ranks` > 0: started by mpirun on so many ranks.
  Command(const std::vector<std::string>& arguments, const std::filesystem::path& folder, int ranks = 0);
  ~Command();  ///< kills it where it still runs
  Command(const Command&) = delete;
  Command& operator=(const Command&) = delete;

  bool running();
  void send(int signal);
  /// Waits for the end. Throws std::runtime_error, after killing it, where it runs longer than this.
  CommandResult wait(double seconds = 120);

 private:
  struct Capture;
  void collect(int status);

  pid_t pid_ = -1;  ///< -1: ended
  std::unique_ptr<Capture> out_, err_;
  CommandResult result_;
};

/// Starts the command and waits for its end.
CommandResult runAtrapos(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                         double seconds = 120);

/// The same on several ranks. mpirun has lines of its own in `err` where the command fails.
CommandResult runAtraposOnRanks(int ranks, const std::vector<std::string>& arguments,
                                const std::filesystem::path& folder, double seconds = 120);

/// `atrapos run -q deck.yaml` and more words.
CommandResult runDeck(const std::vector<std::string>& more, const std::filesystem::path& folder);

}  // namespace atrapos::test
