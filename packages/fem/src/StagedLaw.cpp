#include "atrapos/fem/StagedLaw.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace atrapos::fem {
namespace {

class StagedLaw final : public PointLaw {
 public:
  explicit StagedLaw(StagedPlan plan) : plan_(std::move(plan)), numWires_(plan_.inputs) {
    const auto within = [](const std::vector<int>& numbers, int first, int end) {
      return std::all_of(numbers.begin(), numbers.end(), [=](int n) { return n >= first && n < end; });
    };
    for (const LawStage& stage : plan_.stages) {
      const LawShape s = stage.law->shape();
      if (static_cast<int>(stage.inputs.size()) != s.inputs ||
          static_cast<int>(stage.data.size()) != s.data || !within(stage.inputs, 0, numWires_) ||
          !within(stage.data, -1, plan_.data))
        throw std::logic_error("stagedLaw: a stage reads what is not there");
      if (s.variables > 0) setRemembering(stage, s);
      sizes_ = sizes_ || s.sizes;
      numWires_ += s.outputs;
      widest_ = std::max({widest_, s.inputs, s.outputs, s.data});
      largest_ = std::max(largest_, s.inputs * s.outputs);
    }
    if (!within(plan_.outputs, 0, numWires_))
      throw std::logic_error("stagedLaw: an output that is not there");
  }

  LawShape shape() const override {
    LawShape shape{plan_.inputs, static_cast<int>(plan_.outputs.size()), plan_.data, plan_.symmetric,
                   static_cast<int>(plan_.show ? plan_.names.size() : plan_.observed.size())};
    if (remembering_ >= 0) {
      const LawShape own = plan_.stages[remembering_].law->shape();
      shape.variables = own.variables;
      shape.events = own.events;
      shape.freeGrow = own.freeGrow;
    }
    shape.sizes = sizes_;
    return shape;
  }
  // The memory of one stage stands behind that of another, for series and for scratch.
  std::size_t seriesDoubles(const SeriesOrder& order) const override {
    std::size_t sum = 0;
    for (const LawStage& stage : plan_.stages) sum += stage.law->seriesDoubles(order);
    return sum;
  }

  void value(const PointBatch& points, const double* in, double* out) const override {
    const Room room(*this, points.numPoints);
    evaluate(points, in, room, [&](const PointLaw& law, const PointBatch& own, int, int) {
      law.value(own, room.in, room.out);
    });
    room.pick(plan_.outputs, room.wires, out);
  }

  void tangent(const PointBatch& points, const double* in, double* out, double* jacobian) const override {
    const int Q = points.numPoints, J = plan_.inputs, O = static_cast<int>(plan_.outputs.size());
    const Room room(*this, Q, true);
    // Derivatives of the wires by the inputs, [point][wire][input][lane].
    const auto row = [&](int q, int wire) { return room.derivatives + (q * numWires_ + wire) * J * kLanes; };
    std::fill_n(room.derivatives, static_cast<std::size_t>(Q) * numWires_ * J * kLanes, 0.0);
    for (int q = 0; q < Q; ++q)
      for (int j = 0; j < J; ++j) std::fill_n(row(q, j) + j * kLanes, kLanes, 1.0);
    evaluate(points, in, room, [&](const PointLaw& law, const PointBatch& own, int s, int firstWire) {
      law.tangent(own, room.in, room.out, room.jacobian);
      const LawStage& stage = plan_.stages[s];
      const int I = static_cast<int>(stage.inputs.size()), outputs = law.shape().outputs;
      for (int q = 0; q < Q; ++q)
        for (int o = 0; o < outputs; ++o)
          for (int i = 0; i < I; ++i) {
            const double* by = room.jacobian + ((q * outputs + o) * I + i) * kLanes;
            double* to = row(q, firstWire + o);
            if (const int wire = stage.inputs[i]; wire < J)  // an input of the whole law
              add(by, to + wire * kLanes);
            else
              addProducts(by, J, row(q, wire), to);
          }
    });
    room.pick(plan_.outputs, room.wires, out);
    for (int q = 0; q < Q; ++q)
      for (int o = 0; o < O; ++o)
        std::copy_n(row(q, plan_.outputs[o]), J * kLanes, jacobian + (q * O + o) * J * kLanes);
  }

