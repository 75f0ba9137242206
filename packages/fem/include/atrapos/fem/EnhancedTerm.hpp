#pragma once

#include "atrapos/fem/EnhancedParameters.hpp"
#include "atrapos/fem/LawArrays.hpp"

namespace atrapos::fem {

/// Points at which a law with an enhanced strain acts: the maps B of a PointSet, and e = sum_j mode_j beta_j
/// with M parameters beta of each element.
struct EnhancedPoints {
  PointSet points;
  int numParameters = 0;
  std::vector<double> modes;  ///< [point of an element][parameter], the same for all elements
  std::vector<double> data;   ///< the law's passive data, [entity][point][datum]
};

/// A law of h = B u and of an enhanced strain e, paper (32)-(35), whose element parameters are condensed
/// inside the element at every order (docs/theory/shell.md, "Condensation"). B u: `Law::components` vectors
/// at a point.
///
/// Law (see taylor/Law.hpp): inputs (h, [Cartesian component][vector], e), outputs their work conjugates (f,
/// s); besides
///     template <class T> T enhancedStress(const T* in, const taylor::Passive<T>* data) const;   // s alone
///     double enhancedStrainSize(const double* data) const;   // strain per unit of e, for convergence only
/// and the observed values of LawTerm's laws.
///
/// beta follows from the displacements alone. Where an element has none, its forces are NaN, failure() says
/// why and beginSeries throws it. M: number of parameters.
template <class Law, int M, int Width = kLanes>
class EnhancedTerm final : public Term {
  static constexpr int L = Width, C = Law::components, I = 3 * C, J = I + 1, D = Law::numData;
  static_assert(Law::numInputs == J && Law::numOutputs == J, "the law's inputs are vectors and one strain");
  /// Points of an element: bounds the stack, 16 shell nodes need no more than 3 x 3 x 3.
  static constexpr int maxPoints = 27;
  using Pack = taylor::Lanes<L>;

  struct Arrays : LawArrays<Law, C, L> {
    View<double*> modes;    // [q][parameter]
    View<double*> dfde;     // [batch][q][I][lane], times the weight
    View<double*> dsdh;     // the same, times the weight
    View<double*> inverse;  // [batch][M][M][lane] K_bb^-1
    View<double*> g;        // [batch][M][lane] of the order swept last: g_k with U_k = 0, beta_k = 0
    View<int*> failed;      // [batch][lane]

    KOKKOS_INLINE_FUNCTION double mode(int q, int j) const { return modes(q * M + j); }
    KOKKOS_INLINE_FUNCTION Pack* at(const View<double*>& view, std::size_t item, int size) const {
      return reinterpret_cast<Pack*>(&view(item * size * L));
    }

    /// in[q] = (h, e) in all lanes, with the beta that belongs to the displacements.
    KOKKOS_INLINE_FUNCTION void inputs(int b, const ConstField& u, Pack* in) const {
      Pack local[3 * kMaxNodes];
      this->gather(b, u, local);
      const int Q = this->Q;
      for (int q = 0; q < Q; ++q) this->interpolate(b, q, local, in + q * J);
      for (int lane = 0; lane < L; ++lane) {
        double one[maxPoints * J], data[maxPoints * D + 1], w[maxPoints], beta[M];
        for (int q = 0; q < Q; ++q) {
          this->lanesOf(in + q * J, I, lane, one + q * J);
          this->lanesOf(this->dataAt(b, q), D, lane, data + q * D);
          w[q] = this->weightAt(b, q)[lane];
        }
        EnhancedFailure failure = EnhancedFailure::none;
        if (lane < this->lanesIn(b)) {
          failure = solveEnhanced<M>(this->law, Q, one, data, w, &modes(0), beta);
          if (failure != EnhancedFailure::none)
            for (int q = 0; q < Q; ++q) one[q * J + I] = NAN;
        } else {
          for (int q = 0; q < Q; ++q) one[q * J + I] = 0;
        }
        failed(b * L + lane) = static_cast<int>(failure);
        for (int q = 0; q < Q; ++q) in[q * J + I][lane] = one[q * J + I];
      }
    }

