#include "output/PathCurves.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "deck/Characters.hpp"
#include "output/PathTable.hpp"
#include "output/TableFile.hpp"

namespace atrapos {
namespace {

Stability stabilityOf(double negative) {
  if (!(negative >= 0)) return Stability::unknown;
  return negative > 0 ? Stability::unstable : Stability::stable;
}

/// A point of points.csv that may change the stability.
struct Located {
  double pathLength = 0;
  std::string kind;
  MarkType type = MarkType::limit;
  int step = 0;
  bool changes = true;  ///< the number of negative eigenvalues
  double loadFactor = 0;
  std::vector<double> monitors;
};

/// [branch] Its limit points of the load factor and bifurcation points, along the path.
std::map<int, std::vector<Located>> locatedIn(const TableFile& points) {
  std::map<int, std::vector<Located>> located;
  const auto branch = points.integers("branch"), nullity = points.integers("nullity"),
             step = points.integers("step"), change = points.integers("negative_change");
  const auto length = points.numbers("path_length"), load = points.numbers("load_factor");
  const auto kind = points.texts("kind");
  const std::size_t first = points.place("uncertainty") + 1;
  for (std::size_t i = 0; i < points.numRows(); ++i) {
    const MarkType type = kind[i] == hopfKind ? MarkType::hopf
                          : nullity[i] > 0    ? MarkType::bifurcation
                                              : MarkType::limit;
    if (type == MarkType::limit && kind[i] != "maximum" && kind[i] != "minimum") continue;  // of a monitor
    if (!std::isfinite(length[i]))
      throw std::invalid_argument(fmt::format("points.csv: row {} has no path length", i + 1));
    const bool changes = type == MarkType::limit || change[i] != 0;
    Located p{length[i], kind[i], type, step[i], changes, load[i], {}};
    for (std::size_t m = first; m < points.names().size(); ++m) p.monitors.push_back(points.number(i, m));
    located[branch[i]].push_back(std::move(p));
  }
  for (auto& [of, list] : located)
    std::stable_sort(list.begin(), list.end(),
                     [](const Located& a, const Located& b) { return a.pathLength < b.pathLength; });
  return located;
}

void append(BranchCurve& curve, int step, double loadFactor, double pathLength,
            const std::vector<double>& monitors, Stability next) {
  curve.steps.push_back(step);
  curve.values[0].push_back(loadFactor);
  curve.values[1].push_back(pathLength);
  for (std::size_t m = 0; m < monitors.size(); ++m) curve.values[2 + m].push_back(monitors[m]);
  curve.stability.push_back(next);
}

/// Of the stretches that the points located between two rows make: up to the first one it is that of the row
/// before, from the last one on that of the row behind. Between them, and where rows differ without a point,
/// it is not known to be stable.
Stability stretch(Stability before, Stability behind, int number, int last) {
  if (last == 0 && before == behind) return before;
  if (last > 0 && number == 0) return before;
  if (last > 0 && number == last) return behind;
  return before == Stability::unknown || behind == Stability::unknown ? Stability::unknown
                                                                      : Stability::unstable;
}

/// Rows and located points of one branch in one order.
class Merger {
 public:
  Merger(BranchCurve& curve, const std::vector<Located>& located)
      : curve_(curve), located_(located), next_(located.begin()) {}

  void row(int step, double loadFactor, double pathLength, const std::vector<double>& monitors,
           Stability here) {
    if (curve_.numPoints() > 0) {
      auto end = next_;
      int changes = 0, passed = 0;
      for (; end != located_.end() && end->pathLength <= pathLength; ++end) changes += end->changes;
      curve_.stability.back() = stretch(before_, here, passed, changes);
      for (; next_ != end; ++next_) {
        passed += next_->changes;
        curve_.marks.push_back({curve_.numPoints(), next_->kind, next_->type});
        append(curve_, next_->step, next_->loadFactor, next_->pathLength, next_->monitors,
               stretch(before_, here, passed, changes));
      }
    }
    append(curve_, step, loadFactor, pathLength, monitors, here);
    before_ = here;
  }

