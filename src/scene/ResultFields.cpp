#include "scene/ResultFields.hpp"

#include <algorithm>
#include <cmath>

#include "atrapos/solid/MixedBody.hpp"
#include "atrapos/solid/ShellResults.hpp"
#include "scene/ShellFields.hpp"

// What the result file holds of a state.
namespace atrapos {
namespace {

using Fields = std::vector<std::vector<double>>;

std::vector<std::string> stressNames(const std::string& prefix) {
  std::vector<std::string> names;
  for (const char* component : {"xx", "yy", "zz", "xy", "yz", "zx"}) names.push_back(prefix + component);
  return names;
}

void append(const std::vector<std::string>& more, std::vector<std::string>& names) {
  names.insert(names.end(), more.begin(), more.end());
}

void append(Fields more, Fields& fields) {
  for (auto& variable : more) fields.push_back(std::move(variable));
}

/// The named values [first, end) of all points.
std::vector<double> columns(const fem::PointValues& shown, std::size_t first, std::size_t end) {
  std::vector<double> result;
  for (std::size_t i = 0; i < shown.values.size(); i += shown.names.size())
    result.insert(result.end(), &shown.values[i] + first, &shown.values[i] + end);
  return result;
}

/// Sums of stresses at nodes, and how many.
struct NodalMeans {
  Fields sums;
  std::vector<int> count;

  explicit NodalMeans(std::size_t nodes) : sums(6, std::vector<double>(nodes, 0.0)), count(nodes, 0) {}

  /// Adds sum over q of weight[q] values[q step + component].
  void add(std::size_t node, const double* weights, int points, const double* values, int step) {
    ++count[node];
    for (int q = 0; q < points; ++q)
      for (int i = 0; i < 6; ++i)
        sums[i][node] += weights[q] * values[static_cast<std::size_t>(q) * step + i];
  }

