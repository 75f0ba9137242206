#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "atrapos/linear/Dot.hpp"
#include "scene/ContactMoments.hpp"
#include "scene/Degrees.hpp"
#include "scene/Scene.hpp"
#include "scene/Sets.hpp"

// What a scene watches along the path: stops, monitors, contact.
namespace atrapos {
namespace {

int componentIndex(deck::Component c) { return static_cast<int>(c); }

int nearestNode(const fem::Mesh& mesh, const std::vector<int>& nodes, const deck::Vector3& place) {
  const auto distance = [&](int n) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    return std::hypot(x[0] - place[0], x[1] - place[1], x[2] - place[2]);
  };
  return *std::min_element(nodes.begin(), nodes.end(),
                           [&](int a, int b) { return distance(a) < distance(b); });
}

/// Calls f(term of the contact, point, position) for all points.
template <class F>
void forEachPosition(const ContactPoints& contact, const F& f) {
  for (std::size_t t = 0; t < contact.points.size(); ++t)
    for (int p = 0; p < contact.points[t].numPoints(); ++p)
      f(t, p, &contact.points[t].positions[3 * static_cast<std::size_t>(p)]);
}

/// Term and point of the contact point that is nearest to a place, the first of several.
std::pair<std::size_t, int> nearestPoint(const ContactPoints& contact, const deck::Vector3& place) {
  double nearest = std::numeric_limits<double>::infinity();
  std::pair<std::size_t, int> found{0, 0};
  forEachPosition(contact, [&](std::size_t t, int p, const double* x) {
    const double distance = std::hypot(x[0] - place[0], x[1] - place[1], x[2] - place[2]);
    if (!(distance < nearest)) return;
    nearest = distance;
    found = {t, p};
  });
  return found;
}

/// [term][point] of a contact: the weights of the points that a monitor adds up, zero of all others.
std::vector<std::vector<double>> weightsNear(const ContactPoints& contact,
                                             const deck::ContactForceMonitor& monitor) {
  const auto [term, point] = nearestPoint(contact, *monitor.near);
  const double* origin = &contact.points[term].positions[3 * static_cast<std::size_t>(point)];
  const deck::Vector3 a = monitor.along.value_or(deck::Vector3{});
  const double length = std::hypot(a[0], a[1], a[2]);
  std::vector<std::vector<double>> weights;
  for (const fem::PointSet& points : contact.points) weights.emplace_back(points.numPoints(), 0.0);
  bool found = false;
  forEachPosition(contact, [&](std::size_t t, int p, const double* x) {
    const double d[3] = {x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]};
    const double distance = std::hypot(d[0], d[1], d[2]);
    if (!monitor.along && (distance > 0 || found)) return;  // one point, even where two are at a place
    // Coordinates in a mesh file are exact to rounding, or to the six digits of a text that they came from.
    if (monitor.along && std::hypot(a[1] * d[2] - a[2] * d[1], a[2] * d[0] - a[0] * d[2],
                                    a[0] * d[1] - a[1] * d[0]) > 1e-5 * length * distance)
      return;
    weights[t][p] = contact.points[t].weights[p];
    found = true;
  });
  return weights;
}

/// A force along a direction.
double along(const fem::ForceAlong& force, const SceneState& state) {
  double sum = 0;
  for (const fem::CoupledDof& part : force) sum += part.factor * state.slaveForces()[part.dof];
  return sum;
}

}  // namespace

template <class Monitor>
linear::RCP<path::Vector> Scene::weightsOf(const std::string& key, const Monitor& monitor,
                                           const std::string& field, int component) const {
  auto weights = linear::rcp(new path::Vector(problem_->map()));
  auto nodes = nodesOf(mesh_, monitor.set);
  if (monitor.near) nodes = {nearestNode(mesh_, nodes, *monitor.near)};
  const bool mean = monitor.reduce == deck::DisplacementMonitor::Reduce::Mean;
  const double each = mean ? 1.0 / static_cast<double>(nodes.size()) : 1.0;
  const fem::DofMap& dofs = problem_->model().dofs;
  const int number = dofs.find(field);
  for (const int n : nodes) {
    const linear::GlobalIndex dof = number < 0 ? -1 : dofs.dof(number, n, component);
    if (dof < 0)
      deck::failAt(deck_, key + "/set", fmt::format("node {} has no {}", mesh_.nodeNumber(n), field));
    if (problem_->map()->isNodeGlobalElement(dof)) weights->sumIntoGlobalValue(dof, each);
  }
  return weights;
}