  // By what depends on the input alone: one call for each input of a stage that does.
  void derivative(const PointBatch& points, int input, const double* in, double* out,
                  double* derivative) const override {
    const int Q = points.numPoints;
    const Room room(*this, Q, true);
    double* const wires = room.derivatives;  // [wire][point][lane]
    const auto of = [&](int wire) { return wires + wire * Q * kLanes; };
    std::fill_n(wires, numWires_ * Q * kLanes, 0.0);
    std::fill_n(of(input), Q * kLanes, 1.0);
    std::vector<char> depends(numWires_, 0);
    depends[input] = 1;
    evaluate(points, in, room, [&](const PointLaw& law, const PointBatch& own, int s, int firstWire) {
      const LawStage& stage = plan_.stages[s];
      const int outputs = law.shape().outputs;
      bool any = false;
      for (std::size_t i = 0; i < stage.inputs.size(); ++i) {
        if (depends[stage.inputs[i]] == 0) continue;
        law.derivative(own, static_cast<int>(i), room.in, room.out, room.jacobian);
        any = true;
        for (int q = 0; q < Q; ++q)
          for (int o = 0; o < outputs; ++o)
            addProducts(room.jacobian + (q * outputs + o) * kLanes, 1, of(stage.inputs[i]) + q * kLanes,
                        of(firstWire + o) + q * kLanes);
      }
      if (any)
        std::fill_n(depends.begin() + firstWire, outputs, char{1});
      else
        law.value(own, room.in, room.out);
    });
    room.pick(plan_.outputs, room.wires, out);
    for (int q = 0; q < Q; ++q)
      for (const int wire : plan_.outputs)
        derivative = std::copy_n(of(wire) + q * kLanes, kLanes, derivative);
  }

  void start(const PointBatch& points, const SeriesOrder& order, const double* in, double* out,
             PointFailure& failure) const override {
    const Room room(*this, points.numPoints);
    double* memory = points.memory;
    evaluate(points, in, room, [&](const PointLaw& law, PointBatch own, int, int) {
      own.memory = memory;
      memory += points.numPoints * law.seriesDoubles(order);
      law.start(own, order, room.in, room.out, failure);
    });
    room.pick(plan_.outputs, room.wires, out);
  }

  // Stage by stage, of each order k - 1 before order k: what they read of either was worked out by then.
  void advance(const PointBatch& points, const SeriesOrder& order, In in, Out out) const override {
    const Room room(*this, points.numPoints);
    const bool completes = order.k > 1;
    if (completes) room.put(plan_.inputs, in.last, 0, room.lastWires);
    if (in.current != nullptr)
      room.put(plan_.inputs, in.current, 0, room.wires);
    else
      room.clear(plan_.inputs, room.wires);
    double* memory = points.memory;
    int wire = plan_.inputs;
    for (const LawStage& stage : plan_.stages) {
      const int outputs = stage.law->shape().outputs;
      PointBatch own = batchOf(stage, points, room);
      own.memory = memory;
      memory += points.numPoints * stage.law->seriesDoubles(order);
      if (completes) room.pick(stage.inputs, room.lastWires, room.lastIn);
      room.pick(stage.inputs, room.wires, room.in);
      double* const current = out.current != nullptr ? room.out : nullptr;
      stage.law->advance(own, order, {room.lastIn, room.in}, {room.lastOut, current});
      if (completes) room.put(outputs, room.lastOut, wire, room.lastWires);
      room.put(outputs, room.out, wire, room.wires);
      wire += outputs;
    }
    if (out.last != nullptr && completes) room.pick(plan_.outputs, room.lastWires, out.last);
    if (out.current != nullptr) room.pick(plan_.outputs, room.wires, out.current);
  }

