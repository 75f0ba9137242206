#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "atrapos/fem/EventTerm.hpp"
#include "atrapos/fem/LawArrays.hpp"
#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/fem/Rows.hpp"

namespace atrapos::fem {

/// One-sided conditions with forces that are unknowns: one multiplier for each condition, at a node of its
/// own (docs/theory/contact.md, Hard contact).
///
///     at points:   h(x, lambda) >= 0, force P grad h, P >= 0, P h = 0
///     over faces:  g_i = int psi_i h dA / int psi_i dA >= 0, pressure sum_i psi_i p_i, p_i >= 0, p_i g_i = 0
///
/// with the functions psi_i >= 0 of `UnilateralPoints`. A point is a face with psi = 1.
///
/// Law (see taylor/Law.hpp): inputs (x, r) or (x, r, lambda), outputs (-r grad h, h); numObserved = 1 and
///     static std::vector<std::string> observedNames();   // of h and of the pressure
/// where the pressure at a point is P over its weight.
/// A law with data (pieces: PieceSearch) has also
///     bool exists(const double* data) const;   // false: the point is over nothing, its gap infinite
/// and zeros for its outputs where that is false: mean gaps are those of the points that are over something.
///
/// The unknown r_i is the multiplier as a length: P_i = p_i int psi_i dA = s_i r_i with s_i the body's
/// stiffness there. The last nodes of an entity are those of its multipliers. The row of r_i reads -s_i g_i =
/// 0 where the condition is active and s_i r_i = 0 where it is free, so the graph of the tangent never
/// changes and, where the law says `symmetric`, the tangent is symmetric: an active condition couples r and u
/// by -s grad g, a free one adds s to the diagonal. Event functions: g of a free condition, r of an active
/// one.
///
/// A condition all of whose nodes are held by supports is never active; its multiplier stays zero.
template <class Law, int Width = kLanes>
class UnilateralTerm final : public EventTerm {
  static constexpr int L = Width, D = Law::numData, J = Law::numInputs, O = 4;
  static constexpr bool seesLambda = J == 5;
  static_assert((J == 4 || J == 5) && Law::numOutputs == O,
                "the law's inputs are the place, the multiplier and perhaps the load factor, its outputs the "
                "force and the gap");
  using Pack = taylor::Lanes<L>;

  struct Arrays : LawArrays<Law, 1, L> {
    int M = 1;                // conditions of an entity, and their nodes
    View<double*> mean;       // [batch][q][m][lane] psi_m over the integral of psi_m on all faces
    View<double*> stiffness;  // [batch][m][lane] s; 0: held
    View<double*> share;      // [batch][m][lane] the entity's part of the condition; sums to 1
    double heldDiagonal = 1;  // of the multipliers of held conditions, which stay zero
    double extent = 0;        // largest coordinate of the points
    View<double*> active;     // [batch][m][lane] 1 or 0
    View<double*> gap;        // [batch][q][lane] h with U_k = 0 of the order swept last
    View<double*> gapStart;   // [batch][q][lane] h of order 0
    View<double*> force;      // [batch][m][lane] r of order 0
    View<double*> gradient;   // [batch][q][input][lane] dh/d(x, lambda) at the start of the series

    KOKKOS_INLINE_FUNCTION std::size_t condition(int b, int m) const {
      return (static_cast<std::size_t>(b) * M + m) * L;
    }
    KOKKOS_INLINE_FUNCTION std::size_t point(int b, int q) const {
      return (static_cast<std::size_t>(b) * this->Q + q) * L;
    }
    KOKKOS_INLINE_FUNCTION Pack meanAt(int b, int q, int m) const {
      return Pack::load(&mean(((static_cast<std::size_t>(b) * this->Q + q) * M + m) * L));
    }
    KOKKOS_INLINE_FUNCTION Pack at(const View<double*>& view, int b, int m) const {
      return Pack::load(&view(condition(b, m)));
    }
    KOKKOS_INLINE_FUNCTION const Pack& multiplier(const Pack* local, int m) const {
      return local[3 * (this->N - M + m)];
    }

