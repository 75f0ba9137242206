// Input files of Abaqus and CalculiX: what is read, how it is refused, and what cells, sets and decks come of
// it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <set>

#include "InpFile.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "deck/Deck.hpp"

namespace atrapos::importer {
namespace {

using fem::Topology;

// A cube of edge 2 as one element of any kind, nodes at the places that the manuals give: edges of the
// bottom, of the top, then between them.
std::vector<std::array<double, 3>> corners(Topology cell) {
  switch (cell) {
    case Topology::Hex8:
    case Topology::Hex20:
      return {{-1, -1, -1}, {1, -1, -1}, {1, 1, -1}, {-1, 1, -1},
              {-1, -1, 1},  {1, -1, 1},  {1, 1, 1},  {-1, 1, 1}};
    case Topology::Wedge6:
    case Topology::Wedge15:
      return {{0, 0, -1}, {1, 0, -1}, {0, 1, -1}, {0, 0, 1}, {1, 0, 1}, {0, 1, 1}};
    case Topology::Tet4:
    case Topology::Tet10:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    case Topology::Shell3:
    case Topology::Shell6:
    case Topology::Tri3:
    case Topology::Tri6:
      return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    case Topology::Bar2:
      return {{-1, 0, 0}, {1, 0, 0}};
    default:
      return {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  }
}

/// Corners, 1-based, of the middle nodes' edges and of the faces, from Abaqus' manual (Elements guide, node
/// ordering and face numbering).
struct Element {
  const char* type;
  Topology cell;
  std::vector<std::pair<int, int>> edges;
  std::vector<std::vector<int>> faces;
};

const std::vector<std::vector<int>> kHexFaces{{1, 2, 3, 4}, {5, 8, 7, 6}, {1, 5, 6, 2},
                                              {2, 6, 7, 3}, {3, 7, 8, 4}, {4, 8, 5, 1}},
    kTetFaces{{1, 2, 3}, {1, 4, 2}, {2, 4, 3}, {3, 4, 1}},
    kWedgeFaces{{1, 2, 3}, {4, 6, 5}, {1, 4, 5, 2}, {2, 5, 6, 3}, {3, 6, 4, 1}},
    kQuadFaces{{1, 2}, {2, 3}, {3, 4}, {4, 1}}, kTriFaces{{1, 2}, {2, 3}, {3, 1}};

const std::vector<Element>& elements() {
  static const std::vector<Element> all{
      {"C3D8", Topology::Hex8, {}, kHexFaces},
      {"C3D20R",
       Topology::Hex20,
       {{1, 2}, {2, 3}, {3, 4}, {4, 1}, {5, 6}, {6, 7}, {7, 8}, {8, 5}, {1, 5}, {2, 6}, {3, 7}, {4, 8}},
       kHexFaces},
      {"C3D4", Topology::Tet4, {}, kTetFaces},
      {"C3D10", Topology::Tet10, {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}}, kTetFaces},
      {"C3D6", Topology::Wedge6, {}, kWedgeFaces},
      {"C3D15",
       Topology::Wedge15,
       {{1, 2}, {2, 3}, {3, 1}, {4, 5}, {5, 6}, {6, 4}, {1, 4}, {2, 5}, {3, 6}},
       kWedgeFaces},
      {"CPS4", Topology::Quad4, {}, kQuadFaces},
      {"CPE8R", Topology::Quad8, {{1, 2}, {2, 3}, {3, 4}, {4, 1}}, kQuadFaces},
      {"CAX3", Topology::Tri3, {}, kTriFaces},
      {"CPS6", Topology::Tri6, {{1, 2}, {2, 3}, {3, 1}}, kTriFaces},
      {"S3", Topology::Shell3, {}, {}},
      {"S6", Topology::Shell6, {{1, 2}, {2, 3}, {3, 1}}, {}},
      {"S8R", Topology::Shell8, {{1, 2}, {2, 3}, {3, 4}, {4, 1}}, {}},
      {"M3D6", Topology::Shell6, {{1, 2}, {2, 3}, {3, 1}}, {}},
      {"M3D4R", Topology::Shell4, {}, {}},
      {"T3D2", Topology::Bar2, {}, {}}};
  return all;
}

/// Has a remark with these words.
bool tells(const Model& model, const std::string& words) {
  return std::any_of(model.remarks.begin(), model.remarks.end(),
                     [&](const std::string& r) { return r.find(words) != std::string::npos; });
}

class Cell : public ::testing::TestWithParam<Element> {};

// Nodes stand where Exodus' reference cell has them, and faces have the corners that the manual says.
TEST_P(Cell, NodesAndFaces) {
  const Element& element = GetParam();
  auto x = corners(element.cell);
  const auto ends = x;
  for (const auto& [a, b] : element.edges) {
    std::array<double, 3> middle{};
    for (std::size_t d = 0; d < 3; ++d)
      middle[d] = (ends[static_cast<std::size_t>(a - 1)][d] + ends[static_cast<std::size_t>(b - 1)][d]) / 2;
    x.push_back(middle);
  }
  std::string text = "*NODE\n";
  for (std::size_t n = 0; n < x.size(); ++n)
    text += std::to_string(10 + n) + ", " + std::to_string(x[n][0]) + ", " + std::to_string(x[n][1]) + ", " +
            std::to_string(x[n][2]) + "\n";
  text += std::string("*ELEMENT, TYPE=") + element.type + "\n7";
  for (std::size_t n = 0; n < x.size(); ++n) text += (n == 8 ? ",\n" : ", ") + std::to_string(10 + n);
  text += "\n";
  for (std::size_t f = 0; f < element.faces.size(); ++f)
    text += "*SURFACE, NAME=F" + std::to_string(f + 1) + "\n7, S" + std::to_string(f + 1) + "\n";
  const fem::Mesh mesh = readText(text).mesh;
  ASSERT_EQ(mesh.blocks.size(), 1u);
  ASSERT_EQ(mesh.blocks[0].topology, element.cell);
  EXPECT_EQ(mesh.elementIds, std::vector<long long>{7});
  const auto& nodes = mesh.blocks[0].nodes;
  // Shape functions are 1 at their node: where the cell's middle nodes would be, its nodes are.
  const std::vector<double> places = fem::referenceNodes(element.cell);
  const std::size_t dim = places.size() / nodes.size();
  for (std::size_t n = 0; n < nodes.size(); ++n)
    for (std::size_t d = 0; d < dim; ++d)
      EXPECT_EQ(mesh.coordinates[3 * static_cast<std::size_t>(nodes[n]) + d], places[n * dim + d])
          << "node " << n;
  ASSERT_EQ(mesh.sideSets.size(), element.faces.size());
  for (std::size_t f = 0; f < element.faces.size(); ++f) {
    const fem::SideSet& set = mesh.sideSets[f];
    EXPECT_EQ(set.name, "F" + std::to_string(f + 1));
    ASSERT_EQ(set.sides.size(), 1u);
    std::set<long long> found, expected;
    for (const int local : fem::sideNodes(element.cell, set.sides[0].side))
      if (const long long id = mesh.nodeIds[static_cast<std::size_t>(nodes[static_cast<std::size_t>(local)])];
          id < 10 + static_cast<long long>(ends.size()))
        found.insert(id);
    for (const int corner : element.faces[f]) expected.insert(9 + corner);
    EXPECT_EQ(found, expected) << "face " << f + 1;
  }
}

INSTANTIATE_TEST_SUITE_P(Inp, Cell, ::testing::ValuesIn(elements()),
                         [](const auto& info) { return std::string(info.param.type); });

const std::string kNodes =
    "*NODE, NSET=all\n1\n2, 1.\n3, 1.d0, 1.\n4, , +1.0E+0\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, "
    "1\n9, 5, 5, 5\n";
const std::string kCube = kNodes + "*ELEMENT, TYPE=C3D8, ELSET=cube\n1, 1,2,3,4,5,6,7,8\n";
/// The cube of a material m, whose laws come next, and a step that pulls it.
const std::string kCubeOfM = kCube + "*SOLID SECTION, ELSET=cube, MATERIAL=m\n*MATERIAL, NAME=m\n",
                  kPulled = "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*CLOAD\n7, 1, 1.\n*END STEP\n";
const std::string kSteel =
    "*MATERIAL, NAME=steel\n*ELASTIC\n210000., .3\n*DENSITY\n2.\n*SOLID SECTION, ELSET=cube, "
    "MATERIAL=steel\n";

TEST(Inp, WritingThatManualsAllow) {
  const Model model = readText(
      "** a comment\r\n*Heading\r\nA cube, of steel\r\n" + kCube +
      "*N Set , nset = \"two words\" , \n  GENERATE\n1, 7, 2\n\n** between\n*NSET, NSET=TOP\n5, 6,\n7, 8\n" +
      "*nset, nset=both\ntop, Two Words\n*SURFACE, NAME=free\nCUBE,\n*SURFACE,NAME=n,TYPE=NODE\ntop,1.\n");
  EXPECT_EQ(model.mesh.title, "A cube, of steel");
  EXPECT_EQ(model.mesh.numNodes(), 8);
  EXPECT_EQ(model.mesh.coordinates[3 * 2], 1);
  EXPECT_EQ(model.mesh.coordinates[3 * 3 + 1], 1);
  EXPECT_EQ(namesOf(model.mesh.nodeSets), (std::vector<std::string>{"all", "two words", "TOP", "both", "n"}));
  EXPECT_EQ(model.mesh.nodeSets[0].nodes.size(), 8u);
  EXPECT_EQ(model.mesh.nodeSets[1].nodes, (std::vector<int>{0, 2, 4, 6}));
  EXPECT_EQ(model.mesh.nodeSets[3].nodes, (std::vector<int>{0, 2, 4, 5, 6, 7}));
  EXPECT_EQ(model.mesh.nodeSets[4].nodes, model.mesh.nodeSets[2].nodes);
  ASSERT_EQ(model.mesh.sideSets.size(), 1u);
  EXPECT_EQ(model.mesh.sideSets[0].sides.size(), 6u);
  ASSERT_EQ(model.remarks.size(), 2u);  // C3D8 is not quite HEX8; node 9
  EXPECT_NE(model.remarks[1].find("1 node left out"), std::string::npos) << model.remarks[1];
}

TEST(Inp, WhatIsLeftOutIsTold) {
  const Model model =
      readText(kCube +
               "*SURFACE, NAME=a\ncube, S2\n*SURFACE, NAME=b\n1, S2\n*NSET, NSET=far\n9, 77\n*ELEMENT, "
               "TYPE=B31, ELSET=bars\n"
               "2, 1, 2\n*ELSET, ELSET=half\nbars\n*CREEP\n1.\n*EQUATION\n2\n1, 1, 1., 2, 1, -1.\n");
  EXPECT_EQ(namesOf(model.mesh.sideSets),
            (std::vector<std::string>{"a", "b"}));  // names stay, though they are the same
  for (const char* line :
       {":17: *NSET: 1 node left out that the mesh does not have, first 77",
        ":19: *ELEMENT, TYPE=B31: left out", ":21: element set 'half': left out", ":23: *CREEP: left out",
        ":26: *EQUATION: left out", "1 node left out", "node set 'far': left out"})
    EXPECT_TRUE(tells(model, line)) << line;
}

TEST(Inp, PartsOfOneInstanceAreFlat) {
  const Model model = readText(
      "*Part, name=P\n" + kCube +
      "*Nset, nset=Set-1\n1, 2\n*End Part\n*Assembly, name=A\n"
      "*Instance, name=P-1, part=P\n*End Instance\n*Nset, nset=Set-2, instance=P-1\n3\n*End Assembly\n" +
      "*Material, name=steel\n*Elastic\n1, .3\n");
  EXPECT_EQ(namesOf(model.mesh.nodeSets), (std::vector<std::string>{"all", "Set-1", "Set-2"}));
}

TEST(Inp, IncludedFiles) {
  const InpFile file("*INCLUDE, INPUT=nodes.inc\n9, 5, 5, 5\n*ELEMENT, TYPE=C3D8, INPUT=elements.inc\n");
  file.beside("nodes.inc", kNodes.substr(0, kNodes.rfind("9,")));
  file.beside("elements.inc", "1, 1,2,3,4,5,6,7,8\n");
  const Model model = readInp(file.path(), Deck::no);
  EXPECT_EQ(model.mesh.numElements(), 1);
  EXPECT_EQ(model.mesh.numNodes(), 8);
  file.beside("elements.inc", "1, 1,2,3,4,5,6,7\n");
  try {
    readInp(file.path(), Deck::no);
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find("elements.inc:1: element 1 has 7 nodes; C3D8 has 8"),
              std::string::npos)
        << e.what();
  }
}

TEST(Inp, ErrorsHaveFileAndLine) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"", "has no keyword"},
      {"1, 2\n", ":1: is before the first keyword"},
      {"*NODE\n1, x\n", ":2: 'x' is no coordinate"},
      {"*NODE\n1, 1e999\n", ":2: '1e999' is no coordinate"},
      {"*NODE\n1, nan\n", ":2: 'nan' is no coordinate"},
      {"*NODE\n0, 1\n", ":2: '0' is no number of a node"},
      {"*NODE\n4294967296\n", ":2: '4294967296' is no number of a node"},
      {"*NODE, SYSTEM=C\n1\n", ":1: *NODE, SYSTEM=C: expected Cartesian"},
      {"*NODE\n1\n", "has no element that this program knows"},
      {"*NODE\n1\n*ELEMENT, TYPE=B31\n1, 1, 1\n", "has no element that this program knows"},
      {kNodes + "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,7,99\n",
       ":12: element 1 has node 99, which is not there"},
      {kCube + "*ELEMENT, TYPE=C3D8\n1, 1,2,3,4,5,6,7,8\n", ":14: element 1 is there already"},
      {kCube + "*NSET, NSET=a\nnone\n", ":14: there is no node set 'none'"},
      {kCube + "*NSET\n1\n", ":13: *NSET: has no name"},
      {kCube + "*NSET, NSET=a, ELSET=none\n", ":13: *NSET: there is no element set 'none'"},
      {kCube + "*SURFACE, NAME=s\ncube, S7\n", ":14: element 1 has no face 'S7'"},
      {kCube + "*SURFACE, NAME=s\nnone, S1\n", ":14: there is no element set 'none'"},
      {kNodes + "*ELEMENT, TYPE=S4, ELSET=plate\n1, 1,2,3,4\n*SURFACE, NAME=s\nplate\n",
       ":14: a surface of shells has no face; expected SPOS, SNEG, E1"},
      {"*PART, NAME=p\n" + kCube +
           "*NSET, NSET=a\n1\n*END PART\n*ASSEMBLY, NAME=A\n*INSTANCE, NAME=i, PART=p\n" +
           "*END INSTANCE\n*NSET, NSET=a, INSTANCE=i\n3\n*END ASSEMBLY\n",
       ":20: *NSET: a set of this name is in the part too; expected different names"},
      {kCube + "*NGEN\n1, 2\n", ":13: *NGEN: is not known"},
      {kCube + "*INCLUDE, INPUT=none.inc\n", "none.inc' does not exist"},
      {"*INCLUDE, INPUT=model.inp\n", "is included 17 deep"},
      {kCube + "*PART, NAME=a\n*PART, NAME=b\n", ":14: *PART: is the second one"},
      {kCube + "*INSTANCE, NAME=a\n1., 0., 0.\n", ":14: *INSTANCE: is moved or turned"},
      {kCube + "*ELEMENT, TYPE=CPS4\n2, 1,2,3,4\n", "elements 1 and 2 are C3D8 and CPS4"},
      {"*NODE\n1\n2,1\n3,1,1,1\n*ELEMENT, TYPE=CPS3\n1, 1, 2, 3\n", "node 3 of a plane element has z = 1"}};
  for (const auto& [text, what] : cases) expectRefused(text, Deck::no, what);
}

