// Part files: what is cut, written, read and joined is what there was; parts that do not fit are refused.
#include <exodusII.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>

#include "SampleMesh.hpp"
#include "TempFile.hpp"
#include "atrapos/exodus/Decomposition.hpp"
#include "atrapos/exodus/JoinedResults.hpp"
#include "atrapos/exodus/MeshFile.hpp"

using namespace atrapos;

namespace {

/// The sample mesh with ascending ids and lists, as joined meshes have them.
fem::Mesh ascendingSample(fem::Topology topology) {
  fem::Mesh mesh = sampleMesh(topology);
  for (std::size_t i = 0; i < mesh.nodeIds.size(); ++i) mesh.nodeIds[i] = 100 + 3 * static_cast<long long>(i);
  for (auto& set : mesh.nodeSets) std::sort(set.nodes.begin(), set.nodes.end());
  for (auto& set : mesh.sideSets)
    std::sort(set.sides.begin(), set.sides.end(), [](const fem::Side& a, const fem::Side& b) {
      return std::make_pair(a.element, a.side) < std::make_pair(b.element, b.side);
    });
  return mesh;
}

/// Elements dealt out in turn: every part touches every other one, and no block is whole anywhere.
std::vector<int> dealt(const fem::Mesh& mesh, int parts) {
  std::vector<int> part;
  for (int e = 0; e < mesh.numElements(); ++e) part.push_back(e % parts);
  return part;
}

std::vector<exodus::MeshPart> writtenAndRead(const exodus::Decomposition& cut, const std::string& file) {
  std::vector<exodus::MeshPart> parts;
  for (int p = 0; p < cut.parts(); ++p) {
    exodus::writePart(cut.part(p), file);
    parts.push_back(exodus::readPart(exodus::partName(file, cut.parts(), p)));
  }
  return parts;
}

std::string messageOf(const std::function<void()>& f) {
  try {
    f();
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

class Parts : public testing::TestWithParam<fem::Topology> {};

TEST_P(Parts, JoinToTheMeshThatWasCut) {
  const fem::Mesh mesh = ascendingSample(GetParam());
  for (const int parts : {1, 2, 3}) {
    SCOPED_TRACE(parts);
    const TempFile temp;
    const exodus::Decomposition cut(mesh, dealt(mesh, parts), parts);
    const auto joined = exodus::join(writtenAndRead(cut, temp()), temp());
    expectEqual(mesh, joined.mesh);
    EXPECT_EQ(joined.partOfElement, dealt(mesh, parts));
    for (int p = 0; p < parts; ++p) {
      EXPECT_EQ(joined.nodes[p], cut.nodes(p));
      EXPECT_EQ(joined.elements[p], cut.elements(p));
    }
    EXPECT_EQ(exodus::findParts(temp()), std::vector<int>{parts});
  }
}

INSTANTIATE_TEST_SUITE_P(Cells, Parts,
                         testing::Values(fem::Topology::Hex8, fem::Topology::Hex20, fem::Topology::Tet10,
                                         fem::Topology::Wedge15),
                         [](const auto& info) { return fem::topologyName(info.param); });

TEST(Parts, BordersNameTheSharedNodesOnBothSides) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex20);
  const TempFile temp;
  const exodus::Decomposition cut(mesh, dealt(mesh, 3), 3);
  const auto parts = writtenAndRead(cut, temp());
  for (const auto& part : parts) {
    EXPECT_EQ(part.whole.nodes, mesh.numNodes());
    EXPECT_EQ(part.whole.elements, mesh.numElements());
    for (const auto& border : part.borders) {
      std::set<long long> mine(part.mesh.nodeIds.begin(), part.mesh.nodeIds.end());
      std::vector<long long> common, listed;
      for (const long long id : parts[border.part].mesh.nodeIds)
        if (mine.count(id) > 0) common.push_back(id);
      for (const int n : border.nodes) listed.push_back(part.mesh.nodeIds[n]);
      EXPECT_EQ(listed, common);
      EXPECT_FALSE(listed.empty());
    }
  }
  EXPECT_EQ(parts[0].borders.size(), 2u);
}

// What the library says of a file, as other programs read it.
TEST(Parts, HaveNemesisRecords) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  const TempFile temp;
  const exodus::Decomposition cut(mesh, dealt(mesh, 2), 2);
  exodus::writePart(cut.part(1), temp());
  int words = 8, fileWords = 0, parts = 0, inFile = 0;
  float version = 0;
  const int id = ex_open(temp("file.exo.2.1").c_str(), EX_READ, &words, &fileWords, &version);
  ASSERT_GE(id, 0);
  char kind[MAX_STR_LENGTH + 1] = "";
  EXPECT_GE(ex_get_init_info(id, &parts, &inFile, kind), 0);
  EXPECT_EQ(parts, 2);
  EXPECT_EQ(inFile, 1);
  int inner = 0, border = 0, external = 0, innerElements = 0, borderElements = 0, maps = 0, faceMaps = 0;
  EXPECT_GE(ex_get_loadbal_param(id, &inner, &border, &external, &innerElements, &borderElements, &maps,
                                 &faceMaps, 1),
            0);
  EXPECT_EQ(inner + border, static_cast<int>(cut.nodes(1).size()));
  EXPECT_EQ(innerElements + borderElements, static_cast<int>(cut.elements(1).size()));
  EXPECT_EQ(border, static_cast<int>(cut.part(1).borders[0].nodes.size()));
  EXPECT_EQ(maps, 1);
  int blockIds[2], blockCounts[2];
  EXPECT_GE(ex_get_eb_info_global(id, blockIds, blockCounts), 0);
  EXPECT_EQ(blockIds[0], 42);
  EXPECT_EQ(blockIds[1], 7);
  EXPECT_EQ(blockCounts[0] + blockCounts[1], mesh.numElements());
  std::vector<int> innerNodes(inner), borderNodes(border), none(1);
  EXPECT_GE(ex_get_processor_node_maps(id, innerNodes.data(), borderNodes.data(), none.data(), 1), 0);
  std::vector<int> all = innerNodes;
  all.insert(all.end(), borderNodes.begin(), borderNodes.end());
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(all[i], static_cast<int>(i) + 1);
  ex_close(id);
}