    /// Weighted derivatives of the law at all points: f by h (where wanted), f by e, s by h, and K_bb^-1.
    KOKKOS_INLINE_FUNCTION void moduli(int b, double* memory, const Pack* in, Pack* dfdh, Pack* byE,
                                       Pack* byh, Pack* Kinverse) const {
      Pack K[M * M], out[J], jacobian[J * J];
      for (int i = 0; i < M * M; ++i) K[i] = Pack(0.0);
      for (int q = 0; q < this->Q; ++q) {
        const Pack w = this->weightAt(b, q);
        this->tangent(b, q, memory, in + q * J, out, jacobian);
        if (dfdh)
          for (int m = 0; m < I; ++m)
            for (int n = 0; n < I; ++n) dfdh[(q * I + m) * I + n] = w * jacobian[m * J + n];
        for (int m = 0; m < I; ++m) {
          byE[q * I + m] = w * jacobian[m * J + I];
          byh[q * I + m] = w * jacobian[I * J + m];
        }
        const Pack dsde = w * jacobian[I * J + I];
        for (int j = 0; j < M; ++j)
          for (int k = 0; k < M; ++k) K[j * M + k] += (mode(q, j) * mode(q, k)) * dsde;
      }
      for (int lane = this->lanesIn(b); lane < L; ++lane)
        for (int j = 0; j < M; ++j) K[j * M + j][lane] = 1;  // padding: no weight, no stiffness
      invertInLanes<M>(K, Kinverse);
    }

    /// x = K_bb^-1 y
    KOKKOS_INLINE_FUNCTION void solveInLanes(int b, const Pack* y, Pack* x) const {
      const Pack* K = at(inverse, b, M * M);
      for (int j = 0; j < M; ++j) {
        x[j] = Pack(0.0);
        for (int i = 0; i < M; ++i) x[j] += K[j * M + i] * y[i];
      }
    }

    /// in[q] = (h_k, e_k) of U_k, with beta_k = -K_bb^-1 (g_k + K_bu U_k) and the g_k that the sweep of order
    /// k left.
    KOKKOS_INLINE_FUNCTION void trueInputs(int b, const ConstField& Uk, Pack* in) const {
      Pack local[3 * kMaxNodes], sum[M], minusBeta[M];
      this->gather(b, Uk, local);
      for (int j = 0; j < M; ++j) sum[j] = at(g, b, M)[j];
      for (int q = 0; q < this->Q; ++q) {
        Pack* h = in + q * J;
        this->interpolate(b, q, local, h);
        const Pack* byh = at(dsdh, static_cast<std::size_t>(b) * this->Q + q, I);
        Pack s(0.0);
        for (int m = 0; m < I; ++m) s += byh[m] * h[m];
        for (int j = 0; j < M; ++j) sum[j] += mode(q, j) * s;
      }
      solveInLanes(b, sum, minusBeta);
      for (int q = 0; q < this->Q; ++q) {
        Pack e(0.0);
        for (int j = 0; j < M; ++j) e += mode(q, j) * minusBeta[j];
        in[q * J + I] = -e;
      }
    }
  };

 public:
  EnhancedTerm(const Law& law, const EnhancedPoints& p)
      : entityNodes_(p.points.nodes),
        batches_(makeBatches(L, p.points.numEntities, p.points.nodesPerEntity, p.points.nodes)) {
    const int Q = p.points.pointsPerEntity;
    if (p.numParameters != M || p.modes.size() != static_cast<std::size_t>(Q) * M)
      throw std::logic_error("EnhancedTerm: wrong number of parameters or modes");
    if (Q > maxPoints)
      throw std::invalid_argument("a shell element has more than 27 points: lower the cubature degree");
    a_.fill(law, p.points, p.data, batches_);
    a_.modes = upload("modes", p.modes);
    makeWorkspace();
  }

  int numEntities() const override { return a_.numEntities; }
  int nodesPerEntity() const override { return a_.N; }
  const std::vector<int>& nodes() const override { return entityNodes_; }
  bool symmetric() const override { return Law::symmetric; }
  bool seesLoadFactor() const override { return false; }
  std::size_t historyBytes(int maxOrder) const override {
    return a_.historyDoubles(batches_.count, maxOrder) * sizeof(double);
  }

