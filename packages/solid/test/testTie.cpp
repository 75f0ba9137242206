// Ties of surfaces whose meshes do not fit: patch tests, rigid motions across gaps, closed forms, borders.
#include "atrapos/fem/Tie.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <stdexcept>
#include <string>

#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/solid/EdgePressure.hpp"
#include "atrapos/solid/PlaneBody.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using fem::Topology;
using Kind = PlaneSection::Kind;

namespace {

/// Two meshes in one, nothing shared; side sets of the first begin with "a_", of the second with "b_".
fem::Mesh beside(const fem::Mesh& a, const fem::Mesh& b) {
  fem::Mesh both = a;
  both.nodeSets.clear();
  for (fem::SideSet& set : both.sideSets) set.name = "a_" + set.name;
  both.coordinates.insert(both.coordinates.end(), b.coordinates.begin(), b.coordinates.end());
  for (fem::Block block : b.blocks) {
    for (int& n : block.nodes) n += a.numNodes();
    both.blocks.push_back(block);
  }
  for (fem::SideSet set : b.sideSets) {
    set.name = "b_" + set.name;
    for (fem::Side& side : set.sides) side.element += a.numElements();
    both.sideSets.push_back(set);
  }
  return both;
}

fem::FeModel modelOf(const fem::Mesh& mesh, const SaintVenantKirchhoff& law,
                     const PlaneSection& section = {}) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes(), mesh.dimension);
  for (const fem::Block& block : mesh.blocks) {
    // Full cubature: forces of a constant stress on a face are exact then.
    const auto cell = fem::tabulate(block.topology, 6);
    model.terms.push_back(mesh.dimension == 2
                              ? fem::lawTerm(planeLaw(fem::pointLaw(law), section.kind),
                                             planePoints(mesh, block, cell, section))
                              : fem::lawTerm(fem::pointLaw(law), fem::volumePoints(mesh, block, cell)));
  }
  model.load.assign(model.dofs.numDofs(), 0.0);
  return model;
}

/// A displacement gradient, and the first Piola-Kirchhoff stress in a plane or in space.
struct Homogeneous {
  double H[3][3] = {{0.1, 0.05, -0.03}, {-0.02, 0.07, 0.04}, {0.06, -0.05, -0.08}};
  double lambda = 100, mu = 80;
  int dim = 3;

  explicit Homogeneous(int d) : dim(d) {}
  double u(const double* X, int i) const {
    double sum = 0;
    for (int j = 0; j < dim; ++j) sum += H[i][j] * X[j];
    return sum;
  }
  /// P N, in plane strain with dim = 2.
  std::array<double, 3> traction(const std::array<double, 3>& N) const {
    double F[3][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, E[3][3], trace = 0;
    for (int i = 0; i < dim; ++i)
      for (int j = 0; j < dim; ++j) F[i][j] += H[i][j];
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) {
        E[i][j] = i == j ? -0.5 : 0;
        for (int k = 0; k < 3; ++k) E[i][j] += 0.5 * F[k][i] * F[k][j];
        trace += i == j ? E[i][j] : 0;
      }
    std::array<double, 3> t{};
    for (int i = 0; i < dim; ++i)
      for (int k = 0; k < dim; ++k)
        for (int j = 0; j < dim; ++j)
          t[i] += F[i][k] * (2 * mu * E[k][j] + (k == j ? lambda * trace : 0)) * N[j];
    return t;
  }
};

