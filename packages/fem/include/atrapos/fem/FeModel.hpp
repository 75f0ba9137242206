#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "atrapos/fem/Coupling.hpp"
#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Support.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/linear/Types.hpp"

namespace Teuchos {
template <class Ordinal>
class Comm;
}

namespace atrapos::fem {

/// What a finite-element problem is made of.
struct FeModel {
  DofMap dofs;
  std::vector<std::unique_ptr<Term>> terms;
  Supports supports;
  Couplings couplings;
  std::vector<double> constantLoad;  ///< F_0, [dof], dead
  std::vector<double> load;          ///< F_1: the dead load at load factor 1
  /// [dof] the unknowns before any load acts, supported ones apart; empty: zero
  std::vector<double> initial;
  /// Communicator of the problem's maps; null: Tpetra's default, all ranks of the program.
  linear::RCP<const Teuchos::Comm<int>> comm;
  /// w_t: the square of the change of the load factor that counts in the path parameter as much as a change
  /// of one parameter t of a law (Role::parameter: places on contact curves) by 1.
  double parameterWeight = 1;
  /// The same for internal variables of terms, the relative widths of contact zones.
  double internalWeight = 1e-2;
  /// Of the body, against which displacements are large or small; 0: not known.
  double size = 0;
  /// Where the mesh came in parts, [term][entity] the rank that works on an element; terms at the end and
  /// terms of others than elements may have empty lists. Empty: METIS decides.
  std::vector<std::vector<int>> ranks;
  /// What messages call a dof; empty: DofMap::nameOf.
  std::function<std::string(int dof)> dofName;

  /// Prescribes a component of a node's first field, or of the named one. Throws std::invalid_argument as
  /// Supports::prescribe does, and where the node has no such component.
  void prescribe(int node, int component, double value, double perLoadFactor, const std::string& field = {});
  /// Supports::release of such a component.
  void release(int node, int component, const std::string& field = {});
};

}  // namespace atrapos::fem