  // Along the straight line between what the stage that remembers reads at the two ends.
  void carry(const PointBatch& points, const double* from, const double* to, double* variables,
             PointFailure& failure) const override {
    if (remembering_ < 0) return PointLaw::carry(points, from, to, variables, failure);
    const LawStage& stage = plan_.stages[remembering_];
    const Room room(*this, points.numPoints);
    const auto inputsAt = [&](const double* in, double* ofStage) {
      evaluate(points, in, room, remembering_, [&](const PointLaw& law, const PointBatch& own, int, int) {
        law.value(own, room.in, room.out);
      });
      room.pick(stage.inputs, room.wires, ofStage);
    };
    inputsAt(from, room.lastIn);
    inputsAt(to, room.lastOut);
    stage.law->carry(batchOf(stage, points, room), room.lastIn, room.lastOut, variables, failure);
  }

  // What stages behind one with sizes make of these.
  void sizes(const PointBatch& points, const double* in, double* out) const override {
    if (!sizes_) return PointLaw::sizes(points, in, out);
    const Room room(*this, points.numPoints);
    evaluate(points, in, room, [&](const PointLaw& law, const PointBatch& own, int, int) {
      if (law.shape().sizes)
        law.sizes(own, room.in, room.out);
      else
        law.value(own, room.in, room.out);
    });
    room.pick(plan_.outputs, room.wires, out);
  }

  std::vector<std::string> observedNames() const override {
    if (plan_.show) return plan_.names;
    std::vector<std::string> names;
    for (const auto& shown : plan_.observed) names.push_back(shown.name);
    return names;
  }

  void observe(const PointBatch& points, const double* in, double* values) const override {
    const Room room(*this, points.numPoints);
    evaluate(points, in, room, [&](const PointLaw& law, const PointBatch& own, int, int) {
      law.value(own, room.in, room.out);
    });
    if (plan_.show) return show(points, room, values);
    for (int q = 0; q < points.numPoints; ++q)
      for (const StagedPlan::Shown& shown : plan_.observed) {
        const double* wire = room.wires + (q * numWires_ + shown.wire) * kLanes;
        for (int lane = 0; lane < points.lanes; ++lane) {
          const bool here =
              plan_.existence < 0 || points.data[(q * plan_.data + plan_.existence) * kLanes + lane] >= 0;
          values[lane] = here ? wire[lane] : shown.absent;
        }
        values += kLanes;
      }
  }

  bool exists(const double* data) const override { return plan_.existence < 0 || data[plan_.existence] >= 0; }

 private:
  static void add(const double* by, double* __restrict to) {
    for (int lane = 0; lane < kLanes; ++lane) to[lane] += by[lane];
  }
  /// to[j][lane] += by[lane] from[j][lane], j < count.
  static void addProducts(const double* by, int count, const double* from, double* __restrict to) {
    double factor[kLanes];
    std::copy_n(by, kLanes, factor);
    for (int j = 0; j < count; ++j)
      for (int lane = 0; lane < kLanes; ++lane)
        to[j * kLanes + lane] += factor[lane] * from[j * kLanes + lane];
  }

  /// A thread's numbers of a batch: wires [point][wire][lane], and what one stage reads and writes.
  struct Room {
    Room(const StagedLaw& law, int numPoints, bool tangent = false)
        : Q(numPoints), W(law.numWires_), D(law.plan_.data) {
      static thread_local std::vector<double> memory;
      const std::size_t each = static_cast<std::size_t>(Q) * kLanes, wire = each * W,
                        stage = each * law.widest_;
      const std::size_t matrices = tangent ? each * (law.largest_ + W * law.plan_.inputs) : 0;
      if (memory.size() < 2 * wire + 5 * stage + matrices) memory.resize(2 * wire + 5 * stage + matrices);
      double* at = memory.data();
      const auto take = [&](std::size_t size) { return std::exchange(at, at + size); };
      wires = take(wire);
      lastWires = take(wire);
      for (double** part : {&in, &out, &lastIn, &lastOut, &data}) *part = take(stage);
      jacobian = at;
      derivatives = at + each * law.largest_;
    }

