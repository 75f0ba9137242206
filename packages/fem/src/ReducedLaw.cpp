#include "atrapos/fem/ReducedLaw.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <utility>

namespace atrapos::fem {
namespace {

class ReducedLaw final : public PointLaw {
 public:
  ReducedLaw(std::unique_ptr<PointLaw> law, Reduction reduction)
      : law_(std::move(law)), r_(std::move(reduction)), full_(law_->shape()), own_(full_) {
    const auto within = [](const std::vector<int>& list, int end) {
      return std::all_of(list.begin(), list.end(), [=](int n) { return n >= -1 && n < end; });
    };
    if (static_cast<int>(r_.inputs.size()) != full_.inputs || !within(r_.inputs, r_.numInputs) ||
        !within(r_.outputs, full_.outputs) || r_.condensed >= std::min(full_.inputs, full_.outputs) ||
        (r_.condensed >= 0 && r_.inputs[r_.condensed] >= 0))
      throw std::logic_error("reducedLaw: the reduction does not fit the law");
    if (full_.variables > 0 && r_.condensed >= 0)
      throw std::logic_error("reducedLaw: a law with internal variables and a condensed input");
    for (int o = full_.outputs - full_.variables - full_.events; o < full_.outputs; ++o)
      r_.outputs.push_back(o);
    own_.inputs = r_.numInputs;
    own_.outputs = static_cast<int>(r_.outputs.size());
    // The memory that a thread works in is one for all of them.
    if (dynamic_cast<const ReducedLaw*>(law_.get()) != nullptr)
      throw std::logic_error("reducedLaw: the law is a reduced one already");
  }

  LawShape shape() const override { return own_; }
  std::size_t seriesDoubles(const SeriesOrder& order) const override {
    return law_->seriesDoubles(order) + kept() * kLanes;
  }

  void value(const PointBatch& points, const double* in, double* out) const override {
    const Room room(*this, points.numPoints);
    solve(points, in, room);
    law_->value(points, room.in, room.out);
    pickOutputs(points.numPoints, room.out, out);
  }

  void tangent(const PointBatch& points, const double* in, double* out, double* jacobian) const override {
    const Room room(*this, points.numPoints);
    solve(points, in, room);
    law_->tangent(points, room.in, room.out, room.jacobian);
    pickOutputs(points.numPoints, room.out, out);
    for (int q = 0; q < points.numPoints; ++q)
      for (int o = 0; o < own_.outputs; ++o) {
        double* row = jacobian + (q * own_.outputs + o) * own_.inputs * kLanes;
        std::fill_n(row, own_.inputs * kLanes, 0.0);
        const int from = r_.outputs[o];
        if (from < 0) continue;
        for (int i = 0; i < full_.inputs; ++i) {
          if (r_.inputs[i] < 0) continue;
          const double* by = room.at(q, from, i);
          double* to = row + r_.inputs[i] * kLanes;
          for (int lane = 0; lane < kLanes; ++lane) to[lane] += by[lane];
          if (r_.condensed < 0) continue;
          const double *byH = room.at(q, from, r_.condensed), *ofH = room.at(q, r_.condensed, i),
                       *D = room.at(q, r_.condensed, r_.condensed);
          for (int lane = 0; lane < kLanes; ++lane) to[lane] -= byH[lane] * ofH[lane] / D[lane];
        }
      }
  }

  void derivative(const PointBatch& points, int input, const double* in, double* out,
                  double* derivative) const override {
    const std::size_t rows = static_cast<std::size_t>(points.numPoints) * own_.outputs, J = own_.inputs;
    std::vector<double> jacobian(rows * J * kLanes);
    tangent(points, in, out, jacobian.data());
    for (std::size_t m = 0; m < rows; ++m)
      std::copy_n(&jacobian[(m * J + input) * kLanes], kLanes, derivative + m * kLanes);
  }

  void start(const PointBatch& points, const SeriesOrder& order, const double* in, double* out,
             PointFailure& failure) const override {
    const Room room(*this, points.numPoints);
    PointBatch scratch = points;
    scratch.memory = room.memory;
    solve(scratch, in, room);
    if (r_.condensed >= 0) {
      law_->tangent(scratch, room.in, room.out, room.jacobian);
      double* to = points.memory + points.numPoints * law_->seriesDoubles(order);
      for (int q = 0; q < points.numPoints; ++q) {
        to = std::copy_n(room.at(q, r_.condensed, 0), full_.inputs * kLanes, to);
        for (int o = 0; o < full_.outputs; ++o) to = std::copy_n(room.at(q, o, r_.condensed), kLanes, to);
        to = std::fill_n(to, kLanes, 0.0);
      }
    }
    law_->start(points, order, room.in, room.out, failure);
    pickOutputs(points.numPoints, room.out, out);
  }

