// What a page is made of: data that stays data whatever texts it has, surfaces of meshes, and what is
// thinned.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "atrapos/exodus/ResultWriter.hpp"
#include "atrapos/fem/StructuredMesh.hpp"
#include "atrapos/fem/StructuredPlane.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "output/PathTable.hpp"
#include "output/ToolShapes.hpp"
#include "report/Bundle.hpp"
#include "report/ReportData.hpp"
#include "report/ReportPage.hpp"
#include "report/ReportShape.hpp"
#include "report/Surface.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

TEST(ReportPage, DataStaysDataWhateverItSays) {
  const std::vector<std::string> texts{"</script><script>alert(1)</script>",
                                       "<!-- <script>",
                                       "]]> &lt; &#60; `${x}` '\" \\ \\u003c",
                                       "a\nb\r\tc\x01",
                                       "\u2028\u2029 \u00e4",
                                       std::string("a\0b", 3)};
  for (const std::string& text : texts) {
    const nlohmann::json json{{text, text}, {"list", {text, 1, nullptr}}};
    const std::string safe = jsonInHtml(json);
    EXPECT_EQ(safe.find_first_of("<>&\n\r"), std::string::npos) << safe;
    for (const char c : safe) EXPECT_TRUE(c >= ' ' && c <= '~') << safe;
    EXPECT_EQ(nlohmann::json::parse(safe), json);
  }
  // Bytes that are no text do not end it either.
  EXPECT_NO_THROW(nlohmann::json::parse(jsonInHtml(nlohmann::json{{"x", "\xff\xfe<"}})));
}

TEST(ReportPage, OnePageWithoutOtherFiles) {
  const std::string script(bundle::script());
  EXPECT_GT(script.size(), 100000u);
  // What would end the element that it stands in, or begin a comment.
  for (const char* word : {"</script", "<script", "<!--"})
    EXPECT_EQ(script.find(word), std::string::npos) << word;
  const std::string page = reportPage({{"title", "</script>"}});
  EXPECT_EQ(page.rfind("<!doctype html>\n<!-- atrapos report -->\n", 0), 0u);
  EXPECT_NE(page.find("default-src 'none'"), std::string::npos);
  std::size_t ends = 0;
  for (std::size_t at = page.find("</script"); at != std::string::npos; at = page.find("</script", at + 1))
    ++ends;
  EXPECT_EQ(ends, 2u);  // the data's and the program's own
  EXPECT_EQ(page.find(" src="), std::string::npos) << "something is loaded";
  for (const char* library : {"three", "d3-zoom"})
    EXPECT_NE(bundle::licences().find(std::string("==== ") + library), std::string_view::npos) << library;
}

/// Of all triangles.
double area(const fem::Mesh& mesh, const Surface& surface) {
  double sum = 0;
  for (std::size_t t = 0; t < surface.triangles.size(); t += 3) {
    const double* p[3];
    for (int i = 0; i < 3; ++i) p[i] = &mesh.coordinates[3 * surface.nodes[surface.triangles[t + i]]];
    double n[3];
    for (int c = 0; c < 3; ++c) {
      const int d = (c + 1) % 3, e = (c + 2) % 3;
      n[c] = (p[1][d] - p[0][d]) * (p[2][e] - p[0][e]) - (p[1][e] - p[0][e]) * (p[2][d] - p[0][d]);
    }
    sum += 0.5 * std::hypot(n[0], n[1], n[2]);
  }
  return sum;
}

TEST(Surface, OfSolidsIsWhatIsOutside) {
  for (const auto topology :
       {fem::Topology::Hex8, fem::Topology::Hex20, fem::Topology::Hex27, fem::Topology::Tet4,
        fem::Topology::Tet10, fem::Topology::Wedge6, fem::Topology::Wedge15}) {
    SCOPED_TRACE(fem::topologyName(topology));
    fem::BoxOptions options;
    options.lengths = {3, 2, 1};
    options.divisions = {3, 2, 2};
    options.topology = topology;
    const fem::Mesh mesh = fem::boxMesh(options);
    const Surface surface = surfaceOf(mesh);
    EXPECT_NEAR(area(mesh, surface), 2 * (3 * 2 + 2 * 1 + 1 * 3),
                1e-12);  // no face twice, none missing, none inside
    EXPECT_EQ(surface.triangles.size(), 3 * surface.triangleElements.size());
    const auto [low, high] =
        std::minmax_element(surface.triangleElements.begin(), surface.triangleElements.end());
    EXPECT_GE(*low, 0u);
    EXPECT_LT(*high, static_cast<std::uint32_t>(mesh.numElements()));
    std::set<std::pair<std::uint32_t, std::uint32_t>> edges;
    for (std::size_t e = 0; e < surface.edges.size(); e += 2)
      EXPECT_TRUE(edges.insert(std::minmax(surface.edges[e], surface.edges[e + 1])).second) << "drawn twice";
  }
}