TEST(Inp, DeckOfAStaticStep) {
  const Model model = readText(kCube + kSteel +
                                   "*NSET, NSET=foot\n1, 2, 3, 4\n*BOUNDARY\nfoot, 3\n1, 1, 2\n4, 1\n1, "
                                   "6\n*STEP, NLGEOM\n*STATIC\n*CLOAD\n5, 1, 2.\n5, 1, 1.\n6, 1, 3."
                                   "\n*DLOAD\ncube, P2, 4.\ncube, GRAV, 10., 0., 0., -2.\n*BOUNDARY\n7, 3, "
                                   "3, .5\n*NODE PRINT, NSET=all\nU\n*END STEP\n",
                               Deck::yes);
  const deck::Deck deck = deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
  ASSERT_EQ(deck.materials.size(), 1u);
  EXPECT_EQ(deck.materials[0].blocks, std::vector<std::string>{"cube"});
  // Nodes by what holds them: 2 and 3 (z), 4 (x, z), 1 (x, y, z), 7 (driven along z).
  ASSERT_EQ(deck.supports.size(), 4u) << model.deck;
  ASSERT_EQ(deck.loads.size(), 3u) << model.deck;
  const auto expectIn = [&](const std::string& part) {
    EXPECT_NE(model.deck.find(part), std::string::npos) << part << "\n" << model.deck;
  };
  expectIn("per_node: [3, 0, 0]");  // the two on node 5 add up: one load with node 6
  expectIn("pressure: 4, follower: true");
  expectIn("force: [0, 0, -20]");  // density 2
  expectIn("z: {per_load_factor: 0.5}");
  expectIn("stop: {load_factor: 1}");
  ASSERT_EQ(model.mesh.sideSets.size(), 1u);
  EXPECT_EQ(model.mesh.sideSets[0].sides[0].side, 5);  // the top
  EXPECT_TRUE(tells(model, ": *NODEPRINT: left out"));
}

