#pragma once

#include <vector>

#include "import/InpModel.hpp"
#include "import/InpStep.hpp"

namespace atrapos::importer {

/// What the rigid bodies of a model are in a deck, by what holds their reference nodes: free turns make a
/// rigid coupling, those about one axis, free or driven, one with an axis; without turns the nodes move as
/// one, by supports of their own where their motion is given.
class InpRigidMotions {
 public:
  /// Supports and forces of the step that are those of bodies without turns go to their nodes. Throws Error
  /// where a body's turns are neither free, nor all held, nor about one axis.
  InpRigidMotions(InpModel& model, InpStep& step);

  struct Coupling {
    bool turns = true;  ///< kind rigid, else equal
    std::vector<int> nodes;
    int reference = -1;  ///< of a rigid one; -1: none
    int axis = -1;       ///< that it turns about alone; -1: any
    double angle = 0;    ///< degrees by which it is driven
    double moment = 0;   ///< about the axis
  };
  const std::vector<Coupling>& couplings() const { return couplings_; }
  /// Nodes that the mesh needs for them, though no element may have them.
  std::vector<int> references() const;

 private:
  void add(const InpRigidBody& body, InpStep& step);

  std::vector<Coupling> couplings_;
};

}  // namespace atrapos::importer