void Scene::addMonitors() {
  unknownWeights_.clear();
  contactWeights_.clear();
  for (const deck::Monitor& monitor : deck_.output.monitors) {
    linear::RCP<path::Vector> weights;
    if (const auto* m = std::get_if<deck::DisplacementMonitor>(&monitor.quantity))
      weights = weightsOf("output/monitors/" + monitor.name, *m, fem::displacementField().name,
                          componentIndex(m->component));
    if (const auto* m = std::get_if<deck::FieldMonitor>(&monitor.quantity))
      weights = weightsOf("output/monitors/" + monitor.name, *m, m->field, 0);
    if (const auto* m = std::get_if<deck::RotationMonitor>(&monitor.quantity)) {
      weights = linear::rcp(new path::Vector(problem_->map()));
      const linear::GlobalIndex dof = problem_->model().dofs.firstDof(hinges_.at(m->coupling));
      if (problem_->map()->isNodeGlobalElement(dof)) weights->sumIntoGlobalValue(dof, 1 / radians(1));
    }
    unknownWeights_.push_back(weights);
    std::vector<std::vector<double>> points;
    if (const auto* m = std::get_if<deck::ContactForceMonitor>(&monitor.quantity); m && m->near)
      for (const ContactPoints& contact : contacts_)
        if (contact.name == m->contact) points = weightsNear(contact, *m);
    contactWeights_.push_back(std::move(points));
  }
}

path::Stops Scene::stops() const {
  path::Stops stops;
  const deck::Stop& stop = deck_.path.stop;
  stops.loadFactors = stop.loadFactors;
  if (stop.pathLength) stops.pathLength = *stop.pathLength;
  stops.limitPoints = stop.limitPoint.value_or(0);
  stops.bifurcations = stop.bifurcation.value_or(0);
  for (const auto& [name, values] : stop.monitors)
    for (std::size_t i = 0; i < unknownWeights_.size(); ++i)
      if (deck_.output.monitors[i].name == name)
        for (const double value : values) stops.functionals.push_back({name, unknownWeights_[i], value});
  return stops;
}

std::vector<std::string> Scene::monitorNames() const {
  std::vector<std::string> names;
  for (const deck::Monitor& monitor : deck_.output.monitors) names.push_back(monitor.name);
  return names;
}

void Scene::forEachContactPoint(const ContactPoints& contact, const SceneState& state,
                                const std::function<void(std::size_t, int, const double*)>& f) const {
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    const fem::PointValues& observed = state.observed(contact.terms[t]);
    const int M = static_cast<int>(observed.names.size());
    for (int p = 0; p < contact.points[t].numPoints(); ++p)
      f(t, p, &observed.values[static_cast<std::size_t>(p) * M]);
  }
}

std::vector<path::Monitor> Scene::functionals() const {
  std::vector<path::Monitor> list;
  for (std::size_t i = 0; i < unknownWeights_.size(); ++i)
    if (!unknownWeights_[i].is_null()) list.push_back({deck_.output.monitors[i].name, unknownWeights_[i]});
  return list;
}

ContactState Scene::contactState(const ContactPoints& contact, const SceneState& at) const {
  ContactState state;
  forEachContactPoint(contact, at, [&](std::size_t t, int p, const double* gapAndPressure) {
    const double pressure = gapAndPressure[1];
    const bool active = isClosed(contact, t, p, gapAndPressure);
    state.active += active;
    // Zones say which part of a point's area is in them.
    state.area += contact.points[t].weights[p] * (contact.lines.empty() ? active : gapAndPressure[2]);
    state.normalForce += contact.points[t].weights[p] * pressure;
  });
  return state;
}

double Scene::contactForce(const ContactPoints& contact, const std::vector<std::vector<double>>& weights,
                           const SceneState& state) const {
  double force = 0;
  forEachContactPoint(contact, state, [&](std::size_t t, int p, const double* gapAndPressure) {
    if (weights[t][p] != 0) force += weights[t][p] * gapAndPressure[1];
  });
  return force;
}

