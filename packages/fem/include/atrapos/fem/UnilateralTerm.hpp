#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/EventTerm.hpp"
#include "atrapos/fem/LawArrays.hpp"
#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/fem/PointPieces.hpp"

namespace atrapos::fem {

/// One-sided conditions h(x, lambda) >= 0 at points, with forces P grad h, P >= 0, P h = 0, that are
/// unknowns: one multiplier a point, at a node of its own (docs/theory/contact.md, Hard contact).
///
/// Law (see taylor/Law.hpp): inputs (x, r) or (x, r, lambda), outputs (-r grad h, h); numObserved = 1 and
///     static std::vector<std::string> observedNames();   // of h and of P over the point's weight
/// A law with data (pieces: PieceSearch) has also
///     bool exists(const double* data) const;   // false: the point is over nothing, its gap infinite
/// and a positive constant for h where that is false.
/// r is the multiplier as a length: P = s r with s the body's stiffness at the point. Every point is its own
/// entity, and its last node is that of the multiplier (`withMultipliers`). Its row reads -s h = 0 where the
/// point is active and s r = 0 where it is free, so the graph of the tangent never changes and, where the law
/// says `symmetric`, the tangent is symmetric: an active point couples r and u by -s grad h, a free one adds
/// s to the diagonal. Event functions: h of a free point, r of an active one.
///
/// A point whose nodes are all held by supports is never active; its multiplier stays zero.
template <class Law>
class UnilateralTerm final : public EventTerm {
  static constexpr int L = kLanes, D = Law::numData, J = Law::numInputs, O = 4;
  static constexpr bool seesLambda = J == 5;
  static_assert((J == 4 || J == 5) && Law::numOutputs == O,
                "the law's inputs are the place, the multiplier and perhaps the load factor, its outputs the "
                "force and the gap");
  using Pack = taylor::Lanes<L>;

  struct Arrays : LawArrays<Law, 1> {
    View<double*> stiffness;  // [batch][lane] s; 0: held
    double heldDiagonal = 1;  // of the multipliers of held points, which stay zero
    View<double*> active;     // [batch][lane] 1 or 0
    View<double*> gap;        // [batch][lane] h with U_k = 0 of the order swept last
    View<double*> gapStart;   // [batch][lane] h of order 0
    View<double*> force;      // [batch][lane] r of order 0
    View<double*> gradient;   // [batch][input][lane] dh/d(x, lambda) at the start of the series

    KOKKOS_INLINE_FUNCTION Pack at(const View<double*>& view, int b) const {
      return Pack::load(&view(b * L));
    }

    /// in = (x, r, lambda) from local displacements; the constant part of x only where it is asked for.
    KOKKOS_INLINE_FUNCTION void inputs(int b, const Pack* local, double lambda, bool offset, Pack* in) const {
      this->interpolate(b, 0, local, in);
      if (offset) this->addOffset(b, 0, in);
      in[3] = local[3 * (this->N - 1)];
      if constexpr (seesLambda) in[4] = Pack(lambda);
    }

    /// force = what the outputs (-r grad h, h) are at the nodes.
    KOKKOS_INLINE_FUNCTION void forces(int b, const Pack* out, const Pack& r, Pack* force) const {
      const Pack s = at(stiffness, b), on = at(active, b);
      const double* shape = this->shapeAt(b, 0);
      for (int n = 0; n + 1 < this->N; ++n)
        for (int i = 0; i < 3; ++i) force[3 * n + i] = s * out[i] * Pack::load(shape + n * L);
      Pack* row = force + 3 * (this->N - 1);
      row[0] = s * ((Pack(1.0) - on) * r - on * out[3]);
      row[1] = row[2] = Pack(0.0);
    }
  };

 public:
  /// `points` as withMultipliers makes them; weights only divide the force that is shown.
  UnilateralTerm(const Law& law, const PointSet& points) : UnilateralTerm(law, points, {}, {}) {
    static_assert(D == 0, "a law with data needs the search that keeps them up to date");
  }

