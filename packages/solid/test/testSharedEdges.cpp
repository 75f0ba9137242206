// Shells with middle nodes beside shells without.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "ShellChecks.hpp"
#include "atrapos/fem/SharedEdges.hpp"
#include "atrapos/fem/ShellJoints.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "support/Meshes.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::solid::test;
using namespace atrapos::fem::test;

namespace {

using Cell = fem::Topology;
using Map = std::function<Vec3(double s, double t)>;
using Vector = std::function<Vec3(const Vec3&)>;

constexpr double thickness = 0.05, nu = 0.3;

/// Squares of [0, 1]^2, each of a cell of its own, on a surface; nothing held.
struct Patch {
  fem::Mesh mesh;
  fem::ShellGeometry shells;
  fem::FeModel model;
  std::vector<int> outline;  ///< nodes of the mesh

  Patch(int columns, int rows, const std::function<Cell(int column, int row)>& cellAt, const Map& surface,
        double poisson = nu, double thick = thickness) {
    std::vector<fem::Mesh> squares;
    for (int i = 0; i < columns; ++i)
      for (int j = 0; j < rows; ++j) {
        fem::ShellPlateOptions o;
        o.topology = cellAt(i, j);
        o.length = 1.0 / columns;
        o.width = 1.0 / rows;
        o.origin = {o.length * i, o.width * j, 0};
        squares.push_back(shellPlateMesh(o));
      }
    mesh = glued(squares);
    mesh.nodeSets.clear();
    mesh.sideSets.clear();
    for (int n = 0; n < mesh.numNodes(); ++n) {
      double* x = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
      const auto atEdge = [](double s) { return s < 1e-9 || s > 1 - 1e-9; };
      if (atEdge(x[0]) || atEdge(x[1])) outline.push_back(n);
      const Vec3 y = surface(x[0], x[1]);
      std::copy(y.begin(), y.end(), x);
    }
    std::vector<fem::ShellSection> sections;
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) sections.push_back({static_cast<int>(b), thick});
    shells = fem::shellGeometry(mesh, sections);
    model.dofs = fem::DofMap::displacements(shells.numNodes());
    const auto law = SaintVenantKirchhoff::fromYoung(1, poisson);
    for (const fem::ShellBlock& b : shells.blocks)
      model.terms.push_back(
          shellTerm({b.nodes, b.midsurface, b.directors, b.directorScale, b.nodesPerElement}, law, {},
                    b.nodesPerElement == 3   ? Shear::mitc3
                    : b.nodesPerElement == 4 ? Shear::mitc4
                    : b.nodesPerElement == 6 ? Shear::mitc6
                                             : Shear::assumed));
  }

  Vec3 X(int n) const { return at(mesh.coordinates, n); }
  Vec3 D(int director) const { return at(shells.directors, director - shells.numMeshNodes); }
  static Vec3 at(const Numbers& values, int n) {
    const double* v = &values[3 * static_cast<std::size_t>(n)];
    return {v[0], v[1], v[2]};
  }

  /// v of places and w of places and directors, as values of the nodes.
  Numbers field(const Vector& v, const std::function<Vec3(const Vec3& X, const Vec3& D)>& w) const {
    Numbers u(3 * static_cast<std::size_t>(shells.numNodes()), 0.0);
    const auto put = [&](int node, const Vec3& value) {
      std::copy(value.begin(), value.end(), &u[3 * static_cast<std::size_t>(node)]);
    };
    for (int n = 0; n < mesh.numNodes(); ++n) {
      put(n, v(X(n)));
      for (const int d : shells.directorNodes(n)) put(d, w(X(n), D(d)));
    }
    return u;
  }
  Numbers homogeneous(const Matrix& A) const {
    const auto times = [A](const Vec3& x) {
      Vec3 y{};
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) y[i] += A[3 * i + j] * x[j];
      return y;
    };
    return field(times, [&](const Vec3&, const Vec3& D) { return times(D); });
  }
  Numbers bent(const Vec3& k) const {
    return field(
        [&](const Vec3& x) {
          return Vec3{0, 0, -(k[0] * x[0] * x[0] + k[1] * x[1] * x[1] + 2 * k[2] * x[0] * x[1]) / 2};
        },
        [&](const Vec3& x, const Vec3& D) {
          return Vec3{D[2] * (k[0] * x[0] + k[2] * x[1]), D[2] * (k[2] * x[0] + k[1] * x[1]), 0};
        });
  }

  void drive(const std::vector<int>& nodes, const Numbers& exact) {
    for (const int n : nodes) {
      std::vector<int> all = shells.directorNodes(n);
      all.push_back(n);
      for (const int node : all)
        for (int i = 0; i < 3; ++i)
          model.prescribe(node, i, 0, exact[3 * static_cast<std::size_t>(node) + i]);
    }
  }
  void couple() {
    fem::coupleSharedEdges(model, mesh, shells, 1.0);
    fem::joinShells(model, mesh, shells, 1.0);
    model.constantLoad.resize(model.dofs.numDofs(), 0.0);
    model.load.resize(model.dofs.numDofs(), 0.0);
  }
};