TEST(Parts, MayBeEmpty) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  const TempFile temp;
  const std::vector<int> all(mesh.numElements(), 1);
  const exodus::Decomposition cut(mesh, all, 3);
  const auto parts = writtenAndRead(cut, temp());
  EXPECT_EQ(parts[0].mesh.numNodes(), 0);
  EXPECT_EQ(parts[2].mesh.numElements(), 0);
  expectEqual(mesh, exodus::join(parts, temp()).mesh);
}

TEST(Parts, NodesWithoutElementsAreInTheFirst) {
  fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  mesh.coordinates.insert(mesh.coordinates.end(), {9, 9, 9});
  mesh.nodeIds.push_back(100000);
  const TempFile temp;
  const exodus::Decomposition cut(mesh, dealt(mesh, 2), 2);
  EXPECT_EQ(cut.nodes(0).back(), mesh.numNodes() - 1);
  EXPECT_LT(cut.nodes(1).back(), mesh.numNodes() - 1);
  expectEqual(mesh, exodus::join(writtenAndRead(cut, temp()), temp()).mesh);
}

TEST(Parts, OfAnotherOrderOfIdsJoinByIds) {
  const fem::Mesh mesh = sampleMesh(fem::Topology::Hex8);  // descending ids of nodes
  const TempFile temp;
  const exodus::Decomposition cut(mesh, dealt(mesh, 2), 2);
  const auto joined = exodus::join(writtenAndRead(cut, temp()), temp());
  EXPECT_TRUE(std::is_sorted(joined.mesh.nodeIds.begin(), joined.mesh.nodeIds.end()));
  const int last = mesh.numNodes() - 1;
  for (int n = 0; n <= last; ++n)
    for (int i = 0; i < 3; ++i)
      EXPECT_EQ(joined.mesh.coordinates[3 * n + i], mesh.coordinates[3 * (last - n) + i]);
}

