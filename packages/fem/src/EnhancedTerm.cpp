#include "atrapos/fem/EnhancedTerm.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

#include "EnhancedParameters.hpp"
#include "LawArrays.hpp"
#include "atrapos/taylor/Domain.hpp"

namespace atrapos::fem {
namespace {

class EnhancedTerm final : public Term {
 public:
  EnhancedTerm(std::unique_ptr<PointLaw> law, const EnhancedPoints& p)
      : a_(std::move(law), p.points, p.data),
        I_(a_.elements.inputs()),
        J_(a_.shape.inputs),
        M_(p.numParameters),
        modes_(p.modes) {
    const std::size_t Q = numPoints(), J = J_;
    if ((J_ != I_ + 1 && J_ != I_ + 2) || a_.shape.outputs != I_ + 1)
      throw std::logic_error(
          "enhancedTerm: the law's inputs and outputs are vectors and one strain, before which inputs may "
          "have the "
          "load factor");
    if (M_ < 1 || M_ > kMaxParameters || modes_.size() != Q * M_ ||
        p.strain.size() != static_cast<std::size_t>(p.points.numPoints()))
      throw std::logic_error("enhancedTerm: wrong number of parameters, modes or strains");
    strain_ = a_.elements.packed(p.strain, Q);
    const std::size_t dofs = localDofs() * kLanes, rank = M_;
    a_.allocateScratch(dofs * (1 + 2 * rank) + a_.perBatch(3 * J + (I_ + 1) * J) + 3 * rank * rank * kLanes +
                       (a_.elements.numFields() > 1 ? a_.perBatch(I_ * I_) : 0));
    makeWorkspace();
  }

  int numEntities() const override { return a_.elements.numEntities(); }
  int nodesPerEntity() const override { return a_.elements.nodesPerEntity(); }
  const std::vector<int>& nodes() const override { return a_.elements.nodes(); }
  bool symmetric() const override { return a_.shape.symmetric; }
  bool seesLoadFactor() const override { return J_ > I_ + 1; }
  std::size_t historyBytes(int maxOrder) const override { return a_.historyBytes(maxOrder); }

  void keep(const TermPart& part) override {
    strain_ = ElementArrays::packedOf(part, strain_.data(), numPoints());
    a_.keep(part);
    makeWorkspace();
  }

  void connect(const DofMap& dofs, const std::vector<int>& positions) override {
    a_.elements.connect(dofs, positions, nodesPerEntity());
  }

  OwnForces addResidual(const ConstDofView& u, double lambda, const DofView& f) const override {
    const int balances = a_.elements.numBalances();
    std::vector<double> squares(static_cast<std::size_t>(batches().count) * balances);
    forEachBatch("residual", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, held, s);
      a_.law->value(a_.batch(b, a_.data(), held.data()), s.in, s.out);
      a_.elements.addForces(b, s.out, I_ + 1, true, zero(s.force, localDofs()));
      a_.elements.scatter(b, s.force, f.data());
      a_.elements.squares(b, s.force, &squares[static_cast<std::size_t>(b) * balances]);
    });
    return sumOf(squares, balances);
  }

