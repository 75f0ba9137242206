#pragma once

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "atrapos/fem/Batches.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"
#include "atrapos/taylor/Law.hpp"

namespace atrapos::fem {

/// Lanes of a batch: one AVX-512 register of doubles, two of AVX2.
constexpr int kLanes = 8;
/// Bounds of the element loops' stack arrays.
constexpr int kMaxNodes = 27;
constexpr int kMaxPoints = 64;

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
/// is sum over points of weight * out . d(in). It may show named values through
///     static constexpr int numObserved;  static std::vector<std::string> observedNames();
///     void observe(const double* in, const double* data, double* observed) const;
/// A law says `static constexpr bool symmetric` when d out/d in is symmetric.
/// `data` holds Law::numData passive numbers a point: [entity][point][datum].
template <class Law, class Operator>
class LawTerm final : public Term {
  static constexpr int L = kLanes, C = Operator::components, I = Operator::numInputs, D = Law::numData;
  static_assert(Law::numInputs == I && Law::numOutputs == I, "the law's inputs must be the operator's");
  using Pack = taylor::Lanes<L>;

  /// What the kernels read; copied by value into them.
  struct Arrays {
    Law law;
    int numEntities, N, Q, slots = 0, maxOrder = 0;
    View<int*> nodes;       // [batch][lane][node]
    View<int*> positions;   // [batch][lane][node a][node b]
    View<double*> shape;    // [batch][q][node][component][lane]
    View<double*> weight;   // [batch][q][lane]
    View<double*> offset;   // [batch][q][input][lane], CurrentPosition only: X
    View<double*> data;     // [batch][q][datum][lane]
    View<double*> history;  // [batch][q][slot][order][lane]
    View<int*> order;

    KOKKOS_INLINE_FUNCTION int lanesIn(int b) const {
      const int left = numEntities - b * L;
      return left < L ? left : L;
    }
    KOKKOS_INLINE_FUNCTION const int* nodesOf(int b, int lane) const { return &nodes((b * L + lane) * N); }
    KOKKOS_INLINE_FUNCTION const double* shapeAt(int b, int q) const {
      return &shape((static_cast<std::size_t>(b) * Q + q) * N * C * L);
    }
    KOKKOS_INLINE_FUNCTION const Pack* dataAt(int b, int q) const {
      return D == 0 ? nullptr
                    : reinterpret_cast<const Pack*>(&data((static_cast<std::size_t>(b) * Q + q) * D * L));
    }
    KOKKOS_INLINE_FUNCTION double* historyAt(int b, int q) const {
      return &history((static_cast<std::size_t>(b) * Q + q) * slots * (maxOrder + 1) * L);
    }

    KOKKOS_INLINE_FUNCTION void gather(int b, const ConstField& u, Pack* local) const {
      for (int lane = 0; lane < L; ++lane) {
        const int* node = nodesOf(b, lane);
        for (int n = 0; n < N; ++n)
          for (int i = 0; i < 3; ++i) local[3 * n + i].v[lane] = u(3 * node[n] + i);
      }
    }

    /// in = B u at point q.
    KOKKOS_INLINE_FUNCTION void interpolate(int b, int q, const Pack* local, Pack* in) const {
      const double* s = shapeAt(b, q);
      for (int m = 0; m < I; ++m) in[m] = Pack(0.0);
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < C; ++c) {
            const double* sc = s + (n * C + c) * L;
            for (int lane = 0; lane < L; ++lane) in[i * C + c].v[lane] += local[3 * n + i].v[lane] * sc[lane];
          }
    }

    /// Adds the constant part of the inputs (order 0 only).
    KOKKOS_INLINE_FUNCTION void addOffset(int b, int q, Pack* in) const {
      if (C != 1) return;
      const double* x = &offset((static_cast<std::size_t>(b) * Q + q) * I * L);
      for (int m = 0; m < I; ++m)
        for (int lane = 0; lane < L; ++lane) in[m].v[lane] += x[m * L + lane];
    }