TEST(Surface, OfShellsAndPlanesIsAllOfThem) {
  for (const auto topology : {fem::Topology::Shell4, fem::Topology::Shell8, fem::Topology::Shell9}) {
    fem::ShellPlateOptions options;
    options.length = 3;
    options.width = 2;
    options.divisions = {3, 2};
    options.topology = topology;
    const fem::Mesh mesh = fem::shellPlateMesh(options);
    const Surface surface = surfaceOf(mesh);
    EXPECT_NEAR(area(mesh, surface), 6, 1e-12);
    EXPECT_EQ(surface.nodes.size(), static_cast<std::size_t>(mesh.numNodes()));
  }
  for (const auto topology : {fem::Topology::Quad4, fem::Topology::Quad8, fem::Topology::Quad9,
                              fem::Topology::Tri3, fem::Topology::Tri6}) {
    fem::RectangleOptions options;
    options.lengths = {3, 2};
    options.divisions = {3, 2};
    options.topology = topology;
    const fem::Mesh mesh = fem::rectangleMesh(options);
    EXPECT_NEAR(area(mesh, surfaceOf(mesh)), 6, 1e-12) << fem::topologyName(topology);
  }
}

TEST(Base64, IsThatOfTheStandard) {
  // 1.0f and -2.0f, little-endian.
  EXPECT_EQ(base64(std::vector<float>{1}), "AACAPw==");
  EXPECT_EQ(base64(std::vector<float>{1, -2}), "AACAPwAAAMA=");
  EXPECT_EQ(base64(std::vector<float>{1, -2, 1}), "AACAPwAAAMAAAIA/");
  EXPECT_EQ(base64(std::vector<float>{}), "");
}

TEST(Evenly, WithBothEnds) {
  EXPECT_EQ(evenly(5, 9), (std::vector<std::size_t>{0, 1, 2, 3, 4}));
  EXPECT_EQ(evenly(9, 3), (std::vector<std::size_t>{0, 4, 8}));
  EXPECT_EQ(evenly(9, 1), (std::vector<std::size_t>{8}));
  EXPECT_TRUE(evenly(0, 3).empty());
  const auto many = evenly(1000003, 4000);
  EXPECT_EQ(many.size(), 4000u);
  EXPECT_EQ(many.back(), 1000002u);
  EXPECT_TRUE(std::is_sorted(many.begin(), many.end()));
}

/// A folder of results with so many states of a box, x displaced by the state's number.
/// With moves = false without displacements, in their place fields of these values.
void writeResults(const std::filesystem::path& folder, int states, const fem::Mesh& mesh, bool moves = true) {
  writeFile(folder / "points.csv", pointHeader({"u"}) + "\n");
  std::string rows = pathHeader({"u"}) + "\n";
  for (int s = 0; s < states; ++s) {
    PathRow row;
    row.step = s;
    row.pathLength = s;
    row.loadFactor = 0.1 * s;
    row.monitors = {1.0 * s};
    row.negative = 0;
    rows += text(row) + "\n";
  }
  writeFile(folder / "path.csv", rows);
  exodus::ResultNames names;
  names.nodal = {"displ_x", "displ_y", "displ_z", "heat"};
  if (!moves) names.nodal = {"u", "v", "w", "heat"};
  names.element = {"stress_xx"};
  names.global = {"load_factor"};
  exodus::ResultWriter writer((folder / "results.exo").string(), mesh, names);
  const std::size_t n = mesh.numNodes(), m = mesh.numElements();
  for (int s = 0; s < states; ++s) {
    std::vector<double> nodal(4 * n, 0.0);
    std::fill(nodal.begin(), nodal.begin() + static_cast<std::ptrdiff_t>(n), s);
    writer.writeStep(s, nodal, std::vector<double>(m, 7), std::vector<double>{0.1 * s});
  }
}

std::vector<float> floatsOf(const nlohmann::json& base64) {
  static const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  unsigned bits = 0;
  int count = 0;
  for (const char c : base64.get<std::string>()) {
    if (c == '=') break;
    bits = bits << 6 | static_cast<unsigned>(letters.find(c));
    if ((count += 6) < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 255);
  }
  std::vector<float> values(bytes.size() / sizeof(float));
  std::memcpy(values.data(), bytes.data(), values.size() * sizeof(float));
  return values;
}

TEST(ReportData, StatesOfTheBody) {
  const TemporaryFolder folder;
  fem::BoxOptions options;
  options.divisions = {2, 2, 2};
  const fem::Mesh mesh = fem::boxMesh(options);
  writeResults(folder.path(), 3, mesh);
  const nlohmann::json data = reportData(folder.path().string());
  const auto& shape = data.at("shape");
  EXPECT_EQ(shape.at("dimension"), 3);
  EXPECT_TRUE(shape.at("moves"));
  ASSERT_EQ(shape.at("fields").size(), 2u);
  EXPECT_EQ(shape.at("fields")[0], (nlohmann::json{{"name", "heat"}, {"of", "node"}}));
  EXPECT_EQ(shape.at("fields")[1], (nlohmann::json{{"name", "stress_xx"}, {"of", "element"}}));
  const auto& states = shape.at("branches").at(0).at("states");
  ASSERT_EQ(states.size(), 3u);
  std::vector<float> u;
  for (int node = 0; node < 26; ++node) u.insert(u.end(), {2, 0, 0});  // the one within is not seen
  EXPECT_EQ(states[2].at("displacement"), base64(u));
  EXPECT_EQ(states[2].at("path_length"), 2);
  EXPECT_DOUBLE_EQ(states[2].at("load_factor"), 0.2);
  EXPECT_EQ(states[0].at("fields")[1], base64(std::vector<float>(8, 7)));
  EXPECT_TRUE(data.at("notes").empty());
  EXPECT_FALSE(data.contains("summary"));  // as of a run that was killed
}

