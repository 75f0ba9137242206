#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/ShellBody.hpp"
#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Stops.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "deck/Deck.hpp"
#include "scene/DeckMesh.hpp"
#include "scene/DeckTool.hpp"
#include "scene/SceneModel.hpp"
#include "scene/SceneState.hpp"
#include "scene/Shells.hpp"

namespace atrapos {

/// State of one contact at a point of the path.
struct ContactState {
  double normalForce = 0;  ///< sum of weight * R over the points
  double area = 0;         ///< sum of the weights of closed points; of zones the area within them
  /// Closed points: h <= 2 eta/alpha, the vertex of the hyperbola (15); rigid: h <= 1e-3 Delta; h <= 0 with
  /// laws without eta; hard on faces: pressed by an active corner; zones: points with a part of them.
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
  /// Lines on what the program has made of shells and ties that was not said in so many words.
  std::vector<std::string> remarks() const;
  const std::vector<BodyBlock>& bodies() const { return bodies_; }  ///< [block]
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
  /// The forces of all supports on the nodes, [3 node + component] and of directors behind them.
  std::vector<double> reactions(const SceneState& state) const;

  /// Values of the monitors, in the deck's order.
  std::vector<double> monitors(const SceneState& state) const;

  /// The monitors of displacements and fields, linear functionals of the unknowns.
  std::vector<path::Monitor> functionals() const;

  /// Calls f(term of the contact, point, gap and pressure) at all points.
  void forEachContactPoint(const ContactPoints& contact, const SceneState& state,
                           const std::function<void(std::size_t, int, const double*)>& f) const;
  ContactState contactState(const ContactPoints& contact, const SceneState& state) const;
  /// Sum of the normal forces over a contact's points with other weights than their own: [term][point].
  double contactForce(const ContactPoints& contact, const std::vector<std::vector<double>>& weights,
                      const SceneState& state) const;
  /// Total force of a contact on the body.
  std::array<double, 3> contactResultant(const ContactPoints& contact, const SceneState& state) const;

  /// Where results are on the bodies of shells; null: they are on the deck's mesh.
  const fem::ShellBody* shellBody() const { return body_ ? &*body_ : nullptr; }
  /// The mesh on which results are: the deck's own, or with the bodies of shells as solids.
  const fem::Mesh& resultMesh() const { return body_ ? body_->mesh : mesh_; }
  /// [element of the mesh, and of the result mesh] rank that works on it.
  std::vector<int> elementRanks() const;

 private:
  /// The whole model; bodies, joints, ties and contacts are those of its terms from then on.
  fem::FeModel makeModel();
  /// What messages call an unknown of the problem.
  std::string dofName(const fem::DofMap& dofs, int dof) const;
  void addMonitors();
  bool axisymmetric() const { return plane_ && plane_->kind == solid::PlaneSection::Kind::axisymmetric; }
  /// Of a monitor with set, reduce and near.
  template <class Monitor>
  linear::RCP<path::Vector> weightsOf(const std::string& key, const Monitor& monitor,
                                      const std::string& field, int component) const;

  deck::Deck deck_;
  fem::Mesh mesh_;
  std::vector<int> givenRanks_;
  SceneShells shells_;
  std::optional<solid::PlaneSection> plane_;  ///< what plane cells stand for
  std::optional<fem::ShellBody> body_;        ///< where the results are on the bodies of shells
  std::unique_ptr<fem::FeProblem> problem_;
  /// Of a scene that sharpens: the problem before, which those who followed its path still refer to.
  std::unique_ptr<fem::FeProblem> loaded_;
  SceneTools tools_;
  std::vector<BodyBlock> bodies_;  ///< [block]
  std::vector<ContactPoints> contacts_;
  std::vector<TiedSurfaces> ties_;
  std::map<std::string, std::vector<NormalForce>> normalForces_;  ///< SceneModel::normalForces
  std::map<std::string, int> hinges_;                             ///< SceneModel::hinges
  /// [monitor] weights of a monitor of displacements or a field over the unknowns; null for the others
  std::vector<linear::RCP<path::Vector>> unknownWeights_;
  /// [monitor][term][point] of the contact that a monitor with `near` watches; empty for the others
  std::vector<std::vector<std::vector<double>>> contactWeights_;
};

}  // namespace atrapos
