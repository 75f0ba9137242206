#pragma once

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include <Teuchos_DefaultMpiComm.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>

#include "Jet.hpp"
#include "atrapos/path/Problem.hpp"

/// A Problem made from a law with
///
///     int size() const;
///     template <class S> std::vector<S> residual(const std::vector<S>& u, const S& lambda) const;
///     template <class S> std::vector<S> internal(const std::vector<S>& u, const S& lambda) const;  // may be
///     empty
///
/// Everything else (tangent, F, orders) is read off Jets. One rank, dense graph. A law whose tangent is not
/// symmetric has `bool symmetric() const`, false; one with Lagrange multipliers among its unknowns says how
/// many
/// (`int multipliers() const`): each owes a negative pivot. One whose unknowns have rates of different
/// weights says which (`std::vector<double> rateWeights() const`).
template <class Law>
class JetProblem : public atrapos::path::Problem {
 public:
  using Map = atrapos::path::Map;
  using Vector = atrapos::path::Vector;
  using CrsMatrix = atrapos::path::CrsMatrix;
  using State = atrapos::path::State;

  /// internalWeight: weight of the internal variables in inner(); 0 leaves them out.
  explicit JetProblem(Law law, double internalWeight = 0) : law_(law), internalWeight_(internalWeight) {
    const int n = law_.size();
    map_ = Teuchos::rcp(new Map(n, 0, Teuchos::rcp(new Teuchos::MpiComm<int>(MPI_COMM_SELF))));
    K_ = Teuchos::rcp(new CrsMatrix(map_, n));
    std::vector<long long> columns(n);
    for (int j = 0; j < n; ++j) columns[j] = j;
    const std::vector<double> zeros(n, 0.0);
    for (int i = 0; i < n; ++i) K_->insertGlobalValues(i, n, zeros.data(), columns.data());
    K_->fillComplete();
  }

  const Law& law() const { return law_; }
  Teuchos::RCP<const Map> map() const override { return map_; }
  bool symmetric() const override { return symmetric(law_, 0); }
  int constraintPivots() const override { return multipliers(law_, 0); }

  /// A state from plain numbers.
  Teuchos::RCP<Vector> vector(const std::vector<double>& x) const {
    auto v = Teuchos::rcp(new Vector(map_));
    for (std::size_t i = 0; i < x.size(); ++i) v->replaceLocalValue(i, x[i]);
    return v;
  }

  atrapos::path::ResidualNorm residual(const State& state, Vector& r) override {
    ++residuals;
    remember(state);
    Jet::terms = 1;
    const auto R = law_.residual(jets(*state.u), Jet(state.lambda));
    double norm2 = 0;
    for (std::size_t i = 0; i < R.size(); ++i) {
      r.replaceLocalValue(i, R[i][0]);
      norm2 += R[i][0] * R[i][0];
    }
    return {std::sqrt(norm2), law_.scale()};
  }

  Teuchos::RCP<const CrsMatrix> tangent(const State& state, Vector& F) override {
    remember(state);
    Jet::terms = 2;
    const int n = law_.size();
    auto x = jets(*state.u);
    Jet l(state.lambda);
    K_->resumeFill();
    for (int j = 0; j <= n; ++j) {
      Jet& seeded = j < n ? x[j] : l;
      seeded[1] = 1;
      const auto R = law_.residual(x, l);
      seeded[1] = 0;
      for (int i = 0; i < n; ++i) {
        const double value = R[i][1];
        const long long column = j;
        if (j < n)
          K_->replaceGlobalValues(i, 1, &value, &column);
        else
          F.replaceLocalValue(i, -value);
      }
    }
    K_->fillComplete();
    return K_;
  }

  Teuchos::RCP<const CrsMatrix> mass(const State&) override { return masses(law_, 0); }

  void beginSeries(const State& state, int maxOrder) override {
    remember(state);
    u_.clear();
    const auto data = state.u->getData();
    for (int i = 0; i < law_.size(); ++i) u_.push_back({data[i]});
    lambda_ = {state.lambda};
    maxOrder_ = maxOrder;
  }

  void orderRhs(int k, Vector& Fk) override {
    if (k != static_cast<int>(lambda_.size()) || k > maxOrder_)
      throw std::logic_error("orders out of sequence");
    Jet::terms = k + 1;
    const auto R = law_.residual(seriesJets(), Jet(lambda_));
    for (int i = 0; i < law_.size(); ++i) Fk.replaceLocalValue(i, -R[i][k]);
  }

  void completeOrder(int k, const Vector& Uk, double lambdaK) override {
    if (k != static_cast<int>(lambda_.size())) throw std::logic_error("orders out of sequence");
    const auto data = Uk.getData();
    for (int i = 0; i < law_.size(); ++i) u_[i].push_back(data[i]);
    lambda_.push_back(lambdaK);
  }

  int internalCount() const override {
    if (internalWeight_ == 0) return 0;
    Jet::terms = 1;
    return static_cast<int>(law_.internal(std::vector<Jet>(law_.size()), Jet(0.0)).size());
  }

  void internalOrder(int k, const Vector& v, double mu, std::vector<double>& y) const override {
    if (internalWeight_ == 0) return;
    Jet::terms = k + 1;
    auto x = seriesJets();
    const auto data = v.getData();
    for (int i = 0; i < law_.size(); ++i) x[i][k] = data[i];
    Jet l(lambda_);
    l[k] = mu;
    const auto t = law_.internal(x, l);
    for (std::size_t i = 0; i < t.size(); ++i) y[i] = t[i][k];
  }

  double inner(const atrapos::path::Increment& x, const atrapos::path::Increment& y) const override {
    double sum = Problem::inner(x, y);
    for (std::size_t i = 0; i < x.internal.size(); ++i)
      sum += internalWeight_ * x.internal[i] * y.internal[i];
    return sum;
  }

  int residuals = 0;

 protected:
  /// Before everything that is asked at a state: a law that events change becomes what it is there.
  virtual void remember(const State& /*state*/) {}

  template <class L>
  static auto symmetric(const L& law, int) -> decltype(law.symmetric()) {
    return law.symmetric();
  }
  template <class L>
  static bool symmetric(const L&, long) {
    return true;
  }
  template <class L>
  static auto multipliers(const L& law, int) -> decltype(law.multipliers()) {
    return law.multipliers();
  }
  template <class L>
  static int multipliers(const L&, long) {
    return 0;
  }

  /// diag(law.rateWeights()); null where the law has none.
  template <class L>
  auto masses(const L& law, int) -> decltype(law.rateWeights(), Teuchos::RCP<const CrsMatrix>()) {
    const std::vector<double> diagonal = law.rateWeights();
    const auto M = Teuchos::rcp(new CrsMatrix(map_, 1));
    for (long long i = 0; i < law.size(); ++i) M->insertGlobalValues(i, 1, &diagonal[i], &i);
    M->fillComplete();
    return M;
  }
  template <class L>
  Teuchos::RCP<const CrsMatrix> masses(const L&, long) {
    return Teuchos::null;
  }

  std::vector<Jet> jets(const Vector& u) const {
    const auto data = u.getData();
    return std::vector<Jet>(data.begin(), data.end());
  }
  std::vector<Jet> seriesJets() const {
    std::vector<Jet> x;
    for (const auto& c : u_) x.emplace_back(c);
    return x;
  }

  Law law_;
  double internalWeight_;
  Teuchos::RCP<const Map> map_;
  Teuchos::RCP<CrsMatrix> K_;
  std::vector<std::vector<double>> u_;
  std::vector<double> lambda_;
  int maxOrder_ = 0;
};