  void addTangent(const ConstDofView& u, double lambda, const TangentSink& sink) const override {
    forEachBatch("tangent", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, held, s);
      double* byE = s.out;  // [q][I + 1][lane], its last row unused
      double* byh = s.in;   // the same, once the inputs were read
      linearize(b, held, s, byE, byh, s.inverse);
      if (seesLoadFactor()) {
        loadDirection(b, s, byE);
        a_.elements.scatter(b, s.force, sink.loadDirection.data());
      }
      // K_ub and -K_bb^-1 K_bu by dof, [dof][parameter].
      const int dofs = localDofs();
      zero(s.left, dofs * M_);
      zero(s.right, dofs * M_);
      for (int j = 0; j < M_; ++j) {
        a_.elements.addForces(b, scaled(byE, j, s.product), I_ + 1, false, zero(s.force, dofs));
        for (int n = 0; n < dofs; ++n) copy(s.force + n * kLanes, s.left + (n * M_ + j) * kLanes);
        a_.elements.addForces(b, scaled(byh, j, s.product), I_ + 1, false, zero(s.force, dofs));
        for (int n = 0; n < dofs; ++n)
          for (int k = 0; k < M_; ++k)
            subtractProduct(s.inverse + (k * M_ + j) * kLanes, s.force + n * kLanes,
                            s.right + (n * M_ + k) * kLanes);
      }
      a_.elements.addBlocks(b, s.jacobian, I_ + 1, J_, a_.shape.symmetric, {M_, s.left, s.right}, sink,
                            s.moduli);
    });
  }

  void beginSeries(const ConstDofView& u, double lambda, int maxOrder) override {
    a_.reserveHistory(maxOrder);
    std::vector<PointFailure> failures(batches().count);
    forEachBatch("beginSeries", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      inputs(b, u, lambda, held, s);
      std::copy_n(s.in, a_.perBatch(J_), s.product);
      linearize(b, held, s, &dfde_[b * a_.perBatch(I_ + 1)], &dsdh_[b * a_.perBatch(I_ + 1)],
                &inverse_[static_cast<std::size_t>(b) * M_ * M_ * kLanes]);
      if (seesLoadFactor()) byLoadFactor(b, s.jacobian, &dgdl_[static_cast<std::size_t>(b) * M_ * kLanes]);
      a_.start(b, a_.data(), s.product, s.out, failures[b]);
    });
    const std::string unsolved = failure();
    if (!unsolved.empty())
      throw taylor::DomainError(taylor::Operation::Result, std::numeric_limits<double>::quiet_NaN(),
                                unsolved);
    a_.throwFirst(failures);
  }

  // f_k - K_ub K_bb^-1 g_k, after the histories of order k - 1 became those of the true (U, beta).
  void addOrder(int k, const ConstDofView& last, double lastLambda, const DofView& f) override {
    const SeriesOrder order = seriesOrder(k, a_.maxOrder());
    forEachBatch("addOrder", batches(), [&](int b) {
      const ThreadMemory::Held held(a_.memory());
      const Scratch s(*this, held);
      double* g = &g_[static_cast<std::size_t>(b) * M_ * kLanes];
      if (k > 1) trueInputs(b, last, lastLambda, g, s);
      a_.law->order(a_.seriesBatch(b, a_.data()), order, s.in, s.out);
      zero(g, M_);
      for (int q = 0; q < numPoints(); ++q) {
        double ofStrain[kLanes];
        product(a_.elements.weights(b) + q * kLanes, s.out + (q * (I_ + 1) + I_) * kLanes, ofStrain);
        for (int j = 0; j < M_; ++j) addTimes(mode(q, j), ofStrain, g + j * kLanes);
      }
      a_.elements.addForces(b, s.out, I_ + 1, true, zero(s.force, localDofs()));
      // What the parameters of this order do to the forces.
      double minusBeta[kMaxParameters * kLanes];
      solve(b, g, minusBeta);
      for (int i = 0; i < M_ * kLanes; ++i) minusBeta[i] = -minusBeta[i];
      addCondensed(b, &dfde_[b * a_.perBatch(I_ + 1)], minusBeta, s);
      a_.elements.scatter(b, s.force, f.data());
    });
  }

  PointValues observe(const ConstDofView& u, double lambda) const override {
    return a_.observe(a_.data(), [&](int b, const ThreadMemory::Held& held) {
      const Scratch s(*this, held);
      inputs(b, u, lambda, held, s);
      return s.in;
    });
  }

 private:
  /// A batch's numbers in a thread's memory.
  struct Scratch {
    Scratch(const EnhancedTerm& t, const ThreadMemory::Held& held) {
      const std::size_t dofs = t.localDofs() * kLanes, J = t.J_, rank = t.M_;
      force = t.a_.scratchOf(held);
      left = force + dofs;
      right = left + dofs * rank;
      in = right + dofs * rank;
      out = in + t.a_.perBatch(J);
      product = out + t.a_.perBatch(J);
      jacobian = product + t.a_.perBatch(J);
      inverse = jacobian + t.a_.perBatch((t.I_ + 1) * J);
      moduli = t.a_.elements.numFields() > 1 ? inverse + 3 * rank * rank * kLanes : jacobian;
    }
    double *force, *left, *right, *in, *out, *product, *jacobian, *inverse;
    double* moduli;  ///< those of one field may take the jacobian's place
  };

  // Numbers of all lanes.
  static double* zero(double* to, std::size_t count) {
    std::fill_n(to, count * kLanes, 0.0);
    return to;
  }
  static void copy(const double* from, double* to) { std::copy_n(from, kLanes, to); }
  static void product(const double* a, const double* b, double* to) {
    for (int l = 0; l < kLanes; ++l) to[l] = a[l] * b[l];
  }
  static void addTimes(double factor, const double* a, double* to) {
    for (int l = 0; l < kLanes; ++l) to[l] += factor * a[l];
  }
  static void subtractProduct(const double* a, const double* b, double* to) {
    for (int l = 0; l < kLanes; ++l) to[l] -= a[l] * b[l];
  }

  double mode(int q, int j) const { return modes_[q * M_ + j]; }

  /// in[q] = (h, lambda where the law reads it, e) with the beta that belongs to the state.
  void inputs(int b, const ConstDofView& u, double lambda, const ThreadMemory::Held& held,
              const Scratch& s) const {
    a_.elements.gather(b, u.data(), J_, s.in);
    setLoadFactor(lambda, s.in);
    EnhancedFailure failure[kLanes];
    solveEnhanced(*a_.law, a_.batch(b, a_.data(), held.data()),
                  {M_, modes_.data(), a_.elements.weights(b), &strain_[b * a_.perBatch(1)]}, s.in, s.out,
                  s.jacobian, failure);
    for (int lane = 0; lane < a_.elements.lanesIn(b); ++lane)
      failed_[static_cast<std::size_t>(b) * kLanes + lane] = failure[lane];
  }

  /// Where the law reads it.
  void setLoadFactor(double lambda, double* in) const {
    for (int q = 0; seesLoadFactor() && q < numPoints(); ++q)
      std::fill_n(in + (q * J_ + I_) * kLanes, kLanes, lambda);
  }

  /// dg/dlambda of the parameters, [parameter].
  void byLoadFactor(int b, const double* jacobian, double* dgdl) const {
    zero(dgdl, M_);
    for (int q = 0; q < numPoints(); ++q) {
      double ofStrain[kLanes];
      product(a_.elements.weights(b) + q * kLanes,
              jacobian + ((static_cast<std::size_t>(q) * (I_ + 1) + I_) * J_ + I_) * kLanes, ofStrain);
      for (int j = 0; j < M_; ++j) addTimes(mode(q, j), ofStrain, dgdl + j * kLanes);
    }
  }

  /// s.force = -(df/dlambda - K_ub K_bb^-1 dg/dlambda), after linearize.
  void loadDirection(int b, const Scratch& s, const double* byE) const {
    double dgdl[kMaxParameters * kLanes], beta[kMaxParameters * kLanes];
    byLoadFactor(b, s.jacobian, dgdl);
    multiply(s.inverse, dgdl, beta);
    for (int q = 0; q < numPoints(); ++q)
      for (int m = 0; m < I_; ++m) {
        const std::size_t row = static_cast<std::size_t>(q) * (I_ + 1) + m;
        for (int l = 0; l < kLanes; ++l)
          s.product[row * kLanes + l] = -s.jacobian[(row * J_ + I_) * kLanes + l];
      }
    a_.elements.addForces(b, s.product, I_ + 1, true, zero(s.force, localDofs()));
    addCondensed(b, byE, beta, s);
  }

  /// s.force += byE times the strains of `beta`.
  void addCondensed(int b, const double* byE, const double* beta, const Scratch& s) const {
    for (int q = 0; q < numPoints(); ++q) {
      double e[kLanes] = {};
      for (int j = 0; j < M_; ++j) addTimes(mode(q, j), beta + j * kLanes, e);
      for (int m = 0; m < I_; ++m) {
        const std::size_t at = (static_cast<std::size_t>(q) * (I_ + 1) + m) * kLanes;
        product(byE + at, e, s.product + at);
      }
    }
    a_.elements.addForces(b, s.product, I_ + 1, false, s.force);
  }

  /// The law's tangent at all points in s.jacobian, weighted f by e and s by h, [q][I + 1], and K_bb^-1.
  /// `byh` may be the inputs' own place.
  void linearize(int b, const ThreadMemory::Held& held, const Scratch& s, double* byE, double* byh,
                 double* inverse) const {
    const int O = I_ + 1, e = J_ - 1;
    double K[kMaxParameters * kMaxParameters * kLanes];
    zero(K, M_ * M_);
    a_.law->tangent(a_.batch(b, a_.data(), held.data()), s.in, s.out, s.jacobian);
    for (int q = 0; q < numPoints(); ++q) {
      const double* w = a_.elements.weights(b) + q * kLanes;
      const double* jacobian = s.jacobian + static_cast<std::size_t>(q) * O * J_ * kLanes;
      for (int m = 0; m < I_; ++m) {
        product(w, jacobian + (m * J_ + e) * kLanes, byE + (q * O + m) * kLanes);
        product(w, jacobian + (I_ * J_ + m) * kLanes, byh + (q * O + m) * kLanes);
      }
      double dsde[kLanes];
      product(w, jacobian + (I_ * J_ + e) * kLanes, dsde);
      for (int j = 0; j < M_; ++j)
        for (int k = 0; k < M_; ++k) addTimes(mode(q, j) * mode(q, k), dsde, K + (j * M_ + k) * kLanes);
    }
    for (int lane = a_.elements.lanesIn(b); lane < kLanes; ++lane)
      for (int j = 0; j < M_; ++j) K[(j * M_ + j) * kLanes + lane] = 1;  // padding: no weight, no stiffness
    invertInLanes(M_, K, inverse);
  }

  /// product[q][m] = mode_j of the point times a[q][m].
  double* scaled(const double* a, int j, double* to) const {
    const int J = I_ + 1;
    for (int q = 0; q < numPoints(); ++q)
      for (int m = 0; m < I_ * kLanes; ++m) to[q * J * kLanes + m] = a[q * J * kLanes + m] * mode(q, j);
    return to;
  }

  /// x = K_bb^-1 y
  void solve(int b, const double* y, double* x) const {
    multiply(&inverse_[static_cast<std::size_t>(b) * M_ * M_ * kLanes], y, x);
  }
  void multiply(const double* K, const double* y, double* x) const {
    for (int j = 0; j < M_; ++j)
      for (int l = 0; l < kLanes; ++l) {
        double sum = 0;
        for (int i = 0; i < M_; ++i) sum += K[(j * M_ + i) * kLanes + l] * y[i * kLanes + l];
        x[j * kLanes + l] = sum;
      }
  }

  /// in[q] = (h_k, lambda_k, e_k) of U_k and lambda_k, with beta_k = -K_bb^-1 (g_k + K_bu U_k + dg/dlambda
  /// lambda_k) and the g_k that the sweep of order k left.
  void trueInputs(int b, const ConstDofView& Uk, double lambdak, const double* g, const Scratch& s) const {
    const int J = J_, O = I_ + 1;
    double sum[kMaxParameters * kLanes], minusBeta[kMaxParameters * kLanes];
    std::copy_n(g, M_ * kLanes, sum);
    a_.elements.gather(b, Uk.data(), J, s.in);
    setLoadFactor(lambdak, s.in);
    if (seesLoadFactor()) {
      const double* dgdl = &dgdl_[static_cast<std::size_t>(b) * M_ * kLanes];
      for (int i = 0; i < M_ * kLanes; ++i) sum[i] += dgdl[i] * lambdak;
    }
    const double* byh = &dsdh_[b * a_.perBatch(O)];
    for (int q = 0; q < numPoints(); ++q) {
      double stress[kLanes] = {};
      for (int m = 0; m < I_; ++m)
        for (int l = 0; l < kLanes; ++l)
          stress[l] += byh[(q * O + m) * kLanes + l] * s.in[(q * J + m) * kLanes + l];
      for (int j = 0; j < M_; ++j) addTimes(mode(q, j), stress, sum + j * kLanes);
    }
    solve(b, sum, minusBeta);
    for (int q = 0; q < numPoints(); ++q) {
      double* e = zero(s.in + (q * J + J - 1) * kLanes, 1);
      for (int j = 0; j < M_; ++j) addTimes(-mode(q, j), minusBeta + j * kLanes, e);
    }
  }

  /// The first element without enhanced parameters in the last loop over states, and why; empty where all
  /// have theirs.
  std::string failure() const {
    for (int e = 0; e < numEntities(); ++e)
      if (failed_[e] != EnhancedFailure::none)
        return "element " + std::to_string(a_.elements.numberInTerm(e) + 1) + ": " + describe(failed_[e]);
    return {};
  }

  // New vectors: assign() would keep the memory of the whole term where a rank keeps its part.
  void makeWorkspace() {
    const std::size_t count = batches().count;
    dfde_ = std::vector(count * a_.perBatch(I_ + 1), 0.0);
    dsdh_ = std::vector(count * a_.perBatch(I_ + 1), 0.0);
    inverse_ = std::vector(count * M_ * M_ * kLanes, 0.0);
    g_ = std::vector(count * M_ * kLanes, 0.0);
    if (seesLoadFactor()) dgdl_ = std::vector(count * M_ * kLanes, 0.0);
    failed_ = std::vector(count * kLanes, EnhancedFailure::none);
  }

  int numPoints() const { return a_.elements.numPoints(); }
  int localDofs() const { return a_.elements.localDofs(); }
  const Batches& batches() const { return a_.elements.batches(); }

  LawArrays a_;
  int I_, J_, M_;               ///< inputs from the unknowns, of the law; parameters
  std::vector<double> modes_;   ///< [q][parameter]
  std::vector<double> strain_;  ///< [batch][q][lane]
  // At the start of the series under way:
  std::vector<double> dfde_;     ///< [batch][q][I + 1][lane], times the weight
  std::vector<double> dsdh_;     ///< the same
  std::vector<double> inverse_;  ///< [batch][M][M][lane] K_bb^-1
  std::vector<double> dgdl_;     ///< [batch][M][lane] by lambda, where the law reads it
  std::vector<double> g_;        ///< [batch][M][lane] of the order swept last: g_k with U_k = 0, beta_k = 0
  mutable std::vector<EnhancedFailure> failed_;  ///< [batch][lane] of the last loop over states
};

}  // namespace

std::unique_ptr<Term> enhancedTerm(std::unique_ptr<PointLaw> law, const EnhancedPoints& points) {
  return std::make_unique<EnhancedTerm>(std::move(law), points);
}

}  // namespace atrapos::fem
