#pragma once

#include <string>
#include <vector>

namespace atrapos::fem {

/// What the unknowns of a field are to the tangent.
enum class Role {
  primal,      ///< displacements, temperatures
  multiplier,  ///< each that is free owes the tangent a negative pivot: multipliers of constraints,
               ///< potentials
  oneSided,  ///< multipliers of conditions that are active or free (EventTerm): a negative pivot while active
  parameter  ///< parameters of local laws; a negative pivot each, and a weight of their own in the path
};

/// A field of unknowns: a vector with named components, or a scalar with one that has no name.
struct Field {
  std::string name;                         ///< "displacement"
  std::vector<std::string> components{""};  ///< "x", "y", "z"
  Role role = Role::primal;
  /// What its rows are a balance of, "forces": newtons and watts do not add, so every balance has a norm and
  /// a scale of its own. Empty: of its own name where it is primal, else that of the first field.
  std::string balance = {};

  int numComponents() const { return static_cast<int>(components.size()); }
};

/// The displacement of a body in space (x, y, z) or in a plane (x, y).
Field displacementField(int dimension = 3);
/// What a shell's director changes by: x, y, z.
Field directorField();

/// Which unknowns there are and how they are numbered.
///
/// Nodes carry fields; the unknowns of a node are contiguous, field after field, and nodes are numbered in
/// their order. Nodes are first those of a mesh, then whatever else has unknowns of its own: directors of
/// shells, rigid bodies, points with multipliers.
class DofMap {
 public:
  /// A field and the nodes that have it, ascending; all of them where the list is empty.
  struct Located {
    Field field;
    std::vector<int> nodes;
  };

  DofMap() = default;
  DofMap(int numNodes, const std::vector<Located>& fields);
  /// All nodes have a displacement and nothing else.
  static DofMap displacements(int numNodes, int dimension = 3);

  /// `count` nodes behind those there are, with this field; numbers given before stay. Returns the first of
  /// them. Throws std::logic_error where a field of this name has other components or another role.
  int addNodes(int count, const Field& field);

  /// The same for some of the nodes only, in their order.
  DofMap part(const std::vector<int>& nodes) const;

  int numNodes() const { return static_cast<int>(start_.size()) - 1; }
  int numDofs() const { return start_.back(); }
  int numDofs(int node) const { return start_[node + 1] - start_[node]; }
  /// The first unknown of a node: the first component of its first field.
  int firstDof(int node) const { return start_[node]; }

  const std::vector<Field>& fields() const { return fields_; }
  /// Number of the field with this name; -1: none.
  int find(const std::string& name) const;
  /// The unknown, or -1 where the node does not have the field.
  int dof(int field, int node, int component) const {
    const int offset = offsets_[layout_[node]][field];
    return offset < 0 ? -1 : start_[node] + offset + component;
  }
  /// Components of a node's first field; 0: the node has none.
  int firstFieldSize(int node) const;

  struct Address {
    int field = 0, node = 0, component = 0;
  };
  Address addressOf(int dof) const;
  int nodeOf(int dof) const { return addressOf(dof).node; }
  /// Different balances of the fields, in their order; and the number of that of a field.
  const std::vector<std::string>& balances() const { return balances_; }
  int balanceOf(int field) const { return balanceOf_[field]; }
  /// All unknowns of fields with this role, ascending.
  std::vector<int> dofsWith(Role role) const;

  /// "displacement z of node 17", nodes from 1.
  std::string nameOf(int dof) const;

  /// Vectors in space from the first fields of all nodes, [3 node + component]: zeros for components that a
  /// field does not have, and for nodes whose first field is no vector of up to 3 components.
  std::vector<double> vectors(const std::vector<double>& dofs) const;
  /// The other way round; what has no unknown is left out.
  std::vector<double> fromVectors(const std::vector<double>& vectors) const;

 private:
  int fieldNumber(const Field& field);
  int layoutNumber(const std::vector<int>& fields);
  int sizeOf(int layout) const;

  std::vector<Field> fields_;
  std::vector<std::string> balances_;
  std::vector<int> balanceOf_;             ///< [field]
  std::vector<std::vector<int>> layouts_;  ///< [layout] fields in their order
  std::vector<std::vector<int>> offsets_;  ///< [layout][field] first component in the node; -1: not there
  std::vector<int> layout_;                ///< [node]
  std::vector<int> start_{0};              ///< [node] first unknown, and the number of all
};

}  // namespace atrapos::fem
