#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/contact/NearContact.hpp"
#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ShellBody.hpp"
#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Stops.hpp"
#include "atrapos/physics/Expansion.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "deck/Deck.hpp"
#include "scene/ContactPressure.hpp"
#include "scene/DeckMesh.hpp"
#include "scene/SceneState.hpp"
#include "scene/Shells.hpp"

namespace atrapos {

/// The material's term of one block of the mesh.
struct BodyBlock {
  int term = -1;           ///< of its material: its position in the problem; -1: no material
  int balances = -1;       ///< of its scalar fields; -1: none
  int flow = -1;           ///< -1: none
  std::vector<int> own{};  ///< of laws of plug-ins
  int shells = -1;         ///< position in SceneShells; -1: solids
  /// One of its terms.
  int any() const {
    return term >= 0 ? term : balances >= 0 ? balances : flow >= 0 ? flow : own.empty() ? -1 : own.front();
  }
  std::vector<double>
      toNodes;  ///< [node][point] of a cell: values at points (of shells: in the plane) -> nodes
};

/// The points of one contact of the deck.
struct ContactPoints {
  std::string name;
  std::vector<int> terms;  ///< positions of its terms in the problem (one a face shape)
  std::vector<fem::PointSet> points;
  std::vector<std::vector<double>> gaps;        ///< [term][point] initial gap
  std::vector<std::vector<double>> references;  ///< [term][point] Delta
  std::vector<std::vector<double>> closedGaps;  ///< [term][point] a point with a smaller gap is closed
  const contact::RigidTool* tool = nullptr;
  const contact::RigidTool* atStart = nullptr;  ///< where it stands before it moves, at load factor 0
  std::vector<contact::NearContact*> near;      ///< [term]; empty where all points carry the law
  ContactPressure pressure;
  bool hardFaces = false;           ///< hard, with conditions on mean gaps around the corners of faces
  std::vector<fem::LineSet> lines;  ///< [term] of zones; empty: points carry the law
  int count = 0;
  double smallestGap = 0;  ///< at the start
  int attracted = 0;       ///< points farther off than a uniform Delta, which pulls at them
  /// Points that carry the law so far: those that came near the tool. Collective.
  int numCarried() const;
};

/// State of one contact at a point of the path.
struct ContactState {
  double normalForce = 0;  ///< sum of weight * R over the points
  double area = 0;         ///< sum of the weights of closed points; of zones the area within them
  /// Closed points: h <= 2 eta/alpha, the vertex of the hyperbola (15); rigid: h <= 1e-3 Delta; h <= 0 with
  /// laws without eta; hard on faces: pressed by an active corner; zones: points within them.
  int active = 0;
};

/// A deck and its mesh made into a finite-element problem, with what the deck asks to be watched.
/// Everything that can be wrong with the input is found here, before any work: throws deck::DeckError.
///
/// On several ranks all make the same scene; the problem is shared out among them. Whatever takes vectors is
/// collective, and its results are whole on every rank.
class Scene {
 public:
  Scene(const deck::Deck& deck, DeckMesh mesh);
  Scene(const Scene&) = delete;  // its problem refers to it
  Scene& operator=(const Scene&) = delete;

  const deck::Deck& deck() const { return deck_; }
  const fem::Mesh& mesh() const { return mesh_; }
  /// [element] of a mesh that came in parts the rank whose part it came in; empty: METIS decides.
  const std::vector<int>& givenRanks() const { return givenRanks_; }
  const SceneShells& shells() const { return shells_; }
  fem::FeProblem& problem() { return *problem_; }
  const fem::FeProblem& problem() const { return *problem_; }
  const std::vector<ContactPoints>& contacts() const { return contacts_; }
  int numContactPoints() const;
  /// Of the problem, supported ones included.
  int numUnknowns() const;

  /// Whether there are contacts whose points get their law along the path.
  bool contactsGrow() const;
  /// Whether points that carry no contact law so far are near their tool in a state; with `grow` they carry
  /// it from then on.
  bool othersAreNear(const path::State& state) const;
  void grow(const path::State& state);

  /// The body at this load factor, which stays, with contacts whose regularisation falls: eta exp(-s), s in
  /// place of the load factor in all members from now on. States of the problem before go on as
  /// FeProblem::values: on several ranks the new one may be shared out otherwise. Throws std::logic_error
  /// where a law is not (15).
  void sharpen(double loadFactor);

  path::Stops stops() const;

  /// What there is to see at a state of the problem, which must stay meanwhile.
  SceneState at(const path::State& state) const { return {*problem_, state}; }

  std::vector<std::string> monitorNames() const;
  /// Values of the monitors, in the deck's order.
  std::vector<double> monitors(const SceneState& state) const;

  /// The monitors of displacements and fields, linear functionals of the unknowns.
  std::vector<path::Monitor> functionals() const;

  ContactState contactState(const ContactPoints& contact, const SceneState& state) const;
  /// Sum of the normal forces over a contact's points with other weights than their own: [term][point].
  double contactForce(const ContactPoints& contact, const std::vector<std::vector<double>>& weights,
                      const SceneState& state) const;
  /// Total force of a contact on the body.
  std::array<double, 3> contactResultant(const ContactPoints& contact, const SceneState& state) const;

  /// The mesh on which results are: the deck's own, or with the bodies of shells as solids.
  const fem::Mesh& resultMesh() const { return body_ ? body_->mesh : mesh_; }
  /// [element of the mesh, and of the result mesh] rank that works on it.
  std::vector<int> elementRanks() const;
  std::vector<std::string> nodalNames() const;
  std::vector<std::string> elementNames() const;
  /// [variable][node of the result mesh]
  std::vector<std::vector<double>> nodalValues(const SceneState& state) const;
  /// [variable][element over all blocks]
  std::vector<std::vector<double>> elementValues(const SceneState& state) const;