  void advance(const PointBatch& points, const SeriesOrder& order, In in, Out out) const override {
    if (in.current != nullptr) throw std::logic_error("reducedLaw: a reduced law is no stage");
    const Room room(*this, points.numPoints);
    double* kept = points.memory + points.numPoints * law_->seriesDoubles(order);
    if (order.k > 1) {
      putInputs(points.numPoints, in.last, room.in);
      if (r_.condensed >= 0)
        for (int q = 0; q < points.numPoints; ++q) {
          const Kept k(*this, kept, q);
          double* h = room.in + (q * full_.inputs + r_.condensed) * kLanes;
          double sum[kLanes];
          std::copy_n(k.known, kLanes, sum);
          for (int i = 0; i < full_.inputs; ++i) {
            if (r_.inputs[i] < 0) continue;
            const double* given = room.in + (q * full_.inputs + i) * kLanes;
            for (int lane = 0; lane < kLanes; ++lane) sum[lane] += k.ofH[i * kLanes + lane] * given[lane];
          }
          for (int lane = 0; lane < kLanes; ++lane) h[lane] = -sum[lane] / k.D[lane];
        }
    }
    if (full_.variables > 0) {
      // No input is condensed.
      law_->advance(points, order, {room.in, nullptr},
                    {room.jacobian, out.current != nullptr ? room.out : nullptr});
      if (out.last != nullptr) pickOutputs(points.numPoints, room.jacobian, out.last);
      if (out.current != nullptr) pickOutputs(points.numPoints, room.out, out.current);
      return;
    }
    law_->order(points, order, room.in, room.out);
    if (r_.condensed >= 0)
      for (int q = 0; q < points.numPoints; ++q) {
        const Kept k(*this, kept, q);
        double* rows = room.out + q * full_.outputs * kLanes;
        std::copy_n(rows + r_.condensed * kLanes, kLanes, k.known);
        for (int o = 0; o < full_.outputs; ++o)
          for (int lane = 0; lane < kLanes; ++lane)
            rows[o * kLanes + lane] -= k.byH[o * kLanes + lane] * (k.known[lane] / k.D[lane]);
      }
    pickOutputs(points.numPoints, room.out, out.current);
  }

  void carry(const PointBatch& points, const double* from, const double* to, double* variables,
             PointFailure& failure) const override {
    const Room room(*this, points.numPoints);
    putInputs(points.numPoints, from, room.in);
    putInputs(points.numPoints, to, room.jacobian);
    law_->carry(points, room.in, room.jacobian, variables, failure);
  }

  void sizes(const PointBatch& points, const double* in, double* out) const override {
    const Room room(*this, points.numPoints);
    solve(points, in, room);
    law_->sizes(points, room.in, room.out);
    pickOutputs(points.numPoints, room.out, out);
  }

  std::vector<std::string> observedNames() const override { return law_->observedNames(); }
  void observe(const PointBatch& points, const double* in, double* values) const override {
    const Room room(*this, points.numPoints);
    solve(points, in, room);
    law_->observe(points, room.in, values);
  }
  bool exists(const double* data) const override { return law_->exists(data); }

 private:
  /// Of a point with a condensed input, for a series: the output's derivatives by all inputs, the outputs'
  /// by the input, and the output of the order under way.
  std::size_t kept() const { return r_.condensed < 0 ? 0 : full_.inputs + full_.outputs + 1; }
  struct Kept {
    Kept(const ReducedLaw& law, double* memory, int q)
        : known(memory + (q * law.kept() + law.full_.inputs + law.full_.outputs) * kLanes),
          ofH(memory + q * law.kept() * kLanes),
          D(ofH + law.r_.condensed * kLanes),
          byH(ofH + law.full_.inputs * kLanes) {}
    double* known;
    const double *ofH, *D, *byH;
  };

