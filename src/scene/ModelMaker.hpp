#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/RigidBody.hpp"
#include "atrapos/physics/Expansion.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "deck/Deck.hpp"
#include "scene/DeckTool.hpp"
#include "scene/SceneModel.hpp"
#include "scene/Shells.hpp"
#include "scene/ThinSections.hpp"

namespace atrapos {

/// What a model is made of: a deck, the mesh that it belongs to, and what these imply. Nothing in it changes.
struct ModelInput {
  const deck::Deck& deck;
  const fem::Mesh& mesh;
  const std::vector<int>& ranks;  ///< DeckMesh::ranks
  const SceneShells& shells;
  const std::optional<solid::PlaneSection>& plane;  ///< what plane cells stand for
  const SceneTools& tools;
};

/// Makes the whole model of a scene, on every rank. Whatever of the deck does not fit its mesh is found here:
/// throws deck::DeckError.
class ModelMaker {
 public:
  explicit ModelMaker(const ModelInput& input)
      : deck_(input.deck),
        mesh_(input.mesh),
        givenRanks_(input.ranks),
        shells_(input.shells),
        plane_(input.plane),
        tools_(input.tools),
        thin_(thinSections(input.deck, input.mesh)) {}

  /// Once; the tools must live as long as what is made.
  SceneModel make();

 private:
  // ModelMaker.cpp: unknowns, materials, supports.
  std::vector<fem::DofMap::Located> fields() const;                      ///< of the nodes of the mesh
  std::vector<int> nodesOfBlocks(const std::vector<int>& blocks) const;  ///< ascending
  void addMaterials();
  BodyBlock addShell(const deck::Material& material, int block);
  BodyBlock addThin(const deck::Material& material, int block);
  fem::PointSet materialPoints(const fem::Block& block, const fem::Tabulation& cell) const;
  void giveRanks();
  void addSupports();
  void addInclinedSupports();
  void requireSupport() const;
  void requireEffect() const;

  // ModelPhysics.cpp: scalar fields, flows, laws of plug-ins.
  /// The scalar fields of a block, in the order of deck::scalarFields; and those of all blocks that sides of
  /// a set belong to.
  std::vector<std::string> scalarFieldsOf(int block) const;
  std::vector<std::string> scalarFieldsOf(const fem::SideSet& set) const;
  physics::Expansion expansionOf(const deck::Material& material, int block) const;
  bool isVelocity(const std::string& field) const;
  const solid::ShellElements* shellsOf(int block) const;  ///< null: it has none
  std::vector<fem::DofMap::Located> flowFields() const;   ///< velocities and pressures
  void addBalances();
  void addFlows();
  void addPluginLaws();
  void addPluginLoads();
  /// The fields of the blocks that these sides belong to, among which that of a load must be, at this key.
  std::vector<std::string> fieldsAt(const std::string& key, const std::string& sides,
                                    const std::string& field) const;
  void addInflows();
  void addContactInflows();  ///< once there are contacts
  void setInitialValues();

  // ModelCouplings.cpp
  void addCouplings();
  /// Nodes of a coupling's set; none of an equation.
  std::vector<int> setOf(const deck::Coupling& coupling) const;
  void addTie(const deck::Coupling& coupling);
  void addEquation(const deck::Coupling& coupling);
  void addHinge(const deck::Coupling& coupling, const fem::RigidBody& body);
  /// Pairs of nodes that couplings join, as if an element did.
  std::vector<std::pair<int, int>> joinedNodes() const;
  /// The nodes of a solid along a shell's director, with their zeta.
  struct SolidSide {
    int top = -1, bottom = -1;
    std::vector<std::pair<int, double>> between;
  };
  SolidSide solidNodesAt(const deck::Coupling& coupling, int director) const;

  // ModelLoads.cpp
  void addLoads();
  void addFollowers();

  // ModelContacts.cpp
  void addContacts();
  std::vector<fem::PointSet> pointsOf(const deck::Contact& contact) const;
  BodySize bodySize() const;
  void makeLines(const deck::Contact& contact, ContactPoints& entry) const;
  void addZones(const deck::Contact& contact, ContactPoints& entry);
  void measureGaps(const deck::Contact& contact, ContactPoints& entry) const;
  void choosePressure(const deck::Contact& contact, BodySize body, ContactPoints& entry) const;

  [[noreturn]] void fail(const std::string& key, const std::string& problem) const {
    deck::failAt(deck_, key, problem);
  }
  /// make(), what it throws being told at an entry of the deck.
  template <class Make>
  auto made(const std::string& path, const Make& make) const {
    try {
      return make();
    } catch (const std::exception& e) {
      fail(path, e.what());
    }
  }

  const deck::Deck& deck_;
  const fem::Mesh& mesh_;
  const std::vector<int>& givenRanks_;
  const SceneShells& shells_;
  const std::optional<solid::PlaneSection>& plane_;
  const SceneTools& tools_;
  const std::map<int, solid::ThinSection> thin_;  ///< by block
  std::vector<fem::HeldDirection> held_;          ///< by supports with a normal and axes of rigid bodies
  std::vector<std::pair<int, int>> joined_;  ///< nodes of ties and equations, each with one that it follows
  SceneModel made_;
};

}  // namespace atrapos