/// What is out of balance in a homogeneous state under its own tractions, relative to a force on the tied
/// surface's nodes.
double outOfBalance(const fem::Mesh& mesh, const std::string& follows, const std::string& leads) {
  const Homogeneous state(mesh.dimension);
  SaintVenantKirchhoff law;
  law.lambda = state.lambda;
  law.mu = state.mu;
  const PlaneSection section;
  fem::FeModel model = modelOf(mesh, law, section);
  const fem::Tie tie = fem::tieSurfaces(mesh, sideSet(mesh, follows), sideSet(mesh, leads));
  EXPECT_TRUE(tie.open.empty());
  EXPECT_EQ(fem::couple(model, tie, {"displacement"}), 0);
  double scale = 0;
  for (const fem::SideSet& set : mesh.sideSets) {
    const auto faces =
        mesh.dimension == 2 ? planeEdgePoints(mesh, set, section, 6) : fem::facePoints(mesh, set, 6);
    for (const fem::PointSet& p : faces)
      for (int e = 0; e < p.numEntities; ++e)
        for (int q = 0; q < p.pointsPerEntity; ++q) {
          const std::size_t at = static_cast<std::size_t>(e) * p.pointsPerEntity + q;
          const auto t = state.traction({p.normals[3 * at], p.normals[3 * at + 1], p.normals[3 * at + 2]});
          for (int a = 0; a < p.nodesPerEntity; ++a)
            for (int i = 0; i < mesh.dimension; ++i) {
              const double force = p.weights[at] * p.shapeAt(at, a, 0) * t[i];
              scale = std::max(scale, std::abs(force));
              if (set.name != follows && set.name != leads)
                model.load[model.dofs.firstDof(p.nodes[static_cast<std::size_t>(e) * p.nodesPerEntity + a]) +
                           i] += force;
            }
        }
  }
  fem::FeProblem problem(std::move(model));
  Numbers u(problem.model().dofs.numDofs());
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (int i = 0; i < mesh.dimension; ++i)
      u[mesh.dimension * n + i] = state.u(&mesh.coordinates[3 * static_cast<std::size_t>(n)], i);
  return largest(residual(problem, u, 1).r) / scale;
}

/// The nodes of the faces x_min, x_max moved within them, and what lies between.
fem::Mesh skewed(fem::Mesh mesh, double amount, int seed) {
  const auto moves = randomNumbers(mesh.coordinates.size(), amount, seed);
  for (int n = 0; n < mesh.numNodes(); ++n) {
    double* X = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    const auto inside = [&](int i) { return X[i] > 1e-9 && X[i] < 1 - 1e-9; };
    const bool y = inside(1), z = mesh.dimension == 3 && inside(2);
    if (y) X[1] += moves[3 * n + 1];
    if (z) X[2] += moves[3 * n + 2];
  }
  return mesh;
}

struct Pair {
  Topology first, second;
};

}  // namespace

// Constant stress passes through flat surfaces: all kinds of faces follow and lead.
TEST(Ties, PatchTestInSpace) {
  for (const auto& [first, second] :
       {Pair{Topology::Hex8, Topology::Hex8}, Pair{Topology::Hex20, Topology::Hex20},
        Pair{Topology::Hex27, Topology::Hex20}, Pair{Topology::Tet4, Topology::Hex8},
        Pair{Topology::Tet10, Topology::Hex20}, Pair{Topology::Hex20, Topology::Tet10},
        Pair{Topology::Wedge15, Topology::Tet10}, Pair{Topology::Hex8, Topology::Tet10},
        Pair{Topology::Wedge6, Topology::Wedge6}}) {
    // Corners inside the faces are moved; of cells with middle nodes that would curve edges.
    const double amount = 0.04;
    const auto part = [&](Topology cell, std::array<int, 3> divisions, double x, int seed) {
      const fem::Mesh mesh = box(cell, divisions, {1, 1, 1}, {x, 0, 0});
      return isQuadratic(cell) ? mesh : skewed(mesh, amount, seed);
    };
    const fem::Mesh mesh = beside(part(first, {2, 3, 2}, 0, 1), part(second, {1, 2, 3}, 1, 2));
    SCOPED_TRACE(std::string(fem::topologyName(first)) + " on " + fem::topologyName(second));
    // Rounding of sums over some hundred points; on faces that are no parallelograms functions of places are
    // no polynomials, and cubature of degree 6 leaves this.
    const double small = isQuadratic(first) ? 1e-12 : 5e-9;
    EXPECT_LT(outOfBalance(mesh, "a_x_max", "b_x_min"), small);
    EXPECT_LT(outOfBalance(mesh, "b_x_min", "a_x_max"), small);
  }
}