  /// The same with a law that is analytic piece by piece. A law's data: [point][datum].
  UnilateralTerm(const Law& law, const PointSet& points, const std::vector<double>& data, PieceSearch search)
      : entityNodes_(points.nodes),
        weights_(points.weights),
        shape_(points.shape),
        batches_(makeBatches(L, points.numEntities, points.nodesPerEntity, points.nodes)) {
    if (points.pointsPerEntity != 1) throw std::logic_error("UnilateralTerm: every point is its own entity");
    a_.fill(law, points, data, batches_);
    const std::size_t lanes = static_cast<std::size_t>(batches_.count) * L;
    a_.stiffness = upload("stiffness", std::vector<double>(lanes, 1.0));
    a_.active = View<double*>("active", lanes);
    a_.gap = View<double*>("gap", lanes);
    a_.gapStart = View<double*>("gapStart", lanes);
    a_.force = View<double*>("force", lanes);
    a_.gradient = View<double*>("gradient", 4 * lanes);
    active_.assign(a_.numEntities, 0);
    if constexpr (D > 0) {
      pieces_ = std::make_unique<PointPieces>(std::move(search), points.numPoints(), data);
      seriesData_ = View<double*>("seriesData", a_.data.size());
    }
    for (int p = 0; p < 3 * a_.numEntities; ++p) extent_ = std::max(extent_, std::abs(points.positions[p]));
  }

  int numEntities() const override { return a_.numEntities; }
  int nodesPerEntity() const override { return a_.N; }
  const std::vector<int>& nodes() const override { return entityNodes_; }
  bool symmetric() const override { return Law::symmetric; }
  bool seesLoadFactor() const override { return seesLambda; }
  std::size_t historyBytes(int maxOrder) const override {
    return a_.historyDoubles(batches_.count, maxOrder) * sizeof(double);
  }
  int eventCount() const override { return a_.numEntities; }
  void setPositions(const std::vector<int>& positions) override {
    a_.setPositions(positions, batches_.count);
  }

  double addResidual(const ConstField& u, double lambda, const Field& f) const override {
    const Arrays a = updated(u, lambda, a_.data);
    const View<double*> squares("squares", batches_.count);
    forEachBatch(
        "residual", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[O];
          a.gather(b, u, local);
          a.inputs(b, local, lambda, true, in);
          a.evaluate(b, 0, in, out);
          a.forces(b, out, in[3], force);
          a.scatter(b, force, f);
          double sum = 0;  // of the forces on the body; a condition is no force
          for (int n = 0; n < 3 * (a.N - 1); ++n)
            for (int lane = 0; lane < a.lanesIn(b); ++lane) sum += force[n][lane] * force[n][lane];
          squares(b) = sum;
        });
    return sumOf(squares);
  }

