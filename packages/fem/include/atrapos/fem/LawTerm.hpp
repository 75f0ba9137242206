#pragma once

#include <algorithm>
#include <functional>
#include <memory>
#include <utility>

#include "atrapos/fem/LawArrays.hpp"
#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/fem/Rows.hpp"

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

/// Brings passive data of all points of a term up to date before the law reads them: which piece of a surface
/// a point is over, a table's cell, ...
///
/// in: [point][law input] (with CurrentPosition the place, and the load factor where the law reads it). data:
/// [point][datum], on entry those that the term was made with, whatever was evaluated before: the result is
/// a function of `in` alone, so that a residual, a tangent and a path do not depend on what came before them.
/// Called on the host, once a loop for all points.
using DataUpdate = std::function<void(int numPoints, const double* in, double* data)>;

/// A law at the points of a PointSet: gather, B, law, B^T, scatter.
///
/// Law (see taylor/Law.hpp) maps the operator's inputs to their work conjugates: the virtual work of the term
/// is sum over points of weight * out . d(in). A law with one input more than the operator has reads the load
/// factor as its last input. It may show named values through
///     static constexpr int numObserved;  static std::vector<std::string> observedNames();
///     void observe(const double* in, const double* data, double* observed) const;
/// A law says `static constexpr bool symmetric` when d out/d in is symmetric.
/// `data` holds Law::numData passive numbers a point: [entity][point][datum]. With an `update` they are
/// brought up to date at every state that is evaluated; a series keeps those of its start.
template <class Law, class Operator, int Width = kLanes>
class LawTerm final : public Term {
  static constexpr int L = Width, C = Operator::components, I = Operator::numInputs, D = Law::numData;
  static constexpr int J = Law::numInputs;
  static constexpr bool seesLambda = J == I + 1;
  static_assert((J == I || seesLambda) && Law::numOutputs == I,
                "the law's inputs must be the operator's, and perhaps the load factor");
  using Pack = taylor::Lanes<L>;
  using Arrays = LawArrays<Law, C, L>;

 public:
  LawTerm(const Law& law, const PointSet& points, const std::vector<double>& data = {},
          DataUpdate update = {})
      : entityNodes_(points.nodes),
        batches_(makeBatches(L, points.numEntities, points.nodesPerEntity, points.nodes)),
        update_(std::move(update)) {
    a_.fill(law, points, data, batches_);
    if (!update_) return;
    initialData_ = data;
    seriesData_ = View<double*>("seriesData", a_.data.size());
  }

  /// A law that is analytic piece by piece: which piece a point is on is part of its data.
  LawTerm(const Law& law, const PointSet& points, const std::vector<double>& data, PieceSearch search)
      : LawTerm(law, points, data, [this](int, const double* in, double* renewed) {
          const std::size_t count = static_cast<std::size_t>(pieces_->numPoints()) * J;
          const auto found = pieces_->at({in, in + count});
          std::copy(found.begin(), found.end(), renewed);
        }) {
    pieces_ = std::make_unique<PointPieces>(std::move(search), points.numPoints(), data);
  }
  LawTerm(const LawTerm&) = delete;
  LawTerm& operator=(const LawTerm&) = delete;

  int numEntities() const override { return a_.numEntities; }
  int nodesPerEntity() const override { return a_.N; }
  const std::vector<int>& nodes() const override { return entityNodes_; }
  bool symmetric() const override { return Law::symmetric; }
  bool seesLoadFactor() const override { return seesLambda; }
  std::size_t historyBytes(int maxOrder) const override {
    return a_.historyDoubles(batches_.count, maxOrder) * sizeof(double);
  }

