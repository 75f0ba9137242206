// examples/path/*.yaml that follow branches, with residuals, tangents and right-hand sides of orders off by
// 1e-13 relative, as no machine rounds: the same points, the same branches, nothing unexplained.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <tuple>

#include "commands/MeshCommand.hpp"
#include "commands/ModelCase.hpp"
#include "commands/RunSettings.hpp"
#include "commands/SceneCase.hpp"
#include "scene/DeckMesh.hpp"
#include "support/RoundedProblem.hpp"

namespace atrapos::test {
namespace {

constexpr double kRounding = 1e-13;

/// What must not depend on rounding.
struct Diagram {
  /// Load factor, kind, number of null vectors.
  std::vector<std::tuple<double, std::string, int>> points;
  /// How many branches end in which way.
  std::map<std::pair<path::BranchEnd, path::EndReason>, int> ends;
  int unexplained = 0;
};

class Count final : public path::BranchObserver {
 public:
  int unexplained = 0;
  bool onStep(int, const path::StepReport& report, const path::Series&) override {
    unexplained += report.unexplained;
    return true;
  }
};

std::unique_ptr<Scene> sceneOf(const deck::Deck& deck) {
  return deck.problem ? nullptr : std::make_unique<Scene>(deck, DeckMesh(generateMesh(deck)));
}

/// Seed 0: as it is.
Diagram follow(const deck::Deck& deck, unsigned seed) {
  const auto scene = sceneOf(deck);
  std::unique_ptr<PathCase> exact;
  if (scene)
    exact = std::make_unique<SceneCase>(*scene);
  else
    exact = std::make_unique<ModelCase>(deck);
  RoundedProblem rounded(exact->problem(), seed, seed == 0 ? 0 : kRounding);
  const auto solver = tangentSolver(*exact);
  path::BranchFollower follower(rounded, *solver, pathOptions(*exact), exact->stops(),
                                branchOptions(deck.path));
  Count count;
  const path::BranchDiagram found = follower.run(exact->start(), count);
  Diagram diagram;
  diagram.unexplained = count.unexplained;
  for (const auto& p : found.points)
    diagram.points.emplace_back(p.point.state.lambda, path::toString(p.point.kind), p.point.nullity);
  for (const auto& b : found.branches) ++diagram.ends[{b.end, b.outcome.reason}];
  std::sort(diagram.points.begin(), diagram.points.end());
  return diagram;
}

void expectSame(const Diagram& found, const Diagram& known) {
  EXPECT_EQ(found.unexplained, 0);
  EXPECT_EQ(found.ends, known.ends);
  ASSERT_EQ(found.points.size(), known.points.size());
  for (std::size_t i = 0; i < known.points.size(); ++i) {
    const auto& [load, kind, nullity] = known.points[i];
    // A column's buckling load is 1e-6 of its stiffness along: rounding of 1e-13 is 1e-7 of that load.
    EXPECT_NEAR(std::get<0>(found.points[i]), load, 1e-6 * std::max(1.0, std::abs(load)));
    EXPECT_EQ(std::get<1>(found.points[i]), kind) << load;
    EXPECT_EQ(std::get<2>(found.points[i]), nullity) << load;
  }
}

std::vector<deck::Deck> decks(bool models) {
  std::vector<deck::Deck> all;
  for (const auto& entry : std::filesystem::directory_iterator(ATRAPOS_EXAMPLES "/path")) {
    if (entry.path().extension() != ".yaml") continue;
    deck::Deck deck = deck::readDeck(entry.path());
    if (deck.path.branches != path::Follow::none && deck.problem.has_value() == models)
      all.push_back(std::move(deck));
  }
  return all;
}

void expectSameWithAll(const std::vector<deck::Deck>& decks, unsigned seeds) {
  for (const auto& deck : decks) {
    SCOPED_TRACE(deck.file);
    const Diagram known = follow(deck, 0);
    EXPECT_EQ(known.unexplained, 0);
    for (unsigned seed = 1; seed <= seeds; ++seed) {
      SCOPED_TRACE(seed);
      expectSame(follow(deck, seed), known);
    }
  }
}

TEST(Rounding, ModelProblems) {
  const auto all = decks(true);
  EXPECT_GE(all.size(), 12u);
  expectSameWithAll(all, 20);
}

/// ATRAPOS_ROUNDING_SEEDS: how many; a seed takes half a minute.
TEST(Rounding, Bodies) {
  const auto all = decks(false);
  EXPECT_GE(all.size(), 5u);
  const char* seeds = std::getenv("ATRAPOS_ROUNDING_SEEDS");
  expectSameWithAll(all, seeds ? static_cast<unsigned>(std::stoul(seeds)) : 1);
}

}  // namespace
}  // namespace atrapos::test
