#pragma once

#include <algorithm>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "LawArrays.hpp"
#include "PointVariables.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointPieces.hpp"
#include "atrapos/fem/Rows.hpp"

namespace atrapos::fem {

/// A law at the points of entities, as a Term or a kind of Term.
template <class Base>
class LawTermOf : public Base {
 public:
  LawTermOf(std::unique_ptr<PointLaw> law, const PointSet& points, const std::vector<double>& data)
      : a_(std::move(law), points, data), I_(a_.elements.inputs()), O_(a_.shape.outputs), variables_(a_) {
    if ((a_.shape.inputs != I_ && a_.shape.inputs != I_ + 1) ||
        O_ - a_.shape.events - a_.shape.variables != I_)
      throw std::logic_error("lawTerm: a law with " + std::to_string(a_.shape.inputs) + " inputs and " +
                             std::to_string(a_.shape.outputs) + " outputs at points with " +
                             std::to_string(I_) + " (and perhaps the load factor)");
    const std::size_t J = a_.shape.inputs;
    if (a_.elements.numFields() > 1) moduliDoubles_ = a_.perBatch(I_ * I_);
    a_.allocateScratch(forceDoubles() + a_.perBatch(J + O_ + O_ * J) + moduliDoubles_);
  }

  void setUpdate(DataUpdate update, const std::vector<double>& data) {
    if (!update) return;
    if (!variables_.none())
      throw std::logic_error("lawTerm: a law with internal variables whose data are brought up to date");
    update_ = std::move(update);
    initialData_ = data;
  }
  void setSymmetricSum() { symmetricSum_ = true; }
  void setCapacity(Capacity capacity) { capacity_ = std::move(capacity); }
  void setPieces(PieceSearch search, const std::vector<double>& data) {
    pieces_ = std::make_unique<PointPieces>(std::move(search), numPoints(), data);
    setUpdate(
        [this](int, const double* in, double* renewed) {
          const std::size_t count = static_cast<std::size_t>(pieces_->numPoints()) * a_.shape.inputs;
          const auto found = pieces_->at({in, in + count});
          std::copy(found.begin(), found.end(), renewed);
        },
        data);
  }

  int numEntities() const override { return a_.elements.numEntities(); }
  int nodesPerEntity() const override { return a_.elements.nodesPerEntity(); }
  const std::vector<int>& nodes() const override { return a_.elements.nodes(); }
  bool symmetric() const override { return a_.shape.symmetric || symmetricSum_; }
  bool seesLoadFactor() const override { return a_.shape.inputs > I_; }
  std::size_t historyBytes(int maxOrder) const override { return a_.historyBytes(maxOrder); }

  void keep(const TermPart& part) override {
    const int Q = a_.elements.numPoints();
    a_.keep(part);
    if (!update_) return;
    initialData_ = rowsOf(initialData_, part.entities, static_cast<std::size_t>(Q) * a_.shape.data);
    if (pieces_) pieces_->keep(pointsOf(part.entities, Q));
  }

  void connect(const DofMap& dofs, const std::vector<int>& positions) override {
    a_.elements.connect(dofs, positions, nodesPerEntity());
  }

