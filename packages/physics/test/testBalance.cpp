// Balances of scalar fields by formulas: patch test, manufactured solutions, derivatives.
#include <gtest/gtest.h>

#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/formula/Builder.hpp"
#include "atrapos/physics/Balance.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::physics;
using namespace atrapos::fem::test;
using fem::Topology;
using Kind = solid::PlaneSection::Kind;
using Plane = std::optional<solid::PlaneSection>;

namespace {

const std::vector<Topology> planeCells{Topology::Quad4, Topology::Quad8, Topology::Quad9, Topology::Tri3,
                                       Topology::Tri6};

fem::Mesh square(Topology cell, int divisions, double x0 = 0) {
  fem::RectangleOptions options;
  options.topology = cell;
  options.divisions = {divisions, divisions};
  options.origin = {x0, 0};
  return fem::rectangleMesh(options);
}

fem::FeModel modelOf(const fem::Mesh& mesh, const std::vector<std::string>& fields,
                     const std::vector<Balance>& balances, const Constants& constants, const Plane& plane) {
  fem::FeModel model;
  std::vector<fem::DofMap::Located> located;
  for (const std::string& name : fields) located.push_back({scalarField(name), {}});
  model.dofs = fem::DofMap(mesh.numNodes(), located);
  for (const fem::Block& block : mesh.blocks)
    model.terms.push_back(balanceTerm(mesh, block, fields, balances, constants, plane));
  return model;
}

std::vector<int> boundary(const fem::Mesh& mesh) {
  std::vector<char> seen(mesh.numNodes(), 0);
  std::vector<int> nodes;
  for (const fem::SideSet& set : mesh.sideSets)
    for (const int n : fem::nodesOf(mesh, set))
      if (!seen[n]++) nodes.push_back(n);
  return nodes;
}

using Exact = std::function<double(const double*)>;

/// The largest error at a node of the solution at load factor 1 with boundary values from `exact`.
double errorOf(const fem::Mesh& mesh, fem::FeModel model, const std::vector<std::string>& fields,
               const std::vector<Exact>& exact) {
  const std::size_t F = fields.size();
  Numbers start(model.dofs.numDofs());
  for (int n = 0; n < mesh.numNodes(); ++n)
    for (std::size_t f = 0; f < F; ++f) start[F * n + f] = exact[f](&mesh.coordinates[3 * n]);
  for (const int n : boundary(mesh))
    for (std::size_t f = 0; f < F; ++f) model.prescribe(n, 0, start[F * n + f], 0, fields[f]);
  fem::FeProblem problem(std::move(model));
  const Numbers u = equilibrium(problem, 1, start, 1e-10).u;
  return largest(sum(u, -1, start));
}

bool isQuadraticPlane(Topology cell) {
  return cell == Topology::Quad8 || cell == Topology::Quad9 || cell == Topology::Tri6;
}

}  // namespace

TEST(Balance, NamesAreChecked) {
  EXPECT_TRUE(isFreeName("T"));
  for (const char* name : {"lambda", "x", "z", "exp", "2T", ""}) EXPECT_FALSE(isFreeName(name)) << name;
  const Constants constants{{"k", 2.0}};
  checkFormula("k*(1 + T)*dot(grad(T), grad(V))", {"T", "V"}, constants, Place::body);
  EXPECT_THROW(checkFormula("dot(grad(T), grad(T))", {"T"}, constants, Place::surface),
               formula::FormulaError);
  EXPECT_THROW(checkFormula("T", {"T"}, constants, Place::reference), formula::FormulaError);
  EXPECT_THROW(checkFormula("S", {"T"}, constants, Place::body), formula::FormulaError);
  EXPECT_TRUE(dependsOnLoadFactor("k*lambda + T", {"T"}, constants, Place::surface));
  EXPECT_FALSE(dependsOnLoadFactor("k + 0*lambda", {"T"}, constants, Place::body));
  const double place[] = {1, 2, 3};
  EXPECT_EQ(ofPlace("k*x + y*z", constants)(place), 8);
}

