#pragma once

#include <string>
#include <vector>

#include "atrapos/fem/Coupling.hpp"
#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/Mesh.hpp"

/// Surfaces that are one whose meshes need not fit (docs/theory/couplings.md, "Ties").
namespace atrapos::fem {

struct TieOptions {
  /// How far apart the surfaces may be, relative to the size of their faces (square root of the area).
  double reach = 0.1;
  /// Of cross-sections that are turned about y: a place weighs as its circle.
  bool axisymmetric = false;
};

/// A node of the surface that follows as a sum over nodes, whatever field it is of.
struct TiedNode {
  int node = 0;
  std::vector<CoupledNode> masters;  ///< some may be tied nodes themselves
};

struct Tie {
  std::vector<TiedNode> nodes;  ///< ascending
  std::vector<int> open;        ///< nodes of the surface that follows with nothing opposite; ascending
  double largestGap = 0;        ///< between the two, where they are tied; a length
};

/// The tie of two side sets, the first of which follows: faces of solids, or edges of plane cells. In the
/// mean over what a node stands for the first surface moves as the cells behind the second do, continued to
/// where the first surface is: constant stress passes through flat surfaces, and a motion of both as one
/// rigid body is free of forces whatever the gap. Throws std::invalid_argument for other sides, sets with
/// common nodes, and where no node has anything opposite; std::runtime_error for cells too distorted to find
/// a place in.
Tie tieSurfaces(const Mesh& mesh, const SideSet& follows, const SideSet& leads,
                const TieOptions& options = {});

/// Couples these fields of the tied nodes, where they have them; what is supported or coupled already keeps
/// to that. Returns how many unknowns do so. Throws std::invalid_argument where a node lacks a field of one
/// that follows it.
int couple(FeModel& model, const Tie& tie, const std::vector<std::string>& fields);

}  // namespace atrapos::fem
