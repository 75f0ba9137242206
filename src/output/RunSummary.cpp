#include "output/RunSummary.hpp"

#include <fmt/format.h>

#include <Kokkos_Core.hpp>
#include <algorithm>
#include <nlohmann/json.hpp>

#include "Version.hpp"
#include "atrapos/fem/Processor.hpp"
#include "atrapos/linear/Choice.hpp"
#include "atrapos/linear/Iterations.hpp"
#include "deck/DeckTables.hpp"
#include "machine/Memory.hpp"
#include "machine/Ranks.hpp"
#include "plugin/Plugins.hpp"

namespace atrapos {
namespace {

template <class T, class Owner>
T sumOver(const path::BranchDiagram& diagram, T Owner::*member) {
  T total{};
  for (const path::Branch& b : diagram.branches) total += b.outcome.*member;
  return total;
}

double seconds(const path::BranchDiagram& diagram, double path::Timings::*member) {
  double total = 0;
  for (const path::Branch& b : diagram.branches) total += b.outcome.seconds.*member;
  return total;
}

nlohmann::ordered_json pointsOf(const PathCase& pathCase, const path::BranchDiagram& diagram) {
  auto list = nlohmann::ordered_json::array();
  const auto names = pathCase.monitorNames();
  for (std::size_t i = 0; i < diagram.points.size(); ++i) {
    const path::BranchPoint& found = diagram.points[i];
    const path::CriticalPoint& p = found.point;
    nlohmann::ordered_json json{{"point", i},
                                {"branch", found.branch},
                                {"step", found.step},
                                {"kind", path::toString(p.kind)},
                                {"load_factor", p.state.lambda},
                                {"nullity", p.nullity},
                                {"negative_change", p.negativeChange},
                                {"residual", p.residual},
                                {"uncertainty", p.uncertainty}};
    const auto values = pathCase.at(p.state)->monitors();
    for (std::size_t m = 0; m < names.size(); ++m) json["monitors"][names[m]] = values[m];
    list.push_back(json);
  }
  return list;
}

nlohmann::ordered_json limitPointsOf(const PathCase& pathCase, const Recorder& recorder) {
  auto list = nlohmann::ordered_json::array();
  const auto names = pathCase.monitorNames();
  for (const PointRow& p : recorder.limitPoints()) {
    nlohmann::ordered_json json{{"branch", p.branch},
                                {"step", p.step},
                                {"kind", p.kind},
                                {"load_factor", p.loadFactor},
                                {"path_length", p.pathLength}};
    for (std::size_t m = 0; m < names.size(); ++m) json["monitors"][names[m]] = p.monitors[m];
    list.push_back(json);
  }
  return list;
}

nlohmann::ordered_json hopfPointsOf(const PathCase& pathCase, const Recorder& recorder) {
  auto list = nlohmann::ordered_json::array();
  const auto names = pathCase.monitorNames();
  for (const PointRow& p : recorder.hopfPoints()) {
    nlohmann::ordered_json json{{"branch", p.branch},          {"step", p.step},
                                {"load_factor", p.loadFactor}, {"path_length", p.pathLength},
                                {"frequency", p.frequency},    {"negative_change", p.negativeChange},
                                {"uncertainty", p.uncertainty}};
    for (std::size_t m = 0; m < names.size(); ++m) json["monitors"][names[m]] = p.monitors[m];
    list.push_back(json);
  }
  return list;
}

/// How a branch ended, as files and tables name it.
std::string endedOf(const path::Branch& b) {
  if (b.outcome.reason != path::EndReason::observerStopped) return path::toString(b.outcome.reason);
  return b.end == path::BranchEnd::path ? "interrupted" : path::toString(b.end);
}

std::string whyOf(const path::Branch& b) {
  return endedOf(b) == "interrupted" ? "interrupted by a signal" : b.outcome.text;
}

nlohmann::ordered_json branchesOf(const path::BranchDiagram& diagram) {
  auto list = nlohmann::ordered_json::array();
  for (std::size_t i = 0; i < diagram.branches.size(); ++i) {
    const path::Branch& b = diagram.branches[i];
    nlohmann::ordered_json json{{"branch", i}};
    if (b.parent >= 0) {
      json["parent"] = b.parent;
      json["point"] = b.point;
      json["load_direction"] = b.direction.lambda;
    }
    json["depth"] = b.depth;
    if (b.imperfection != 0) json["imperfection"] = b.imperfection;
    if (!b.stage.empty()) json["stage"] = b.stage;
    json["end"] = path::toString(b.end);
    json["ended"] = endedOf(b);
    json["why"] = whyOf(b);
    json["steps"] = b.outcome.steps;
    json["factorizations"] = b.outcome.factorizations;
    if (b.outcome.final.u) json["load_factor"] = b.outcome.final.lambda;
    json["path_length"] = b.outcome.pathLength;
    list.push_back(json);
  }
  return list;
}

/// What the load factor changes: loads, or else the places of supports and tools, whose forces are answers.
const char* drivenBy(const deck::Deck& deck) {
  const bool loads = deck.problem || std::any_of(deck.loads.begin(), deck.loads.end(),
                                                 [](const deck::Load& load) { return !load.constant; });
  return loads ? "load" : "displacement";
}

/// Name -> type, of those that the deck defines.
nlohmann::ordered_json monitorTypes(const deck::Deck& deck) {
  auto types = nlohmann::ordered_json::object();
  struct TypeOf {
    const char* operator()(const deck::DisplacementMonitor&) const { return "displacement"; }
    const char* operator()(const deck::FieldMonitor&) const { return "field"; }
    const char* operator()(const deck::RotationMonitor&) const { return "rotation"; }
    const char* operator()(const deck::MomentMonitor&) const { return "moment"; }
    const char* operator()(const deck::ReactionMonitor&) const { return "reaction"; }
    const char* operator()(const deck::ContactForceMonitor&) const { return "contact_force"; }
    const char* operator()(const deck::ContactAreaMonitor&) const { return "contact_area"; }
    const char* operator()(const deck::ContactPressureMonitor&) const { return "contact_pressure"; }
    const char* operator()(const deck::ContactCenterMonitor&) const { return "contact_center"; }
    const char* operator()(const deck::ContactSpreadMonitor&) const { return "contact_spread"; }
  };
  for (const deck::Monitor& m : deck.output.monitors) types[m.name] = std::visit(TypeOf{}, m.quantity);
  return types;
}

}  // namespace

nlohmann::ordered_json runSummary(const deck::Deck& deck, const PathCase& pathCase,
                                  const path::BranchDiagram& diagram, const linear::TangentSolver& solver,
                                  const Recorder& recorder) {
  using path::Outcome;
  const bool inStages = !deck.path.stages.empty();
  const path::Branch& main = inStages ? diagram.branches.back() : diagram.branches[0];
  const Outcome& outcome = main.outcome;
  nlohmann::ordered_json json;
  json["program"] = "atrapos " + std::string(kVersion);
  json["deck"] = deck.file;
  json["title"] = deck.title;
  json["driven_by"] = drivenBy(deck);
  json["monitors"] = monitorTypes(deck);
  for (const auto& plugin : plugins::loaded())
    if (std::find(deck.plugins.begin(), deck.plugins.end(), plugin.name) != deck.plugins.end())
      json["plugins"].push_back({{"name", plugin.name}, {"file", plugin.file}});
  if (inStages) json["stage"] = main.stage;
  json["ended"] = endedOf(main);
  json["why"] = whyOf(main);
  json["reached_stop"] = outcome.reason == path::EndReason::stopReached &&
                         (!inStages || diagram.branches.size() == deck.path.stages.size());
  json["load_factor"] = outcome.final.lambda;
  json["path_length"] = outcome.pathLength;
  json["path_weight"] = outcome.weight;
  json["steps"] = sumOver(diagram, &Outcome::steps);
  json["method"] = deck::wordOf(deck.path.method, deck::methods());
  if (deck.path.autoOrder)
    json["order"] = "auto";
  else if (deck.path.series())
    json["order"] = deck.path.order;
  json["orders_computed"] = sumOver(diagram, &Outcome::orders);
  json["factorizations"] = sumOver(diagram, &Outcome::factorizations) + diagram.switchFactorizations;
  json["solves"] = sumOver(diagram, &Outcome::solves);
  json["corrections"] = sumOver(diagram, &Outcome::corrections);
  json["start_iterations"] = sumOver(diagram, &Outcome::startIterations);
  json["restarts"] = sumOver(diagram, &Outcome::restarts);
  json["retreats"] = sumOver(diagram, &Outcome::retreats);
  json["critical_factorizations"] = sumOver(diagram, &Outcome::criticalFactorizations);
  json["switch_factorizations"] = diagram.switchFactorizations;
  json["closings"] = sumOver(diagram, &Outcome::closings);
  json["cut_backs"] = sumOver(diagram, &Outcome::cutBacks);
  json["residual_bound"] = deck.path.residual;
  json["worst_residual"] = recorder.worstResidual();
  double worst = 0, worstJump = 0;
  for (const path::Branch& b : diagram.branches) {
    worst = std::max(worst, b.outcome.worstResidual);
    worstJump = std::max(worstJump, b.outcome.worstJump);
  }
  json["worst_residual_at_step_ends"] = worst;
  json["jumps"] = sumOver(diagram, &Outcome::jumps);
  json["worst_jump"] = worstJump;
  json["limit_points"] = recorder.limitPoints().size();
  json["bifurcation_points"] = diagram.points.size();
  json["unexplained_sign_changes"] = diagram.unexplained;
  json["uncounted_steps"] = diagram.uncounted;
  json["load_limits"] = limitPointsOf(pathCase, recorder);
  if (deck.path.hopf) {
    json["hopf_points"] = hopfPointsOf(pathCase, recorder);
    json["hopf_factorizations"] = sumOver(diagram, &Outcome::hopfFactorizations);
  }
  json["points"] = pointsOf(pathCase, diagram);
  json["branches"] = branchesOf(diagram);
  json["branches_complete"] = diagram.complete && diagram.unexplained == 0 && diagram.uncounted == 0;
  for (const auto& [name, size] : pathCase.sizes()) json[name] = size;
  if (deck.path.series()) json["contact_events"] = recorder.contactEvents();
  pathCase.summarize(json);
  json["solver"] = solver.name();
  if (const std::string why = linear::choice(solver); !why.empty()) json["solver_choice"] = why;
  if (const auto iterations = linear::iterations(solver))
    json["iterations"] = {{"total", iterations->total}, {"most", iterations->most}};
  nlohmann::ordered_json memory;
  if (const auto factor = linear::spent(solver)) memory["factor"] = factor->bytes;
  memory["peak"] = residentOfAll().peak;  // collective
  json["memory_bytes"] = memory;
  json["ranks"] = ranks::count();
  json["kernels"] = fem::describeKernels();
  json["execution_space"] = Kokkos::DefaultExecutionSpace::name();
  json["threads"] = Kokkos::DefaultExecutionSpace::concurrency();
  json["seconds"] = {{"tangent", seconds(diagram, &path::Timings::tangent)},
                     {"analysis", seconds(diagram, &path::Timings::analysis)},
                     {"factorization", seconds(diagram, &path::Timings::factor)},
                     {"solves", seconds(diagram, &path::Timings::solve)},
                     {"order_rhs", seconds(diagram, &path::Timings::orderRhs)},
                     {"residual", seconds(diagram, &path::Timings::residual)},
                     {"output", recorder.outputSeconds()},
                     {"total", recorder.seconds()}};
  json["deck_text"] = deck.text;
  return json;
}

std::string branchTable(const path::BranchDiagram& diagram) {
  std::string table =
      "branch,parent,depth,point,kind,load_factor,load_direction,steps,factorizations,end,ended,"
      "stage,imperfection\n";
  for (std::size_t i = 0; i < diagram.branches.size(); ++i) {
    const path::Branch& b = diagram.branches[i];
    const bool first = b.parent < 0;
    const path::CriticalPoint* p = first ? nullptr : &diagram.points[b.point].point;
    table += fmt::format(
        "{},{},{},{},{},{:.17g},{:.17g},{},{},{},{},{},{:g}\n", i, b.parent, b.depth, b.point,
        b.imperfection != 0 ? "imperfect"
        : !b.stage.empty()  ? "stage"
        : first             ? "start"
                            : path::toString(p->kind),
        first ? b.start.lambda : p->state.lambda, first ? 0.0 : b.direction.lambda, b.outcome.steps,
        b.outcome.factorizations, path::toString(b.end), endedOf(b), b.stage, b.imperfection);
  }
  return table;
}

}  // namespace atrapos
