#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/path/Problem.hpp"

namespace atrapos::fem {

/// R(u, lambda) = sum of the terms F(u, lambda) - F_0 - lambda F_1 with Dirichlet conditions, as a
/// path::Problem.
///
/// The unknowns are those of FeModel::dofs. The row of a prescribed dof reads s (u - value -
/// lambda rate) = 0 with s the size of the tangent's diagonal, and its column is carried to the load
/// direction (the state and every series satisfy the condition to rounding), so the tangent stays symmetric
/// and its inertia is that of the free dofs. A state off its supports is out of balance by that row. Nodes
/// without an element are held at zero; a force there throws std::invalid_argument. Coupled dofs are
/// eliminated in the same way: their forces and columns go to their masters, and their own rows are the
/// couplings.
///
/// Every balance (Field::balance) has a norm and a scale of its own; the residual is that of the balance
/// which is furthest off. Scale of the relative residual: the norm of what the residual is the cancellation
/// of, sqrt(sum over all elements and contact faces of |own nodal forces|^2), or that of F_0 + lambda F_1
/// where it is larger; at least 1e-6 of the forces at load factor 1. (Assembled forces and reactions would
/// not do: they can all vanish at a stressed state, and in a thin body the rounding of the displacements
/// alone then exceeds any fraction of them.)
///
/// On a communicator of several ranks every rank gives the same whole model; the problem cuts it
/// (fem::partition) and each rank keeps its part (docs/theory/parallel.md). Whatever takes vectors is
/// collective then, numbers of nodes and entities stay those of the whole model, and an error on one rank is
/// thrown on all. Terms that cannot be shared out (Term::keep) throw std::invalid_argument. A program of
/// several ranks may have one problem on each, with Teuchos::MpiComm<int>(MPI_COMM_SELF) as FeModel::comm.
class FeProblem final : public path::Problem {
 public:
  /// Throws std::invalid_argument, one line, also where laws have no value at the start.
  explicit FeProblem(FeModel model);
  ~FeProblem() override;

  linear::RCP<const path::Map> map() const override;
  bool symmetric() const override;
  path::ResidualNorm residual(const path::State& state, path::Vector& r) override;
  /// The sum over the balances of scale times |v_b|.
  double scaleAlong(const path::Vector& v, const path::State& state) override;
  linear::RCP<const path::CrsMatrix> tangent(const path::State& state, path::Vector& F) override;
  /// What the terms store (Term::addCapacity), on the tangent's graph; nothing in the rows and columns of
  /// prescribed dofs and of those eliminated by couplings. Null where no term stores anything.
  linear::RCP<const path::CrsMatrix> mass(const path::State& state) override;
  /// The mean diagonal entry of each field's own block where several balances act together, which makes
  /// eigenvalues the same in all units. Fields with a capacity (mass) are one in this: their rates compare.
  /// Null where all are one.
  linear::RCP<const path::Vector> eigenvalueWeights(const path::State& state) override;
  void beginSeries(const path::State& state, int maxOrder) override;
  void orderRhs(int k, path::Vector& Fk) override;
  void completeOrder(int k, const path::Vector& Uk, double lambdaK) override;

  /// Those of the terms, of this rank's entities.
  int internalCount() const override;
  void internalOrder(int k, const path::Vector& v, double mu, std::vector<double>& y) const override;

  /// The fields of each balance times its factor (weighFields), and parameters of laws and internal variables
  /// with their own weights: w <x, y> = w sum_b c_b x_b . y_b + w_t x_t . y_t + w_i x_i . y_i.
  double inner(const path::Increment& x, const path::Increment& y) const override;
  /// By balance (DofMap::balances), with directors, multipliers and parameters in that of the displacements.
  /// A field has moved where the forces of its change, by the mean diagonal entry of its own block in the
  /// last tangent, are a thousandth of those of its balance.
  std::vector<double> fieldChanges(const path::State& from, const path::State& to) override;
  /// Throws std::invalid_argument where there are others than one a balance.
  void weighFields(const std::vector<double>& factors) override;
  /// Chosen from the unknowns without the parameters.
  double weight(const path::Increment& Xhat, std::optional<double> given) override;

