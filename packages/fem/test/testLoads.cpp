#include <gtest/gtest.h>

#include <array>

#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "support/Meshes.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

using Vec3 = std::array<double, 3>;

// Sums of up to a few thousand nodal forces of size 0.1 or less.
constexpr double roundingOfSums = 1e-12;

Vec3 total(const std::vector<double>& force) {
  Vec3 sum{0, 0, 0};
  for (std::size_t d = 0; d < force.size(); ++d) sum[d % 3] += force[d];
  return sum;
}

Vec3 moment(const Mesh& mesh, const std::vector<double>& force) {
  Vec3 sum{0, 0, 0};
  for (int n = 0; n < mesh.numNodes(); ++n) {
    const double *x = &mesh.coordinates[3 * n], *f = &force[3 * n];
    for (int i = 0; i < 3; ++i) {
      const int j = (i + 1) % 3, k = (i + 2) % 3;
      sum[i] += x[j] * f[k] - x[k] * f[j];
    }
  }
  return sum;
}

void expectNear(const Vec3& a, const Vec3& b) {
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(a[i], b[i], roundingOfSums);
}

std::vector<double> noForce(const Mesh& mesh) { return std::vector<double>(3 * mesh.numNodes(), 0.0); }

SideSet surfaceOf(const Mesh& mesh) {
  SideSet all;
  for (const SideSet& set : mesh.sideSets)
    all.sides.insert(all.sides.end(), set.sides.begin(), set.sides.end());
  return all;
}

double volumeOf(const Mesh& mesh) {
  double volume = 0;
  for (const Block& block : mesh.blocks)
    for (double w : volumePoints(mesh, block, tabulate(block.topology, 6)).weights) volume += w;
  return volume;
}

}  // namespace

TEST(Loads, NodalForcesAddUp) {
  const Mesh mesh = box(Topology::Hex8, {1, 1, 1});
  auto force = noForce(mesh);
  addNodalLoad({0, 7, 0}, {1, 2, 3}, force);
  EXPECT_EQ(force[0], 2);
  EXPECT_EQ(force[3 * 7 + 2], 3);
  expectNear(total(force), {3, 6, 9});
}

// Force and moment of a uniform traction on a plane rectangle are exact: area times traction, at its centre.
TEST(Loads, TractionHasTheForceAndMomentOfItsFace) {
  for (Topology cell : allCells())
    for (const char* name : {"x_max", "z_min"}) {  // wedges: quadrilaterals and triangles
      SCOPED_TRACE(std::string(topologyName(cell)) + " " + name);
      const Mesh mesh = box(cell, {3, 2, 2}, {2, 3, 5});
      auto force = noForce(mesh);
      const Vec3 t{0.3, -0.2, 0.7};
      addTraction(mesh, sideSet(mesh, name), t, force);
      const bool onX = name[0] == 'x';
      const double area = onX ? 15 : 6;
      const Vec3 centre = onX ? Vec3{2, 1.5, 2.5} : Vec3{1, 1.5, 0};
      EXPECT_NEAR(areaOf(mesh, sideSet(mesh, name)), area, roundingOfSums);
      expectNear(total(force), {area * t[0], area * t[1], area * t[2]});
      expectNear(moment(mesh, force),
                 {area * (centre[1] * t[2] - centre[2] * t[1]), area * (centre[2] * t[0] - centre[0] * t[2]),
                  area * (centre[0] * t[1] - centre[1] * t[0])});
    }
}

TEST(Loads, SurfaceForceIsTheTotal) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = distorted(box(cell), 0.03);
    auto force = noForce(mesh);
    addNodalLoad({0}, {1, 1, 1}, force);  // loads add to what is there
    addSurfaceForce(mesh, surfaceOf(mesh), {-2, 0.5, 4}, force);
    expectNear(total(force), {-1, 1.5, 5});
  }
}

// Divergence theorem: a pressure p on a closed surface has no force and no moment, and the work of x is -3 p
// V. Exact on distorted cells, because the faces' cubature integrates N_a (x_xi cross x_eta) . x exactly.
TEST(Loads, PressureOnAClosedSurface) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = distorted(box(cell), 0.03);
    auto force = noForce(mesh);
    addPressure(mesh, surfaceOf(mesh), 1.7, force);
    expectNear(total(force), {0, 0, 0});
    expectNear(moment(mesh, force), {0, 0, 0});
    double work = 0;
    for (std::size_t d = 0; d < force.size(); ++d) work += force[d] * mesh.coordinates[d];
    EXPECT_NEAR(work, -3 * 1.7 * volumeOf(mesh), roundingOfSums);
  }
}

TEST(Loads, PressurePushesInwards) {
  const Mesh mesh = box(Topology::Wedge15, {2, 2, 1}, {1, 2, 3});
  auto force = noForce(mesh);
  addPressure(mesh, sideSet(mesh, "z_max"), 2.0, force);
  expectNear(total(force), {0, 0, -4});
}

TEST(Loads, BodyForceHasTheForceAndMomentOfTheBlock) {
  for (Topology cell : allCells()) {
    SCOPED_TRACE(topologyName(cell));
    const Mesh mesh = box(cell, {2, 2, 3}, {1, 2, 3});
    auto force = noForce(mesh);
    addBodyForce(mesh, mesh.blocks[0], {0.1, 0.2, -0.4}, force);
    expectNear(total(force), {0.6, 1.2, -2.4});
    // 6 (0.5, 1, 1.5) x (0.1, 0.2, -0.4)
    expectNear(moment(mesh, force), {6 * (-0.4 - 0.3), 6 * (0.15 + 0.2), 6 * (0.1 - 0.1)});
  }
}

TEST(Loads, BodyForceOnlyOnItsBlock) {
  const Mesh mesh = mixedMesh();
  auto force = noForce(mesh);
  addBodyForce(mesh, mesh.blocks[4], {0, 0, 1}, force);  // TET4
  std::vector<char> in(mesh.numNodes(), 0);
  for (int n : mesh.blocks[4].nodes) in[n] = 1;
  for (int n = 0; n < mesh.numNodes(); ++n) EXPECT_EQ(in[n] != 0, force[3 * n + 2] != 0) << n;
}
