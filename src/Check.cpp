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
  out << fmt::format("# memory    {:.1f} MB for the histories of order {}\n",
                     1e-6 * static_cast<double>(problem.historyBytes(scene.deck().path.order)),
                     scene.deck().path.order);
}

void printCheck(const ModelCase& model, std::ostream& out) {
  deck::describe(model.deck(), out);
  out << fmt::format("\n# problem   {}\n", model.about());
  out << fmt::format("# unknowns  {}\n", model.sizes()[0].second);
  for (const std::string& name : model.monitorNames()) out << fmt::format("# monitor   {}\n", name);
}

}  // namespace atrapos