TEST(Inp, DeckOfShells) {
  const std::string plate =
      "*NODE\n1\n2,1\n3,1,1\n4,0,1\n5,.5\n6,1,.5\n7,.5,1\n8,0,.5\n*ELEMENT, TYPE=S8R, ELSET=plate\n1, "
      "1,2,3,4,5,6,7,8\n"
      "*MATERIAL, NAME=al-7\n*ELASTIC\n70000, .33\n*SHELL SECTION, ELSET=plate, MATERIAL=AL-7\n.1\n";
  const Model model = readText(plate +
                                   "*BOUNDARY\n1, ENCASTRE\n4, XSYMM\n8, 1, 3\n8, 4\n*STEP\n*STATIC, "
                                   "RIKS\n.1, 1., , , 2.5, 3, 3, -7.\n"
                                   "*DLOAD\nplate, P, 2.\n*END STEP\n",
                               Deck::yes);
  ASSERT_EQ(model.mesh.blocks[0].attributes, std::vector<double>{.1});
  ASSERT_EQ(model.mesh.sideSets.size(), 1u);
  EXPECT_EQ(model.mesh.sideSets[0].sides[0].side, 1);  // along the normal: on the bottom
  const deck::Deck deck = deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
  EXPECT_EQ(deck.materials[0].name, "al-7");
  const auto expectIn = [&](const std::string& part) {
    EXPECT_NE(model.deck.find(part), std::string::npos) << part << "\n" << model.deck;
  };
  expectIn("x: 0, y: 0, z: 0, director_x: 0, director_y: 0, director_z: 0");
  expectIn("x: 0, director_x: 0}");  // no turn about y and z: the director stays in the plane of symmetry
  expectIn("x: 0, y: 0, z: 0, director_y: 0}");  // none about x
  expectIn("load_factor: 2.5, displacement: {end: -7}");
}

