#pragma once

#include <functional>
#include <string>
#include <vector>

namespace atrapos::fem {

/// Which piece of a law that is analytic piece by piece every point is on: the patch of a surface, say.
struct PieceSearch {
  int count = 0;      ///< of the pieces, numbered from 0; -1 stands for none of them
  int numInputs = 3;  ///< of a place: 3, or 4 with the load factor
  int numData = 0;    ///< passive data of the law a point
  int piece = 0;      ///< the datum that holds the number of the piece
  /// Brings data, [point][datum], up to date with places, [point][input]. preferred: [point] the piece to be
  /// taken where the place lies on the border of several, or PointPieces::any. A function of its arguments
  /// alone, on the host.
  std::function<void(int numPoints, const double* places, const int* preferred, double* data)> update;
};

/// The pieces of a term's points: found from the place alone, but for points that a path has led on to a
/// border: these prefer the piece that the path goes on to. A series keeps the pieces of its start.
class PointPieces {
 public:
  static constexpr int any = -2;

  /// `data`: those that the term was made with; called: a point in messages.
  PointPieces(PieceSearch search, int numPoints, std::vector<double> data,
              std::string called = "contact point");

  /// Drops all points but these.
  void keep(const std::vector<int>& points);

  int count() const { return search_.count; }
  const std::string& called() const { return called_; }
  int numPoints() const { return static_cast<int>(preferred_.size()); }
  int numInputs() const { return search_.numInputs; }
  int numWhole() const { return numWhole_; }                    ///< points before keep
  const std::vector<int>& numbers() const { return numbers_; }  ///< [point] among those, ascending

  /// The data at these places; those of the series under way while they are held.
  std::vector<double> at(const std::vector<double>& places) const;
  /// From here on a series has these data.
  void beginSeries(const std::vector<double>& data) { ofSeries_ = data; }
  void hold(bool held) { held_ = held && !ofSeries_.empty(); }
  bool held() const { return held_; }

  /// `any` before the first series and for points that have no part in it.
  int pieceOfSeries(int point) const;
  /// The piece at one place, whatever is preferred.
  int pieceAt(int point, const double* place) const;

  /// The point prefers this piece, or none again where it did.
  void toggle(int point, int piece);
  const std::vector<int>& preferred() const { return preferred_; }
  /// Throws std::invalid_argument on pieces that are not there.
  void setPreferred(const std::vector<int>& preferred);

  /// For a term that works with some of the points only, by pieces of its own (`part`: those of the points
  /// `of`, in this order): gives the part what these points prefer and whether their data are held.
  void lend(const std::vector<int>& of, PointPieces& part) const;
  /// The series of the part has begun, of which the other points are not. `part`: null where there is none.
  void beginSeriesOf(const std::vector<int>& of, const PointPieces* part);

 private:
  int pieceIn(const std::vector<double>& data, int point) const {
    return static_cast<int>(data[static_cast<std::size_t>(point) * search_.numData + search_.piece]);
  }

  PieceSearch search_;
  std::string called_;
  std::vector<double> data_, ofSeries_;
  std::vector<int> preferred_;  ///< [point]
  int numWhole_;
  std::vector<int> numbers_;
  bool held_ = false;
};

}  // namespace atrapos::fem
