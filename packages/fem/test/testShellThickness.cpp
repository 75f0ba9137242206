#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>

#include "atrapos/fem/ShellThickness.hpp"
#include "atrapos/fem/StructuredShell.hpp"

using namespace atrapos::fem;

namespace {

Mesh twoElements() {
  ShellPlateOptions options;
  options.divisions = {2, 1};
  Mesh mesh = shellPlateMesh(options);
  mesh.elementIds = {11, 12};
  for (int n = 0; n < mesh.numNodes(); ++n) mesh.nodeIds.push_back(101 + n);
  return mesh;
}

std::string messageOf(const Mesh& mesh, const ShellSection& section) {
  try {
    shellThickness(mesh, section);
  } catch (const std::invalid_argument& e) {
    return e.what();
  }
  return "no error";
}

}  // namespace

TEST(ShellThickness, ANumberWinsOverAttributes) {
  Mesh mesh = twoElements();
  EXPECT_EQ(shellThickness(mesh, {0, 0.25}), std::vector<double>(16, 0.25));
  mesh.blocks[0].attributeNames = {"thickness"};
  mesh.blocks[0].attributes = {1, 2};
  EXPECT_EQ(shellThickness(mesh, {0, 0.25}), std::vector<double>(16, 0.25));
}

TEST(ShellThickness, OneAttributeIsTheElementsWhateverItsName) {
  Mesh mesh = twoElements();
  for (const char* name : {"thickness", "Thickness", "THICKNESS", "", "t"}) {
    mesh.blocks[0].attributeNames = {name};
    mesh.blocks[0].attributes = {1.5, 2.5};
    std::vector<double> expected(8, 1.5);
    expected.resize(16, 2.5);
    EXPECT_EQ(shellThickness(mesh, {0, {}}), expected);
  }
}

TEST(ShellThickness, OneOfSeveralAttributesMustBeNamed) {
  Mesh mesh = twoElements();
  mesh.blocks[0].attributeNames = {"angle", "thickness", "offset"};
  mesh.blocks[0].attributes = {45, 1.5, 0, 30, 2.5, 0};
  std::vector<double> expected(8, 1.5);
  expected.resize(16, 2.5);
  EXPECT_EQ(shellThickness(mesh, {0, {}}), expected);
  mesh.blocks[0].attributeNames[1] = "height";
  EXPECT_EQ(
      messageOf(mesh, {0, {}}),
      "block 'shell': the shells have no thickness: give a number, or the block one attribute (or several "
      "with one named thickness, or one for each of the 8 nodes); it has 3");
}

TEST(ShellThickness, AsManyAttributesAsNodesAreNodal) {
  Mesh mesh = twoElements();
  mesh.blocks[0].attributeNames.assign(8, "");
  for (int i = 0; i < 16; ++i) mesh.blocks[0].attributes.push_back(1 + 0.1 * i);
  EXPECT_EQ(shellThickness(mesh, {0, {}}), mesh.blocks[0].attributes);
  mesh.blocks[0].attributes[10] = 0;
  EXPECT_EQ(messageOf(mesh, {0, {}}),
            "element 12 (block 'shell'): the thickness in its attributes must be positive, got 0 at node " +
                std::to_string(101 + mesh.blocks[0].nodes[10]));
}

TEST(ShellThickness, WhatIsNotAPositiveNumberIsNamed) {
  Mesh mesh = twoElements();
  EXPECT_EQ(messageOf(mesh, {0, -1.0}), "block 'shell': the thickness of shells must be positive, got -1");
  EXPECT_NE(messageOf(mesh, {0, std::nan("")}), "no error");
  EXPECT_NE(messageOf(mesh, {0, 1.0 / 0.0}), "no error");
  EXPECT_NE(messageOf(mesh, {0, {}}).find("the shells have no thickness"), std::string::npos);
  mesh.blocks[0].attributeNames = {"thickness"};
  mesh.blocks[0].attributes = {0.5, -0.5};
  EXPECT_EQ(messageOf(mesh, {0, {}}),
            "element 12 (block 'shell'): the thickness in its attributes must be positive, got -0.5");
}
