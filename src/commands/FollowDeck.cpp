#include "commands/FollowDeck.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <Kokkos_Core.hpp>
#include <filesystem>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "commands/Check.hpp"
#include "commands/MeshCommand.hpp"
#include "commands/ModelCase.hpp"
#include "commands/SceneCase.hpp"
#include "commands/Stages.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "machine/Threads.hpp"
#include "output/Files.hpp"

namespace atrapos {
namespace {

/// How the ranks and threads share the work; empty where there is one of each. Collective but with a model
/// problem, of which the other ranks see nothing.
std::string sharing(const deck::Deck& deck) {
  int all = 1;  // ranks::count() is that of those at work
  MPI_Comm_size(MPI_COMM_WORLD, &all);
  if (all > 1 && deck.problem) return "the model problem runs on the first rank";
  if (all == 1 && Kokkos::DefaultExecutionSpace::concurrency() == 1) return {};
  return threads::describe(MPI_COMM_WORLD);
}

}  // namespace

RunResult followDeck(const deck::Deck& deck, const RunOptions& options,
                     const std::function<void(const std::string&)>& tell) {
  const std::string shared = sharing(deck);
  const auto follow = [&](PathCase& pathCase, const std::string& about) {
    tell(about);
    if (!shared.empty()) tell(shared);
    return runPath(deck, pathCase, options);
  };
  if (deck.problem) {
    ModelCase model(deck);
    tell(deck.title);
    return follow(model, model.about());
  }
  DeckMesh mesh = readDeckMesh(deck);
  tell(deck.title);                            // the scene may take a while
  if (mesh.ranks.empty() && ranks::isFirst())  // who tells
    if (const std::string other = otherThanGenerated(deck, mesh.mesh); !other.empty())
      tell("warning: " + other);
  const char* const came = mesh.ranks.empty() ? "" : ", a part file for each rank";
  const deck::Deck first = firstDeck(deck, mesh);
  Scene scene(first, std::move(mesh));
  SceneCase pathCase(scene);
  return follow(pathCase, describeMesh(scene.mesh()) + came);
}

void checkDeck(const deck::Deck& deck, std::ostream& out) {
  if (deck.problem) return printCheck(ModelCase(deck), out);
  DeckMesh mesh = readDeckMesh(deck);
  const deck::Deck first = firstDeck(deck, mesh);
  Scene scene(first, std::move(mesh));
  printCheck(deck, scene, out);
}

std::string writeDeckMesh(const deck::Deck& deck, const std::string& output) {
  const auto mesh = generateMesh(deck);
  const std::string file = output.empty() ? deck.mesh.path : output;
  std::error_code notThere;
  if (std::filesystem::equivalent(file, deck.file, notThere)) {  // links and other spellings too
    const std::string what =
        file + " is the deck itself, which the mesh would replace; expected another file";
    if (output.empty()) deck::failAt(deck, "mesh/file", what);
    throw deck::DeckError(fmt::format("{}: --output: {}", deck.file, what));
  }
  requireOwn(file, Made::mesh, {});
  if (std::filesystem::exists(file) && exodus::ResultReader(file).numSteps() > 0)
    throw deck::DeckError(fmt::format("{}: {} holds results, which the mesh would replace", deck.file, file));
  exodus::writeMesh(mesh, file);
  return fmt::format("{}: {}", file, describeMesh(mesh));
}

}  // namespace atrapos
