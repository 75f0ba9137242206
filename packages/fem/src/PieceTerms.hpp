#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "atrapos/fem/Term.hpp"
#include "atrapos/path/Pieces.hpp"

namespace atrapos::fem {

class EventTerm;

/// The terms of a model whose points lie on pieces, as path::Pieces. A break is (point, piece that it goes on
/// to): its index is that of the first break plus, term by term, (pieces + 1) point + piece + 1, piece -1 for
/// none.
class PieceTerms final : public path::Pieces {
 public:
  PieceTerms() = default;
  /// Breaks are numbered from firstIndex on. `residual` is the problem's.
  PieceTerms(const std::vector<std::unique_ptr<Term>>& terms, int firstIndex,
             std::function<path::ResidualNorm(const path::Vector&, double, path::Vector&)> residual);

  bool empty() const { return entries_.empty(); }

  path::ResidualNorm residualOfSeries(const path::Vector& u, double lambda, path::Vector& r) override;
  bool eventsAstray(const path::Vector& u, double lambda, const std::vector<int>& events) const override;
  std::vector<path::Break> breaks(const path::Series& series, double end) const override;
  bool continues(const path::Vector& u, double lambda, int index) const override;
  std::string text(int index) const override;

  /// Applies those of the indices that are breaks at the state (u, lambda).
  void apply(const std::vector<int>& indices, const path::Vector& u, double lambda);

  /// The pieces that points prefer, term by term.
  std::vector<int> conditions() const;
  void setConditions(const std::vector<int>& conditions);
  int numPoints() const;

 private:
  struct Entry {
    Term* term;
    PointPieces* pieces;
    EventTerm* events;  ///< the same term where it has event functions, and the first of them
    int firstEvent, firstIndex;
  };
  struct Place {
    const Entry* entry;
    int point, piece;
  };
  Place placeOf(int index) const;

  std::vector<Entry> entries_;
  int firstIndex_ = 0;
  std::function<path::ResidualNorm(const path::Vector&, double, path::Vector&)> residual_;
};

}  // namespace atrapos::fem
