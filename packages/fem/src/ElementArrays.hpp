#pragma once

#include <cstddef>
#include <vector>

#include "ElementKernels.hpp"
#include "atrapos/fem/Batches.hpp"
#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// The entities of a term as its loops read them, in batches of kLanes: weights, and of each field dofs and
/// shape functions with the kernels that work on them.
class ElementArrays {
 public:
  explicit ElementArrays(const PointSet& points);

  int numEntities() const { return numEntities_; }
  int numPoints() const { return Q_; }  ///< of an entity
  int lanesIn(int b) const { return parts_.front().view.lanesIn(b); }
  const Batches& batches() const { return batches_; }
  /// [entity][node] of all fields; those that several fields have at the same nodes once.
  const std::vector<int>& nodes() const { return entityNodes_; }
  int nodesPerEntity() const { return P_; }
  int numFields() const { return static_cast<int>(parts_.size()); }
  int inputs() const { return inputs_; }        ///< B u at a point, of all fields
  int localDofs() const { return localDofs_; }  ///< of an entity, field after field
  /// Nodes of the first field.
  int numNodes() const { return parts_.front().view.N; }

  /// Number of an entity, from 0, in the whole term.
  int numberInTerm(int entity) const { return kept_.empty() ? entity : kept_[entity]; }

  /// Drops all entities but these.
  void keep(const TermPart& part);
  /// Term::connect; `positions` of `stride` nodes a row and column, of which these are the first.
  void connect(const DofMap& dofs, const std::vector<int>& positions, int stride);

  /// in[q][m][lane] = B u of all fields, of rows of `stride` entries a point.
  void gather(int b, const double* u, int stride, double* in) const;
  /// in += the constant part of the inputs: X where the first field's are the current place.
  void addOffset(int b, int stride, double* in) const;
  /// force[local dof][lane] += B^T out; with `weighted` times the points' weights.
  void addForces(int b, const double* out, int stride, bool weighted, double* force) const;
  /// f += force.
  void scatter(int b, const double* force, double* f) const;
  /// K += weight B^T jacobian B + correction (of terms with one field). jacobian [q][output][input][lane]
  /// with these numbers of outputs and inputs, moduli: scratch of the same size.
  void addBlocks(int b, const double* jacobian, int outputs, int inputs, bool symmetric,
                 const BlockCorrection& correction, const TangentSink& sink, double* moduli) const;

  /// How many balances (DofMap::balances) its fields reach to, and that of the first field.
  int numBalances() const { return numBalances_; }
  int balance() const { return parts_.front().balance; }
  /// Sums of squares of a batch's nodal forces, [balance].
  void squares(int b, const double* force, double* sums) const;
  /// The weights of a batch, [q][lane].
  const double* weights(int b) const { return weight_.data() + static_cast<std::size_t>(b) * Q_ * kLanes; }
  /// The unknowns of the first field: its first component at a node of an entity.
  int dof(std::size_t entity, int node) const {
    return parts_.front().dofs(entity * parts_.front().view.N + node);
  }

  /// [entity][m] -> [batch][m][lane], m < count; lanes beyond the last entity copy it.
  std::vector<double> packed(const std::vector<double>& from, std::size_t count) const;
  /// [batch][m][lane] of the whole term -> of a part; before `keep`.
  static std::vector<double> packedOf(const TermPart& part, const double* from, std::size_t count);

 private:
  /// One field.
  struct Part {
    std::string field;
    int components = 0, shapeComponents = 0;
    int firstNode = 0;   ///< of its nodes among those of an entity
    int firstInput = 0;  ///< of its inputs among those of a point
    int firstDof = 0;    ///< of its dofs among those of an entity
    int balance = 0;     ///< of its rows
    ElementView view;
    ElementKernels kernels;
    View<double*> shape, map;
    View<int*> dofs;       ///< [batch][lane][node]
    View<int*> positions;  ///< where the field is not the first one of all its nodes: its own blocks
    std::vector<int> columnOffsets;  ///< then, [entity][node] of its first component among a node's unknowns

    int inputs() const { return components * shapeComponents; }
    int columnOffset(std::size_t entity, int node) const {
      return columnOffsets.empty() ? 0 : columnOffsets[entity * view.N + node];
    }
  };

  void addPart(const Interpolation& of);
  void setViews();
  int fieldAt(const Part& part, const DofMap& dofs, int node) const;
  int balanceAt(const Part& part, const DofMap& dofs, int node) const;
  double shapeAt(const Part& part, int b, int q, int n, int c, int lane) const;
  /// [q][node][component][lane] of a batch, in `room` where they are not kept so.
  const double* shapesAt(const Part& part, int b, std::vector<double>& room) const;
  /// Whether a law's jacobian has nothing between two parts, at any point.
  bool vanishes(const Part& row, const Part& column, const double* jacobian, int outputs, int inputs) const;
  void addMixedBlocks(int b, const Part& row, const Part& column, const double* jacobian, int outputs,
                      int inputs, bool transposed, const BlockCorrection& correction,
                      const TangentSink& sink) const;
  /// What a correction by all dofs of an entity has for those of one part.
  static BlockCorrection ofPart(const BlockCorrection& correction, const Part& part);
  std::vector<int> padded(const std::vector<int>& of, int count) const;
  std::vector<double> withoutPadding(std::vector<double> weights) const;

  int numEntities_ = 0, Q_ = 0, P_ = 0;
  int stride_ = 0;  ///< nodes a row of positions_
  int inputs_ = 0, localDofs_ = 0, numBalances_ = 1;
  std::vector<Part> parts_;
  std::vector<int> entityNodes_;
  std::vector<int> kept_;  ///< entities of the whole term, where this is a part; empty: all
  Batches batches_;
  View<int*> positions_;
  View<double*> weight_, offset_;
};

}  // namespace atrapos::fem
