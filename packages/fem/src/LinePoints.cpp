#include "LinePoints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
      pressure(std::move(laws.pressure)),
      pieces(std::move(laws.pieces)) {
  if (degree == 1)
    makeStages<1>(*this);
  else if (degree == 2)
    makeStages<2>(*this);
  else
    throw std::logic_error("LineLaws: lines of degree 1 and 2 only");
  const LawShape place = projection->shape(), own = pressure->shape();
  if ((place.inputs != 3 && place.inputs != 4) || place.outputs != (hasPieces() ? 6 : 4) ||
      place.data != (hasPieces() ? pieces.numData : 0) || own.inputs != 1 || own.outputs != 1 ||
      own.data != 0)
    throw std::logic_error(
        "LineLaws: a projection of (x, y, z, lambda) on (h, n), with data and coordinates of its pieces, and "
        "a pressure p(h) without data");
}

std::vector<double> LineLaws::located(int numPoints, const double* places, const int* preferred) const {
  if (!hasPieces()) return {};
  const int J = placeInputs(), D = pieces.numData;
  const auto prefers = [&](int q, int lane) {
    return preferred == nullptr ? PointPieces::any : preferred[q * L + lane];
  };
  // Lanes that repeat the first, as those beyond the last line do, are not looked for.
  const auto repeats = [&](int q, int lane) {
    if (prefers(q, lane) != prefers(q, 0)) return false;
    for (int j = 0; j < J; ++j)
      if (places[(q * J + j) * L + lane] != places[(q * J + j) * L]) return false;
    return true;
  };
  std::vector<int> of(numPoints * L);
  std::vector<double> own;
  std::vector<int> wanted;
  int count = 0;
  for (int q = 0; q < numPoints; ++q)
    for (int lane = 0; lane < L; ++lane) {
      if (lane > 0 && repeats(q, lane)) {
        of[q * L + lane] = of[q * L];
        continue;
      }
      of[q * L + lane] = count++;
      wanted.push_back(prefers(q, lane));
      for (int j = 0; j < J; ++j) own.push_back(places[(q * J + j) * L + lane]);
    }
  std::vector<double> found(count * D, 0.0), data(numPoints * D * L);
  pieces.update(count, own.data(), wanted.data(), found.data());
  for (int q = 0; q < numPoints; ++q)
    for (int d = 0; d < D; ++d)
      for (int lane = 0; lane < L; ++lane) data[(q * D + d) * L + lane] = found[of[q * L + lane] * D + d];
  return data;
}

std::vector<double> LineLaws::projected(int numPoints, const double* places) const {
  const int H = placeOutputs();
  const auto data = located(numPoints, places);
  std::vector<double> out(H * numPoints * L), scratch(projection->historyDoubles(0));
  projection->value({numPoints, L, data.data(), scratch.data()}, places, out.data());
  for (int q = 0; q < numPoints; ++q)
    for (int lane = 0; lane < L; ++lane)
      if (overNothing(data, q, lane)) out[H * q * L + lane] = std::numeric_limits<double>::infinity();
  return out;
}