TEST(Parts, NamesAreThoseOfSeacas) {
  EXPECT_EQ(exodus::partName("mesh.exo", 4, 3), "mesh.exo.4.3");
  EXPECT_EQ(exodus::partName("mesh.exo", 16, 3), "mesh.exo.16.03");
  const auto name = exodus::parsePartName("a.b/mesh.exo.128.007");
  EXPECT_EQ(name.file, "a.b/mesh.exo");
  EXPECT_EQ(name.parts, 128);
  EXPECT_EQ(name.part, 7);
  for (const char* wrong : {"mesh.exo", "mesh.exo.3", "mesh.exo.3.3", "mesh.exo.16.3", "mesh.exo.0.0", ".3.1",
                            "mesh.exo.-3.1", "mesh.exo..1", "mesh.exo.3."})
    EXPECT_THROW(exodus::parsePartName(wrong), exodus::Error) << wrong;
}

TEST(Parts, ThatDoNotFitAreRefused) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  const exodus::Decomposition cut(mesh, dealt(mesh, 2), 2);
  const std::vector<exodus::MeshPart> good{cut.part(0), cut.part(1)};
  ASSERT_EQ(messageOf([&] { exodus::join(good, "m"); }), "");
  const auto refused = [&](const std::function<void(std::vector<exodus::MeshPart>&)>& damage) {
    auto parts = good;
    damage(parts);
    return messageOf([&] { exodus::join(parts, "m"); });
  };
  EXPECT_EQ(refused([](auto& p) { p.pop_back(); }), "m: part 0 of 2 stands where part 0 of 1 is needed");
  EXPECT_EQ(refused([](auto& p) { p[1].mesh.blocks[0].id = 8; }),
            "m: part 1 has not the same blocks as part 0");
  EXPECT_NE(refused([](auto& p) { p[1].mesh.coordinates[0] += 1; }).find("at another one in part 1"),
            std::string::npos);
  EXPECT_NE(refused([](auto& p) { p[1].mesh.nodeIds[0] = 5; }).find("nodes together, the files announce"),
            std::string::npos);
  EXPECT_NE(
      refused([](auto& p) { p[1].mesh.elementIds[0] = p[0].mesh.elementIds[0]; }).find("again in part 1"),
      std::string::npos);
  EXPECT_EQ(refused([](auto& p) { p[1].borders[0].nodes.pop_back(); }),
            "m: the communication maps of parts 0 and 1 do not name the same nodes");
  EXPECT_NE(refused([](auto& p) { p[1].whole.nodes += 1; }).find("part 1 is of a mesh with"),
            std::string::npos);
}

TEST(Parts, WholeFilesAreNotParts) {
  const TempFile temp;
  exodus::writeMesh(ascendingSample(fem::Topology::Hex8), temp("file.exo.2.0"));
  EXPECT_NE(
      messageOf([&] { exodus::readPart(temp("file.exo.2.0")); }).find("is not a part of a decomposed mesh"),
      std::string::npos);
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  exodus::writePart(exodus::Decomposition(mesh, dealt(mesh, 2), 2).part(0), temp());
  std::filesystem::rename(temp("file.exo.2.0"), temp("file.exo.3.0"));
  EXPECT_NE(messageOf([&] { exodus::readPart(temp("file.exo.3.0")); }).find("holds 1 of 2 parts"),
            std::string::npos);
}

TEST(Parts, IdsThatOccurTwiceAreRefused) {
  fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  mesh.nodeIds[1] = mesh.nodeIds[0];
  EXPECT_NE(
      messageOf([&] { exodus::Decomposition(mesh, dealt(mesh, 2), 2); }).find("two nodes have the id 100"),
      std::string::npos);
}

/// Values of the whole mesh that differ by step, variable and place.
std::vector<double> wholeValues(int step, int variable, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(100 * step + 10 * variable + 1.0 / (3 + i));
  return values;
}

std::vector<double> chosen(const std::vector<double>& whole, const std::vector<int>& places) {
  std::vector<double> values;
  for (const int i : places) values.push_back(whole[i]);
  return values;
}