 private:
  BranchCurve& curve_;
  const std::vector<Located>& located_;
  std::vector<Located>::const_iterator next_;
  Stability before_ = Stability::unknown;
};

std::vector<BranchCurve> curvesOf(const TableFile& path, const std::map<int, std::vector<Located>>& located) {
  const auto branch = path.integers("branch"), step = path.integers("step");
  const auto length = path.numbers("path_length"), load = path.numbers("load_factor"),
             negative = path.numbers("negative_eigenvalues");
  const std::size_t first = path.place("load_factor") + 1, end = path.place("negative_eigenvalues");
  std::vector<BranchCurve> curves;
  std::map<int, Merger> mergers;
  std::map<int, std::size_t> places;
  const std::vector<Located> none;
  for (const int b : branch)
    if (places.emplace(b, curves.size()).second) {
      BranchCurve& curve = curves.emplace_back();
      curve.number = b;
      curve.name = curve.number == 0 ? "path" : fmt::format("branch {}", curve.number);
      curve.values.resize(2 + end - first);
    }
  for (const auto& [number, place] : places) {
    const auto found = located.find(number);
    mergers.emplace(number, Merger(curves[place], found == located.end() ? none : found->second));
  }
  for (std::size_t i = 0; i < path.numRows(); ++i) {
    std::vector<double> monitors;
    for (std::size_t m = first; m < end; ++m) monitors.push_back(path.number(i, m));
    mergers.at(branch[i]).row(step[i], load[i], length[i], monitors, stabilityOf(negative[i]));
  }
  return curves;
}

void nameBranches(const TableFile& table, std::vector<BranchCurve>& curves) {
  const auto number = table.integers("branch");
  const auto size = table.numbers("imperfection");
  const auto kind = table.texts("kind");
  const auto stage = table.has("stage") ? table.texts("stage") : std::vector<std::string>(number.size());
  for (std::size_t i = 0; i < table.numRows(); ++i)
    for (BranchCurve& curve : curves) {
      if (curve.number != number[i] || (curve.number == 0 && stage[i].empty())) continue;
      curve.name = !stage[i].empty() ? stage[i]
                   : size[i] != 0    ? fmt::format("imperfection {:g}", size[i])
                                     : fmt::format("branch {} ({})", curve.number, kind[i]);
    }
}

QuantityKind kindOf(const std::string& type) {
  if (type == "displacement") return QuantityKind::displacement;
  if (type == "reaction" || type == "contact_force") return QuantityKind::force;
  return QuantityKind::other;
}

void takeSummary(const std::string& file, PathCurves& curves) {
  std::ifstream in(file);
  const auto json = nlohmann::json::parse(in, nullptr, false);
  if (!json.is_object()) throw std::invalid_argument(fmt::format("{}: is not what a run writes", file));
  const auto textOf = [](const nlohmann::json& of, const char* key) {
    const auto found = of.find(key);
    return found != of.end() && found->is_string() ? found->get<std::string>() : std::string();
  };
  curves.title = textOf(json, "title");
  curves.drivenByDisplacement = textOf(json, "driven_by") == "displacement";
  const auto types = json.find("monitors");
  if (types == json.end() || !types->is_object()) return;
  for (std::size_t q = 2; q < curves.quantities.size(); ++q)
    curves.quantities[q].kind = kindOf(textOf(*types, curves.quantities[q].name.c_str()));
}

}  // namespace

std::size_t PathCurves::find(const std::string& name) const {
  std::string names;
  for (std::size_t q = 0; q < quantities.size(); ++q) {
    if (quantities[q].name == name) return q;
    names += (q == 0 ? "" : ", ") + quantities[q].name;
  }
  throw std::invalid_argument(
      fmt::format("there is no '{}' in path.csv; there are {}", name, deck::plainLine(names)));
}

PathCurves readCurves(const std::string& folder) {
  const auto file = [&](const char* name) { return folder + "/" + name; };
  if (!std::filesystem::exists(file("path.csv")))
    throw std::invalid_argument(
        fmt::format("{}: holds no path.csv; expected the results of `atrapos run`", folder));
  const TableFile path(file("path.csv")), points(file("points.csv"));
  if (path.place("negative_eigenvalues") < path.place("load_factor"))
    throw std::invalid_argument(
        fmt::format("{}: its columns are not in the order in which a run writes them", file("path.csv")));
  PathCurves curves;
  curves.quantities = {{"load factor", QuantityKind::load}, {"path length", QuantityKind::length}};
  for (std::size_t m = path.place("load_factor") + 1; m < path.place("negative_eigenvalues"); ++m)
    curves.quantities.push_back({path.names()[m], QuantityKind::other});
  if (points.names().size() - points.place("uncertainty") + 1 != curves.quantities.size())
    throw std::invalid_argument(fmt::format("{}: path.csv and points.csv have different monitors", folder));
  curves.branches = curvesOf(path, locatedIn(points));
  if (std::filesystem::exists(file("branches.csv")))
    nameBranches(TableFile(file("branches.csv")), curves.branches);
  if (std::filesystem::is_regular_file(file("summary.json"))) takeSummary(file("summary.json"), curves);
  if (curves.title.empty()) curves.title = std::filesystem::path(folder).filename().string();
  return curves;
}

namespace {

/// Weights of the values at `nodes` in that of their polynomial at s (Lagrange).
std::vector<double> weightsAt(double s, const std::vector<double>& nodes) {
  std::vector<double> weights(nodes.size(), 1.0);
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (std::size_t j = 0; j < nodes.size(); ++j)
      if (j != i) weights[i] *= (s - nodes[j]) / (nodes[i] - nodes[j]);
  return weights;
}

/// The points of the step on which the stretch from `point` to the next one lies, next to that stretch: two
/// at either end at most, none twice.
std::vector<std::size_t> nodesAround(const BranchCurve& branch, std::size_t point) {
  const auto& length = branch.values[1];
  const int step = branch.steps[point + 1];
  const double together = 1e-6 * (length[point + 1] - length[point]);
  std::vector<std::size_t> nodes{point, point + 1};
  const auto belongs = [&](std::size_t at) { return branch.steps[at] == step; };
  // A step begins at the last point of the one before.
  if (point > 0 && belongs(point) && length[point] - length[point - 1] > together)
    nodes.insert(nodes.begin(), point - 1);
  if (point + 2 < branch.numPoints() && belongs(point + 2) &&
      length[point + 2] - length[point + 1] > together)
    nodes.push_back(point + 2);
  return nodes;
}

}  // namespace

BranchCurve refined(const BranchCurve& branch) {
  constexpr int parts = 8;  // of a stretch
  BranchCurve fine;
  fine.number = branch.number;
  fine.name = branch.name;
  fine.values.resize(branch.values.size());
  std::vector<std::size_t> places;
  for (std::size_t point = 0; point < branch.numPoints(); ++point) {
    places.push_back(fine.numPoints());
    const auto add = [&](int step, const auto& valueOf) {
      fine.steps.push_back(step);
      fine.stability.push_back(branch.stability[point]);
      for (std::size_t q = 0; q < fine.values.size(); ++q)
        fine.values[q].push_back(valueOf(branch.values[q]));
    };
    add(branch.steps[point], [&](const std::vector<double>& values) { return values[point]; });
    if (point + 1 == branch.numPoints()) break;
    const auto nodes = nodesAround(branch, point);
    const double from = branch.values[1][point], to = branch.values[1][point + 1];
    if (nodes.size() < 3 || !(to > from)) continue;
    std::vector<double> lengths;
    for (const std::size_t node : nodes) lengths.push_back(branch.values[1][node]);
    for (int part = 1; part < parts; ++part) {
      const auto weights = weightsAt(from + (to - from) * part / parts, lengths);
      add(branch.steps[point + 1], [&](const std::vector<double>& values) {
        double value = 0;
        for (std::size_t n = 0; n < nodes.size(); ++n) value += weights[n] * values[nodes[n]];
        return value;
      });
    }
  }
  for (CurveMark mark : branch.marks) {
    mark.point = places[mark.point];
    fine.marks.push_back(mark);
  }
  return fine;
}

}  // namespace atrapos
