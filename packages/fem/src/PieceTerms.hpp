#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "EventTerms.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/path/Pieces.hpp"

namespace atrapos::fem {

/// The terms of a model whose points lie on pieces, as path::Pieces. A break is (point, piece that it goes on
/// to): its index is that of the first break plus, term by term, (pieces + 1) point + piece + 1, piece -1 for
/// none.
///
/// On several ranks points have the numbers of the whole model. All ranks go through the same places of a
/// series and are told the pieces of all points there; all but the queries is collective.
class PieceTerms final : public path::Pieces {
 public:
  /// A state as the terms of this rank read it, and the problem's residual.
  using Local = std::function<ConstDofView(const path::State&)>;
  using Residual = std::function<path::ResidualNorm(const path::State&, path::Vector&)>;

  PieceTerms(const std::vector<std::unique_ptr<Term>>& terms, const EventTerms& events,
             const detail::Distribution& ranks, Local local, Residual residual);

  bool empty() const { return entries_.empty(); }

  path::ResidualNorm residualOfSeries(const path::State& state, path::Vector& r) override;
  bool eventsAstray(const path::State& state, const std::vector<int>& events) const override;
  std::vector<path::Break> breaks(const path::Series& series, double end) const override;
  bool continues(const path::State& state, int index) const override;
  std::string text(int index) const override;

  /// Applies those of the indices that are breaks, at a state as the terms of this rank read it.
  void apply(const std::vector<int>& indices, const ConstDofView& u, double lambda);

  /// The pieces that points prefer, term by term.
  std::vector<int> conditions() const;
  void setConditions(const std::vector<int>& conditions);
  int numPoints() const;

 private:
  struct Entry {
    Term* term;
    PointPieces* pieces;
    int firstIndex;
  };
  struct Place {
    const Entry* entry;
    int point, piece;
  };
  Place placeOf(int index) const;
  /// [point of the whole term] what `of` tells of this rank's points, by their numbers here.
  template <class Of>
  std::vector<int> ofAllPoints(const Entry& entry, const Of& of) const;
  /// What `of` tells of one point, by its number here, where it is of this rank.
  template <class Of>
  int ofPoint(const Entry& entry, int point, const Of& of) const;
  std::vector<int> piecesAt(const Entry& entry, const path::State& state) const;
  int pieceAt(const Entry& entry, int point, const std::vector<double>& places) const;
  int pieceOfSeries(const Entry& entry, int point) const;

  const EventTerms& events_;
  const detail::Distribution& ranks_;
  Local local_;
  Residual residual_;
  std::vector<Entry> entries_;
  int firstIndex_ = 0;
};

}  // namespace atrapos::fem