TEST(Inp, DeckOfMembranesAndBars) {
  const std::string text =
      "*NODE\n1\n2,1\n3,1,1\n4,0,1\n5,.5,.5,-1\n*ELEMENT, TYPE=M3D4, ELSET=skin\n1, 1,2,3,4\n"
      "*ELEMENT, TYPE=T3D2, ELSET=stays\n2, 1,5\n3, 2,5\n*ELEMENT, TYPE=T3D2, ELSET=thin\n4, 3,5\n"
      "*MATERIAL, NAME=al\n*ELASTIC\n70000, .33\n*MEMBRANE SECTION, ELSET=skin, MATERIAL=al\n.1\n"
      "*SOLID SECTION, ELSET=stays, MATERIAL=al\n20.\n*SOLID SECTION, ELSET=thin, MATERIAL=al\n";
  const std::string step =
      "*BOUNDARY\n5, 1, 3\n*STEP\n*STATIC\n*DLOAD\nskin, P, 2.\nstays, GRAV, 10., 0., 0., -1.\n*END STEP\n";
  const std::string density = "*MATERIAL, NAME=al\n*DENSITY\n3.\n*ELASTIC\n";
  const std::string whole = text + "5.\n" + step;
  const Model model = readText(
      std::string(whole).replace(whole.find("*MATERIAL, NAME=al\n*ELASTIC\n"), 28, density), Deck::yes);
  const deck::Deck deck = deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
  ASSERT_EQ(deck.membranes.size(), 1u) << model.deck;
  EXPECT_EQ(deck.membranes[0].blocks, std::vector<std::string>{"skin"});
  EXPECT_EQ(deck.membranes[0].size, .1);
  EXPECT_TRUE(model.mesh.blocks[0].attributes.empty());
  ASSERT_EQ(deck.bars.size(), 2u) << model.deck;
  EXPECT_EQ(deck.bars[0].size, 5);
  EXPECT_EQ(deck.bars[1].size, 20);
  EXPECT_NE(model.deck.find("force: [0, 0, -30]"), std::string::npos) << model.deck;
  expectRefused(text + step, Deck::yes, ": has no area, which a deck needs");
}