    /// to[point][m] = wire number m of these.
    void pick(const std::vector<int>& numbers, const double* from, double* to) const {
      for (int q = 0; q < Q; ++q)
        for (const int n : numbers) to = std::copy_n(from + (q * W + n) * kLanes, kLanes, to);
    }
    /// The wires from `first` on become from[point][m], m < count.
    void put(int count, const double* from, int first, double* to) const {
      for (int q = 0; q < Q; ++q)
        std::copy_n(from + q * count * kLanes, count * kLanes, to + (q * W + first) * kLanes);
    }
    void clear(int count, double* to) const {
      for (int q = 0; q < Q; ++q) std::fill_n(to + q * W * kLanes, count * kLanes, 0.0);
    }

    int Q, W, D;
    double *wires, *lastWires, *in, *out, *lastIn, *lastOut, *data, *jacobian, *derivatives;
  };

  /// The points with the stage's own data.
  static PointBatch batchOf(const LawStage& stage, const PointBatch& points, const Room& room) {
    PointBatch own = points;
    own.data = room.data;
    double* to = room.data;
    for (int q = 0; q < points.numPoints; ++q)
      for (const int d : stage.data)
        if (d < 0)
          to = std::fill_n(to, kLanes, 0.0);
        else
          to = std::copy_n(points.data + (q * room.D + d) * kLanes, kLanes, to);
    return own;
  }

  /// All wires at the inputs, stage by stage; call(law, points, stage, first wire of its outputs) turns
  /// room.in into room.out.
  template <class Call>
  void evaluate(const PointBatch& points, const double* in, const Room& room, const Call& call) const {
    evaluate(points, in, room, static_cast<int>(plan_.stages.size()), call);
  }
  /// Of the first stages alone.
  template <class Call>
  void evaluate(const PointBatch& points, const double* in, const Room& room, int count,
                const Call& call) const {
    room.put(plan_.inputs, in, 0, room.wires);
    int wire = plan_.inputs;
    for (int s = 0; s < count; ++s) {
      const LawStage& stage = plan_.stages[s];
      const int outputs = stage.law->shape().outputs;
      room.pick(stage.inputs, room.wires, room.in);
      call(*stage.law, batchOf(stage, points, room), s, wire);
      room.put(outputs, room.out, wire, room.wires);
      wire += outputs;
    }
  }

  /// One stage may have variables: as the whole law has them.
  void setRemembering(const LawStage& stage, const LawShape& own) {
    const int D = plan_.data, V = own.variables, O = static_cast<int>(plan_.outputs.size());
    bool fits = remembering_ < 0 && O >= V + own.events && (own.events == 0 || stage.data[0] == 0);
    for (int v = 0; v < V; ++v) fits = fits && stage.data[own.data - V + v] == D - V + v;
    for (int o = 1; fits && o <= V + own.events; ++o)
      fits = plan_.outputs[O - o] == numWires_ + own.outputs - o;
    if (!fits) throw std::logic_error("stagedLaw: the variables of a stage are not the whole law's");
    remembering_ = static_cast<int>(&stage - plan_.stages.data());
  }

  void show(const PointBatch& points, const Room& room, double* values) const {
    const std::size_t V = plan_.names.size();
    std::vector<double> wires(numWires_), data(plan_.data), shown(V);
    for (int q = 0; q < points.numPoints; ++q)
      for (int lane = 0; lane < points.lanes; ++lane) {
        for (int w = 0; w < numWires_; ++w) wires[w] = room.wires[(q * numWires_ + w) * kLanes + lane];
        for (int d = 0; d < plan_.data; ++d) data[d] = points.data[(q * plan_.data + d) * kLanes + lane];
        plan_.show(wires.data(), data.data(), shown.data());
        for (std::size_t v = 0; v < V; ++v) values[(q * V + v) * kLanes + lane] = shown[v];
      }
  }

  StagedPlan plan_;
  int numWires_, widest_ = 1, largest_ = 1;
  int remembering_ = -1;  ///< the stage with internal variables
  bool sizes_ = false;    ///< a stage has sizes of its own
};

}  // namespace

std::unique_ptr<PointLaw> stagedLaw(StagedPlan plan) { return std::make_unique<StagedLaw>(std::move(plan)); }

}  // namespace atrapos::fem