    /// in = (x, r, lambda) at point q from local displacements, r the pressure there; the constant part of x
    /// only where it is asked for.
    KOKKOS_INLINE_FUNCTION void inputs(int b, int q, const Pack* local, double lambda, bool offset,
                                       Pack* in) const {
      this->interpolate(b, q, local, in);
      if (offset) this->addOffset(b, q, in);
      in[3] = Pack(0.0);
      for (int m = 0; m < M; ++m) in[3] += at(stiffness, b, m) * meanAt(b, q, m) * multiplier(local, m);
      if constexpr (seesLambda) in[4] = Pack(lambda);
    }

    /// force += what the outputs (-r grad h, h) at point q are at the nodes.
    KOKKOS_INLINE_FUNCTION void addForces(int b, int q, const Pack* out, Pack* force) const {
      this->accumulate(b, q, out, force);
      const Pack gap = this->weightAt(b, q) * out[3];
      for (int m = 0; m < M; ++m)
        force[3 * (this->N - M + m)] -= at(active, b, m) * at(stiffness, b, m) * meanAt(b, q, m) * gap;
    }
  };

 public:
  /// Conditions at points as withMultipliers makes them; weights only divide the force that is shown.
  UnilateralTerm(const Law& law, const PointSet& points)
      : UnilateralTerm(law, UnilateralPoints{points, 1, std::vector<double>(points.numPoints(), 1.0)}) {}

  /// The same with a law that is analytic piece by piece. A law's data: [point][datum].
  UnilateralTerm(const Law& law, const PointSet& points, const std::vector<double>& data, PieceSearch search)
      : UnilateralTerm(law, UnilateralPoints{points, 1, std::vector<double>(points.numPoints(), 1.0)}, data,
                       std::move(search)) {}

  /// Conditions over faces.
  UnilateralTerm(const Law& law, const UnilateralPoints& faces) : UnilateralTerm(law, faces, {}, {}) {
    static_assert(D == 0, "a law with data needs the search that keeps them up to date");
  }

  /// The same with a law that is analytic piece by piece.
  UnilateralTerm(const Law& law, const UnilateralPoints& faces, const std::vector<double>& data,
                 PieceSearch search)
      : entityNodes_(faces.points.nodes),
        weights_(faces.points.weights),
        shape_(faces.points.shape),
        batches_(makeBatches(L, faces.points.numEntities, faces.points.nodesPerEntity, faces.points.nodes)) {
    const PointSet& points = faces.points;
    if (faces.conditions > kMaxConditions)
      throw std::logic_error("UnilateralTerm: too many conditions a face");
    a_.fill(law, points, data, batches_);
    a_.M = faces.conditions;
    findConditions(faces);
    makeArrays();
    if constexpr (D > 0) {
      pieces_ = std::make_unique<PointPieces>(std::move(search), points.numPoints(), data);
      seriesData_ = View<double*>("seriesData", a_.data.size());
    }
    for (const double x : points.positions) a_.extent = std::max(a_.extent, std::abs(x));
  }

  int numEntities() const override { return a_.numEntities; }
  int nodesPerEntity() const override { return a_.N; }
  const std::vector<int>& nodes() const override { return entityNodes_; }
  bool symmetric() const override { return Law::symmetric; }
  bool seesLoadFactor() const override { return seesLambda; }
  std::size_t historyBytes(int maxOrder) const override {
    return a_.historyDoubles(batches_.count, maxOrder) * sizeof(double);
  }
  int eventCount() const override { return count_; }
  const std::vector<int>& eventNumbers() const override { return numbers_; }
  std::string eventText(int number) const override {
    return (a_.M > 1 ? "contact faces around corner " : "contact point ") + std::to_string(number + 1) +
           " (of " + std::to_string(count_) + (a_.M > 1 ? ") are on average" : ") is");
  }

  void keep(const TermPart& part) override {
    kept_ = part.entities;
    batches_ = makeBatches(L, static_cast<int>(kept_.size()), a_.N, part.nodes);
    const std::size_t N = a_.N, Q = a_.Q, M = a_.M;
    weights_ = rowsOf(weights_, kept_, Q);
    shape_ = rowsOf(shape_, kept_, Q * N);
    meanShape_ = rowsOf(meanShape_, kept_, Q * M);
    conditionOf_ = rowsOf(conditionOf_, kept_, M);
    entityNodes_ = part.nodes;
    a_.keep(part, batches_);
    std::vector<int> present = conditionOf_;
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (int& c : conditionOf_)
      c = static_cast<int>(std::lower_bound(present.begin(), present.end(), c) - present.begin());
    std::vector<char> tells;
    for (const int c : present)
      tells.push_back(std::binary_search(kept_.begin(), kept_.end(), firstEntity_[c]));
    numbers_ = std::move(present);
    tells_ = std::move(tells);
    active_.assign(numbers_.size(), 0);
    stiffness_.assign(numbers_.size(), 1.0);
    if (pieces_) {
      pieces_->keep(pointsOf(kept_, a_.Q));
      seriesData_ = View<double*>("seriesData", a_.data.size());
    }
    makeArrays();
  }

