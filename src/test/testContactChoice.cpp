// The law and the points of contacts that name neither.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "support/CheckedDeck.hpp"

namespace atrapos::test {
namespace {

/// A scene of one contact with what its deck says beside tool and set.
struct Scene {
  std::string shape =
      "{shape: shell_plate, length: 40, width: 4, origin: [0, -2, 0], divisions: [4, 1], block: body}";
  std::string kind = "shells: {sections: {body: {blocks: [body], thickness: 0.1}}}";
  std::string support = "{set: x_min, condition: clamped}";
  std::string load = "{type: edge, set: x_max, total: [0, 0, -0.001]}";
  std::string tool = "{type: cylinder, center: [30, 0, -5], axis: [0, 1, 0], radius: 4}";
  std::string set = "top", more, path, rest;

  std::string deck() const {
    return fmt::format(R"(mesh: {{file: m.exo, generate: {}}}
materials: {{rubber: {{law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [body]}}}}
{}
supports: {{clamp: {}}}
loads: {{pull: {}}}
tools: {{tool: {}}}
contact: {{face: {{tool: tool, set: {}{}}}}}
path: {{{}stop: {{load_factor: 1}}}}
{})",
                       shape, kind, support, load, tool, set, more, path, rest);
  }
};

Scene plane() {
  Scene scene;
  scene.shape = "{shape: rectangle, lengths: [40, 2], divisions: [8, 1], cell: QUAD8, block: body}";
  scene.kind = "plane: {kind: stress, thickness: 1}";
  scene.support = "{set: x_min, x: 0, y: 0}";
  scene.load = "{type: surface, set: x_max, total: [0, -0.001, 0]}";
  scene.tool = "{type: plane, point: [0, -1, 0], normal: [0, 1, 0]}";
  scene.set = "y_min";
  return scene;
}

class ContactChoice : public ::testing::Test {
 protected:
  /// "zones, linear" of the line of check about the contact: what is marked as chosen, its points first.
  std::string of(const Scene& scene) {
    const std::string text = checkedDeck(folder_, scene.deck()), begin = "# contact   face: ";
    const std::size_t at = text.find(begin);
    if (at == std::string::npos) return text;
    const std::string line = text.substr(at, text.find('\n', at) - at);
    std::string chosen;
    for (const std::string name : {"zones", "nodes", "quadrature"})
      if (line.find("points " + name + " (chosen)") != std::string::npos) chosen = name + ", ";
    for (const std::string name : {"linear", "hard", "hyperbola"})
      if (line.find("law (chosen) " + name) != std::string::npos) chosen += name;
    return chosen;
  }
  std::string with(Scene scene, const std::string& more) {
    scene.more = more;
    return of(scene);
  }
  TemporaryFolder folder_;
};

TEST_F(ContactChoice, LinesOfSlenderBodiesAreZones) {
  Scene scene;
  EXPECT_EQ(of(scene), "zones, linear");
  scene.tool = "{type: sphere, center: [30, 0, -5], radius: 4}";
  EXPECT_EQ(of(scene), "quadrature, hard");
  scene.tool = "{type: plane, point: [0, 0, -1], normal: [0, 0, 1]}";
  EXPECT_EQ(of(scene), "quadrature, hard");
  EXPECT_EQ(of(plane()), "zones, linear");
}

TEST_F(ContactChoice, ThickBodiesAndTrianglesAreHard) {
  Scene thick = plane();
  thick.shape = "{shape: rectangle, lengths: [40, 10], divisions: [8, 2], cell: QUAD8, block: body}";
  EXPECT_EQ(of(thick), "quadrature, hard");
  Scene triangles;
  triangles.shape =
      "{shape: shell_plate, length: 40, width: 4, divisions: [4, 1], cell: SHELL6, block: body}";
  EXPECT_EQ(of(triangles), "quadrature, hard");
}

TEST_F(ContactChoice, BodiesThatLieOnToolsAreHard) {
  Scene lies = plane();
  lies.tool = "{type: plane, point: [0, 0, 0], normal: [0, 1, 0]}";
  EXPECT_EQ(of(lies), "quadrature, hard");
  lies.support = "{set: x_min, x: 0}";
  EXPECT_EQ(of(lies), "quadrature, hard");
}

// Nothing but points that are open holds the body: the force must act from afar.
TEST_F(ContactChoice, WhatHoldsFromAfarIsTheHyperbola) {
  Scene hangs = plane();
  hangs.support = "{set: x_min, x: 0}";
  EXPECT_EQ(of(hangs), "quadrature, hyperbola");
}

TEST_F(ContactChoice, SolversWithoutHardContact) {
  Scene scene;
  scene.tool = "{type: sphere, center: [30, 0, -5], radius: 4}";
  scene.path = "method: newton, ";
  EXPECT_EQ(of(scene), "quadrature, hyperbola");
  scene.path = "";
  scene.rest = "solver: {type: belos}\n";
  EXPECT_EQ(of(scene), "quadrature, hyperbola");
  Scene roll;
  roll.path = "method: newton, ";
  EXPECT_EQ(of(roll), "zones, linear");
  roll.path = "sharpen: 1.0e-3, ";
  EXPECT_EQ(of(roll), "quadrature, hyperbola");
}

TEST_F(ContactChoice, WhatIsSaidStands) {
  const Scene scene;
  EXPECT_EQ(with(scene, ", points: quadrature"), "hard");
  EXPECT_EQ(with(scene, ", points: nodes"), "hard");
  EXPECT_EQ(with(scene, ", points: zones"), "linear");
  Scene nodes = scene;
  nodes.set = "y_lines";
  EXPECT_EQ(of(nodes), "nodes, hard");
  nodes.rest = "output: {monitors: {area: {type: contact_area, contact: face}}}\n";
  writeFile(folder_ / "m.yaml", nodes.deck());
  const CommandResult check = runAtrapos({"check", "m.yaml"}, folder_.path());
  EXPECT_EQ(check.exitCode, 2);
  EXPECT_NE(check.err.find("contact 'face' acts at nodes, which have no area"), std::string::npos)
      << check.err;
  EXPECT_EQ(with(scene, ", law: power_overclosure"), "zones, ");
  EXPECT_EQ(with(scene, ", law: penalty"), "quadrature, ");
  EXPECT_EQ(with(scene, ", law: hard"), "quadrature, ");
  // A number of the hyperbola is one of that law, as ever.
  EXPECT_EQ(with(scene, ", stiffness: 100"), "quadrature, ");
  EXPECT_EQ(with(scene, ", points: zones, stiffness: 100"), "");
  EXPECT_EQ(with(scene, ", law: hyperbola, points: quadrature"), "");
}

}  // namespace
}  // namespace atrapos::test
