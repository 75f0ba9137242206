#include "LinePoints.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace atrapos::fem {
namespace {

template <int P>
void makeStages(LineLaws& laws) {
  laws.curve = pointLaw(CurveStage<P>{});
  laws.cubature = pointLaw(CubatureStage<P>{});
  laws.force = pointLaw(ForceStage<P>{});
}

}  // namespace

LineLaws::LineLaws(int lineDegree, ZoneLaws laws)
    : degree(lineDegree),
      slope(pointLaw(SlopeStage{})),
      projection(std::move(laws.projection)),
      pressure(std::move(laws.pressure)) {
  if (degree == 1)
    makeStages<1>(*this);
  else if (degree == 2)
    makeStages<2>(*this);
  else
    throw std::logic_error("LineLaws: lines of degree 1 and 2 only");
  const LawShape place = projection->shape(), own = pressure->shape();
  if ((place.inputs != 3 && place.inputs != 4) || place.outputs != 4 || place.data != 0 || own.inputs != 1 ||
      own.outputs != 1 || own.data != 0)
    throw std::logic_error(
        "LineLaws: a projection of (x, y, z, lambda) on (h, n) and a pressure p(h), without data");
}

LineProbe probe(const LineLaws& laws, int Q, const double* xi, const double* c, double lambda) {
  const int J = laws.placeInputs(), P = laws.degree;
  LineProbe r;
  r.along.resize(3 * Q * L);
  std::vector<double> in(Q * J * L, 0.0), bend(3 * Q * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const double s = xi[q * L + lane];
      for (int i = 0; i < 3; ++i) {
        const double c0 = c[i * L + lane], c1 = c[(3 + i) * L + lane],
                     c2 = P == 2 ? c[(6 + i) * L + lane] : 0;
        in[(q * J + i) * L + lane] = c0 + s * (c1 + s * c2);
        r.along[(3 * q + i) * L + lane] = c1 + 2 * c2 * s;
        bend[(3 * q + i) * L + lane] = 2 * c2;
      }
      if (J == 4) in[(q * J + 3) * L + lane] = lambda;
    }
  std::vector<double> scratch(laws.projection->historyDoubles(0)), out(4 * Q * L), jacobian(4 * J * Q * L);
  laws.projection->tangent({Q, L, nullptr, scratch.data()}, in.data(), out.data(), jacobian.data());
  r.gap.resize(Q * L);
  r.slope.assign(Q * L, 0.0);
  r.bend.assign(Q * L, 0.0);
  r.gradient.assign(4 * Q * L, 0.0);
  r.normal.resize(3 * Q * L);
  r.turn.assign(12 * Q * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const std::size_t m = static_cast<std::size_t>(q) * L + lane;
      const auto by = [&](int o, int j) { return jacobian[((q * 4 + o) * J + j) * L + lane]; };
      r.gap[m] = out[(4 * q) * L + lane];
      for (int j = 0; j < J; ++j) r.gradient[(4 * q + j) * L + lane] = by(0, j);
      for (int i = 0; i < 3; ++i) {
        const double n = out[(4 * q + 1 + i) * L + lane], x1 = r.along[(3 * q + i) * L + lane];
        r.normal[(3 * q + i) * L + lane] = n;
        r.slope[m] += n * x1;
        r.bend[m] += n * bend[(3 * q + i) * L + lane];
        for (int j = 0; j < J; ++j) r.turn[((3 * q + i) * 4 + j) * L + lane] = by(1 + i, j);
        for (int j = 0; j < 3; ++j) r.bend[m] += x1 * by(1 + i, j) * r.along[(3 * q + j) * L + lane];
      }
    }
  return r;
}