Cell checkered(int i, int j, Cell one, Cell other) { return (i + j) % 2 == 0 ? one : other; }

/// Of each kind with middle nodes and each without.
const std::vector<std::array<Cell, 2>> pairs{{Cell::Shell8, Cell::Shell4},
                                             {Cell::Shell6, Cell::Shell3},
                                             {Cell::Shell8, Cell::Shell3},
                                             {Cell::Shell6, Cell::Shell4}};

Patch patchOf(const std::array<Cell, 2>& cells, const Map& surface, double thick = thickness) {
  return {3, 3, [&](int i, int j) { return checkered(i, j, cells[0], cells[1]); }, surface, nu, thick};
}

/// Parallelograms.
Vec3 skew(double s, double t) { return {s + 0.4 * t, 0.1 * s + 0.9 * t, 0}; }
Vec3 arch(double s, double t) { return {std::sin(s), t, std::cos(s)}; }

double patchError(const std::array<Cell, 2>& cells, const std::function<Numbers(const Patch&)>& solution) {
  Patch patch = patchOf(cells, skew);
  const Numbers exact = solution(patch);
  patch.drive(patch.outline, exact);
  patch.couple();
  fem::FeProblem problem(std::move(patch.model));
  EXPECT_GT(problem.numFreeDofs(), 0);
  Numbers u = linearSolution(problem);
  u.resize(exact.size());  // then multipliers
  return largest(sum(u, -1, exact)) / largest(exact);
}

}  // namespace

TEST(SharedEdges, AreFound) {
  const Patch patch = patchOf(pairs[0], skew);
  EXPECT_EQ(fem::sharedEdges(patch.mesh).size(), 12u);  // all inside
  EXPECT_EQ(patch.shells.followers.size(), 12u);
  const Patch same(
      2, 1, [](int, int) { return Cell::Shell8; }, skew);
  EXPECT_TRUE(fem::sharedEdges(same.mesh).empty());
  EXPECT_TRUE(fem::middlesAtCorners(patch.mesh).empty());
  fem::Mesh halves = patch.mesh;  // another square, with a corner at a middle
  fem::Block& four = *std::find_if(halves.blocks.begin(), halves.blocks.end(),
                                   [](const fem::Block& b) { return b.topology == Cell::Shell4; });
  const int middle = patch.shells.followers.front().node;
  four.nodes.insert(four.nodes.end(), {four.nodes[0], four.nodes[1], middle, four.nodes[3]});
  EXPECT_EQ(fem::middlesAtCorners(halves), std::vector<int>{middle});
}

TEST(SharedEdges, TangentAndOrders) {
  for (const auto& cells : pairs) {
    Patch patch = patchOf(cells, arch, 0.2);
    patch.drive({patch.outline[0], patch.outline[1]},
                Numbers(3 * static_cast<std::size_t>(patch.shells.numNodes()), 0.0));
    patch.couple();
    EXPECT_GT(expectSymmetricTangentAndOrders(std::move(patch.model)), 0);
  }
}