std::array<double, 3> Scene::contactResultant(const ContactPoints& contact, const SceneState& state) const {
  std::array<double, 3> resultant{0, 0, 0};
  for (int t : contact.terms) {
    const auto& force = state.forces(t);
    // Forces on the nodes of the mesh: those on directors are couples' arms.
    for (std::size_t d = 0; d < mesh_.coordinates.size(); ++d) resultant[d % 3] -= force[d];
  }
  return resultant;
}

std::vector<double> Scene::reactions(const SceneState& state) const {
  std::vector<double> all = state.reactions();
  for (const auto& support : normalForces_)
    for (const NormalForce& at : support.second) {
      const double force = along(at.force, state);
      for (std::size_t i = 0; i < 3; ++i)
        all[3 * static_cast<std::size_t>(at.node) + i] += force * at.normal[i];
    }
  return all;
}

std::vector<double> Scene::monitors(const SceneState& state) const {
  std::vector<double> result;
  struct Evaluator {
    const Scene& scene;
    const SceneState& state;
    const path::Vector* weights;
    const std::vector<std::vector<double>>& contactWeights;
    double operator()(const deck::DisplacementMonitor&) const { return linear::dot(*weights, state.u()); }
    double operator()(const deck::FieldMonitor&) const { return linear::dot(*weights, state.u()); }
    double operator()(const deck::RotationMonitor&) const { return linear::dot(*weights, state.u()); }
    double operator()(const deck::MomentMonitor& m) const {
      return state.supportForces()[scene.problem_->model().dofs.firstDof(scene.hinges_.at(m.coupling))];
    }
    const ContactPoints& contact(const std::string& name) const {
      return *std::find_if(scene.contacts_.begin(), scene.contacts_.end(),
                           [&](const ContactPoints& c) { return c.name == name; });
    }
    double operator()(const deck::ContactForceMonitor& m) const {
      if (m.near) return scene.contactForce(contact(m.contact), contactWeights, state);
      if (m.component == deck::Component::Normal)
        return scene.contactState(contact(m.contact), state).normalForce;
      return scene.contactResultant(contact(m.contact), state)[componentIndex(m.component)];
    }
    double operator()(const deck::ContactAreaMonitor& m) const {
      return scene.contactState(contact(m.contact), state).area;
    }
    double operator()(const deck::ContactPressureMonitor& m) const {
      const ContactPoints& pressed = contact(m.contact);
      if (!m.near) return largestPressure(pressed, state);
      const auto [term, point] = nearestPoint(pressed, *m.near);
      return pressureAt(pressed, term, point, state);
    }
    double operator()(const deck::ContactCenterMonitor& m) const {
      return contactMoments(contact(m.contact), state, scene.axisymmetric())
          .center[componentIndex(m.component)];
    }
    double operator()(const deck::ContactSpreadMonitor& m) const {
      const auto squares = contactMoments(contact(m.contact), state, scene.axisymmetric(), m.about).squares;
      return std::sqrt(m.component ? squares[componentIndex(*m.component)]
                                   : squares[0] + squares[1] + squares[2]);
    }
    double operator()(const deck::ReactionMonitor& m) const {
      const auto& support = *std::find_if(scene.deck_.supports.begin(), scene.deck_.supports.end(),
                                          [&](const deck::Support& s) { return s.name == m.support; });
      double sum = 0;
      if (!support.field.empty()) {
        const fem::DofMap& dofs = scene.problem_->model().dofs;
        const int field = dofs.find(support.field);
        for (int n : nodesOf(scene.mesh_, support.set)) sum += state.supportForces()[dofs.dof(field, n, 0)];
        return sum;
      }
      if (support.normal) {
        for (const NormalForce& at : scene.normalForces_.at(support.name)) sum += along(at.force, state);
        return sum;
      }
      const int i = componentIndex(*m.component);
      for (int n : nodesOf(scene.mesh_, support.set)) sum += state.reactions()[3 * n + i];
      return sum;
    }
  };
  for (std::size_t i = 0; i < deck_.output.monitors.size(); ++i)
    result.push_back(std::visit(Evaluator{*this, state, unknownWeights_[i].get(), contactWeights_[i]},
                                deck_.output.monitors[i].quantity));
  return result;
}

}  // namespace atrapos
