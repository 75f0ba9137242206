#include "SwitchedTerm.hpp"

#include <fmt/format.h>

#include <limits>
#include <numeric>
#include <stdexcept>

namespace atrapos::fem {

SwitchedTerm::SwitchedTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                           const std::vector<double>& data)
    : LawTermOf<EventTerm>(std::move(law), points, data), count_(numPoints()) {
  if (a_.shape.events != 1 || a_.shape.data < 1)
    throw std::logic_error("lawTerm: a law has one event function a point, and a datum that says its state");
  std::vector<int> all(numEntities());
  std::iota(all.begin(), all.end(), 0);
  number(all);
  for (int e = 0, i = 0; e < numEntities(); ++e)
    for (int q = 0; q < a_.elements.numPoints(); ++q, ++i) active_[i] = a_.datum(e, q, 0) != 0;
}

void SwitchedTerm::number(const std::vector<int>& entities) {
  const int Q = a_.elements.numPoints();
  numbers_.clear();
  for (const int e : entities)
    for (int q = 0; q < Q; ++q) numbers_.push_back(e * Q + q);
  active_.resize(numbers_.size());
}

void SwitchedTerm::keep(const TermPart& part) {
  LawTermOf<EventTerm>::keep(part);
  std::vector<int> active;
  for (const int e : part.entities)
    for (int q = 0; q < a_.elements.numPoints(); ++q)
      active.push_back(active_[e * a_.elements.numPoints() + q]);
  number(part.entities);
  active_ = std::move(active);
}

std::string SwitchedTerm::eventText(int number) const {
  const int Q = a_.elements.numPoints();
  return fmt::format("cubature point {} of element {} of its block is", number % Q + 1, number / Q + 1);
}

/// A batch's event function as [own entity][point].
void SwitchedTerm::put(int batch, const double* out, std::vector<double>& values) const {
  const int Q = a_.elements.numPoints();
  for (int lane = 0; lane < a_.elements.lanesIn(batch); ++lane)
    for (int q = 0; q < Q; ++q)
      values[(static_cast<std::size_t>(batch) * kLanes + lane) * Q + q] =
          out[(q * O_ + eventOutput()) * kLanes + lane];
}

void SwitchedTerm::beginSeries(const ConstDofView& u, double lambda, int maxOrder) {
  start_.assign(active_.size(), 0.0);
  known_.assign(active_.size(), 0.0);
  derivatives_.assign(batches().count * a_.perBatch(a_.shape.inputs), 0.0);
  LawTermOf<EventTerm>::beginSeries(u, lambda, maxOrder);
}

void SwitchedTerm::started(int batch, const Scratch& s, double* memory) {
  const int Q = a_.elements.numPoints(), J = a_.shape.inputs;
  put(batch, s.out, start_);
  a_.law->tangent(a_.batch(batch, seriesData(), memory), s.in, s.out, s.jacobian);
  for (int q = 0; q < Q; ++q)
    std::copy_n(s.jacobian + (q * O_ + eventOutput()) * J * kLanes, J * kLanes,
                derivatives_.data() + batch * a_.perBatch(J) + q * J * kLanes);
}

void SwitchedTerm::ordered(int batch, const Scratch& s) { put(batch, s.out, known_); }

std::vector<double> SwitchedTerm::eventOrder(int k, const ConstDofView& Uk, double lambdaK) const {
  std::vector<double> all = k == 0 ? start_ : known_;
  if (k == 0) {
    for (std::size_t i = 0; i < all.size(); ++i)
      if (grows(active_[i] != 0)) all[i] = 0;
    return all;
  }
  const int Q = a_.elements.numPoints(), J = a_.shape.inputs;
  forEachBatch("eventOrder", batches(), [&](int b) {
    const ThreadMemory::Held held(a_.memory());
    const Scratch s(*this, held);
    inputs(b, Uk, lambdaK, false, s.in);
    const double* by = derivatives_.data() + b * a_.perBatch(J);
    for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
      for (int q = 0; q < Q; ++q) {
        double& sum = all[(static_cast<std::size_t>(b) * kLanes + lane) * Q + q];
        for (int j = 0; j < J; ++j)
          sum += by[(q * J + j) * kLanes + lane] * s.in[(q * J + j) * kLanes + lane];
      }
  });
  return all;
}

/// The event functions of all own points at a state.
std::vector<double> SwitchedTerm::functionsAt(const ConstDofView& u, double lambda) const {
  std::vector<double> values(active_.size(), 0.0), room;
  const double* data = dataAt(u, lambda, room);
  forEachBatch("functionsAt", batches(), [&](int b) {
    const ThreadMemory::Held held(a_.memory());
    const Scratch s(*this, held);
    inputs(b, u, lambda, true, s.in);
    a_.law->value(a_.batch(b, data, held.data()), s.in, s.out);
    put(b, s.out, values);
  });
  return values;
}

EventTerm::MeanGaps SwitchedTerm::gapsAt(const ConstDofView& u, double lambda) const {
  const std::vector<double> covered(active_.size(), 1.0);
  if (grows(false)) return {covered, covered};  // no border to be at
  MeanGaps gaps{functionsAt(u, lambda), covered};
  for (std::size_t i = 0; i < active_.size(); ++i)
    if (active_[i] != 0) gaps.sum[i] = 0;
  return gaps;
}

/// Active points of such a law, whose function is the share that would change, as next to nothing does.
std::vector<double> SwitchedTerm::indifferent(const ConstDofView& u, double lambda) const {
  std::vector<double> told = functionsAt(u, lambda);
  for (std::size_t i = 0; i < told.size(); ++i) told[i] = active_[i] != 0 && -told[i] < negligibleFall();
  return told;
}

std::vector<double> SwitchedTerm::moved(const ConstDofView&, double) const {
  return std::vector<double>(active_.size(), 0.0);
}

void SwitchedTerm::setConditions(const std::vector<int>& conditions) {
  if (conditions.size() != active_.size())
    throw std::logic_error("SwitchedTerm: not the conditions of this part");
  active_ = conditions;
  const int Q = a_.elements.numPoints();
  for (int e = 0; e < numEntities(); ++e)
    for (int q = 0; q < Q; ++q) a_.setDatum(e, q, 0, active_[e * Q + q]);
}

std::vector<double> SwitchedTerm::leastStiffness(const std::vector<double>&) const {
  return std::vector<double>(active_.size(), std::numeric_limits<double>::infinity());
}

}  // namespace atrapos::fem