TEST(Ties, PatchTestInAPlane) {
  const auto rectangle = [](Topology cell, std::array<int, 2> divisions, double x) {
    fem::RectangleOptions options;
    options.topology = cell;
    options.divisions = divisions;
    options.origin = {x, 0};
    return fem::rectangleMesh(options);
  };
  for (const auto& [first, second] :
       {Pair{Topology::Quad4, Topology::Quad4}, Pair{Topology::Quad8, Topology::Tri6},
        Pair{Topology::Tri3, Topology::Quad8}, Pair{Topology::Quad9, Topology::Quad8}}) {
    const fem::Mesh mesh = beside(rectangle(first, {2, 3}, 0), rectangle(second, {1, 5}, 1));
    SCOPED_TRACE(std::string(fem::topologyName(first)) + " on " + fem::topologyName(second));
    EXPECT_LT(outOfBalance(mesh, "a_x_max", "b_x_min"), 1e-11);
    EXPECT_LT(outOfBalance(mesh, "b_x_min", "a_x_max"), 1e-11);
  }
}

// Facets of two polygons that do not meet: what turns as one body keeps to the tie, at any angle.
TEST(Ties, RigidMotionsPassAGap) {
  fem::CylinderPanelOptions inner, outer;
  inner.midRadius = 1.5;
  inner.thickness = outer.thickness = 1;
  outer.midRadius = 2.5;
  inner.topology = Topology::Hex8;
  outer.topology = Topology::Tet4;
  inner.divisions = {5, 2, 1};
  outer.divisions = {7, 3, 1};
  const fem::Mesh mesh = beside(fem::cylinderPanelMesh(inner), fem::cylinderPanelMesh(outer));
  const fem::Tie tie = fem::tieSurfaces(mesh, sideSet(mesh, "a_outer"), sideSet(mesh, "b_inner"));
  EXPECT_GT(tie.largestGap, 0.005);
  EXPECT_LT(tie.largestGap,
            2 * (1 - std::cos(0.5 * std::acos(-1.0) / 10)));  // the sagitta of the coarser facets
  EXPECT_TRUE(tie.open.empty());
  // x -> a quarter turn about z and something else about x
  const double c = std::cos(2.0), s = std::sin(2.0);
  const auto moved = [&](int n) {
    const double* X = &mesh.coordinates[3 * static_cast<std::size_t>(n)];
    const double x = -X[1], y = X[0], z = X[2];
    return std::array<double, 3>{x - X[0], c * y - s * z - X[1], s * y + c * z - X[2]};
  };
  for (const fem::TiedNode& node : tie.nodes) {
    std::array<double, 3> u{};
    for (const fem::CoupledNode& m : node.masters)
      for (int i = 0; i < 3; ++i) u[i] += m.factor * moved(m.node)[i];
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(u[i], moved(node.node)[i], 1e-12);
  }
}

