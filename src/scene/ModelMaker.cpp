// A deck made into unknowns, terms, supports.
#include "scene/ModelMaker.hpp"

#include <fmt/format.h>

#include <Teuchos_DefaultMpiComm.hpp>
#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <set>

#include "atrapos/fem/HeldAlong.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/RigidBody.hpp"
#include "atrapos/fem/ShellFaces.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/solid/MixedBody.hpp"
#include "atrapos/solid/ShellResults.hpp"
#include "machine/Ranks.hpp"
#include "scene/Extents.hpp"
#include "scene/FollowerLoads.hpp"
#include "scene/Registry.hpp"
#include "scene/Sets.hpp"

namespace atrapos {
SceneModel ModelMaker::make() {
  made_.model.comm = Teuchos::rcp(new Teuchos::MpiComm<int>(ranks::communicator()));
  made_.model.dofs = fem::DofMap(mesh_.numNodes(), fields());
  if (!deck_.materials.empty()) made_.model.size = longestSide(mesh_);
  made_.model.dofs.addNodes(shells_.geometry.numDirectors(), fem::directorField());
  addMaterials();
  addFlows();
  addBalances();
  addPluginLaws();
  giveRanks();
  addSupports();
  addInclinedSupports();
  addCouplings();
  if (!shells_.empty()) made_.joints = joinShells(deck_, mesh_, shells_, made_.model);
  addLoads();
  addFollowers();
  addInflows();
  addPluginLoads();
  setInitialValues();
  addContacts();
  addContactInflows();
  requireSupport();
  requireEffect();
  return std::move(made_);
}

void ModelMaker::giveRanks() {
  if (givenRanks_.empty()) return;
  made_.model.ranks.resize(made_.model.terms.size());
  auto first = givenRanks_.begin();
  for (const BodyBlock& body : made_.bodies) {
    const auto last = first + made_.model.terms[body.any()]->numEntities();
    for (const int term : {body.term, body.balances, body.flow})
      if (term >= 0) made_.model.ranks[term].assign(first, last);
    for (const int term : body.own) made_.model.ranks[term].assign(first, last);
    first = last;
  }
}

std::vector<fem::DofMap::Located> ModelMaker::fields() const {
  std::vector<fem::DofMap::Located> fields;
  const std::vector<std::string> scalars = deck::scalarFields(deck_);
  if (scalars.empty()) {
    fields.push_back({fem::displacementField(mesh_.dimension), {}});
  } else if (!deck_.materials.empty()) {
    std::vector<int> blocks;
    for (const deck::Material& material : deck_.materials)
      for (const std::string& name : material.blocks) blocks.push_back(fem::findBlock(mesh_, name));
    fields.push_back({fem::displacementField(mesh_.dimension), nodesOfBlocks(blocks)});
  }
  for (const deck::Material& material : deck_.materials)
    if (material.formulation == deck::Material::Formulation::Mixed)
      for (const std::string& name : material.blocks) {
        const fem::Block& block = mesh_.blocks[fem::findBlock(mesh_, name)];
        if (!solid::hasPressures(block.topology))
          fail("materials/" + material.name + "/formulation",
               fmt::format(
                   "block '{}' has {}; pressures stand beside displacements of degree 2, in QUAD8, QUAD9, "
                   "TRI6, HEX20, HEX27, TET10 and WEDGE15",
                   name, fem::topologyName(block.topology)));
        fields.push_back({solid::pressureField(block), solid::pressureNodes(block)});
      }
  const std::vector<fem::DofMap::Located> ofFlows = flowFields();
  fields.insert(fields.end(), ofFlows.begin(), ofFlows.end());
  for (const std::string& name : scalars) {
    if (std::any_of(ofFlows.begin(), ofFlows.end(),
                    [&](const fem::DofMap::Located& located) { return located.field.name == name; }))
      continue;
    std::vector<int> blocks;
    fem::Field field = physics::scalarField(name);
    for (int b = 0; b < static_cast<int>(mesh_.blocks.size()); ++b) {
      const std::vector<std::string> here = scalarFieldsOf(b);
      if (std::find(here.begin(), here.end(), name) != here.end()) blocks.push_back(b);
    }
    for (const deck::Material& material : deck_.materials)
      if (material.dielectric && material.dielectric->field == name) field.role = fem::Role::multiplier;
    fields.push_back({field, nodesOfBlocks(blocks)});
  }
  return fields;
}

std::vector<int> ModelMaker::nodesOfBlocks(const std::vector<int>& blocks) const {
  std::set<int> nodes;
  for (const int b : blocks) nodes.insert(mesh_.blocks[b].nodes.begin(), mesh_.blocks[b].nodes.end());
  return {nodes.begin(), nodes.end()};
}

void ModelMaker::addMaterials() {
  made_.bodies.resize(mesh_.blocks.size());
  for (const deck::Material& material : deck_.materials)
    for (const std::string& name : material.blocks) {
      const int b = fem::findBlock(mesh_, name);
      const fem::Block& block = mesh_.blocks[b];
      std::optional<physics::Expansion> expansion;
      if (!material.expansion.empty() && !fem::isShell(block)) expansion = expansionOf(material, b);
      try {
        if (thin_.count(b) > 0) {
          made_.bodies[b] = addThin(material, b);
          continue;
        }
        if (fem::isShell(block)) {
          made_.bodies[b] = addShell(material, b);
          continue;
        }
        const bool mixed = material.formulation == deck::Material::Formulation::Mixed;
        const auto cell = mixed ? solid::mixedTabulation(block.topology) : fem::tabulate(block.topology);
        fem::PointSet points = materialPoints(block, cell);
        made_.bodies[b].term = static_cast<int>(made_.model.terms.size());
        made_.bodies[b].toNodes = fem::extrapolation(block.topology, cell);
        if (material.dielectric) {
          points.more.push_back(
              fem::gradientsOf(physics::scalarField(material.dielectric->field), points, cell));
          made_.model.terms.push_back(registry::dielectricTerm(material, points, plane_));
          continue;
        }
        if (expansion) {
          if (!expansion->field.empty())
            points.more.push_back(fem::valuesOf(physics::scalarField(expansion->field), points, cell));
          made_.model.terms.push_back(registry::expandingTerm(material, *expansion, points, plane_));
          continue;
        }
        made_.model.terms.push_back(mixed ? registry::mixedTerm(material, mesh_, block,
                                                                solid::withPressures(points, block, cell),
                                                                plane_)
                                          : registry::materialTerm(material, points, plane_));
      } catch (const std::runtime_error& e) {
        fail("mesh/file", e.what());
      }
    }
}

fem::PointSet ModelMaker::materialPoints(const fem::Block& block, const fem::Tabulation& cell) const {
  return plane_ ? solid::planePoints(mesh_, block, cell, *plane_) : fem::volumePoints(mesh_, block, cell);
}

BodyBlock ModelMaker::addShell(const deck::Material& material, int block) {
  const int shells = shells_.find(block);
  BodyBlock body;
  body.term = static_cast<int>(made_.model.terms.size());
  body.shells = shells;
  body.toNodes = solid::shellPointsToNodes({}, shells_.elements[shells].nodesPerElement);
  physics::ShellExpansion expansion;
  try {
    if (!material.expansion.empty())
      expansion = physics::shellExpansion(material.expansion, scalarFieldsOf(block), deck_.constants);
  } catch (const formula::FormulaError& e) {
    fail("materials/" + material.name + "/expansion",
         fmt::format("in block '{}' {}", mesh_.blocks[block].name, e.what()));
  }
  made_.model.terms.push_back(registry::shellTerm(material, shells_.elements[shells],
                                                  shells_.cubature[shells], shells_.shear[shells],
                                                  std::move(expansion)));
  return body;
}

BodyBlock ModelMaker::addThin(const deck::Material& material, int b) {
  const fem::Block& block = mesh_.blocks[b];
  const auto cell = solid::thinTabulation(block.topology);
  BodyBlock body;
  body.term = static_cast<int>(made_.model.terms.size());
  body.toNodes = fem::extrapolation(block.topology, cell);
  const solid::ThinSection& section = thin_.at(b);
  made_.model.terms.push_back(registry::thinTerm(material, fem::isBar(block.topology),
                                                 solid::thinPoints(mesh_, block, cell, section), section));
  return body;
}

namespace {

/// Numbers of a deck, or formulas of the place, at nodes.
class NumbersAtNodes {
 public:
  NumbersAtNodes(const fem::Mesh& mesh, const physics::Constants& constants)
      : mesh_(mesh), constants_(constants) {}

