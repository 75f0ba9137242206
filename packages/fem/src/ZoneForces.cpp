#include "ZoneForces.hpp"

#include <algorithm>
#include <cmath>

#include "atrapos/fem/ReferenceCell.hpp"

namespace atrapos::fem {
namespace {

constexpr int Q = ZoneForces::kPoints;

/// to[q][first + m][lane] = from[q][start + m][lane], m < count.
void put(int count, const std::vector<double>& from, int start, int fromWidth, int first, int toWidth,
         std::vector<double>& to) {
  for (int q = 0; q < Q; ++q)
    std::copy_n(&from[(q * fromWidth + start) * L], count * L, &to[(q * toWidth + first) * L]);
}

/// [point][lane] the pieces of the points of zones.
std::vector<int> preferred(const ZoneBatch& zones) {
  std::vector<int> all;
  for (int q = 0; q < Q; ++q) all.insert(all.end(), zones.piece.begin(), zones.piece.end());
  return all;
}

}  // namespace

ZoneForces::ZoneForces(const LineLaws& laws) : laws_(laws), limits_(laws, 2) {
  const Tabulation gauss = tabulateFace(Face::Line2, 2 * Q - 1);
  for (int q = 0; q < Q; ++q) {
    abscissae_.push_back(0.5 * (1 + gauss.points[q]));
    weights_.push_back(0.5 * gauss.weights[q]);
  }
}

/// [q][xi_1, xi_2, c][lane].
std::vector<double> ZoneForces::inputs(const double* limits, const double* c) const {
  const int C = laws_.coefficients();
  std::vector<double> in(Q * (2 + C) * L);
  for (int q = 0; q < Q; ++q) {
    std::copy_n(limits, 2 * L, &in[q * (2 + C) * L]);
    std::copy_n(c, C * L, &in[(q * (2 + C) + 2) * L]);
  }
  return in;
}

std::vector<double> ZoneForces::dataOf(const ZoneBatch& zones) const {
  const int C = laws_.coefficients();
  std::vector<double> data(Q * (2 + 2 * C) * L);
  for (int q = 0; q < Q; ++q) {
    double* own = &data[q * (2 + 2 * C) * L];
    for (const double number : {abscissae_[q], weights_[q]}) own = std::fill_n(own, L, number);
    own = std::copy_n(zones.reference.data(), C * L, own);
    std::copy_n(zones.across.data(), C * L, own);
  }
  return data;
}

ZoneForces::Points ZoneForces::pointsOf(const ZoneBatch& zones, double lambda, const double* pieces) const {
  const int J = laws_.placeInputs(), H = laws_.placeOutputs();
  const auto in = inputs(zones.limits.data(), zones.c.data()), data = dataOf(zones);
  std::vector<double> scratch(
      std::max({laws_.cubature->historyDoubles(0), laws_.projection->historyDoubles(0),
                laws_.pressure->historyDoubles(0)}));
  std::vector<double> x(5 * Q * L), place(Q * J * L, 0.0), h(Q * L);
  Points points;
  laws_.cubature->value({Q, L, data.data(), scratch.data()}, in.data(), x.data());
  put(3, x, 0, 5, 0, J, place);
  if (J == 4)
    for (int q = 0; q < Q; ++q) std::fill_n(&place[(q * J + 3) * L], L, lambda);
  points.hn.resize(H * Q * L);
  points.positions.resize(3 * Q * L);
  points.places.resize(Q * L);
  points.weights.resize(Q * L);
  points.pressure.resize(Q * L);
  std::vector<double> located;
  if (pieces == nullptr) located = laws_.located(Q, place.data(), preferred(zones).data());
  laws_.projection->value({Q, L, pieces == nullptr ? located.data() : pieces, scratch.data()}, place.data(),
                          points.hn.data());
  put(1, points.hn, 0, H, 0, 1, h);
  laws_.pressure->value({Q, L, nullptr, scratch.data()}, h.data(), points.pressure.data());
  put(3, x, 0, 5, 0, 3, points.positions);
  put(1, x, 3, 5, 0, 1, points.places);
  put(1, x, 4, 5, 0, 1, points.weights);
  return points;
}

void ZoneForces::value(const ZoneBatch& zones, double lambda, double* forces) const {
  add(pointsOf(zones, lambda), forces);
}

void ZoneForces::valueOfSeries(int b, const std::vector<double>& limits, const std::vector<double>& c,
                               double lambda, double* forces) const {
  ZoneBatch zones = ofSeries_[b];
  zones.limits = limits_.rootsNear(b, limits, c.data(), lambda);
  zones.c = c;
  add(pointsOf(zones, lambda, pieces_.data() + b * (pieces_.size() / ofSeries_.size())), forces);
}

void ZoneForces::add(const Points& points, double* forces) const {
  std::fill_n(forces, laws_.coefficients() * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      double share = -points.pressure[q * L + lane] * points.weights[q * L + lane];
      for (int k = 0; k <= laws_.degree; ++k, share *= points.places[q * L + lane])
        for (int i = 0; i < 3; ++i)
          forces[(3 * k + i) * L + lane] += share * points.hn[(laws_.placeOutputs() * q + 1 + i) * L + lane];
    }
}

ZoneForces::Shares ZoneForces::shares(const ZoneBatch& zones, double lambda,
                                      const std::vector<double>& places) const {
  const Points points = pointsOf(zones, lambda);
  const std::size_t count = places.size();
  Shares shares;
  shares.forces.resize(count * L);
  shares.areas.resize(count * L);
  shares.moments.resize(count * 3 * L);
  shares.squares.resize(count * 3 * L);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const double xi = points.places[q * L + lane], area = points.weights[q * L + lane];
      const auto add = [&](std::size_t place, double part) {
        const double force = part * area * points.pressure[q * L + lane];
        shares.forces[place * L + lane] += force;
        shares.areas[place * L + lane] += part * area;
        for (int i = 0; i < 3; ++i) {
          const double way = points.positions[(3 * q + i) * L + lane] - zones.c[i * L + lane];
          shares.moments[(3 * place + i) * L + lane] += force * way;
          shares.squares[(3 * place + i) * L + lane] += force * way * way;
        }
      };
      const std::size_t above = std::upper_bound(places.begin(), places.end(), xi) - places.begin();
      if (above == 0 || above == count) {
        add(above == 0 ? 0 : count - 1, 1);
        continue;
      }
      const double t = (xi - places[above - 1]) / (places[above] - places[above - 1]);
      add(above - 1, 1 - t);
      add(above, t);
    }
  return shares;
}

