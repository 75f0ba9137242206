// Models of CalculiX' own test suite go through `atrapos import --deck`, and their linear displacements agree
// with CalculiX (models.py, models.csv). The first slope of a path is the linear answer: runs end at a load
// factor of 1e-6.
#include <gtest/gtest.h>
#include <zlib.h>

#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"

namespace atrapos::test {
namespace {

/// Of a model by node: displacements of CalculiX.
using Displacements = std::map<long long, std::array<double, 3>>;

std::map<std::string, Displacements> reference() {
  std::map<std::string, Displacements> all;
  std::ifstream file(ATRAPOS_PEER_DATA "/models.csv");
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::istringstream cells(line);
    std::string model, cell;
    std::getline(cells, model, ',');
    std::getline(cells, cell, ',');
    auto& u = all[model][std::stoll(cell)];
    for (double& component : u) {
      std::getline(cells, cell, ',');
      component = std::stod(cell);
    }
  }
  return all;
}

/// The package has long files compressed, short ones as they are; zlib reads both.
std::string modelText(const std::string& name) {
  for (const char* ending : {".inp", ".inp.gz"}) {
    const gzFile file = gzopen((ATRAPOS_CALCULIX_MODELS "/" + name + ending).c_str(), "rb");
    if (file == nullptr) continue;
    std::string text, buffer(1 << 16, '\0');
    for (int n = 0; (n = gzread(file, buffer.data(), static_cast<unsigned>(buffer.size()))) > 0;)
      text.append(buffer, 0, static_cast<std::size_t>(n));
    gzclose(file);
    return text;
  }
  throw std::runtime_error("the package has no model " + name);
}

class CalculixModel : public ::testing::TestWithParam<std::string> {};

TEST_P(CalculixModel, LinearDisplacements) {
  constexpr double load = 1e-6;
  const TemporaryFolder folder;
  writeFile(folder / "model.inp", modelText(GetParam()));
  const CommandResult imported = runAtrapos({"import", "model.inp", "--deck"}, folder.path());
  ASSERT_EQ(imported.exitCode, 0) << imported.err;
  writeFile(folder / "deck.yaml",
            edited(readFile(folder / "model.yaml"), "stop: {load_factor: 1}", "stop: {load_factor: 1.0e-6}"));
  const CommandResult run = runAtrapos({"run", "-q", "deck.yaml", "-o", "results"}, folder.path());
  ASSERT_EQ(run.exitCode, 0) << run.err;

  const fem::Mesh mesh = exodus::readMesh((folder / "model.exo").string());
  const exodus::ResultReader results((folder / "results" / "results.exo").string());
  std::map<long long, std::array<double, 3>> own;
  for (int d = 0; d < mesh.dimension; ++d) {
    const auto u = results.nodal(results.numSteps() - 1, std::string("displ_") + "xyz"[d]);
    for (std::size_t n = 0; n < u.size(); ++n)
      own[mesh.nodeIds.empty() ? static_cast<long long>(n) + 1 : mesh.nodeIds[n]]
         [static_cast<std::size_t>(d)] = u[n] / load;
  }
  const Displacements expected = reference().at(GetParam());
  double largest = 0, worst = 0;
  int compared = 0;
  for (const auto& [node, u] : expected)
    for (int d = 0; d < mesh.dimension; ++d)
      largest = std::max(largest, std::abs(u[static_cast<std::size_t>(d)]));
  for (const auto& [node, u] : expected) {
    const auto at = own.find(node);
    if (at == own.end()) continue;  // of no element
    ++compared;
    for (std::size_t d = 0; d < static_cast<std::size_t>(mesh.dimension); ++d)
      worst = std::max(worst, std::abs(at->second[d] - u[d]) / largest);
  }
  std::printf("%s: %d nodes, largest difference %.1e of the largest displacement\n", GetParam().c_str(),
              compared, worst);
  EXPECT_GE(compared, 4);
  // CalculiX prints seven digits: half a unit of the last is 5e-7 at most.
  EXPECT_LT(worst, 1e-6);
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& [name, u] : reference()) all.push_back(name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Suite, CalculixModel, ::testing::ValuesIn(names()),
                         [](const auto& info) { return info.param; });

}  // namespace
}  // namespace atrapos::test
