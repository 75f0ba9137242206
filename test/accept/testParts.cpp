// Decomposed meshes and results through the command: split, run on several ranks, join.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/ShellPlate.hpp"
#include "support/Table.hpp"

namespace atrapos::test {
namespace {

/// A row of solids that bends under its end's load.
const std::string kBeam = R"(mesh:
  file: beam.exo
  generate: {shape: strip, length: 6, width: 1, thickness: 1, divisions: [6, 2, 1], cell: HEX20, block: beam}
materials:
  beam: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0.3, blocks: [beam]}
supports:
  clamp: {set: x_min, x: 0, y: 0, z: 0}
loads:
  end: {type: surface, set: x_max, total: [0, 0, -4]}
path:
  order: 10
  accuracy: 1.0e-4
  stop: {load_factor: 1}
output:
  points_per_step: 2
  monitors:
    tip_uz: {type: displacement, set: x_max, component: z}
)";

/// Well conditioned: what rounds differently must not show (docs/theory/parallel.md).
constexpr double kSame = 1e-10;

struct Beam {
  TemporaryFolder folder;

  explicit Beam(const std::string& deck = kBeam) {
    writeFile(folder / "deck.yaml", deck);
    expectDone(runAtrapos({"mesh", "-q", "deck.yaml"}, folder.path()));
  }

  static void expectDone(const CommandResult& r) {
    if (r.exitCode != 0) throw std::runtime_error(r.err);
  }
  void atrapos(const std::vector<std::string>& words) const { expectDone(runAtrapos(words, folder.path())); }
  void run(int ranks, const std::string& to, const std::vector<std::string>& more = {}) const {
    std::vector<std::string> words{"run", "-q", "deck.yaml", "-o", to};
    words.insert(words.end(), more.begin(), more.end());
    expectDone(runAtraposOnRanks(ranks, words, folder.path()));
  }
  void edit(const std::string& from, const std::string& to) const {
    writeFile(folder / "deck.yaml", edited(readFile(folder / "deck.yaml"), from, to));
  }
  std::string file(const std::string& name) const { return (folder / name).string(); }
  bool has(const std::string& name) const { return std::filesystem::exists(folder / name); }
};

/// Column by column, in parts of the largest value.
void expectSamePath(const Beam& beam, const std::string& a, const std::string& b) {
  const Table x(beam.folder / (a + "/path.csv")), y(beam.folder / (b + "/path.csv"));
  ASSERT_EQ(x.numRows(), y.numRows());
  ASSERT_GT(x.numRows(), 2);
  for (const std::string name : {"path_length", "load_factor", "tip_uz"}) {
    const auto p = x.column(name), q = y.column(name);
    double largest = 0;
    for (const double v : p) largest = std::max(largest, std::abs(v));
    for (std::size_t i = 0; i < p.size(); ++i) EXPECT_NEAR(p[i], q[i], kSame * largest) << name;
  }
}

std::vector<int> sorted(std::vector<int> list) {
  std::sort(list.begin(), list.end());
  return list;
}

std::vector<std::pair<int, int>> sorted(const std::vector<fem::Side>& sides) {
  std::vector<std::pair<int, int>> list;
  for (const fem::Side& side : sides) list.emplace_back(side.element, side.side);
  std::sort(list.begin(), list.end());
  return list;
}

/// The same mesh to the bit; sets may list their members in another order.
void expectSameMesh(const fem::Mesh& a, const fem::Mesh& b) {
  EXPECT_EQ(a.coordinates, b.coordinates);
  EXPECT_EQ(a.nodeIds, b.nodeIds);
  EXPECT_EQ(a.elementIds, b.elementIds);
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_EQ(a.blocks[i].name, b.blocks[i].name);
    EXPECT_EQ(a.blocks[i].nodes, b.blocks[i].nodes);
  }
  ASSERT_EQ(a.nodeSets.size(), b.nodeSets.size());
  for (std::size_t i = 0; i < a.nodeSets.size(); ++i) {
    EXPECT_EQ(a.nodeSets[i].name, b.nodeSets[i].name);
    EXPECT_EQ(sorted(a.nodeSets[i].nodes), sorted(b.nodeSets[i].nodes));
  }
  ASSERT_EQ(a.sideSets.size(), b.sideSets.size());
  for (std::size_t i = 0; i < a.sideSets.size(); ++i) {
    EXPECT_EQ(a.sideSets[i].name, b.sideSets[i].name);
    EXPECT_EQ(sorted(a.sideSets[i].sides), sorted(b.sideSets[i].sides));
  }
}

