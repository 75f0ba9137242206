#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <limits>

#include "Scene.hpp"
#include "atrapos/linear/Dot.hpp"

// What a scene shows of a state: stops, monitors, fields.
namespace atrapos {
namespace {

const std::vector<std::string> kStressNames = {"stress_xx", "stress_yy", "stress_zz",
                                               "stress_xy", "stress_yz", "stress_zx"};

int componentIndex(deck::Component c) { return static_cast<int>(c); }

/// Calls f on each term's points of a contact: f(point set, values, first value of point).
template <class F>
void forEachPoint(const fem::FeProblem& problem, const ContactPoints& contact, const path::Vector& u,
                  double lambda, const F& f) {
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    const fem::PointValues observed = problem.term(contact.terms[t]).observe(fem::field(u), lambda);
    const int M = static_cast<int>(observed.names.size());
    for (int p = 0; p < contact.points[t].numPoints(); ++p)
      f(t, p, &observed.values[static_cast<std::size_t>(p) * M]);
  }
}

}  // namespace

void Scene::addMonitors() {
  for (const deck::Monitor& monitor : deck_.output.monitors) {
    linear::RCP<path::Vector> weights;
    if (const auto* m = std::get_if<deck::DisplacementMonitor>(&monitor.quantity)) {
      weights = linear::rcp(new path::Vector(problem_->map()));
      const auto nodes = nodesOf(m->set);
      const double each = m->reduce == deck::DisplacementMonitor::Reduce::Mean ? 1.0 / nodes.size() : 1.0;
      for (int n : nodes) weights->sumIntoLocalValue(3 * n + componentIndex(m->component), each);
    }
    displacementWeights_.push_back(weights);
  }
}

path::Stops Scene::stops() const {
  path::Stops stops;
  const deck::Stop& stop = deck_.path.stop;
  stops.loadFactors = stop.loadFactors;
  if (stop.pathLength) stops.pathLength = *stop.pathLength;
  for (const auto& [name, values] : stop.monitors)
    for (std::size_t i = 0; i < displacementWeights_.size(); ++i)
      if (deck_.output.monitors[i].name == name)
        for (const double value : values) stops.functionals.push_back({name, displacementWeights_[i], value});
  return stops;
}

std::vector<std::string> Scene::monitorNames() const {
  std::vector<std::string> names;
  for (const deck::Monitor& monitor : deck_.output.monitors) names.push_back(monitor.name);
  return names;
}

std::vector<path::Monitor> Scene::functionals() const {
  std::vector<path::Monitor> list;
  for (std::size_t i = 0; i < displacementWeights_.size(); ++i)
    if (!displacementWeights_[i].is_null())
      list.push_back({deck_.output.monitors[i].name, displacementWeights_[i]});
  return list;
}

ContactState Scene::contactState(const ContactPoints& contact, const path::Vector& u, double lambda) const {
  const auto& entry = *std::find_if(deck_.contacts.begin(), deck_.contacts.end(),
                                    [&](const deck::Contact& c) { return c.name == contact.name; });
  ContactState state;
  forEachPoint(*problem_, contact, u, lambda, [&](std::size_t t, int p, const double* gapAndPressure) {
    const double gap = gapAndPressure[0], pressure = gapAndPressure[1];
    const double turn =
        entry.stiffness ? 2 * entry.regularisation / *entry.stiffness : 1e-3 * contact.gaps[t][p];
    state.active += gap <= turn;
    state.normalForce += contact.points[t].weights[p] * pressure;
  });
  return state;
}

std::array<double, 3> Scene::contactResultant(const ContactPoints& contact, const path::Vector& u,
                                              double lambda) const {
  std::array<double, 3> resultant{0, 0, 0};
  for (int t : contact.terms) {
    const auto force = problem_->forces(problem_->term(t), u, lambda);
    for (std::size_t d = 0; d < force.size(); ++d) resultant[d % 3] -= force[d];
  }
  return resultant;
}