namespace {

constexpr double pressure = 1e-4, young = 1000, poisson = 0.3;

/// A body of two under a pressure from inside that makes strains of 1e-7: what is not linear is beyond the
/// errors. Displacements are along the radius, in the plane of x and z with `axis` 1, of x and y with 2.
struct Vessel {
  fem::Mesh mesh;
  PlaneSection section;
  int axis = 2;
  std::vector<std::array<int, 2>> planes;  ///< of symmetry: x_i = 0 holds u_j
};

/// The largest error of displacements against `exact` along the radius, relative to that inside.
double errorOf(const Vessel& vessel, const std::function<double(double)>& exact) {
  const fem::Mesh& mesh = vessel.mesh;
  const int dim = mesh.dimension;
  fem::FeModel model = modelOf(mesh, SaintVenantKirchhoff::fromYoung(young, poisson), vessel.section);
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (const auto& [i, j] : vessel.planes)
      if (i < 0 || std::abs(mesh.coordinates[3 * n + i]) < 1e-9) model.prescribe(n, j, 0, 0);
  const fem::SideSet& inside = sideSet(mesh, "a_inner");
  std::vector<double> force(mesh.coordinates.size(), 0.0);
  fem::addPressure(
      dim == 2 ? planeEdgePoints(mesh, inside, vessel.section, 6) : fem::facePoints(mesh, inside, 6),
      pressure, force);
  model.load = model.dofs.fromVectors(force);
  fem::TieOptions options;
  options.axisymmetric = vessel.section.kind == Kind::axisymmetric;
  const fem::Tie tie = fem::tieSurfaces(mesh, sideSet(mesh, "a_outer"), sideSet(mesh, "b_inner"), options);
  EXPECT_TRUE(tie.open.empty());
  fem::couple(model, tie, {"displacement"});
  fem::FeProblem problem(std::move(model));
  const Numbers u = equilibrium(problem, 1, Numbers(dim * mesh.numNodes(), 0.0)).u;
  double worst = 0, least = 1e9;
  for (int n = 0; n < mesh.numNodes(); ++n) {
    std::array<double, 3> X{};
    for (int i = 0; i < 3; ++i) X[i] = i == vessel.axis ? 0 : mesh.coordinates[3 * n + i];
    const double r = std::hypot(X[0], X[1], X[2]);
    least = std::min(least, r);
    for (int i = 0; i < dim; ++i) worst = std::max(worst, std::abs(u[dim * n + i] - exact(r) * X[i] / r));
  }
  return worst / exact(least);
}

/// Errors on meshes halved twice: the last one and the order.
void expectOrder(const std::function<Vessel(int)>& vessel, const std::function<double(double)>& exact,
                 double error, double order) {
  const double errors[] = {errorOf(vessel(1), exact), errorOf(vessel(2), exact), errorOf(vessel(4), exact)};
  EXPECT_LT(errors[2], error);
  EXPECT_GT(std::log2(errors[1] / errors[2]), order) << errors[0] << " " << errors[1] << " " << errors[2];
}

/// Lame's tube from 1 to 3 in plane strain, and his sphere.
double tube(double r) {
  const double k = pressure / (3 * 3 - 1);
  return (1 + poisson) / young * k * ((1 - 2 * poisson) * r + 9 / r);
}
double sphere(double r) {
  const double k = pressure / (27 - 1);
  return k / young * ((1 - 2 * poisson) * r + (1 + poisson) * 27 / (2 * r * r));
}

fem::Mesh rings(Topology cell, int n) {
  fem::AnnulusOptions inside, outside;
  inside.outerRadius = outside.innerRadius = 1.7;
  outside.outerRadius = 3;
  inside.topology = outside.topology = cell;
  inside.divisions = {2 * n, 5 * n};
  outside.divisions = {3 * n, 3 * n};
  return beside(fem::annulusMesh(inside), fem::annulusMesh(outside));
}

}  // namespace

// Tubes and spheres of two whose cells do not fit, against Lame.
TEST(Ties, PlaneTubeConverges) {
  const auto vessel = [](Topology cell) {
    return [cell](int n) { return Vessel{rings(cell, n), {}, 2, {{0, 0}, {1, 1}}}; };
  };
  expectOrder(vessel(Topology::Quad4), tube, 5e-3, 1.7);
  expectOrder(vessel(Topology::Quad8), tube, 2e-5, 2.7);
}

TEST(Ties, SphereConverges) {
  const auto vessel = [](Topology cell) {
    return [cell](int n) { return Vessel{rings(cell, n), {Kind::axisymmetric}, 2, {{0, 0}, {1, 1}}}; };
  };
  expectOrder(vessel(Topology::Quad4), sphere, 1e-2, 1.7);
  expectOrder(vessel(Topology::Quad8), sphere, 2e-5, 2.7);
}

TEST(Ties, TubeInSpaceConverges) {
  const auto vessel = [](Topology cell) {
    return [cell](int n) {
      fem::CylinderPanelOptions inside, outside;
      inside.midRadius = 1.35;
      inside.thickness = 0.7;
      outside.midRadius = 2.35;
      outside.thickness = 1.3;
      inside.length = outside.length = 0.5;
      inside.topology = outside.topology = cell;
      inside.divisions = {5 * n, 3, 2 * n};
      outside.divisions = {3 * n, 2, 3 * n};
      return Vessel{beside(fem::cylinderPanelMesh(inside), fem::cylinderPanelMesh(outside)),
                    {},
                    1,
                    {{0, 0}, {2, 2}, {-1, 1}}};
    };
  };
  expectOrder(vessel(Topology::Hex8), tube, 5e-3, 1.7);
  // Faces of eight nodes have no dual functions that make a stress that varies linearly.
  expectOrder(vessel(Topology::Hex20), tube, 5e-5, 1.7);
}

