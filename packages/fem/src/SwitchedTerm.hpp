#pragma once

#include <memory>
#include <string>
#include <vector>

#include "LawTermOf.hpp"
#include "atrapos/fem/EventTerm.hpp"

namespace atrapos::fem {

/// A law each of whose points is free or active (LawShape::events): a condition a point, [entity][point]. Its
/// first datum, 0 or 1, says which.
class SwitchedTerm final : public LawTermOf<EventTerm> {
 public:
  SwitchedTerm(std::unique_ptr<PointLaw> law, const PointSet& points, const std::vector<double>& data);

  void keep(const TermPart& part) override;
  void beginSeries(const ConstDofView& u, double lambda, int maxOrder) override;

  int eventCount() const override { return count_; }
  const std::vector<int>& eventNumbers() const override { return numbers_; }
  std::string eventText(int number) const override;
  bool grows(bool active) const override { return active || a_.shape.freeGrow; }
  // Where free points grow, too, their law is smooth by a width that is an error of 1e-2 or more.
  double negligibleFall() const override { return a_.shape.freeGrow ? 1e-5 : 1e-10; }
  std::vector<double> indifferent(const ConstDofView& u, double lambda) const override;
  std::vector<double> eventOrder(int k, const ConstDofView& Uk, double lambdaK) const override;
  std::vector<double> covered() const override { return std::vector<double>(active_.size(), 1.0); }
  MeanGaps gapsAt(const ConstDofView& u, double lambda) const override;
  // Yield functions are of size 1.
  double touching(const ConstDofView&) const override { return 1e-9; }
  std::string violation() const override {
    return "beyond the border of its law where the path starts; the state at the start must be within";
  }
  std::vector<double> moved(const ConstDofView&, double) const override;
  void setConditions(const std::vector<int>& conditions) override;
  bool owesPivots() const override { return false; }
  std::vector<double> leastStiffness(const std::vector<double>&) const override;
  void setStiffness(const std::vector<double>&, double) override {}

 private:
  void started(int batch, const Scratch& s, double* memory) override;
  void ordered(int batch, const Scratch& s) override;
  int eventOutput() const { return O_ - a_.shape.variables - 1; }
  void number(const std::vector<int>& entities);
  void put(int batch, const double* out, std::vector<double>& values) const;
  std::vector<double> functionsAt(const ConstDofView& u, double lambda) const;

  int count_ = 0;
  std::vector<int> numbers_;  ///< [own entity][point]
  std::vector<int> active_;   ///< [own entity][point]
  // Of the series under way: the event function's order without the unknowns of that order, [own
  // entity][point], and its derivatives by the inputs, [batch][point][input][lane].
  std::vector<double> start_, known_;
  std::vector<double> derivatives_;
};

}  // namespace atrapos::fem