namespace {

/// The projection's inputs at points of lines, [point][input][lane].
std::vector<double> placesOn(const LineLaws& laws, int Q, const double* xi, const double* c, double lambda) {
  const int J = laws.placeInputs(), P = laws.degree;
  std::vector<double> in(Q * J * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const double s = xi[q * L + lane];
      for (int i = 0; i < 3; ++i) {
        const double c2 = P == 2 ? c[(6 + i) * L + lane] : 0;
        in[(q * J + i) * L + lane] = c[i * L + lane] + s * (c[(3 + i) * L + lane] + s * c2);
      }
      if (J == 4) in[(q * J + 3) * L + lane] = lambda;
    }
  return in;
}

/// dataAt(places): the projection's data, [point][datum][lane].
template <class DataAt>
LineProbe probeWith(const LineLaws& laws, int Q, const double* xi, const double* c, double lambda,
                    const DataAt& dataAt) {
  const int J = laws.placeInputs(), H = laws.placeOutputs(), P = laws.degree;
  LineProbe r;
  r.along.resize(3 * Q * L);
  const auto in = placesOn(laws, Q, xi, c, lambda);
  std::vector<double> bend(3 * Q * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const double s = xi[q * L + lane];
      for (int i = 0; i < 3; ++i) {
        const double c1 = c[(3 + i) * L + lane], c2 = P == 2 ? c[(6 + i) * L + lane] : 0;
        r.along[(3 * q + i) * L + lane] = c1 + 2 * c2 * s;
        bend[(3 * q + i) * L + lane] = 2 * c2;
      }
    }
  std::vector<double> scratch(laws.projection->historyDoubles(0)), out(H * Q * L), jacobian(H * J * Q * L);
  const auto& data = dataAt(in.data());
  laws.projection->tangent({Q, L, data.data(), scratch.data()}, in.data(), out.data(), jacobian.data());
  r.gap.resize(Q * L);
  r.slope.assign(Q * L, 0.0);
  r.bend.assign(Q * L, 0.0);
  r.gradient.assign(4 * Q * L, 0.0);
  r.normal.resize(3 * Q * L);
  r.turn.assign(12 * Q * L, 0.0);
  r.in.resize((H - 4) * Q * L);
  r.inBy.assign((H - 4) * 4 * Q * L, 0.0);
  for (int q = 0; q < Q; ++q)
    for (int lane = 0; lane < L; ++lane) {
      const std::size_t m = static_cast<std::size_t>(q) * L + lane;
      const auto by = [&](int o, int j) { return jacobian[((q * H + o) * J + j) * L + lane]; };
      r.gap[m] = out[H * q * L + lane];
      for (int j = 0; j < J; ++j) r.gradient[(4 * q + j) * L + lane] = by(0, j);
      for (int i = 0; i < 3; ++i) {
        const double n = out[(H * q + 1 + i) * L + lane], x1 = r.along[(3 * q + i) * L + lane];
        r.normal[(3 * q + i) * L + lane] = n;
        r.slope[m] += n * x1;
        r.bend[m] += n * bend[(3 * q + i) * L + lane];
        for (int j = 0; j < J; ++j) r.turn[((3 * q + i) * 4 + j) * L + lane] = by(1 + i, j);
        for (int j = 0; j < 3; ++j) r.bend[m] += x1 * by(1 + i, j) * r.along[(3 * q + j) * L + lane];
      }
      for (int i = 0; i < H - 4; ++i) {
        r.in[(2 * q + i) * L + lane] = out[(H * q + 4 + i) * L + lane];
        for (int j = 0; j < J; ++j) r.inBy[((2 * q + i) * 4 + j) * L + lane] = by(4 + i, j);
      }
      if (!laws.overNothing(data, q, lane)) continue;
      r.gap[m] = std::numeric_limits<double>::infinity();
      r.slope[m] = r.bend[m] = 0;
      for (int j = 0; j < 4; ++j) r.gradient[(4 * q + j) * L + lane] = 0;
    }
  return r;
}

}  // namespace

double LineProbe::inSlope(int coordinate, int point, int lane) const {
  double sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += inBy[((2 * point + coordinate) * 4 + i) * L + lane] * along[(3 * point + i) * L + lane];
  return sum;
}

LineProbe probe(const LineLaws& laws, int Q, const double* xi, const double* c, double lambda,
                const int* preferred) {
  return probeWith(laws, Q, xi, c, lambda,
                   [&](const double* places) { return laws.located(Q, places, preferred); });
}

std::vector<double> gaps(const LineLaws& laws, int Q, const double* xi, const double* c, double lambda) {
  const int H = laws.placeOutputs();
  const auto out = laws.projected(Q, placesOn(laws, Q, xi, c, lambda).data());
  std::vector<double> gap(Q * L);
  for (int q = 0; q < Q; ++q) std::copy_n(&out[H * q * L], L, &gap[q * L]);
  return gap;
}

void LinePoints::reserve(int batches, int maxOrder) {
  start_ = seriesOrder(0, maxOrder);
  curveDoubles_ = P_ * laws_.curve->seriesDoubles(start_);
  projectionDoubles_ = P_ * laws_.projection->seriesDoubles(start_);
  perBatch_ = curveDoubles_ + projectionDoubles_ + P_ * laws_.slope->seriesDoubles(start_);
  history_.resize(batches * perBatch_);
  data_.resize(batches * dataSize());
  points_.assign(static_cast<std::size_t>(batches) * P_ * L, {});
}

std::size_t LinePoints::bytes(int batches, int maxOrder) const {
  const SeriesOrder order = seriesOrder(0, maxOrder);
  return sizeof(double) * batches * P_ *
         (laws_.curve->seriesDoubles(order) + laws_.projection->seriesDoubles(order) +
          laws_.slope->seriesDoubles(order));
}

