#include "commands/Check.hpp"

#include <fmt/format.h>

#include <ostream>

#include "atrapos/linear/Choice.hpp"
#include "commands/FirstAnswer.hpp"
#include "commands/MeshCommand.hpp"
#include "commands/RunSettings.hpp"
#include "commands/SceneCase.hpp"
#include "machine/Memory.hpp"
#include "machine/Ranks.hpp"
#include "machine/Threads.hpp"
#include "scene/Compression.hpp"
#include "scene/Locking.hpp"
#include "scene/Waste.hpp"

namespace atrapos {

void printCheck(const deck::Deck& deck, Scene& scene, std::ostream& out) {
  deck::describe(deck, out);
  fem::FeProblem& problem = scene.problem();
  out << fmt::format("\n# mesh      {}\n", describeMesh(scene.mesh()));
  if (scene.givenRanks().empty())
    if (const std::string other = otherThanGenerated(deck, scene.mesh()); !other.empty())
      out << "# warning   " << other << '\n';
  out << fmt::format("# unknowns  {} ({} free), {} tangent\n", scene.numUnknowns(), problem.numFreeDofs(),
                     problem.symmetric() ? "symmetric" : "unsymmetric");
  const fem::ShellGeometry& shells = scene.shells().geometry;
  for (const fem::ShellBlock& block : shells.blocks)
    out << fmt::format("# shells    {} elements in block '{}'\n", block.numElements(),
                       scene.mesh().blocks[block.block].name);
  if (!shells.blocks.empty()) out << fmt::format("# directors {}\n", shells.numDirectors());
  for (const std::string& line : scene.remarks()) out << "# " << line << '\n';
  for (const ContactPoints& contact : scene.contacts()) {
    out << fmt::format("# contact   {}: {} points, smallest gap {:.6g}, {}\n", contact.name, contact.count,
                       contact.smallestGap, contact.pressure.text);
    if (contact.attracted > 0)
      out << fmt::format(
          "# warning   contact/{}/reference_gap: pulls at the {} points that are farther off than it; "
          "initial "
          "does not\n",
          contact.name, contact.attracted);
  }
  for (const std::string& line : largeCompression(scene.deck(), scene.mesh()))
    out << "# warning   " << line << '\n';
  for (const std::string& line : lockingCells(scene.deck(), scene.mesh()))
    out << "# warning   " << line << '\n';
  for (const std::string& line : waste(scene)) out << "# waste     " << line << '\n';
  if (ranks::count() > 1) out << fmt::format("# ranks     {}\n", threads::describe(ranks::communicator()));
  SceneCase pathCase(scene);
  const auto solver = tangentSolver(pathCase);
  const MemoryEstimate memory =
      estimateMemory(problem, pathCase.start(), scene.deck().path, *solver, pathCase.historyBytes());
  if (const std::string why = linear::choice(*solver); !why.empty()) out << "# solver    " << why << '\n';
  for (const std::string& line : describe(memory, allMachines())) out << "# " << line << '\n';
  for (const std::string& line : describeFirstAnswer(scene, pathCase.start(), *solver))
    out << "# " << line << '\n';
}

void printCheck(const ModelCase& model, std::ostream& out) {
  deck::describe(model.deck(), out);
  out << fmt::format("\n# problem   {}\n", model.about());
  out << fmt::format("# unknowns  {}\n", model.sizes()[0].second);
  for (const std::string& name : model.monitorNames()) out << fmt::format("# monitor   {}\n", name);
}

}  // namespace atrapos