  void setPositions(const std::vector<int>& positions) override {
    a_.setPositions(positions, batches_.count);
  }

  double addResidual(const ConstField& u, double lambda, const Field& f) const override {
    const Arrays a = updated(u, lambda, a_.data);
    const View<double*> squares("squares", batches_.count);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "residual", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[O];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.inputs(b, q, local, lambda, true, in);
            a.evaluate(b, q, held.data(), in, out);
            a.addForces(b, q, out, force);
          }
          for (int m = 0; m < a.M; ++m)
            force[3 * (a.N - a.M + m)] += (Pack(1.0) - a.at(a.active, b, m)) * a.at(a.stiffness, b, m) *
                                          a.at(a.share, b, m) * a.multiplier(local, m);
          a.scatter(b, force, f);
          double sum = 0;
          for (int n = 0; n < 3 * (a.N - a.M); ++n)
            for (int lane = 0; lane < a.lanesIn(b); ++lane) sum += force[n][lane] * force[n][lane];
          // A condition is no force, but a gap is a difference of coordinates: as a part of the scale their
          // rounding is 1e-7, a tenth of the residual's usual bound. Else a path whose loads begin with
          // nothing could not begin in contact.
          constexpr double coordinates = 1e7 * 2.2e-16;
          for (int m = 0; m < a.M; ++m) {
            const Pack size = (coordinates * a.extent) * a.at(a.active, b, m) * a.at(a.stiffness, b, m) *
                              a.at(a.share, b, m);
            for (int lane = 0; lane < a.lanesIn(b); ++lane) sum += size[lane] * size[lane];
          }
          squares(b) = sum;
        });
    return sumOf(squares);
  }

  void addTangent(const ConstField& u, double lambda, const TangentSink& sink) const override {
    const Arrays a = updated(u, lambda, a_.data);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "tangent", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack local[3 * kMaxNodes], in[J], out[O], jacobian[O * J], moduli[9 * kMaxPoints];
          Pack byMultiplier[3 * kMaxPoints], ofGap[3 * kMaxPoints];  // [q][component], times the weight
          Pack byLambda[O], direction[3 * kMaxNodes], own[kMaxConditions];
          if constexpr (seesLambda)
            for (int n = 0; n < 3 * a.N; ++n) direction[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int m = 0; m < a.M; ++m) {
            const Pack s = a.at(a.stiffness, b, m), on = a.at(a.active, b, m), share = a.at(a.share, b, m);
            for (int lane = 0; lane < L; ++lane)
              own[m][lane] = share[lane] * (s[lane] == 0 ? a.heldDiagonal : s[lane] * (1 - on[lane]));
          }
          for (int q = 0; q < a.Q; ++q) {
            const Pack w = a.weightAt(b, q);
            a.inputs(b, q, local, lambda, true, in);
            a.tangent(b, q, held.data(), in, out, jacobian);
            for (int i = 0; i < 3; ++i) {
              for (int j = 0; j < 3; ++j) moduli[9 * q + 3 * i + j] = w * jacobian[i * J + j];
              byMultiplier[3 * q + i] = w * jacobian[i * J + 3];
              ofGap[3 * q + i] = -(w * jacobian[3 * J + i]);
            }
            if constexpr (seesLambda)
              for (int m = 0; m < O; ++m) byLambda[m] = -jacobian[m * J + 4];
            if constexpr (seesLambda) a.addForces(b, q, byLambda, direction);
          }
          if constexpr (seesLambda) a.scatter(b, direction, sink.loadDirection);
          const int first = a.N - a.M;
          const auto withMultipliers = [&](int na, int nb, Pack* block) {
            for (int i = 0; i < 9; ++i) block[i] = Pack(0.0);
            if (na >= first && nb >= first) {
              if (na == nb) block[0] = own[na - first];
              return;
            }
            if (na < first && nb < first) return;
            const int m = (na < first ? nb : na) - first, n = na < first ? na : nb;
            const Pack on = a.at(a.active, b, m) * a.at(a.stiffness, b, m);
            for (int q = 0; q < a.Q; ++q) {
              const Pack factor = on * a.meanAt(b, q, m) * a.valueAt(b, q, n);
              for (int i = 0; i < 3; ++i)
                if (na < first)
                  block[3 * i] += factor * byMultiplier[3 * q + i];
                else
                  block[i] += factor * ofGap[3 * q + i];
            }
          };
          a.addBlocks(b, moduli, false, withMultipliers, sink);
        });
  }

  void beginSeries(const ConstField& u, double lambda, int maxOrder) override {
    a_.reserveHistory(batches_.count, maxOrder);
    const Arrays a = updated(u, lambda, seriesData_, pieces_.get());
    const View<LawFailure*> failures("failures", batches_.count);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "beginSeries", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack local[3 * kMaxNodes], in[J], out[O], jacobian[O * J];
          a.gather(b, u, local);
          for (int m = 0; m < a.M; ++m) a.multiplier(local, m).store(&a.force(a.condition(b, m)));
          for (int q = 0; q < a.Q; ++q) {
            a.inputs(b, q, local, lambda, true, in);
            taylor::Failures<L> noted;
            auto context = a.context(b, q, 0);
            context.failures = &noted;
            taylor::start(a.law, context, in, a.dataAt(b, q), out);
            a.findFailure(b, q, out, noted, failures(b));
            out[3].store(&a.gapStart(a.point(b, q)));
            a.tangent(b, q, held.data(), in, out, jacobian);
            double* gradient = &a.gradient(4 * a.point(b, q));
            for (int i = 0; i < 3; ++i) jacobian[3 * J + i].store(gradient + i * L);
            (seesLambda ? jacobian[3 * J + J - 1] : Pack(0.0)).store(gradient + 3 * L);
          }
        });
    throwFirst(failures, kept_);
  }

  void addOrder(int k, const ConstField& last, double lastLambda, const Field& f) override {
    Arrays a = a_;
    if (D > 0) a.data = seriesData_;
    a.block = taylor::orderBlock(k, a.maxOrder);
    forEachBatch(
        "addOrder", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[O];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          if (k > 1) a.gather(b, last, local);
          for (int q = 0; q < a.Q; ++q) {
            if (k > 1) {
              a.inputs(b, q, local, lastLambda, false, in);
              auto previous = a.context(b, q, k - 1);
              taylor::complete(a.law, previous, in, a.dataAt(b, q));
            }
            auto context = a.context(b, q, k);
            taylor::sweep(a.law, context, a.dataAt(b, q), out);
            out[3].store(&a.gap(a.point(b, q)));
            a.addForces(b, q, out, force);
          }
          a.scatter(b, force, f);
        });
  }

  std::vector<double> eventOrder(int k, const ConstField& Uk, double lambdaK) const override {
    const Arrays a = a_;
    // Of every entity: its part of the mean gaps, then the multipliers.
    const std::size_t size = static_cast<std::size_t>(batches_.count) * a.M * L;
    const View<double*> gaps("gaps", size), multipliers("multipliers", size);
    forEachBatch(
        "events", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J], sum[kMaxConditions];
          for (int m = 0; m < a.M; ++m) sum[m] = Pack(0.0);
          if (k > 0) a.gather(b, Uk, local);
          for (int q = 0; q < a.Q; ++q) {
            Pack h = Pack::load(k == 0 ? &a.gapStart(a.point(b, q)) : &a.gap(a.point(b, q)));
            if (k > 0) {
              a.inputs(b, q, local, lambdaK, false, in);
              const double* gradient = &a.gradient(4 * a.point(b, q));
              for (int i = 0; i < 3; ++i) h += Pack::load(gradient + i * L) * in[i];
              if constexpr (seesLambda) h += Pack::load(gradient + 3 * L) * in[4];
            }
            h = a.weightAt(b, q) * h;
            for (int m = 0; m < a.M; ++m) sum[m] += a.meanAt(b, q, m) * h;
          }
          for (int m = 0; m < a.M; ++m) {
            sum[m].store(&gaps(a.condition(b, m)));
            (k == 0 ? a.at(a.force, b, m) : a.multiplier(local, m)).store(&multipliers(a.condition(b, m)));
          }
        });
    const auto own = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), gaps);
    const auto r = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), multipliers);
    std::vector<double> g(active_.size(), 0.0);
    forEachCondition([&](int c, int, std::size_t at) {
      if (stiffness_[c] != 0 && !active_[c])
        g[c] += own(at);
      else if (tells_[c])
        g[c] = stiffness_[c] != 0 ? r(at) : k == 0 ? 1 : 0;  // held ones never change
    });
    return g;
  }

  PointPieces* pieces() override { return pieces_.get(); }
  std::vector<double> places(const ConstField& u, double lambda) const override {
    if (!pieces_) return {};
    constexpr int stride = seesLambda ? 4 : 3;
    const Arrays a = a_;
    const View<double*> all("places", static_cast<std::size_t>(a.numEntities) * a.Q * stride);
    forEachBatch(
        "places", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J];
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.inputs(b, q, local, lambda, true, in);
            for (int lane = 0; lane < a.lanesIn(b); ++lane) {
              double* place = &all((static_cast<std::size_t>(b * L + lane) * a.Q + q) * stride);
              for (int i = 0; i < 3; ++i) place[i] = in[i][lane];
              if (seesLambda) place[3] = lambda;
            }
          }
        });
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), all);
    return {host.data(), host.data() + host.size()};
  }

  std::vector<double> covered() const override {
    Arrays a = a_;
    if (D > 0) a.data = seriesData_;
    const View<double*> parts("covered", static_cast<std::size_t>(batches_.count) * a.M * L);
    forEachBatch(
        "covered", batches_, a.order, KOKKOS_LAMBDA(int b) {
          for (int m = 0; m < a.M; ++m) {
            Pack sum(0.0), on;
            for (int q = 0; q < a.Q; ++q) {
              for (int lane = 0; lane < L; ++lane) on[lane] = exists(a, b, q, lane);
              sum += a.weightAt(b, q) * a.meanAt(b, q, m) * on;
            }
            sum.store(&parts(a.condition(b, m)));
          }
        });
    const auto own = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), parts);
    std::vector<double> sums(active_.size(), 0.0);
    forEachCondition([&](int c, int, std::size_t at) {
      if (stiffness_[c] != 0 && !active_[c])
        sums[c] += own(at);
      else if (tells_[c])
        sums[c] = 1;
    });
    return sums;
  }

  std::vector<double> moved(const ConstField& u, double lambda) const override {
    std::vector<double> found(active_.size(), 0.0);
    if (!pieces_) return found;
    const auto in = places(u, lambda);
    const int stride = pieces_->numInputs(), Q = a_.Q, M = a_.M;
    for (int p = 0; p < pieces_->numPoints(); ++p)
      if (pieces_->pieceAt(p, &in[static_cast<std::size_t>(p) * stride]) != pieces_->pieceOfSeries(p))
        for (int m = 0; m < M; ++m)
          if (meanShape_[static_cast<std::size_t>(p) * M + m] != 0) found[conditionOf_[p / Q * M + m]] = 1;
    return found;
  }

  MeanGaps gapsAt(const ConstField& u, double lambda) const override {
    const auto shown = observe(u, lambda);
    MeanGaps gaps{std::vector<double>(active_.size(), 0.0), std::vector<double>(active_.size(), 0.0)};
    const std::size_t Q = a_.Q, M = a_.M;
    forEachCondition([&](int c, int m, std::size_t at) {
      if (stiffness_[c] == 0 || active_[c]) return;
      for (std::size_t p = entityAt(at) * Q; p < (entityAt(at) + 1) * Q; ++p) {
        const double part = weights_[p] * meanShape_[p * M + m], h = shown.values[2 * p];
        if (std::isinf(h)) continue;
        gaps.sum[c] += part * h;
        gaps.covered[c] += part;
      }
    });
    return gaps;
  }

  /// Coordinates and the tool's equations are rounded to a few units of 1e-16 of the size; meshes read from
  /// files in single precision are not meant to touch exactly.
  double touching(const ConstField& u) const override { return 1e-11 * sizeAt(u); }

  void setConditions(const std::vector<int>& conditions) override {
    if (conditions.size() != active_.size())
      throw std::logic_error("UnilateralTerm: not the conditions of this part");
    active_ = conditions;
    a_.active = ofConditions("active", {active_.begin(), active_.end()});
  }

  std::vector<double> leastStiffness(const std::vector<double>& ofNodes) const override {
    const std::size_t N = a_.N, Q = a_.Q;
    std::vector<double> least(active_.size(), std::numeric_limits<double>::infinity());
    forEachCondition([&](int c, int, std::size_t at) {
      const std::size_t e = entityAt(at);
      for (std::size_t i = 0; i < Q * (N - a_.M); ++i) {
        const std::size_t q = i / (N - a_.M), n = i % (N - a_.M);
        const double k = ofNodes[entityNodes_[e * N + n]];
        if (shape_[(e * Q + q) * N + n] != 0 && k > 0) least[c] = std::min(least[c], k);
      }
    });
    return least;
  }

  void setStiffness(const std::vector<double>& least, double largest) override {
    // Gaps are differences of coordinates, which exceed displacements by far where a path starts: with the
    // whole stiffness their rounding would rule the residual. A hundredth is still well above the stiffness
    // with which a body gives way as a whole.
    constexpr double part = 1e-2;
    for (std::size_t c = 0; c < least.size(); ++c)
      stiffness_[c] = std::isfinite(least[c]) ? part * least[c] : 0.0;
    a_.heldDiagonal = largest > 0 ? part * largest : 1;
    a_.stiffness = ofConditions("stiffness", stiffness_);
  }

  PointValues observe(const ConstField& u, double lambda) const override {
    PointValues result;
    result.names = Law::observedNames();
    const Arrays a = updated(u, lambda, a_.data);
    View<double*> values("observed", 2 * static_cast<std::size_t>(a_.numEntities) * a_.Q);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "observe", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack local[3 * kMaxNodes], in[J], out[O];
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.inputs(b, q, local, lambda, true, in);
            a.evaluate(b, q, held.data(), in, out);
            for (int lane = 0; lane < a.lanesIn(b); ++lane) {
              double* shown = &values(2 * (static_cast<std::size_t>(b * L + lane) * a.Q + q));
              const bool on = exists(a, b, q, lane);
              shown[0] = on ? out[3][lane] : std::numeric_limits<double>::infinity();
              shown[1] = on ? in[3][lane] : 0.0;
            }
          }
        });
    auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), values);
    result.values.assign(host.data(), host.data() + host.size());
    return result;
  }

 private:
  /// The conditions are numbered as their nodes are.
  void findConditions(const UnilateralPoints& faces) {
    const std::size_t N = a_.N, Q = a_.Q, M = a_.M, entities = a_.numEntities;
    int first = std::numeric_limits<int>::max(), last = -1;
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t m = 0; m < M; ++m) {
        first = std::min(first, entityNodes_[e * N + N - M + m]);
        last = std::max(last, entityNodes_[e * N + N - M + m]);
      }
    const std::size_t count = last < first ? 0 : last - first + 1;
    count_ = static_cast<int>(count);
    firstEntity_.assign(count, static_cast<int>(entities));
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t m = 0; m < M; ++m) {
        const int c = entityNodes_[e * N + N - M + m] - first;
        conditionOf_.push_back(c);
        firstEntity_[c] = std::min(firstEntity_[c], static_cast<int>(e));
      }
    numbers_.resize(count);
    std::iota(numbers_.begin(), numbers_.end(), 0);
    tells_.assign(count, 1);
    active_.assign(count, 0);
    stiffness_.assign(count, 1.0);
    std::vector<double> area(count, 0.0), own(entities * M, 0.0);
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t q = 0; q < Q; ++q)
        for (std::size_t m = 0; m < M; ++m)
          own[e * M + m] += weights_[e * Q + q] * faces.functions[(e * Q + q) * M + m];
    for (std::size_t i = 0; i < own.size(); ++i) area[conditionOf_[i]] += own[i];
    meanShape_.resize(entities * Q * M);
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t q = 0; q < Q; ++q)
        for (std::size_t m = 0; m < M; ++m)
          meanShape_[(e * Q + q) * M + m] =
              faces.functions[(e * Q + q) * M + m] / area[conditionOf_[e * M + m]];
  }

  /// What the loops read of the conditions, none of them active, and room for their series.
  void makeArrays() {
    const std::size_t Q = a_.Q, M = a_.M, lanes = static_cast<std::size_t>(batches_.count) * L;
    std::vector<double> mean(lanes * Q * M), share(lanes * M, 0.0);
    a_.pack(meanShape_, static_cast<std::size_t>(a_.Q) * a_.M, batches_.count, mean.data());
    forEachCondition([&](int, int m, std::size_t at) {
      const std::size_t e = entityAt(at);
      for (std::size_t q = 0; q < Q; ++q) share[at] += weights_[e * Q + q] * meanShape_[(e * Q + q) * M + m];
    });
    a_.mean = upload("mean", mean);
    a_.share = upload("share", share);
    a_.stiffness = ofConditions("stiffness", stiffness_);
    a_.active = View<double*>("active", lanes * M);
    a_.force = View<double*>("force", lanes * M);
    a_.gap = View<double*>("gap", lanes * Q);
    a_.gapStart = View<double*>("gapStart", lanes * Q);
    a_.gradient = View<double*>("gradient", 4 * lanes * Q);
  }

  /// The entity of a place in arrays [batch][m][lane].
  std::size_t entityAt(std::size_t at) const {
    return at / (static_cast<std::size_t>(a_.M) * L) * L + at % L;
  }

  /// f(number of the condition, number m in its entity, place in arrays [batch][m][lane]) for all conditions
  /// of all entities, one after the other.
  template <class F>
  void forEachCondition(const F& f) const {
    const std::size_t M = a_.M;
    for (std::size_t e = 0; e < static_cast<std::size_t>(a_.numEntities); ++e)
      for (std::size_t m = 0; m < M; ++m)
        f(conditionOf_[e * M + m], static_cast<int>(m), (e / L * M + m) * L + e % L);
  }

  /// Values of the conditions where every entity reads its own; lanes beyond the last entity copy it.
  View<double*> ofConditions(const char* name, const std::vector<double>& values) const {
    const std::size_t M = a_.M;
    std::vector<double> all(static_cast<std::size_t>(batches_.count) * M * L);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const std::size_t e = std::min<std::size_t>(i / (M * L) * L + i % L, a_.numEntities - 1);
      all[i] = values[conditionOf_[e * M + i / L % M]];
    }
    return upload(name, all);
  }

  /// The arrays, with `data` in place of theirs and brought up to date at the state where points are on
  /// pieces. A series that begins tells its pieces to `pieces`.
  Arrays updated(const ConstField& u, double lambda, const View<double*>& data,
                 PointPieces* pieces = nullptr) const {
    if (!pieces_) return a_;
    const auto renewed = pieces_->at(places(u, lambda));
    if (pieces) pieces->beginSeries(renewed);
    auto mirror = Kokkos::create_mirror_view(data);
    a_.pack(renewed, static_cast<std::size_t>(a_.Q) * D, batches_.count, mirror.data());
    Kokkos::deep_copy(data, mirror);
    Arrays a = a_;
    a.data = data;
    return a;
  }

  /// Whether a point is over something, by the data of the arrays.
  KOKKOS_INLINE_FUNCTION static bool exists(const Arrays& a, int b, int q, int lane) {
    if constexpr (D > 0) {
      double data[D];
      a.lanesOf(a.dataAt(b, q), D, lane, data);
      return a.law.exists(data);
    }
    return true;
  }

  /// The largest coordinate and displacement.
  double sizeAt(const ConstField& u) const {
    const auto displacements = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), u);
    double size = a_.extent;
    for (int n : entityNodes_)
      for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(displacements(3 * n + i)));
    return size;
  }

  std::vector<int> entityNodes_;
  std::vector<int> kept_;  ///< entities of the whole term, where this is a part
  int count_ = 0;          ///< conditions of the whole term
  std::vector<double> weights_, shape_;
  std::vector<double> meanShape_;  ///< [entity][point][m] as Arrays::mean
  std::vector<int> conditionOf_;   ///< [entity][m]
  std::vector<int> firstEntity_;   ///< [condition of the whole term]
  std::vector<int> numbers_;       ///< [condition] in the whole term
  std::vector<char> tells_;        ///< [condition] this part tells what is not a sum over entities
  std::vector<double> stiffness_;  ///< [condition] s; 0: held
  Batches batches_;
  Arrays a_;
  std::unique_ptr<PointPieces> pieces_;  ///< null: not in pieces
  View<double*> seriesData_;             ///< those of the series under way, as a_.data
  std::vector<int> active_;              ///< [condition]
};

}  // namespace atrapos::fem
