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
  static constexpr int kMaxData = 16;

 public:
  UnilateralTerm(std::unique_ptr<PointLaw> law, const UnilateralPoints& faces,
                 const std::vector<double>& data, PieceSearch search)
      : weights_(faces.points.weights),
        shape_(faces.points.shape),
        M_(faces.conditions),
        a_(std::move(law), faces.points, data),
        D_(a_.elements.inputs()),
        O_(D_ + 1),
        J_(a_.shape.inputs),
        allNodes_(joinedNodes(faces)) {
    if (faces.points.shapeComponents != 1 || !faces.points.more.empty() || (J_ != D_ + 1 && J_ != D_ + 2) ||
        a_.shape.outputs != O_)
      throw std::logic_error(
          "unilateralTerm: the law's inputs are the place, the multiplier and perhaps the load factor, its "
          "outputs the force and the gap");
    if (M_ > kMaxConditions) throw std::logic_error("unilateralTerm: too many conditions a face");
    if (a_.shape.data > 0 && !search.update)
      throw std::logic_error("unilateralTerm: a law with data needs the search that keeps them up to date");
    if (a_.shape.data > kMaxData) throw std::logic_error("unilateralTerm: more than 16 data a point");
    const PointSet& points = faces.points;
    const std::size_t J = J_, O = O_;
    a_.allocateScratch((a_.elements.localDofs() + 2 * M_) * kLanes + a_.perBatch(J + O + O * J + D_ * D_));
    findConditions(faces);
    makeArrays();
    if (a_.shape.data > 0)
      pieces_ = std::make_unique<PointPieces>(std::move(search), points.numPoints(), data);
    for (const double x : points.positions) extent_ = std::max(extent_, std::abs(x));
  }

  int numEntities() const override { return a_.elements.numEntities(); }
  int nodesPerEntity() const override { return numNodes() + M_; }
  const std::vector<int>& nodes() const override { return allNodes_; }
  bool symmetric() const override { return a_.shape.symmetric; }
  bool seesLoadFactor() const override { return J_ == D_ + 2; }
  std::size_t historyBytes(int maxOrder) const override { return a_.historyBytes(maxOrder); }
  int eventCount() const override { return count_; }
  const std::vector<int>& eventNumbers() const override { return numbers_; }
  std::string eventText(int number) const override {
    return (M_ > 1 ? "contact faces around corner " : "contact point ") + std::to_string(number + 1) +
           " (of " + std::to_string(count_) + (M_ > 1 ? ") are on average" : ") is");
  }

  void keep(const TermPart& part) override {
    const std::size_t N = numNodes(), Q = numPoints(), M = M_;
    weights_ = rowsOf(weights_, part.entities, Q);
    shape_ = rowsOf(shape_, part.entities, Q * N);
    meanShape_ = rowsOf(meanShape_, part.entities, Q * M);
    conditionOf_ = rowsOf(conditionOf_, part.entities, M);
    allNodes_ = part.nodes;
    TermPart own{part.entities, {}};
    for (std::size_t e = 0; e < part.entities.size(); ++e)
      own.nodes.insert(own.nodes.end(), part.nodes.begin() + e * (N + M),
                       part.nodes.begin() + e * (N + M) + N);
    a_.keep(own);
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

  void connect(const DofMap& dofs, const std::vector<int>& positions) override {
    a_.elements.connect(dofs, positions, nodesPerEntity());
    positions_ = positions;
    multiplierDofs_.clear();
    for (int e = 0; e < numEntities(); ++e)
      for (int m = 0; m < M_; ++m)
        multiplierDofs_.push_back(
            dofs.firstDof(allNodes_[static_cast<std::size_t>(e) * nodesPerEntity() + numNodes() + m]));
  }

  OwnForces addResidual(const ConstDofView& u, double lambda, const DofView& f) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    std::vector<double> squares(batches().count);
    forEachBatch("residual", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
      makeForces(b, s);
      double sum = 0;
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane) {
        const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
        for (int m = 0; m < M_; ++m)
          s.conditions[m * kLanes + lane] +=
              (1.0 - active(e, m)) * stiffness(e, m) * share_[e * M_ + m] * s.multipliers[m * kLanes + lane];
        for (int n = 0; n < a_.elements.localDofs(); ++n)
          sum += s.force[n * kLanes + lane] * s.force[n * kLanes + lane];
        // A condition is no force, but a gap is a difference of coordinates: as a part of the scale their
        // rounding is 1e-7, a tenth of the residual's usual bound. Else a path whose loads begin with
        // nothing could not begin in contact.
        constexpr double coordinates = 1e7 * 2.2e-16;
        for (int m = 0; m < M_; ++m) {
          const double size = (coordinates * extent_) * active(e, m) * stiffness(e, m) * share_[e * M_ + m];
          sum += size * size;
        }
      }
      scatter(b, s, f);
      squares[b] = sum;
    });
    OwnForces own(a_.elements.numBalances(), 0.0);
    own[a_.elements.balance()] = sumOf(squares, 1).front();
    return own;
  }

  void addTangent(const ConstDofView& u, double lambda, const TangentSink& sink) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    forEachBatch("tangent", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.law->tangent(a_.batch(b, data, held.data()), s.in, s.out, s.jacobian);
      if (seesLoadFactor()) {
        for (int m = 0; m < numPoints() * O_; ++m)
          for (int lane = 0; lane < kLanes; ++lane)
            s.out[m * kLanes + lane] = -s.jacobian[(m * J_ + D_ + 1) * kLanes + lane];
        makeForces(b, s);
        scatter(b, s, sink.loadDirection);
      }
      addMultiplierBlocks(b, s.jacobian, sink);
      a_.elements.addBlocks(b, s.jacobian, O_, J_, false, {}, sink, s.moduli);
    });
  }

  void beginSeries(const ConstDofView& u, double lambda, int maxOrder) override {
    a_.reserveHistory(maxOrder);
    if (pieces_) {
      const auto data = pieces_->at(places(u, lambda));
      pieces_->beginSeries(data);
      seriesData_ = a_.packed(data);
    }
    const double* data = pieces_ ? seriesData_.data() : a_.data();
    const int Q = numPoints();
    std::vector<PointFailure> failures(batches().count);
    forEachBatch("beginSeries", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.start(b, data, s.in, s.out, failures[b]);
      a_.law->tangent(a_.batch(b, data, held.data()), s.in, s.out, s.jacobian);
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane) {
        const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
        for (int m = 0; m < M_; ++m) force_[e * M_ + m] = s.multipliers[m * kLanes + lane];
        for (int q = 0; q < Q; ++q) {
          gapStart_[e * Q + q] = s.out[(q * O_ + D_) * kLanes + lane];
          const double* ofGap = s.jacobian + (q * O_ + D_) * J_ * kLanes + lane;
          double* gradient = &gradient_[4 * (e * Q + q)];
          for (int i = 0; i < D_; ++i) gradient[i] = ofGap[i * kLanes];
          gradient[3] = seesLoadFactor() ? ofGap[(D_ + 1) * kLanes] : 0.0;
        }
      }
    });
    a_.throwFirst(failures);
  }

  void addOrder(int k, const ConstDofView& last, double lastLambda, const DofView& f) override {
    const double* data = pieces_ ? seriesData_.data() : a_.data();
    const SeriesOrder order = seriesOrder(k, a_.maxOrder());
    const int Q = numPoints();
    forEachBatch("addOrder", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      if (k > 1) inputs(b, last, lastLambda, false, s);
      a_.law->order(a_.seriesBatch(b, data), order, s.in, s.out);
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
        for (int q = 0; q < Q; ++q)
          gap_[(static_cast<std::size_t>(b) * kLanes + lane) * Q + q] = s.out[(q * O_ + D_) * kLanes + lane];
      makeForces(b, s);
      scatter(b, s, f);
    });
  }

  std::vector<double> eventOrder(int k, const ConstDofView& Uk, double lambdaK) const override {
    const std::size_t Q = numPoints(), M = M_, entities = numEntities();
    // Of every entity: its part of the mean gaps, then the multipliers.
    std::vector<double> gaps(entities * M, 0.0), multipliers(entities * M);
    forEachBatch("events", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      if (k > 0) inputs(b, Uk, lambdaK, false, s);
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane) {
        const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
        for (std::size_t q = 0; q < Q; ++q) {
          double h = k == 0 ? gapStart_[e * Q + q] : gap_[e * Q + q];
          if (k > 0) {
            const double* gradient = &gradient_[4 * (e * Q + q)];
            const double* in = s.in + q * J_ * kLanes + lane;
            for (int i = 0; i < D_; ++i) h += gradient[i] * in[i * kLanes];
            if (seesLoadFactor()) h += gradient[3] * in[(D_ + 1) * kLanes];
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
  std::vector<double> places(const ConstDofView& u, double lambda) const override {
    if (!pieces_) return {};
    const int stride = D_ + (seesLoadFactor() ? 1 : 0), Q = numPoints();
    std::vector<double> all(static_cast<std::size_t>(numEntities()) * Q * stride);
    forEachBatch("places", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
        for (int q = 0; q < Q; ++q) {
          double* place = &all[((static_cast<std::size_t>(b) * kLanes + lane) * Q + q) * stride];
          for (int i = 0; i < D_; ++i) place[i] = s.in[(q * J_ + i) * kLanes + lane];
          if (seesLoadFactor()) place[D_] = lambda;
        }
    });
    return all;
  }

  std::vector<double> covered() const override {
    const double* data = pieces_ ? seriesData_.data() : a_.data();
    const std::size_t Q = numPoints(), M = M_;
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

  std::vector<double> moved(const ConstDofView& u, double lambda) const override {
    std::vector<double> found(active_.size(), 0.0);
    if (!pieces_) return found;
    const auto in = places(u, lambda);
    const int stride = pieces_->numInputs(), Q = numPoints(), M = M_;
    for (int p = 0; p < pieces_->numPoints(); ++p)
      if (pieces_->pieceAt(p, &in[static_cast<std::size_t>(p) * stride]) != pieces_->pieceOfSeries(p))
        for (int m = 0; m < M; ++m)
          if (meanShape_[static_cast<std::size_t>(p) * M + m] != 0) found[conditionOf_[p / Q * M + m]] = 1;
    return found;
  }

  MeanGaps gapsAt(const ConstDofView& u, double lambda) const override {
    const auto shown = observe(u, lambda);
    MeanGaps gaps{std::vector<double>(active_.size(), 0.0), std::vector<double>(active_.size(), 0.0)};
    const std::size_t Q = numPoints(), M = M_;
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
  double touching(const ConstDofView& u) const override { return 1e-11 * sizeAt(u); }

  void setConditions(const std::vector<int>& conditions) override {
    if (conditions.size() != active_.size())
      throw std::logic_error("UnilateralTerm: not the conditions of this part");
    active_ = conditions;
  }

  std::vector<double> leastStiffness(const std::vector<double>& ofNodes) const override {
    const std::size_t N = numNodes(), Q = numPoints(), M = M_;
    std::vector<double> least(active_.size(), std::numeric_limits<double>::infinity());
    forEachCondition([&](int c, std::size_t at) {
      const std::size_t e = at / M;
      for (std::size_t i = 0; i < Q * N; ++i) {
        const std::size_t q = i / N, n = i % N;
        const double k = ofNodes[allNodes_[e * (N + M) + n]];
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

  PointValues observe(const ConstDofView& u, double lambda) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    const std::size_t Q = numPoints();
    PointValues result{a_.law->observedNames(), {}};
    result.values.resize(2 * static_cast<std::size_t>(numEntities()) * Q);
    forEachBatch("observe", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s);
      a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
        for (std::size_t q = 0; q < Q; ++q) {
          const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
          const bool on = exists(data, e, q);
          double* shown = &result.values[2 * (e * Q + q)];
          shown[0] = on ? s.out[(q * O_ + D_) * kLanes + lane] : std::numeric_limits<double>::infinity();
          shown[1] = on ? s.in[(q * J_ + D_) * kLanes + lane] : 0.0;
        }
    });
    return result;
  }

 private:
  /// A batch's numbers in a thread's memory.
  struct Scratch {
    Scratch(const UnilateralTerm& t, const ThreadMemory::Held& held) {
      const std::size_t J = t.J_, O = t.O_;
      force = t.a_.scratchOf(held);
      conditions = force + t.a_.elements.localDofs() * kLanes;
      multipliers = conditions + t.M_ * kLanes;
      in = multipliers + t.M_ * kLanes;
      out = in + t.a_.perBatch(J);
      jacobian = out + t.a_.perBatch(O);
      moduli = jacobian + t.a_.perBatch(O * J);
    }
    double *force, *conditions, *multipliers, *in, *out, *jacobian, *moduli;
  };

  double stiffness(std::size_t e, int m) const { return stiffness_[conditionOf_[e * M_ + m]]; }
  double active(std::size_t e, int m) const { return active_[conditionOf_[e * M_ + m]]; }

  /// s.in = (x, r, lambda), r the pressure at the point, with the constant part of x where it is asked for;
  /// s.multipliers [m][lane].
  void inputs(int b, const ConstDofView& u, double lambda, bool offset, const Scratch& s) const {
    const int Q = numPoints();
    a_.elements.gather(b, u.data(), J_, s.in);
    if (offset) a_.elements.addOffset(b, J_, s.in);
    for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane) {
      const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
      for (int m = 0; m < M_; ++m) s.multipliers[m * kLanes + lane] = u(multiplierDofs_[e * M_ + m]);
      for (int q = 0; q < Q; ++q) {
        double r = 0;
        for (int m = 0; m < M_; ++m)
          r += stiffness(e, m) * meanShape_[(e * Q + q) * M_ + m] * s.multipliers[m * kLanes + lane];
        s.in[(q * J_ + D_) * kLanes + lane] = r;
        if (seesLoadFactor()) s.in[(q * J_ + D_ + 1) * kLanes + lane] = lambda;
      }
    }
  }

  /// What the outputs (-r grad h, h) are at the nodes, s.force, and in the rows of the multipliers,
  /// s.conditions.
  void makeForces(int b, const Scratch& s) const {
    std::fill_n(s.force, a_.elements.localDofs() * kLanes, 0.0);
    a_.elements.addForces(b, s.out, O_, true, s.force);
    for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane) {
      const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane, Q = numPoints();
      for (int m = 0; m < M_; ++m) {
        double sum = 0;
        for (std::size_t q = 0; q < Q; ++q)
          sum +=
              meanShape_[(e * Q + q) * M_ + m] * (weights_[e * Q + q] * s.out[(q * O_ + D_) * kLanes + lane]);
        s.conditions[m * kLanes + lane] = -(active(e, m) * stiffness(e, m) * sum);
      }
    }
  }

  void scatter(int b, const Scratch& s, const DofView& f) const {
    a_.elements.scatter(b, s.force, f.data());
    for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
      for (int m = 0; m < M_; ++m)
        f(multiplierDofs_[(static_cast<std::size_t>(b) * kLanes + lane) * M_ + m]) +=
            s.conditions[m * kLanes + lane];
  }

  /// The blocks of the tangent that belong to multipliers.
  void addMultiplierBlocks(int b, const double* jacobian, const TangentSink& sink) const {
    const std::size_t N = numNodes(), Q = numPoints(), P = N + M_;
    for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane) {
      const std::size_t e = static_cast<std::size_t>(b) * kLanes + lane;
      const auto add = [&](int dof, std::size_t row, std::size_t column, int j, double value) {
        sink.values(sink.rowStart(dof) + positions_[(e * P + row) * P + column] + j) += value;
      };
      for (int m = 0; m < M_; ++m) {
        const double s = stiffness(e, m), on = active(e, m);
        const int multiplier = multiplierDofs_[e * M_ + m];
        add(multiplier, N + m, N + m, 0, share_[e * M_ + m] * (s == 0 ? heldDiagonal_ : s * (1 - on)));
        if (on == 0) continue;
        for (std::size_t n = 0; n < N; ++n) {
          double byMultiplier[3] = {}, ofCondition[3] = {};
          for (std::size_t q = 0; q < Q; ++q) {
            const double factor =
                s * meanShape_[(e * Q + q) * M_ + m] * weights_[e * Q + q] * shape_[(e * Q + q) * N + n];
            const double* at = jacobian + q * O_ * J_ * kLanes + lane;
            for (int i = 0; i < D_; ++i) {
              byMultiplier[i] += factor * at[(i * J_ + D_) * kLanes];
              ofCondition[i] -= factor * at[(D_ * J_ + i) * kLanes];
            }
          }
          for (int i = 0; i < D_; ++i) {
            add(a_.elements.dof(e, static_cast<int>(n)) + i, n, N + m, 0, byMultiplier[i]);
            add(multiplier, N + m, n, i, ofCondition[i]);
          }
        }
      }
    }
  }

  /// The conditions are numbered as their nodes are.
  void findConditions(const UnilateralPoints& faces) {
    const std::size_t Q = numPoints(), M = M_, entities = numEntities();
    int first = std::numeric_limits<int>::max(), last = -1;
    for (const int node : faces.multipliers) {
      first = std::min(first, node);
      last = std::max(last, node);
    }
    const std::size_t count = last < first ? 0 : last - first + 1;
    count_ = static_cast<int>(count);
    firstEntity_.assign(count, static_cast<int>(entities));
    for (std::size_t e = 0; e < entities; ++e)
      for (std::size_t m = 0; m < M; ++m) {
        const int c = faces.multipliers[e * M + m] - first;
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
    const std::size_t Q = numPoints(), M = M_, entities = numEntities();
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
  const double* dataAt(const ConstDofView& u, double lambda, std::vector<double>& room) const {
    if (!pieces_) return a_.data();
    room = a_.packed(pieces_->at(places(u, lambda)));
    return room.data();
  }

  /// Whether a point is over something, by these packed data.
  bool exists(const double* data, std::size_t e, std::size_t q) const {
    if (a_.shape.data == 0) return true;
    double own[kMaxData];
    const double* from = data + ((e / kLanes * numPoints() + q) * a_.shape.data) * kLanes + e % kLanes;
    for (int d = 0; d < a_.shape.data; ++d) own[d] = from[d * kLanes];
    return a_.law->exists(own);
  }

  /// The largest coordinate and displacement.
  double sizeAt(const ConstDofView& u) const {
    double size = extent_;
    for (int e = 0; e < numEntities(); ++e)
      for (int n = 0; n < numNodes(); ++n)
        for (int i = 0; i < D_; ++i) size = std::max(size, std::abs(u(a_.elements.dof(e, n) + i)));
    return size;
  }

  /// [entity] its nodes, then those of its multipliers.
  static std::vector<int> joinedNodes(const UnilateralPoints& faces) {
    const std::size_t N = faces.points.nodesPerEntity, M = faces.conditions;
    std::vector<int> all;
    for (int e = 0; e < faces.points.numEntities; ++e) {
      all.insert(all.end(), &faces.points.nodes[e * N], &faces.points.nodes[e * N] + N);
      all.insert(all.end(), &faces.multipliers[e * M], &faces.multipliers[e * M] + M);
    }
    return all;
  }

  int numNodes() const { return a_.elements.numNodes(); }  ///< of an entity, but for those of multipliers
  int numPoints() const { return a_.elements.numPoints(); }
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
  int D_, O_;                            ///< coordinates of a place; outputs of the law
  int J_;                                ///< inputs of the law
  std::vector<int> allNodes_;            ///< [entity][node], those of the multipliers last
  std::vector<int> positions_;           ///< [entity][node][node] in the tangent's rows
  std::vector<int> multiplierDofs_;      ///< [entity][m]
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

}  // namespace atrapos::fem
