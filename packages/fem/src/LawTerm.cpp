#include "atrapos/fem/LawTerm.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "LawArrays.hpp"
#include "atrapos/fem/Rows.hpp"

namespace atrapos::fem {
namespace {

class LawTerm final : public Term {
 public:
  LawTerm(std::unique_ptr<PointLaw> law, const PointSet& points, const std::vector<double>& data)
      : a_(std::move(law), points, data), I_(a_.elements.inputs()) {
    if ((a_.shape.inputs != I_ && a_.shape.inputs != I_ + 1) || a_.shape.outputs != I_)
      throw std::logic_error("lawTerm: a law with " + std::to_string(a_.shape.inputs) + " inputs and " +
                             std::to_string(a_.shape.outputs) + " outputs at points with " +
                             std::to_string(I_) + " (and perhaps the load factor)");
    const std::size_t J = a_.shape.inputs;
    a_.allocateScratch(3 * view().N * kLanes + a_.perBatch(J + I_ + I_ * J));
  }

  void setUpdate(DataUpdate update, const std::vector<double>& data) {
    if (!update) return;
    update_ = std::move(update);
    initialData_ = data;
  }
  void setPieces(PieceSearch search, const std::vector<double>& data) {
    pieces_ = std::make_unique<PointPieces>(std::move(search), view().numEntities * view().Q, data);
    setUpdate(
        [this](int, const double* in, double* renewed) {
          const std::size_t count = static_cast<std::size_t>(pieces_->numPoints()) * a_.shape.inputs;
          const auto found = pieces_->at({in, in + count});
          std::copy(found.begin(), found.end(), renewed);
        },
        data);
  }

  int numEntities() const override { return view().numEntities; }
  int nodesPerEntity() const override { return view().N; }
  const std::vector<int>& nodes() const override { return a_.elements.nodes(); }
  bool symmetric() const override { return a_.shape.symmetric; }
  bool seesLoadFactor() const override { return a_.shape.inputs > I_; }
  std::size_t historyBytes(int maxOrder) const override { return a_.historyBytes(maxOrder); }

  void keep(const TermPart& part) override {
    const int Q = view().Q;
    a_.keep(part);
    if (!update_) return;
    initialData_ = rowsOf(initialData_, part.entities, static_cast<std::size_t>(Q) * a_.shape.data);
    if (pieces_) pieces_->keep(pointsOf(part.entities, Q));
  }

  void setPositions(const std::vector<int>& positions) override { a_.elements.setPositions(positions); }

  double addResidual(const ConstField& u, double lambda, const Field& f) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    std::vector<double> squares(batches().count);
    forEachBatch("residual", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
      kernels().forces(view(), b, s.out, I_, true, zero(s.force));
      kernels().scatter(view(), b, s.force, f.data());
      squares[b] = a_.elements.squares(b, 3 * view().N, s.force);
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
      inputs(b, u, lambda, true, s.in);
      a_.law->tangent(a_.batch(b, data, held.data()), s.in, s.out, s.jacobian);
      if (seesLoadFactor()) {
        byLoadFactor(s.jacobian, s.out);
        kernels().forces(view(), b, s.out, I_, true, zero(s.force));
        kernels().scatter(view(), b, s.force, sink.loadDirection.data());
      }
      kernels().moduli(view(), b, s.jacobian, I_, a_.shape.inputs, s.jacobian);
      kernels().blocks(view(), b, s.jacobian, a_.shape.symmetric, {}, blocks);
    });
  }

