#include "commands/GmshProgram.hpp"

#include <stdexcept>
#include <vector>

#include "import/Import.hpp"
#include "machine/ChildProcess.hpp"

namespace atrapos {

void runGmshProgram(const std::string& file, const std::string& mesh, bool shells, bool quiet) {
  const std::string program = programBeside("atrapos-gmsh");
  if (program.empty())
    throw importer::Error(file +
                          ": meshes of Gmsh are read by atrapos-gmsh, which this installation does not have "
                          "(docs/install.md); expected .inp");
  std::vector<std::string> words{file, mesh, shells ? "shells" : "plane"};
  if (quiet) words.emplace_back("quiet");
  ChildResult result;
  try {
    result = runProgram(program, words, true);
  } catch (const std::runtime_error& error) {
    throw importer::Error(file + ": " + error.what());
  }
  if (result.exitCode == 0) return;
  const bool refused = result.exitCode == 2 && !result.message.empty();
  throw importer::Error(
      refused ? result.message
              : file +
                    ": is damaged: Gmsh's library does not come to an end with it in the time and memory "
                    "that a file of its length may take");
}

}  // namespace atrapos