void LinePoints::start(int b, const double* xi, const Hold* hold, const double* c, double lambda,
                       const int* preferred, double* gap, PointFailure& failure) {
  const int C = laws_.coefficients(), J = laws_.placeInputs(), H = laws_.placeOutputs();
  std::vector<double> in(P_ * (1 + C) * L), x(6 * P_ * L), place(P_ * J * L, 0.0), hn(H * P_ * L),
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
  const auto located = laws_.located(P_, place.data(), preferred);
  double* data = std::copy(located.begin(), located.end(), data_.data() + b * dataSize()) - located.size();
  laws_.projection->start({P_, L, data, own + curveDoubles_}, start_, place.data(), hn.data(), failure);
  for (int p = 0; p < P_; ++p) {
    std::copy_n(&hn[(H * p + 1) * L], 3 * L, &onSlope[6 * p * L]);
    std::copy_n(&x[(6 * p + 3) * L], 3 * L, &onSlope[(6 * p + 3) * L]);
    std::copy_n(&hn[H * p * L], L, gap + p * L);
  }
  laws_.slope->start({P_, L, nullptr, own + curveDoubles_ + projectionDoubles_}, start_, onSlope.data(),
                     slope.data(), failure);
  const LineProbe at = probeWith(laws_, P_, xi, c, lambda,
                                 [&](const double*) -> const std::vector<double>& { return located; });
  for (int p = 0; p < P_; ++p)
    for (int lane = 0; lane < L; ++lane) {
      Point& point = points_[(static_cast<std::size_t>(b) * P_ + p) * L + lane];
      const std::size_t m = static_cast<std::size_t>(p) * L + lane;
      point = {};
      point.xi = point.pending = xi[m];
      if (hold[m] == Hold::root) point.byGap = -1 / at.slope[m];
      if (hold[m] == Hold::extremum) point.bySlope = -1 / at.bend[m];
      for (int j = 0; j < 4; ++j) point.gradient[j] = at.gradient[(4 * p + j) * L + lane];
      if (isBorder(hold[m])) {
        const int i = hold[m] == Hold::border1 ? 0 : 1;
        point.output = 4 + i;
        for (int j = 0; j < 4; ++j) point.gradient[j] = at.inBy[((2 * p + i) * 4 + j) * L + lane];
        point.byGap = -1 / at.inSlope(i, p, lane);
      }
      for (int i = 0; i < 3; ++i) {
        point.normal[i] = at.normal[(3 * p + i) * L + lane];
        const double along = at.along[(3 * p + i) * L + lane];
        for (int j = 0; j < 4; ++j) point.slopeBy[j] += along * at.turn[((3 * p + i) * 4 + j) * L + lane];
      }
    }
}

std::vector<double> LinePoints::rootsNear(int b, std::vector<double> xi, const double* c,
                                          double lambda) const {
  const double* first = data_.data() + b * dataSize();
  const std::vector<double> data(first, first + dataSize());
  for (int p = 0; p < P_; ++p)
    for (int lane = 0; lane < L; ++lane)
      if (at(b, p, lane).byGap == 0) xi[p * L + lane] = at(b, p, lane).xi;
  constexpr int most = 20;
  for (int i = 0; i < most; ++i) {
    const LineProbe here = probeWith(laws_, P_, xi.data(), c, lambda,
                                     [&](const double*) -> const std::vector<double>& { return data; });
    double moved = 0;
    for (int p = 0; p < P_; ++p)
      for (int lane = 0; lane < L; ++lane) {
        const Point& point = at(b, p, lane);
        if (point.byGap == 0) continue;
        double step = here.gap[p * L + lane] / here.slope[p * L + lane];
        if (const int i = point.output - 4; i >= 0) {
          const double t = here.in[(2 * p + i) * L + lane];
          step = (t - std::round(t)) / here.inSlope(i, p, lane);
        }
        xi[p * L + lane] -= step;
        moved = std::max(moved, std::abs(step));
      }
    if (moved <= 4e-16) break;
  }
  return xi;
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
  const int C = laws_.coefficients(), J = laws_.placeInputs(), H = laws_.placeOutputs(), P = P_;
  const bool completes = order.k > 1;
  out.last.assign(P * L, 0.0);
  out.current.assign(P * L, 0.0);
  out.gap.assign(P * L, 0.0);
  std::vector<double> lastIn(P * (1 + C) * L), lastX(6 * P * L), x(6 * P * L), lastPlace(P * J * L, 0.0),
      place(P * J * L, 0.0), lastHn(H * P * L), hn(H * P * L), lastSlopeIn(6 * P * L), slopeIn(6 * P * L),
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
  laws_.projection->advance({P, L, data_.data() + b * dataSize(), own + curveDoubles_}, order,
                            {lastPlace.data(), place.data()}, {lastHn.data(), hn.data()});
  for (int p = 0; p < P; ++p) {
    std::copy_n(&hn[(H * p + 1) * L], 3 * L, &slopeIn[6 * p * L]);
    std::copy_n(&lastHn[(H * p + 1) * L], 3 * L, &lastSlopeIn[6 * p * L]);
    std::copy_n(&x[(6 * p + 3) * L], 3 * L, &slopeIn[(6 * p + 3) * L]);
    std::copy_n(&lastX[(6 * p + 3) * L], 3 * L, &lastSlopeIn[(6 * p + 3) * L]);
  }
  laws_.slope->advance({P, L, nullptr, own + curveDoubles_ + projectionDoubles_}, order,
                       {lastSlopeIn.data(), slopeIn.data()}, {lastSlope.data(), slope.data()});
  for (int p = 0; p < P; ++p)
    for (int lane = 0; lane < L; ++lane) {
      Point& point = points_[(static_cast<std::size_t>(b) * P + p) * L + lane];
      const std::size_t m = static_cast<std::size_t>(p) * L + lane;
      out.gap[m] = hn[(H * p + point.output) * L + lane];
      point.pending = out.current[m] = point.byGap * out.gap[m] + point.bySlope * slope[m];
    }
}

}  // namespace atrapos::fem