TEST(Inp, Materials) {
  const std::string &begin = kCubeOfM, &end = kPulled;
  const std::vector<std::pair<std::string, std::string>> laws{
      {"*HYPERELASTIC, NEO HOOKE\n3., .04\n", "law: mooney_rivlin, c1: 3, c2: 0, bulk_modulus: 50"},
      {"*HYPERELASTIC, MOONEY-RIVLIN\n3., 1., .04\n", "law: mooney_rivlin, c1: 3, c2: 1, bulk_modulus: 50"},
      {"*HYPERELASTIC, OGDEN\n3., 1.5, .04\n", "law: ogden, mu: [4], alpha: [1.5], bulk_modulus: 50"},
      {"*HYPERELASTIC, OGDEN, N=3\n3., 2., -.5, -2., .1, 5., .04, 0\n0\n",
       "law: ogden, mu: [3, 0.5, 0.04], alpha: [2, -2, 5], bulk_modulus: 50"},
      {"*HYPERELASTIC, POLYNOMIAL, N=1\n3., 1., .04\n", "law: mooney_rivlin, c1: 3, c2: 1, bulk_modulus: 50"},
      {"*HYPERELASTIC, YEOH\n3., -.1, .2, .04\n", "law: yeoh, c1: 3, c2: -0.1, c3: 0.2, bulk_modulus: 50"}};
  for (const auto& [card, law] : laws) {
    const Model model = readText(begin + card + end, Deck::yes);
    EXPECT_NE(model.deck.find(law), std::string::npos) << model.deck;
    deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
  }
  expectRefused(begin + "*HYPERELASTIC, NEO HOOKE\n3., 0.\n" + end, Deck::yes,
                ":15: *HYPERELASTIC: D1 is not positive");
  expectRefused(begin + "*HYPERELASTIC, ARRUDA-BOYCE\n3., 5., .1\n" + end, Deck::yes,
                ":15: *HYPERELASTIC: no law here is equal");
  expectRefused(begin + "*HYPERELASTIC, OGDEN\n3., 0., .1\n" + end, Deck::yes,
                ":15: *HYPERELASTIC, OGDEN: term 1 has a constant that is 0");
  expectRefused(begin + "*ELASTIC, TYPE=ORTHO\n3., 0.\n" + end, Deck::yes, ":15: *ELASTIC, TYPE=ORTHO");
  expectRefused(begin + end, Deck::yes, ":14: material 'm' has neither");
}

TEST(Inp, Plasticity) {
  const std::string begin = kCubeOfM + "*ELASTIC\n2e5, .3\n", &end = kPulled;
  const std::string law = "law: von_mises, youngs_modulus: 200000, poissons_ratio: 0.3, yield_stress: 250";
  const std::vector<std::pair<std::string, std::string>> keys{
      {"*PLASTIC\n250.\n", ", blocks"},
      {"*PLASTIC\n250., 0.\n260., .01\n", ", hardening_modulus: 1000, blocks"},
      {"*PLASTIC\n250., 0.\n260., .01\n270., .02\n280., .03\n", ", hardening_modulus: 1000, blocks"},
      {"*PLASTIC, HARDENING=KINEMATIC\n250., 0.\n260., .01\n", ", kinematic_modulus: 1000, blocks"},
      {"*PLASTIC\n250., 0., 20.\n260., .01, 20.\n200., 0., 400.\n", ", hardening_modulus: 1000, blocks"}};
  for (const auto& [card, key] : keys) {
    const Model model = readText(begin + card + end, Deck::yes);
    EXPECT_NE(model.deck.find(law + key), std::string::npos) << model.deck;
    deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
    EXPECT_EQ(tells(model, "rows of other temperatures"), card.find("400") != std::string::npos);
    EXPECT_EQ(tells(model, "hardening goes on as before it"), card.find("260") != std::string::npos);
    EXPECT_FALSE(tells(model, "a curve through"));
  }
  // With large strains those of metals are too, in solids.
  std::string large = begin + "*PLASTIC\n250.\n" + end;
  large.replace(large.find("*STEP"), 5, "*STEP, NLGEOM");
  EXPECT_NE(readText(large, Deck::yes).deck.find(law + ", strains: finite"), std::string::npos);

  expectRefused(begin + "*PLASTIC, HARDENING=JOHNSON COOK\n250.\n" + end, Deck::yes,
                ":17: *PLASTIC, HARDENING=JOHNSON");
  expectRefused(begin + "*PLASTIC\n" + end, Deck::yes, ":17: *PLASTIC: has no row");
  expectRefused(begin + "*PLASTIC\n-1.\n" + end, Deck::yes,
                ":18: *PLASTIC: the yield stress is not positive");
  expectRefused(begin + "*PLASTIC\n250., 0.\n260., 0.\n" + end, Deck::yes,
                ":19: *PLASTIC: plastic strains must begin");
  expectRefused(begin + "*PLASTIC, HARDENING=KINEMATIC\n250., 0.\n240., .1\n" + end, Deck::yes,
                "the yield stress falls");
}

// Tables of the law itself give its constants back, others a curve as near as the line says.
TEST(Inp, HardeningCurves) {
  const std::string begin = kCubeOfM + "*ELASTIC\n2e5, .3\n", &end = kPulled;
  const auto hardened = [&](const std::string& parameters, const std::function<double(double)>& stress) {
    std::string rows;
    for (int i = 0; i <= 20; ++i) {
      const double g = 0.3 * i * i / 400;
      rows += std::to_string(stress(g)) + ", " + std::to_string(g) + "\n";
    }
    const Model model = readText(begin + "*PLASTIC" + parameters + "\n" + rows + end, Deck::yes);
    const deck::Deck read = deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
    return std::make_pair(std::get<deck::VonMises>(read.materials.at(0).law), model);
  };
  const auto [voce, told] =
      hardened("", [](double g) { return 250 + 130 * g + 270 * (1 - std::exp(-17 * g)); });
  // Exponents are looked for in steps of half a percent.
  EXPECT_NEAR(voce.hardeningModulus, 130, 10);
  EXPECT_NEAR(voce.saturation, 270, 3);
  EXPECT_NEAR(voce.exponent, 17, 0.1);
  EXPECT_TRUE(tells(told, "*PLASTIC: a curve through its 21 rows, off by 0.0")) << told.remarks.back();

  const auto [swift, near] =
      hardened("", [](double g) { return 500 * std::pow(0.01 + g, 0.2) / std::pow(0.01, 0.2); });
  double off = 0;
  for (int i = 0; i <= 20; ++i) {
    const double g = 0.3 * i * i / 400, exact = 500 * std::pow(1 + 100 * g, 0.2);
    off = std::max(off, std::abs((500 + swift.hardeningModulus * g +
                                  swift.saturation * (1 - std::exp(-swift.exponent * g))) /
                                     exact -
                                 1));
  }
  EXPECT_LT(off, 0.04);  // a power is no exponential
  EXPECT_TRUE(tells(near, fmt::format("off by {:.2g} % at most", 100 * off))) << off;

  const auto [back, line] =
      hardened(", HARDENING=KINEMATIC", [](double g) { return 250 + 100 * (1 - std::exp(-30 * g)); });
  EXPECT_NEAR(back.kinematicModulus, 3000, 20);
  EXPECT_NEAR(back.recall, 30, 0.2);
}

