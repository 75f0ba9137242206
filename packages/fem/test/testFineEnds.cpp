// Generated meshes with equal elements at one end of an axis, from which the others grow by one factor.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/fem/StructuredShell.hpp"

namespace atrapos::fem {
namespace {

/// Sizes of the elements along an axis, from the places of all nodes of cells without nodes between corners.
std::vector<double> sizes(const Mesh& mesh, int axis) {
  std::set<double> places;
  for (int n = 0; n < mesh.numNodes(); ++n) places.insert(mesh.coordinates[3 * n + axis]);
  std::vector<double> all(places.begin(), places.end()), found;
  for (std::size_t i = 1; i < all.size(); ++i)
    if (all[i] - all[i - 1] > 1e-9) found.push_back(all[i] - all[i - 1]);
  return found;
}

/// So many equal elements over a length, then others by one factor, which is returned; all over `whole`.
double expectFine(std::vector<double> found, const FineEnd& fine, double whole, int divisions) {
  if (fine.atMax) std::reverse(found.begin(), found.end());
  constexpr double rounding = 1e-11;
  EXPECT_EQ(found.size(), static_cast<std::size_t>(divisions));
  const double equal = fine.length / fine.divisions;
  double sum = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    sum += found[i];
    if (static_cast<int>(i) < fine.divisions) {
      EXPECT_NEAR(found[i], equal, rounding * whole) << i;
    }
  }
  EXPECT_NEAR(sum, whole, rounding * whole);
  const double factor = found[fine.divisions] / equal;
  for (std::size_t i = fine.divisions; i < found.size(); ++i)
    EXPECT_NEAR(found[i] / found[i - 1], factor, 1e-9 * factor) << i;
  EXPECT_EQ(growth(fine, whole, divisions) > 1, factor > 1);
  EXPECT_NEAR(growth(fine, whole, divisions), factor, 1e-9 * factor);
  return factor;
}

TEST(FineEnds, ElementsAreEqualAndThenGrow) {
  RectangleOptions rectangle;
  rectangle.lengths = {80, 40};
  rectangle.origin = {-3, 7};
  rectangle.divisions = {24, 10};
  rectangle.topology = Topology::Quad4;
  rectangle.fine = {FineEnd{12, 1.6, false}, FineEnd{4, 2, true}};
  const Mesh plane = rectangleMesh(rectangle);
  // h (q + ... + q^12) = 78.4 with h = 1.6/12
  EXPECT_NEAR(expectFine(sizes(plane, 0), rectangle.fine[0], 80, 24), 1.56316, 1e-5);
  expectFine(sizes(plane, 1), rectangle.fine[1], 40, 10);

  BoxOptions box;
  box.lengths = {4, 5, 6};
  box.divisions = {4, 5, 6};
  box.fine = {FineEnd{}, FineEnd{2, 0.5, true}, FineEnd{3, 0.25, false}};
  const Mesh solid = boxMesh(box);
  expectFine(sizes(solid, 1), box.fine[1], 5, 5);
  expectFine(sizes(solid, 2), box.fine[2], 6, 6);
  // The other axis is as it would be, to the bit.
  BoxOptions plain = box;
  plain.fine = {};
  const Mesh equal = boxMesh(plain);
  for (int n = 0; n < solid.numNodes(); ++n) ASSERT_EQ(solid.coordinates[3 * n], equal.coordinates[3 * n]);

  ShellPlateOptions plate;
  plate.length = 3;
  plate.divisions = {6, 1};
  plate.topology = Topology::Shell4;
  plate.fine[0] = {3, 0.3, false};
  expectFine(sizes(shellPlateMesh(plate), 0), plate.fine[0], 3, 6);
}

TEST(FineEnds, NodesBetweenCornersAreHalfway) {
  RectangleOptions options;
  options.lengths = {10, 1};
  options.divisions = {6, 1};
  options.fine[0] = {3, 0.6, false};
  const Mesh mesh = rectangleMesh(options);  // QUAD8
  const Block& block = mesh.blocks.front();
  for (std::size_t e = 0; e < block.nodes.size(); e += 8)
    for (int side = 0; side < 4; ++side) {
      const auto x = [&](int node) { return mesh.coordinates[3 * block.nodes[e + node]]; };
      EXPECT_NEAR(x(4 + side), 0.5 * (x(side) + x((side + 1) % 4)), 1e-14);
    }
}

TEST(FineEnds, AMeshOfEqualElementsIsOne) { EXPECT_NEAR(growth({3, 0.3, false}, 1, 10), 1, 1e-12); }

TEST(FineEnds, WhatDoesNotFitIsRefused) {
  const auto refused = [](const FineEnd& fine, double length, int divisions, const std::string& words) {
    try {
      growth(fine, length, divisions);
      ADD_FAILURE() << "accepted: " << words;
    } catch (const std::invalid_argument& error) {
      EXPECT_NE(std::string(error.what()).find(words), std::string::npos) << error.what();
    }
  };
  refused({2, 0, false}, 1, 4, "fine elements over 0 of a length of 1: must be above 0 and below it");
  refused({2, 1, false}, 1, 4, "below it");
  refused({4, 0.5, false}, 1, 4, "4 fine elements of 4: must be at least 1, and leave at least 1");
  refused({2, 0.5, false}, 1, 8,
          "6 elements beside 2 fine ones of 0.25 would be smaller than these: 0.5 is left for them");
  ShellPlateOptions plate;
  plate.divisions = {4, 4};
  plate.fine[0] = {2, 0.1, false};
  plate.grading = 2;
  EXPECT_THROW(shellPlateMesh(plate), std::invalid_argument);
}

}  // namespace
}  // namespace atrapos::fem
