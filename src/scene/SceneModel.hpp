#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

#include "atrapos/contact/NearContact.hpp"
#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/HeldAlong.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/ShellJoints.hpp"
#include "scene/ContactPressure.hpp"

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

/// What a tie of the deck has joined.
struct TiedSurfaces {
  std::string name;
  int nodes = 0, open = 0;  ///< that follow; that have nothing opposite
  double gap = 0;           ///< the largest between the surfaces
};

/// What a support with a normal holds a node with.
struct NormalForce {
  int node = 0;
  std::array<double, 3> normal{};  ///< of length 1
  fem::ForceAlong force;
};

/// What a deck and its mesh become: the terms, and where those of each block and contact are among them.
struct SceneModel {
  fem::FeModel model;
  std::vector<BodyBlock> bodies;  ///< [block]
  std::vector<ContactPoints> contacts;
  std::vector<deck::Contact> chosenContacts;  ///< the deck's, with law and points where it leaves them open
  fem::ShellJoints joints;                    ///< folds and branches of shells
  std::vector<TiedSurfaces> ties;
  std::map<std::string, std::vector<NormalForce>> normalForces;  ///< by support with a normal
  std::map<std::string, int> hinges;  ///< by coupling: the node of a rigid body's angle
};

}  // namespace atrapos
