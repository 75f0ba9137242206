// events.csv: where contact points close and open.
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <sstream>

#include "atrapos/exodus/ResultReader.hpp"
#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/SmallDeck.hpp"

namespace atrapos::test {
namespace {

const std::string kLaw = "{tool: roll, set: z_min, stiffness: 1000, regularisation: 1.0e-3}";
constexpr double closedGap = 2e-6;  // 2 eta/alpha

struct Event {
  int step = 0, point = 0, node = 0;
  double pathLength = 0;
  std::string loadFactor;  ///< as written: 17 digits
  bool closes = false;
  double force = 0;
};

class ContactEvents : public testing::Test {
 protected:
  /// Runs a deck and gives its events.
  std::vector<Event> run(const std::string& deck) {
    writeFile(folder_ / "deck.yaml", deck);
    if (!std::filesystem::exists(folder_ / "box.exo")) {
      const CommandResult made = runAtrapos({"mesh", "-q", "deck.yaml"}, folder_.path());
      EXPECT_EQ(made.exitCode, 0) << made.err;
    }
    const CommandResult r = runAtrapos({"run", "-q", "deck.yaml"}, folder_.path());
    EXPECT_EQ(r.exitCode, 0) << r.err;
    std::istringstream lines(readFile(folder_ / "deck_results" / "events.csv"));
    std::string line;
    std::getline(lines, line);
    EXPECT_EQ(line, "step,branch,path_length,load_factor,contact,event,point,node,x,y,z,force");
    std::vector<Event> events;
    while (std::getline(lines, line)) {
      std::istringstream cells(line);
      std::vector<std::string> cell;
      for (std::string c; std::getline(cells, c, ',');) cell.push_back(c);
      EXPECT_EQ(cell.size(), 12u) << line;
      EXPECT_EQ(cell[4], "lower");
      EXPECT_TRUE(cell[5] == "closes" || cell[5] == "opens") << line;
      events.push_back({std::stoi(cell[0]), std::stoi(cell[6]), std::stoi(cell[7]), std::stod(cell[2]),
                        cell[3], cell[5] == "closes", std::stod(cell[11])});
    }
    return events;
  }

  TemporaryFolder folder_;
};

// A path that ends at the load of an event ends with that node's gap at the threshold.
TEST_F(ContactEvents, LieOnThePath) {
  const std::string deck = edited(
      kSmallDeck, kLaw, "{tool: roll, set: z_min, points: nodes, stiffness: 1000, regularisation: 1.0e-3}");
  const auto events = run(edited(deck, "{load_factor: 0.5}", "{load_factor: 1.5}"));
  ASSERT_GT(events.size(), 1u);
  int checked = 0;
  for (const Event& event : events) {
    run(edited(deck, "{load_factor: 0.5}", "{load_factor: " + event.loadFactor + "}"));
    exodus::ResultReader results((folder_ / "deck_results" / "results.exo").string());
    const auto gap = results.nodal(results.numSteps() - 1, "contact_gap");
    // The residual's bound is 1e-8 of about 5 to 15; the gap follows it by a compliance of 1/1000.
    EXPECT_NEAR(gap[event.node - 1], closedGap, 1e-9) << event.loadFactor;
    EXPECT_NEAR(event.force, std::sqrt(1000 * 1e-3 * 0.25), 0.3);  // R at the vertex, Delta near 0.25
    if (++checked == 3) break;
  }
}

// As many as the state needs: every point alternates, and what closed and did not open is closed at the end.
TEST_F(ContactEvents, AddUpToTheActivePoints) {
  const auto events = run(edited(kSmallDeck, "{load_factor: 0.5}", "{load_factor: 1.5}"));
  ASSERT_FALSE(events.empty());
  std::map<int, bool> closed;
  double last = 0;
  for (const Event& event : events) {
    EXPECT_NE(closed[event.point], event.closes) << "point " << event.point;
    closed[event.point] = event.closes;
    EXPECT_GE(event.pathLength, last);
    last = event.pathLength;
  }
  int active = 0;
  for (const auto& [point, isClosed] : closed) active += isClosed;
  exodus::ResultReader results((folder_ / "deck_results" / "results.exo").string());
  EXPECT_EQ(active, results.global(results.numSteps() - 1, "active_contacts"));
  EXPECT_NE(readFile(folder_ / "deck_results" / "summary.json")
                .find("\"contact_events\": " + std::to_string(events.size())),
            std::string::npos);
}

// Rigid motion over the edge of a plate and down on it, one step long: nodes that have no gap where the step
// starts close within it, in the step that reaches the plate.
TEST_F(ContactEvents, OfPointsThatComeOverAnEdge) {
  const std::string deck = R"(
mesh: {file: box.exo, generate: {shape: box, lengths: [1, 1, 1], divisions: [2, 1, 1], cell: HEX8}}
materials: {rubber: {law: saint_venant_kirchhoff, youngs_modulus: 1000, poissons_ratio: 0, blocks: [body]}}
supports: {top: {set: z_max, x: {per_load_factor: 0.6}, y: 0, z: {per_load_factor: -0.2}}}
tools:
  plate:
    type: patches
    surfaces: {plate: {degree: [1, 1], points: [[1.2, -1, -0.1], [1.2, 2, -0.1], [3, -1, -0.1], [3, 2, -0.1]]}}
contact: {lower: {tool: plate, set: z_min, points: nodes, law: hard}}
path: {stop: {load_factor: 0.7}}
)";
  for (const char* pade : {"off", "on"}) {
    SCOPED_TRACE(pade);
    const auto events = run(edited(deck, "path: {", std::string("path: {pade: ") + pade + ", "));
    ASSERT_EQ(events.size(), 2u);
    for (const Event& event : events) {
      EXPECT_TRUE(event.closes);
      EXPECT_EQ(event.step, 2);  // the first one ends where they come over the edge
      // 1e-10 above the plate they count as closed: 5e-10 of the load factor.
      EXPECT_NEAR(std::stod(event.loadFactor), 0.5, 1e-9);
    }
  }
}

// The same law with its curve as unknown: the same state at the end, in less steps.
TEST_F(ContactEvents, CurveAsUnknown) {
  const std::string law = "tool: roll, set: z_min, points: nodes, stiffness: 1.0e6, regularisation: 1.0e-6";
  const std::string deck = edited(kSmallDeck, "{load_factor: 0.5}", "{load_factor: 1.5}");
  double deflection[2];
  int steps[2];
  std::size_t changes[2];
  for (const int curve : {0, 1}) {
    changes[curve] = run(edited(deck, kLaw, "{" + law + (curve == 1 ? ", unknown: curve}" : "}"))).size();
    exodus::ResultReader results((folder_ / "deck_results" / "results.exo").string());
    const int last = results.numSteps() - 1;
    EXPECT_DOUBLE_EQ(results.global(last, "load_factor"), 1.5);  // a root on the series
    deflection[curve] = results.nodal(last, "displ_z").back();
    steps[curve] = last;
  }
  EXPECT_NEAR(deflection[1], deflection[0], 1e-7);  // residual bound 1e-8 of about 10, stiffness about 1
  EXPECT_EQ(changes[1], changes[0]);
  EXPECT_LT(3 * steps[1], 2 * steps[0]);
}

}  // namespace
}  // namespace atrapos::test
