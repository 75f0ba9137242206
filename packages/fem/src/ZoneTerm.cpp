#include "atrapos/fem/ZoneTerm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "OneLine.hpp"
#include "ZoneForces.hpp"
#include "ZoneLine.hpp"
#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Rows.hpp"
#include "atrapos/taylor/Domain.hpp"

namespace atrapos::fem {
namespace {

class ZoneTerm final : public EventTerm {
  static constexpr int kPlaces = 2 + kSlots;
  static constexpr int kMostCoefficients = 9;
  static constexpr int kLimits = 4;  ///< of a line that are followed over borders of pieces: of two zones

 public:
  ZoneTerm(ZoneLaws laws, const LineSet& lines, ZoneOptions options)
      : laws_(lines.degree, std::move(laws)),
        lines_(lines),
        options_(options),
        forces_(laws_),
        eventPoints_(laws_, kPlaces) {
    numLines_ = lines_.numLines();
    firstLine_.assign(lines_.numEnds(), numLines_);
    for (int e = 0; e < numLines_; ++e)
      for (int end = 0; end < 2; ++end) {
        int& first = firstLine_[lines_.ends[2 * e + end]];
        first = std::min(first, e);
      }
    if (laws_.hasPieces() && options_.events) pieces_ = makePieces();
    lineNumbers_.resize(numLines_);
    std::iota(lineNumbers_.begin(), lineNumbers_.end(), 0);
    for (const double x : lines_.coefficients) extent_ = std::max(extent_, std::abs(x));
    makeArrays();
  }

  int numEntities() const override { return lines_.numLines(); }
  int nodesPerEntity() const override { return lines_.nodesPerLine; }
  const std::vector<int>& nodes() const override { return lines_.nodes; }
  bool symmetric() const override { return true; }
  bool seesLoadFactor() const override { return laws_.moves(); }
  std::size_t historyBytes(int maxOrder) const override {
    return forces_.bytes(1, maxOrder) + eventPoints_.bytes(batches(), maxOrder);
  }

  int eventCount() const override { return options_.events ? numEnds() + kSlots * numLines_ : 0; }
  const std::vector<int>& eventNumbers() const override { return numbers_; }
  std::string eventText(int number) const override {
    if (number < numEnds())
      return "end " + std::to_string(number + 1) + " (of " + std::to_string(numEnds()) +
             ") of contact lines is";
    return "contact line " + std::to_string((number - numEnds()) / kSlots + 1) + " (of " +
           std::to_string(numLines_) + ") is";
  }
  /// Extrema beyond the ends of lines are watched, as they may come in, and others may leave.
  bool mayBeNone(int number) const override { return number >= numEnds(); }
  bool owesPivots() const override { return false; }
  bool renews() const override { return true; }

  void keep(const TermPart& part) override {
    const std::size_t N = lines_.nodesPerLine, C = laws_.coefficients(), K = laws_.degree + 1;
    lines_.shape = rowsOf(lines_.shape, part.entities, N * K);
    lines_.coefficients = rowsOf(lines_.coefficients, part.entities, C);
    lines_.across = rowsOf(lines_.across, part.entities, C);
    lines_.weights = rowsOf(lines_.weights, part.entities, lines_.shown.size());
    lines_.ends = rowsOf(lines_.ends, part.entities, 2);
    lines_.middleNodes = rowsOf(lines_.middleNodes, part.entities, 1);
    lines_.nodes = part.nodes;
    lineNumbers_ = part.entities;
    if (pieces_) {
      std::vector<int> points;
      for (const int e : part.entities)
        for (int p = 0; p < kLimits; ++p) points.push_back(kLimits * e + p);
      pieces_->keep(points);
    }
    makeArrays();
  }

  void connect(const DofMap& dofs, const std::vector<int>& positions) override {
    dofs_.clear();
    for (const int node : lines_.nodes) {
      if (dofs.firstFieldSize(node) < lines_.components)
        throw std::logic_error("zoneTerm: node " + std::to_string(node + 1) + " has no displacement");
      dofs_.push_back(dofs.firstDof(node));
      balance_ = dofs.balanceOf(dofs.addressOf(dofs_.back()).field);
    }
    positions_ = positions;
  }

  OwnForces addResidual(const ConstDofView& u, double lambda, const DofView& f) const override {
    double squares = 0;
    std::vector<double> forces(laws_.coefficients() * L);
    const auto put = [&](const auto& lines, int count) {
      for (int lane = 0; lane < count; ++lane) squares += scatter(lines[lane], &forces[lane], f);
    };
    if (pieces_ && pieces_->held())
      forEachOfSeries(u, lambda, [&](int b, const std::vector<double>& limits, const std::vector<double>& c) {
        forces_.valueOfSeries(b, limits, c, lambda, forces.data());
        put(seriesLines_[b], static_cast<int>(seriesLines_[b].size()));
      });
    else
      forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
        forces_.value(batch, lambda, forces.data());
        put(lines, batch.lanes);
      });
    OwnForces own(balance_ + 1, 0.0);
    own[balance_] = squares;
    return own;
  }