  void keep(const TermPart& part) override {
    batches_ = makeBatches(L, static_cast<int>(part.entities.size()), a_.N, part.nodes);
    entityNodes_ = part.nodes;
    kept_ = part.entities;
    a_.keep(part, batches_);
    makeWorkspace();
  }

  void setPositions(const std::vector<int>& positions) override {
    a_.setPositions(positions, batches_.count);
  }

  double addResidual(const ConstField& u, double, const Field& f) const override {
    const Arrays a = a_;
    const View<double*> squares("squares", batches_.count);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "residual", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack force[3 * kMaxNodes], in[maxPoints * J], out[J];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          a.inputs(b, u, in);
          for (int q = 0; q < a.Q; ++q) {
            a.evaluate(b, q, held.data(), in + q * J, out);
            a.accumulate(b, q, out, force);
          }
          a.scatter(b, force, f);
          squares(b) = a.squares(force);
        });
    return sumOf(squares);
  }

  void addTangent(const ConstField& u, double, const TangentSink& sink) const override {
    const Arrays a = a_;
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "tangent", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack in[maxPoints * J], dfdh[maxPoints * I * I], byE[maxPoints * I], byh[maxPoints * I],
              Kinverse[M * M];
          a.inputs(b, u, in);
          a.moduli(b, held.data(), in, dfdh, byE, byh, Kinverse);
          // K_ub and -K_bb^-1 K_bu, node by node: [node][component][parameter].
          Pack ub[kMaxNodes * 3 * M], bu[kMaxNodes * 3 * M];
          for (int i = 0; i < a.N * 3 * M; ++i) ub[i] = bu[i] = Pack(0.0);
          for (int j = 0; j < M; ++j) {
            Pack u1[3 * kMaxNodes], b1[3 * kMaxNodes];
            for (int n = 0; n < 3 * a.N; ++n) u1[n] = b1[n] = Pack(0.0);
            for (int q = 0; q < a.Q; ++q) {
              Pack scaledE[I], scaledh[I];
              for (int m = 0; m < I; ++m) {
                scaledE[m] = byE[q * I + m] * a.mode(q, j);
                scaledh[m] = byh[q * I + m] * a.mode(q, j);
              }
              a.accumulateWeighted(b, q, scaledE, u1);
              a.accumulateWeighted(b, q, scaledh, b1);
            }
            for (int n = 0; n < 3 * a.N; ++n) {
              ub[n * M + j] = u1[n];
              for (int k = 0; k < M; ++k) bu[n * M + k] = bu[n * M + k] - Kinverse[k * M + j] * b1[n];
            }
          }
          const auto condensed = [&](int na, int nb, Pack* block) {
            for (int i = 0; i < 3; ++i)
              for (int j = 0; j < 3; ++j) {
                Pack sum(0.0);
                for (int k = 0; k < M; ++k) sum += ub[(3 * na + i) * M + k] * bu[(3 * nb + j) * M + k];
                block[3 * i + j] = sum;
              }
          };
          a.addBlocks(b, dfdh, Law::symmetric, condensed, sink);
        });
  }

  void beginSeries(const ConstField& u, double, int maxOrder) override {
    a_.reserveHistory(batches_.count, maxOrder);
    const Arrays a = a_;
    const View<LawFailure*> failures("failures", batches_.count);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "beginSeries", batches_, a.order, KOKKOS_LAMBDA(int b) {
          const PointMemory::Held held(memory);
          Pack in[maxPoints * J], out[J];
          a.inputs(b, u, in);
          a.moduli(b, held.data(), in, nullptr, a.at(a.dfde, b, a.Q * I), a.at(a.dsdh, b, a.Q * I),
                   a.at(a.inverse, b, M * M));
          for (int q = 0; q < a.Q; ++q) {
            taylor::Failures<L> noted;
            auto context = a.context(b, q, 0);
            context.failures = &noted;
            taylor::start(a.law, context, in + q * J, a.dataAt(b, q), out);
            a.findFailure(b, q, out, noted, failures(b));
          }
        });
    const std::string unsolved = failure();
    if (!unsolved.empty()) throw taylor::DomainError(taylor::Operation::Result, NAN, unsolved);
    throwFirst(failures, kept_);
  }

  // f_k - K_ub K_bb^-1 g_k, after the histories of order k - 1 became those of the true (U, beta).
  void addOrder(int k, const ConstField& last, double, const Field& f) override {
    Arrays a = a_;
    a.block = taylor::orderBlock(k, a.maxOrder);
    forEachBatch(
        "addOrder", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack force[3 * kMaxNodes], in[maxPoints * J], out[J], g[M];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          for (int j = 0; j < M; ++j) g[j] = Pack(0.0);
          if (k > 1) a.trueInputs(b, last, in);
          // Both orders in one visit: the histories are read from memory once an order.
          for (int q = 0; q < a.Q; ++q) {
            if (k > 1) {
              auto previous = a.context(b, q, k - 1);
              taylor::complete(a.law, previous, in + q * J, a.dataAt(b, q));
            }
            auto context = a.context(b, q, k);
            taylor::sweep(a.law, context, a.dataAt(b, q), out);
            a.accumulate(b, q, out, force);
            const Pack s = a.weightAt(b, q) * out[I];
            for (int j = 0; j < M; ++j) g[j] += a.mode(q, j) * s;
          }
          Pack minusBeta[M];
          a.solveInLanes(b, g, minusBeta);
          for (int q = 0; q < a.Q; ++q) {
            Pack e(0.0), stress[I];
            for (int j = 0; j < M; ++j) e += a.mode(q, j) * minusBeta[j];
            const Pack* byE = a.at(a.dfde, static_cast<std::size_t>(b) * a.Q + q, I);
            for (int m = 0; m < I; ++m) stress[m] = -(byE[m] * e);
            a.accumulateWeighted(b, q, stress, force);
          }
          for (int j = 0; j < M; ++j) a.at(a.g, b, M)[j] = g[j];
          a.scatter(b, force, f);
        });
  }

  PointValues observe(const ConstField& u, double) const override {
    PointValues result;
    result.names = Law::observedNames();
    constexpr int V = Law::numObserved;
    View<double*> values("observed", static_cast<std::size_t>(a_.numEntities) * a_.Q * V);
    const Arrays a = a_;
    forEachBatch(
        "observe", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack in[maxPoints * J];
          a.inputs(b, u, in);
          for (int q = 0; q < a.Q; ++q)
            for (int lane = 0; lane < a.lanesIn(b); ++lane) {
              double one[J], data[D + 1];
              a.lanesOf(in + q * J, J, lane, one);
              a.lanesOf(a.dataAt(b, q), D, lane, data);
              a.law.observe(one, data, &values((static_cast<std::size_t>(b * L + lane) * a.Q + q) * V));
            }
        });
    auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), values);
    result.values.assign(host.data(), host.data() + host.size());
    return result;
  }

  /// The first element without enhanced parameters in the last loop over states (residual, tangent, start of
  /// a series), and why; empty where all have theirs. Elements are counted from 1 within the whole term.
  std::string failure() const {
    auto failed = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), a_.failed);
    for (int e = 0; e < a_.numEntities; ++e)
      if (failed(e) != 0)
        return "element " + std::to_string(numberInTerm(kept_, e) + 1) + ": " +
               describe(static_cast<EnhancedFailure>(failed(e)));
    return {};
  }

 private:
  void makeWorkspace() {
    const std::size_t batches = batches_.count, Q = a_.Q;
    a_.dfde = View<double*>("dfde", batches * Q * I * L);
    a_.dsdh = View<double*>("dsdh", batches * Q * I * L);
    a_.inverse = View<double*>("inverse", batches * M * M * L);
    a_.g = View<double*>("g", batches * M * L);
    a_.failed = View<int*>("failed", batches * L);
  }

  std::vector<int> entityNodes_;
  std::vector<int> kept_;  ///< entities of the whole term, where this is a part
  Batches batches_;
  Arrays a_;
};

}  // namespace atrapos::fem