  void keep(const TermPart& part) override {
    batches_ = makeBatches(L, static_cast<int>(part.entities.size()), a_.N, part.nodes);
    entityNodes_ = part.nodes;
    kept_ = part.entities;
    a_.keep(part, batches_);
    if (!update_) return;
    initialData_ = rowsOf(initialData_, part.entities, static_cast<std::size_t>(a_.Q) * D);
    if (pieces_) pieces_->keep(pointsOf(part.entities, a_.Q));
    seriesData_ = View<double*>("seriesData", a_.data.size());
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
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[J], out[I];
          const PointMemory::Held held(memory);
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            a.evaluate(b, q, held.data(), in, out);
            a.accumulate(b, q, out, force);
          }
          a.scatter(b, force, f);
          squares(b) = a.squares(force);
        });
    return sumOf(squares);
  }

  void addTangent(const ConstField& u, double lambda, const TangentSink& sink) const override {
    const Arrays a = updated(u, lambda, a_.data);
    const PointMemory memory = a_.pointMemory();
    forEachBatch(
        "tangent", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J], out[I], jacobian[I * J];
          Pack moduli[kMaxPoints * I * I];  // weighted tangent of the law at every point
          Pack byLambda[I], direction[3 * kMaxNodes];
          const PointMemory::Held held(memory);
          if constexpr (seesLambda)
            for (int n = 0; n < 3 * a.N; ++n) direction[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            const Pack w = a.weightAt(b, q);
            a.tangent(b, q, held.data(), in, out, jacobian);
            for (int m = 0; m < I; ++m) {
              for (int n = 0; n < I; ++n) moduli[(q * I + m) * I + n] = w * jacobian[m * J + n];
              if constexpr (seesLambda) byLambda[m] = -jacobian[m * J + I];
            }
            if constexpr (seesLambda) a.accumulate(b, q, byLambda, direction);
          }
          if constexpr (seesLambda) a.scatter(b, direction, sink.loadDirection);
          const auto nothing = [](int, int, Pack* block) {
            for (int i = 0; i < 9; ++i) block[i] = Pack(0.0);
          };
          a.addBlocks(b, moduli, Law::symmetric, nothing, sink);
        });
  }

  void beginSeries(const ConstField& u, double lambda, int maxOrder) override {
    a_.reserveHistory(batches_.count, maxOrder);
    const Arrays a = updated(u, lambda, seriesData_, pieces_.get());
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
    throwFirst(failures, kept_);
  }

  void addOrder(int k, const ConstField& last, double lastLambda, const Field& f) override {
    Arrays a = a_;
    if (update_) a.data = seriesData_;
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

  PointPieces* pieces() override { return pieces_.get(); }
  std::vector<double> places(const ConstField& u, double lambda) const override {
    const int Q = a_.Q;
    const Arrays a = a_;
    const View<double*> all("inputs", static_cast<std::size_t>(a.numEntities) * Q * J);
    forEachBatch(
        "inputs", batches_, a.order, KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[J];
          a.gather(b, u, local);
          for (int q = 0; q < Q; ++q) {
            inputs(a, b, q, local, lambda, in);
            for (int lane = 0; lane < a.lanesIn(b); ++lane)
              a.lanesOf(in, J, lane, &all((static_cast<std::size_t>(b * L + lane) * Q + q) * J));
          }
        });
    const auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), all);
    return {host.data(), host.data() + host.size()};
  }

  PointValues observe(const ConstField& u, double lambda) const override {
    PointValues result;
    result.names = Law::observedNames();
    constexpr int M = Law::numObserved;
    View<double*> values("observed", static_cast<std::size_t>(a_.numEntities) * a_.Q * M);
    const Arrays a = updated(u, lambda, a_.data);
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

  /// The arrays, with `data` in place of theirs and brought up to date at the state where there is an update.
  /// A series that begins tells its pieces to `pieces`.
  Arrays updated(const ConstField& u, double lambda, const View<double*>& data,
                 PointPieces* pieces = nullptr) const {
    if (!update_) return a_;
    Arrays a = a_;
    const auto in = places(u, lambda);
    std::vector<double> renewed = initialData_;
    update_(a.numEntities * a.Q, in.data(), renewed.data());
    if (pieces) pieces->beginSeries(renewed);
    auto mirror = Kokkos::create_mirror_view(data);
    a.pack(renewed, static_cast<std::size_t>(a.Q) * D, batches_.count, mirror.data());
    Kokkos::deep_copy(data, mirror);
    a.data = data;
    return a;
  }

  std::vector<int> entityNodes_;
  std::vector<int> kept_;  ///< entities of the whole term, where this is a part
  Batches batches_;
  Arrays a_;
  DataUpdate update_;
  std::unique_ptr<PointPieces> pieces_;  ///< null: not in pieces
  std::vector<double> initialData_;
  View<double*> seriesData_;  ///< those of the series under way, as a_.data
};

}  // namespace atrapos::fem