// Plates: constant strain in the plane and constant curvatures, on parallelograms. Rounding times
// (1/thickness)^2 times a few nodes.
TEST(SharedEdges, ConstantStrainAndCurvaturePass) {
  Matrix A{1e-3, 2e-4, 0, -4e-4, 5e-4, 0, 0, 0, 0};
  A[8] = -nu / (1 - nu) * (A[0] + A[4]);  // S_33 = 0
  for (const auto& cells : pairs) {
    EXPECT_LT(patchError(cells, [&](const Patch& p) { return p.homogeneous(A); }), 1e-11);
    for (const Vec3& k : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, 1}, Vec3{0.3, -0.8, 0.5}})
      EXPECT_LT(patchError(cells, [&](const Patch& p) { return p.bent(k); }), 1e-11);
  }
}

// The same at a stretch of a fifth, turned: the state is one of equilibrium, multipliers found with it.
TEST(SharedEdges, HomogeneousStateAtFiniteStrain) {
  const double a = 1.2, d = 1.1;
  const double stretch = std::sqrt(1 - nu / (1 - nu) * (a * a + d * d - 2));
  const std::array<double, 3> U{a, d, stretch};
  Matrix A = rotation(0.5);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      A[3 * i + j] = (A[3 * i + j] + (i == j ? 1 : 0)) * U[static_cast<std::size_t>(j)] - (i == j ? 1 : 0);
  for (const auto& cells : pairs) {
    Patch patch = patchOf(cells, skew);
    const Numbers exact = patch.homogeneous(A);
    patch.drive(patch.outline, exact);
    patch.couple();
    fem::FeProblem problem(std::move(patch.model));
    Numbers start(problem.model().dofs.numDofs(), 0.0);
    std::copy(exact.begin(), exact.end(), start.begin());
    const Numbers off = randomNumbers(exact.size(), 0.05 * thickness, 5);
    for (std::size_t i = 0; i < exact.size(); ++i)
      if (!problem.model().supports.fixed(static_cast<int>(i))) start[i] += off[i];
    Numbers u = equilibrium(problem, 1.0, start, 1e-11).u;
    u.resize(exact.size());
    EXPECT_LT(largest(sum(u, -1, exact)), 1e-11);  // rounding times (1/thickness)^2
  }
}

// On a curved surface too, whose edges stand out from their chords.
TEST(SharedEdges, FiniteRotationCostsNoForce) {
  for (const auto& cells : pairs)
    for (const Map& surface : {Map(skew), Map(arch)}) {
      Patch patch = patchOf(cells, surface);
      std::vector<Numbers> turned;
      for (const double angle : {0.4, 2.0, M_PI}) turned.push_back(patch.homogeneous(rotation(angle)));
      patch.couple();
      fem::FeProblem problem(std::move(patch.model));
      for (Numbers& u : turned) {
        EXPECT_GT(largest(u), 0.1);
        u.resize(problem.model().dofs.numDofs(), 0.0);
        EXPECT_LT(largest(residual(problem, u, 0).r), 2e-15);  // rounding of numbers of size 1 times areas
      }
    }
}

