#include "atrapos/fem/UnilateralTerm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>

#include "LawArrays.hpp"
#include "atrapos/fem/Rows.hpp"

namespace atrapos::fem {
namespace {

class UnilateralTerm final : public EventTerm {
  static constexpr int O = 4;  ///< outputs of the law
  static constexpr int kMaxData = 16;

 public:
  UnilateralTerm(std::unique_ptr<PointLaw> law, const UnilateralPoints& faces,
                 const std::vector<double>& data, PieceSearch search)
      : weights_(faces.points.weights),
        shape_(faces.points.shape),
        M_(faces.conditions),
        a_(std::move(law), faces.points, data),
        J_(a_.shape.inputs) {
    if (a_.elements.components() != 1 || (J_ != 4 && J_ != 5) || a_.shape.outputs != O)
      throw std::logic_error(
          "unilateralTerm: the law's inputs are the place, the multiplier and perhaps the load factor, its "
          "outputs the force and the gap");
    if (M_ > kMaxConditions) throw std::logic_error("unilateralTerm: too many conditions a face");
    if (a_.shape.data > 0 && !search.update)
      throw std::logic_error("unilateralTerm: a law with data needs the search that keeps them up to date");
    if (a_.shape.data > kMaxData) throw std::logic_error("unilateralTerm: more than 16 data a point");
    const PointSet& points = faces.points;
    const std::size_t N = view().N, J = J_;
    a_.allocateScratch((2 * 3 * N + 9 * N * N) * kLanes + a_.perBatch(J + O + O * J + 9));
    findConditions(faces);
    makeArrays();
    if (a_.shape.data > 0)
      pieces_ = std::make_unique<PointPieces>(std::move(search), points.numPoints(), data);
    for (const double x : points.positions) extent_ = std::max(extent_, std::abs(x));
  }

  int numEntities() const override { return view().numEntities; }
  int nodesPerEntity() const override { return view().N; }
  const std::vector<int>& nodes() const override { return a_.elements.nodes(); }
  bool symmetric() const override { return a_.shape.symmetric; }
  bool seesLoadFactor() const override { return J_ == 5; }
  std::size_t historyBytes(int maxOrder) const override { return a_.historyBytes(maxOrder); }
  int eventCount() const override { return count_; }
  const std::vector<int>& eventNumbers() const override { return numbers_; }
  std::string eventText(int number) const override {
    return (M_ > 1 ? "contact faces around corner " : "contact point ") + std::to_string(number + 1) +
           " (of " + std::to_string(count_) + (M_ > 1 ? ") are on average" : ") is");
  }

  void keep(const TermPart& part) override {
    const std::size_t N = view().N, Q = view().Q, M = M_;
    weights_ = rowsOf(weights_, part.entities, Q);
    shape_ = rowsOf(shape_, part.entities, Q * N);
    meanShape_ = rowsOf(meanShape_, part.entities, Q * M);
    conditionOf_ = rowsOf(conditionOf_, part.entities, M);
    a_.keep(part);
    std::vector<int> present = conditionOf_;
    std::sort(present.begin(), present.end());
    present.erase(std::unique(present.begin(), present.end()), present.end());
    for (int& c : conditionOf_)
      c = static_cast<int>(std::lower_bound(present.begin(), present.end(), c) - present.begin());
    std::vector<char> tells;
    for (const int c : present)
      tells.push_back(std::binary_search(part.entities.begin(), part.entities.end(), firstEntity_[c]));
    numbers_ = std::move(present);
    tells_ = std::move(tells);
    active_.assign(numbers_.size(), 0);
    stiffness_.assign(numbers_.size(), 1.0);
    if (pieces_) pieces_->keep(pointsOf(part.entities, static_cast<int>(Q)));
    makeArrays();
  }

  void setPositions(const std::vector<int>& positions) override { a_.elements.setPositions(positions); }