/// Two cubes on each other, whose meshes are apart: nodes 21 to 24 are at the places of 5 to 8.
const std::string kTwoCubes =
    "*NODE\n1\n2, 1.\n3, 1., 1.\n4, 0, 1\n5, 0, 0, 1\n6, 1, 0, 1\n7, 1, 1, 1\n8, 0, 1, 1\n"
    "21, 0, 0, 1.0000001\n22, 1, 0, 1\n23, 1, 1, 1\n24, 0, 1, 1\n25, 0, 0, 2\n26, 1, 0, 2\n27, 1, 1, 2\n28, "
    "0, 1, 2\n"
    "99, .5, .5, 3.\n98, .5, .5, 3.\n"
    "*ELEMENT, TYPE=C3D8, ELSET=cube\n1, 1,2,3,4,5,6,7,8\n2, 21,22,23,24,25,26,27,28\n"
    "*SURFACE, NAME=lower\n1, S2\n*SURFACE, NAME=upper\n2, S1\n*NSET, NSET=head\n25, 26, 27, 28\n"
    "*NSET, NSET=seam\n21, 22, 23, 24\n";

TEST(Inp, TiedSurfaces) {
  const Model model = readText(kTwoCubes + "*TIE, NAME=t\nupper, lower\n");
  EXPECT_TRUE(tells(model, "*TIE: 4 nodes of 'upper' are one with those of 'lower'"));
  EXPECT_EQ(model.mesh.numNodes(), 12);
  EXPECT_EQ(std::vector<int>(model.mesh.blocks[0].nodes.begin() + 8, model.mesh.blocks[0].nodes.begin() + 12),
            (std::vector<int>{4, 5, 6, 7}));
  for (const fem::NodeSet& set : model.mesh.nodeSets)
    if (set.name == "seam") {
      EXPECT_EQ(set.nodes, (std::vector<int>{4, 5, 6, 7}));
    }
  std::string apart = kTwoCubes + "*TIE, NAME=t\nupper, lower\n";
  apart.replace(apart.find("23, 1, 1, 1\n"), 12, "23, 1, .9, 1\n");
  const Model left = readText(apart);
  EXPECT_EQ(left.mesh.numNodes(), 16);
  EXPECT_TRUE(tells(left,
                    "*TIE: a coupling of kind tie of the deck, 1 of 4 nodes of 'upper' are at no node of "
                    "'lower', first node 23"));
  const Model deck = readText(
      apart + kSteel + "*BOUNDARY\n1, 1, 3\n2, 1, 3\n3, 1, 3\n*STEP\n*STATIC\n*CLOAD\n25, 3, 4.\n*END STEP\n",
      Deck::yes);
  EXPECT_NE(deck.deck.find("couplings:\n  upper: {kind: tie, set: upper, to: lower}\n"), std::string::npos)
      << deck.deck;
  // Of nodes alone there are no faces.
  const std::string faces =
      "*SURFACE, NAME=upper\n2, S1\n*NSET, NSET=head\n25, 26, 27, 28\n*NSET, NSET=seam\n21, 22, 23, 24\n";
  std::string ofNodes = apart;
  ofNodes.replace(ofNodes.find(faces), faces.size(),
                  "*NSET, NSET=seam\n21, 22, 23, 24\n*SURFACE, NAME=upper, TYPE=NODE\nseam\n");
  EXPECT_TRUE(tells(readText(ofNodes, Deck::no), "*TIE: left out, 1 of 4 nodes of 'upper'"));
  expectRefused(kTwoCubes + "*TIE, NAME=t\nupper, roof\n", Deck::no, ":32: *TIE: there is no surface 'roof'");
  expectRefused(kTwoCubes + "*SURFACE, NAME=all, TYPE=NODE\nhead\n*TIE, NAME=t\nhead, all\n" +
                    "*TIE, NAME=t\nlower, lower\n*NODE\n30, 0, 0, 1\n*ELEMENT, TYPE=C3D4\n5, 5, 6, 7, 30\n" +
                    "*SURFACE, NAME=flat, TYPE=NODE\n30\n*TIE, NAME=t\nflat, lower\n",
                Deck::no, "*TIE: ties nodes of element 5 to each other");
}

