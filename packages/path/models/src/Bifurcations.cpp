#include "Bifurcations.hpp"

#include <cmath>
#include <numeric>

#include "Galerkin.hpp"
#include "Laws.hpp"
#include "Registry.hpp"

namespace atrapos::models {

namespace {
using Values = Parameters;
using path::Problem;

Modes modes(const Values& v, std::vector<double> crossing) {
  Modes law;
  law.crossing = std::move(crossing);
  law.imperfection = v.at("imperfection");
  if (v.count("bend")) law.bend = v.at("bend");
  if (v.count("cubic")) law.cubic = v.at("cubic");
  return law;
}

void watchModes(Setup& s, const Problem& p) {
  const int n = static_cast<int>(p.map()->getGlobalNumElements());
  for (int i = 1; i < n; ++i) s.monitors.push_back(unknown(p, "mode_" + std::to_string(i), i));
  s.stops.loadFactors = {2, -1};
}

/// The trivial path is the one without modes.
void trivial(Setup& s, const Values& v, const Problem& p) {
  if (v.at("imperfection") != 0) return;
  std::vector<int> all(p.map()->getGlobalNumElements() - 1);
  std::iota(all.begin(), all.end(), 1);
  s.offBranch = zeroUnknowns(all);
}

SquareModes square(const Values& v) {
  SquareModes law;
  law.a = v.at("own");
  law.b = v.at("other");
  law.imperfection = v.at("imperfection");
  if (law.a == 0 || law.a + law.b == 0)
    throw std::invalid_argument("model problem 'square_plate': own and own + other must not be zero");
  return law;
}
}  // namespace

std::vector<Entry> bifurcations() {
  return {
      {"pitchfork",
       "a mode appears symmetrically at lambda = 0.5 + bend/4 on a curved trivial path",
       {{"bend", 0.3}, {"imperfection", 0}},
       [](const Values& v) { return problem(modes(v, {0.5})); },
       [](const Values& v, const Problem& p, Setup& s) {
         watchModes(s, p);
         trivial(s, v, p);
       }},
      {"pitchfork_side_branch",
       "the same, started on the branch that leaves it and followed through the pitchfork",
       {{"bend", 0.3}},
       [](const Values& v) {
         Modes law;
         law.bend = v.at("bend");
         return problem(law);
       },
       [](const Values& v, const Problem& p, Setup& s) {
         const double x = 0.5, y = 0.5 + x * x;
         s.start = {vector(p, {y, x}), y + v.at("bend") * y * y - 0.5 * x * x};
         s.direction = -1;
         s.monitors = {unknown(p, "mode_1", 1)};
         stopAt(s, s.monitors[0], -0.6);
         s.offBranch = [](const path::State& state) {
           const auto u = state.u->getData();
           return std::abs(u[0] - 0.5 - u[1] * u[1]);
         };
       }},
      {"transcritical",
       "two branches cross at lambda = 0.5 + bend/4",
       {{"bend", 0.3}, {"cubic", 1}, {"imperfection", 0}},
       [](const Values& v) { return problem(modes(v, {0.5})); },
       [](const Values& v, const Problem& p, Setup& s) {
         watchModes(s, p);
         trivial(s, v, p);
       }},
      {"two_modes",
       "two pitchforks on one path, a distance apart",
       {{"bend", 0.3}, {"distance", 0.4}, {"imperfection", 0}},
       [](const Values& v) {
         return problem(modes(v, {0.5, 0.5 + v.at("distance")}));
       },
       [](const Values& v, const Problem& p, Setup& s) {
         watchModes(s, p);
         trivial(s, v, p);
       }},
      {"three_modes",
       "three pitchforks at one point, lambda = 0.5 + 0.25 bend",
       {{"bend", 0.3}, {"imperfection", 0}},
       [](const Values& v) {
         return problem(modes(v, {0.5, 0.5, 0.5}));
       },
       [](const Values& v, const Problem& p, Setup& s) {
         watchModes(s, p);
         trivial(s, v, p);
       }},
      {"branch_trap",
       "an imperfect pitchfork whose branches pass each other at about the size of the imperfection",
       {{"bend", 0.3}, {"imperfection", 1e-3}},
       [](const Values& v) { return problem(modes(v, {0.5})); },
       [](const Values& v, const Problem& p, Setup& s) {
         // Next to the trivial path, mode eps / crossing; a Newton start takes the rest.
         s.start.lambda = -2 * v.at("imperfection") * v.at("imperfection");
         watchModes(s, p);
         s.offBranch = [](const path::State& state) { return std::max(0.0, -state.u->getData()[1]); };
       }},
      {"square_plate",
       "two modes of a square appear together at lambda = 0.575: four branches, D4 symmetry",
       {{"own", 1}, {"other", 0.5}, {"imperfection", 0}},
       [](const Values& v) { return problem(square(v)); },
       [](const Values& v, const Problem& p, Setup& s) {
         s.monitors = {unknown(p, "mode_x", 1), unknown(p, "mode_y", 2)};
         s.stops.loadFactors = {2, -1};
         trivial(s, v, p);
       }},
      {"perturbed_pitchfork",
       "u^3 - lambda u = eps: the branch with a fold at 3 (eps/2)^(2/3), u < 0",
       {{"eps", 0.1}},
       [](const Values& v) { return problem(Pitchfork{positive(v, "eps")}); },
       [](const Values& v, const Problem& p, Setup& s) {
         s.start = {vector(p, {-1}), 1 + v.at("eps")};
         s.direction = -1;
         s.monitors = {unknown(p, "u", 0)};
         s.stops.loadFactors = {2};
       }},
  };
}

}  // namespace atrapos::models