  double addResidual(const ConstField& u, double lambda, const Field& f) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    std::vector<double> squares(batches().count);
    forEachBatch("residual", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
      addForces(b, s.out, s.force);
      const int first = firstMultiplier(), lanes = view().lanesIn(b);
      double sum = 0;
      for (int lane = 0; lane < lanes; ++lane) {
        const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
        for (int m = 0; m < M_; ++m)
          s.force[(first + 3 * m) * kLanes + lane] +=
              (1.0 - active(e, m)) * stiffness(e, m) * share_[e * M_ + m] * s.multipliers[m * kLanes + lane];
        for (int n = 0; n < first; ++n) sum += s.force[n * kLanes + lane] * s.force[n * kLanes + lane];
        // A condition is no force, but a gap is a difference of coordinates: as a part of the scale their
        // rounding is 1e-7, a tenth of the residual's usual bound. Else a path whose loads begin with
        // nothing could not begin in contact.
        constexpr double coordinates = 1e7 * 2.2e-16;
        for (int m = 0; m < M_; ++m) {
          const double size = (coordinates * extent_) * active(e, m) * stiffness(e, m) * share_[e * M_ + m];
          sum += size * size;
        }
      }
      kernels().scatter(view(), b, s.force, f.data());
      squares[b] = sum;
    });
    return sumOf(squares);
  }

