#include "Check.hpp"

#include <fmt/format.h>

#include <ostream>

#include "MeshCommand.hpp"

namespace atrapos {

void printCheck(Scene& scene, std::ostream& out) {
  deck::describe(scene.deck(), out);
  fem::FeProblem& problem = scene.problem();
  out << fmt::format("\n# mesh      {}\n", describeMesh(scene.mesh()));
  out << fmt::format("# unknowns  {} ({} free), {} tangent\n", scene.numUnknowns(), problem.numFreeDofs(),
                     problem.symmetric() ? "symmetric" : "unsymmetric");
  for (const ContactPoints& contact : scene.contacts())
    out << fmt::format("# contact   {}: {} points, smallest gap {:.6g}\n", contact.name, contact.count,
                       contact.smallestGap);
  out << fmt::format("# memory    {:.1f} MB for the histories of order {}\n",
                     1e-6 * static_cast<double>(problem.historyBytes(scene.deck().path.order)),
                     scene.deck().path.order);
}

}  // namespace atrapos
