#pragma once

#include <Teuchos_Comm.hpp>
#include <Teuchos_EReductionType.hpp>
#include <exception>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/fem/FeModel.hpp"
#include "atrapos/fem/Partition.hpp"

namespace atrapos::fem::detail {

using Comm = Teuchos::Comm<int>;

/// What one rank of a finite-element problem holds, and how sums over ranks are made
/// (docs/theory/parallel.md).
///
/// The rank counts its nodes: first those whose rows it owns, then the ones that its entities share with
/// other owners, each in the order of the whole model; behind them the nodes that occur in its columns only.
/// Fields have the unknowns of the first two kinds. With one rank all nodes are owned and nothing
/// is sent.
///
/// All but the queries is collective.
class Distribution {
 public:
  /// Cuts the model; its terms stay whole.
  Distribution(const FeModel& model, const std::vector<Coupling>& couplings, linear::RCP<const Comm> comm);

  bool alone() const { return comm_->getSize() == 1; }
  int rank() const { return comm_->getRank(); }
  const linear::RCP<const Comm>& comm() const { return comm_; }

  int numOwned() const { return numOwned_; }
  int numLocal() const { return numLocal_; }                           ///< owned and shared
  int numColumns() const { return static_cast<int>(nodes_.size()); }   ///< and those in columns only
  const std::vector<int>& nodes() const { return nodes_; }             ///< [node of the rank] in the model
  const DofMap& dofs() const { return dofs_; }                         ///< of these nodes
  int localOf(int node) const { return localOf_[node]; }               ///< -1: none of this rank
  const std::vector<std::vector<int>>& rows() const { return rows_; }  ///< [local] columns, ascending
  /// Entries of a row of a node's unknowns.
  int rowLength(int node) const;
  /// Where the unknowns of a column's node begin in it.
  int positionInRow(int node, int column) const;
  const std::vector<std::vector<int>>& entities() const { return entities_; }  ///< [term] this rank's
  const std::vector<int>& ranksOf(int term) const { return ranksOf_[term]; }   ///< [entity] rank
  /// The couplings that this rank eliminates, with its own dofs.
  const std::vector<Coupling>& couplings() const { return couplings_; }

  /// The owners' values at shared nodes.
  void fetch(const DofView& f) const;
  /// Adds what all ranks have at shared nodes to their owners': own part first, then the ranks' in ascending
  /// order. Shared entries keep what they were.
  void collect(const DofView& f) const;
  /// The same for the rows of a matrix; rowStart: [dof] first entry.
  void collectRows(const View<std::size_t*>& rowStart, const View<double*>& values) const;

  double sum(double x) const;
  double max(double x) const;
  /// Element by element; the sum is exact where all ranks but one have zeros.
  void sum(std::vector<double>& x) const;
  void min(std::vector<double>& x) const;

  /// Calls f on every rank. Where it throws on some, all throw what the first of them did.
  template <class F>
  void together(const F& f) const {
    if (alone()) return f();
    std::string what;
    std::exception_ptr own;
    bool ofInput = false;
    try {
      f();
    } catch (const std::exception& error) {
      what = error.what();
      own = std::current_exception();
      ofInput = dynamic_cast<const std::invalid_argument*>(&error) != nullptr;
    }
    agree(what, own, ofInput);
  }

 private:
  /// Nodes that this rank shares with one other.
  struct Neighbour {
    int rank = 0;
    std::vector<int> theirs;  ///< nodes of this rank that the other one owns
    std::vector<int> ours;    ///< nodes owned here that the other one shares
    /// Their entries in our rows: [node of `ours`][column] where the column's unknowns begin, and how many.
    std::vector<int> columnStart, columns, columnSizes;
    std::size_t received = 0;  ///< entries of their rows of `ours`
    std::size_t sent = 0;      ///< entries of our rows of `theirs`
  };
  using Nodes = std::vector<int> Neighbour::*;
  /// Sends the field at the given nodes of every neighbour and puts what comes into the taken ones, the
  /// ranks' in ascending order.
  template <class Put>
  void trade(const DofView& f, Nodes given, Nodes taken, const Put& put) const;
  void cutRows(const FeModel& model, const std::vector<Coupling>& couplings, const Partition& p);
  void findNeighbours(const std::vector<std::vector<int>>& ranksAt, const Partition& p);
  void matchRows();
  void reduce(Teuchos::EReductionType how, std::vector<double>& x) const;
  void agree(const std::string& what, const std::exception_ptr& own, bool ofInput) const;

  linear::RCP<const Comm> comm_;
  int numOwned_ = 0, numLocal_ = 0;
  std::vector<int> nodes_, localOf_;
  DofMap dofs_;
  std::vector<std::vector<int>> rows_, entities_, ranksOf_;
  std::vector<Coupling> couplings_;
  std::vector<Neighbour> neighbours_;  ///< by ascending rank
};

}  // namespace atrapos::fem::detail
