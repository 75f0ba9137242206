#pragma once

#include <algorithm>
#include <memory>
#include <vector>

#include "JetProblem.hpp"

/// Masses u_0 .. u_{m-1} with hard stops: mass i may not pass stop_i. One multiplier R_i >= 0 a stop is an
/// unknown at all times: the map and the graph never change; its row reads R_i = 0 while the stop is free and
/// u_i - stop_i = 0 while it is touched. Body supplies forces(u, lambda) = 0 without the stops.
///
/// Event functions: the gap of a free stop, the force of a touched one.
template <class Body>
struct WithStops : Body {
  std::vector<double> stops;
  std::vector<bool> touched = std::vector<bool>(stops.size(), false);

  WithStops(Body body, std::vector<double> where) : Body(body), stops(std::move(where)) {}

  int masses() const { return static_cast<int>(stops.size()); }
  int size() const { return 2 * masses(); }
  template <class S>
  std::vector<S> residual(const std::vector<S>& x, const S& lambda) const {
    const int m = masses();
    std::vector<S> r = Body::forces(std::vector<S>(x.begin(), x.begin() + m), lambda);
    for (int i = 0; i < m; ++i) {
      r[i] = r[i] + x[m + i];
      r.push_back(touched[i] ? x[i] - stops[i] : x[m + i]);
    }
    // Symmetric: a free stop's multiplier is zero and acts on nothing.
    for (int i = 0; i < m; ++i)
      if (!touched[i]) r[i] = r[i] - x[m + i];
    return r;
  }
  template <class S>
  std::vector<S> events(const std::vector<S>& x) const {
    std::vector<S> g;
    for (int i = 0; i < masses(); ++i) g.push_back(touched[i] ? x[masses() + i] : stops[i] - x[i]);
    return g;
  }
};

template <class Body>
class UnilateralProblem : public JetProblem<WithStops<Body>> {
 public:
  using Base = JetProblem<WithStops<Body>>;
  using Vector = typename Base::Vector;
  using State = typename Base::State;
  using Base::Base;

  int eventCount() const override { return this->law_.masses(); }
  void eventOrder(int k, std::vector<double>& g) const override {
    Jet::terms = k + 1;
    const auto e = this->law_.events(this->seriesJets());
    for (std::size_t i = 0; i < e.size(); ++i) g[i] = e[i][k];
  }
  std::vector<int> eventsAt(const State& state) override {
    remember(state);
    Jet::terms = 1;
    const auto g = this->law_.events(this->jets(*state.u));
    std::vector<int> zero;
    for (std::size_t i = 0; i < g.size(); ++i)
      if (!this->law_.touched[i] && g[i][0] < 1e-12) zero.push_back(static_cast<int>(i));
    return zero;
  }
  State afterEvent(const std::vector<int>& indices, const State& state) override {
    auto memory = std::make_shared<atrapos::path::Memory>();
    memory->conditions = touchedAt(state);
    for (const int i : indices) memory->conditions[i] = 1 - memory->conditions[i];
    return {state.u, state.lambda, memory};
  }
  /// [mass] 1 where its stop is touched at the state.
  std::vector<int> touchedAt(const State& state) const {
    return state.memory ? state.memory->conditions : start_;
  }
  Teuchos::RCP<const typename Base::CrsMatrix> tangent(const State& state, Vector& F) override {
    auto K = Base::tangent(state, F);
    pivots_ = static_cast<int>(std::count(this->law_.touched.begin(), this->law_.touched.end(), true));
    return K;
  }
  int constraintPivots() const override { return pivots_; }

 protected:
  void remember(const State& state) override {
    const auto touched = touchedAt(state);
    this->law_.touched.assign(touched.begin(), touched.end());
  }

 private:
  int pivots_ = 0;  ///< of the last tangent
  std::vector<int> start_{this->law_.touched.begin(), this->law_.touched.end()};
};