  std::vector<double> startVariables() const override { return variables_.values(a_.data()); }
  void remember(const double* variables, const ConstDofView& u, double lambda) override {
    variables_.remember(variables, [&](int b, double* in) { inputs(b, u, lambda, true, in); });
  }
  std::vector<double> variablesAt(const ConstDofView& u, double lambda) const override {
    std::vector<double> room;
    return variables_.values(dataAt(u, lambda, room));
  }
  std::vector<std::vector<double>> variableOrders(const ConstDofView& last, double lastLambda) override {
    if (variables_.none()) return {};
    const double* data = seriesData();
    const SeriesOrder order = variables_.afterLast();
    forEachBatch("variableOrders", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, last, lastLambda, false, s.in);
      a_.law->advance(a_.seriesBatch(b, data), order, {s.in, nullptr}, {s.out, nullptr});
      variables_.complete(b, order.k - 1, s.out);
    });
    return variables_.orders();
  }

  OwnForces addResidual(const ConstDofView& u, double lambda, const DofView& f) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    const int balances = a_.elements.numBalances();
    std::vector<double> squares(static_cast<std::size_t>(batches().count) * balances);
    forEachBatch("residual", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
      a_.elements.addForces(b, s.out, O_, true, zero(s.force));
      a_.elements.scatter(b, s.force, f.data());
      if (a_.shape.sizes) {
        a_.law->sizes(a_.batch(b, data, held.data()), s.in, s.out);
        a_.elements.addForces(b, s.out, O_, true, zero(s.force));
      }
      a_.elements.squares(b, s.force, &squares[static_cast<std::size_t>(b) * balances]);
    });
    return sumOf(squares, balances);
  }

  void addTangent(const ConstDofView& u, double lambda, const TangentSink& sink) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    forEachBatch("tangent", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      a_.law->tangent(a_.batch(b, data, held.data()), s.in, s.out, s.jacobian);
      if (seesLoadFactor()) {
        byLoadFactor(s.jacobian, s.out);
        a_.elements.addForces(b, s.out, O_, true, zero(s.force));
        a_.elements.scatter(b, s.force, sink.loadDirection.data());
      }
      a_.elements.addBlocks(b, s.jacobian, O_, a_.shape.inputs, a_.shape.symmetric, {}, sink, s.moduli);
    });
  }

  bool addCapacity(const ConstDofView& u, double lambda, const TangentSink& sink) const override {
    if (!capacity_) return false;
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    forEachBatch("capacity", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      std::fill_n(s.jacobian, a_.perBatch(static_cast<std::size_t>(O_) * a_.shape.inputs), 0.0);
      capacity_(a_.batch(b, data, held.data()), s.in, s.jacobian);
      a_.elements.addBlocks(b, s.jacobian, O_, a_.shape.inputs, false, {}, sink, s.moduli);
    });
    return true;
  }

  void beginSeries(const ConstDofView& u, double lambda, int maxOrder) override {
    a_.reserveHistory(maxOrder);
    if (update_) {
      const auto data = updatedData(u, lambda);
      if (pieces_) pieces_->beginSeries(data);
      seriesData_ = a_.packed(data);
    }
    if (!variables_.none()) {
      dataAt(u, lambda, seriesData_);
      variables_.beginSeries(seriesData_.data(), maxOrder);
    }
    const double* data = seriesData();
    std::vector<PointFailure> failures(batches().count);
    forEachBatch("beginSeries", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      a_.start(b, data, s.in, s.out, failures[b]);
      started(b, s, held.data());
    });
    a_.throwFirst(failures);
  }

  void addOrder(int k, const ConstDofView& last, double lastLambda, const DofView& f) override {
    const double* data = seriesData();
    const SeriesOrder order = seriesOrder(k, a_.maxOrder());
    forEachBatch("addOrder", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      if (k > 1) inputs(b, last, lastLambda, false, s.in);
      if (variables_.none()) {
        a_.law->order(a_.seriesBatch(b, data), order, s.in, s.out);
      } else {
        a_.law->advance(a_.seriesBatch(b, data), order, {s.in, nullptr}, {s.jacobian, s.out});
        if (k > 1) variables_.complete(b, k - 1, s.jacobian);
        variables_.begin(b, k, s.out);
      }
      ordered(b, s);
      a_.elements.addForces(b, s.out, O_, true, zero(s.force));
      a_.elements.scatter(b, s.force, f.data());
    });
    variables_.added(k);
  }

  PointPieces* pieces() override { return pieces_.get(); }

  std::vector<double> places(const ConstDofView& u, double lambda) const override {
    const std::size_t each = static_cast<std::size_t>(a_.elements.numPoints()) * a_.shape.inputs;
    std::vector<double> all(each * numEntities());
    forEachBatch("inputs", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
        for (std::size_t i = 0; i < each; ++i)
          all[(static_cast<std::size_t>(b) * kLanes + lane) * each + i] = s.in[i * kLanes + lane];
    });
    return all;
  }

  PointValues observe(const ConstDofView& u, double lambda) const override {
    std::vector<double> room;
    const double* data = dataAt(u, lambda, room);
    return a_.observe(data, [&](int b, const ThreadMemory::Held& held) {
      const Scratch s(*this, held);
      inputs(b, u, lambda, true, s.in);
      return s.in;
    });
  }

 protected:
  /// A batch's numbers in a thread's memory.
  struct Scratch {
    Scratch(const LawTermOf& t, const ThreadMemory::Held& held)
        : force(t.a_.scratchOf(held)),
          in(force + t.forceDoubles()),
          out(in + t.a_.perBatch(t.a_.shape.inputs)),
          jacobian(out + t.a_.perBatch(t.O_)),
          // With one field they take the place of the derivatives.
          moduli(t.moduliDoubles_ == 0 ? jacobian : jacobian + t.a_.perBatch(t.O_ * t.a_.shape.inputs)) {}
    double *force, *in, *out, *jacobian, *moduli;
  };
  /// A series has started in a batch: its inputs and outputs are those of order 0. `memory` begins with what
  /// the law needs as scratch.
  virtual void started(int /*batch*/, const Scratch&, double* /*memory*/) {}
  /// Outputs of an order whose unknowns are not known yet.
  virtual void ordered(int /*batch*/, const Scratch&) {}

  std::size_t forceDoubles() const { return static_cast<std::size_t>(a_.elements.localDofs()) * kLanes; }
  double* zero(double* force) const {
    std::fill_n(force, forceDoubles(), 0.0);
    return force;
  }

  /// in = (B u, lambda), with its constant part where it is asked for.
  void inputs(int b, const ConstDofView& u, double lambda, bool offset, double* in) const {
    const int J = a_.shape.inputs, Q = a_.elements.numPoints();
    a_.elements.gather(b, u.data(), J, in);
    if (offset) a_.elements.addOffset(b, J, in);
    if (J > I_)
      for (int q = 0; q < Q; ++q) std::fill_n(in + (q * J + I_) * kLanes, kLanes, lambda);
  }

  /// out = -d law/d lambda.
  void byLoadFactor(const double* jacobian, double* out) const {
    const int rows = a_.elements.numPoints() * O_, J = I_ + 1;
    for (int m = 0; m < rows; ++m)
      for (int lane = 0; lane < kLanes; ++lane)
        out[m * kLanes + lane] = -jacobian[(m * J + I_) * kLanes + lane];
  }

  /// The data, [point][datum], brought up to date at the state.
  std::vector<double> updatedData(const ConstDofView& u, double lambda) const {
    std::vector<double> data = initialData_;
    update_(numPoints(), places(u, lambda).data(), data.data());
    return data;
  }
  /// The packed data at the state; `room` holds them where they are brought up to date.
  const double* dataAt(const ConstDofView& u, double lambda, std::vector<double>& room) const {
    if (!variables_.none()) {
      variables_.carry([&](int b, double* in) { inputs(b, u, lambda, true, in); }, room);
      return room.data();
    }
    if (!update_) return a_.data();
    room = a_.packed(updatedData(u, lambda));
    return room.data();
  }

  const double* seriesData() const { return seriesData_.empty() ? a_.data() : seriesData_.data(); }

  int numPoints() const { return a_.elements.numEntities() * a_.elements.numPoints(); }
  const Batches& batches() const { return a_.elements.batches(); }

  LawArrays a_;
  int I_, O_;
  PointVariables variables_;
  std::size_t moduliDoubles_ = 0;
  bool symmetricSum_ = false;
  Capacity capacity_;  ///< empty: nothing is stored
  DataUpdate update_;
  std::unique_ptr<PointPieces> pieces_;  ///< null: not in pieces
  std::vector<double> initialData_;      ///< [point][datum]
  std::vector<double> seriesData_;       ///< of the series under way, packed
};

}  // namespace atrapos::fem
