#pragma once

#include <array>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/Mesh.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/path/Monitor.hpp"
#include "atrapos/path/Stops.hpp"
#include "deck/Deck.hpp"

namespace atrapos {

/// The solid term of one block of the mesh.
struct SolidBlock {
  int term = -1;                ///< its position in the problem
  std::vector<double> toNodes;  ///< [node][cubature point] of a cell: values at points -> values at nodes
};

/// The points of one contact of the deck.
struct ContactPoints {
  std::string name;
  std::vector<int> terms;  ///< positions of its terms in the problem (one a face shape)
  std::vector<fem::PointSet> points;
  std::vector<std::vector<double>> gaps;  ///< [term][point] initial gap
  int count = 0;
  double smallestGap = 0;  ///< at the start
};

/// State of one contact at a point of the path.
struct ContactState {
  double normalForce = 0;  ///< sum of weight * R over the points
  /// Closed points: h <= 2 eta/alpha, the vertex of the hyperbola (15); rigid: h <= 1e-3 of the initial gap.
  int active = 0;
};

/// A deck and its mesh made into a finite-element problem, with what the deck asks to be watched.
/// Everything that can be wrong with the input is found here, before any work: throws deck::DeckError.
class Scene {
 public:
  Scene(const deck::Deck& deck, fem::Mesh mesh);

  const deck::Deck& deck() const { return deck_; }
  const fem::Mesh& mesh() const { return mesh_; }
  fem::FeProblem& problem() { return *problem_; }
  const fem::FeProblem& problem() const { return *problem_; }
  const std::vector<ContactPoints>& contacts() const { return contacts_; }
  int numContactPoints() const;

  path::Stops stops() const;

  std::vector<std::string> monitorNames() const;
  /// Values of the monitors, in the deck's order.
  std::vector<double> monitors(const path::Vector& u, double lambda) const;

  /// The displacement monitors, linear functionals of the unknowns.
  std::vector<path::Monitor> functionals() const;

  ContactState contactState(const ContactPoints& contact, const path::Vector& u, double lambda) const;
  /// Total force of a contact on the body.
  std::array<double, 3> contactResultant(const ContactPoints& contact, const path::Vector& u,
                                         double lambda) const;

  std::vector<std::string> nodalNames() const;
  std::vector<std::string> elementNames() const;
  /// [variable][node]
  std::vector<std::vector<double>> nodalValues(const path::Vector& u, double lambda) const;
  /// [variable][element over all blocks]
  std::vector<std::vector<double>> elementValues(const path::Vector& u, double lambda) const;

 private:
  std::vector<int> nodesOf(const std::string& set) const;
  void addMaterials(fem::FeModel& model);
  void addSupports(fem::FeModel& model) const;
  void addLoads(fem::FeModel& model) const;
  void addContacts(fem::FeModel& model);
  void addMonitors();
  const deck::Tool& toolOf(const deck::Contact& contact) const;
  void requireSupport(const fem::Supports& supports) const;
  void requireEffect(const fem::FeModel& model) const;
  [[noreturn]] void fail(const std::string& key, const std::string& problem) const;
  bool writes(deck::OutputField field) const;
  std::vector<std::vector<double>> nodalContact(const path::Vector& u, double lambda) const;
  std::vector<std::vector<double>> nodalStress(const path::Vector& u, double lambda) const;

  deck::Deck deck_;
  fem::Mesh mesh_;
  std::unique_ptr<fem::FeProblem> problem_;
  std::vector<SolidBlock> solids_;  ///< [block]
  std::vector<ContactPoints> contacts_;
  /// [monitor] weights of a displacement monitor over the unknowns; null for the others
  std::vector<linear::RCP<path::Vector>> displacementWeights_;
};

}  // namespace atrapos
