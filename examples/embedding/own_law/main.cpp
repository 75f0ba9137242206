// A rubber block is pressed on an ellipsoid. The law, the tool and the observer that ends the run are the
// application's: one struct each, registered nowhere.
#include <Tpetra_Core.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <cstdio>

#include "atrapos/contact/ContactLaw.hpp"
#include "atrapos/fem/FeProblem.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/PointLawOf.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/PathFollower.hpp"

using namespace atrapos;

/// Compressible neo-Hookean solid: P = mu (F - F^-T) + lambda ln J F^-T, F = I + H, rows of H and P.
struct NeoHooke {
  static constexpr int numInputs = 9, numOutputs = 9, numData = 0;
  static constexpr bool symmetric = true;
  double mu = 1, lambda = 2;  // MPa

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* H, const taylor::Passive<T>*, T* P) const {
    using std::log;
    T F[9], cofactor[9];
    for (int i = 0; i < 9; ++i) F[i] = H[i] + (i % 4 == 0 ? 1.0 : 0.0);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
        cofactor[3 * i + j] = F[3 * a + c] * F[3 * b + d] - F[3 * a + d] * F[3 * b + c];
      }
    const T J = F[0] * cofactor[0] + F[1] * cofactor[1] + F[2] * cofactor[2];
    const T factor = (lambda * log(J) - mu) / J;
    for (int i = 0; i < 9; ++i) P[i] = mu * F[i] + factor * cofactor[i];
  }

  static constexpr int numObserved = 1;
  static std::vector<std::string> observedNames() { return {"volume_ratio"}; }
  KOKKOS_INLINE_FUNCTION void observe(const double* H, const double*, double* observed) const {
    double F[9];
    for (int i = 0; i < 9; ++i) F[i] = H[i] + (i % 4 == 0 ? 1.0 : 0.0);
    observed[0] = F[0] * (F[4] * F[8] - F[5] * F[7]) - F[1] * (F[3] * F[8] - F[5] * F[6]) +
                  F[2] * (F[3] * F[7] - F[4] * F[6]);
  }
};

/// Ellipsoid with half axes along x, y, z: proj(h, n, x) = 0 (docs/own_tool.md).
struct Ellipsoid {
  static constexpr int numUnknowns = 4;
  static constexpr bool symmetric = true;
  double center[3] = {0, 0, 0}, half[3] = {1, 1, 1};

  template <class T>
  KOKKOS_INLINE_FUNCTION void operator()(const T* x, const T* y, T* g) const {
    using std::sqrt;
    T m[3], level(-1.0), square(0.0);
    for (int i = 0; i < 3; ++i) {
      const T foot = x[i] - center[i] - y[0] * y[1 + i];
      m[i] = foot / (half[i] * half[i]);
      level += foot * m[i];
      square += m[i] * m[i];
    }
    const T size = sqrt(square);
    g[0] = level;
    for (int i = 0; i < 3; ++i) g[1 + i] = size * y[1 + i] - m[i];
  }
  KOKKOS_INLINE_FUNCTION void start(const double* x, double* y) const {
    double d[3], level = 0, size = 0;
    for (int i = 0; i < 3; ++i) d[i] = x[i] - center[i];
    for (int i = 0; i < 3; ++i) level += d[i] * d[i] / (half[i] * half[i]);
    for (int i = 0; i < 3; ++i) y[1 + i] = d[i] / (half[i] * half[i]);
    for (int i = 0; i < 3; ++i) size += y[1 + i] * y[1 + i];
    y[0] = 0;
    for (int i = 0; i < 3; ++i) y[1 + i] /= std::sqrt(size);
    for (int i = 0; i < 3; ++i) y[0] += (1 - 1 / std::sqrt(level)) * d[i] * y[1 + i];
  }
};

/// Ends the run where the force on the tool reaches a value, and finds the place inside the step from its
/// series.
class ForceLimit : public path::Observer {
 public:
  ForceLimit(fem::FeProblem& problem, double limit) : problem_(problem), limit_(limit) {}