  void addTangent(const ConstField& u, double lambda, const TangentSink& sink) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    const BlockSink blocks{sink.rowStart.data(), sink.values.data()};
    forEachBatch("tangent", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.law->tangent(a_.batch(b, data, held.data()), s.in, s.out, s.jacobian);
      if (seesLoadFactor()) {
        for (int m = 0; m < view().Q * O; ++m)
          for (int lane = 0; lane < kLanes; ++lane)
            s.out[m * kLanes + lane] = -s.jacobian[(m * J_ + 4) * kLanes + lane];
        addForces(b, s.out, s.force);
        kernels().scatter(view(), b, s.force, sink.loadDirection.data());
      }
      coupleMultipliers(b, s.jacobian, s.dense);
      kernels().moduli(view(), b, s.jacobian, O, J_, s.moduli);
      kernels().blocks(view(), b, s.moduli, false, {0, nullptr, nullptr, s.dense}, blocks);
    });
  }

  void beginSeries(const ConstField& u, double lambda, int maxOrder) override {
    a_.reserveHistory(maxOrder);
    if (pieces_) {
      const auto data = pieces_->at(places(u, lambda));
      pieces_->beginSeries(data);
      seriesData_ = a_.packed(data);
    }
    const double* data = pieces_ ? seriesData_.data() : a_.data();
    const int Q = view().Q;
    std::vector<PointFailure> failures(batches().count);
    forEachBatch("beginSeries", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.start(b, data, s.in, s.out, failures[b]);
      a_.law->tangent(a_.batch(b, data, held.data()), s.in, s.out, s.jacobian);
      for (int lane = 0; lane < view().lanesIn(b); ++lane) {
        const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
        for (int m = 0; m < M_; ++m) force_[e * M_ + m] = s.multipliers[m * kLanes + lane];
        for (int q = 0; q < Q; ++q) {
          gapStart_[e * Q + q] = s.out[(q * O + 3) * kLanes + lane];
          const double* ofGap = s.jacobian + (q * O + 3) * J_ * kLanes + lane;
          double* gradient = &gradient_[4 * (e * Q + q)];
          for (int i = 0; i < 3; ++i) gradient[i] = ofGap[i * kLanes];
          gradient[3] = seesLoadFactor() ? ofGap[4 * kLanes] : 0.0;
        }
      }
    });
    a_.throwFirst(failures);
  }

  void addOrder(int k, const ConstField& last, double lastLambda, const Field& f) override {
    const double* data = pieces_ ? seriesData_.data() : a_.data();
    const SeriesOrder order = seriesOrder(k, a_.maxOrder());
    const int Q = view().Q;
    forEachBatch("addOrder", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      if (k > 1) inputs(b, last, lastLambda, false, s);
      a_.law->order(a_.seriesBatch(b, data), order, s.in, s.out);
      for (int lane = 0; lane < view().lanesIn(b); ++lane)
        for (int q = 0; q < Q; ++q)
          gap_[(static_cast<std::size_t>(b) * kLanes + lane) * Q + q] = s.out[(q * O + 3) * kLanes + lane];
      addForces(b, s.out, s.force);
      kernels().scatter(view(), b, s.force, f.data());
    });
  }

  std::vector<double> eventOrder(int k, const ConstField& Uk, double lambdaK) const override {
    const std::size_t Q = view().Q, M = M_, entities = view().numEntities;
    // Of every entity: its part of the mean gaps, then the multipliers.
    std::vector<double> gaps(entities * M, 0.0), multipliers(entities * M);
    forEachBatch("events", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      if (k > 0) inputs(b, Uk, lambdaK, false, s);
      for (int lane = 0; lane < view().lanesIn(b); ++lane) {
        const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
        for (std::size_t q = 0; q < Q; ++q) {
          double h = k == 0 ? gapStart_[e * Q + q] : gap_[e * Q + q];
          if (k > 0) {
            const double* gradient = &gradient_[4 * (e * Q + q)];
            const double* in = s.in + q * J_ * kLanes + lane;
            for (int i = 0; i < 3; ++i) h += gradient[i] * in[i * kLanes];
            if (seesLoadFactor()) h += gradient[3] * in[4 * kLanes];
          }
          h *= weights_[e * Q + q];
          for (std::size_t m = 0; m < M; ++m) gaps[e * M + m] += meanShape_[(e * Q + q) * M + m] * h;
        }
        for (std::size_t m = 0; m < M; ++m)
          multipliers[e * M + m] = k == 0 ? force_[e * M + m] : s.multipliers[m * kLanes + lane];
      }
    });
    std::vector<double> g(active_.size(), 0.0);
    forEachCondition([&](int c, std::size_t at) {
      if (stiffness_[c] != 0 && !active_[c])
        g[c] += gaps[at];
      else if (tells_[c])
        g[c] = stiffness_[c] != 0 ? multipliers[at] : k == 0 ? 1 : 0;  // held ones never change
    });
    return g;
  }

  PointPieces* pieces() override { return pieces_.get(); }
  std::vector<double> places(const ConstField& u, double lambda) const override {
    if (!pieces_) return {};
    const int stride = seesLoadFactor() ? 4 : 3, Q = view().Q;
    std::vector<double> all(static_cast<std::size_t>(view().numEntities) * Q * stride);
    forEachBatch("places", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      for (int lane = 0; lane < view().lanesIn(b); ++lane)
        for (int q = 0; q < Q; ++q) {
          double* place = &all[((static_cast<std::size_t>(b) * kLanes + lane) * Q + q) * stride];
          for (int i = 0; i < 3; ++i) place[i] = s.in[(q * J_ + i) * kLanes + lane];
          if (seesLoadFactor()) place[3] = lambda;
        }
    });
    return all;
  }

  std::vector<double> covered() const override {
    const double* data = pieces_ ? seriesData_.data() : a_.data();
    const std::size_t Q = view().Q, M = M_;
    std::vector<double> sums(active_.size(), 0.0);
    forEachCondition([&](int c, std::size_t at) {
      const std::size_t e = at / M, m = at % M;
      if (stiffness_[c] != 0 && !active_[c]) {
        double own = 0;
        for (std::size_t q = 0; q < Q; ++q)
          own += weights_[e * Q + q] * meanShape_[(e * Q + q) * M + m] * exists(data, e, q);
        sums[c] += own;
      } else if (tells_[c]) {
        sums[c] = 1;
      }
    });
    return sums;
  }

  std::vector<double> moved(const ConstField& u, double lambda) const override {
    std::vector<double> found(active_.size(), 0.0);
    if (!pieces_) return found;
    const auto in = places(u, lambda);
    const int stride = pieces_->numInputs(), Q = view().Q, M = M_;
    for (int p = 0; p < pieces_->numPoints(); ++p)
      if (pieces_->pieceAt(p, &in[static_cast<std::size_t>(p) * stride]) != pieces_->pieceOfSeries(p))
        for (int m = 0; m < M; ++m)
          if (meanShape_[static_cast<std::size_t>(p) * M + m] != 0) found[conditionOf_[p / Q * M + m]] = 1;
    return found;
  }

  MeanGaps gapsAt(const ConstField& u, double lambda) const override {
    const auto shown = observe(u, lambda);
    MeanGaps gaps{std::vector<double>(active_.size(), 0.0), std::vector<double>(active_.size(), 0.0)};
    const std::size_t Q = view().Q, M = M_;
    forEachCondition([&](int c, std::size_t at) {
      if (stiffness_[c] == 0 || active_[c]) return;
      const std::size_t e = at / M, m = at % M;
      for (std::size_t p = e * Q; p < (e + 1) * Q; ++p) {
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
  }

  std::vector<double> leastStiffness(const std::vector<double>& ofNodes) const override {
    const std::size_t N = view().N, Q = view().Q, M = M_;
    std::vector<double> least(active_.size(), std::numeric_limits<double>::infinity());
    forEachCondition([&](int c, std::size_t at) {
      const std::size_t e = at / M;
      for (std::size_t i = 0; i < Q * (N - M); ++i) {
        const std::size_t q = i / (N - M), n = i % (N - M);
        const double k = ofNodes[nodes()[e * N + n]];
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
    heldDiagonal_ = largest > 0 ? part * largest : 1;
  }

  PointValues observe(const ConstField& u, double lambda) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    const std::size_t Q = view().Q;
    PointValues result{a_.law->observedNames(), {}};
    result.values.resize(2 * static_cast<std::size_t>(view().numEntities) * Q);
    forEachBatch("observe", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
      for (int lane = 0; lane < view().lanesIn(b); ++lane)
        for (std::size_t q = 0; q < Q; ++q) {
          const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
          const bool on = exists(data, e, q);
          double* shown = &result.values[2 * (e * Q + q)];
          shown[0] = on ? s.out[(q * O + 3) * kLanes + lane] : std::numeric_limits<double>::infinity();
          shown[1] = on ? s.in[(q * J_ + 3) * kLanes + lane] : 0.0;
        }
    });
    return result;
  }

 private:
  /// A batch's numbers in a thread's memory.
  struct Scratch {
    Scratch(const UnilateralTerm& t, const ThreadMemory::Held& held) {
      const std::size_t N = t.view().N, J = t.J_;
      force = t.a_.scratchOf(held);
      multipliers = force + 3 * N * kLanes;
      dense = multipliers + 3 * N * kLanes;
      in = dense + 9 * N * N * kLanes;
      out = in + t.a_.perBatch(J);
      jacobian = out + t.a_.perBatch(O);
      moduli = jacobian + t.a_.perBatch(O * J);
    }
    double *force, *multipliers, *dense, *in, *out, *jacobian, *moduli;
  };

  int firstMultiplier() const { return 3 * (view().N - M_); }  ///< its dof in the entity
  double stiffness(std::size_t e, int m) const { return stiffness_[conditionOf_[e * M_ + m]]; }
  double active(std::size_t e, int m) const { return active_[conditionOf_[e * M_ + m]]; }

  /// s.in = (x, r, lambda), r the pressure at the point, with the constant part of x where it is asked for;
  /// s.multipliers [m][lane].
  void inputs(int b, const ConstField& u, double lambda, bool offset, const Scratch& s) const {
    const int Q = view().Q, N = view().N;
    kernels().inputs(view(), b, u.data(), J_, s.in);
    if (offset) a_.elements.addOffset(b, J_, s.in);
    for (int lane = 0; lane < view().lanesIn(b); ++lane) {
      const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
      for (int m = 0; m < M_; ++m) s.multipliers[m * kLanes + lane] = u(3 * nodes()[e * N + N - M_ + m]);
      for (int q = 0; q < Q; ++q) {
        double r = 0;
        for (int m = 0; m < M_; ++m)
          r += stiffness(e, m) * meanShape_[(e * Q + q) * M_ + m] * s.multipliers[m * kLanes + lane];
        s.in[(q * J_ + 3) * kLanes + lane] = r;
        if (seesLoadFactor()) s.in[(q * J_ + 4) * kLanes + lane] = lambda;
      }
    }
  }

  /// force = what the outputs (-r grad h, h) are at the nodes.
  void addForces(int b, const double* out, double* force) const {
    const int Q = view().Q;
    std::fill_n(force, 3 * view().N * kLanes, 0.0);
    kernels().forces(view(), b, out, O, true, force);
    for (int lane = 0; lane < view().lanesIn(b); ++lane) {
      const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
      for (int m = 0; m < M_; ++m) {
        double sum = 0;
        for (int q = 0; q < Q; ++q)
          sum += meanShape_[(e * Q + q) * M_ + m] * (weights_[e * Q + q] * out[(q * O + 3) * kLanes + lane]);
        force[(firstMultiplier() + 3 * m) * kLanes + lane] -= active(e, m) * stiffness(e, m) * sum;
      }
    }
  }

  /// The blocks of the tangent that belong to multipliers, [node a][node b][i][j][lane]; zeros elsewhere.
  void coupleMultipliers(int b, const double* jacobian, double* dense) const {
    const int Q = view().Q, N = view().N, first = N - M_;
    std::fill_n(dense, 9 * N * N * kLanes, 0.0);
    for (int lane = 0; lane < view().lanesIn(b); ++lane) {
      const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
      const auto entry = [&](int na, int nb, int i, int j) -> double& {
        return dense[((na * N + nb) * 9 + 3 * i + j) * kLanes + lane];
      };
      for (int m = 0; m < M_; ++m) {
        const double s = stiffness(e, m), on = active(e, m);
        entry(first + m, first + m, 0, 0) = share_[e * M_ + m] * (s == 0 ? heldDiagonal_ : s * (1 - on));
        for (int q = 0; q < Q; ++q) {
          const double part = on * s * meanShape_[(e * Q + q) * M_ + m] * weights_[e * Q + q];
          const double* at = jacobian + static_cast<std::size_t>(q) * O * J_ * kLanes + lane;
          for (int n = 0; n < first; ++n) {
            const double factor = part * a_.elements.value(b, q, n, lane);
            for (int i = 0; i < 3; ++i) {
              entry(n, first + m, i, 0) += factor * at[(i * J_ + 3) * kLanes];
              entry(first + m, n, 0, i) -= factor * at[(3 * J_ + i) * kLanes];
            }
          }
        }
      }
    }
  }

  /// The conditions are numbered as their nodes are.
  void findConditions(const UnilateralPoints& faces) {
    const std::size_t N = view().N, Q = view().Q, M = M_, entities = view().numEntities;
    const std::vector<int>& entityNodes = nodes();
    int first = std::numeric_limits<int>::max(), last = -1;
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t m = 0; m < M; ++m) {
        first = std::min(first, entityNodes[e * N + N - M + m]);
        last = std::max(last, entityNodes[e * N + N - M + m]);
      }
    const std::size_t count = last < first ? 0 : last - first + 1;
    count_ = static_cast<int>(count);
    firstEntity_.assign(count, static_cast<int>(entities));
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t m = 0; m < M; ++m) {
        const int c = entityNodes[e * N + N - M + m] - first;
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

  /// What belongs to entities, and room for their series; no condition is active.
  void makeArrays() {
    const std::size_t Q = view().Q, M = M_, entities = view().numEntities;
    share_.assign(entities * M, 0.0);
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t q = 0; q < Q; ++q)
        for (std::size_t m = 0; m < M; ++m)
          share_[e * M + m] += weights_[e * Q + q] * meanShape_[(e * Q + q) * M + m];
    force_.assign(entities * M, 0.0);
    gap_.assign(entities * Q, 0.0);
    gapStart_.assign(entities * Q, 0.0);
    gradient_.assign(4 * entities * Q, 0.0);
  }

  /// f(number of the condition, place in arrays [entity][m]) for all conditions of all entities, one after
  /// the other.
  template <class F>
  void forEachCondition(const F& f) const {
    for (std::size_t at = 0; at < conditionOf_.size(); ++at) f(conditionOf_[at], at);
  }

  /// The packed data at the state; `room` holds them where points are on pieces.
  const double* dataAt(const ConstField& u, double lambda, std::vector<double>& room) const {
    if (!pieces_) return a_.data();
    room = a_.packed(pieces_->at(places(u, lambda)));
    return room.data();
  }

  /// Whether a point is over something, by these packed data.
  bool exists(const double* data, std::size_t e, std::size_t q) const {
    if (a_.shape.data == 0) return true;
    double own[kMaxData];
    const double* from = data + ((e / kLanes * view().Q + q) * a_.shape.data) * kLanes + e % kLanes;
    for (int d = 0; d < a_.shape.data; ++d) own[d] = from[d * kLanes];
    return a_.law->exists(own);
  }

  /// The largest coordinate and displacement.
  double sizeAt(const ConstField& u) const {
    double size = extent_;
    for (int n : nodes())
      for (int i = 0; i < 3; ++i) size = std::max(size, std::abs(u(3 * n + i)));
    return size;
  }

  const ElementView& view() const { return a_.elements.view(); }
  const ElementKernels& kernels() const { return a_.elements.kernels(); }
  const Batches& batches() const { return a_.elements.batches(); }

  int count_ = 0;  ///< conditions of the whole term
  std::vector<double> weights_, shape_;
  std::vector<double> meanShape_;  ///< [entity][point][m] psi_m over the integral of psi_m on all faces
  std::vector<double> share_;      ///< [entity][m] its part of the condition; sums to 1
  std::vector<int> conditionOf_;   ///< [entity][m]
  std::vector<int> firstEntity_;   ///< [condition of the whole term]
  std::vector<int> numbers_;       ///< [condition] in the whole term
  std::vector<char> tells_;        ///< [condition] this part tells what is not a sum over entities
  std::vector<double> stiffness_;  ///< [condition] s; 0: held
  std::vector<int> active_;        ///< [condition]
  int M_;                          ///< conditions of an entity, and their nodes
  LawArrays a_;
  int J_;                                ///< inputs of the law
  double heldDiagonal_ = 1;              ///< of the multipliers of held conditions, which stay zero
  double extent_ = 0;                    ///< largest coordinate of the points
  std::unique_ptr<PointPieces> pieces_;  ///< null: not in pieces
  std::vector<double> seriesData_;       ///< those of the series under way, packed
  std::vector<double> gap_;              ///< [entity][q] h with U_k = 0 of the order swept last
  std::vector<double> gapStart_;         ///< [entity][q] h of order 0
  std::vector<double> force_;            ///< [entity][m] r of order 0
  std::vector<double> gradient_;         ///< [entity][q][4] dh/d(x, lambda) at the start of the series
};

}  // namespace

std::unique_ptr<EventTerm> unilateralTerm(std::unique_ptr<PointLaw> law, const UnilateralPoints& faces,
                                          const std::vector<double>& data, PieceSearch search) {
  return std::make_unique<UnilateralTerm>(std::move(law), faces, data, std::move(search));
}

std::unique_ptr<EventTerm> unilateralTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                                          const std::vector<double>& data, PieceSearch search) {
  return unilateralTerm(std::move(law),
                        UnilateralPoints{points, 1, std::vector<double>(points.numPoints(), 1.0)}, data,
                        std::move(search));
}

}  // namespace atrapos::fem
