#include <algorithm>
#include <cmath>

#include "ChebyshevBratu.hpp"
#include "Laws.hpp"
#include "Registry.hpp"

namespace atrapos::models {

namespace {
using Values = Parameters;
using path::Problem;

void middle(Setup& s, const Problem& problem, int i, double end) {
  s.monitors = {unknown(problem, "middle", i)};
  stopAt(s, s.monitors[0], end);
}
}  // namespace

std::vector<Entry> folds() {
  return {
      {"stvk_bar",
       "bar of Saint Venant-Kirchhoff material, pressed through its limit point at stretch 1/sqrt(3)",
       {},
       [](const Values&) { return problem(StvkBar{}); },
       [](const Values&, const Problem& p, Setup& s) {
         s.direction = -1;
         s.monitors = {unknown(p, "shortening", 0)};
         stopAt(s, s.monitors[0], -0.9);
       }},
      {"von_mises_truss",
       "two bars that snap through: limit points at sinking 1 -+ 1/sqrt(3)",
       {},
       [](const Values&) { return problem(Truss{}); },
       [](const Values&, const Problem& p, Setup& s) {
         s.monitors = {unknown(p, "sinking", 0)};
         stopAt(s, s.monitors[0], 2.2);
       }},
      {"truss_on_spring",
       "the truss pulled through a soft spring: load and displacement of the load's point fold (snap-back)",
       {{"stiffness", 0.3}},
       [](const Values& v) { return problem(TrussOnSpring{positive(v, "stiffness")}); },
       [](const Values&, const Problem& p, Setup& s) {
         s.monitors = {unknown(p, "sinking", 0), unknown(p, "load_point", 1)};
         stopAt(s, s.monitors[0], 2.2);
       }},
      {"bratu_1d",
       "-u'' = lambda exp(u) on the unit interval by collocation, even solutions; one fold at 3.513830719125",
       {{"points", 24}},
       [](const Values& v) { return problem(ChebyshevBratu(2 * count(v, "points", 2, 64), 1)); },
       [](const Values& v, const Problem& p, Setup& s) { middle(s, p, count(v, "points", 2, 64) - 1, 4); }},
      {"bratu_1d_differences",
       "the same by central differences, symmetric tangent",
       {{"points", 31}},
       [](const Values& v) { return problem(Bratu{count(v, "points", 1, 199)}); },
       [](const Values& v, const Problem& p, Setup& s) { middle(s, p, count(v, "points", 1, 199) / 2, 4); }},
      {"bratu_2d",
       "-Laplace u = lambda exp(u) on the unit square by collocation, even solutions; one fold at "
       "6.80812442258",
       {{"points", 8}},
       [](const Values& v) { return problem(ChebyshevBratu(2 * count(v, "points", 2, 12), 2)); },
       [](const Values& v, const Problem& p, Setup& s) {
         const int n = count(v, "points", 2, 12);
         middle(s, p, n * n - 1, 4);
       }},
      {"bars_in_series",
       "bars of Saint Venant-Kirchhoff material in a row, pressed: other branches leave where the load is "
       "largest",
       {{"bars", 2}},
       [](const Values& v) { return problem(BarsInSeries{count(v, "bars", 1, 100)}); },
       [](const Values& v, const Problem& p, Setup& s) {
         const int n = count(v, "bars", 1, 100);
         s.direction = -1;
         s.monitors = {unknown(p, "shortening", n - 1)};
         stopAt(s, s.monitors[0], -0.9);
         s.offBranch = [n](const path::State& x) {
           const auto u = x.u->getData();
           double worst = 0;
           for (int i = 0; i < n; ++i) worst = std::max(worst, std::abs(u[i] - u[n - 1] * (i + 1) / n));
           return worst;
         };
       }},
      {"contact",
       "one mass pressed on a regularised rigid stop",
       {{"alpha", 1e3}, {"eta", 0.1}, {"internal_weight", 0}},
       [](const Values& v) {
         return problem(Contact{positive(v, "alpha"), positive(v, "eta")}, v.at("internal_weight"));
       },
       [](const Values&, const Problem& p, Setup& s) {
         s.monitors = {unknown(p, "displacement", 0)};
         s.stops.loadFactors = {3};
       }},
  };
}

}  // namespace atrapos::models
