#pragma once

#include "atrapos/fem/LawArrays.hpp"

namespace atrapos::fem {

/// Law input H_ij = du_i/dX_j (row-major, 9 entries): solids in total-Lagrangian form.
struct DisplacementGradient {
  static constexpr int components = 3;
  static constexpr int numInputs = 9;
};

/// Law input x = X + u (3 entries): contact, forces that depend on the place.
struct CurrentPosition {
  static constexpr int components = 1;
  static constexpr int numInputs = 3;
};

/// A law at the points of a PointSet: gather, B, law, B^T, scatter.
///
/// Law (see taylor/Law.hpp) maps the operator's inputs to their work conjugates: the virtual work of the term
/// is sum over points of weight * out . d(in). A law with one input more than the operator has reads the load
/// factor as its last input. It may show named values through
///     static constexpr int numObserved;  static std::vector<std::string> observedNames();
///     void observe(const double* in, const double* data, double* observed) const;
/// A law says `static constexpr bool symmetric` when d out/d in is symmetric.
/// `data` holds Law::numData passive numbers a point: [entity][point][datum].
template <class Law, class Operator>
class LawTerm final : public Term {
  static constexpr int L = kLanes, C = Operator::components, I = Operator::numInputs, D = Law::numData;
  static constexpr int J = Law::numInputs;
  static constexpr bool seesLambda = J == I + 1;
  static_assert((J == I || seesLambda) && Law::numOutputs == I,
                "the law's inputs must be the operator's, and perhaps the load factor");
  using Pack = taylor::Lanes<L>;
  using Arrays = LawArrays<Law, C>;

 public:
  LawTerm(const Law& law, const PointSet& points, const std::vector<double>& data = {})
      : entityNodes_(points.nodes),
        batches_(makeBatches(L, points.numEntities, points.nodesPerEntity, points.nodes)) {
    a_.fill(law, points, data, batches_);
  }

  int numEntities() const override { return a_.numEntities; }
  int nodesPerEntity() const override { return a_.N; }
  const std::vector<int>& nodes() const override { return entityNodes_; }
  bool symmetric() const override { return Law::symmetric; }
  bool seesLoadFactor() const override { return seesLambda; }
  std::size_t historyBytes(int maxOrder) const override {
    return a_.historyDoubles(batches_.count, maxOrder) * sizeof(double);
  }

  void setPositions(const std::vector<int>& positions) override {
    a_.setPositions(positions, batches_.count);
  }

  double addResidual(const ConstField& u, double lambda, const Field& f) const override {
    const Arrays a = a_;
    const View<double*> squares("squares", batches_.count);
    forEachBatch(
        "residual", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[I];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            a.evaluate(b, q, in, out);
            a.accumulate(b, q, out, force);
          }
          a.scatter(b, force, f);
          squares(b) = a.squares(force);
        });
    return sumOf(squares);
  }

  void addTangent(const ConstField& u, double lambda, const TangentSink& sink) const override {
    const Arrays a = a_;
    forEachBatch(
        "tangent", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J];
          Pack moduli[kMaxPoints * I * I];  // weighted tangent of the law at every point
          Pack byLambda[I], direction[3 * kMaxNodes];
          if constexpr (seesLambda)
            for (int n = 0; n < 3 * a.N; ++n) direction[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            const Pack w = a.weightAt(b, q);
            for (int lane = 0; lane < L; ++lane) {
              double one[J], data[D + 1], out[I], jacobian[I * J];
              a.lanesOf(in, J, lane, one);
              a.lanesOf(a.dataAt(b, q), D, lane, data);
              taylor::tangent(a.law, one, data, out, jacobian);
              for (int m = 0; m < I; ++m) {
                for (int n = 0; n < I; ++n) moduli[(q * I + m) * I + n][lane] = w[lane] * jacobian[m * J + n];
                if constexpr (seesLambda) byLambda[m][lane] = -jacobian[m * J + I];
              }
            }
            if constexpr (seesLambda) a.accumulate(b, q, byLambda, direction);
          }
          if constexpr (seesLambda) a.scatter(b, direction, sink.loadDirection);
          const auto nothing = [](int, int, Pack* block) {
            for (int i = 0; i < 9; ++i) block[i] = Pack(0.0);
          };
          a.addBlocks(b, moduli, nothing, sink);
        });
  }

  void beginSeries(const ConstField& u, double lambda, int maxOrder) override {
    a_.reserveHistory(batches_.count, maxOrder);
    const Arrays a = a_;
    const View<LawFailure*> failures("failures", batches_.count);
    forEachBatch(
        "beginSeries", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J], out[I];
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            taylor::Failures<L> noted;
            auto context = a.context(b, q, 0);
            context.failures = &noted;
            taylor::start(a.law, context, in, a.dataAt(b, q), out);
            a.findFailure(b, q, out, noted, failures(b));
          }
        });
    throwFirst(failures);
  }

  void addOrder(int k, const ConstField& last, double lastLambda, const Field& f) override {
    Arrays a = a_;
    a.block = taylor::orderBlock(k, a.maxOrder);
    forEachBatch(
        "addOrder", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[I];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          if (k > 1) a.gather(b, last, local);
          // Both orders in one visit: the histories are read from memory once an order.
          for (int q = 0; q < a.Q; ++q) {
            if (k > 1) {
              a.interpolate(b, q, local, in);
              if constexpr (seesLambda) in[I] = Pack(lastLambda);
              auto previous = a.context(b, q, k - 1);
              taylor::complete(a.law, previous, in, a.dataAt(b, q));
            }
            auto context = a.context(b, q, k);
            taylor::sweep(a.law, context, a.dataAt(b, q), out);
            a.accumulate(b, q, out, force);
          }
          a.scatter(b, force, f);
        });
  }

  PointValues observe(const ConstField& u, double lambda) const override {
    PointValues result;
    result.names = Law::observedNames();
    constexpr int M = Law::numObserved;
    View<double*> values("observed", static_cast<std::size_t>(a_.numEntities) * a_.Q * M);
    const Arrays a = a_;
    forEachBatch(
        "observe", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J];
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            for (int lane = 0; lane < a.lanesIn(b); ++lane) {
              double one[J], data[D + 1];
              a.lanesOf(in, J, lane, one);
              a.lanesOf(a.dataAt(b, q), D, lane, data);
              a.law.observe(one, data, &values((static_cast<std::size_t>(b * L + lane) * a.Q + q) * M));
            }
          }
        });
    auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), values);
    result.values.assign(host.data(), host.data() + host.size());
    return result;
  }

 private:
  /// in = (B u, lambda) at point q.
  KOKKOS_INLINE_FUNCTION static void inputs(const Arrays& a, int b, int q, const Pack* local, double lambda,
                                            Pack* in) {
    a.interpolate(b, q, local, in);
    a.addOffset(b, q, in);
    if constexpr (seesLambda) in[I] = Pack(lambda);
  }

  std::vector<int> entityNodes_;
  Batches batches_;
  Arrays a_;
};

}  // namespace atrapos::fem