/// The same states; `tolerance` in parts of the largest value of a variable's kind, 0: to the bit.
void expectSameResults(const std::string& a, const std::string& b, double tolerance) {
  expectSameMesh(exodus::readMesh(a), exodus::readMesh(b));
  const exodus::ResultReader x(a), y(b);
  ASSERT_EQ(x.numSteps(), y.numSteps());
  ASSERT_GT(x.numSteps(), 1);
  ASSERT_EQ(x.nodalNames(), y.nodalNames());
  ASSERT_EQ(x.elementNames(), y.elementNames());
  EXPECT_EQ(x.globalNames(), y.globalNames());
  const auto compare = [&](const std::vector<std::string>& names, const auto& read) {
    double largest = 0, worst = 0;
    for (int step = 0; step < x.numSteps(); ++step)
      for (const std::string& name : names) {
        const auto p = read(x, step, name), q = read(y, step, name);
        ASSERT_EQ(p.size(), q.size());
        for (std::size_t i = 0; i < p.size(); ++i) {
          largest = std::max(largest, std::abs(p[i]));
          worst = std::max(worst, std::abs(p[i] - q[i]));
        }
      }
    EXPECT_GT(largest, 0);
    EXPECT_LE(worst, tolerance * largest);
  };
  compare(x.nodalNames(), [](const auto& f, int step, const auto& name) { return f.nodal(step, name); });
  compare(x.elementNames(), [](const auto& f, int step, const auto& name) { return f.element(step, name); });
}

/// One line that names this, and exit code 2.
void expectRefused(const CommandResult& r, const std::string& problem) {
  EXPECT_EQ(r.exitCode, 2);
  const auto lines = r.errorLines();
  EXPECT_EQ(std::count_if(lines.begin(), lines.end(),
                          [&](const std::string& line) { return line.find(problem) != std::string::npos; }),
            1)
      << problem << " in:\n"
      << r.err;
}

TEST(Parts, OfAMeshJoinToTheMesh) {
  const Beam beam;
  for (const int parts : {1, 3, 12}) {
    beam.atrapos({"split", "-q", "beam.exo", std::to_string(parts)});
    beam.atrapos({"join", "-q", exodus::partName("beam.exo", parts, 0), "-o", "joined.exo"});
    expectSameMesh(exodus::readMesh(beam.file("beam.exo")), exodus::readMesh(beam.file("joined.exo")));
  }
  EXPECT_EQ(exodus::findParts(beam.file("beam.exo")), (std::vector<int>{1, 3, 12}));
}

TEST(Parts, RunOnAsManyRanksFollowsTheSamePath) {
  const Beam beam;
  beam.run(1, "whole");
  for (const int ranks : {2, 3}) {
    SCOPED_TRACE(ranks);
    const std::string n = std::to_string(ranks);
    beam.atrapos({"split", "-q", "beam.exo", n, "-o", "cut" + n + ".exo"});
    // The decomposed mesh has no whole file, and its results are parts.
    beam.edit(ranks == 2 ? "beam.exo" : "cut2.exo", "cut" + n + ".exo");
    if (ranks == 2) beam.edit("  points_per_step: 2", "  points_per_step: 2\n  parts: true");
    beam.run(ranks, "on" + n);
    expectSamePath(beam, "whole", "on" + n);
    const std::string results = "on" + n + "/results.exo";
    EXPECT_FALSE(beam.has(results));
    // Each part has the elements that it had.
    for (int r = 0; r < ranks; ++r)
      EXPECT_EQ(exodus::readPart(exodus::partName(beam.file(results), ranks, r)).mesh.elementIds,
                exodus::readPart(exodus::partName(beam.file("cut" + n + ".exo"), ranks, r)).mesh.elementIds);
    beam.atrapos({"join", "-q", results});
    // Stresses are differences of displacements: ten times as far off.
    expectSameResults(beam.file("whole/results.exo"), beam.file(results), 10 * kSame);
  }
  // A single rank joins the parts itself, and writes the whole.
  beam.run(1, "on1");
  expectSamePath(beam, "whole", "on1");
  EXPECT_TRUE(beam.has("on1/results.exo"));
}