void LinePoints::reserve(int batches, int maxOrder) {
  start_ = seriesOrder(0, maxOrder);
  curveDoubles_ = P_ * laws_.curve->seriesDoubles(start_);
  projectionDoubles_ = P_ * laws_.projection->seriesDoubles(start_);
  perBatch_ = curveDoubles_ + projectionDoubles_ + P_ * laws_.slope->seriesDoubles(start_);
  history_.resize(batches * perBatch_);
  points_.assign(static_cast<std::size_t>(batches) * P_ * L, {});
}

std::size_t LinePoints::bytes(int batches, int maxOrder) const {
  const SeriesOrder order = seriesOrder(0, maxOrder);
  return sizeof(double) * batches * P_ *
         (laws_.curve->seriesDoubles(order) + laws_.projection->seriesDoubles(order) +
          laws_.slope->seriesDoubles(order));
}

void LinePoints::start(int b, const double* xi, const Hold* hold, const double* c, double lambda, double* gap,
                       PointFailure& failure) {
  const int C = laws_.coefficients(), J = laws_.placeInputs();
  std::vector<double> in(P_ * (1 + C) * L), x(6 * P_ * L), place(P_ * J * L, 0.0), hn(4 * P_ * L),
      onSlope(6 * P_ * L), slope(P_ * L);
  for (int p = 0; p < P_; ++p) {
    std::copy_n(xi + p * L, L, &in[p * (1 + C) * L]);
    std::copy_n(c, C * L, &in[(p * (1 + C) + 1) * L]);
  }
  double* own = memory(b);
  laws_.curve->start({P_, L, nullptr, own}, start_, in.data(), x.data(), failure);
  for (int p = 0; p < P_; ++p) {
    std::copy_n(&x[6 * p * L], 3 * L, &place[p * J * L]);
    if (J == 4) std::fill_n(&place[(p * J + 3) * L], L, lambda);
  }
  laws_.projection->start({P_, L, nullptr, own + curveDoubles_}, start_, place.data(), hn.data(), failure);
  for (int p = 0; p < P_; ++p) {
    std::copy_n(&hn[(4 * p + 1) * L], 3 * L, &onSlope[6 * p * L]);
    std::copy_n(&x[(6 * p + 3) * L], 3 * L, &onSlope[(6 * p + 3) * L]);
    std::copy_n(&hn[4 * p * L], L, gap + p * L);
  }
  laws_.slope->start({P_, L, nullptr, own + curveDoubles_ + projectionDoubles_}, start_, onSlope.data(),
                     slope.data(), failure);
  const LineProbe at = probe(laws_, P_, xi, c, lambda);
  for (int p = 0; p < P_; ++p)
    for (int lane = 0; lane < L; ++lane) {
      Point& point = points_[(static_cast<std::size_t>(b) * P_ + p) * L + lane];
      const std::size_t m = static_cast<std::size_t>(p) * L + lane;
      point = {};
      point.xi = point.pending = xi[m];
      if (hold[m] == Hold::root) point.byGap = -1 / at.slope[m];
      if (hold[m] == Hold::extremum) point.bySlope = -1 / at.bend[m];
      for (int j = 0; j < 4; ++j) point.gradient[j] = at.gradient[(4 * p + j) * L + lane];
      for (int i = 0; i < 3; ++i) {
        point.normal[i] = at.normal[(3 * p + i) * L + lane];
        const double along = at.along[(3 * p + i) * L + lane];
        for (int j = 0; j < 4; ++j) point.slopeBy[j] += along * at.turn[((3 * p + i) * 4 + j) * L + lane];
      }
    }
}

void LinePoints::motion(const Point& point, const double* c, int lane, double* x, double* along) const {
  const double s = point.xi;
  for (int i = 0; i < 3; ++i) {
    const double c1 = c[(3 + i) * L + lane], c2 = laws_.degree == 2 ? c[(6 + i) * L + lane] : 0;
    x[i] = c[i * L + lane] + s * (c1 + s * c2);
    along[i] = c1 + 2 * c2 * s;
  }
}