 private:
  /// The whole model, on every rank; bodies, tools and contacts are those of its terms from then on.
  fem::FeModel makeModel();
  /// What messages call an unknown of the problem.
  std::string dofName(const fem::DofMap& dofs, int dof) const;
  std::vector<int> nodesOf(const std::string& set) const;
  std::vector<fem::PointSet> pointsOf(const deck::Contact& contact) const;
  fem::PointSet materialPoints(const fem::Block& block, const fem::Tabulation& cell) const;
  std::vector<fem::DofMap::Located> fields() const;                      ///< of the nodes of the mesh
  std::vector<int> nodesOfBlocks(const std::vector<int>& blocks) const;  ///< ascending
  /// Whether a material has plastic strains to show.
  bool yields() const;
  void addMaterials(fem::FeModel& model);
  /// The scalar fields of a block, in the order of deck::scalarFields; and those of all blocks that sides of
  /// a set belong to.
  std::vector<std::string> scalarFieldsOf(int block) const;
  std::vector<std::string> scalarFieldsOf(const fem::SideSet& set) const;
  physics::Expansion expansionOf(const deck::Material& material, int block) const;
  bool isVelocity(const std::string& field) const;
  void addBalances(fem::FeModel& model);
  void addFlows(fem::FeModel& model);
  void addPluginLaws(fem::FeModel& model);
  void addPluginLoads(fem::FeModel& model) const;
  /// make(), what it throws being told at an entry of the deck.
  template <class Make>
  auto made(const std::string& path, const Make& make) const {
    try {
      return make();
    } catch (const std::exception& e) {
      fail(path, e.what());
    }
  }
  /// Velocities and pressures of flows.
  std::vector<fem::DofMap::Located> flowFields() const;
  /// Values of a field that is the pressure of a flow at the nodes between corners, [node].
  void fillPressures(const std::string& field, std::vector<double>& nodes) const;
  void addInflows(fem::FeModel& model) const;
  void setInitialValues(fem::FeModel& model) const;
  /// Those of the mesh's parts, to the materials' terms.
  void giveRanks(fem::FeModel& model) const;
  BodyBlock addShell(const deck::Material& material, int shells, fem::FeModel& model) const;
  void addSupports(fem::FeModel& model) const;
  void addCouplings(fem::FeModel& model) const;
  /// Pairs of nodes that couplings join, as if an element did.
  std::vector<std::pair<int, int>> joinedNodes() const;
  /// The nodes of a solid along a shell's director, with their zeta.
  struct SolidSide {
    int top = -1, bottom = -1;
    std::vector<std::pair<int, double>> between;
  };
  SolidSide solidNodesAt(const deck::Coupling& coupling, int director) const;
  void addLoads(fem::FeModel& model) const;
  void addFollowers(fem::FeModel& model) const;
  void addContacts(fem::FeModel& model);
  void addMonitors();
  /// Of a monitor with set, reduce and near.
  template <class Monitor>
  linear::RCP<path::Vector> weightsOf(const std::string& key, const Monitor& monitor,
                                      const std::string& field, int component) const;
  void makeTools();
  BodySize bodySize() const;
  void makeLines(const deck::Contact& contact, ContactPoints& entry) const;
  void addZones(const deck::Contact& contact, ContactPoints& entry, fem::FeModel& model) const;
  void measureGaps(const deck::Contact& contact, ContactPoints& entry) const;
  void choosePressure(const deck::Contact& contact, BodySize body, ContactPoints& entry) const;
  void requireSupport(const fem::FeModel& model) const;
  void requireEffect(const fem::FeModel& model) const;
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;
  bool writes(deck::OutputField field) const;
  /// Calls f(term of the contact, point, gap and pressure) at all points.
  void forEachContactPoint(const ContactPoints& contact, const SceneState& state,
                           const std::function<void(std::size_t, int, const double*)>& f) const;
  std::vector<std::vector<double>> nodalContact(const SceneState& state) const;
  std::vector<std::vector<double>> nodalStress(const SceneState& state) const;
  std::vector<double> onResultNodes(std::vector<double> ofMesh) const;

  deck::Deck deck_;
  fem::Mesh mesh_;
  std::vector<int> givenRanks_;
  SceneShells shells_;
  std::optional<solid::PlaneSection> plane_;  ///< what plane cells stand for
  std::optional<fem::ShellBody> body_;        ///< where the results are on the bodies of shells
  std::unique_ptr<fem::FeProblem> problem_;
  /// Of a scene that sharpens: the problem before, which those who followed its path still refer to.
  std::unique_ptr<fem::FeProblem> loaded_;
  std::vector<std::unique_ptr<contact::RigidTool>> tools_;  ///< in the deck's order
  /// The same where they stand before they move; null where that is at load factor 0 of tools_.
  std::vector<std::unique_ptr<contact::RigidTool>> toolsAtStart_;
  std::vector<BodyBlock> bodies_;  ///< [block]
  std::vector<ContactPoints> contacts_;
  /// [monitor] weights of a monitor of displacements or a field over the unknowns; null for the others
  std::vector<linear::RCP<path::Vector>> unknownWeights_;
  /// [monitor][term][point] of the contact that a monitor with `near` watches; empty for the others
  std::vector<std::vector<std::vector<double>>> contactWeights_;
};

}  // namespace atrapos