  double travel = 0;  ///< load factor where the limit is reached

  bool onStep(const path::StepReport& report, const path::Series& series) override {
    if (force(report.end) < limit_) return true;
    double from = 0, to = report.length;
    for (int i = 0; i < 60; ++i) {  // bisection: no solve, the series is the path
      const double a = 0.5 * (from + to);
      const path::State state = series.state(a);
      travel = state.lambda;
      (force(state) < limit_ ? from : to) = a;
    }
    return false;
  }

  /// Vertical force of the tool on the block.
  double force(const path::State& state) const {
    const auto forces = problem_.forces(problem_.term(1), state);
    double sum = 0;
    for (std::size_t i = 2; i < forces.size(); i += 3) sum -= forces[i];
    return sum;
  }

 private:
  fem::FeProblem& problem_;
  double limit_;
};

/// The block is 2 x 2 x 1 mm, its lower face 0.1 mm over the ellipsoid; the load factor is the travel of its
/// upper face.
static int press() {
  fem::BoxOptions box;
  box.lengths = {2, 2, 1};
  box.origin = {-1, -1, 0};
  box.divisions = {4, 4, 2};
  const fem::Mesh mesh = fem::boxMesh(box);
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  model.terms.push_back(
      fem::lawTerm(fem::pointLaw(NeoHooke{}),
                   fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(mesh.blocks[0].topology))));
  Ellipsoid tool;
  tool.center[2] = -0.6;
  tool.half[0] = 2;
  tool.half[1] = 1.5;
  tool.half[2] = 0.5;
  using Contact = contact::ContactLaw<Ellipsoid>;
  const auto points = fem::nodePoints(mesh, mesh.nodeSets[fem::findNodeSet(mesh, "z_min")].nodes);
  std::vector<double> gaps;
  for (int p = 0; p < points.numPoints(); ++p) {
    double y[4];
    if (!taylor::solveImplicit<3, 4>(tool, &points.positions[3 * p], y)) return 2;
    gaps.push_back(y[0]);
  }
  model.terms.push_back(
      fem::lawTerm(fem::pointLaw(Contact{tool, contact::RegularisedPressure{1e-2, 1e-3}}), points, gaps));
  for (const int node : mesh.nodeSets[fem::findNodeSet(mesh, "z_max")].nodes) {
    model.prescribe(node, 0, 0, 0);
    model.prescribe(node, 1, 0, 0);
    model.prescribe(node, 2, 0, -1);  // 1 mm down at load factor 1
  }
  fem::FeProblem problem(std::move(model));
  const auto solver = linear::makeTangentSolver({});
  path::Stops stops;
  stops.loadFactors = {0.5};
  ForceLimit observer(problem, 1.0);  // N
  const auto outcome =
      path::PathFollower(problem, *solver, {}, stops).run({problem.initialState(0.0), 0.0}, observer);
  std::printf("%s after %d steps; 1 N at a travel of %.8f mm, in the last step to %.8f mm\n",
              outcome.text.c_str(), outcome.steps, observer.travel, outcome.final.lambda);
  // Equilibrium: the tool's force is what the supports of the upper face bear.
  double support = 0;
  const auto reactions = problem.reactions(outcome.final);
  for (std::size_t i = 2; i < reactions.size(); i += 3) support -= reactions[i];
  const double force = observer.force(outcome.final);
  const bool good = outcome.reason == path::EndReason::observerStopped && observer.travel > 0.1 &&
                    observer.travel <= outcome.final.lambda && force >= 1.0 &&
                    std::abs(support - force) < 1e-4 * force;  // the residual bound, 1e-6 of larger forces
  if (!good) std::printf("force %.8f, support %.8f\n", force, support);
  return good ? 0 : 1;
}

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard guard(&argc, &argv);
  return press();
}