// A strip whose ends are turned by a right angle against each other bends to a quarter of a circle, squares
// of both kinds in turn: the free end comes to the circle's with the order of the elements of four nodes, 2.
TEST(SharedEdges, StripBendsToAQuarterCircle) {
  const double length = 10, h = 0.02, k = M_PI / (2 * length);
  const auto error = [&](const std::array<Cell, 2>& cells, int columns) {
    Patch patch(
        columns, 1, [&](int i, int) { return checkered(i, 0, cells[0], cells[1]); },
        [&](double s, double t) {
          return Vec3{length * s, t, 0};
        },
        0, h);
    const Numbers circle = patch.field(
        [&](const Vec3& x) {
          return Vec3{std::sin(k * x[0]) / k - x[0], 0, (std::cos(k * x[0]) - 1) / k};
        },
        [&](const Vec3& x, const Vec3& D) {
          return Vec3{std::sin(k * x[0]) * D[2], 0, (std::cos(k * x[0]) - 1) * D[2]};
        });
    int tip = -1;
    for (int n = 0; n < patch.mesh.numNodes(); ++n) {
      const bool first = patch.X(n)[0]<1e-9, last = patch.X(n)[0]> length - 1e-9;
      if (first) patch.drive({n}, circle);
      if (last) tip = n;
      for (const int d : patch.shells.directorNodes(n))
        for (int i = 0; last && i < 3; ++i)
          patch.model.prescribe(d, i, 0, circle[3 * static_cast<std::size_t>(d) + i]);
    }
    patch.couple();
    fem::FeProblem problem(std::move(patch.model));
    Numbers start = circle;
    start.resize(problem.model().dofs.numDofs(), 0.0);
    const auto state = equilibrium(problem, 1.0, start, 1e-9);
    EXPECT_TRUE(state.inertia);
    EXPECT_EQ(state.inertia->negative, problem.constraintPivots());  // stable
    const Vec3 u = Patch::at(state.u, tip), exact = Patch::at(circle, tip);
    return std::hypot(u[0] - exact[0], u[1] - exact[1], u[2] - exact[2]) / length;
  };
  for (const auto& cells : pairs) {
    const double coarse = error(cells, 8), fine = error(cells, 16);
    EXPECT_LT(coarse, 5e-3);
    EXPECT_GT(fine, 1e-5);  // what the thickness changes, (h k)^2/2 = 5e-6, is less
    EXPECT_NEAR(std::log2(coarse / fine), 2, 0.3);
  }
}

// What holds the middle of an edge makes its condition needless, and must hold the ends.
TEST(SharedEdges, SupportsTakeConditions) {
  const auto pivots = [](const std::function<void(Patch&, const fem::EdgeFollower&)>& hold) {
    Patch patch = patchOf(pairs[0], skew);
    patch.drive({patch.outline[0], patch.outline[1], patch.outline[2]},
                Numbers(3 * static_cast<std::size_t>(patch.shells.numNodes()), 0.0));
    const std::set<int> outline(patch.outline.begin(), patch.outline.end());
    const auto inside = std::find_if(
        patch.shells.followers.begin(), patch.shells.followers.end(),
        [&](const auto& f) { return outline.count(f.ends[0]) == 0 && outline.count(f.ends[1]) == 0; });
    hold(patch, *inside);
    patch.couple();
    fem::FeProblem problem(std::move(patch.model));
    const auto state = equilibrium(problem, 0, Numbers(problem.model().dofs.numDofs(), 0.0));
    EXPECT_EQ(state.inertia->negative, problem.constraintPivots());
    return problem.constraintPivots();
  };
  const auto none = [](Patch&, const fem::EdgeFollower&) {};
  const int all = pivots(none);
  EXPECT_EQ(all, 3 * 12);
  const auto line = [](const std::string& components) {
    return [components](Patch& patch, const fem::EdgeFollower& f) {
      hold(patch.model, {f.node, f.ends[0], f.ends[1]}, components);
    };
  };
  EXPECT_EQ(pivots(line("z")), all - 1);
  EXPECT_EQ(pivots(line("xyz")), all - 3);
  EXPECT_EQ(pivots([&](Patch& patch, const fem::EdgeFollower& f) {  // clamped
              line("xyz")(patch, f);
              hold(patch.model, {f.director, f.endDirectors[0], f.endDirectors[1]}, "xyz");
            }),
            all - 3);
  for (const bool first : {true, false})  // moving as one, as the middle does or as an end
    EXPECT_EQ(pivots([&](Patch& patch, const fem::EdgeFollower& f) {
                fem::coupleEqual(patch.model.couplings, patch.model.dofs,
                                 first ? std::vector<int>{f.node, f.ends[0], f.ends[1]}
                                       : std::vector<int>{f.ends[0], f.node, f.ends[1]});
              }),
              all - 3);
  try {
    pivots([](Patch& patch, const fem::EdgeFollower& f) { hold(patch.model, {f.node}, "z"); });
    FAIL();
  } catch (const std::invalid_argument& e) {
    EXPECT_NE(std::string(e.what()).find("is the middle of an edge"), std::string::npos) << e.what();
  }
}