double LinePoints::gapBy(int b, int p, int lane, const double* c, double lambda) const {
  const Point& point = at(b, p, lane);
  double x[3], along[3], sum = point.gradient[3] * lambda;
  motion(point, c, lane, x, along);
  for (int i = 0; i < 3; ++i) sum += point.gradient[i] * x[i];
  return sum;
}

double LinePoints::placeBy(int b, int p, int lane, const double* c, double lambda) const {
  const Point& point = at(b, p, lane);
  if (point.byGap != 0) return point.byGap * gapBy(b, p, lane, c, lambda);
  if (point.bySlope == 0) return 0;
  double x[3], along[3], slope = point.slopeBy[3] * lambda;
  motion(point, c, lane, x, along);
  for (int i = 0; i < 3; ++i) slope += point.normal[i] * along[i] + point.slopeBy[i] * x[i];
  return point.bySlope * slope;
}

void LinePoints::advance(int b, const SeriesOrder& order, const double* last, double lastLambda,
                         Orders& out) {
  const int C = laws_.coefficients(), J = laws_.placeInputs(), P = P_;
  const bool completes = order.k > 1;
  out.last.assign(P * L, 0.0);
  out.current.assign(P * L, 0.0);
  out.gap.assign(P * L, 0.0);
  std::vector<double> lastIn(P * (1 + C) * L), lastX(6 * P * L), x(6 * P * L), lastPlace(P * J * L, 0.0),
      place(P * J * L, 0.0), lastHn(4 * P * L), hn(4 * P * L), lastSlopeIn(6 * P * L), slopeIn(6 * P * L),
      lastSlope(P * L), slope(P * L);
  if (completes)
    for (int p = 0; p < P; ++p) {
      for (int lane = 0; lane < L; ++lane) {
        const double gained = placeBy(b, p, lane, last, lastLambda);
        out.last[p * L + lane] = gained;
        lastIn[p * (1 + C) * L + lane] = at(b, p, lane).pending + gained;
      }
      std::copy_n(last, C * L, &lastIn[(p * (1 + C) + 1) * L]);
    }
  double* own = memory(b);
  laws_.curve->advance({P, L, nullptr, own}, order, {lastIn.data(), nullptr}, {lastX.data(), x.data()});
  for (int p = 0; p < P; ++p) {
    std::copy_n(&x[6 * p * L], 3 * L, &place[p * J * L]);
    std::copy_n(&lastX[6 * p * L], 3 * L, &lastPlace[p * J * L]);
    if (J == 4) std::fill_n(&lastPlace[(p * J + 3) * L], L, lastLambda);
  }
  laws_.projection->advance({P, L, nullptr, own + curveDoubles_}, order, {lastPlace.data(), place.data()},
                            {lastHn.data(), hn.data()});
  for (int p = 0; p < P; ++p) {
    std::copy_n(&hn[(4 * p + 1) * L], 3 * L, &slopeIn[6 * p * L]);
    std::copy_n(&lastHn[(4 * p + 1) * L], 3 * L, &lastSlopeIn[6 * p * L]);
    std::copy_n(&x[(6 * p + 3) * L], 3 * L, &slopeIn[(6 * p + 3) * L]);
    std::copy_n(&lastX[(6 * p + 3) * L], 3 * L, &lastSlopeIn[(6 * p + 3) * L]);
  }
  laws_.slope->advance({P, L, nullptr, own + curveDoubles_ + projectionDoubles_}, order,
                       {lastSlopeIn.data(), slopeIn.data()}, {lastSlope.data(), slope.data()});
  for (int p = 0; p < P; ++p)
    for (int lane = 0; lane < L; ++lane) {
      Point& point = points_[(static_cast<std::size_t>(b) * P + p) * L + lane];
      const std::size_t m = static_cast<std::size_t>(p) * L + lane;
      out.gap[m] = hn[4 * p * L + lane];
      point.pending = out.current[m] = point.byGap * out.gap[m] + point.bySlope * slope[m];
    }
}

}  // namespace atrapos::fem
