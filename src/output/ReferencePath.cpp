#include "output/ReferencePath.hpp"

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>

namespace atrapos {
namespace {

double distance(const std::vector<double>& p, const std::vector<double>& q) {
  double square = 0;
  for (std::size_t i = 0; i < p.size(); ++i) square += (p[i] - q[i]) * (p[i] - q[i]);
  return std::sqrt(square);
}

/// The place on the chord from p to q that is nearest to x, as a part of the chord, and its distance.
std::pair<double, double> nearest(const std::vector<double>& x, const std::vector<double>& p,
                                  const std::vector<double>& q) {
  double dot = 0, square = 0, gap = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    dot += (x[i] - p[i]) * (q[i] - p[i]);
    square += (q[i] - p[i]) * (q[i] - p[i]);
  }
  const double t = square > 0 ? std::min(1.0, std::max(0.0, dot / square)) : 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double d = x[i] - p[i] - t * (q[i] - p[i]);
    gap += d * d;
  }
  return {t, std::sqrt(gap)};
}

}  // namespace

ReferencePath::Point ReferencePath::point(const path::Vector& u, double lambda) const {
  const auto data = u.getData();
  Point p(data.begin(), data.end());
  for (double& x : p) x *= std::sqrt(weight_);
  p.push_back(lambda);
  return p;
}

void ReferencePath::append(const path::StepReport& report, const path::Series& series) {
  if (points_.empty()) {
    weight_ = series.weight();
    append(point(*series.coefficient(0).u, series.lambdaCoefficient(0)));
  }
  path::Vector u(series.coefficient(0).u->getMap());
  for (int j = 1; j < samples_; ++j) {
    const double lambda = series.evaluate(report.length * j / samples_, u);
    append(point(u, lambda));
  }
  append(point(*report.end.u, report.end.lambda));
}

void ReferencePath::append(Point point) {
  at_.push_back(points_.empty() ? 0 : at_.back() + distance(point, points_.back()));
  points_.push_back(std::move(point));
}

double ReferencePath::extent() const {
  double largest = 0;
  for (const Point& p : points_) largest = std::max(largest, distance(p, points_.front()));
  return largest;
}

bool ReferencePath::Walker::nearEnd() const {
  return distance(last_, path_.points_.back()) <= 2 * tolerance_;
}

ReferencePath::Walker::Place ReferencePath::Walker::go(const path::Vector& u, double lambda) {
  const Point x = path_.point(u, lambda);
  const double gone = last_.empty() ? 0 : distance(x, last_);
  last_ = x;
  // An arc between close states is not longer than three chords, sharp turns included.
  const double first = reached_ - 2 * tolerance_, last = reached_ + 3 * gone + 4 * tolerance_;
  const auto& at = path_.at_;
  const auto index = [&](double place) {
    return static_cast<std::size_t>(std::upper_bound(at.begin(), at.end(), place) - at.begin());
  };
  const std::size_t from = std::max<std::size_t>(index(first), 1);
  double best = tolerance_, place = -1;
  for (std::size_t i = from; i < at.size() && at[i - 1] <= last; ++i) {
    const auto [t, d] = nearest(x, path_.points_[i - 1], path_.points_[i]);
    if (d > best) continue;
    best = d;
    place = at[i - 1] + t * (at[i] - at[i - 1]);
  }
  if (place >= 0) {
    reached_ = std::max(reached_, place);
    return Place::on;
  }
  for (std::size_t i = 1; i < from; ++i)
    if (nearest(x, path_.points_[i - 1], path_.points_[i]).second <= tolerance_) return Place::behind;
  return Place::off;
}

}  // namespace atrapos
