#pragma once

#include <string>
#include <vector>

#include "LinePoints.hpp"

namespace atrapos::fem {

/// Zones of up to kLanes lines, side by side; lanes beyond the last zone repeat the first.
struct ZoneBatch {
  int lanes = 0;
  std::vector<double> limits;     ///< [2][lane] xi
  std::vector<Hold> hold;         ///< [2][lane] of the limits
  std::vector<double> widthUnit;  ///< [lane] of its width among the internal variables; 0: it is none
  std::vector<double> deepest;    ///< [2][lane] xi of the least gap of the zone, and that gap
  std::vector<double> c;          ///< [coefficient][lane] of the places
  std::vector<double> reference;  ///< [coefficient][lane] of the undeformed lines
  std::vector<double> across;     ///< [coefficient][lane]: dA = |dX/dxi x across| dxi
  std::vector<int> piece;         ///< [lane] of the tool that the zone is over; PointPieces::any: it has none
  std::vector<int> limitPiece;    ///< [2][lane] that the limit is held on: of a border the one below it
  std::string wrong;              ///< with one of the zones, in a line; empty where nothing is
  std::vector<int> nth;           ///< [lane] of the zones of its line
};

/// What the pressure on zones does on the lines' coefficients: F_k = integral from xi_1 to xi_2 of -p n xi^k
/// dA, by Gauss points that lie between the limits and move with them.
class ZoneForces {
 public:
  /// Points of a zone: integrands that are analytic within a distance of several zones are then exact to
  /// rounding, and the tangent needs no part of the limits.
  static constexpr int kPoints = 10;

  explicit ZoneForces(const LineLaws& laws);

  /// forces [coefficient][lane].
  void value(const ZoneBatch& zones, double lambda, double* forces) const;
  /// And their derivatives, [coefficient][coefficient, lambda][lane]. The limits have no part in them: p
  /// vanishes at those that move.
  void tangent(const ZoneBatch& zones, double lambda, double* forces, double* jacobian) const;
  /// What the hat functions f_j of places xi on the line take of a zone: integrals of p f_j dA and of f_j dA,
  /// [place][lane], and of p f_j d_i dA and p f_j d_i^2 dA, [place][3][lane], d the way in space from the
  /// line's middle, the coefficients of xi^0. Sums over j are the integrals without f_j.
  struct Shares {
    std::vector<double> forces, areas, moments, squares;
  };
  Shares shares(const ZoneBatch& zones, double lambda, const std::vector<double>& places) const;
  /// [lane] the pressure at gaps, [lane].
  std::vector<double> pressures(const double* gaps) const;

  void reserve(int batches, int maxOrder);
  std::size_t bytes(int batches, int maxOrder) const;
  void start(int b, const ZoneBatch& zones, double lambda, PointFailure& failure);
  /// Forces where the lines have the coefficients c, by zones that go on from those of the series on the same
  /// pieces of the tool: their roots are near the limits, [2][lane].
  void valueOfSeries(int b, const std::vector<double>& limits, const std::vector<double>& c, double lambda,
                     double* forces) const;
  /// Makes order k - 1 that of the coefficients (last, lastLambda), then forces of order k with c_k = 0.
  void advance(int b, const SeriesOrder& order, const double* last, double lastLambda, double* forces);

  const LinePoints& limits() const { return limits_; }

 private:
  /// What is at the Gauss points, [point][...][lane].
  struct Points {
    std::vector<double> places, weights, hn, pressure;  ///< xi; dA; h, n; p
    std::vector<double> positions;                      ///< x, y, z
  };
  /// pieces: the projection's data of the points; null: where they are.
  Points pointsOf(const ZoneBatch& zones, double lambda, const double* pieces = nullptr) const;
  void add(const Points& points, double* forces) const;
  std::vector<double> inputs(const double* limits, const double* c) const;
  std::vector<double> dataOf(const ZoneBatch& zones) const;

  const LineLaws& laws_;
  std::vector<double> abscissae_, weights_;  ///< of Gauss' rule on [0, 1]
  LinePoints limits_;
  SeriesOrder start_;
  std::size_t cubatureDoubles_ = 0, projectionDoubles_ = 0, pressureDoubles_ = 0, perBatch_ = 0;
  std::vector<double> history_, data_;
  std::vector<ZoneBatch> ofSeries_;
  std::vector<double> pieces_;  ///< [batch] the projection's data, those of the start
};

}  // namespace atrapos::fem
