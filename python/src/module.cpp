// The compiled part of the Python module atrapos: decks and results through the code of the command, paths of
// equations written in Python. What users see is in python/atrapos.
#include <pybind11/functional.h>
#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <csignal>
#include <memory>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "NumpyProblem.hpp"
#include "Version.hpp"
#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/linear/MakeTangentSolver.hpp"
#include "atrapos/path/Branches.hpp"
#include "atrapos/path/PathFollower.hpp"
#include "commands/FollowDeck.hpp"
#include "machine/Interrupt.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "machine/Runtime.hpp"

namespace py = pybind11;

namespace atrapos::python {
namespace {

/// MPI and Kokkos from the first call on; they end with the interpreter (finalize).
std::unique_ptr<Runtime>& runtime() {
  static std::unique_ptr<Runtime> only;
  return only;
}
void start() {
  if (runtime()) return;
  std::signal(SIGXFSZ, SIG_IGN);
  runtime() = std::make_unique<Runtime>(0);
}

/// Output of the C++ side, line by line, as Python's print.
class Printed final : public std::ostringstream {
 public:
  void flush() {
    py::print(str(), py::arg("end") = "", py::arg("flush") = true);
    str("");
  }
};

py::dict stepOf(int branch, const path::StepReport& report) {
  py::dict step;
  step["branch"] = branch;
  step["step"] = report.step;
  step["order"] = report.order;
  step["radius"] = report.radius;
  step["length"] = report.length;
  step["path_length"] = report.pathLengthEnd;
  step["load_factor"] = report.lambdaEnd;
  step["residual"] = report.residual;
  return step;
}

py::tuple run(const std::string& file, const std::string& directory, const std::string& restart, bool quiet,
              const std::optional<py::function>& onStep) {
  start();
  const deck::Deck deck = deck::readDeck(file);
  Printed out;
  RunOptions options;
  options.directory = directory;
  options.restart = restart;
  const bool shown = !quiet && ranks::isFirst();
  options.progress = shown ? &out : nullptr;
  std::vector<std::string> names;
  for (const auto& monitor : deck.output.monitors) names.push_back(monitor.name);
  options.afterStep = [&](const StepTaken& taken) {
    if (shown) out.flush();
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!onStep) return;
    py::dict step = stepOf(taken.branch, taken.report);
    for (std::size_t i = 0; i < names.size() && i < taken.monitors.size(); ++i)
      step[py::str(names[i])] = taken.monitors[i];
    const py::object told = (*onStep)(step);
    if (told.is(py::bool_(false))) Interrupt::ask();
  };
  RunResult result;
  const auto follow = [&] {
    result = followDeck(deck, options, [&](const std::string& line) {
      if (shown) out << line << '\n';
    });
    return 0;
  };
  if (deck.problem)
    ranks::onFirst(follow);
  else
    follow();
  if (shown) out.flush();
  return py::make_tuple(result.reachedStop, result.text);
}

std::string check(const std::string& file) {
  start();
  std::ostringstream out;
  checkDeck(deck::readDeck(file), out);
  return out.str();
}

std::string mesh(const std::string& file, const std::string& output) {
  start();
  return writeDeckMesh(deck::readDeck(file), output);
}

template <class T>
py::array_t<T> matrix(const std::vector<T>& values, std::size_t columns) {
  py::array_t<T> a({values.size() / columns, columns});
  std::copy(values.begin(), values.end(), a.mutable_data());
  return a;
}

py::dict meshOf(const std::string& file) {
  const fem::Mesh mesh = exodus::readMesh(file);
  py::dict result;
  result["points"] = matrix(mesh.coordinates, 3);
  py::list blocks;
  for (const fem::Block& block : mesh.blocks) {
    py::dict b;
    b["name"] = block.name;
    b["cell"] = fem::topologyName(block.topology);
    b["nodes"] = matrix(block.nodes, static_cast<std::size_t>(fem::nodesPerElement(block.topology)));
    blocks.append(b);
  }
  result["blocks"] = blocks;
  return result;
}

py::array_t<double> numbersOf(const std::vector<double>& values) {
  return py::array_t<double>(values.size(), values.data());
}

/// What a path of NumpyProblem gives.
class PathTables {
 public:
  explicit PathTables(int points) : points_(points) {
    for (const char* name : {"u", "load_factor", "path_length", "step", "negative_eigenvalues"})
      told_[name] = py::list();
    told_["points"] = py::list();
    told_["steps"] = py::list();
  }
  /// The step as the caller sees it.
  py::dict add(int branch, const path::StepReport& report, const path::Series& series) {
    const auto negative = [&](double a) { return report.negativeAt(a).value_or(-1); };
    if (report.step == 1) row(0, 0, series.state(0), negative(0));
    for (int j = 1; j < points_; ++j) {
      const double a = report.length * j / points_;
      row(report.step, report.pathLengthStart + a, series.state(a), negative(a));
    }
    row(report.step, report.pathLengthEnd, report.end, negative(report.length));
    for (const auto& limit : report.limitPoints) point("limit", report, series, limit.a);
    for (const auto& critical : report.criticalPoints) point("bifurcation", report, series, critical.a);
    py::dict step = stepOf(branch, report);
    append("steps", step);
    return step;
  }
  py::dict end(const path::Branch& branch) {
    const path::Outcome& outcome = branch.outcome;
    told_["reached_stop"] = path::atStop(branch);
    told_["text"] = outcome.text.empty() ? path::toString(branch.end) : outcome.text;
    told_["factorizations"] = outcome.factorizations;
    told_["solves"] = outcome.solves;
    told_["parent"] = branch.parent;
    return told_;
  }