std::vector<double> ZoneForces::pressures(const double* gaps) const {
  std::vector<double> scratch(laws_.pressure->historyDoubles(0)), pressures(L);
  laws_.pressure->value({1, L, nullptr, scratch.data()}, gaps, pressures.data());
  return pressures;
}

void ZoneForces::tangent(const ZoneBatch& zones, double lambda, double* forces, double* jacobian) const {
  const Points points = pointsOf(zones, lambda);
  add(points, forces);
  const int C = laws_.coefficients(), P = laws_.degree;
  const LineProbe at = probe(laws_, Q, points.places.data(), zones.c.data(), lambda, preferred(zones).data());
  std::vector<double> scratch(laws_.pressure->historyDoubles(0)), h(Q * L), p(Q * L), rate(Q * L);
  put(1, points.hn, 0, laws_.placeOutputs(), 0, 1, h);
  laws_.pressure->tangent({Q, L, nullptr, scratch.data()}, h.data(), p.data(), rate.data());
  std::fill_n(jacobian, C * (C + 1) * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const double s = points.places[q * L + lane], weight = points.weights[q * L + lane];
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 4; ++j) {  // by x, y, z, lambda
          const double a = -weight * (rate[q * L + lane] * at.gradient[(4 * q + j) * L + lane] *
                                          at.normal[(3 * q + i) * L + lane] +
                                      p[q * L + lane] * at.turn[((3 * q + i) * 4 + j) * L + lane]);
          double power = a;
          for (int k = 0; k <= P; ++k, power *= s) {
            double* row = jacobian + (3 * k + i) * (C + 1) * L + lane;
            if (j == 3) {
              row[C * L] += power;
              continue;
            }
            double entry = power;
            for (int l = 0; l <= P; ++l, entry *= s) row[(3 * l + j) * L] += entry;
          }
        }
    }
}

void ZoneForces::reserve(int batches, int maxOrder) {
  start_ = seriesOrder(0, maxOrder);
  limits_.reserve(batches, maxOrder);
  cubatureDoubles_ = Q * laws_.cubature->seriesDoubles(start_);
  projectionDoubles_ = Q * laws_.projection->seriesDoubles(start_);
  pressureDoubles_ = Q * laws_.pressure->seriesDoubles(start_);
  perBatch_ =
      cubatureDoubles_ + projectionDoubles_ + pressureDoubles_ + Q * laws_.force->seriesDoubles(start_);
  history_.resize(batches * perBatch_);
  data_.resize(static_cast<std::size_t>(batches) * Q * laws_.cubature->shape().data * L);
  ofSeries_.resize(batches);
  pieces_.resize(static_cast<std::size_t>(batches) * Q * laws_.projection->shape().data * L);
}

std::size_t ZoneForces::bytes(int batches, int maxOrder) const {
  const SeriesOrder order = seriesOrder(0, maxOrder);
  return limits_.bytes(batches, maxOrder) +
         sizeof(double) * batches * Q *
             (laws_.cubature->seriesDoubles(order) + laws_.projection->seriesDoubles(order) +
              laws_.pressure->seriesDoubles(order) + laws_.force->seriesDoubles(order));
}