  /// Displacements below 1e-6 of the body's size, where that is known and there are no fields beside them.
  bool isNegligible(const path::Vector& change) const override;

  /// Event functions: those of the terms that change at events, one a contact point.
  int eventCount() const override;
  /// Number of the first one of this term.
  int firstEvent(int term) const;
  void eventOrder(int k, std::vector<double>& g) const override;
  std::vector<int> growingAt(const path::State& state) const override;
  double negligibleFall(int event) const override;
  bool eventMayBeNone(int event) const override;
  std::vector<int> eventsBeside(const std::vector<int>& indices, const path::State& state) override;
  bool eventGradient(int index, const path::State& state, double& value, path::Vector& byU,
                     double& byLambda) override;
  std::vector<int> eventsAt(const path::State& state) override;
  path::State afterEvent(const std::vector<int>& indices, const path::State& state) override;
  int constraintPivots() const override;
  std::string name(long long unknown) const override;

  path::Pieces* pieces() override;

  /// Paths begin at this state, another one than initialState(): the scale of the residual is at least a
  /// thousandth of the forces there, and of those that its unknowns would need without what is remembered,
  /// from which the forces of a body without stress are the difference. Collective.
  void beginAt(const path::State& start);

  /// Memory::variables: those of all terms that remember (Term::numVariables), of this rank's entities.
  bool remembers() const override;
  std::vector<std::vector<double>> memoryOrders() override;
  path::State settled(const path::State& state) override;

  /// Memory::conditions at a state: of every event function, 0 (free) or 1 (active), then the pieces that
  /// points prefer (fem::PointPieces), of all terms.
  std::vector<int> conditionsAt(const path::State& state) const;
  /// The memory of a state with these conditions and without internal variables. Throws
  /// std::invalid_argument, one line, where their number is not that of this problem.
  std::shared_ptr<const path::Memory> memoryOf(std::vector<int> conditions) const;

  /// The state at load factor lambda before any load acts: prescribed values, those of FeModel::initial
  /// elsewhere.
  linear::RCP<path::Vector> initialState(double lambda) const;

  /// Forces that the supports exert on the body at a state, with those of coupled dofs, zero at free dofs:
  /// [dof], on every rank.
  std::vector<double> reactions(const path::State& state) const;
  /// [dof] the forces with which couplings hold their slaves, 0 elsewhere. Collective.
  std::vector<double> slaveForces(const path::State& state) const;

  /// Nodal forces of one term at a state.
  std::vector<double> forces(const Term& term, const path::State& state) const;

  /// Named values of term i at all its points, those of all ranks' entities, on every rank.
  PointValues observe(int i, const path::State& state) const;

  /// The state as the terms read it, which now have its memory: the unknowns of this rank's nodes. Holds
  /// until the next call to the problem.
  ConstDofView onRank(const path::State& state) const;

  /// What the problem was made of; its terms are the problem's own, with several ranks those of this rank's
  /// part.
  const FeModel& model() const;

  /// A vector of the map as plain numbers [dof], on every rank. Collective.
  static std::vector<double> values(const path::Vector& u);

  const Term& term(int i) const;
  int numTerms() const;
  /// [entity of the whole term] the rank that runs the law of term i there.
  const std::vector<int>& ranksOf(int i) const;
  int numFreeDofs() const;
  /// Bytes of the terms' histories for series of order `maxOrder`, on all ranks together.
  std::size_t historyBytes(int maxOrder) const;

 private:
  /// Scales, start and size of prescribed rows.
  void evaluateStart();

  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// View of a vector's values for the element loops.
ConstDofView field(const path::Vector& u);

}  // namespace atrapos::fem