 private:
  void append(const char* name, const py::object& value) { told_[name].cast<py::list>().append(value); }
  void row(int step, double length, const path::State& state, long long negative) {
    append("u", NumpyProblem::numbers(*state.u));
    append("load_factor", py::float_(state.lambda));
    append("path_length", py::float_(length));
    append("step", py::int_(step));
    append("negative_eigenvalues", py::int_(negative));
  }
  void point(const char* kind, const path::StepReport& report, const path::Series& series, double a) {
    const path::State state = series.state(a);
    py::dict p;
    p["kind"] = kind;
    p["step"] = report.step;
    p["load_factor"] = state.lambda;
    p["u"] = NumpyProblem::numbers(*state.u);
    append("points", p);
  }
  int points_;
  py::dict told_;
};

class Watch final : public path::BranchObserver {
 public:
  Watch(int points, const std::optional<py::function>& onStep) : points_(points), onStep_(onStep) {}
  bool onStep(int branch, const path::StepReport& report, const path::Series& series) override {
    const py::dict step = of(branch).add(branch, report, series);
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    return !onStep_ || !(*onStep_)(step).is(py::bool_(false));
  }
  PathTables& of(int branch) {
    while (static_cast<int>(paths_.size()) <= branch) paths_.emplace_back(points_);
    return paths_[branch];
  }

 private:
  int points_;
  const std::optional<py::function>& onStep_;
  std::vector<PathTables> paths_;
};

struct FollowOptions {
  std::vector<double> stops;
  int steps = 0, order = 0, points = 0;
  double accuracy = 0, direction = 1;
  std::string branches;
};

path::Follow branchesOf(const std::string& name) {
  if (name == "none") return path::Follow::none;
  if (name == "stable") return path::Follow::stable;
  if (name == "all") return path::Follow::all;
  throw std::invalid_argument("branches: '" + name + "'; expected none, stable or all");
}

/// One dict a path: the first one, then its branches.
py::list follow(const py::object& equations, const Numbers& start0, double loadFactor, bool symmetric,
                const std::vector<int>& rows, const std::vector<long long>& columns,
                const FollowOptions& given, const std::optional<py::function>& onStep) {
  start();
  NumpyProblem problem(equations, static_cast<int>(start0.size()), symmetric, rows, columns);
  linear::TangentSolverOptions solverOptions;
  solverOptions.symmetric = symmetric;
  const auto solver = linear::makeTangentSolver(solverOptions);
  path::Options options;
  options.order = given.order;
  options.delta = options.residualBound = given.accuracy;
  options.direction = given.direction;
  options.maxSteps = given.steps;
  path::Stops ends;
  ends.loadFactors = given.stops;
  path::BranchOptions branches;
  branches.follow = branchesOf(given.branches);
  path::BranchFollower follower(problem, *solver, options, ends, branches);
  Watch watch(given.points, onStep);
  const path::BranchDiagram diagram = follower.run({problem.vector(start0), loadFactor}, watch);
  problem.rethrow();
  py::list paths;
  for (std::size_t b = 0; b < diagram.branches.size(); ++b)
    paths.append(watch.of(static_cast<int>(b)).end(diagram.branches[b]));
  return paths;
}

}  // namespace
}  // namespace atrapos::python

PYBIND11_MODULE(_atrapos, m) {
  using namespace atrapos;
  using namespace atrapos::python;
  m.doc() = "The compiled part of atrapos";
  m.attr("version") = kVersion;
  py::register_exception<deck::DeckError>(m, "DeckError", PyExc_ValueError);
  py::register_exception<exodus::Error>(m, "MeshError", PyExc_ValueError);
  py::register_exception<FileError>(m, "FileError", PyExc_OSError);
  m.def("run", &run);
  m.def("check", &check);
  m.def("mesh", &mesh);
  m.def("mesh_of", &meshOf);
  py::class_<FollowOptions>(m, "FollowOptions")
      .def(py::init<>())
      .def_readwrite("stops", &FollowOptions::stops)
      .def_readwrite("steps", &FollowOptions::steps)
      .def_readwrite("order", &FollowOptions::order)
      .def_readwrite("points", &FollowOptions::points)
      .def_readwrite("accuracy", &FollowOptions::accuracy)
      .def_readwrite("direction", &FollowOptions::direction)
      .def_readwrite("branches", &FollowOptions::branches);
  m.def("follow", &follow);
  m.def("finalize", [] { runtime().reset(); });
  py::class_<exodus::ResultReader>(m, "ResultFile")
      .def(py::init([](const std::string& file) {
        start();
        return exodus::ResultReader(file);
      }))
      .def_property_readonly("count", &exodus::ResultReader::numSteps)
      .def_property_readonly("nodal_names", &exodus::ResultReader::nodalNames)
      .def_property_readonly("element_names", &exodus::ResultReader::elementNames)
      .def_property_readonly("global_names", &exodus::ResultReader::globalNames)
      .def("nodal", [](const exodus::ResultReader& r, int step,
                       const std::string& name) { return numbersOf(r.nodal(step, name)); })
      .def("element", [](const exodus::ResultReader& r, int step,
                         const std::string& name) { return numbersOf(r.element(step, name)); })
      .def("global_", &exodus::ResultReader::global);
}