void ZoneForces::start(int b, const ZoneBatch& zones, double lambda, PointFailure& failure) {
  const int J = laws_.placeInputs(), H = laws_.placeOutputs();
  std::vector<double> gaps(2 * L);
  ofSeries_[b] = zones;
  limits_.start(b, zones.limits.data(), zones.hold.data(), zones.c.data(), lambda, zones.limitPiece.data(),
                gaps.data(), failure);
  const auto own = dataOf(zones);
  double* data = std::copy(own.begin(), own.end(), &data_[b * own.size()]) - own.size();
  double* memory = &history_[b * perBatch_];
  const auto in = inputs(zones.limits.data(), zones.c.data());
  std::vector<double> x(5 * Q * L), place(Q * J * L, 0.0), hn(H * Q * L), h(Q * L), p(Q * L),
      onForce(6 * Q * L), out(Q * laws_.coefficients() * L);
  laws_.cubature->start({Q, L, data, memory}, start_, in.data(), x.data(), failure);
  put(3, x, 0, 5, 0, J, place);
  if (J == 4)
    for (int q = 0; q < Q; ++q) std::fill_n(&place[(q * J + 3) * L], L, lambda);
  memory += cubatureDoubles_;
  const auto located = laws_.located(Q, place.data(), preferred(zones).data());
  double* pieces =
      std::copy(located.begin(), located.end(), pieces_.data() + b * located.size()) - located.size();
  laws_.projection->start({Q, L, pieces, memory}, start_, place.data(), hn.data(), failure);
  put(1, hn, 0, H, 0, 1, h);
  memory += projectionDoubles_;
  laws_.pressure->start({Q, L, nullptr, memory}, start_, h.data(), p.data(), failure);
  put(1, p, 0, 1, 0, 6, onForce);
  put(3, hn, 1, H, 1, 6, onForce);
  put(2, x, 3, 5, 4, 6, onForce);
  memory += pressureDoubles_;
  laws_.force->start({Q, L, nullptr, memory}, start_, onForce.data(), out.data(), failure);
}

void ZoneForces::advance(int b, const SeriesOrder& order, const double* last, double lastLambda,
                         double* forces) {
  const int C = laws_.coefficients(), J = laws_.placeInputs(), H = laws_.placeOutputs();
  LinePoints::Orders limits;
  limits_.advance(b, order, last, lastLambda, limits);
  // Of order k - 1 the Gauss points have had what the limits were then; of order k they get what they are.
  const std::vector<double> none(C * L, 0.0);
  const auto lastIn = inputs(limits.last.data(), order.k > 1 ? last : none.data()),
             in = inputs(limits.current.data(), none.data());
  std::vector<double> lastX(5 * Q * L), x(5 * Q * L), lastPlace(Q * J * L, 0.0), place(Q * J * L, 0.0),
      lastHn(H * Q * L), hn(H * Q * L), lastH(Q * L), h(Q * L), lastP(Q * L), p(Q * L), lastOn(6 * Q * L),
      on(6 * Q * L), out(Q * C * L);
  const double* data = &data_[static_cast<std::size_t>(b) * Q * laws_.cubature->shape().data * L];
  double* memory = &history_[b * perBatch_];
  laws_.cubature->advance({Q, L, data, memory}, order, {lastIn.data(), in.data()}, {lastX.data(), x.data()});
  put(3, x, 0, 5, 0, J, place);
  put(3, lastX, 0, 5, 0, J, lastPlace);
  if (J == 4)
    for (int q = 0; q < Q; ++q) std::fill_n(&lastPlace[(q * J + 3) * L], L, lastLambda);
  memory += cubatureDoubles_;
  const double* pieces =
      pieces_.data() + static_cast<std::size_t>(b) * Q * laws_.projection->shape().data * L;
  laws_.projection->advance({Q, L, pieces, memory}, order, {lastPlace.data(), place.data()},
                            {lastHn.data(), hn.data()});
  put(1, hn, 0, H, 0, 1, h);
  put(1, lastHn, 0, H, 0, 1, lastH);
  memory += projectionDoubles_;
  laws_.pressure->advance({Q, L, nullptr, memory}, order, {lastH.data(), h.data()}, {lastP.data(), p.data()});
  put(1, p, 0, 1, 0, 6, on);
  put(3, hn, 1, H, 1, 6, on);
  put(2, x, 3, 5, 4, 6, on);
  put(1, lastP, 0, 1, 0, 6, lastOn);
  put(3, lastHn, 1, H, 1, 6, lastOn);
  put(2, lastX, 3, 5, 4, 6, lastOn);
  memory += pressureDoubles_;
  laws_.force->advance({Q, L, nullptr, memory}, order, {lastOn.data(), on.data()}, {nullptr, out.data()});
  std::fill_n(forces, C * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int m = 0; m < C * L; ++m) forces[m] += out[q * C * L + m];
}

}  // namespace atrapos::fem