TEST(Parts, OfResultsJoinToTheFileOfTheFirstRank) {
  const Beam beam;
  beam.run(2, "whole");
  beam.edit("  points_per_step: 2", "  points_per_step: 2\n  parts: true");
  beam.run(2, "parts");
  beam.atrapos({"join", "-q", "parts/results.exo.2.0", "parts/results.exo.2.1", "-o", "joined.exo"});
  // MUMPS does not repeat to the bit on several ranks (docs/theory/parallel.md).
  expectSameResults(beam.file("whole/results.exo"), beam.file("joined.exo"), 10 * kSame);
  EXPECT_EQ(exodus::ResultReader(beam.file("joined.exo")).times().size(),
            exodus::ResultReader(beam.file("whole/results.exo")).times().size());
  // The deck goes along.
  EXPECT_EQ(exodus::ResultReader(beam.file("joined.exo")).info().front(), "mesh:");
}

TEST(Parts, OfShellsAndTheirBodiesJoinToo) {
  // Bodies have nodes on the middle surface that no element of the result has.
  const Beam plate(edited(kShellPlate, "  monitors:", "  shells: body\n  monitors:"));
  plate.run(1, "whole");
  plate.atrapos({"split", "-q", "plate.exo", "3"});
  plate.edit("file: plate.exo", "file: plate.exo\n  decomposed: true");
  plate.edit("shells: body", "shells: body\n  parts: true");
  plate.run(3, "parts");
  expectSamePath(plate, "whole", "parts");
  plate.atrapos({"join", "-q", "parts/results.exo"});
  // A tenth of the length thick: differences of displacements are a hundred times as far off.
  expectSameResults(plate.file("whole/results.exo"), plate.file("parts/results.exo"), 100 * kSame);
}

TEST(Parts, RunGoesOnFromPartsWithAnotherNumberOfRanks) {
  const Beam beam;
  beam.edit("points_per_step: 2", "points_per_step: 2\n  parts: true");
  beam.run(3, "three");
  beam.edit("{load_factor: 1}", "{load_factor: 1, steps: 1}");
  beam.run(2, "two");
  beam.edit(", steps: 1}", "}");
  beam.run(3, "two", {"--restart", "two"});
  expectSamePath(beam, "three", "two");
  EXPECT_FALSE(beam.has("two/results.exo.2.0"));  // of the run before
  for (const char* name : {"three", "two"})
    beam.atrapos({"join", "-q", std::string(name) + "/results.exo", "-o", std::string(name) + ".exo"});
  expectSameResults(beam.file("three.exo"), beam.file("two.exo"), 10 * kSame);
}

TEST(Parts, ThatAreMissingOrTooManyAreTold) {
  const Beam beam;
  beam.atrapos({"split", "-q", "beam.exo", "2"});
  beam.edit("file: beam.exo", "file: beam.exo\n  decomposed: true");
  const auto run = [&](int ranks) {
    return runAtraposOnRanks(ranks, {"run", "-q", "deck.yaml"}, beam.folder.path());
  };
  expectRefused(run(3), "beam.exo is cut into 2 parts, but runs on 3 ranks");
  beam.atrapos({"split", "-q", "beam.exo", "3"});
  expectRefused(runAtrapos({"check", "deck.yaml"}, beam.folder.path()),
                "is cut into 2 and again into 3 parts");
  expectRefused(runAtrapos({"join", "beam.exo"}, beam.folder.path()), "is cut into 2 and again into 3 parts");
  expectRefused(runAtrapos({"join", "beam.exo.2.0", "beam.exo.3.0"}, beam.folder.path()),
                "are not parts of one decomposition");
  std::filesystem::copy_file(beam.folder / "beam.exo.2.0", beam.folder / "beam.exo.2.1",
                             std::filesystem::copy_options::overwrite_existing);
  expectRefused(run(2), "beam.exo: ");
  std::filesystem::remove(beam.folder / "beam.exo.2.1");
  expectRefused(run(2), "beam.exo.2.1");
  expectRefused(runAtrapos({"join", "beam.exo.2.0"}, beam.folder.path()), "beam.exo.2.1");
  expectRefused(runAtrapos({"join", "deck.yaml"}, beam.folder.path()), "is not the name of a part file");
  expectRefused(runAtrapos({"split", "beam.exo", "13"}, beam.folder.path()), "has 12 elements");
  for (const int parts : {2, 3})
    for (int p = 0; p < parts; ++p)
      std::filesystem::remove(exodus::partName(beam.file("beam.exo"), parts, p));
  expectRefused(run(2), "there are no part files");
}

}  // namespace
}  // namespace atrapos::test