    /// force += weight B^T out.
    KOKKOS_INLINE_FUNCTION void accumulate(int b, int q, const Pack* out, Pack* force) const {
      const double* s = shapeAt(b, q);
      const double* w = &weight((static_cast<std::size_t>(b) * Q + q) * L);
      Pack scaled[I];
      for (int m = 0; m < I; ++m)
        for (int lane = 0; lane < L; ++lane) scaled[m].v[lane] = w[lane] * out[m].v[lane];
      for (int n = 0; n < N; ++n)
        for (int i = 0; i < 3; ++i)
          for (int c = 0; c < C; ++c) {
            const double* sc = s + (n * C + c) * L;
            for (int lane = 0; lane < L; ++lane)
              force[3 * n + i].v[lane] += scaled[i * C + c].v[lane] * sc[lane];
          }
    }

    KOKKOS_INLINE_FUNCTION void scatter(int b, const Pack* force, const Field& f) const {
      const int count = lanesIn(b);
      for (int lane = 0; lane < count; ++lane) {
        const int* node = nodesOf(b, lane);
        for (int n = 0; n < N; ++n)
          for (int i = 0; i < 3; ++i) f(3 * node[n] + i) += force[3 * n + i].v[lane];
      }
    }

    KOKKOS_INLINE_FUNCTION void lanesOf(const Pack* in, int count, int lane, double* one) const {
      for (int m = 0; m < count; ++m) one[m] = in[m].v[lane];
    }
  };

 public:
  LawTerm(const Law& law, const PointSet& points, const std::vector<double>& data = {})
      : entityNodes_(points.nodes),
        batches_(makeBatches(L, points.numEntities, points.nodesPerEntity, points.nodes)) {
    if (points.shapeComponents != C)
      throw std::logic_error("LawTerm: the points' shape components do not fit the operator");
    if (points.nodesPerEntity > kMaxNodes || points.pointsPerEntity > kMaxPoints)
      throw std::invalid_argument(
          "an element or face has more than 27 nodes or 64 points: lower the cubature degree");
    if (data.size() != static_cast<std::size_t>(points.numPoints()) * D)
      throw std::logic_error("LawTerm: wrong number of data");
    a_.law = law;
    a_.numEntities = points.numEntities;
    a_.N = points.nodesPerEntity;
    a_.Q = points.pointsPerEntity;
    a_.slots = taylor::historySlots<L>(law);
    fill(points, data);
  }

  int numEntities() const override { return a_.numEntities; }
  int nodesPerEntity() const override { return a_.N; }
  const std::vector<int>& nodes() const override { return entityNodes_; }
  bool symmetric() const override { return Law::symmetric; }
  std::size_t historyBytes(int maxOrder) const override { return historyDoubles(maxOrder) * sizeof(double); }

  void setPositions(const std::vector<int>& positions) override {
    const int block = a_.N * a_.N;
    a_.positions = View<int*>("positions", static_cast<std::size_t>(batches_.count) * L * block);
    auto host = Kokkos::create_mirror_view(a_.positions);
    for (int e = 0; e < a_.numEntities; ++e)
      for (int i = 0; i < block; ++i)
        host(static_cast<std::size_t>(e) * block + i) = positions[static_cast<std::size_t>(e) * block + i];
    Kokkos::deep_copy(a_.positions, host);
  }

