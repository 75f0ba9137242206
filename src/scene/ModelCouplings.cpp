// The deck's couplings as linear couplings and rigid bodies.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "atrapos/fem/RigidBody.hpp"
#include "atrapos/fem/Tie.hpp"
#include "scene/Degrees.hpp"
#include "scene/ModelMaker.hpp"
#include "scene/Sets.hpp"

namespace atrapos {

namespace {

using Kind = deck::Coupling::Kind;

/// The node that leads a rigid body; -1: none does.
int referenceOf(const fem::Mesh& mesh, const deck::Coupling& coupling) {
  return coupling.reference.empty() ? -1 : nodesOf(mesh, coupling.reference).front();
}

/// v . n of all nodes is that of the first, and directors stay in the plane: w . n = 0.
void addPlane(const deck::Vector3& normal, const std::vector<int>& nodes, const fem::ShellGeometry& shells,
              fem::FeModel& model) {
  fem::couplePlane(model.couplings, model.dofs, nodes, normal);
  int pivot = 0;
  for (int i = 1; i < 3; ++i)
    if (std::abs(normal[i]) > std::abs(normal[pivot])) pivot = i;
  for (int node : nodes)
    for (int director : shells.directorNodes(node)) {
      fem::Coupling c;
      const int first = model.dofs.firstDof(director);
      c.dof = first + pivot;
      for (int i = 0; i < 3; ++i)
        if (i != pivot && normal[i] != 0) c.masters.push_back({first + i, -normal[i] / normal[pivot]});
      model.couplings.add(std::move(c));
    }
}

/// The nodes and their directors on one rigid body, about their centre or a node `reference` of it (-1:
/// none), which leads: what supports it supports the body.
fem::RigidBody addRigid(const fem::Mesh& mesh, const std::vector<int>& nodes, int reference,
                        const fem::ShellGeometry& shells, double youngsModulus, fem::FeModel& model) {
  const auto X = [&](int node) {
    const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(node)];
    return std::array<double, 3>{x[0], x[1], x[2]};
  };
  std::array<double, 3> centre{};
  if (reference >= 0)
    centre = X(reference);
  else
    for (int node : nodes)
      for (int i = 0; i < 3; ++i) centre[i] += X(node)[i] / static_cast<double>(nodes.size());
  double size = 0;
  const auto directorOf = [&](int director) {
    return &shells.directors[3 * static_cast<std::size_t>(director - shells.numMeshNodes)];
  };
  for (int node : nodes) {
    size = std::max(size, std::hypot(X(node)[0] - centre[0], X(node)[1] - centre[1], X(node)[2] - centre[2]));
    for (int director : shells.directorNodes(node)) {
      const double* D = directorOf(director);
      size = std::max(size, std::hypot(D[0], D[1], D[2]));
    }
  }
  const double arms = size > 0 ? size : 1.0;
  const fem::RigidBody body(model, centre, arms, youngsModulus * arms);
  if (reference >= 0) fem::coupleEqual(model.couplings, model.dofs, {reference, body.originNode()});
  for (int node : nodes) {
    if (node != reference) body.attach(model, node, X(node));
    for (int director : shells.directorNodes(node)) {
      const double* D = directorOf(director);
      body.attachDirector(model, director, {D[0], D[1], D[2]});
    }
  }
  return body;
}

}  // namespace

