#pragma once

#include <memory>
#include <vector>

#include "LineStages.hpp"
#include "atrapos/fem/ZoneTerm.hpp"

namespace atrapos::fem {

constexpr int L = kLanes;  ///< lines side by side

/// The laws of lines of one degree, put together when the program runs.
struct LineLaws {
  LineLaws(int degree, ZoneLaws laws);

  int degree;
  std::unique_ptr<PointLaw> curve, slope, cubature, force, projection, pressure;
  PieceSearch pieces;  ///< of the projection's data

  int coefficients() const { return 3 * (degree + 1); }  ///< of a line, [k][component]
  int placeInputs() const { return projection->shape().inputs; }
  int placeOutputs() const { return projection->shape().outputs; }
  bool moves() const { return placeInputs() == 4; }
  bool hasPieces() const { return static_cast<bool>(pieces.update); }

  /// The projection's data at places, [point][input][lane] -> [point][datum][lane]; empty where it has none.
  /// preferred: [point][lane] the piece to be taken where a place lies on the border of several; null: any.
  std::vector<double> located(int numPoints, const double* places, const int* preferred = nullptr) const;
  /// Whether a place with these data is over nothing: its gap is infinite and does not change.
  bool overNothing(const std::vector<double>& data, int point, int lane) const {
    return hasPieces() && data[(point * pieces.numData + pieces.piece) * L + lane] < 0;
  }
  /// The projection at places, [point][output][lane].
  std::vector<double> projected(int numPoints, const double* places) const;
};

/// What keeps a point of a line at its place.
enum class Hold {
  place,     ///< xi stays
  root,      ///< h = 0
  extremum,  ///< dh/dxi = 0
  border1,   ///< the first of the coordinates in its piece stays, -1 or 1
  border2    ///< the second
};
inline bool isBorder(Hold hold) { return hold == Hold::border1 || hold == Hold::border2; }

/// Gap and derivatives at points of lines. All arrays are [point][...][lane], c is [coefficient][lane].
struct LineProbe {
  std::vector<double> gap, slope, bend;  ///< h, dh/dxi, d2h/dxi2 along the line
  std::vector<double> gradient;          ///< [4] dh/dx, dh/dlambda at the point
  std::vector<double> normal;            ///< [3]
  std::vector<double> turn;              ///< [3][4] dn/dx, dn/dlambda
  std::vector<double> along;             ///< [3] dx/dxi
  std::vector<double> in;                ///< [2] coordinates in the piece, where the surface has some
  std::vector<double> inBy;              ///< [2][4] and by x, lambda
  double inSlope(int coordinate, int point, int lane) const;  ///< of one of these along the line, by xi
};
/// A place over nothing (piece -1) has an infinite gap that does not change.
LineProbe probe(const LineLaws& laws, int numPoints, const double* xi, const double* c, double lambda,
                const int* preferred = nullptr);

/// The gaps alone.
std::vector<double> gaps(const LineLaws& laws, int numPoints, const double* xi, const double* c,
                         double lambda);

/// Series of points of lines whose places are local unknowns xi(a): roots of the gap, of its slope, or of the
/// way to a border of the piece. To order k, with what r(xi, c) = 0 leaves at xi_k = 0,
///     xi_k = -(r_k + dr/dc c_k)/(dr/dxi),
/// the second part when c_k comes.
class LinePoints {
 public:
  LinePoints(const LineLaws& laws, int perLine) : laws_(laws), P_(perLine) {}

  void reserve(int batches, int maxOrder);
  std::size_t bytes(int batches, int maxOrder) const;

  /// Order 0 at xi, [point][lane], with the gaps; on preferred pieces, [point][lane], where they are on a
  /// border.
  void start(int b, const double* xi, const Hold* hold, const double* c, double lambda, const int* preferred,
             double* gap, PointFailure& failure);

  /// xi, [point][lane], in another state, on the pieces of the series: roots near these places.
  std::vector<double> rootsNear(int b, std::vector<double> xi, const double* c, double lambda) const;

  struct Orders {
    std::vector<double> last;     ///< xi_{k-1}: what it gains from the coefficients of that order
    std::vector<double> current;  ///< xi_k with c_k = 0
    std::vector<double> gap;      ///< h_k with c_k = 0; of roots also with xi_k = 0
  };
  /// Makes order k - 1 that of the coefficients (last, lastLambda), then order k.
  void advance(int b, const SeriesOrder& order, const double* last, double lastLambda, Orders& out);

  /// What (c, lambda) of the order under way adds to h_k.
  double gapBy(int b, int point, int lane, const double* c, double lambda) const;
  /// And to xi_k.
  double placeBy(int b, int point, int lane, const double* c, double lambda) const;
  /// xi_k with c_k = 0, of the order swept last; of order 0 the place.
  double place(int b, int point, int lane) const { return at(b, point, lane).pending; }

 private:
  struct Point {
    double xi = 0, pending = 0;         ///< place of order 0; xi_k with c_k = 0
    double byGap = 0, bySlope = 0;      ///< -1/(dr/dxi) of r = h or dh/dxi
    int output = 0;                     ///< of the projection: h, or what is in its place
    double gradient[4] = {0, 0, 0, 0};  ///< dh/dx, dh/dlambda
    double normal[3] = {0, 0, 0}, slopeBy[4] = {0, 0, 0, 0};  ///< d(dh/dxi) by dx/dxi; by x, lambda
  };
  const Point& at(int b, int p, int lane) const {
    return points_[(static_cast<std::size_t>(b) * P_ + p) * kLanes + lane];
  }
  /// sum_k c_k xi^k and its derivative, at order 0 of xi.
  void motion(const Point& point, const double* c, int lane, double* x, double* along) const;
  std::size_t dataSize() const { return static_cast<std::size_t>(P_) * laws_.projection->shape().data * L; }
  double* memory(int b) { return &history_[static_cast<std::size_t>(b) * perBatch_]; }

  const LineLaws& laws_;
  int P_;
  std::size_t curveDoubles_ = 0, projectionDoubles_ = 0, perBatch_ = 0;
  SeriesOrder start_;
  std::vector<double> history_;
  std::vector<double> data_;  ///< [batch] of the projection: pieces are those of the start
  std::vector<Point> points_;
};

}  // namespace atrapos::fem