TEST(Inp, RigidBodies) {
  const std::string begin = kTwoCubes + "*TIE, NAME=t\nupper, lower\n" + kSteel +
                            "*BOUNDARY\n1, 1, 3\n2, 1, 3\n3, 1, 3\n",
                    body = "*RIGID BODY, NSET=head, REF NODE=99, ROT NODE=98\n", step = "*STEP\n*STATIC\n",
                    load = "*CLOAD\n99, 3, 4.\n", end = "*END STEP\n";
  const auto deckOf = [](const std::string& text) {
    const Model model = readText(text, Deck::yes);
    deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
    return model.deck;
  };
  const auto expectIn = [](const std::string& deck, const std::string& part) {
    EXPECT_NE(deck.find(part), std::string::npos) << part << "\n" << deck;
  };
  // Free to turn: the reference node leads.
  const std::string turns = deckOf(begin + body + step + load + "*BOUNDARY\n99, 1, 2\n" + end);
  expectIn(turns, "head: {kind: rigid, set: head, reference: reference_1}");
  expectIn(turns, "set: reference_1, x: 0, y: 0}");
  expectIn(turns, "per_node: [0, 0, 4]");
  // Without turns: the nodes move alike, or as they are driven.
  const std::string alike = deckOf(begin + body + step + load + "*BOUNDARY\n98, 1, 3\n99, 1, 2\n" + end);
  expectIn(alike, "head: {kind: equal, set: head}");
  expectIn(alike, "x: 0, y: 0}");
  const std::string driven =
      deckOf(begin + body + step + "*BOUNDARY\n99, 1, 2\n99, 4, 6\n99, 3, 3, -.5\n" + end);
  expectIn(driven, "set: head, x: 0, y: 0, z: {per_load_factor: -0.5}");
  EXPECT_EQ(driven.find("couplings"), std::string::npos) << driven;

  // About one axis: freely under a moment, by its ROT NODE or by components 4 to 6, or driven, in radians
  // there.
  const std::string moment =
      deckOf(begin + body + step + load + "*CLOAD\n98, 3, 7.\n*BOUNDARY\n98, 1, 2\n" + end);
  expectIn(moment, "head: {kind: rigid, set: head, reference: reference_1, axis: [0, 0, 1]}");
  expectIn(moment, "head: {type: moment, coupling: head, moment: 7}");
  expectIn(moment, "head_angle: {type: rotation, coupling: head}");
  const std::string alone = "*RIGID BODY, NSET=head, REF NODE=99\n";
  EXPECT_EQ(deckOf(begin + alone + step + load + "*CLOAD\n99, 6, 7.\n*BOUNDARY\n99, 4, 5\n" + end), moment);
  const std::string turned = deckOf(begin + body + step + "*BOUNDARY\n98, 1, 2\n98, 3, 3, .5\n" + end);
  expectIn(turned, "axis: [0, 0, 1], angle: {per_load_factor: 28.6478897565");
  expectIn(turned, "head_moment: {type: moment, coupling: head}");

  expectRefused(begin + body + step + load + "*BOUNDARY\n98, 1, 1\n" + end, Deck::yes,
                "*RIGID BODY: turns about more than one axis");
  expectRefused(begin + body + step + load + "*BOUNDARY\n98, 1, 1\n98, 2, 3, .1\n" + end, Deck::yes,
                "*RIGID BODY: turns about more than one axis");
  expectRefused(begin + body + step + "*CLOAD\n98, 3, 4.\n" + end, Deck::yes,
                "*RIGID BODY: a moment on a body that turns in all directions");
  expectRefused(begin + "*RIGID BODY, NSET=head, REF NODE=head\n" + step + load + end, Deck::yes,
                "*RIGID BODY, REFNODE: names 4 nodes; expected one");
  EXPECT_TRUE(tells(readText(begin + "*RIGID BODY, ANALYTICAL SURFACE=s, REF NODE=99\n", Deck::no),
                    "*RIGID BODY: left out"));
}

TEST(Inp, DecksThatWouldBeAnotherProblemAreRefused) {
  const std::string step = "*STEP\n*STATIC\n*CLOAD\n7, 1, 1.\n*END STEP\n";
  expectRefused(kCube + kSteel, Deck::yes, "has no step with *STATIC or *BUCKLE");
  expectRefused(kCube + kSteel + step, Deck::yes, "has no *BOUNDARY");
  expectRefused(kCube + kSteel + "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*END STEP\n", Deck::yes, "has no load");
  expectRefused(kCube + "*BOUNDARY\n1, 1, 3\n" + step, Deck::yes, "has no section with a material");
}

TEST(Inp, Equations) {
  const std::string begin = kCube + kSteel + "*NSET, NSET=a\n3, 4\n*NSET, NSET=b\n7, 8\n",
                    step =
                        "*BOUNDARY\n1, 1, 3\n2, 1, 3\n5, 1, 3\n*STEP\n*STATIC\n*CLOAD\n7, 1, 1.\n*END STEP\n";
  const Model model = readText(
      begin + "*EQUATION\n2\na, 1, 1., b, 1, -1.\n3\n6, 2, 2., 7, 2, -1.,\n8, 2, -1.\n" + step, Deck::yes);
  deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
  EXPECT_NE(model.deck.find("{kind: equation, terms: [[a, x, 1], [b, x, -1]]}"), std::string::npos)
      << model.deck;
  EXPECT_NE(model.deck.find(", y, 2], ["), std::string::npos) << model.deck;
  EXPECT_TRUE(tells(readText(begin + "*EQUATION\n2\n6, 4, 2., 7, 2, -1.\n", Deck::no),
                    "*EQUATION: left out, it has rotations"));
  EXPECT_TRUE(
      tells(readText(begin + "*EQUATION\n1\n6, 1, 2.\n", Deck::no), "*EQUATION: left out, it has one term"));
  EXPECT_TRUE(tells(readText(begin + "*EQUATION\n2\n6, 1, 2., 7, 1, 1.\n", Deck::no),
                    "*EQUATION: left out, this one and those behind it"));
  expectRefused(begin + "*EQUATION\n3\n6, 1, 2., 7, 1, 1.\n", Deck::no, "*EQUATION: ends before its 3 terms");
  expectRefused(begin + "*EQUATION\n2\na, 1, 2., all, 1, 1.\n", Deck::no,
                "*EQUATION: its sets have different numbers of nodes");
}