ModelMaker::SolidSide ModelMaker::solidNodesAt(const deck::Coupling& coupling, int director) const {
  const fem::ShellGeometry& g = shells_.geometry;
  const int shellNode = g.meshNode[director - g.numMeshNodes];
  const double* D = &g.directors[3 * static_cast<std::size_t>(director - g.numMeshNodes)];
  const double* X = &mesh_.coordinates[3 * static_cast<std::size_t>(shellNode)];
  const double half = std::hypot(D[0], D[1], D[2]);
  // A thousandth of the thickness: meshes of both parts are made to fit, up to rounding in their files.
  const double near = 1e-3;
  std::map<int, double> onDirector;  // node of a solid -> zeta
  for (const fem::Block& block : mesh_.blocks) {
    if (!fem::isSolid(block.topology)) continue;
    for (int n : block.nodes) {
      const double* Y = &mesh_.coordinates[3 * static_cast<std::size_t>(n)];
      const double d[3] = {Y[0] - X[0], Y[1] - X[1], Y[2] - X[2]};
      const double zeta = (d[0] * D[0] + d[1] * D[1] + d[2] * D[2]) / (half * half);
      const double off = std::hypot(d[0] - zeta * D[0], d[1] - zeta * D[1], d[2] - zeta * D[2]);
      if (off < near * half && std::abs(zeta) < 1 + near) onDirector[n] = zeta;
    }
  }
  SolidSide side;
  for (const auto& [node, zeta] : onDirector) {
    if (zeta > 1 - near)
      side.top = node;
    else if (zeta < -1 + near)
      side.bottom = node;
    else if (node != shellNode)
      side.between.push_back({node, zeta});
  }
  if (side.top < 0 || side.bottom < 0)
    fail("couplings/" + coupling.name + "/set",
         fmt::format("no node of a solid at the {} of the shell's node {}", side.top < 0 ? "top" : "bottom",
                     mesh_.nodeNumber(shellNode)));
  return side;
}

void ModelMaker::addHinge(const deck::Coupling& coupling, const fem::RigidBody& body) {
  if (!coupling.axis) return;
  const int node = body.hinge(made_.model, *coupling.axis);
  // No turn across the axis, and none about it where its angle is given.
  const deck::Vector3& a = *coupling.axis;
  const double square = a[0] * a[0] + a[1] * a[1] + a[2] * a[2];
  for (int i = 0; i < 3; ++i) {
    fem::HeldDirection held{nodesOf(mesh_, coupling.set).front(), {}, true};
    for (int j = 0; j < 3; ++j)
      held.direction[j] = (i == j ? 1 : 0) - (coupling.angle ? 0 : a[i] * a[j] / square);
    held_.push_back(held);
  }
  made_.hinges[coupling.name] = node;
  if (const auto& angle = coupling.angle)
    made_.model.prescribe(node, 0, radians(angle->value), radians(angle->perLoadFactor));
}

std::vector<int> ModelMaker::setOf(const deck::Coupling& coupling) const {
  return coupling.set.empty() ? std::vector<int>{} : nodesOf(mesh_, coupling.set);
}

void ModelMaker::addTie(const deck::Coupling& coupling) {
  const std::string path = "couplings/" + coupling.name;
  fem::TieOptions options;
  if (coupling.reach) options.reach = *coupling.reach;
  options.axisymmetric = plane_ && plane_->kind == solid::PlaneSection::Kind::axisymmetric;
  const fem::Tie tie = made(path, [&] {
    return fem::tieSurfaces(mesh_, sidesOf(mesh_, coupling.set), sidesOf(mesh_, coupling.to), options);
  });
  for (const fem::TiedNode& node : tie.nodes) joined_.push_back({node.node, node.masters.front().node});
  std::vector<std::string> fields;
  if (const std::string displacement = fem::displacementField().name;
      made_.model.dofs.find(displacement) >= 0)
    fields.push_back(displacement);
  const std::vector<std::string> there = scalarFieldsOf(sidesOf(mesh_, coupling.to));
  for (const std::string& field : scalarFieldsOf(sidesOf(mesh_, coupling.set)))
    if (isVelocity(field))
      fail(path, "joins a flow, which ties do not");
    else if (std::find(there.begin(), there.end(), field) != there.end())
      fields.push_back(field);
  fem::couple(made_.model, tie, fields);
  made_.ties.push_back(
      {coupling.name, static_cast<int>(tie.nodes.size()), static_cast<int>(tie.open.size()), tie.largestGap});
}

