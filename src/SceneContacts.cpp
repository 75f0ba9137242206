// The contacts of a deck made into terms: where points are over tools, and their reference gaps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "Registry.hpp"
#include "Scene.hpp"

namespace atrapos {

const deck::Tool& Scene::toolOf(const deck::Contact& contact) const {
  return *std::find_if(deck_.tools.begin(), deck_.tools.end(),
                       [&](const deck::Tool& tool) { return tool.name == contact.tool; });
}

void Scene::addContacts(fem::FeModel& model) {
  for (const deck::Tool& tool : deck_.tools) try {
      registry::validate(tool);
    } catch (const std::invalid_argument& e) {
      fail("tools/" + tool.name, e.what());
    }
  for (const deck::Contact& contact : deck_.contacts) {
    const deck::Tool& tool = toolOf(contact);
    contact::RegularisedPressure pressure;
    pressure.compliance = contact.stiffness ? 1.0 / *contact.stiffness : 0.0;
    pressure.eta = contact.regularisation;

    ContactPoints entry;
    entry.name = contact.name;
    if (contact.points == deck::Contact::Points::Nodes)
      entry.points.push_back(fem::nodePoints(mesh_, nodesOf(contact.set)));
    else
      entry.points = fem::facePoints(mesh_, mesh_.sideSets.at(fem::findSideSet(mesh_, contact.set)),
                                     contact.quadratureDegree);

    entry.smallestGap = std::numeric_limits<double>::infinity();
    for (const fem::PointSet& points : entry.points) {
      std::vector<double> gaps, references;
      for (int p = 0; p < points.numPoints(); ++p) {
        const double* x = &points.positions[3 * static_cast<std::size_t>(p)];
        const std::string ambiguity = registry::ambiguity(tool, x);
        const double gap = registry::project(tool, x)[0];
        if (!ambiguity.empty() || !std::isfinite(gap))
          fail("contact/" + contact.name,
               fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) has no unique projection on tool '{}'{}{}",
                           x[0], x[1], x[2], tool.name, ambiguity.empty() ? "" : ": it ", ambiguity));
        // Rounding of coordinates as large as the scene; anything deeper is meant.
        const double rounding = 1e-12 * (1 + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
        if (gap < -rounding)
          fail("contact/" + contact.name, fmt::format("tool '{}' penetrates the body at the start: gap "
                                                      "{:.6g} at ({:.6g}, {:.6g}, {:.6g}); move the "
                                                      "tool or the mesh apart",
                                                      tool.name, gap, x[0], x[1], x[2]));
        // Law (15) needs Delta > eta/alpha; a point that touches at the start gets the least sensible value.
        const double least = 2 * pressure.eta * pressure.compliance;
        if (!contact.referenceGap && !(std::max(gap, least) > 0))
          fail("contact/" + contact.name + "/reference_gap",
               fmt::format(
                   "the body touches tool '{}' at ({:.6g}, {:.6g}, {:.6g}): a rigid contact needs a positive "
                   "reference_gap there, give a number",
                   tool.name, x[0], x[1], x[2]));
        gaps.push_back(gap);
        references.push_back(contact.referenceGap ? *contact.referenceGap : std::max(gap, least));
        entry.smallestGap = std::min(entry.smallestGap, gap);
      }
      entry.count += points.numPoints();
      entry.terms.push_back(static_cast<int>(model.terms.size()));
      entry.gaps.push_back(std::move(gaps));
      model.terms.push_back(registry::contactTerm(tool, pressure, points, references));
    }
    contacts_.push_back(std::move(entry));
  }
}

int Scene::numContactPoints() const {
  return std::accumulate(contacts_.begin(), contacts_.end(), 0,
                         [](int n, const ContactPoints& c) { return n + c.count; });
}

}  // namespace atrapos
