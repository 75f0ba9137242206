#include <cmath>
#include <numeric>

#include "Bifurcations.hpp"
#include "Galerkin.hpp"
#include "HingedFrame.hpp"
#include "Registry.hpp"

namespace atrapos::models {

namespace {
using Values = Parameters;
using path::Problem;

SwayTruss sway(const Values& v) {
  SwayTruss law;
  law.b = positive(v, "half_width");
  law.imperfection = v.at("imperfection");
  return law;
}

Column column(const Values& v) {
  Column law;
  law.n = count(v, "links", 2, 199);
  law.EA = positive(v, "axial_stiffness");
  law.sideLoad = v.at("side_load");
  law.follow = v.at("follow");
  return law;
}

ShallowArch arch(const Values& v) {
  ShallowArch law;
  law.modes = count(v, "modes", 2, 32);
  law.rise = positive(v, "rise");
  law.imperfection = v.at("imperfection");
  return law;
}

StrutOnFoundation strut(const Values& v) {
  StrutOnFoundation law;
  law.modes = count(v, "modes", 2, 32);
  law.k = v.at("foundation");
  law.k2 = v.at("quadratic");
  law.k3 = v.at("cubic");
  law.EA = positive(v, "axial_stiffness");
  law.imperfection = v.at("imperfection");
  return law;
}

HingedFrame frame(const Values& v) {
  HingedFrame law;
  law.elements = count(v, "elements", 4, 60);
  return law;
}
/// 1 .. n.
std::vector<int> others(int n) {
  std::vector<int> list(n);
  std::iota(list.begin(), list.end(), 1);
  return list;
}
}  // namespace

std::vector<Entry> structures() {
  return {
      {"sway_truss",
       "von Mises truss whose top may sway: two limit points and, for half_width < 0.707, two bifurcations",
       {{"half_width", 0.5}, {"imperfection", 0}},
       [](const Values& v) { return problem(sway(v)); },
       [](const Values& v, const Problem& p, Setup& s) {
         s.monitors = {unknown(p, "sinking", 0), unknown(p, "sway", 1)};
         if (v.at("imperfection") == 0) s.offBranch = zeroUnknowns({1});
         stopAt(s, s.monitors[0], 2.2);
         stopAt(s, s.monitors[0], -1);
       }},
      {"euler_column",
       "column of rigid links, clamped at its foot, pressed at its top (the discretised elastica)",
       {{"links", 40}, {"axial_stiffness", 100}, {"side_load", 0}, {"follow", 0}},
       [](const Values& v) { return problem(column(v)); },
       [](const Values& v, const Problem& p, Setup& s) {
         const int n = count(v, "links", 2, 199);
         // The rotation is flat at the free end: parabola through the last two links.
         auto tip = vector(p);
         tip->replaceLocalValue(n, 9.0 / 8);
         tip->replaceLocalValue(n - 1, -1.0 / 8);
         s.monitors = {{"tip_rotation", tip}, unknown(p, "shortening", 0)};
         // A side load puts the column out of balance at lambda = 0: the path starts with a Newton solution.
         s.stops.loadFactors = {5};
         if (v.at("side_load") == 0) s.offBranch = zeroUnknowns(others(n));
       }},
      {"shallow_arch",
       "shallow pinned arch by Galerkin's method: symmetric limit points and an antisymmetric bifurcation",
       {{"modes", 4}, {"rise", 4}, {"imperfection", 0}},
       [](const Values& v) { return problem(arch(v)); },
       [](const Values& v, const Problem& p, Setup& s) {
         s.start.u = vector(p, arch(v).start());
         s.monitors = {unknown(p, "mode_1", 0), unknown(p, "mode_2", 1)};
         stopAt(s, s.monitors[0], -1.1 * v.at("rise"));
         if (v.at("imperfection") == 0) s.offBranch = zeroUnknowns(others(count(v, "modes", 2, 32) - 1));
       }},
      {"strut_on_foundation",
       "pinned strut on a foundation with equal buckling loads of its first two modes (foundation = 4)",
       {{"modes", 4},
        {"foundation", 4},
        {"quadratic", 0},
        {"cubic", 1},
        {"axial_stiffness", 50},
        {"imperfection", 0}},
       [](const Values& v) { return problem(strut(v)); },
       [](const Values& v, const Problem& p, Setup& s) {
         const int n = count(v, "modes", 2, 32);
         for (int i = 1; i <= n; ++i) s.monitors.push_back(unknown(p, "mode_" + std::to_string(i), i));
         s.stops.loadFactors = {8, -1};
         if (v.at("imperfection") == 0) s.offBranch = zeroUnknowns(others(n));
       }},
      {"lee_frame",
       "Lee's frame: geometrically exact beams, load and both displacements of its point fold",
       {{"elements", 12}},
       [](const Values& v) { return problem(frame(v)); },
       [](const Values&, const Problem& p, Setup& s) {
         s.monitors = {unknown(p, "u", 0), unknown(p, "v", 1)};
         s.stops.loadFactors = {2.5};
       }},
  };
}

}  // namespace atrapos::models