  double addResidual(const ConstField& u, const Field& f) const override {
    const Arrays a = a_;
    const View<double*> squares("squares", batches_.count);
    forEachBatch(
        "residual", KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], force[3 * kMaxNodes], in[I], out[I];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.interpolate(b, q, local, in);
            a.addOffset(b, q, in);
            for (int lane = 0; lane < L; ++lane) {
              double one[I], data[D + 1], result[I];
              a.lanesOf(in, I, lane, one);
              a.lanesOf(a.dataAt(b, q), D, lane, data);
              taylor::value(a.law, one, data, result);
              for (int m = 0; m < I; ++m) out[m].v[lane] = result[m];
            }
            a.accumulate(b, q, out, force);
          }
          a.scatter(b, force, f);
          double sum = 0;
          for (int n = 0; n < 3 * a.N; ++n)
            for (int lane = 0; lane < L; ++lane) sum += force[n].v[lane] * force[n].v[lane];
          squares(b) = sum;  // padding lanes have weight, hence force, zero
        });
    auto host = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), squares);
    double sum = 0;  // in one order for any number of threads
    for (int b = 0; b < batches_.count; ++b) sum += host(b);
    return sum;
  }

  void addTangent(const ConstField& u, const TangentSink& sink) const override {
    const Arrays a = a_;
    forEachBatch(
        "tangent", KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[I];
          Pack moduli[kMaxPoints * I * I];  // weighted tangent of the law at every point
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.interpolate(b, q, local, in);
            a.addOffset(b, q, in);
            const double* w = &a.weight((static_cast<std::size_t>(b) * a.Q + q) * L);
            for (int lane = 0; lane < L; ++lane) {
              double one[I], data[D + 1], out[I], jacobian[I * I];
              a.lanesOf(in, I, lane, one);
              a.lanesOf(a.dataAt(b, q), D, lane, data);
              taylor::tangent(a.law, one, data, out, jacobian);
              for (int m = 0; m < I * I; ++m) moduli[q * I * I + m].v[lane] = w[lane] * jacobian[m];
            }
          }
          const int count = a.lanesIn(b);
          Pack column[kMaxPoints * I * 3];  // moduli times the shape of node nb: [q][input][j]
          for (int nb = 0; nb < a.N; ++nb) {
            for (int q = 0; q < a.Q; ++q) {
              const double* s = a.shapeAt(b, q) + nb * C * L;
              for (int m = 0; m < I; ++m)
                for (int j = 0; j < 3; ++j) {
                  Pack sum(0.0);
                  for (int c = 0; c < C; ++c)
                    for (int lane = 0; lane < L; ++lane)
                      sum.v[lane] += moduli[(q * I + m) * I + j * C + c].v[lane] * s[c * L + lane];
                  column[(q * I + m) * 3 + j] = sum;
                }
            }
            for (int na = 0; na < a.N; ++na) {
              Pack block[9];
              for (int i = 0; i < 9; ++i) block[i] = Pack(0.0);
              for (int q = 0; q < a.Q; ++q) {
                const double* s = a.shapeAt(b, q) + na * C * L;
                for (int i = 0; i < 3; ++i)
                  for (int c = 0; c < C; ++c)
                    for (int j = 0; j < 3; ++j)
                      for (int lane = 0; lane < L; ++lane)
                        block[3 * i + j].v[lane] +=
                            s[c * L + lane] * column[(q * I + i * C + c) * 3 + j].v[lane];
              }
              for (int lane = 0; lane < count; ++lane) {
                const int node = a.nodesOf(b, lane)[na];
                const int position =
                    a.positions((static_cast<std::size_t>(b * L + lane) * a.N + na) * a.N + nb);
                for (int i = 0; i < 3; ++i)
                  for (int j = 0; j < 3; ++j)
                    sink.values(sink.rowStart(3 * node + i) + position + j) += block[3 * i + j].v[lane];
              }
            }
          }
        });
  }

  void beginSeries(const ConstField& u, int maxOrder) override {
    if (a_.history.size() == 0 || a_.maxOrder != maxOrder) {
      a_.maxOrder = maxOrder;
      a_.history = View<double*>();  // free before the new one is made
      a_.history =
          View<double*>(Kokkos::view_alloc("history", Kokkos::WithoutInitializing), historyDoubles(maxOrder));
    }
    const Arrays a = a_;
    forEachBatch(
        "beginSeries", KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[I], out[I];
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.interpolate(b, q, local, in);
            a.addOffset(b, q, in);
            taylor::Context<L> context{a.historyAt(b, q), a.maxOrder, 0, taylor::Pass::Start, 0};
            taylor::sweep(a.law, context, in, a.dataAt(b, q), out);
          }
        });
  }

  void addOrder(int k, const Field& f) override {
    const Arrays a = a_;
    forEachBatch(
        "addOrder", KOKKOS_LAMBDA(int b) {
          Pack force[3 * kMaxNodes], in[I], out[I];
          for (int n = 0; n < 3 * a.N; ++n) force[n] = Pack(0.0);
          for (int m = 0; m < I; ++m) in[m] = Pack(0.0);
          for (int q = 0; q < a.Q; ++q) {
            taylor::Context<L> context{a.historyAt(b, q), a.maxOrder, k, taylor::Pass::Sweep, 0};
            taylor::sweep(a.law, context, in, a.dataAt(b, q), out);
            a.accumulate(b, q, out, force);
          }
          a.scatter(b, force, f);
        });
  }

  void completeOrder(int k, const ConstField& Uk) override {
    const Arrays a = a_;
    forEachBatch(
        "completeOrder", KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[I], out[I];
          a.gather(b, Uk, local);
          for (int q = 0; q < a.Q; ++q) {
            a.interpolate(b, q, local, in);
            taylor::Context<L> context{a.historyAt(b, q), a.maxOrder, k, taylor::Pass::Complete, 0};
            taylor::sweep(a.law, context, in, a.dataAt(b, q), out);
          }
        });
  }

  PointValues observe(const ConstField& u) const override {
    PointValues result;
    result.names = Law::observedNames();
    constexpr int M = Law::numObserved;
    View<double*> values("observed", static_cast<std::size_t>(a_.numEntities) * a_.Q * M);
    const Arrays a = a_;
    forEachBatch(
        "observe", KOKKOS_LAMBDA(int b) {
          Pack local[3 * kMaxNodes], in[I];
          a.gather(b, u, local);
          for (int q = 0; q < a.Q; ++q) {
            a.interpolate(b, q, local, in);
            a.addOffset(b, q, in);
            for (int lane = 0; lane < a.lanesIn(b); ++lane) {
              double one[I], data[D + 1];
              a.lanesOf(in, I, lane, one);
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
  std::size_t historyDoubles(int maxOrder) const {
    return static_cast<std::size_t>(batches_.count) * a_.Q * taylor::historyDoubles<L>(a_.slots, maxOrder);
  }

  /// Colour by colour; within a colour in parallel.
  template <class Kernel>
  void forEachBatch(const char* name, const Kernel& kernel) const {
    const View<int*> order = a_.order;
    for (std::size_t c = 0; c + 1 < batches_.colourStart.size(); ++c)
      Kokkos::parallel_for(
          name, Kokkos::RangePolicy<Execution>(batches_.colourStart[c], batches_.colourStart[c + 1]),
          KOKKOS_LAMBDA(int i) { kernel(order(i)); });
    Execution().fence();
  }

  void fill(const PointSet& p, const std::vector<double>& data) {
    const int N = a_.N, Q = a_.Q;
    const std::size_t batches = batches_.count;
    a_.nodes = View<int*>("nodes", batches * L * N);
    a_.shape = View<double*>("shape", batches * Q * N * C * L);
    a_.weight = View<double*>("weight", batches * Q * L);
    a_.offset = View<double*>("offset", C == 1 ? batches * Q * I * L : 0);
    a_.data = View<double*>("data", batches * Q * D * L);
    a_.order = View<int*>("order", batches);
    auto nodes = Kokkos::create_mirror_view(a_.nodes);
    auto shape = Kokkos::create_mirror_view(a_.shape);
    auto weight = Kokkos::create_mirror_view(a_.weight);
    auto offset = Kokkos::create_mirror_view(a_.offset);
    auto datum = Kokkos::create_mirror_view(a_.data);
    auto order = Kokkos::create_mirror_view(a_.order);
    for (std::size_t b = 0; b < batches; ++b) {
      order(b) = batches_.order[b];
      for (int lane = 0; lane < L; ++lane) {
        // The last batch is filled up with copies of the last entity, of no weight and never scattered.
        const std::size_t e = std::min<std::size_t>(b * L + lane, p.numEntities - 1);
        const bool real = b * L + lane < static_cast<std::size_t>(p.numEntities);
        for (int n = 0; n < N; ++n) nodes((b * L + lane) * N + n) = p.nodes[e * N + n];
        for (int q = 0; q < Q; ++q) {
          const std::size_t source = e * Q + q, target = b * Q + q;
          weight(target * L + lane) = real ? p.weights[source] : 0.0;
          for (int m = 0; m < N * C; ++m)
            shape((target * N * C + m) * L + lane) = p.shape[source * N * C + m];
          if (C == 1)
            for (int i = 0; i < 3; ++i) offset((target * I + i) * L + lane) = p.positions[source * 3 + i];
          for (int d = 0; d < D; ++d) datum((target * D + d) * L + lane) = data[source * D + d];
        }
      }
    }
    Kokkos::deep_copy(a_.nodes, nodes);
    Kokkos::deep_copy(a_.shape, shape);
    Kokkos::deep_copy(a_.weight, weight);
    Kokkos::deep_copy(a_.offset, offset);
    Kokkos::deep_copy(a_.data, datum);
    Kokkos::deep_copy(a_.order, order);
  }

  std::vector<int> entityNodes_;
  Batches batches_;
  Arrays a_;
};

}  // namespace atrapos::fem
