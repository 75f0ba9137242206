// What flows into a body through its contact with a tool, by a formula of the contact's pressure and gap.
#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "atrapos/contact/PatchSet.hpp"
#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/physics/Balance.hpp"
#include "atrapos/physics/FieldTerm.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::physics;
using namespace atrapos::fem::test;
using fem::Topology;

namespace {

// Soft: its branch points, 2 sqrt(eta Delta/alpha) away, are far beyond differences and series here.
const contact::RegularisedPressure pressure{1, 1};
const double reference = 0.5;

/// Displacements and these fields at all nodes.
fem::DofMap dofsOf(const fem::Mesh& mesh, int dimension, const std::vector<std::string>& fields) {
  std::vector<fem::DofMap::Located> located{{fem::displacementField(dimension), {}}};
  for (const std::string& name : fields) located.push_back({scalarField(name), {}});
  return fem::DofMap(mesh.numNodes(), located);
}

fem::PointSet withFields(fem::PointSet points, const std::vector<std::string>& fields) {
  for (const std::string& field : fields) points.more.push_back(mapsOf(field, points));
  return points;
}

/// The first of the fields flows.
std::unique_ptr<fem::Term> passage(const contact::RigidTool& tool, const fem::PointSet& places,
                                   const std::vector<std::string>& fields, const std::string& amount) {
  const std::vector<double> gaps(places.numPoints(), reference);
  return tool.passage(contact::AnyPressure(pressure), withFields(places, fields), gaps,
                      {contactInflow(amount, fields, {{"c", 0.3}}), 0});
}

/// A block of `count` fields whose lower face a tool touches; its top is held.
fem::FeModel block(const contact::RigidTool& tool, int count) {
  const std::vector<std::string> all{"a", "b", "d"};
  const std::vector<std::string> fields(all.begin(), all.begin() + count);
  const fem::Mesh mesh = distorted(box(Topology::Hex8, {2, 2, 1}), 0.02);
  fem::FeModel model;
  model.dofs = dofsOf(mesh, 3, fields);
  model.terms.push_back(fem::lawTerm(fem::pointLaw(solid::SaintVenantKirchhoff::fromYoung(10, 0.3)),
                                     fem::volumePoints(mesh, mesh.blocks[0], fem::tabulate(Topology::Hex8))));
  std::vector<Balance> balances;
  for (const std::string& field : fields) balances.push_back({field, "1", "0"});
  model.terms.push_back(balanceTerm(mesh, mesh.blocks[0], fields, balances, {}, {}));
  const auto points = fem::facePoints(mesh, sideSet(mesh, "z_min"), 3)[0];
  model.terms.push_back(
      tool.term(contact::AnyPressure(pressure), points, std::vector<double>(points.numPoints(), reference)));
  const std::string amount = count == 1 ? "(1 + c*contact_pressure^2)*(2*lambda - a)"
                                        : "(contact_pressure + c*x)*exp(-contact_gap)*(2*lambda - a*b)";
  model.terms.push_back(passage(tool, points, fields, amount));
  for (const int n : nodesOfSet(mesh, "z_max")) {
    for (int i = 0; i < 3; ++i) model.prescribe(n, i, 0, i == 2 ? -0.05 : 0.02);
    for (const std::string& field : fields) model.prescribe(n, 0, 0.1, 0.2, field);
  }
  return model;
}

const contact::Cylinder& roll() {
  static const contact::Cylinder cylinder{{0.4, 0, -2.06}, {0.28, 0.96, 0}, 2.0};
  return cylinder;
}

/// A flat patch below the block, as far as x = `end`.
contact::BezierPatch floorTo(double end) {
  contact::BezierPatch patch;
  patch.degree = {1, 1};
  for (const double x : {-1.0, end})
    for (const double y : {-1.0, 2.0}) patch.points.push_back({x, y, -0.05});
  return patch;
}

}  // namespace

TEST(ContactInflow, TangentsAndOrders) {
  const auto tool = contact::rigidTool(roll());
  for (int count = 1; count <= 3; ++count) {
    SCOPED_TRACE(count);
    checkTangent(block(*tool, count));
    checkOrders(block(*tool, count));
  }
}

