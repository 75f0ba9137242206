#include "Scene.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "Registry.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos {
namespace {

int componentIndex(deck::Component c) { return static_cast<int>(c); }

/// Calls f on each term's points of a contact: f(point set, values, first value of point).
template <class F>
void forEachPoint(const fem::FeProblem& problem, const ContactPoints& contact, const path::Vector& u, const F& f) {
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    const fem::PointValues observed = problem.term(contact.terms[t]).observe(fem::field(u));
    const int M = static_cast<int>(observed.names.size());
    for (int p = 0; p < contact.points[t].numPoints(); ++p)
      f(t, p, &observed.values[static_cast<std::size_t>(p) * M]);
  }
}

}  // namespace

Scene::Scene(const deck::Deck& deck, fem::Mesh mesh) : deck_(deck), mesh_(std::move(mesh)) {
  deck::checkAgainstMesh(deck_, mesh_);
  fem::FeModel model;
  model.numNodes = mesh_.numNodes();
  addMaterials(model);
  model.supports = fem::Supports(model.numNodes);
  addSupports(model);
  addLoads(model);
  addContacts(model);
  requireSupport(model.supports);
  problem_ = std::make_unique<fem::FeProblem>(std::move(model));
}

void Scene::fail(const std::string& key, const std::string& problem) const {
  throw deck::DeckError(fmt::format("{}: {}: {}", deck_.file, key, problem));
}

std::vector<int> Scene::nodesOf(const std::string& set) const {
  const int n = fem::findNodeSet(mesh_, set);
  if (n >= 0) return mesh_.nodeSets[n].nodes;
  return fem::nodesOf(mesh_, mesh_.sideSets.at(fem::findSideSet(mesh_, set)));
}

void Scene::addMaterials(fem::FeModel& model) {
  blockTerms_.assign(mesh_.blocks.size(), -1);
  for (const deck::Material& material : deck_.materials)
    for (const std::string& name : material.blocks) {
      const int b = fem::findBlock(mesh_, name);
      const fem::Block& block = mesh_.blocks[b];
      try {
        const auto points = fem::volumePoints(mesh_, block, fem::tabulate(block.topology));
        blockTerms_[b] = static_cast<int>(model.terms.size());
        model.terms.push_back(registry::materialTerm(material, points));
      } catch (const std::runtime_error& e) {
        fail("mesh/file", e.what());
      }
    }
}

void Scene::addSupports(fem::FeModel& model) const {
  for (const deck::Support& support : deck_.supports)
    for (int node : nodesOf(support.set))
      for (int i = 0; i < 3; ++i)
        if (const auto& p = support.components[i]) try {
            model.supports.prescribe(node, i, p->value, p->perLoadFactor);
          } catch (const std::invalid_argument& e) {
            fail("supports/" + support.name, e.what());
          }
}

void Scene::addLoads(fem::FeModel& model) const {
  const std::size_t dofs = 3 * static_cast<std::size_t>(mesh_.numNodes());
  model.load.assign(dofs, 0.0);
  model.constantLoad.assign(dofs, 0.0);
  struct Adder {
    const Scene& scene;
    std::vector<double>& force;
    void operator()(const deck::NodalLoad& load) const {
      const auto nodes = scene.nodesOf(load.set);
      deck::Vector3 each = load.force;
      if (!load.perNode)
        for (double& f : each) f /= static_cast<double>(nodes.size());
      fem::addNodalLoad(nodes, each, force);
    }
    void operator()(const deck::SurfaceLoad& load) const {
      const auto& set = scene.mesh_.sideSets.at(fem::findSideSet(scene.mesh_, load.set));
      switch (load.kind) {
        case deck::SurfaceLoad::Kind::Total: return fem::addSurfaceForce(scene.mesh_, set, load.vector, force);
        case deck::SurfaceLoad::Kind::Traction: return fem::addTraction(scene.mesh_, set, load.vector, force);
        case deck::SurfaceLoad::Kind::Pressure: return fem::addPressure(scene.mesh_, set, load.pressure, force);
      }
    }
    void operator()(const deck::VolumeLoad& load) const {
      for (const std::string& name : load.blocks)
        fem::addBodyForce(scene.mesh_, scene.mesh_.blocks.at(fem::findBlock(scene.mesh_, name)), load.force, force);
    }
  };
  for (const deck::Load& load : deck_.loads)
    std::visit(Adder{*this, load.constant ? model.constantLoad : model.load}, load.load);
}

