#include "atrapos/fem/PointPieces.hpp"

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "atrapos/fem/Rows.hpp"

namespace atrapos::fem {

PointPieces::PointPieces(PieceSearch search, int numPoints, std::vector<double> data, std::string called)
    : search_(std::move(search)),
      called_(std::move(called)),
      data_(std::move(data)),
      preferred_(numPoints, any),
      numWhole_(numPoints),
      numbers_(numPoints) {
  std::iota(numbers_.begin(), numbers_.end(), 0);
  if (data_.size() != static_cast<std::size_t>(numPoints) * search_.numData)
    throw std::logic_error("PointPieces: wrong number of data");
}

void PointPieces::keep(const std::vector<int>& points) {
  data_ = rowsOf(data_, points, search_.numData);
  preferred_.assign(points.size(), any);
  numbers_ = points;
}

std::vector<double> PointPieces::at(const std::vector<double>& places) const {
  if (held_) return ofSeries_;
  std::vector<double> data = data_;
  search_.update(numPoints(), places.data(), preferred_.data(), data.data());
  return data;
}

int PointPieces::pieceOfSeries(int point) const {
  return ofSeries_.empty() ? any : pieceIn(ofSeries_, point);
}

int PointPieces::pieceAt(int point, const double* place) const {
  const int none = any;
  const auto first = data_.begin() + static_cast<std::size_t>(point) * search_.numData;
  std::vector<double> data(first, first + search_.numData);
  search_.update(1, place, &none, data.data());
  return pieceIn(data, 0);
}

void PointPieces::toggle(int point, int piece) {
  preferred_.at(point) = preferred_.at(point) == piece ? any : piece;
}

void PointPieces::setPreferred(const std::vector<int>& preferred) {
  if (preferred.size() != preferred_.size() ||
      std::any_of(preferred.begin(), preferred.end(), [&](int p) { return p < any || p >= count(); }))
    throw std::invalid_argument("the pieces of " + std::to_string(preferred.size()) +
                                " points are not those of " + std::to_string(numPoints()) + " points on " +
                                std::to_string(count()) + " pieces");
  preferred_ = preferred;
}

void PointPieces::lend(const std::vector<int>& of, PointPieces& part) const {
  for (std::size_t p = 0; p < of.size(); ++p) part.preferred_.at(p) = preferred_.at(of[p]);
  part.hold(held_);
}

void PointPieces::beginSeriesOf(const std::vector<int>& of, const PointPieces* part) {
  const std::size_t each = search_.numData;
  ofSeries_ = data_;
  for (std::size_t p = 0; p < preferred_.size(); ++p) ofSeries_[p * each + search_.piece] = any;
  for (std::size_t p = 0; p < of.size(); ++p)
    std::copy_n(part->ofSeries_.begin() + p * each, each, ofSeries_.begin() + of[p] * each);
}

}  // namespace atrapos::fem
