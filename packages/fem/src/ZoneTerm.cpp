#include "atrapos/fem/ZoneTerm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <utility>

#include "ZoneForces.hpp"
#include "ZoneSearch.hpp"
#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Rows.hpp"
#include "atrapos/taylor/Domain.hpp"

namespace atrapos::fem {
namespace {

constexpr int kSlots = 3;  ///< extrema of a line that events know: two minima, a maximum

class ZoneTerm final : public EventTerm {
  static constexpr int kPlaces = 2 + kSlots;
  static constexpr int kMostCoefficients = 9;

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
    forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
      forces_.value(batch, lambda, forces.data());
      for (int lane = 0; lane < batch.lanes; ++lane) squares += scatter(lines[lane], &forces[lane], f);
    });
    OwnForces own(balance_ + 1, 0.0);
    own[balance_] = squares;
    return own;
  }

  void addTangent(const ConstDofView& u, double lambda, const TangentSink& sink) const override {
    const int C = laws_.coefficients(), N = lines_.nodesPerLine, K = laws_.degree + 1, D = lines_.components;
    std::vector<double> forces(C * L), jacobian(C * (C + 1) * L);
    forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
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
    std::vector<ZoneBatch> zones;
    forEachBatch(u, lambda, [&](const ZoneBatch& batch, const int* lines) {
      zones.push_back(batch);
      seriesLines_.emplace_back(lines, lines + batch.lanes);
      seriesWidths_.insert(seriesWidths_.end(), batch.widthUnit.begin(), batch.widthUnit.end());
    });
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
      const auto bottom = bottomAt(e, p, shape);
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
    return {1, place.gap + changesAt(e, active_[own] == 0), there.gradient[3 * L]};
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
        if (bottoms(e, end, shape)) continue;  // in contact from a depth on
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
      const Slots slots = slotsOf(shape);
      for (int p = 0; p < kPlaces; ++p) {
        if (!tells(e, p)) continue;
        const int own = conditionOf_[e * kPlaces + p];
        bool on = active_[own] != 0;
        if (p < 2) {
          on = isIn(e, p, shape.ends[p]);
        } else if (const Extremum* x = slots.of[p - 2]) {
          const double depth = x->least ? -x->gap : x->gap;
          if (const int end = endAt(e, *x, shape); end >= 0)
            on = active_[conditionOf_[e * kPlaces + end]] != 0;
          if (depth >= 4 * least(e)) on = true;
          if (depth < -border(e)) on = false;
        } else {
          on = false;
        }
        all[own] = on;
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
          const Slots slots = slotsOf(shape);
          for (int p = 0; p < kPlaces; ++p) {
            if (!tells(e, p)) continue;
            const int condition = conditionOf_[e * kPlaces + p];
            const double depth = changesAt(e, active_[condition] != 0);
            const auto ofDepth = [&](double gap) { return (gap + depth) / (partOfDepth * least(e)); };
            const auto tell = [&](double distance) {
              near.known[condition] = 1;
              near.distance[condition] = distance;
            };
            if (p < 2) {
              const auto bottom = bottomAt(e, p, shape);
              tell(bottom ? ofDepth(bottom->gap) : shape.ends[p] / (partOfBorder * border(e)));
            } else if (const Extremum* x = slots.of[p - 2]) {
              if (x->least && endAt(e, *x, shape) < 0) tell(ofDepth(x->gap));
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
      const LineProbe at = probe(laws_, static_cast<int>(Q), xi.data(), c.data(), lambda);
      for (std::size_t lane = 0; lane < lines.size(); ++lane) {
        for (std::size_t q = 0; q < Q; ++q) result.values[M * (lines[lane] * Q + q)] = at.gap[q * L + lane];
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
  struct Zone {
    int line;
    double limits[2];
    Hold hold[2];
    double widthUnit;
    double deepest[2];  ///< xi of the least gap, and that gap
  };
  /// sign (h - level) >= 0; sign 0: nothing to tell.
  struct EventFunction {
    double sign = 0, level = 0;
  };
  /// The extrema that events know: the two deepest minima, the highest maximum.
  struct Slots {
    const Extremum* of[kSlots] = {nullptr, nullptr, nullptr};
  };
  static Slots slotsOf(const GapShape& shape) {
    Slots slots;
    for (const Extremum& x : shape.extrema) {
      if (!x.least) {
        if (!slots.of[2] || x.gap > slots.of[2]->gap) slots.of[2] = &x;
      } else if (!slots.of[0] || x.gap < slots.of[0]->gap) {
        slots.of[1] = std::exchange(slots.of[0], &x);
      } else if (!slots.of[1] || x.gap < slots.of[1]->gap) {
        slots.of[1] = &x;
      }
    }
    return slots;
  }

  /// The depth from which on a zone counts that does not reach an end of its line: well above the rounding of
  /// coordinates, of which a gap is a difference.
  double least(int e) const {
    const double length = lengths_[e];
    return std::max({std::min(1e-7 * length, options_.mostDepth), 1e-8 * length, 1e-11 * extent_});
  }
  /// The depth at which a zone that counts ceases to, or another begins to. Less for the first: a zone begins
  /// with a force, which may push the body back.
  double changesAt(int e, bool counting) const { return counting ? 0.5 * least(e) : least(e); }
  /// Next to zero the condition says on which side an end is: gaps there are as good as event functions are.
  /// The zone that lies wrong has a depth below it.
  double border(int e) const { return 1e-4 * lengths_[e]; }
  bool isIn(int e, int end, double gap) const {
    if (options_.events && std::abs(gap) <= border(e)) return active_[conditionOf_[e * kPlaces + end]] != 0;
    return gap < 0;
  }
  /// The end (0, 1) of its line that a minimum cannot be told from, as far as a birth is concerned; -1: none.
  /// Far from the tool each is told by itself, for until it gets there the minimum may have left the end.
  int endAt(int e, const Extremum& x, const GapShape& shape) const {
    if (x.gap > border(e)) return -1;
    for (int end = 0; end < 2; ++end)
      if (x.least && std::abs(x.xi - (end == 0 ? -1 : 1)) < kBeyondEnds &&
          std::abs(shape.ends[end] - x.gap) <= 2 * least(e))
        return end;
    return -1;
  }
  /// The deepest place at an end that a minimum cannot be told from: the end, or that minimum where it lies
  /// inside the line, for a zone that has begun at the end may leave it while it lasts. There, as at a
  /// minimum, a zone has no series at the gap zero, and the end's condition is that of the minimum too.
  std::optional<Extremum> bottomAt(int e, int end, const GapShape& shape) const {
    std::optional<Extremum> deepest;
    for (const Extremum& x : shape.extrema) {
      if (endAt(e, x, shape) != end) continue;
      if (!deepest) deepest = Extremum{end == 0 ? -1.0 : 1.0, shape.ends[end]};
      if (std::abs(x.xi) < 1 && x.gap < deepest->gap) deepest = x;
    }
    return deepest;
  }
  bool bottoms(int e, int end, const GapShape& shape) const { return bottomAt(e, end, shape).has_value(); }
  /// Whether a minimum is in contact, or a maximum is out of it.
  bool counts(int e, const Extremum& x, const Slots& slots, const GapShape& shape) const {
    const double depth = x.least ? -x.gap : x.gap;
    if (depth >= 4 * least(e)) return true;
    if (depth < 0.25 * least(e)) return false;
    const int end = endAt(e, x, shape);
    if (options_.events && end >= 0) return active_[conditionOf_[e * kPlaces + end]] != 0;
    for (int s = 0; options_.events && s < kSlots; ++s)
      if (slots.of[s] == &x) return active_[conditionOf_[e * kPlaces + 2 + s]] != 0;
    return depth >= least(e);
  }

  /// What the width of a zone is measured by: the width itself between two roots, or from a bottom to a root;
  /// the line where another limit moves; 0 where none does. At a bottom that a limit has just come past the
  /// width is next to nothing and grows to that of a zone that counts, whatever it was: that is the least.
  double widthUnit(const Zone& zone, const GapShape& shape) const {
    constexpr double line = 2;
    const bool from = zone.hold[0] == Hold::root, to = zone.hold[1] == Hold::root;
    if (!from && !to) return 0;
    const double width = zone.limits[1] - zone.limits[0];
    if (from && to) return width;
    const int end = from ? 1 : 0;
    for (const Extremum& x : shape.extrema)
      if (endAt(zone.line, x, shape) == end) {
        const double depth = least(zone.line), rise = shape.ends[1 - end] - x.gap;
        return std::max(width, rise > depth ? line * std::sqrt(depth / rise) : 0.0);
      }
    return line;
  }

  /// The zones of a line. Between neighbours of which one is in contact and one is not lies one limit.
  void addZones(int e, const double* c, double lambda, const GapShape& shape,
                std::vector<Zone>& zones) const {
    struct Stop {
      double xi, gap;
      bool in, end;
    };
    const Slots slots = slotsOf(shape);
    std::vector<Stop> stops{{-1, shape.ends[0], isIn(e, 0, shape.ends[0]), true}};
    for (const Extremum& x : shape.extrema)
      if (std::abs(x.xi) < 1 && counts(e, x, slots, shape)) stops.push_back({x.xi, x.gap, x.least, false});
    stops.push_back({1, shape.ends[1], isIn(e, 1, shape.ends[1]), true});
    const auto limit = [&](const Stop& a, const Stop& b) -> std::optional<double> {
      if ((a.gap < 0) != (b.gap < 0)) return rootBetween(laws_, c, lambda, a.xi, b.xi);
      // An end that is on the other side by its condition: the limit lies there, or just beyond.
      const Stop& end = !a.end ? b : !b.end ? a : std::abs(a.gap) < std::abs(b.gap) ? a : b;
      return rootNear(laws_, c, lambda, end.xi, 0.5);
    };
    Zone zone{e, {-1, 1}, {Hold::place, Hold::place}, 0, {stops[0].xi, stops[0].gap}};
    bool open = stops[0].in;
    const auto close = [&] {
      zone.widthUnit = widthUnit(zone, shape);
      zones.push_back(zone);
      open = false;
    };
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      if (stops[i].in && stops[i + 1].in && stops[i + 1].gap < zone.deepest[1]) {
        zone.deepest[0] = stops[i + 1].xi;
        zone.deepest[1] = stops[i + 1].gap;
      }
      if (stops[i].in == stops[i + 1].in) continue;
      const auto at = limit(stops[i], stops[i + 1]);
      if (stops[i + 1].in) {
        open = at.has_value();
        if (open) zone = {e, {*at, 1}, {Hold::root, Hold::place}, 0, {stops[i + 1].xi, stops[i + 1].gap}};
      } else if (open && at) {
        zone.limits[1] = *at;
        zone.hold[1] = Hold::root;
        close();
      } else {
        open = false;
      }
    }
    if (open) close();
  }

  /// f(batch of zones, [lane] their lines), in the lines' order.
  template <class F>
  void forEachBatch(const ConstDofView& u, double lambda, const F& f) const {
    std::vector<Zone> zones;
    forEachShape(
        u, lambda,
        [&](int e, const double* c, const GapShape& shape) { addZones(e, c, lambda, shape, zones); }, true);
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
      int lines[L];
      for (int lane = 0; lane < L; ++lane) {
        const Zone& zone = zones[first + (lane < batch.lanes ? lane : 0)];
        lines[lane] = zone.line;
        batch.widthUnit[lane] = zone.widthUnit;
        for (int r = 0; r < 2; ++r) {
          batch.deepest[r * L + lane] = zone.deepest[r];
          batch.limits[r * L + lane] = zone.limits[r];
          batch.hold[r * L + lane] = zone.hold[r];
        }
        for (int m = 0; m < C; ++m) {
          batch.reference[m * L + lane] = lines_.coefficients[zone.line * C + m];
          batch.across[m * L + lane] = lines_.across[zone.line * C + m];
        }
      }
      gather(lines, L, u, 1, batch.c.data());
      f(batch, lines);
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
      const auto shapes = gapShapes(laws_, c.data(), lambda);
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
    const LineProbe at = probe(laws_, 1, middle.data(), c, lambda);
    for (int lane = 0; lane < L; ++lane) {
      double reach = 0;
      for (int k = 1; k <= laws_.degree; ++k)
        reach += std::hypot(c[3 * k * L + lane], c[(3 * k + 1) * L + lane], c[(3 * k + 2) * L + lane]);
      if (!(at.gap[lane] > reach)) return true;
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
      const auto shapes = gapShapes(laws_, c.data(), lambda);
      for (int lane = 0; lane < L; ++lane) {
        const bool real = lane < static_cast<int>(lines.size());
        const int e = lines[real ? lane : 0];
        const GapShape& shape = shapes[real ? lane : 0];
        const Slots slots = slotsOf(shape);
        for (int p = 0; p < kPlaces; ++p) {
          EventFunction function;
          const bool on = active_[conditionOf_[e * kPlaces + p]] != 0;
          xi[p * L + lane] = p == 0 ? -1 : 1;
          hold[p * L + lane] = Hold::place;
          if (p < 2) {
            const auto bottom = bottomAt(e, p, shape);
            function = {isIn(e, p, shape.ends[p]) ? -1.0 : 1.0, bottom ? -changesAt(e, on) : 0.0};
            if (bottom && std::abs(bottom->xi) < 1) {
              xi[p * L + lane] = bottom->xi;
              hold[p * L + lane] = Hold::extremum;
            }
          } else if (const Extremum* x = slots.of[p - 2]) {
            xi[p * L + lane] = x->xi;
            hold[p * L + lane] = Hold::extremum;
            const double depth = changesAt(e, on);
            function = endAt(e, *x, shape) >= 0 ? EventFunction{}
                       : x->least               ? EventFunction{on ? -1.0 : 1.0, -depth}
                                                : EventFunction{on ? 1.0 : -1.0, depth};
          }
          if (real) functions_[e * kPlaces + p] = function;
        }
      }
      eventPoints_.start(b, xi.data(), hold.data(), c.data(), lambda, gaps.data(), failure);
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
  int numLines_ = 0;              ///< of the whole term
  std::vector<int> firstLine_;    ///< [end of the whole term]
  std::vector<int> lineNumbers_;  ///< [line] in the whole term
  std::vector<int> numbers_;      ///< [own condition]
  std::vector<int> conditionOf_;  ///< [line][end or extremum] its own condition
  std::vector<int> active_;       ///< [own condition]
  std::vector<double> lengths_;   ///< [line]
  std::vector<int> dofs_;         ///< [line][node]
  int balance_ = 0;               ///< of the forces (DofMap::balances)
  std::vector<int> positions_;    ///< [line][node][node] in the tangent's rows
  double extent_ = 0;             ///< largest coordinate
  int maxOrder_ = 0;
  std::vector<std::vector<int>> seriesLines_;  ///< [batch of zones] their lines, of the series under way
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