std::vector<double> Scene::monitors(const path::Vector& u, double lambda) const {
  std::vector<double> result;
  struct Evaluator {
    const Scene& scene;
    const path::Vector& u;
    double lambda;
    const path::Vector* weights;
    double operator()(const deck::DisplacementMonitor&) const { return linear::dot(*weights, u); }
    double operator()(const deck::ContactForceMonitor& m) const {
      for (const ContactPoints& contact : scene.contacts_)
        if (contact.name == m.contact)
          return m.component == deck::Component::Normal
                     ? scene.contactState(contact, u, lambda).normalForce
                     : scene.contactResultant(contact, u, lambda)[componentIndex(m.component)];
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
  for (std::size_t i = 0; i < deck_.output.monitors.size(); ++i)
    result.push_back(std::visit(Evaluator{*this, u, lambda, displacementWeights_[i].get()},
                                deck_.output.monitors[i].quantity));
  return result;
}

bool Scene::writes(deck::OutputField field) const {
  const auto& fields = deck_.output.fields;
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

std::vector<std::string> Scene::nodalNames() const {
  std::vector<std::string> names;
  if (writes(deck::OutputField::Displacement)) names.insert(names.end(), {"displ_x", "displ_y", "displ_z"});
  if (writes(deck::OutputField::Reaction))
    names.insert(names.end(), {"reaction_x", "reaction_y", "reaction_z"});
  if (writes(deck::OutputField::Contact) && !contacts_.empty())
    names.insert(names.end(), {"contact_gap", "contact_pressure"});
  if (writes(deck::OutputField::NodalStress))
    for (const std::string& name : kStressNames) names.push_back("nodal_" + name);
  return names;
}

std::vector<std::string> Scene::elementNames() const {
  if (!writes(deck::OutputField::Stress)) return {};
  return kStressNames;
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
    for (auto& variable : nodalContact(u, lambda)) result.push_back(std::move(variable));
  }
  if (writes(deck::OutputField::NodalStress))
    for (auto& variable : nodalStress(u, lambda)) result.push_back(std::move(variable));
  return result;
}

std::vector<std::vector<double>> Scene::nodalContact(const path::Vector& u, double lambda) const {
  // Point values to nodes: means weighted by weight * N^2 (positive, also at the corners of serendipity
  // faces). Nodes that carry no contact show zero.
  const int numNodes = mesh_.numNodes();
  std::vector<double> gap(numNodes, 0.0), pressure(numNodes, 0.0), share(numNodes, 0.0);
  for (const ContactPoints& contact : contacts_)
    forEachPoint(*problem_, contact, u, lambda, [&](std::size_t t, int p, const double* gapAndPressure) {
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
  return {std::move(gap), std::move(pressure)};
}

std::vector<std::vector<double>> Scene::nodalStress(const path::Vector& u, double lambda) const {
  // Each element's cubature values fitted and taken to its nodes, then the mean over the elements at a node.
  const int numNodes = mesh_.numNodes();
  std::vector<std::vector<double>> stress(6, std::vector<double>(numNodes, 0.0));
  std::vector<int> elementsAt(numNodes, 0);
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const fem::Block& block = mesh_.blocks[b];
    const fem::Term& term = problem_->term(solids_[b].term);
    const auto& toNodes = solids_[b].toNodes;
    const auto values = term.observe(fem::field(u), lambda).values;
    const int N = term.nodesPerEntity(), Q = static_cast<int>(toNodes.size()) / N;
    for (int e = 0; e < term.numEntities(); ++e)
      for (int n = 0; n < N; ++n) {
        const int node = block.nodes[static_cast<std::size_t>(e) * N + n];
        ++elementsAt[node];
        for (int q = 0; q < Q; ++q)
          for (int i = 0; i < 6; ++i)
            stress[i][node] += toNodes[n * Q + q] * values[(static_cast<std::size_t>(e) * Q + q) * 6 + i];
      }
  }
  for (auto& component : stress)
    for (int n = 0; n < numNodes; ++n)
      if (elementsAt[n] > 0) component[n] /= elementsAt[n];
  return stress;
}

std::vector<std::vector<double>> Scene::elementValues(const path::Vector& u, double lambda) const {
  if (!writes(deck::OutputField::Stress)) return {};
  std::vector<std::vector<double>> result(6);
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const fem::Term& term = problem_->term(solids_[b].term);
    const fem::PointValues observed = term.observe(fem::field(u), lambda);
    const int points = static_cast<int>(observed.values.size()) / 6 / term.numEntities();
    for (int e = 0; e < term.numEntities(); ++e)
      for (int i = 0; i < 6; ++i) {
        double mean = 0;
        for (int q = 0; q < points; ++q)
          mean += observed.values[(static_cast<std::size_t>(e) * points + q) * 6 + i];
        result[i].push_back(mean / points);
      }
  }
  return result;
}

}  // namespace atrapos