  Fields means() && {
    for (auto& component : sums)
      for (std::size_t n = 0; n < component.size(); ++n)
        if (count[n] > 0) component[n] /= count[n];
    return std::move(sums);
  }
};

}  // namespace

bool ResultFields::writes(deck::OutputField field) const {
  const auto& fields = deck_.output.fields;
  return std::find(fields.begin(), fields.end(), field) != fields.end();
}

std::vector<std::string> ResultFields::nodalNames() const {
  std::vector<std::string> names;
  const auto appendVector = [&](const std::string& prefix) {
    for (int i = 0; i < mesh_.dimension; ++i) names.push_back(prefix + "xyz"[i]);
  };
  if (writes(deck::OutputField::Displacement)) {
    appendVector("displ_");
    if (!shells_.empty()) append({"director_x", "director_y", "director_z", "thickness_change"}, names);
  }
  if (writes(deck::OutputField::Field)) append(deck::scalarFields(deck_), names);
  if (writes(deck::OutputField::Reaction)) appendVector("reaction_");
  if (writes(deck::OutputField::Contact) && !scene_.contacts().empty())
    append({"contact_gap", "contact_pressure"}, names);
  if (writes(deck::OutputField::NodalStress)) {
    append(stressNames("nodal_stress_"), names);
    if (!shells_.empty() && !body_) {
      append(stressNames("nodal_stress_top_"), names);
      append(stressNames("nodal_stress_bottom_"), names);
    }
  }
  return names;
}

bool ResultFields::yields() const {
  return std::any_of(deck_.materials.begin(), deck_.materials.end(), [](const deck::Material& material) {
    return std::holds_alternative<deck::VonMises>(material.law);
  });
}

std::vector<std::string> ResultFields::elementNames() const {
  if (!writes(deck::OutputField::Stress)) return {};
  std::vector<std::string> names = stressNames("stress_");
  if (!shells_.empty()) {
    append(stressNames("stress_top_"), names);
    append(stressNames("stress_bottom_"), names);
    append(solid::ShellResultants::names(), names);
  }
  if (yields()) names.push_back("equivalent_plastic_strain");
  return names;
}

std::vector<double> ResultFields::onResultNodes(std::vector<double> ofMesh) const {
  if (!body_) return ofMesh;
  for (int node : shells_.geometry.meshNode) ofMesh.insert(ofMesh.end(), 2, ofMesh[node]);
  return ofMesh;
}

void ResultFields::fillPressures(const std::string& field, std::vector<double>& nodes) const {
  for (const deck::Physics& entry : deck_.physics) {
    const auto* flow = std::get_if<deck::FluidFlow>(&entry.law);
    if (flow == nullptr || flow->pressure != field) continue;
    for (const std::string& name : entry.blocks) {
      const fem::Block& block = mesh_.blocks[fem::findBlock(mesh_, name)];
      const auto values = solid::pressuresAtNodes(block, [&](int node) { return nodes[node]; });
      for (std::size_t i = 0; i < block.nodes.size(); ++i) nodes[block.nodes[i]] = values[i];
    }
  }
}

std::vector<std::vector<double>> ResultFields::nodalValues(const SceneState& state) const {
  Fields result;
  const auto split = [&](const std::vector<double>& field) {
    for (int i = 0; i < mesh_.dimension; ++i) {
      std::vector<double> component(scene_.resultMesh().numNodes());
      for (std::size_t n = 0; n < component.size(); ++n) component[n] = field[3 * n + i];
      result.push_back(std::move(component));
    }
  };
  const std::vector<double>& values = state.displacements();
  if (writes(deck::OutputField::Displacement)) {
    split(body_ ? body_->displacements(shells_.geometry, values) : values);
    if (!shells_.empty())
      for (auto& variable : directorFields(shells_, values))
        result.push_back(onResultNodes(std::move(variable)));
  }
  if (writes(deck::OutputField::Field)) {
    const fem::DofMap& dofs = scene_.problem().model().dofs;
    for (const std::string& name : deck::scalarFields(deck_)) {
      const int field = dofs.find(name);
      std::vector<double> nodes(mesh_.numNodes(), 0.0);
      for (int n = 0; n < mesh_.numNodes(); ++n)
        if (const int dof = dofs.dof(field, n, 0); dof >= 0) nodes[n] = state.values()[dof];
      fillPressures(name, nodes);
      result.push_back(onResultNodes(std::move(nodes)));
    }
  }
  if (writes(deck::OutputField::Reaction)) {
    const std::vector<double> reactions = scene_.reactions(state);
    split(body_ ? body_->forces(shells_.geometry, reactions) : reactions);
  }
  if (writes(deck::OutputField::Contact) && !scene_.contacts().empty())
    for (auto& variable : nodalContact(state)) result.push_back(onResultNodes(std::move(variable)));
  if (writes(deck::OutputField::NodalStress)) append(nodalStress(state), result);
  return result;
}

std::vector<std::vector<double>> ResultFields::nodalContact(const SceneState& state) const {
  // Point values to nodes: means weighted by weight * N^2 (positive, also at the corners of serendipity
  // faces). Nodes that carry no contact show zero; so do directors, whose nodes show it.
  const int numNodes = mesh_.numNodes();
  std::vector<double> gap(numNodes, 0.0), pressure(numNodes, 0.0), share(numNodes, 0.0);
  for (const ContactPoints& contact : scene_.contacts())
    scene_.forEachContactPoint(contact, state, [&](std::size_t t, int p, const double* gapAndPressure) {
      const fem::PointSet& points = contact.points[t];
      const int N = points.nodesPerEntity, e = p / points.pointsPerEntity;
      if (std::isinf(gapAndPressure[0])) return;  // over no part of the tool
      for (int n = 0; n < N; ++n) {
        const int node = points.nodes[static_cast<std::size_t>(e) * N + n];
        if (node >= numNodes) continue;
        const double shape = points.shape[static_cast<std::size_t>(p) * N + n];
        const double w = points.weights[p] * shape * shape;
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

std::vector<std::vector<double>> ResultFields::nodalStress(const SceneState& state) const {
  // Each element's cubature values fitted and taken to its nodes, then the mean over the elements at a node.
  // With bodies of shells each of their nodes has its own; otherwise a node has middle, top and bottom.
  const std::size_t meshNodes = mesh_.numNodes();
  const bool surfaces = !shells_.empty() && !body_;
  std::vector<NodalMeans> means(surfaces ? 3 : 1, NodalMeans(scene_.resultMesh().numNodes()));
  for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
    const BodyBlock& body = scene_.bodies()[b];
    if (body.term < 0) continue;  // no stress where there is no material
    const fem::Block& block = mesh_.blocks[b];
    const auto& observed = state.observed(body.term);
    const int N = fem::nodesPerElement(block.topology), Q = static_cast<int>(body.toNodes.size()) / N;
    for (int layer = 0; layer < 3; ++layer) {
      constexpr double zetas[3] = {solid::midSurface, solid::topSurface, solid::bottomSurface};
      if (body.shells < 0 && layer > 0 && !surfaces) break;
      const auto values = body.shells < 0
                              ? columns(observed, 0, 6)
                              : solid::surfaceStress(observed, shells_.cubature[body.shells], zetas[layer]);
      const int elements = static_cast<int>(block.nodes.size()) / N;
      for (int e = 0; e < elements; ++e)
        for (int n = 0; n < N; ++n) {
          std::size_t node = block.nodes[static_cast<std::size_t>(e) * N + n];
          if (body_ && layer > 0) {  // bottom and top of the director
            const auto& nodes = shells_.elements[body.shells].nodes;
            const std::size_t director = nodes[static_cast<std::size_t>(e) * 2 * N + N + n] - meshNodes;
            node = meshNodes + 2 * director + (layer == 1 ? 1 : 0);
          }
          means[surfaces ? layer : 0].add(node, &body.toNodes[static_cast<std::size_t>(n) * Q], Q,
                                          &values[static_cast<std::size_t>(e) * Q * 6], 6);
        }
    }
  }
  Fields result;
  for (NodalMeans& m : means) append(std::move(m).means(), result);
  return result;
}

std::vector<std::vector<double>> ResultFields::elementValues(const SceneState& state) const {
  if (!writes(deck::OutputField::Stress)) return {};
  Fields result(elementNames().size());
  const auto add = [&](std::size_t first, const std::vector<double>& values, std::size_t each) {
    for (std::size_t i = 0; i < values.size(); ++i) result[first + i % each].push_back(values[i]);
  };
  for (const BodyBlock& body : scene_.bodies()) {
    const fem::Block& block = mesh_.blocks[&body - scene_.bodies().data()];
    const std::size_t elements = block.nodes.size() / fem::nodesPerElement(block.topology);
    if (body.term < 0) {
      for (auto& variable : result) variable.insert(variable.end(), elements, 0.0);
      continue;
    }
    const fem::PointValues& observed = state.observed(body.term);
    const std::size_t points = observed.values.size() / observed.names.size() / elements;
    if (yields()) {
      const bool shown = observed.names.size() > 6;
      const auto strain =
          shown ? meansOverPoints(columns(observed, 6, 7), points, 1) : std::vector<double>(elements);
      add(result.size() - 1, strain, 1);
    }
    if (body.shells >= 0) {
      const solid::ShellCubature& cubature = shells_.cubature[body.shells];
      add(0, meanSurfaceStress(shells_.elements[body.shells], observed, cubature, solid::midSurface), 6);
      add(6, meanSurfaceStress(shells_.elements[body.shells], observed, cubature, solid::topSurface), 6);
      add(12, meanSurfaceStress(shells_.elements[body.shells], observed, cubature, solid::bottomSurface), 6);
      add(18, meanResultants(shells_.elements[body.shells], observed, cubature, state.displacements()), 8);
      continue;
    }
    const auto means = meansOverPoints(columns(observed, 0, 6), points, 6);
    add(0, means, 6);
    if (shells_.empty()) continue;
    add(6, means, 6);
    add(12, means, 6);
    add(18, std::vector<double>(8 * elements, 0.0), 8);
  }
  return result;
}

}  // namespace atrapos