// A small block stands in the middle of a wide one. Where the wide one's nodes follow, those beside the block
// stay free, and the faces that it covers in part are tied by their nodes; the other way round all of the
// small one's do. A pull of both goes through.
TEST(Ties, NodesWithNothingOppositeStayFree) {
  const fem::Mesh mesh = beside(box(Topology::Hex8, {4, 4, 1}, {1, 1, 0.5}),
                                box(Topology::Hex8, {3, 3, 1}, {0.6, 0.6, 0.5}, {0.2, 0.2, 0.5}));
  const fem::Tie wide = fem::tieSurfaces(mesh, sideSet(mesh, "a_z_max"), sideSet(mesh, "b_z_min")),
                 small = fem::tieSurfaces(mesh, sideSet(mesh, "b_z_min"), sideSet(mesh, "a_z_max"));
  EXPECT_EQ(wide.nodes.size(), 9u);  // at 0.25, 0.5, 0.75
  EXPECT_EQ(wide.open.size(), 16u);
  EXPECT_EQ(small.nodes.size(), 16u);
  EXPECT_TRUE(small.open.empty());
  double pulled[2];
  for (const bool wideFollows : {true, false}) {
    fem::FeModel model = modelOf(mesh, SaintVenantKirchhoff::fromYoung(1, 0.3));
    for (const int n : fem::nodesOf(mesh, sideSet(mesh, "a_z_min")))
      for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, 0);
    for (const int n : fem::nodesOf(mesh, sideSet(mesh, "b_z_max"))) model.prescribe(n, 2, 0.01, 0);
    fem::couple(model, wideFollows ? wide : small, {"displacement"});
    fem::FeProblem problem(std::move(model));
    const auto state = equilibrium(problem, 1, Numbers(problem.model().dofs.numDofs(), 0.0));
    EXPECT_EQ(state.inertia->negative, 0);
    const Numbers forces = problem.reactions({vectorOf(problem, state.u), 1.0});
    double below = 0, above = 0;
    for (const int n : fem::nodesOf(mesh, sideSet(mesh, "a_z_min"))) below += forces[3 * n + 2];
    for (const int n : fem::nodesOf(mesh, sideSet(mesh, "b_z_max"))) above += forces[3 * n + 2];
    EXPECT_NEAR(below + above, 0, 1e-12 * above);
    pulled[wideFollows] = above;
  }
  EXPECT_GT(pulled[0], 0);
  EXPECT_NEAR(pulled[1] / pulled[0], 1, 0.1);  // nine nodes hold less than the whole face
}

TEST(Ties, WhatCannotBeIsNamed) {
  const auto refusal = [](const fem::Mesh& mesh, const char* follows, const char* leads, double reach) {
    fem::TieOptions options;
    options.reach = reach;
    try {
      fem::tieSurfaces(mesh, sideSet(mesh, follows), sideSet(mesh, leads), options);
    } catch (const std::invalid_argument& error) {
      return std::string(error.what());
    }
    return std::string("nothing thrown");
  };
  const fem::Mesh apart =
      beside(box(Topology::Hex8, {1, 1, 1}), box(Topology::Hex8, {2, 1, 1}, {1, 1, 1}, {1.2, 0, 0}));
  EXPECT_EQ(refusal(apart, "a_x_max", "b_x_min", 0.1),
            "no node of the surface that follows has the other one opposite, within 0.1 of the faces' size");
  EXPECT_EQ(refusal(apart, "a_x_max", "b_x_min", 0.3), "nothing thrown");
  EXPECT_EQ(refusal(apart, "a_x_max", "a_y_max", 0.1),
            "node 7 is on both surfaces: those that share nodes there are one already");
}