/// A linear field is a solution whatever the mesh and the constant conductivity, and what flows through a
/// side is the conductivity times the slope: prescribed there it gives the field itself.
TEST(Balance, PatchTest) {
  const auto field = [](const double* x) { return 3 + 2 * x[0] - 0.5 * x[1] + x[2]; };
  const auto check = [&](const fem::Mesh& mesh, const Plane& plane, const std::string& inflow) {
    fem::FeModel model = modelOf(mesh, {"T"}, {{"T", "k", "0"}}, {{"k", 4.0}}, plane);
    for (auto& term : inflowTerms(mesh, sideSet(mesh, "x_max"), {"T"}, {{"T", inflow}}, {{"k", 4.0}}, plane))
      model.terms.push_back(std::move(term));
    Numbers expected(mesh.numNodes());
    std::vector<char> free(mesh.numNodes(), 0);
    for (const int n : nodesOfSet(mesh, "x_max")) free[n] = 1;
    for (const fem::SideSet& set : mesh.sideSets)
      if (set.name != "x_max")
        for (const int n : fem::nodesOf(mesh, set)) free[n] = 0;
    for (int n = 0; n < mesh.numNodes(); ++n) expected[n] = field(&mesh.coordinates[3 * n]);
    for (const int n : boundary(mesh))
      if (!free[n]) model.prescribe(n, 0, expected[n], 0, "T");
    fem::FeProblem problem(std::move(model));
    const Numbers u = equilibrium(problem, 1, Numbers(mesh.numNodes(), 0.0), 1e-9).u;
    EXPECT_LT(largest(sum(u, -1, expected)), 1e-13);  // rounding of a few thousand operations on numbers of 6
  };
  for (const Topology cell : planeCells)
    check(square(cell, 3), solid::PlaneSection{Kind::strain, 0.3}, "2*k + lambda*(T - 5 + 0.5*y)");
  for (const Topology cell : allCells()) check(box(cell), {}, "2*k + lambda*(T - 5 + 0.5*y - z)");
}

/// -div((1 + u w/2) grad u) = s, -div((1 + lambda^2) grad w) = ..., both coupled by products and a gradient:
/// u = sin(x + 2 y) , w = cos(x - y), sources from them by hand.
TEST(Balance, ConvergesAtTheOrderOfTheCell) {
  const Exact u = [](const double* x) { return std::sin(x[0] + 2 * x[1]); };
  const Exact w = [](const double* x) { return std::cos(x[0] - x[1]); };
  // div(k grad u) with k = 1 + u w/2: k lap u + grad k . grad u; grad u = c (1, 2), c = cos(x + 2 y);
  // grad w = -sin(x - y) (1, -1).
  const std::string U = "sin(x + 2*y)", W = "cos(x - y)", c = "cos(x + 2*y)", d = "sin(x - y)";
  const std::string slope = "(0.5*" + W + "*5*" + c + "^2 + 0.5*" + U + "*" + d + "*" + c + ")";
  const std::string sourceU = "5*(1 + 0.5*" + U + "*" + W + ")*" + U + " - " + slope;
  // w: -(1 + lambda^2) lap w + dot(grad u, grad w) = 2 (1 + lambda^2) w + c d (-1 + 2)
  const std::string sourceW =
      "2*(1 + lambda^2)*" + W + " + " + c + "*" + d + " - dot(grad(u), grad(w)) + (u - " + U + ")*w";
  const std::vector<Balance> balances{{"u", "1 + 0.5*u*w", sourceU}, {"w", "1 + lambda^2", sourceW}};
  for (const Topology cell : planeCells) {
    const int p = isQuadraticPlane(cell) ? 2 : 1, n = p == 1 ? 8 : 4;
    const auto error = [&](int divisions) {
      const fem::Mesh mesh = square(cell, divisions);
      return errorOf(mesh, modelOf(mesh, {"u", "w"}, balances, {}, solid::PlaneSection{Kind::strain, 1}),
                     {"u", "w"}, {u, w});
    };
    const double coarse = error(n), fine = error(2 * n), rate = std::log2(coarse / fine);
    // Of the largest nodal error on regular meshes: p + 1, and p + 2 where the nodes of quadratic cells do
    // better.
    EXPECT_GT(rate, p + 1 - 0.15) << fem::topologyName(cell) << ": " << coarse << " " << fine;
    EXPECT_LT(fine, p == 1 ? 2e-3 : 1e-4) << fem::topologyName(cell);
  }
}

TEST(Balance, ConvergesInSpace) {
  const Exact u = [](const double* x) { return std::exp(0.5 * x[0]) * std::sin(x[1] + x[2]); };
  // lap u = (1/4 - 2) u; k = 1 + u^2: div = (1 + u^2) lap u + 2 u |grad u|^2
  const std::string U = "exp(0.5*x)*sin(y + z)";
  const std::string gradient = "exp(x)*(0.25*sin(y + z)^2 + 2*cos(y + z)^2)";
  const std::vector<Balance> balances{{"u", "1 + u^2", "1.75*(1 + u^2)*" + U + " - 2*" + U + "*" + gradient}};
  for (const Topology cell : allCells()) {
    const int p = isQuadratic(cell) ? 2 : 1, n = p == 1 ? 4 : 2;
    const auto error = [&](int divisions) {
      const fem::Mesh mesh = box(cell, {divisions, divisions, divisions});
      return errorOf(mesh, modelOf(mesh, {"u"}, balances, {}, {}), {"u"}, {u});
    };
    const double coarse = error(n), fine = error(2 * n);
    EXPECT_GT(std::log2(coarse / fine), p + 1 - 0.35)
        << fem::topologyName(cell) << ": " << coarse << " " << fine;
  }
}