  void beginSeries(const ConstField& u, double lambda, int maxOrder) override {
    a_.reserveHistory(maxOrder);
    if (update_) {
      const auto data = renewed(u, lambda);
      if (pieces_) pieces_->beginSeries(data);
      seriesData_ = a_.packed(data);
    }
    const double* data = seriesData();
    std::vector<PointFailure> failures(batches().count);
    forEachBatch("beginSeries", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      a_.start(b, data, s.in, s.out, failures[b]);
    });
    a_.throwFirst(failures);
  }

  void addOrder(int k, const ConstField& last, double lastLambda, const Field& f) override {
    const double* data = seriesData();
    const SeriesOrder order = seriesOrder(k, a_.maxOrder());
    forEachBatch("addOrder", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      if (k > 1) inputs(b, last, lastLambda, false, s.in);
      a_.law->order(a_.seriesBatch(b, data), order, s.in, s.out);
      kernels().forces(view(), b, s.out, I_, true, zero(s.force));
      kernels().scatter(view(), b, s.force, f.data());
    });
  }

  PointPieces* pieces() override { return pieces_.get(); }

  std::vector<double> places(const ConstField& u, double lambda) const override {
    const ElementView& e = view();
    const int J = a_.shape.inputs;
    std::vector<double> all(static_cast<std::size_t>(e.numEntities) * e.Q * J);
    forEachBatch("inputs", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      for (int lane = 0; lane < e.lanesIn(b); ++lane)
        for (int i = 0; i < e.Q * J; ++i)
          all[(static_cast<std::size_t>(b) * kLanes + lane) * e.Q * J + i] = s.in[i * kLanes + lane];
    });
    return all;
  }

  PointValues observe(const ConstField& u, double lambda) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    return a_.observe(data, [&](int b, const ThreadMemory::Held& held) {
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      return s.in;
    });
  }

 private:
  /// A batch's numbers in a thread's memory.
  struct Scratch {
    Scratch(const LawTerm& t, const ThreadMemory::Held& held)
        : force(t.a_.scratchOf(held)),
          in(force + 3 * t.view().N * kLanes),
          out(in + t.a_.perBatch(t.a_.shape.inputs)),
          jacobian(out + t.a_.perBatch(t.I_)) {}
    double *force, *in, *out, *jacobian;
  };
  double* zero(double* force) const {
    std::fill_n(force, 3 * view().N * kLanes, 0.0);
    return force;
  }

  /// in = (B u, lambda), with its constant part where it is asked for.
  void inputs(int b, const ConstField& u, double lambda, bool offset, double* in) const {
    const int J = a_.shape.inputs, Q = view().Q;
    kernels().inputs(view(), b, u.data(), J, in);
    if (offset) a_.elements.addOffset(b, J, in);
    if (J > I_)
      for (int q = 0; q < Q; ++q) std::fill_n(in + (q * J + I_) * kLanes, kLanes, lambda);
  }

  /// out = -d law/d lambda.
  void byLoadFactor(const double* jacobian, double* out) const {
    const int rows = view().Q * I_, J = I_ + 1;
    for (int m = 0; m < rows; ++m)
      for (int lane = 0; lane < kLanes; ++lane)
        out[m * kLanes + lane] = -jacobian[(m * J + I_) * kLanes + lane];
  }

  /// The data, [point][datum], brought up to date at the state.
  std::vector<double> renewed(const ConstField& u, double lambda) const {
    std::vector<double> data = initialData_;
    update_(view().numEntities * view().Q, places(u, lambda).data(), data.data());
    return data;
  }
  /// The packed data at the state; `room` holds them where they are brought up to date.
  const double* dataAt(const ConstField& u, double lambda, std::vector<double>& room) const {
    if (!update_) return a_.data();
    room = a_.packed(renewed(u, lambda));
    return room.data();
  }

  const double* seriesData() const { return update_ ? seriesData_.data() : a_.data(); }

  const ElementView& view() const { return a_.elements.view(); }
  const ElementKernels& kernels() const { return a_.elements.kernels(); }
  const Batches& batches() const { return a_.elements.batches(); }

  LawArrays a_;
  int I_;
  DataUpdate update_;
  std::unique_ptr<PointPieces> pieces_;  ///< null: not in pieces
  std::vector<double> initialData_;      ///< [point][datum]
  std::vector<double> seriesData_;       ///< of the series under way, packed
};

}  // namespace

std::unique_ptr<Term> lawTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                              const std::vector<double>& data, DataUpdate update) {
  auto term = std::make_unique<LawTerm>(std::move(law), points, data);
  term->setUpdate(std::move(update), data);
  return term;
}

std::unique_ptr<Term> lawTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                              const std::vector<double>& data, PieceSearch search) {
  auto term = std::make_unique<LawTerm>(std::move(law), points, data);
  term->setPieces(std::move(search), data);
  return term;
}

}  // namespace atrapos::fem