void ModelMaker::addEquation(const deck::Coupling& coupling) {
  const std::string key = "couplings/" + coupling.name + "/terms";
  std::vector<std::vector<int>> dofs;  // [term][node]
  for (const deck::EquationTerm& term : coupling.terms) {
    const std::size_t axis = std::string("xyz").find(term.unknown);
    const std::string name = axis < 3 ? fem::displacementField().name : term.unknown;
    const int field = made_.model.dofs.find(name);
    dofs.emplace_back();
    for (const int node : nodesOf(mesh_, term.set)) {
      const int component = axis < 3 ? static_cast<int>(axis) : 0;
      dofs.back().push_back(field < 0 ? -1 : made_.model.dofs.dof(field, node, component));
      if (dofs.back().back() < 0)
        fail(key, fmt::format("node {} of '{}' has no {}", mesh_.nodeNumber(node), term.set, name));
    }
    if (dofs.back().size() != 1 && dofs.back().size() != dofs.front().size())
      fail(key, fmt::format("'{}' has {} nodes and '{}' has {}; expected as many, or one",
                            coupling.terms[0].set, dofs.front().size(), term.set, dofs.back().size()));
  }
  for (std::size_t n = 0; n < dofs.front().size(); ++n) {
    fem::Coupling c;
    c.dof = dofs[0][n];
    for (std::size_t t = 1; t < dofs.size(); ++t) {
      c.masters.push_back(
          {dofs[t][dofs[t].size() == 1 ? 0 : n], -coupling.terms[t].factor / coupling.terms[0].factor});
      joined_.push_back({made_.model.dofs.nodeOf(c.dof), made_.model.dofs.nodeOf(c.masters.back().dof)});
    }
    made_.model.couplings.add(std::move(c));
  }
}

void ModelMaker::addCouplings() {
  const fem::ShellGeometry& g = shells_.geometry;
  std::vector<const deck::Coupling*> couplings;
  for (const deck::Coupling& coupling : deck_.couplings) couplings.push_back(&coupling);
  // Ties leave what else has a hold of.
  std::stable_partition(couplings.begin(), couplings.end(),
                        [](const deck::Coupling* c) { return c->kind != Kind::Tie; });
  for (const deck::Coupling* entry : couplings) {
    const deck::Coupling& coupling = *entry;
    try {
      const std::vector<int> nodes = setOf(coupling);
      switch (coupling.kind) {
        case Kind::Equal:
          fem::coupleEqual(made_.model.couplings, made_.model.dofs, nodes);
          break;
        case Kind::Plane:
          addPlane(*coupling.normal, nodes, g, made_.model);
          break;
        case Kind::Rigid:
          addHinge(coupling, addRigid(mesh_, nodes, referenceOf(mesh_, coupling), g,
                                      deck::largestYoungsModulus(deck_), made_.model));
          break;
        case Kind::ShellOnSolid:
          for (int node : nodes)
            for (int director : g.directorNodes(node)) {
              const SolidSide side = solidNodesAt(coupling, director);
              fem::coupleShellToSolid(made_.model.couplings, made_.model.dofs, node, director, side.top,
                                      side.bottom);
              for (const auto& [between, zeta] : side.between)
                fem::coupleNode(made_.model.couplings, made_.model.dofs, between,
                                {{side.top, 0.5 * (1 + zeta)}, {side.bottom, 0.5 * (1 - zeta)}});
            }
          break;
        case Kind::Tie:
          addTie(coupling);
          break;
        case Kind::Equation:
          addEquation(coupling);
          break;
      }
      made_.model.couplings.resolved(
          made_.model.dofs,
          made_.model.supports);  // each entry by itself, so that its name is known
    } catch (const std::invalid_argument& e) {
      fail("couplings/" + coupling.name, e.what());
    }
  }
}

std::vector<std::pair<int, int>> ModelMaker::joinedNodes() const {
  std::vector<std::pair<int, int>> joined = joined_;
  for (const deck::Coupling& coupling : deck_.couplings) {
    const std::vector<int> nodes = setOf(coupling);
    if (coupling.kind == Kind::Rigid) {
      for (int node : nodes) joined.push_back({nodes[0], node});
      if (const int reference = referenceOf(mesh_, coupling); reference >= 0)
        joined.push_back({nodes[0], reference});
    }
    if (coupling.kind == Kind::ShellOnSolid)
      for (int node : nodes)
        for (int director : shells_.geometry.directorNodes(node))
          joined.push_back({node, solidNodesAt(coupling, director).top});
  }
  return joined;
}

}  // namespace atrapos