  /// A thread's numbers of the whole law.
  struct Room {
    Room(const ReducedLaw& law, int numPoints) : inputs(law.full_.inputs), outputs(law.full_.outputs) {
      static thread_local std::vector<double> room;
      const std::size_t each = static_cast<std::size_t>(numPoints) * kLanes;
      // Scratch of the law stands first, as `memory` of a batch does: at a multiple of 16 bytes.
      const std::size_t scratch = (law.law_->historyDoubles(0) + 7) / 8 * 8;
      const std::size_t size = scratch + each * (inputs + outputs + inputs * outputs) + 8;
      if (room.size() < size) room.resize(size);
      memory = room.data() + (reinterpret_cast<std::uintptr_t>(room.data()) % 16 == 0 ? 0 : 1);
      in = memory + scratch;
      out = in + each * inputs;
      jacobian = out + each * outputs;
    }
    const double* at(int q, int output, int input) const {
      return jacobian + ((q * outputs + output) * inputs + input) * kLanes;
    }
    int inputs, outputs;
    double *memory, *in, *out, *jacobian;
  };

  void putInputs(int numPoints, const double* from, double* to) const {
    for (int q = 0; q < numPoints; ++q)
      for (const int i : r_.inputs)
        to = i < 0 ? std::fill_n(to, kLanes, 0.0)
                   : std::copy_n(from + (q * own_.inputs + i) * kLanes, kLanes, to);
  }
  void pickOutputs(int numPoints, const double* from, double* to) const {
    for (int q = 0; q < numPoints; ++q)
      for (const int o : r_.outputs)
        to = o < 0 ? std::fill_n(to, kLanes, 0.0)
                   : std::copy_n(from + (q * full_.outputs + o) * kLanes, kLanes, to);
  }

  /// The inputs of the law, with those that are condensed. Newton's method from h = 0, so that the result is
  /// a function of the inputs alone; a step that does not lower the output is halved. At the solution the
  /// output grows with h; where it falls (rubber that resists changes of volume, stretched so far that its
  /// stress falls with its volume) h + 1 is halved or grows by half.
  void solve(const PointBatch& points, const double* in, const Room& room) const {
    putInputs(points.numPoints, in, room.in);
    if (r_.condensed < 0) return;
    constexpr int mostSteps = 60;
    constexpr double epsilon = std::numeric_limits<double>::epsilon();
    const std::size_t size = static_cast<std::size_t>(points.numPoints) * kLanes;
    std::vector<double> step(size, 0.0), best(size, std::numeric_limits<double>::infinity());
    const auto h = [&](std::size_t i) -> double& {
      return room.in[(i / kLanes * full_.inputs + r_.condensed) * kLanes + i % kLanes];
    };
    for (int n = 0; n < mostSteps; ++n) {
      law_->tangent(points, room.in, room.out, room.jacobian);
      bool all = true;
      for (std::size_t i = 0; i < size; ++i) {
        const int q = static_cast<int>(i / kLanes), lane = static_cast<int>(i % kLanes);
        if (lane >= points.lanes) continue;
        const double s = room.out[(q * full_.outputs + r_.condensed) * kLanes + lane];
        if (n > 0 && !(std::abs(s) < best[i] && h(i) > -1)) {
          // No better: at rounding it is done, else the step was too long.
          if (std::abs(step[i]) <= 4 * epsilon * (1 + std::abs(h(i)))) {
            h(i) -= step[i];
            step[i] = 0;
            continue;
          }
          step[i] /= 2;
          h(i) -= step[i];
          all = false;
          continue;
        }
        const double slope = room.at(q, r_.condensed, r_.condensed)[lane];
        if (!(slope > 0)) {
          // Beyond the largest output: back to where it grows.
          best[i] = std::numeric_limits<double>::infinity();
          step[i] = (s > 0 ? -0.5 : 0.5) * (1 + h(i));
          h(i) += step[i];
          all = false;
          continue;
        }
        best[i] = std::abs(s);
        step[i] = -s / slope;
        h(i) += step[i];
        all = all && std::abs(step[i]) <= epsilon * (1 + std::abs(h(i)));
      }
      if (all) return;
    }
    for (std::size_t i = 0; i < size; ++i)
      if (std::abs(step[i]) > 1e-12 * (1 + std::abs(h(i)))) h(i) = std::numeric_limits<double>::quiet_NaN();
  }

  std::unique_ptr<PointLaw> law_;
  Reduction r_;
  LawShape full_, own_;
};

}  // namespace

std::unique_ptr<PointLaw> reducedLaw(std::unique_ptr<PointLaw> law, Reduction reduction) {
  return std::make_unique<ReducedLaw>(std::move(law), std::move(reduction));
}

}  // namespace atrapos::fem