// Axes of nodes: supports along what is no axis of the model get a normal, forces are turned.
TEST(Inp, Transforms) {
  const auto deckOf = [](const std::string& transform, const std::string& inStep) {
    const Model model =
        readText(kCube + kSteel + "*NSET, NSET=two\n7, 8\n*TRANSFORM, NSET=two" + transform +
                     "*BOUNDARY\n1, 1, 3\n2, 1, 3\n4, 1, 3\n" + "*STEP\n*STATIC\n" + inStep + "*END STEP\n",
                 Deck::yes);
    deck::readDeckText("mesh: {file: m.exo}\n" + model.deck, "m.yaml");
    return model.deck;
  };
  const auto expectIn = [](const std::string& deck, const std::string& part) {
    EXPECT_NE(deck.find(part), std::string::npos) << part << "\n" << deck;
  };
  // x' along (3, 4, 0)/5: y' is (-4, 3, 0)/5.
  const std::string turned =
      deckOf("\n3, 4, 0, -4, 3, 0\n", "*BOUNDARY\n7, 2, 2, .5\n8, 3, 3\n*CLOAD\n8, 1, 10.\n");
  expectIn(turned, "normal: [-0.8, 0.6, 0], value: {per_load_factor: 0.5}");
  expectIn(turned, "_force: {type: reaction, support: ");
  expectIn(turned, ", z: 0}");  // z' is z
  expectIn(turned, "per_node: [6, 8, 0]");
  // Around the axis z: node 7 is at (1, 1, 1), 8 at (0, 1, 1).
  const std::string around =
      deckOf(", TYPE=C\n0, 0, 0, 0, 0, 1\n", "*BOUNDARY\ntwo, 1, 1\n*CLOAD\ntwo, 2, 1.\n");
  expectIn(around, "normal: [0.707106781187");
  expectIn(around, ", y: 0}");
  expectIn(around, "per_node: [-1, 0, 0]");
  const auto refused = [](const std::string& transform, const std::string& words) {
    expectRefused(kCube + kSteel + "*NSET, NSET=two\n7, 8\n*TRANSFORM" + transform +
                      "*BOUNDARY\n1, 1, 3\n*STEP\n*STATIC\n*CLOAD\n7, 1, 1.\n*END STEP\n",
                  Deck::yes, words);
  };
  refused("\n1, 0, 0, 0, 1, 0\n", "*TRANSFORM: has no NSET");
  refused(", NSET=two, TYPE=S\n0, 0, 0, 0, 0, 1\n", "*TRANSFORM, TYPE=S: expected R or C");
  refused(", NSET=two\n", "*TRANSFORM: has no line with two points");
  refused(", NSET=two\n1, 0, 0, 2, 0, 0\n", "*TRANSFORM: its points and the origin are on one line");
  // Node 7 on the axis: any two directions across it.
  expectIn(deckOf(", TYPE=C\n1, 1, 0, 1, 1, 1\n", "*BOUNDARY\n7, 1, 2\n*CLOAD\n8, 1, 10.\n"), "x: 0, y: 0}");
}

TEST(Inp, LoadsAndSupportsThatDecksCannotHave) {
  const std::string held = "*BOUNDARY\n1, 1, 3\n", begin = "*STEP\n*STATIC\n", end = "*END STEP\n";
  const auto loads = [&](const std::string& text) { return kCube + kSteel + held + begin + text + end; };
  expectRefused(kNodes + "*ELEMENT, TYPE=C3D4, ELSET=cube\n1, 1,2,3,5\n" + kSteel + held + begin +
                    "*DLOAD\ncube, P5, 1.\n" + end,
                Deck::yes, ":24: element 1 has no face for 'P5'");
  expectRefused(loads("*DSLOAD\nnone, P, 1.\n"), Deck::yes, ":24: there is no surface 'none' of elements");
  expectRefused(kCube + kSteel + "*BOUNDARY\n1, 1, 1, .5\n" + begin + "*CLOAD\n7, 1, 1.\n" + end, Deck::yes,
                ":20: a displacement before the first step is not 0; expected it in a step");
  expectRefused(kCube + kSteel + "*BOUNDARY\n1, XSYM\n" + begin + "*CLOAD\n7, 1, 1.\n" + end, Deck::yes,
                ":20: 'XSYM' is no degree of freedom; expected 1 to 6, XSYMM");
  std::string light = loads("*DLOAD\ncube, GRAV, 10., 0., 0., -2.\n");
  const std::string density = "*DENSITY\n2.\n";
  light.erase(light.find(density), density.size());
  expectRefused(light, Deck::yes, "gravity acts on material 'steel', which has no *DENSITY");
  expectRefused(
      kNodes + "*ELEMENT, TYPE=CPS4, ELSET=a\n1, 1,2,3,4\n*ELEMENT, TYPE=CPS4, ELSET=cube\n2, 1,2,3,4\n" +
          kSteel + "1.\n" + "*SOLID SECTION, ELSET=a, MATERIAL=steel\n2.\n" + held + begin +
          "*CLOAD\n3, 1, 1.\n" + end,
      Deck::yes, "sections of plane elements have thicknesses 1 and 2; a deck has one");
  std::string many = kNodes + "*ELEMENT, TYPE=C3D8, ELSET=cube\n", weights = "*DLOAD\n";
  for (int e = 1; e <= 65; ++e) {
    many += std::to_string(e) + ", 1,2,3,4,5,6,7,8\n";
    weights += std::to_string(e) + ", GRAV, 10., 0., 0., -2.\n";
  }
  expectRefused(many + kSteel + held + begin + weights + end, Deck::yes,
                "has loads by volume on 65 different element sets; expected at most 64");
}

}  // namespace
}  // namespace atrapos::importer