TEST(ContactInflow, OnAToolThatMoves) {
  contact::Motion motion;
  motion.shift[1][0] = 0.03;
  motion.shift[1][2] = 0.1;
  motion.angle[1] = 0.2;
  motion.axis[1] = 1;
  motion.axis[2] = 0;
  const auto tool = contact::rigidTool(roll(), motion);
  checkTangent(block(*tool, 2));
  checkOrders(block(*tool, 2));
}

TEST(ContactInflow, OnPatches) {
  const auto patches = std::make_shared<contact::PatchSet>(std::vector{floorTo(2)});
  const auto tool = contact::rigidTool(patches);
  checkTangent(block(*tool, 2));
  checkOrders(block(*tool, 2));
}

/// Under a pressure that is the same everywhere: amount times area, in a ring once around; nothing where a
/// point is over no part of the tool.
TEST(ContactInflow, AmountTimesArea) {
  fem::RectangleOptions options;
  options.topology = Topology::Quad8;
  options.divisions = {3, 1};
  options.origin = {1, 0};
  const fem::Mesh mesh = fem::rectangleMesh(options);
  const double gap = 0.05;
  contact::Plane plane;
  plane.point[1] = -gap;
  plane.normal[1] = 1;
  plane.normal[2] = 0;
  // R (c R + h) = eta (Delta - h)
  const double c = pressure.compliance;
  const double R = (std::sqrt(gap * gap + 4 * c * pressure.eta * (reference - gap)) - gap) / (2 * c);
  ASSERT_GT(R, 0.1);
  const double amount = (1 + 0.3 * R + gap) * 5;
  const auto inflow = [](const fem::Mesh& of, int dimension, std::unique_ptr<fem::Term> term) {
    fem::FeModel model;
    model.dofs = dofsOf(of, dimension, {"a"});
    const fem::DofMap dofs = model.dofs;
    const std::set<int> nodes(term->nodes().begin(), term->nodes().end());
    model.terms.push_back(std::move(term));
    fem::FeProblem problem(std::move(model));
    Numbers u(dofs.numDofs(), 0.0);
    for (int n = 0; n < of.numNodes(); ++n) u[dofs.dof(1, n, 0)] = -3;
    const Numbers r = residual(problem, u, 2).r;
    double flows = 0, forces = 0;
    for (const int n : nodes) {
      flows -= r[dofs.dof(1, n, 0)];
      for (int i = 0; i < dimension; ++i) forces += std::abs(r[dofs.dof(0, n, i)]);
    }
    EXPECT_EQ(forces, 0);
    return flows;
  };
  const std::string formula = "(1 + c*contact_pressure + contact_gap)*(lambda - a)";
  const auto tool = contact::rigidTool(plane);
  using Kind = solid::PlaneSection::Kind;
  for (const Kind kind : {Kind::strain, Kind::axisymmetric}) {
    const solid::PlaneSection section{kind, 0.5};
    const auto points = solid::planeEdgePoints(mesh, sideSet(mesh, "y_min"), section, 4)[0];
    const double area = kind == Kind::strain ? 0.5 : 3 * std::acos(-1.0);
    EXPECT_NEAR(inflow(mesh, 2, passage(*tool, points, {"a"}, formula)), amount * area,
                1e-13 * amount * area);
  }
  const fem::Mesh solid = box(Topology::Hex8, {2, 1, 1});
  const auto points = fem::facePoints(solid, sideSet(solid, "z_min"), 3)[0];
  for (const double end : {2.0, 0.5}) {  // under all of it, under one of two elements
    const auto floor = contact::rigidTool(std::make_shared<contact::PatchSet>(std::vector{floorTo(end)}));
    EXPECT_NEAR(inflow(solid, 3, passage(*floor, points, {"a"}, formula)), amount * std::min(1.0, end),
                1e-12 * amount);
  }
}

TEST(ContactInflow, WhatIsRefused) {
  EXPECT_THROW(contactInflow("b", {"a"}, {}), formula::FormulaError);
  EXPECT_THROW(contactInflow("a", {"a", "b", "d", "e", "f"}, {}), std::invalid_argument);
  EXPECT_FALSE(isFreeName("contact_pressure"));
  EXPECT_FALSE(isFreeName("contact_gap"));
  EXPECT_THROW(checkFormula("contact_gap", {"a"}, {}, Place::surface), formula::FormulaError);
}