/// Between cylinders of radius 1 and 2 the temperature is ln r; per radian and length the heat flow is 1.
TEST(Balance, RingsHaveTheirRadius) {
  const Exact T = [](const double* x) { return std::log(x[0]); };
  const auto error = [&](int divisions) {
    const fem::Mesh mesh = square(Topology::Quad8, divisions, 1);
    return errorOf(mesh,
                   modelOf(mesh, {"T"}, {{"T", "1", "0"}}, {}, solid::PlaneSection{Kind::axisymmetric, 1}),
                   {"T"}, {T});
  };
  const double coarse = error(4), fine = error(8);
  EXPECT_GT(std::log2(coarse / fine), 3 - 0.15);
  EXPECT_LT(fine, 1e-5);
}

/// Several balances of one field add up.
TEST(Balance, PartsAddUp) {
  const fem::Mesh mesh = square(Topology::Quad4, 3);
  const Plane plane = solid::PlaneSection{Kind::strain, 1};
  const Numbers u = randomNumbers(2 * mesh.numNodes(), 0.5, 3);
  fem::FeProblem whole(
      modelOf(mesh, {"a", "b"}, {{"a", "2 + a", "exp(b)"}, {"b", "1", "lambda"}}, {}, plane));
  fem::FeProblem parts(
      modelOf(mesh, {"a", "b"}, {{"a", "2", "0"}, {"b", "1", "lambda"}, {"a", "a", "exp(b)"}}, {}, plane));
  EXPECT_LT(largest(sum(residual(whole, u, 0.7).r, -1, residual(parts, u, 0.7).r)), 1e-14);
}

TEST(Balance, SymmetryIsKnown) {
  const fem::Mesh mesh = square(Topology::Quad4, 2);
  const Plane plane = solid::PlaneSection{Kind::strain, 1};
  const auto symmetric = [&](const std::vector<std::string>& fields, const std::vector<Balance>& balances) {
    return balanceTerm(mesh, mesh.blocks[0], fields, balances, {}, plane)->symmetric();
  };
  EXPECT_TRUE(symmetric({"u"}, {{"u", "1 + x*lambda", "lambda*exp(u)"}}));
  EXPECT_FALSE(symmetric({"u"}, {{"u", "1 + u", "1"}}));
  EXPECT_FALSE(symmetric({"u"}, {{"u", "1", "dot(grad(u), grad(u))"}}));
  EXPECT_TRUE(symmetric({"u", "w"}, {{"u", "1", "u^2"}, {"w", "2", "w"}}));
  EXPECT_FALSE(symmetric({"u", "w"}, {{"u", "1", "w"}, {"w", "2", "w"}}));
}

/// Tangent against differences, orders against the residual along the series, with 1 to 4 fields, in planes,
/// rings and space, in volume and on sides.
TEST(Balance, TangentAndOrders) {
  const std::vector<std::string> all{"a", "b", "c", "d"};
  const std::vector<std::string> sources{"lambda*exp(a)", "b*dot(grad(a), grad(b)) - lambda",
                                         "sin(c + a)/(1.5 + b)", "sqrt(2 + d*c) + x*lambda"};
  const std::vector<std::string> conductivities{"1 + 0.5*a^2", "exp(0.3*a)", "2 + tanh(b)", "1 + x"};
  for (int count = 1; count <= 4; ++count)
    for (int shape = 0; shape < 3; ++shape) {
      SCOPED_TRACE(std::to_string(count) + " fields, shape " + std::to_string(shape));
      const fem::Mesh mesh = shape == 2 ? box(Topology::Hex8, {2, 2, 1}) : square(Topology::Quad8, 2, 1);
      const Plane plane = shape == 2   ? Plane{}
                          : shape == 1 ? Plane{solid::PlaneSection{Kind::axisymmetric, 1}}
                                       : Plane{solid::PlaneSection{Kind::strain, 0.5}};
      const std::vector<std::string> fields(all.begin(), all.begin() + count);
      const auto model = [&] {
        std::vector<Balance> balances;
        std::vector<Inflow> inflows;
        for (int f = 0; f < count; ++f) {
          balances.push_back({fields[f], conductivities[f], sources[f]});
          inflows.push_back({fields[f], "0.3*lambda*(2 - " + fields[f] + "^4)*cos(a)"});
        }
        fem::FeModel m = modelOf(mesh, fields, balances, {}, plane);
        for (auto& term : inflowTerms(mesh, sideSet(mesh, "y_max"), fields, inflows, {}, plane))
          m.terms.push_back(std::move(term));
        for (const int n : nodesOfSet(mesh, "x_min"))
          for (const std::string& field : fields) m.prescribe(n, 0, 0.1, 0.2, field);
        return m;
      };
      checkTangent(model());
      checkOrders(model());
    }
}

