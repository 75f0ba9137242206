#include <cmath>
#include <cstdio>
#include <cstdlib>

#include <gtest/gtest.h>

#include "problems/FollowedModel.hpp"

using namespace atrapos;
using path::Options;
using path::PadeUse;

namespace {

/// One cell of the map: orders and accuracies far from the defaults, the rational form on and off.
struct Cell {
  bool ended = false, jumped = false, lied = false;
  int unexplained = 0, points = 0, searchFactorizations = 0, steps = 0;
  std::string text;
};

Cell run(const std::string& name, const models::Parameters& parameters, int order, double delta,
         PadeUse pade) {
  Options options;
  options.order = order;
  options.delta = options.residualBound = delta;
  options.pade = pade;
  options.maxSteps = 4000;
  FollowedModel f(name, parameters, options);
  Cell cell;
  cell.steps = f.outcome.steps;
  cell.ended = f.outcome.reason == path::EndReason::stopReached;
  cell.text = f.outcome.text;
  cell.lied = !(f.outcome.worstResidual <= delta);
  cell.searchFactorizations = f.outcome.criticalFactorizations;
  for (const auto& s : f.record.steps) {
    cell.unexplained += s.unexplained;
    for (const auto& p : s.criticalPoints) cell.points += p.nullity;
    // The amplitudes of other branches are of order 1.
    constexpr double other = 0.1;
    if (f.setup.offBranch && f.setup.offBranch(s.end) > other) cell.jumped = true;
  }
  return cell;
}

struct Case {
  std::string name;
  models::Parameters parameters;
  int points;  ///< eigenvalues that vanish at bifurcation points on the path
};

const std::vector<Case> cases{{"stvk_bar", {}, 0},
                              {"von_mises_truss", {}, 0},
                              {"truss_on_spring", {}, 0},
                              {"bratu_1d_differences", {{"points", 7}}, 0},
                              {"bars_in_series", {{"bars", 2}}, 1},  // on its limit point
                              {"bars_in_series", {{"bars", 5}}, 5},  // all five eigenvalues together
                              {"contact", {{"alpha", 1e6}, {"eta", 1e-5}}, 0},
                              {"perturbed_pitchfork", {{"eps", 1e-3}}, 0},
                              {"pitchfork", {}, 1},
                              {"pitchfork_side_branch", {}, 1},
                              {"transcritical", {}, 1},
                              {"two_modes", {}, 2},
                              {"two_modes", {{"distance", 1e-3}}, 2},
                              {"branch_trap", {}, 0},
                              {"square_plate", {}, 2},
                              {"sway_truss", {{"half_width", 0.5}}, 2},
                              {"sway_truss", {{"half_width", 0.65}}, 2},
                              {"sway_truss", {{"half_width", 0.705}}, 2},
                              {"euler_column", {{"links", 8}}, 1},
                              {"shallow_arch", {{"modes", 3}}, 2},
                              {"strut_on_foundation", {}, 2}};

TEST(FailureMap, NoRunJumpsLoopsOrLies) {
  const bool print = std::getenv("ATRAPOS_PRINT_MAP") != nullptr;  // one line a run
  int runs = 0, ended = 0, missed = 0, unexplained = 0;
  for (const auto& c : cases)
    for (const int order : {5, 10, 15, 20, 30, 40})
      for (const double delta : {1e-2, 1e-4, 1e-6, 1e-8, 1e-10})
        for (const auto pade : {PadeUse::off, PadeUse::automatic}) {
          const Cell cell = run(c.name, c.parameters, order, delta, pade);
          ++runs;
          ended += cell.ended;
          const bool miss = c.points >= 0 && cell.points != c.points;
          missed += miss;
          EXPECT_TRUE(!miss || cell.unexplained > 0) << c.name << ' ' << order << ' ' << delta;
          unexplained += cell.unexplained > 0;
          if (print)
            std::printf(
                "%-22s %-5g %3d %7.0e %d %s%s%s%s steps %4d points %d/%d unexplained %d search %d %s\n",
                c.name.c_str(), c.parameters.empty() ? 0 : c.parameters.begin()->second, order, delta,
                pade != PadeUse::off, cell.ended ? "." : "STALL ", cell.jumped ? "JUMP " : ".",
                cell.lied ? "LIE " : ".", miss ? "MISS " : ".", cell.steps, cell.points, c.points,
                cell.unexplained, cell.searchFactorizations, cell.ended ? "" : cell.text.c_str());
          EXPECT_FALSE(cell.jumped) << c.name << ' ' << order << ' ' << delta << ' '
                                    << (pade != PadeUse::off);
          EXPECT_FALSE(cell.lied) << c.name << ' ' << order << ' ' << delta;
          // Two a point, found or known to be there, and two where a suspicion is unfounded.
          EXPECT_LE(cell.searchFactorizations, 2 * (cell.points + cell.unexplained + 1));
        }
  std::printf(
      "%d runs, %d ended at their stop, %d missed or invented points, %d with unexplained eigenvalues\n",
      runs, ended, missed, unexplained);
}

}  // namespace