  void addTangent(const ConstDofView& u, double lambda, const TangentSink& sink) const override {
    const int C = laws_.coefficients(), N = lines_.nodesPerLine, K = laws_.degree + 1, D = lines_.components;
    std::vector<double> forces(C * L), jacobian(C * (C + 1) * L);
    forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
      if (!batch.wrong.empty()) throw std::runtime_error(batch.wrong);
      forces_.tangent(batch, lambda, forces.data(), jacobian.data());
      for (int lane = 0; lane < batch.lanes; ++lane) {
        const int e = lines[lane];
        const auto entry = [&](int row, int column) { return jacobian[(row * (C + 1) + column) * L + lane]; };
        for (int a = 0; a < N; ++a)
          for (int i = 0; i < D; ++i) {
            const int dof = dofs_[e * N + a] + i;
            double byNode[kMostCoefficients + 1] = {};  // by a coefficient, by the load factor
            for (int k = 0; k < K; ++k)
              for (int j = 0; j <= C; ++j) byNode[j] += nodal(e, a, k) * entry(3 * k + i, j);
            if (laws_.moves()) sink.loadDirection(dof) -= byNode[C];
            for (int b = 0; b < N; ++b)
              for (int j = 0; j < D; ++j) {
                double sum = 0;
                for (int l = 0; l < K; ++l) sum += byNode[3 * l + j] * nodal(e, b, l);
                sink.values(sink.rowStart(dof) + positions_[(e * N + a) * N + b] + j) += sum;
              }
          }
      }
    });
  }

  void beginSeries(const ConstDofView& u, double lambda, int maxOrder) override {
    maxOrder_ = maxOrder;
    seriesLines_.clear();
    seriesWidths_.clear();
    seriesNth_.clear();
    std::vector<ZoneBatch> zones;
    forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
      if (!batch.wrong.empty()) throw std::runtime_error(batch.wrong);
      zones.push_back(batch);
      seriesLines_.emplace_back(lines, lines + batch.lanes);
      seriesWidths_.insert(seriesWidths_.end(), batch.widthUnit.begin(), batch.widthUnit.end());
      seriesNth_.push_back(batch.nth);
    });
    if (pieces_) pieces_->beginSeries(limitPieces(zones));
    forces_.reserve(static_cast<int>(zones.size()), maxOrder);
    PointFailure failure;
    for (std::size_t b = 0; b < zones.size(); ++b) {
      forces_.start(static_cast<int>(b), zones[b], lambda, failure);
      if (failure.lane >= 0) fail(failure, seriesLines_[b][std::min<int>(failure.lane, zones[b].lanes - 1)]);
    }
    if (options_.events) beginEvents(u, lambda, maxOrder);
  }

  void addOrder(int k, const ConstDofView& last, double lastLambda, const DofView& f) override {
    const int C = laws_.coefficients();
    const SeriesOrder order = seriesOrder(k, maxOrder_);
    std::vector<double> c(C * L), forces(C * L);
    for (std::size_t b = 0; b < seriesLines_.size(); ++b) {
      const auto& lines = seriesLines_[b];
      if (k > 1) gather(lines.data(), static_cast<int>(lines.size()), last, 0, c.data());
      forces_.advance(static_cast<int>(b), order, c.data(), lastLambda, forces.data());
      for (std::size_t lane = 0; lane < lines.size(); ++lane) scatter(lines[lane], &forces[lane], f);
    }
    if (!options_.events) return;
    LinePoints::Orders points;
    for (int b = 0; b < batches(); ++b) {
      const auto lines = linesOf(b);
      if (k > 1) gather(lines.data(), static_cast<int>(lines.size()), last, 0, c.data());
      eventPoints_.advance(b, order, c.data(), lastLambda, points);
      for (std::size_t lane = 0; lane < lines.size(); ++lane)
        for (int p = 0; p < kPlaces; ++p) eventGap_[lines[lane] * kPlaces + p] = points.gap[p * L + lane];
    }
  }

  PointPieces* pieces() override { return pieces_.get(); }
  /// The limits of the first zones of each line, of which a piece is left or reached; not a number where
  /// there are fewer.
  std::vector<double> places(const ConstDofView& u, double lambda) const override {
    const int J = laws_.placeInputs();
    std::vector<double> all(static_cast<std::size_t>(numEntities()) * kLimits * J,
                            std::numeric_limits<double>::quiet_NaN());
    forEachShape(
        u, lambda,
        [&](int e, const double* c, const GapShape& shape) {
          const OneLine line(laws_, c, lambda);
          for (const Zone& zone : lineAt(e).zones(laws_, c, lambda, shape))
            for (int r = 0; r < 2; ++r) {
              const int point = pointOf(e, zone.nth, r);
              if (point < 0) continue;
              // A limit that the edge of the surface makes is over it, and not on either side by rounding.
              constexpr double outside = 1e-9;
              const double* at = zone.limits;
              const double xi = at[r] + (zone.hold[r] == Hold::root ? outside * (at[r] - at[1 - r]) : 0);
              double x[4], along[3];
              line.place(xi, x, along);
              std::copy_n(x, J, &all[static_cast<std::size_t>(point) * J]);
            }
        },
        true);
    return all;
  }

  /// Of each line the width of zones between two roots, or from a bottom to a root, in units of what it was
  /// at the start of the series; of others with a limit that moves in units of the line.
  int internalCount() const override { return numEntities(); }
  void internalOrder(int, const ConstDofView& v, double mu, double* y) const override {
    std::fill_n(y, numEntities(), 0.0);
    std::vector<double> c(laws_.coefficients() * L);
    for (std::size_t b = 0; b < seriesLines_.size(); ++b) {
      const auto& lines = seriesLines_[b];
      gather(lines.data(), static_cast<int>(lines.size()), v, 0, c.data());
      for (std::size_t lane = 0; lane < lines.size(); ++lane) {
        const double width = seriesWidths_[b * L + lane];
        if (width == 0) continue;
        const auto limit = [&](int r) {
          const int at = static_cast<int>(lane), batch = static_cast<int>(b);
          return forces_.limits().place(batch, r, at) + forces_.limits().placeBy(batch, r, at, c.data(), mu);
        };
        y[lines[lane]] += (limit(1) - limit(0)) / width;
      }
    }
  }

  std::vector<double> eventOrder(int k, const ConstDofView& Uk, double lambdaK) const override {
    std::vector<double> all(numbers_.size(), 0.0), c(laws_.coefficients() * L);
    for (int b = 0; b < batches(); ++b) {
      const auto lines = linesOf(b);
      if (k > 0) gather(lines.data(), static_cast<int>(lines.size()), Uk, 0, c.data());
      for (std::size_t lane = 0; lane < lines.size(); ++lane)
        for (int p = 0; p < kPlaces; ++p) {
          const int e = lines[lane], own = conditionOf_[e * kPlaces + p];
          if (!tells(e, p)) continue;
          const EventFunction& function = functions_[e * kPlaces + p];
          if (function.sign == 0) {
            all[own] = k == 0 ? 1 : 0;
            continue;
          }
          double h = (k == 0 ? eventStart_ : eventGap_)[e * kPlaces + p];
          if (k > 0) h += eventPoints_.gapBy(b, p, static_cast<int>(lane), c.data(), lambdaK);
          all[own] = function.sign * (k == 0 ? h - function.level : h);
        }
    }
    return all;
  }

  /// Of minima and bottoms: a zone counts from a depth on, where it has a force.
  Gradient eventGradient(int number, const ConstDofView& u, double lambda,
                         const DofView& byU) const override {
    const auto own = std::lower_bound(numbers_.begin(), numbers_.end(), number) - numbers_.begin();
    const auto at =
        std::find(conditionOf_.begin(), conditionOf_.end(), static_cast<int>(own)) - conditionOf_.begin();
    const int e = static_cast<int>(at) / kPlaces, p = static_cast<int>(at) % kPlaces;
    if (own == static_cast<long>(numbers_.size()) || numbers_[own] != number || !tells(e, p)) return {};
    std::vector<double> c(laws_.coefficients() * L);
    gather(&e, 1, u, 1, c.data());
    const GapShape shape = gapShapes(laws_, c.data(), lambda)[0];
    Extremum place;
    if (p < 2) {
      const auto bottom = lineAt(e).bottomAt(p, shape);
      if (!bottom) return {};
      place = *bottom;
    } else {
      const Extremum* x = slotsOf(shape).of[p - 2];
      if (x == nullptr || !x->least || std::abs(x->xi) > 1) return {};
      place = *x;
    }
    const std::vector<double> xi(L, place.xi);
    const LineProbe there = probe(laws_, 1, xi.data(), c.data(), lambda);
    const int N = lines_.nodesPerLine;
    for (int n = 0; n < N; ++n) {
      double value = 0, power = 1;
      for (int k = 0; k <= laws_.degree; ++k, power *= place.xi) value += nodal(e, n, k) * power;
      for (int i = 0; i < lines_.components; ++i) byU(dofs_[e * N + n] + i) += value * there.gradient[i * L];
    }
    // Where what has just begun, or ended, is looked for: at the depth at which it did.
    return {1, place.gap + lineAt(e).changesAt(active_[own] == 0), there.gradient[3 * L]};
  }

  std::vector<double> covered() const override {
    std::vector<double> all(numbers_.size(), 0.0);
    for (int e = 0; options_.events && e < numEntities(); ++e)
      for (int p = 0; p < kPlaces; ++p)
        if (tells(e, p)) all[conditionOf_[e * kPlaces + p]] = 1;
    return all;
  }

  /// Ends that touch; what is deeper is in contact already.
  MeanGaps gapsAt(const ConstDofView& u, double lambda) const override {
    MeanGaps gaps{std::vector<double>(numbers_.size(), 0.0), std::vector<double>(numbers_.size(), 0.0)};
    if (!options_.events) return gaps;
    const double small = touching(u);
    forEachShape(u, lambda, [&](int e, const double*, const GapShape& shape) {
      for (int end = 0; end < 2; ++end) {
        const int own = conditionOf_[e * kPlaces + end];
        if (!tells(e, end) || active_[own] != 0 || !(std::abs(shape.ends[end]) <= small)) continue;
        if (lineAt(e).bottomAt(end, shape)) continue;  // in contact from a depth on
        gaps.sum[own] = shape.ends[end];
        gaps.covered[own] = 1;
      }
    });
    return gaps;
  }
  double touching(const ConstDofView& u) const override {
    double size = extent_;
    for (const int dof : dofs_)
      for (int i = 0; i < lines_.components; ++i) size = std::max(size, std::abs(u(dof + i)));
    return 1e-11 * size;
  }
  std::vector<double> moved(const ConstDofView&, double) const override {
    return std::vector<double>(numbers_.size(), 0.0);
  }

  void setConditions(const std::vector<int>& conditions) override {
    if (conditions.size() != active_.size())
      throw std::logic_error("ZoneTerm: not the conditions of this part");
    active_ = conditions;
  }

  /// What is clear from the state, and what was there where it is not.
  std::vector<double> renewed(const ConstDofView& u, double lambda) const override {
    std::vector<double> all(numbers_.size(), 0.0);
    if (!options_.events) return all;
    forEachShape(u, lambda, [&](int e, const double*, const GapShape& shape) {
      const ZoneLine line = lineAt(e);
      const Slots slots = slotsOf(shape);
      for (int p = 0; p < kPlaces; ++p) {
        if (!tells(e, p)) continue;
        bool on = line.on[p];
        if (p < 2) {
          on = line.isIn(p, shape.ends[p]);
        } else if (const Extremum* x = slots.of[p - 2]) {
          const double depth = x->least ? -x->gap : x->gap;
          if (const int end = line.endAt(*x, shape); end >= 0) on = line.on[end];
          if (depth >= 4 * line.least) on = true;
          if (depth < -line.border) on = false;
        } else {
          on = false;
        }
        all[conditionOf_[e * kPlaces + p]] = on;
      }
    });
    return all;
  }

  /// The unit is what lines differ by that symmetry lets change together: rounding, and what the residual's
  /// bound leaves of a state, some 1e-9 of their length where contact is stiff. A zone that is begun at 0.7 d
  /// stays clear of d/2, where it would cease; of ends the condition tells within more than that (border).
  Nearness nearChange(const ConstDofView& u, double lambda) const override {
    constexpr double partOfDepth = 0.3, partOfBorder = 1e-3;
    Nearness near{std::vector<double>(numbers_.size(), 0.0), std::vector<double>(numbers_.size(), 0.0)};
    if (!options_.events) return near;
    forEachShape(
        u, lambda,
        [&](int e, const double*, const GapShape& shape) {
          const ZoneLine line = lineAt(e);
          const Slots slots = slotsOf(shape);
          for (int p = 0; p < kPlaces; ++p) {
            if (!tells(e, p)) continue;
            const int condition = conditionOf_[e * kPlaces + p];
            const double depth = line.changesAt(line.on[p]);
            const auto ofDepth = [&](double gap) { return (gap + depth) / (partOfDepth * line.least); };
            const auto tell = [&](double distance) {
              near.known[condition] = 1;
              near.distance[condition] = distance;
            };
            if (p < 2) {
              const auto bottom = line.bottomAt(p, shape);
              tell(bottom ? ofDepth(bottom->gap) : shape.ends[p] / (partOfBorder * line.border));
            } else if (const Extremum* x = slots.of[p - 2]) {
              if (x->least && line.endAt(*x, shape) < 0) tell(ofDepth(x->gap));
            }
          }
        },
        true);
    return near;
  }

  std::vector<double> leastStiffness(const std::vector<double>&) const override {
    return std::vector<double>(numbers_.size(), std::numeric_limits<double>::infinity());
  }
  void setStiffness(const std::vector<double>&, double) override {}

  PointValues observe(const ConstDofView& u, double lambda) const override {
    const std::size_t Q = lines_.shown.size(), E = numEntities();
    // Gap; force over area; which part of the point's weight is in contact; the largest pressure of the zones
    // next to it; where in space its force is, and its mean square of the distance from there. (Of shown
    // points as such neither the largest pressure nor second moments are to be had: zones may lie between
    // them.)
    PointValues result{{"contact_gap", "contact_pressure", "contact_part", "contact_peak", "contact_x",
                        "contact_y", "contact_z", "contact_xx", "contact_yy", "contact_zz"},
                       {}};
    const std::size_t M = result.names.size();
    result.values.assign(M * E * Q, 0.0);
    std::vector<double> xi, c(laws_.coefficients() * L), middles(3 * E);
    for (const double place : lines_.shown) xi.insert(xi.end(), L, place);
    for (int b = 0; b < batches(); ++b) {
      const auto lines = linesOf(b);
      gather(lines.data(), static_cast<int>(lines.size()), u, 1, c.data());
      const auto gap = gaps(laws_, static_cast<int>(Q), xi.data(), c.data(), lambda);
      for (std::size_t lane = 0; lane < lines.size(); ++lane) {
        for (std::size_t q = 0; q < Q; ++q) result.values[M * (lines[lane] * Q + q)] = gap[q * L + lane];
        for (int i = 0; i < 3; ++i) middles[3 * lines[lane] + i] = c[i * L + lane];
      }
    }
    forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
      const ZoneForces::Shares shares = forces_.shares(batch, lambda, lines_.shown);
      const auto peaks = forces_.pressures(&batch.deepest[L]);
      for (int lane = 0; lane < batch.lanes; ++lane) {
        double* own = &result.values[M * lines[lane] * Q];
        for (std::size_t q = 0; q < Q; ++q) {
          own[M * q + 1] += shares.forces[q * L + lane];
          own[M * q + 2] += shares.areas[q * L + lane];
          for (int i = 0; i < 3; ++i) {
            own[M * q + 4 + i] += shares.moments[(3 * q + i) * L + lane];
            own[M * q + 7 + i] += shares.squares[(3 * q + i) * L + lane];
          }
        }
        const auto distance = [&](double place) { return std::abs(place - batch.deepest[lane]); };
        const std::size_t nearest =
            std::min_element(lines_.shown.begin(), lines_.shown.end(),
                             [&](double a, double b) { return distance(a) < distance(b); }) -
            lines_.shown.begin();
        own[M * nearest + 3] = std::max(own[M * nearest + 3], peaks[lane]);
      }
    });
    // A line may have several zones: means only now.
    for (std::size_t point = 0; point < E * Q; ++point) {
      double* own = &result.values[M * point];
      const double force = own[1];
      own[1] /= lines_.weights[point];
      own[2] /= lines_.weights[point];
      for (int i = 0; i < 3; ++i) {
        const double mean = force > 0 ? own[4 + i] / force : 0;
        own[7 + i] = force > 0 ? std::max(own[7 + i] / force - mean * mean, 0.0) : 0;
        own[4 + i] = middles[3 * (point / Q) + i] + mean;
      }
    }
    return result;
  }

 private:
  /// sign (h - level) >= 0; sign 0: nothing to tell.
  struct EventFunction {
    double sign = 0, level = 0;
  };
  /// Its own line e with the conditions that it has.
  ZoneLine lineAt(int e) const {
    ZoneLine line;
    const double length = lengths_[e];
    line.number = e;
    line.least = std::max({std::min(1e-7 * length, options_.mostDepth), 1e-8 * length, 1e-11 * extent_});
    line.border = 1e-4 * length;
    line.events = options_.events;
    for (int p = 0; p < kPlaces && line.events; ++p) line.on[p] = active_[conditionOf_[e * kPlaces + p]] != 0;
    return line;
  }

  /// f(batch of zones, [lane] their lines), in the lines' order. What is wrong with a zone is told by the
  /// batch, and makes its forces not a number.
  template <class F>
  void forEachBatch(const ConstDofView& u, double lambda, const F& f) const {
    std::vector<Zone> zones;
    forEachShape(
        u, lambda,
        [&](int e, const double* c, const GapShape& shape) {
          const ZoneLine line = lineAt(e);
          for (const Zone& zone : line.zones(laws_, c, lambda, shape)) {
            int preferred[2] = {PointPieces::any, PointPieces::any};
            for (int r = 0; r < 2; ++r)
              if (const int point = pointOf(e, zone.nth, r); pieces_ && point >= 0)
                preferred[r] = pieces_->preferred()[point];
            const auto parts = line.parts(zone, preferred, laws_, c, lambda);
            zones.insert(zones.end(), parts.begin(), parts.end());
          }
        },
        true);
    const int C = laws_.coefficients();
    for (std::size_t first = 0; first < zones.size(); first += L) {
      ZoneBatch batch;
      batch.lanes = static_cast<int>(std::min<std::size_t>(L, zones.size() - first));
      batch.limits.resize(2 * L);
      batch.hold.resize(2 * L);
      batch.widthUnit.resize(L);
      batch.deepest.resize(2 * L);
      batch.c.resize(C * L);
      batch.reference.resize(C * L);
      batch.across.resize(C * L);
      batch.piece.resize(L);
      batch.limitPiece.resize(2 * L);
      batch.nth.resize(L);
      int lines[L];
      for (int lane = 0; lane < L; ++lane) {
        const Zone& zone = zones[first + (lane < batch.lanes ? lane : 0)];
        lines[lane] = zone.line;
        batch.widthUnit[lane] = zone.widthUnit;
        batch.piece[lane] = zone.piece;
        batch.nth[lane] = zone.nth;
        for (int r = 0; r < 2; ++r) {
          batch.deepest[r * L + lane] = zone.deepest[r];
          batch.limits[r * L + lane] = zone.limits[r];
          batch.hold[r * L + lane] = zone.hold[r];
          batch.limitPiece[r * L + lane] = zone.limitPiece[r];
        }
        for (int m = 0; m < C; ++m) {
          batch.reference[m * L + lane] = lines_.coefficients[zone.line * C + m];
          batch.across[m * L + lane] = zone.wrong.empty() ? lines_.across[zone.line * C + m]
                                                          : std::numeric_limits<double>::quiet_NaN();
        }
        if (lane < batch.lanes && batch.wrong.empty() && !zone.wrong.empty())
          batch.wrong = "contact line " + std::to_string(lineNumbers_[zone.line] + 1) + ": " + zone.wrong;
      }
      gather(lines, L, u, 1, batch.c.data());
      f(batch, lines);
    }
  }

  /// f(batch of the series under way, [2][lane] where limits of its zones are in this state, not a number
  /// where it has fewer, coefficients of the lines).
  template <class F>
  void forEachOfSeries(const ConstDofView& u, double lambda, const F& f) const {
    std::vector<std::vector<Zone>> zones(numEntities());
    forEachShape(
        u, lambda,
        [&](int e, const double* own, const GapShape& shape) {
          zones[e] = lineAt(e).zones(laws_, own, lambda, shape);
        },
        true);
    std::vector<double> c(laws_.coefficients() * L), limits(2 * L);
    for (std::size_t b = 0; b < seriesLines_.size(); ++b) {
      const auto& lines = seriesLines_[b];
      gather(lines.data(), static_cast<int>(lines.size()), u, 1, c.data());
      for (int lane = 0; lane < L; ++lane) {
        const std::size_t at = lane < static_cast<int>(lines.size()) ? lane : 0, nth = seriesNth_[b][at];
        const auto& own = zones[lines[at]];
        for (int r = 0; r < 2; ++r)
          limits[r * L + lane] =
              nth < own.size() ? own[nth].limits[r] : std::numeric_limits<double>::quiet_NaN();
      }
      f(static_cast<int>(b), limits, c);
    }
  }

  /// f(line, its coefficients, shape of its gap); where only zones are asked for, lines are left out that
  /// cannot have any.
  template <class F>
  void forEachShape(const ConstDofView& u, double lambda, const F& f, bool onlyNear = false) const {
    const int C = laws_.coefficients();
    std::vector<double> c(C * L);
    for (int b = 0; b < batches(); ++b) {
      const auto lines = linesOf(b);
      gather(lines.data(), static_cast<int>(lines.size()), u, 1, c.data());
      if (onlyNear && !anyNear(c.data(), lambda)) continue;
      const auto& shapes = shapes_.of(laws_, b, c.data(), lambda);
      for (std::size_t lane = 0; lane < lines.size(); ++lane) {
        double own[kMostCoefficients];
        for (int m = 0; m < C; ++m) own[m] = c[m * L + lane];
        f(lines[lane], own, shapes[lane]);
      }
    }
  }

  /// Whether a line of the batch may come to the tool: gaps change by no more than places do.
  bool anyNear(const double* c, double lambda) const {
    const std::vector<double> middle(L, 0.0);
    const auto gap = gaps(laws_, 1, middle.data(), c, lambda);
    for (int lane = 0; lane < L; ++lane) {
      double reach = 0;
      for (int k = 1; k <= laws_.degree; ++k)
        reach += std::hypot(c[3 * k * L + lane], c[(3 * k + 1) * L + lane], c[(3 * k + 2) * L + lane]);
      if (!(gap[lane] > reach) || std::isinf(gap[lane])) return true;  // over nothing: its ends may not be
    }
    return false;
  }

  void beginEvents(const ConstDofView& u, double lambda, int maxOrder) {
    const int C = laws_.coefficients();
    eventPoints_.reserve(batches(), maxOrder);
    functions_.assign(static_cast<std::size_t>(numEntities()) * kPlaces, {});
    std::vector<double> xi(kPlaces * L), c(C * L), gaps(kPlaces * L);
    std::vector<Hold> hold(kPlaces * L);
    PointFailure failure;
    for (int b = 0; b < batches(); ++b) {
      const auto lines = linesOf(b);
      gather(lines.data(), static_cast<int>(lines.size()), u, 1, c.data());
      const auto& shapes = shapes_.of(laws_, b, c.data(), lambda);
      for (int lane = 0; lane < L; ++lane) {
        const bool real = lane < static_cast<int>(lines.size());
        const int e = lines[real ? lane : 0];
        const GapShape& shape = shapes[real ? lane : 0];
        const ZoneLine line = lineAt(e);
        const Slots slots = slotsOf(shape);
        for (int p = 0; p < kPlaces; ++p) {
          EventFunction function;
          const bool on = line.on[p];
          xi[p * L + lane] = p == 0 ? -1 : 1;
          hold[p * L + lane] = Hold::place;
          if (p < 2) {
            const auto bottom = line.bottomAt(p, shape);
            if (std::isfinite(shape.ends[p]))
              function = {line.isIn(p, shape.ends[p]) ? -1.0 : 1.0, bottom ? -line.changesAt(on) : 0.0};
            if (bottom && std::abs(bottom->xi) < 1) {
              xi[p * L + lane] = bottom->xi;
              hold[p * L + lane] = Hold::extremum;
            }
          } else if (const Extremum* x = slots.of[p - 2]) {
            xi[p * L + lane] = x->xi;
            hold[p * L + lane] = Hold::extremum;
            const double depth = line.changesAt(on);
            // Beyond the line a minimum is none of its own, however deep the line would go on there.
            const bool none = !on && x->least && std::abs(x->xi) > 1 && x->gap < 0;
            function = none || line.endAt(*x, shape) >= 0 ? EventFunction{}
                       : x->least                         ? EventFunction{on ? -1.0 : 1.0, -depth}
                                                          : EventFunction{on ? 1.0 : -1.0, depth};
          }
          if (real) functions_[e * kPlaces + p] = function;
        }
      }
      eventPoints_.start(b, xi.data(), hold.data(), c.data(), lambda, nullptr, gaps.data(), failure);
      if (failure.lane >= 0) fail(failure, lines[std::min<std::size_t>(failure.lane, lines.size() - 1)]);
      for (std::size_t lane = 0; lane < lines.size(); ++lane)
        for (int p = 0; p < kPlaces; ++p) eventStart_[lines[lane] * kPlaces + p] = gaps[p * L + lane];
    }
  }

  [[noreturn]] void fail(const PointFailure& failure, int line) const {
    throw taylor::DomainError(failure.operation, failure.value,
                              "contact line " + std::to_string(lineNumbers_[line] + 1));
  }

  /// c [coefficient][lane] of displacements, with the undeformed places times `places`; lanes beyond the last
  /// line repeat the first.
  void gather(const int* lines, int count, const ConstDofView& u, double places, double* c) const {
    const int C = laws_.coefficients(), N = lines_.nodesPerLine;
    for (int lane = 0; lane < L; ++lane) {
      const int e = lines[lane < count ? lane : 0];
      for (int k = 0; k <= laws_.degree; ++k)
        for (int i = 0; i < 3; ++i) {
          double sum = places == 0 ? 0 : places * lines_.coefficients[e * C + 3 * k + i];
          if (i < lines_.components)
            for (int n = 0; n < N; ++n) sum += nodal(e, n, k) * u(dofs_[e * N + n] + i);
          c[(3 * k + i) * L + lane] = sum;
        }
    }
  }

  /// Adds what forces on coefficients, [coefficient] kLanes apart, are at the nodes; returns their squares.
  double scatter(int e, const double* forces, const DofView& f) const {
    const int N = lines_.nodesPerLine;
    double squares = 0;
    for (int n = 0; n < N; ++n)
      for (int i = 0; i < lines_.components; ++i) {
        double sum = 0;
        for (int k = 0; k <= laws_.degree; ++k) sum += nodal(e, n, k) * forces[(3 * k + i) * L];
        f(dofs_[e * N + n] + i) += sum;
        squares += sum * sum;
      }
    return squares;
  }

  /// Coefficient of xi^k in the shape function of a node of a line.
  double nodal(int e, int node, int k) const {
    return lines_.shape[(static_cast<std::size_t>(e) * lines_.nodesPerLine + node) * (laws_.degree + 1) + k];
  }

  /// Its own limit r of the nth zone of a line among the points of pieces; -1: not followed.
  static int pointOf(int e, int nth, int r) { return 2 * nth < kLimits ? kLimits * e + 2 * nth + r : -1; }
  std::unique_ptr<PointPieces> makePieces() const {
    PieceSearch search = laws_.pieces;
    search.update = [of = laws_.pieces](int numPoints, const double* places, const int* preferred,
                                        double* data) {
      for (int p = 0; p < numPoints; ++p) {
        double* own = data + p * of.numData;
        if (std::isnan(places[p * of.numInputs]))
          own[of.piece] = PointPieces::any;
        else
          of.update(1, places + p * of.numInputs, preferred + p, own);
      }
    };
    const int points = kLimits * numLines_;
    return std::make_unique<PointPieces>(
        std::move(search), points, std::vector<double>(points * laws_.pieces.numData, 0.0), "zone limit");
  }
  /// The pieces that limits of the series' zones are over, as data of the points of pieces.
  std::vector<double> limitPieces(const std::vector<ZoneBatch>& zones) const {
    const int D = laws_.pieces.numData;
    std::vector<double> data(pieces_->numPoints() * D, 0.0);
    for (int p = 0; p < pieces_->numPoints(); ++p) data[p * D + laws_.pieces.piece] = PointPieces::any;
    for (std::size_t b = 0; b < zones.size(); ++b)
      for (int lane = 0; lane < zones[b].lanes; ++lane)
        for (int r = 0; r < 2; ++r) {
          const int point = pointOf(seriesLines_[b][lane], seriesNth_[b][lane], r);
          if (point < 0) continue;
          double& piece = data[point * D + laws_.pieces.piece];
          if (r == 1 || piece == PointPieces::any)
            piece = zones[b].piece[lane];  // of the first part, of the last
        }
    return data;
  }

  int numEnds() const { return lines_.numEnds(); }
  int batches() const { return (numEntities() + L - 1) / L; }
  std::vector<int> linesOf(int b) const {
    std::vector<int> lines;
    for (int e = b * L; e < std::min((b + 1) * L, numEntities()); ++e) lines.push_back(e);
    return lines;
  }
  /// Whether this part tells what the end or extremum p of its line e is.
  bool tells(int e, int p) const { return p >= 2 || firstLine_[lines_.ends[2 * e + p]] == lineNumbers_[e]; }

  /// What belongs to lines, and their conditions.
  void makeArrays() {
    const int C = laws_.coefficients();
    shapes_ = KnownShapes(batches());
    lengths_.clear();
    for (int e = 0; e < numEntities(); ++e) {
      const double* chord = &lines_.coefficients[e * C + 3];
      lengths_.push_back(2 * std::hypot(chord[0], chord[1], chord[2]));
    }
    std::vector<int> all;
    for (int e = 0; options_.events && e < numEntities(); ++e)
      for (int p = 0; p < kPlaces; ++p) all.push_back(numberOf(e, p));
    numbers_ = all;
    std::sort(numbers_.begin(), numbers_.end());
    numbers_.erase(std::unique(numbers_.begin(), numbers_.end()), numbers_.end());
    conditionOf_.clear();
    for (const int number : all)
      conditionOf_.push_back(
          static_cast<int>(std::lower_bound(numbers_.begin(), numbers_.end(), number) - numbers_.begin()));
    active_.assign(numbers_.size(), 0);
    eventStart_.assign(static_cast<std::size_t>(numEntities()) * kPlaces, 0.0);
    eventGap_ = eventStart_;
  }
  int numberOf(int e, int p) const {
    return p < 2 ? lines_.ends[2 * e + p] : numEnds() + kSlots * lineNumbers_[e] + p - 2;
  }

  LineLaws laws_;
  LineSet lines_;
  ZoneOptions options_;
  ZoneForces forces_;
  LinePoints eventPoints_;
  int numLines_ = 0;                     ///< of the whole term
  std::vector<int> firstLine_;           ///< [end of the whole term]
  std::vector<int> lineNumbers_;         ///< [line] in the whole term
  std::vector<int> numbers_;             ///< [own condition]
  std::vector<int> conditionOf_;         ///< [line][end or extremum] its own condition
  std::vector<int> active_;              ///< [own condition]
  std::unique_ptr<PointPieces> pieces_;  ///< [line][zone][limit]; null where the tool has no pieces
  mutable KnownShapes shapes_;
  std::vector<double> lengths_;  ///< [line]
  std::vector<int> dofs_;        ///< [line][node]
  int balance_ = 0;              ///< of the forces (DofMap::balances)
  std::vector<int> positions_;   ///< [line][node][node] in the tangent's rows
  double extent_ = 0;            ///< largest coordinate
  int maxOrder_ = 0;
  std::vector<std::vector<int>> seriesLines_;  ///< [batch of zones] their lines, of the series under way
  std::vector<std::vector<int>> seriesNth_;    ///< [batch of zones][lane] which of the zones of its line
  std::vector<double> seriesWidths_;      ///< [batch of zones][lane] units of internal variables; 0: none
  std::vector<EventFunction> functions_;  ///< [line][end or extremum]
  std::vector<double> eventStart_, eventGap_;  ///< the same: h of order 0 and of the order swept last
};

}  // namespace

std::vector<ZoneCondition> zoneConditions(const LineSet& lines) {
  std::vector<ZoneCondition> all;
  for (const int node : lines.endNodes) all.push_back({node, false});
  for (const int node : lines.middleNodes)
    for (int s = 0; s < kSlots; ++s) all.push_back({node, s == 2});
  return all;
}

std::unique_ptr<EventTerm> zoneTerm(ZoneLaws laws, const LineSet& lines, ZoneOptions options) {
  return std::make_unique<ZoneTerm>(std::move(laws), lines, options);
}

}  // namespace atrapos::fem