/// What does not move is shown at rest, by its fields.
TEST(ReportData, BodiesWithoutDisplacements) {
  const TemporaryFolder folder;
  fem::BoxOptions options;
  options.divisions = {2, 2, 2};
  writeResults(folder.path(), 3, fem::boxMesh(options), false);
  const nlohmann::json data = reportData(folder.path().string());
  const auto& shape = data.at("shape");
  EXPECT_FALSE(shape.at("moves"));
  EXPECT_EQ(shape.at("fields").size(), 5u);
  const auto& state = shape.at("branches").at(0).at("states").at(2);
  EXPECT_EQ(state.at("displacement"), base64(std::vector<float>(3 * 26, 0)));
  EXPECT_EQ(state.at("fields")[0], base64(std::vector<float>(26, 2)));
}

/// A ball at rest and a roll that is shifted and turned: of each state where they are.
TEST(ReportData, ToolsWhereTheyAre) {
  const TemporaryFolder folder;
  fem::BoxOptions options;
  options.divisions = {2, 2, 2};
  writeResults(folder.path(), 3, fem::boxMesh(options));
  deck::Deck deck;
  deck::Tool ball, roll;
  ball.name = "ball";
  ball.surface = deck::SphereTool{{0, 0, 3}, 1.5};
  roll.name = "roll";
  roll.surface = deck::CylinderTool{{0, 0, -2}, {0, 1, 0}, 1};
  roll.motion.shift = {{1, 0, 2}};
  roll.motion.angle = {300};  // degrees per load factor, about the axis that follows
  roll.motion.axis = {1, 2, 2};
  roll.motion.pivot = {0, 1, -2};
  deck.tools = {ball, roll};
  writeToolShapes(folder.path().string(), deck);
  const nlohmann::json data = reportData(folder.path().string());
  EXPECT_TRUE(data.at("notes").empty());
  const auto& shape = data.at("shape");
  ASSERT_EQ(shape.at("tools").size(), 2u);
  EXPECT_EQ(shape.at("tools")[1].at("name"), "roll");
  const auto states = shape.at("branches").at(0).at("states");
  for (int s = 0; s < 3; ++s) {
    const auto motions = floatsOf(states[s].at("tools"));
    ASSERT_EQ(motions.size(), 24u);
    for (int i = 0; i < 9; ++i) EXPECT_NEAR(motions[i], i % 4 == 0 ? 1 : 0, 1e-7) << "the ball is at rest";
    const auto positions = floatsOf(shape.at("tools")[1].at("positions"));
    for (std::size_t n = 0; n < positions.size(); n += 3) {
      const float* const x = &positions[n];
      const deck::Vector3 there = moved(roll.motion, 0.1 * s, {x[0], x[1], x[2]});
      for (int i = 0; i < 3; ++i) {
        const float* const row = &motions[12 + 3 * i];
        // Single precision of lengths of 3.
        EXPECT_NEAR(row[0] * x[0] + row[1] * x[1] + row[2] * x[2] + motions[21 + i], there[i], 2e-6);
      }
    }
  }
}

TEST(ReportData, WhatIsThinnedIsSaid) {
  const TemporaryFolder folder;
  fem::BoxOptions options;
  options.divisions = {2, 2, 2};
  writeResults(folder.path(), 400, fem::boxMesh(options));
  std::vector<std::string> notes;
  const std::vector<ShapeFile> files{{0, "path", (folder / "results.exo").string(), ""}};
  const nlohmann::json all = shapeOf(files, 100'000'000, notes);
  EXPECT_EQ(all.at("branches")[0].at("states").size(), 150u);
  EXPECT_EQ(notes, (std::vector<std::string>{"the deformed shape shows 150 of 400 states"}));
  // A state takes 26 * 12 bytes of displacements and 104 a field: room for 30 states with one field.
  notes.clear();
  const nlohmann::json less = shapeOf(files, 30 * (26 * 12 + 104), notes);
  EXPECT_EQ(less.at("branches")[0].at("states").size(), 30u);
  EXPECT_EQ(less.at("fields").size(), 1u);
  EXPECT_EQ(notes.size(), 2u);
  notes.clear();
  EXPECT_TRUE(shapeOf(files, 10, notes).is_null());
  ASSERT_EQ(notes.size(), 1u);
  EXPECT_NE(notes[0].find("too large"), std::string::npos);
}

TEST(ReportData, NoPathNoPage) {
  const TemporaryFolder folder;
  EXPECT_THROW(reportData(folder.path().string()), std::invalid_argument);
}

}  // namespace
}  // namespace atrapos::test