  void addTangent(const ConstField& u, double lambda, const TangentSink& sink) const override {
    const Arrays a = updated(u, lambda, a_.data);
    forEachBatch(
        "tangent", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J], moduli[9], byMultiplier[3], ofGap[3];
          Pack byLambda[O], direction[3 * kMaxNodes], own;
          const Pack s = a.at(a.stiffness, b), on = a.at(a.active, b);
          a.gather(b, u, local);
          a.inputs(b, local, lambda, true, in);
          for (int lane = 0; lane < L; ++lane) {
            own[lane] = s[lane] == 0 ? a.heldDiagonal : s[lane] * (1 - on[lane]);
            double one[J], data[D + 1], result[O], jacobian[O * J];
            a.lanesOf(in, J, lane, one);
            a.lanesOf(a.dataAt(b, 0), D, lane, data);
            taylor::tangent(a.law, one, data, result, jacobian);
            for (int i = 0; i < 3; ++i) {
              for (int j = 0; j < 3; ++j) moduli[3 * i + j][lane] = s[lane] * jacobian[i * J + j];
              byMultiplier[i][lane] = on[lane] * s[lane] * jacobian[i * J + 3];
              ofGap[i][lane] = -on[lane] * s[lane] * jacobian[3 * J + i];
            }
            if constexpr (seesLambda)
              for (int m = 0; m < O; ++m) byLambda[m][lane] = -jacobian[m * J + 4];
          }
          if constexpr (seesLambda) {
            a.forces(b, byLambda, Pack(0.0), direction);
            a.scatter(b, direction, sink.loadDirection);
          }
          const int last = a.N - 1;
          const double* shape = a.shapeAt(b, 0);
          const auto withMultiplier = [&](int na, int nb, Pack* block) {
            for (int i = 0; i < 9; ++i) block[i] = Pack(0.0);
            if (na < last && nb == last)
              for (int i = 0; i < 3; ++i) block[3 * i] = byMultiplier[i] * Pack::load(shape + na * L);
            if (na == last && nb < last)
              for (int j = 0; j < 3; ++j) block[j] = ofGap[j] * Pack::load(shape + nb * L);
            if (na == last && nb == last) block[0] = own;
          };
          a.addBlocks(b, moduli, withMultiplier, sink);
        });
  }

  void beginSeries(const ConstField& u, double lambda, int maxOrder) override {
    a_.reserveHistory(batches_.count, maxOrder);
    const Arrays a = updated(u, lambda, seriesData_, pieces_.get());
    const View<LawFailure*> failures("failures", batches_.count);
    forEachBatch(
        "beginSeries", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J], out[O];
          a.gather(b, u, local);
          a.inputs(b, local, lambda, true, in);
          taylor::Failures<L> noted;
          auto context = a.context(b, 0, 0);
          context.failures = &noted;
          taylor::start(a.law, context, in, a.dataAt(b, 0), out);
          a.findFailure(b, 0, out, noted, failures(b));
          out[3].store(&a.gapStart(b * L));
          in[3].store(&a.force(b * L));
          for (int lane = 0; lane < L; ++lane) {
            double one[J], data[D + 1], result[O], jacobian[O * J];
            a.lanesOf(in, J, lane, one);
            a.lanesOf(a.dataAt(b, 0), D, lane, data);
            taylor::tangent(a.law, one, data, result, jacobian);
            for (int i = 0; i < 3; ++i) a.gradient((b * 4 + i) * L + lane) = jacobian[3 * J + i];
            a.gradient((b * 4 + 3) * L + lane) = seesLambda ? jacobian[3 * J + J - 1] : 0.0;
          }
        });
    throwFirst(failures);
  }

  void addOrder(int k, const ConstField& last, double lastLambda, const Field& f) override {
    Arrays a = a_;
    if (D > 0) a.data = seriesData_;
    a.block = taylor::orderBlock(k, a.maxOrder);
    forEachBatch(
        "addOrder", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[O];
          if (k > 1) {
            a.gather(b, last, local);
            a.inputs(b, local, lastLambda, false, in);
            auto previous = a.context(b, 0, k - 1);
            taylor::complete(a.law, previous, in, a.dataAt(b, 0));
          }
          auto context = a.context(b, 0, k);
          taylor::sweep(a.law, context, a.dataAt(b, 0), out);
          out[3].store(&a.gap(b * L));
          a.forces(b, out, Pack(0.0), force);
          a.scatter(b, force, f);
        });
  }

  void eventOrder(int k, const ConstField& Uk, double lambdaK, double* g) const override {
    const Arrays a = a_;
    const View<double*> values("events", static_cast<std::size_t>(batches_.count) * L);
    forEachBatch(
        "events", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack h = a.at(k == 0 ? a.gapStart : a.gap, b), r = a.at(a.force, b);
          if (k > 0) {
            Pack local[3 * kMaxNodes], in[J];
            a.gather(b, Uk, local);
            a.inputs(b, local, lambdaK, false, in);
            for (int i = 0; i < 3; ++i) h += Pack::load(&a.gradient((b * 4 + i) * L)) * in[i];
            if constexpr (seesLambda) h += Pack::load(&a.gradient((b * 4 + 3) * L)) * in[4];
            r = in[3];
          }
          const Pack on = a.at(a.active, b);
          for (int lane = 0; lane < L; ++lane) {
            double value = on[lane] != 0 ? r[lane] : h[lane];
            if (a.stiffness(b * L + lane) == 0) value = k == 0 ? 1 : 0;  // held
            values(b * L + lane) = value;
          }
        });
    auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), values);
    std::copy(host.data(), host.data() + a_.numEntities, g);
  }

  PointPieces* pieces() override { return pieces_.get(); }
  std::vector<double> places(const ConstField& u, double lambda) const override {
    if (!pieces_) return {};
    constexpr int stride = seesLambda ? 4 : 3;
    const Arrays a = a_;
    const View<double*> all("places", static_cast<std::size_t>(a.numEntities) * stride);
    forEachBatch(
        "places", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J];
          a.gather(b, u, local);
          a.inputs(b, local, lambda, true, in);
          for (int lane = 0; lane < a.lanesIn(b); ++lane) {
            double* place = &all((static_cast<std::size_t>(b) * L + lane) * stride);
            for (int i = 0; i < 3; ++i) place[i] = in[i][lane];
            if (seesLambda) place[3] = lambda;
          }
        });
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), all);
    return {host.data(), host.data() + host.size()};
  }

  bool eventsAstray(const ConstField& u, double lambda, const std::vector<int>& points) const override {
    if (!pieces_) return false;
    const auto in = places(u, lambda);
    const auto shown = observe(u, lambda);
    const auto stiffness = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), a_.stiffness);
    // Roots and states are good to some digits less than coordinates; another piece is further off.
    const double small = 1e-9 * sizeAt(u);
    for (int p = 0; p < a_.numEntities; ++p) {
      if (active_[p] || stiffness(p) == 0) continue;
      if (pieces_->pieceAt(p, &in[static_cast<std::size_t>(p) * pieces_->numInputs()]) ==
          pieces_->pieceOfSeries(p))
        continue;
      const double h = shown.values[2 * p];
      const bool falls = std::find(points.begin(), points.end(), p) != points.end();
      if (h < -small || (falls && h > small)) return true;
    }
    return false;
  }

  std::vector<int> eventsAt(const ConstField& u, double lambda) const override {
    const auto shown = observe(u, lambda);
    auto stiffness = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), a_.stiffness);
    const double size = sizeAt(u);
    // Coordinates and the tool's equations are rounded to a few units of 1e-16 of the size; meshes read from
    // files in single precision are not meant to touch exactly.
    const double touching = 1e-11 * size;
    std::vector<int> points;
    for (int p = 0; p < a_.numEntities; ++p) {
      if (stiffness(p) == 0) continue;
      const double h = shown.values[2 * p];
      if (active_[p]) continue;
      if (h < -touching) {
        std::ostringstream text;
        text << "contact point " << p + 1 << " (of " << a_.numEntities << ") is " << -h
             << " inside the tool where the path starts; hard contact needs a gap >= 0";
        throw std::invalid_argument(text.str());
      }
      if (h <= touching) points.push_back(p);
    }
    return points;
  }

  void applyEvent(const std::vector<int>& points) override {
    for (const int p : points) active_[p] = 1 - active_[p];
    uploadConditions();
  }
  std::vector<int> conditions() const override { return active_; }
  void setConditions(const std::vector<int>& conditions) override {
    if (conditions.size() != active_.size())
      throw std::invalid_argument("contact conditions of " + std::to_string(conditions.size()) +
                                  " points, but there are " + std::to_string(active_.size()));
    active_ = conditions;
    uploadConditions();
  }
  int constraintPivots() const override {
    return static_cast<int>(std::count(active_.begin(), active_.end(), 1));
  }

  void setStiffness(const std::vector<double>& ofNodes) override {
    // Gaps are differences of coordinates, which exceed displacements by far where a path starts: with the
    // whole stiffness their rounding would rule the residual. A hundredth is still well above the stiffness
    // with which a body gives way as a whole.
    constexpr double part = 1e-2;
    const int N = a_.N;
    std::vector<double> s(a_.stiffness.size(), 1.0);
    for (int p = 0; p < a_.numEntities; ++p) {
      double least = std::numeric_limits<double>::infinity();
      for (int n = 0; n + 1 < N; ++n) {
        const double k = ofNodes[entityNodes_[p * N + n]];
        if (shape_[p * N + n] != 0 && k > 0) least = std::min(least, k);
      }
      s[p] = std::isfinite(least) ? part * least : 0.0;
    }
    const double largest = *std::max_element(s.begin(), s.begin() + a_.numEntities);
    a_.heldDiagonal = largest > 0 ? largest : 1;
    a_.stiffness = upload("stiffness", s);
  }

  PointValues observe(const ConstField& u, double lambda) const override {
    PointValues result;
    result.names = Law::observedNames();
    const Arrays a = updated(u, lambda, a_.data);
    View<double*> values("observed", 2 * static_cast<std::size_t>(a_.numEntities));
    forEachBatch(
        "observe", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J], out[O];
          a.gather(b, u, local);
          a.inputs(b, local, lambda, true, in);
          a.evaluate(b, 0, in, out);
          for (int lane = 0; lane < a.lanesIn(b); ++lane) {
            values(2 * (b * L + lane)) = shownGap(a, b, lane, out[3][lane]);
            values(2 * (b * L + lane) + 1) = a.stiffness(b * L + lane) * in[3][lane];
          }
        });
    auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), values);
    result.values.assign(host.data(), host.data() + host.size());
    for (int p = 0; p < a_.numEntities; ++p) result.values[2 * p + 1] /= weights_[p];
    return result;
  }

 private:
  /// The arrays, with `data` in place of theirs and brought up to date at the state where points are on
  /// pieces. A series that begins tells its pieces to `pieces`.
  Arrays updated(const ConstField& u, double lambda, const View<double*>& data,
                 PointPieces* pieces = nullptr) const {
    if (!pieces_) return a_;
    const auto renewed = pieces_->at(places(u, lambda));
    if (pieces) pieces->beginSeries(renewed);
    auto mirror = Kokkos::create_mirror_view(data);
    a_.pack(renewed, D, batches_.count, mirror.data());
    Kokkos::deep_copy(data, mirror);
    Arrays a = a_;
    a.data = data;
    return a;
  }

  KOKKOS_INLINE_FUNCTION static double shownGap(const Arrays& a, int b, int lane, double h) {
    if constexpr (D > 0) {
      double data[D];
      a.lanesOf(a.dataAt(b, 0), D, lane, data);
      if (!a.law.exists(data)) return std::numeric_limits<double>::infinity();
    }
    return h;
  }

  /// The largest coordinate and displacement.
  double sizeAt(const ConstField& u) const {
    const auto displacements = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), u);
    double size = extent_;
    for (int n : entityNodes_)
      for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(displacements(3 * n + i)));
    return size;
  }

  void uploadConditions() {
    std::vector<double> on(a_.active.size(), 0.0);
    std::copy(active_.begin(), active_.end(), on.begin());
    a_.active = upload("active", on);
  }

  std::vector<int> entityNodes_;
  std::vector<double> weights_, shape_;
  Batches batches_;
  Arrays a_;
  std::unique_ptr<PointPieces> pieces_;  ///< null: not in pieces
  View<double*> seriesData_;             ///< those of the series under way, as a_.data
  std::vector<int> active_;              ///< [point]
  double extent_ = 0;                    ///< largest coordinate
};

}  // namespace atrapos::fem