  /// The formula where there is a text.
  double operator()(int node, double number, const std::string& text) {
    if (text.empty()) return number;
    auto& formula = formulas_[text];
    if (!formula) formula = physics::ofPlace(text, constants_);
    return formula(&mesh_.coordinates[3 * static_cast<std::size_t>(node)]);
  }

 private:
  const fem::Mesh& mesh_;
  const physics::Constants& constants_;
  std::map<std::string, std::function<double(const double*)>> formulas_;  ///< each is read once
};

deck::Vector3 unit(const deck::Vector3& a) {
  const double length = std::hypot(a[0], a[1], a[2]);
  return {a[0] / length, a[1] / length, a[2] / length};
}

}  // namespace

void ModelMaker::addSupports() {
  const std::string displacement = fem::displacementField().name;
  NumbersAtNodes at(mesh_, deck_.constants);
  for (const deck::Support& support : deck_.supports) {
    if (support.normal) continue;  // once the others are there
    const auto prescribe = [&](int node, int component, const deck::Prescribed& p,
                               const std::string& of = {}) {
      if (support.released)
        made_.model.release(node, component, of);
      else
        made_.model.prescribe(node, component, at(node, p.value, p.valueFormula),
                              at(node, p.perLoadFactor, p.perLoadFactorFormula), of);
    };
    const std::string& field = support.field.empty() ? displacement : support.field;
    const int number = made_.model.dofs.find(field);
    for (int node : nodesOf(mesh_, support.set)) {
      if (number < 0 || made_.model.dofs.dof(number, node, 0) < 0)
        fail("supports/" + support.name + "/set",
             fmt::format("node {} has no {}", mesh_.nodeNumber(node),
                         support.field.empty() ? "displacement: its blocks have no material"
                                               : "field '" + field + "'"));
      try {
        if (support.value) prescribe(node, 0, *support.value, field);
      } catch (const std::invalid_argument&) {
        fail("supports/" + support.name, fmt::format("the field '{}' of node {} is prescribed twice with "
                                                     "different values",
                                                     field, mesh_.nodeNumber(node)));
      }
      for (int i = 0; i < 3; ++i) try {
          if (const auto& p = support.components[i]; p && i < mesh_.dimension) prescribe(node, i, *p);
          if (const auto& p = support.director[i])
            for (int director : shells_.geometry.directorNodes(node)) prescribe(director, i, *p);
        } catch (const std::invalid_argument&) {
          fail("supports/" + support.name,
               fmt::format("displacement {0} of node {1}, or of its director, is prescribed twice with "
                           "different values",
                           "xyz"[i], mesh_.nodeNumber(node)));
        }
    }
  }
}

void ModelMaker::addInclinedSupports() {
  NumbersAtNodes at(mesh_, deck_.constants);
  std::vector<fem::HeldAlong> conditions;
  std::vector<const deck::Support*> of;  // of those on nodes of the mesh; of directors null
  for (const deck::Support& support : deck_.supports) {
    if (!support.normal) continue;
    const deck::Vector3 n = unit(*support.normal);
    const deck::Prescribed p = support.value.value_or(deck::Prescribed{});
    for (const int node : nodesOf(mesh_, support.set)) {
      if (made_.model.dofs.firstFieldSize(node) != mesh_.dimension)
        fail("supports/" + support.name + "/set",
             fmt::format("node {} has no displacement: its blocks have no material", mesh_.nodeNumber(node)));
      conditions.push_back(
          {node, n, at(node, p.value, p.valueFormula), at(node, p.perLoadFactor, p.perLoadFactorFormula)});
      of.push_back(&support);
      held_.push_back({node, {n[0], n[1], n[2]}});
      if (support.condition != deck::Support::Condition::Symmetry) continue;
      for (const int director : shells_.geometry.directorNodes(node)) {
        conditions.push_back({director, n});
        of.push_back(nullptr);
        const double* const D =
            &shells_.geometry
                 .directors[3 * static_cast<std::size_t>(director - shells_.geometry.numMeshNodes)];
        // omega x D has no part along n. (Nothing where D is along n.)
        deck::Vector3 turn{D[1] * n[2] - D[2] * n[1], D[2] * n[0] - D[0] * n[2], D[0] * n[1] - D[1] * n[0]};
        if (turn != deck::Vector3{}) turn = unit(turn);
        held_.push_back({node, {turn[0], turn[1], turn[2]}, true});
      }
    }
  }
  const auto forces = made("supports", [&] { return fem::holdAlong(made_.model, conditions); });
  for (std::size_t c = 0; c < of.size(); ++c)
    if (of[c] != nullptr)
      made_.normalForces[of[c]->name].push_back({conditions[c].node, conditions[c].direction, forces[c]});
}

void ModelMaker::requireSupport() const {
  std::vector<fem::HeldDirection> held = held_;
  if (plane_ && plane_->kind == solid::PlaneSection::Kind::axisymmetric)  // rings resist whatever is radial
    for (int n = 0; n < mesh_.numNodes(); ++n) held.push_back({n, {1, 0, 0}});
  for (const ContactPoints& contact : made_.contacts)
    for (std::size_t t = 0; t < contact.points.size(); ++t) {
      const fem::PointSet& points = contact.points[t];
      const int N = points.nodesPerEntity, Q = points.pointsPerEntity;
      for (std::size_t i = 0; i < points.nodes.size(); ++i) {
        const int n = points.nodes[i];
        if (n >= mesh_.numNodes()) continue;  // a director
        // Hard contact holds what touches, as long as it is pressed; open points hold nothing.
        const double* gaps = &contact.gaps[t][i / N * Q];
        if ((contact.pressure.hard || !contact.lines.empty()) &&
            std::any_of(gaps, gaps + Q, [&](double h) { return h > contact.closedGaps[t][i / N * Q]; }))
          continue;
        const double* x = &mesh_.coordinates[3 * static_cast<std::size_t>(n)];
        const double place[4] = {x[0], x[1], x[2], 0};
        const contact::ToolProjection over = contact.atStart->project(place);
        if (std::isfinite(over.gap)) held.push_back({n, {over.normal[0], over.normal[1], over.normal[2]}});
      }
    }
  for (const fem::FreeBody& body :
       fem::freeBodies(mesh_, made_.model.dofs, made_.model.supports, held, &shells_.geometry, joinedNodes()))
    fail("supports",
         fmt::format("the body with block '{}' can still move freely in {} rigid motion{}: prescribe more "
                     "displacements",
                     body.block, body.motions, body.motions == 1 ? "" : "s"));
}

void ModelMaker::requireEffect() const {
  if (made_.model.supports.driven() || made_.model.couplings.driven()) return;
  for (const deck::Support& support : deck_.supports)
    if (support.released) return;  // by this stage, or the deck's stages have been looked at
  for (const ContactPoints& contact : made_.contacts)
    if (contact.tool->moves()) return;
  for (const deck::Load& load : deck_.loads)
    if (followers::isFollower(load) && !load.constant) return;
  const bool expands = std::any_of(deck_.materials.begin(), deck_.materials.end(),
                                   [](const deck::Material& m) { return !m.expansion.empty(); });
  if (expands || !deck_.physics.empty()) return;  // formulas were looked at with the deck
  for (std::size_t dof = 0; dof < made_.model.load.size(); ++dof)
    if (made_.model.load[dof] != 0 && !made_.model.supports.fixed(static_cast<int>(dof))) return;
  fail("loads", "without effect: all that depends on the load factor acts on supported displacements");
}

}  // namespace atrapos