/// Writes the results of the whole mesh in parts, each with as many steps as its entry says.
void writeResults(const exodus::Decomposition& cut, const fem::Mesh& mesh, const exodus::ResultNames& names,
                  const std::vector<int>& steps, const std::string& file) {
  for (int p = 0; p < cut.parts(); ++p) {
    exodus::ResultWriter writer(file, cut.part(p), names);
    for (int step = 0; step < steps[p]; ++step) {
      std::vector<double> nodal, element;
      for (int v = 0; v < 2; ++v) {
        const auto n = chosen(wholeValues(step, v, mesh.numNodes()), cut.nodes(p));
        nodal.insert(nodal.end(), n.begin(), n.end());
        const auto e = chosen(wholeValues(step, 5 + v, mesh.numElements()), cut.elements(p));
        element.insert(element.end(), e.begin(), e.end());
      }
      writer.writeStep(0.5 * step, nodal, element, wholeValues(step, 9, 1));
    }
  }
}

const exodus::ResultNames kNames{
    {"displ_x", "displ_y"}, {"stress_xx", "stress_yy"}, {"load_factor"}, {"mesh:", "  a line of a deck"}, {}};

TEST(PartResults, JoinToThoseOfTheWhole) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex20);
  const TempFile temp;
  // The last part has no elements.
  const exodus::Decomposition cut(mesh, dealt(mesh, 3), 4);
  writeResults(cut, mesh, kNames, {3, 3, 3, 3}, temp());
  const exodus::JoinedResults results(temp(), 4);
  EXPECT_FALSE(results.uneven());
  exodus::writeJoined(results, temp("joined.exo"));
  expectEqual(mesh, exodus::readMesh(temp("joined.exo")));
  const exodus::ResultReader reader(temp("joined.exo"));
  ASSERT_EQ(reader.numSteps(), 3);
  EXPECT_EQ(reader.nodalNames(), kNames.nodal);
  EXPECT_EQ(reader.elementNames(), kNames.element);
  EXPECT_EQ(reader.globalNames(), kNames.global);
  EXPECT_EQ(reader.info(), kNames.info);
  EXPECT_EQ(reader.times(), (std::vector<double>{0, 0.5, 1}));
  for (int step = 0; step < 3; ++step) {
    for (int v = 0; v < 2; ++v) {
      EXPECT_EQ(reader.nodal(step, kNames.nodal[v]), wholeValues(step, v, mesh.numNodes()));
      EXPECT_EQ(reader.element(step, kNames.element[v]), wholeValues(step, 5 + v, mesh.numElements()));
    }
    EXPECT_EQ(reader.globals(step), wholeValues(step, 9, 1));
  }
}

TEST(PartResults, OfAnInterruptedRunHaveTheStepsOfAllParts) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  const TempFile temp;
  writeResults(exodus::Decomposition(mesh, dealt(mesh, 2), 2), mesh, kNames, {3, 2}, temp());
  const exodus::JoinedResults results(temp(), 2);
  EXPECT_TRUE(results.uneven());
  EXPECT_EQ(results.numSteps(), 2);
}

TEST(PartResults, OfOtherRunsAreRefused) {
  const fem::Mesh mesh = ascendingSample(fem::Topology::Hex8);
  const exodus::Decomposition cut(mesh, dealt(mesh, 2), 2);
  const TempFile temp;
  writeResults(cut, mesh, kNames, {2, 2}, temp());
  { exodus::ResultWriter other(temp(), cut.part(1), {{"displ_x"}, {}, {}, {}, {}}); }
  EXPECT_NE(messageOf([&] { exodus::JoinedResults(temp(), 2); }).find("part 1 has other variables"),
            std::string::npos);
  {
    exodus::ResultWriter other(temp(), cut.part(1), kNames);
    const std::vector<double> nodal(2 * cut.nodes(1).size()), element(2 * cut.elements(1).size());
    for (const double time : {0.0, 0.25}) other.writeStep(time, nodal, element, wholeValues(0, 9, 1));
  }
  EXPECT_NE(messageOf([&] { exodus::JoinedResults(temp(), 2); }).find("part 1 has steps at other times"),
            std::string::npos);
  std::filesystem::remove(temp("file.exo.2.1"));
  EXPECT_NE(messageOf([&] { exodus::JoinedResults(temp(), 2); }).find("file.exo.2.1"), std::string::npos);
}

}  // namespace