void Scene::addContacts(fem::FeModel& model) {
  for (const deck::Contact& contact : deck_.contacts) {
    const auto& tool = *std::find_if(deck_.tools.begin(), deck_.tools.end(),
                                     [&](const deck::Tool& t) { return t.name == contact.tool; });
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
        const double gap = registry::project(tool, x)[0];
        if (!std::isfinite(gap))
          fail("contact/" + contact.name, fmt::format("the point ({:.6g}, {:.6g}, {:.6g}) has no projection on tool '{}'",
                                                      x[0], x[1], x[2], tool.name));
        // Rounding of coordinates as large as the scene; anything deeper is meant.
        const double rounding = 1e-12 * (1 + std::abs(x[0]) + std::abs(x[1]) + std::abs(x[2]));
        if (gap < -rounding)
          fail("contact/" + contact.name,
               fmt::format("tool '{}' penetrates the body at the start: gap {:.6g} at ({:.6g}, {:.6g}, {:.6g}); move the "
                           "tool or the mesh apart",
                           tool.name, gap, x[0], x[1], x[2]));
        // Law (15) needs Delta > eta/alpha; a point that touches at the start gets the least sensible value.
        const double least = 2 * pressure.eta * pressure.compliance;
        if (!contact.referenceGap && !(std::max(gap, least) > 0))
          fail("contact/" + contact.name + "/reference_gap",
               fmt::format("the body touches tool '{}' at ({:.6g}, {:.6g}, {:.6g}): a rigid contact needs a positive "
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

void Scene::requireSupport(const fem::Supports& supports) const {
  std::vector<fem::HeldDirection> held;
  for (std::size_t c = 0; c < contacts_.size(); ++c) {
    const auto& tool = *std::find_if(deck_.tools.begin(), deck_.tools.end(),
                                     [&](const deck::Tool& t) { return t.name == deck_.contacts[c].tool; });
    for (const fem::PointSet& points : contacts_[c].points)
      for (int n : points.nodes) {
        const auto y = registry::project(tool, &mesh_.coordinates[3 * static_cast<std::size_t>(n)]);
        held.push_back({n, {y[1], y[2], y[3]}});
      }
  }
  for (const fem::FreeBody& body : fem::freeBodies(mesh_, supports, held))
    fail("supports", fmt::format("the body with block '{}' can still move freely in {} rigid motion{}: prescribe more "
                                 "displacements",
                                 body.block, body.motions, body.motions == 1 ? "" : "s"));
}

int Scene::numContactPoints() const {
  return std::accumulate(contacts_.begin(), contacts_.end(), 0,
                         [](int n, const ContactPoints& c) { return n + c.count; });
}

path::Stops Scene::stops() const {
  path::Stops stops;
  const deck::Stop& stop = deck_.path.stop;
  if (stop.loadFactor) stops.loadFactors.push_back(*stop.loadFactor);
  if (stop.pathLength) stops.pathLength = *stop.pathLength;
  for (const auto& [name, value] : stop.displacement)
    for (const deck::Monitor& monitor : deck_.output.monitors) {
      if (monitor.name != name) continue;
      const auto& displacement = std::get<deck::DisplacementMonitor>(monitor.quantity);
      const auto nodes = nodesOf(displacement.set);
      auto weights = Teuchos::rcp(new path::Vector(problem_->map()));
      for (int n : nodes)
        weights->sumIntoLocalValue(3 * n + componentIndex(displacement.component),
                                   displacement.reduce == deck::DisplacementMonitor::Reduce::Mean ? 1.0 / nodes.size() : 1.0);
      stops.functionals.push_back({name, weights, value});
    }
  return stops;
}

std::vector<std::string> Scene::monitorNames() const {
  std::vector<std::string> names;
  for (const deck::Monitor& monitor : deck_.output.monitors) names.push_back(monitor.name);
  return names;
}

ContactState Scene::contactState(const ContactPoints& contact, const path::Vector& u) const {
  const auto& entry = *std::find_if(deck_.contacts.begin(), deck_.contacts.end(),
                                    [&](const deck::Contact& c) { return c.name == contact.name; });
  ContactState state;
  state.smallestGap = std::numeric_limits<double>::infinity();
  forEachPoint(*problem_, contact, u, [&](std::size_t t, int p, const double* gapAndPressure) {
    const double gap = gapAndPressure[0], pressure = gapAndPressure[1];
    const double turn = entry.stiffness ? 2 * entry.regularisation / *entry.stiffness : 1e-3 * contact.gaps[t][p];
    state.active += gap <= turn;
    state.normalForce += contact.points[t].weights[p] * pressure;
    state.smallestGap = std::min(state.smallestGap, gap);
  });
  for (int t : contact.terms) {
    const auto force = problem_->forces(problem_->term(t), u);
    for (std::size_t d = 0; d < force.size(); ++d) state.resultant[d % 3] -= force[d];
  }
  return state;
}

std::vector<double> Scene::monitors(const path::Vector& u, double lambda) const {
  std::vector<double> result;
  struct Evaluator {
    const Scene& scene;
    const path::Vector& u;
    double lambda;
    double operator()(const deck::DisplacementMonitor& m) const {
      const auto values = u.getLocalViewHost(Tpetra::Access::ReadOnly);
      const auto nodes = scene.nodesOf(m.set);
      double sum = 0;
      for (int n : nodes) sum += values(3 * n + componentIndex(m.component), 0);
      return m.reduce == deck::DisplacementMonitor::Reduce::Mean ? sum / nodes.size() : sum;
    }
    double operator()(const deck::ContactForceMonitor& m) const {
      for (const ContactPoints& contact : scene.contacts_)
        if (contact.name == m.contact) {
          const ContactState state = scene.contactState(contact, u);
          return m.component == deck::Component::Normal ? state.normalForce : state.resultant[componentIndex(m.component)];
        }
      return 0;
    }
    double operator()(const deck::ReactionMonitor& m) const {
      const auto reactions = scene.problem_->reactions(u, lambda);
      const auto& support = *std::find_if(scene.deck_.supports.begin(), scene.deck_.supports.end(),
                                          [&](const deck::Support& s) { return s.name == m.support; });
      double sum = 0;
      if (!support.components[componentIndex(m.component)]) return 0;
      for (int n : scene.nodesOf(support.set)) sum += reactions[3 * n + componentIndex(m.component)];
      return sum;
    }
  };
  for (const deck::Monitor& monitor : deck_.output.monitors)
    result.push_back(std::visit(Evaluator{*this, u, lambda}, monitor.quantity));
  return result;
}

bool Scene::writes(deck::OutputField field) const {
  const auto& fields = deck_.output.fields;
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

std::vector<std::string> Scene::nodalNames() const {
  std::vector<std::string> names;
  if (writes(deck::OutputField::Displacement)) names.insert(names.end(), {"displ_x", "displ_y", "displ_z"});
  if (writes(deck::OutputField::Reaction)) names.insert(names.end(), {"reaction_x", "reaction_y", "reaction_z"});
  if (writes(deck::OutputField::Contact) && !contacts_.empty())
    names.insert(names.end(), {"contact_gap", "contact_pressure"});
  return names;
}

std::vector<std::string> Scene::elementNames() const {
  if (!writes(deck::OutputField::Stress)) return {};
  return {"stress_xx", "stress_yy", "stress_zz", "stress_xy", "stress_yz", "stress_zx"};
}

std::vector<std::vector<double>> Scene::nodalValues(const path::Vector& u, double lambda) const {
  const int numNodes = mesh_.numNodes();
  std::vector<std::vector<double>> result;
  const auto split = [&](const std::vector<double>& field) {
    for (int i = 0; i < 3; ++i) {
      std::vector<double> component(numNodes);
      for (int n = 0; n < numNodes; ++n) component[n] = field[3 * static_cast<std::size_t>(n) + i];
      result.push_back(std::move(component));
    }
  };
  if (writes(deck::OutputField::Displacement)) split(fem::FeProblem::values(u));
  if (writes(deck::OutputField::Reaction)) split(problem_->reactions(u, lambda));
  if (writes(deck::OutputField::Contact) && !contacts_.empty()) {
    // Point values to nodes: means weighted by weight * N^2 (positive, also at the corners of serendipity faces).
    // Nodes that carry no contact show zero.
    std::vector<double> gap(numNodes, 0.0), pressure(numNodes, 0.0), share(numNodes, 0.0);
    for (const ContactPoints& contact : contacts_)
      forEachPoint(*problem_, contact, u, [&](std::size_t t, int p, const double* gapAndPressure) {
        const fem::PointSet& points = contact.points[t];
        const int N = points.nodesPerEntity, e = p / points.pointsPerEntity;
        for (int n = 0; n < N; ++n) {
          const double shape = points.shape[static_cast<std::size_t>(p) * N + n];
          const double w = points.weights[p] * shape * shape;
          const int node = points.nodes[static_cast<std::size_t>(e) * N + n];
          gap[node] += w * gapAndPressure[0];
          pressure[node] += w * gapAndPressure[1];
          share[node] += w;
        }
      });
    for (int n = 0; n < numNodes; ++n)
      if (share[n] > 0) {
        gap[n] /= share[n];
        pressure[n] /= share[n];
      }
    result.push_back(std::move(gap));
    result.push_back(std::move(pressure));
  }
  return result;
}

std::vector<std::vector<double>> Scene::elementValues(const path::Vector& u) const {
  if (!writes(deck::OutputField::Stress)) return {};
  std::vector<std::vector<double>> result(6);
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const fem::Term& term = problem_->term(blockTerms_[b]);
    const fem::PointValues observed = term.observe(fem::field(u));
    const int points = static_cast<int>(observed.values.size()) / 6 / term.numEntities();
    for (int e = 0; e < term.numEntities(); ++e)
      for (int i = 0; i < 6; ++i) {
        double mean = 0;
        for (int q = 0; q < points; ++q) mean += observed.values[(static_cast<std::size_t>(e) * points + q) * 6 + i];
        result[i].push_back(mean / points);
      }
  }
  return result;
}

}  // namespace atrapos
