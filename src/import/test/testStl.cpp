// STL files: what is read, and smooth surfaces of heights through their corners, against the surfaces that
// the facets were cut from.
#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <string>

#include "atrapos/contact/PatchSet.hpp"
#include "atrapos/contact/RigidTool.hpp"
#include "import/FitHeights.hpp"
#include "import/Import.hpp"
#include "import/ReadStl.hpp"

namespace atrapos::importer {
namespace {

using Vector = std::array<double, 3>;
using Height = std::function<double(double, double)>;

/// 2 n^2 facets between places on the heights over a rectangle, which face up.
std::vector<Facet> net(const Height& height, Vector low, Vector high, int n) {
  const auto at = [&](int i, int j) {
    const double x = low[0] + (high[0] - low[0]) * i / n, y = low[1] + (high[1] - low[1]) * j / n;
    return Vector{x, y, height(x, y)};
  };
  std::vector<Facet> facets;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      facets.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      facets.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return facets;
}

std::unique_ptr<contact::RigidTool> tool(const FittedSurface& fitted) {
  contact::NurbsSurface surface;
  surface.degree = {3, 3};
  surface.knots = fitted.knots;
  for (int d = 0; d < 2; ++d) surface.count[d] = static_cast<int>(fitted.knots[d].size()) - 4;
  surface.points = fitted.points;
  return contact::rigidTool(
      std::make_shared<contact::PatchSet>(surface.patches(), false, std::numeric_limits<double>::infinity()),
      std::nullopt);
}

/// The largest gap that the tool sees at places of the surface itself, off its corners; the border is left
/// out.
double worstGap(const FittedSurface& fitted, const Height& height, Vector low, Vector high) {
  const auto rigid = tool(fitted);
  double worst = 0;
  constexpr int kPlaces = 23;
  for (int i = 1; i < kPlaces; ++i)
    for (int j = 1; j < kPlaces; ++j) {
      const double x = low[0] + (high[0] - low[0]) * i / kPlaces,
                   y = low[1] + (high[1] - low[1]) * j / kPlaces;
      const double place[4] = {x, y, height(x, y), 0};
      worst = std::max(worst, std::abs(rigid->project(place).gap));
    }
  return worst;
}

const Vector kLow{-4, -3, 0}, kHigh{4, 3, 0};
double ball(double x, double y) { return std::sqrt(100 - x * x - y * y); }
/// The top of a torus of radius 10 and tube radius 8 about an axis along z that is 10 away.
double torus(double x, double y) {
  const double out = std::hypot(x + 10, y) - 10;
  return std::sqrt(64 - out * out);
}

// Corners lie on the surface: a cubic through them converges with the fourth power of their distance, facets
// with the second.
TEST(Stl, SurfacesConvergeWithTheFourthPower) {
  for (const auto& [height, name] : {std::pair<Height, const char*>{ball, "ball"}, {torus, "torus"}}) {
    double before = 0, facetsBefore = 0;
    for (const int n : {16, 32, 64}) {
      const FittedSurface fitted = fitHeights(net(height, kLow, kHigh, n), {}, "tool.stl");
      const double gap = worstGap(fitted, height, kLow, kHigh);
      if (before > 0) {
        EXPECT_GT(std::log2(before / gap), 3.5) << name << " " << n;
        EXPECT_NEAR(std::log2(facetsBefore / fitted.fromFacets), 2, 0.3) << name << " " << n;
      }
      EXPECT_LE(fitted.fromCorners, 3 * gap) << name << " " << n;
      before = gap;
      facetsBefore = fitted.fromFacets;
    }
    EXPECT_LT(before, 1e-5) << name;
  }
}

TEST(Stl, HeightsAlongAnyAxis) {
  const auto up = net(ball, kLow, kHigh, 16);
  for (const auto& [along, turn] :
       {std::pair<Vector, std::array<int, 3>>{{1, 0, 0}, {2, 0, 1}}, {{0, 1, 0}, {1, 2, 0}}}) {
    std::vector<Facet> turned;
    for (const Facet& f : up) {
      Facet& g = turned.emplace_back();
      for (int c = 0; c < 3; ++c)
        for (int i = 0; i < 3; ++i) g[c][i] = f[c][turn[i]];
    }
    FitWishes wishes;
    wishes.along = along;
    const FittedSurface fitted = fitHeights(turned, wishes, "tool.stl");
    EXPECT_EQ(fitted.turnedAway, 0U);
    Vector above{};
    for (int i = 0; i < 3; ++i) above[i] = 11 * along[i];
    const double place[4] = {above[0], above[1], above[2], 0};
    EXPECT_NEAR(tool(fitted)->project(place).gap, 1, 1e-3);  // on the free side
  }
  // From below the same facets face the other way.
  std::vector<Facet> down = up;
  for (Facet& f : down) std::swap(f[1], f[2]);
  FitWishes below;
  below.along = {0, 0, -1};
  const double place[4] = {0, 0, 9, 0};
  EXPECT_NEAR(tool(fitHeights(down, below, "tool.stl"))->project(place).gap, 1, 1e-3);
}

void expectRefused(const std::vector<Facet>& facets, const FitWishes& wishes, const std::string& part) {
  try {
    fitHeights(facets, wishes, "tool.stl");
    FAIL() << "taken; expected: " << part;
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos);
  }
}

TEST(Stl, Overhangs) {
  auto twice = net(ball, kLow, kHigh, 8);
  const auto above = net([](double x, double y) { return ball(x, y) + 1; }, {0, 0, 0}, {3, 2, 0}, 5);
  twice.insert(twice.end(), above.begin(), above.end());
  expectRefused(twice, {}, "tool.stl: overhangs: facets at the heights ");
}

TEST(Stl, WhatFacesAwayIsLeftOut) {
  auto closed = net(ball, kLow, kHigh, 8);
  const auto floor = net([](double, double) { return 0.0; }, {-4, 3, 0}, {4, -3, 0}, 4);  // turned over
  closed.insert(closed.end(), floor.begin(), floor.end());
  const FittedSurface fitted = fitHeights(closed, {}, "tool.stl");
  EXPECT_EQ(fitted.turnedAway, floor.size());
  EXPECT_EQ(fitted.facets, closed.size() - floor.size());
  FitWishes wishes;
  wishes.along = {1, 0, 0};
  expectRefused(floor, wishes, "0 of 32 facets face the axis");
  wishes = {};
  wishes.cells = {101, 1};
  expectRefused(closed, wishes, "--cells 101: expected 1 to 100");
}

// What would take hours, or has no surface in double precision, is refused.
TEST(Stl, OutOfProportion) {
  auto unequal = net([](double, double) { return 0.0; }, {0, 0, 0}, {1e-3, 1e-3, 0}, 224);
  const auto large = net([](double, double) { return 0.0; }, {1, 1, 0}, {2, 2, 0}, 1);
  unequal.insert(unequal.end(), large.begin(), large.end());
  expectRefused(unequal, {}, "facets of too unequal sizes");
  auto huge = net(ball, kLow, kHigh, 8);
  for (Facet& f : huge)
    for (auto& x : f)
      for (double& number : x) number *= 1e160;
  expectRefused(huge, {}, "its corners do not determine a surface");
}

// A round tool: over the corners of its rectangle nothing is known, and the surface goes on smoothly.
TEST(Stl, CornersWithoutFacets) {
  std::vector<Facet> round;
  for (const Facet& f :
       net([](double x, double y) { return 0.1 * x + 0.01 * y * y; }, {-4, -4, 0}, {4, 4, 0}, 24))
    if (std::hypot(f[0][0], f[0][1]) < 3.5) round.push_back(f);
  const FittedSurface fitted = fitHeights(round, {}, "tool.stl");
  EXPECT_DOUBLE_EQ(fitted.empty, 4.0 / 81);  // a cell at each corner
  EXPECT_LT(fitted.fromCorners, 1e-6);
  for (const auto& p : fitted.points) EXPECT_LT(std::abs(p[2]), 1.5);
}

class StlFile : public ::testing::Test {
 protected:
  std::string write(const std::string& bytes) const {
    std::ofstream(file_, std::ios::binary) << bytes;
    return file_;
  }
  void TearDown() override { std::filesystem::remove(file_); }
  void expectRefused(const std::string& bytes, const std::string& part) {
    try {
      readStl(write(bytes));
      FAIL() << "read; expected: " << part;
    } catch (const Error& e) {
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << e.what();
    }
  }
  std::string file_ =
      std::filesystem::temp_directory_path() / ("atrapos_stl_" + std::to_string(::getpid()) + ".stl");
};

std::string ascii(const std::vector<Facet>& facets) {
  std::string text = "solid tool\n";
  for (const Facet& f : facets) {
    text += "facet normal 0 0 1\n outer loop\n";
    for (const auto& x : f)
      text +=
          "  vertex " + std::to_string(x[0]) + " " + std::to_string(x[1]) + " " + std::to_string(x[2]) + "\n";
    text += " endloop\nendfacet\n";
  }
  return text + "endsolid tool\n";
}

std::string binary(const std::vector<Facet>& facets) {
  std::string bytes = "solid, says the text of some binary files";
  bytes.resize(84);
  const auto count = static_cast<std::uint32_t>(facets.size());
  std::memcpy(&bytes[80], &count, 4);
  for (const Facet& f : facets) {
    float numbers[12] = {};
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < 3; ++i) numbers[3 + 3 * c + i] = static_cast<float>(f[c][i]);
    bytes.append(reinterpret_cast<const char*>(numbers), sizeof numbers);
    bytes.append(2, '\0');
  }
  return bytes;
}

TEST_F(StlFile, BothKinds) {
  const auto facets =
      net([](double x, double y) { return x * y; }, {0, 0, 0}, {1, 2, 0}, 2);  // exact in a float
  EXPECT_EQ(readStl(write(ascii(facets))), facets);
  EXPECT_EQ(readStl(write(binary(facets))), facets);
}

TEST_F(StlFile, Damaged) {
  const auto facets = net(ball, kLow, kHigh, 2);
  const std::string text = ascii(facets);
  expectRefused("", "has no facet");
  expectRefused("no solid\n", "is no STL file");
  expectRefused(binary(facets).substr(0, 200), "is no STL file");
  expectRefused(text.substr(0, text.find("vertex", text.find("vertex") + 1)), "ends within a facet");
  expectRefused("solid\nfacet\nvertex 1 2\n", ":3: a corner without three numbers");
  expectRefused("solid\nfacet\nvertex 1 2 3\nendfacet\n", ":4: a facet with 1 corners");
  expectRefused("solid\nendsolid\n", "has no facet");
  file_ += ".not_there";
  EXPECT_THROW(readStl(file_), Error);
}

}  // namespace
}  // namespace atrapos::importer