/// w . M v = int c w v dV of each field, where w and v are fields that the cells have: in space, planes and
/// rings, with capacities of the fields themselves. Nothing in the rows and columns of supports.
TEST(Balance, CapacitiesAreStored) {
  for (int shape = 0; shape < 3; ++shape) {
    SCOPED_TRACE(shape);
    const fem::Mesh mesh = shape == 2 ? box(Topology::Hex20, {2, 2, 1}) : square(Topology::Quad9, 2, 1);
    const Plane plane = shape == 2   ? Plane{}
                        : shape == 1 ? Plane{solid::PlaneSection{Kind::axisymmetric, 1}}
                                     : Plane{solid::PlaneSection{Kind::strain, 0.5}};
    fem::FeModel model =
        modelOf(mesh, {"a", "b", "d"},
                {{"a", "1", "0", "2*(1 + b)"}, {"b", "1", "lambda"}, {"b", "0", "a"}, {"d", "1", "b", "0"}},
                {}, plane);
    const fem::DofMap dofs = model.dofs;
    Numbers ones[3], u(dofs.numDofs());
    for (int f = 0; f < 3; ++f) {
      ones[f].assign(dofs.numDofs(), 0);
      for (int n = 0; n < mesh.numNodes(); ++n) ones[f][dofs.dof(f, n, 0)] = 1;
    }
    for (int n = 0; n < mesh.numNodes(); ++n) u[dofs.dof(1, n, 0)] = mesh.coordinates[3 * n + 1];  // b = y
    const auto product = [](const path::CrsMatrix& M, const Numbers& w, const Numbers& v) {
      path::Vector x(M.getDomainMap()), y(M.getRangeMap());
      for (std::size_t i = 0; i < v.size(); ++i) x.replaceLocalValue(static_cast<int>(i), v[i]);
      M.apply(x, y);
      double total = 0;
      for (std::size_t i = 0; i < w.size(); ++i) total += w[i] * y.getData()[static_cast<int>(i)];
      return total;
    };
    fem::FeProblem problem(std::move(model));
    const auto state = [&] {
      auto vector = Teuchos::rcp(new path::Vector(problem.map()));
      for (std::size_t i = 0; i < u.size(); ++i) vector->replaceLocalValue(static_cast<int>(i), u[i]);
      return path::State{vector, 0.3};
    }();
    const auto M = problem.mass(state);
    ASSERT_FALSE(M.is_null());
    // The cells are those of [1, 2] x [0, 1] (of the box [0, 1]^3), half as thick, or once around the axis.
    const double volume = shape == 0 ? 0.5 : shape == 1 ? 3 * std::acos(-1.0) : 1;
    EXPECT_NEAR(product(*M, ones[0], ones[0]), 3 * volume, 1e-12 * volume);  // 2 (1 + y), 3 in the mean
    EXPECT_NEAR(product(*M, ones[1], ones[1]), volume, 1e-12 * volume);      // not said: 1
    EXPECT_EQ(product(*M, ones[2], ones[2]), 0);                             // said to be 0
    EXPECT_EQ(product(*M, ones[0], ones[1]), 0);
    EXPECT_NEAR(product(*M, ones[1], u), 0.5 * volume, 1e-12 * volume);
  }
  const fem::Mesh mesh = square(Topology::Quad4, 2);
  fem::FeModel held = modelOf(mesh, {"a"}, {{"a", "1", "1"}}, {}, solid::PlaneSection{Kind::strain, 1});
  for (const int n : boundary(mesh)) held.prescribe(n, 0, 0, 1, "a");
  fem::FeProblem problem(std::move(held));
  const auto M = problem.mass({problem.initialState(0), 0});
  // One node is free: the square of its shape function over four cells of 1/4, 4 (1/4) (1/3)^2.
  EXPECT_NEAR(M->getFrobeniusNorm(), 1.0 / 9, 1e-15);
}

TEST(Balance, TooManyFieldsAreRefused) {
  const fem::Mesh mesh = square(Topology::Quad4, 1);
  EXPECT_THROW(balanceTerm(mesh, mesh.blocks[0], {"a", "b", "c", "d", "e"}, {}, {},
                           solid::PlaneSection{Kind::strain, 1}),
               std::invalid_argument);
}
