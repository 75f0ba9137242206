#include <gtest/gtest.h>

#include <stdexcept>

#include "atrapos/fem/StructuredShell.hpp"
#include "atrapos/fem/Support.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

struct Case {
  Mesh mesh = box(Topology::Hex20, {2, 1, 1}, {4, 1, 1});
  DofMap dofs = DofMap::displacements(mesh.numNodes());
  Supports supports;
  std::vector<HeldDirection> held;

  void hold(const std::string& set, std::vector<int> components = {0, 1, 2}) {
    for (int n : nodesOfSet(mesh, set))
      for (int c : components) supports.prescribe(dofs.firstDof(n) + c, 0, 0);
  }
  void touch(const std::string& set, std::array<double, 3> d) {
    for (int n : nodesOfSet(mesh, set)) held.push_back({n, {d[0], d[1], d[2]}});
  }
  /// Motions left of the only body; 0 where it is held.
  int motions() const {
    const auto bodies = freeBodies(mesh, dofs, supports, held);
    EXPECT_LE(bodies.size(), 1u);
    return bodies.empty() ? 0 : bodies[0].motions;
  }
};

}  // namespace

TEST(FreeBodies, MotionsLeft) {
  Case none;
  EXPECT_EQ(none.motions(), 6);
  EXPECT_EQ(freeBodies(none.mesh, none.dofs, none.supports, {})[0].block, "HEX20");

  Case clamped;
  clamped.hold("x_min");
  EXPECT_EQ(clamped.motions(), 0);

  Case point;
  point.hold("x_min_y_min_z_min");
  EXPECT_EQ(point.motions(), 3);

  Case hinge;
  hinge.hold("x_min_z_min");
  EXPECT_EQ(hinge.motions(), 1);

  Case symmetry;  // the three planes of an eighth of a body
  symmetry.hold("x_min", {0});
  symmetry.hold("y_min", {1});
  symmetry.hold("z_min", {2});
  EXPECT_EQ(symmetry.motions(), 0);

  Case sliding;  // on a plane: two translations and the spin remain
  sliding.hold("z_min", {2});
  EXPECT_EQ(sliding.motions(), 3);

  Case sixForces;  // the least that can hold a body: three, two and one component at three corners
  sixForces.hold("x_min_y_min_z_min");
  sixForces.hold("x_max_y_min_z_min", {1, 2});
  sixForces.hold("x_min_y_max_z_min", {2});
  EXPECT_EQ(sixForces.motions(), 0);
}

TEST(FreeBodies, ContactHolds) {
  Case onTable;
  onTable.hold("x_min", {0});
  onTable.hold("y_min", {1});
  EXPECT_EQ(onTable.motions(), 1);
  onTable.touch("x_max_y_max_z_min", {0, 0, 1});
  EXPECT_EQ(onTable.motions(), 0);

  Case oblique;  // the direction counts, not the axis: this one does not stop the hinge's turn
  oblique.hold("x_min_z_min");
  oblique.touch("x_max_z_min", {1, 0, 0});
  EXPECT_EQ(oblique.motions(), 1);
  oblique.touch("x_max_z_min", {0.6, 0, 0.8});
  EXPECT_EQ(oblique.motions(), 0);
}

// A strip a thousand times longer than thick, clamped at its thin end: held, although rounding is near.
TEST(FreeBodies, ThinStripClampedAtItsEnd) {
  Case strip;
  strip.mesh = box(Topology::Hex8, {10, 1, 1}, {1000, 20, 1});
  strip.dofs = DofMap::displacements(strip.mesh.numNodes());
  strip.hold("x_min");
  EXPECT_EQ(strip.motions(), 0);
}

TEST(FreeBodies, EachBodyIsJudgedByItself) {
  const Mesh mesh = mixedMesh();  // five bodies of seven blocks, and two loose nodes that are none
  const DofMap dofs = DofMap::displacements(mesh.numNodes());
  Supports supports;
  auto bodies = freeBodies(mesh, dofs, supports, {});
  ASSERT_EQ(bodies.size(), 5u);
  for (const auto& body : bodies) EXPECT_EQ(body.motions, 6);

  for (int n = 0; n < mesh.numNodes(); ++n)
    if (mesh.coordinates[3 * n] < 0.1 && mesh.coordinates[3 * n + 1] < 5)
      for (int c = 0; c < 3; ++c) supports.prescribe(3 * n + c, 0, 0);
  bodies = freeBodies(mesh, dofs, supports, {});
  ASSERT_EQ(bodies.size(), 2u);
  EXPECT_EQ(bodies[0].block, "TET10");
  EXPECT_EQ(bodies[1].block, "HEX27");
}

TEST(Supports, AskedAndDriven) {
  Supports supports;
  EXPECT_FALSE(supports.driven());
  EXPECT_EQ(supports.last(), -1);
  supports.prescribe(5, 0.5, 0.0);
  EXPECT_FALSE(supports.driven());
  supports.prescribe(5, 0.5, 0.0);  // the same again is no conflict
  supports.prescribe(0, 1.0, -2.0);
  EXPECT_EQ(supports.last(), 5);
  EXPECT_TRUE(supports.driven());
  EXPECT_TRUE(supports.fixed(0));
  EXPECT_FALSE(supports.fixed(1));
  EXPECT_EQ(supports.at(0, 3.0), -5.0);
  EXPECT_EQ(supports.at(5, 3.0), 0.5);
  EXPECT_THROW(supports.prescribe(5, 0.5, 1.0), std::invalid_argument);
  EXPECT_THROW(supports.prescribe(5, 0.4, 0.0), std::invalid_argument);
  EXPECT_THROW(supports.prescribe(-1, 0.4, 0.0), std::invalid_argument);
}

// The strip's clamped edge is a line: only its directors hold the rotation about it.
TEST(FreeBodies, DirectorsOfShellsHoldRotations) {
  ShellPlateOptions options;
  options.length = 100;
  options.thickness = 1e-4;  // a millionth of the length: directors count, however short they are
  options.divisions = {4, 1};
  const Mesh mesh = shellPlateMesh(options);
  const ShellGeometry shells = shellGeometry(mesh, {{0, std::nullopt}});
  DofMap dofs = DofMap::displacements(mesh.numNodes());
  dofs.addNodes(shells.numDirectors(), directorField());
  const auto motions = [&](const Supports& supports) {
    const auto bodies = freeBodies(mesh, dofs, supports, {}, &shells);
    return bodies.empty() ? 0 : bodies[0].motions;
  };
  Supports supports;
  EXPECT_EQ(motions(supports), 6);
  for (int n : nodesOfSet(mesh, "x_min"))
    for (int i = 0; i < 3; ++i) supports.prescribe(dofs.firstDof(n) + i, 0, 0);
  EXPECT_EQ(motions(supports), 1);
  Supports stretch = supports, clamped = supports;
  for (int n : nodesOfSet(mesh, "x_min"))
    for (int d : shells.directorNodes(n)) {
      stretch.prescribe(dofs.firstDof(d) + 2, 0, 0);  // along D: no rotation moves it
      clamped.prescribe(dofs.firstDof(d), 0, 0);
    }
  EXPECT_EQ(motions(stretch), 1);
  EXPECT_EQ(motions(clamped), 0);
  // A single clamped node holds all but the spin about its director.
  Supports one;
  for (int i = 0; i < 3; ++i) {
    one.prescribe(i, 0, 0);
    one.prescribe(dofs.firstDof(shells.directorNodes(0)[0]) + i, 0, 0);
  }
  EXPECT_EQ(motions(one), 1);
}
