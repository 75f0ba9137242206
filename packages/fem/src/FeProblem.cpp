#include "atrapos/fem/FeProblem.hpp"

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

#include "CoupledSystem.hpp"
#include "EventTerms.hpp"
#include "PieceTerms.hpp"

namespace atrapos::fem {

using linear::CrsGraph;
using linear::CrsMatrix;
using linear::Map;
using linear::RCP;
using linear::rcp;
using linear::Vector;

namespace {

Field writable(Vector& u) {
  auto view = u.getLocalViewDevice(Tpetra::Access::ReadWrite);
  return Kokkos::subview(view, Kokkos::ALL(), 0);
}

Field toDevice(const std::vector<double>& host) {
  Field f(Kokkos::view_alloc("field", Kokkos::WithoutInitializing), host.size());
  auto mirror = Kokkos::create_mirror_view(f);
  std::copy(host.begin(), host.end(), mirror.data());
  Kokkos::deep_copy(f, mirror);
  return f;
}

std::vector<double> toHost(const ConstField& f) {
  auto mirror = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), f);
  return {mirror.data(), mirror.data() + mirror.size()};
}

/// Summed in one order, so that the number is the same for any number of threads.
double norm(const ConstField& f) {
  auto mirror = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), f);
  double sum = 0;
  for (std::size_t i = 0; i < mirror.size(); ++i) sum += mirror(i) * mirror(i);
  return std::sqrt(sum);
}

/// Rows of the node graph, sorted: all nodes that share an entity of any term, coupled nodes with their
/// masters.
std::vector<std::vector<int>> nodeGraph(const FeModel& model, const std::vector<Coupling>& couplings) {
  std::vector<std::vector<int>> rows(model.numNodes), masters(model.numNodes);
  for (const Coupling& c : couplings)
    for (const CoupledDof& m : c.masters) masters[c.dof / 3].push_back(m.dof / 3);
  for (auto& nodes : masters) {
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  }
  const auto connect = [&](const std::vector<int>& group) {
    for (int a : group) rows[a].insert(rows[a].end(), group.begin(), group.end());
  };
  for (const auto& term : model.terms) {
    const int N = term->nodesPerEntity();
    const std::vector<int>& nodes = term->nodes();
    for (int e = 0; e < term->numEntities(); ++e) {
      std::vector<int> group(nodes.begin() + e * N, nodes.begin() + (e + 1) * N);
      for (int a = 0; a < N; ++a) {
        const auto& more = masters[nodes[e * N + a]];
        group.insert(group.end(), more.begin(), more.end());
      }
      connect(group);
    }
  }
  for (int n = 0; n < model.numNodes; ++n) {
    if (masters[n].empty()) continue;
    std::vector<int> group = masters[n];
    group.push_back(n);
    connect(group);
  }
  for (int n = 0; n < model.numNodes; ++n) {
    auto& row = rows[n];
    row.push_back(n);
    std::sort(row.begin(), row.end());
    row.erase(std::unique(row.begin(), row.end()), row.end());
    row.shrink_to_fit();
  }
  return rows;
}

}  // namespace

ConstField field(const Vector& u) {
  auto view = u.getLocalViewDevice(Tpetra::Access::ReadOnly);
  return Kokkos::subview(view, Kokkos::ALL(), 0);
}

struct FeProblem::Impl {
  FeModel model;
  EventTerms events;
  PieceTerms pieces;
  RCP<const Map> map;
  RCP<CrsMatrix> K;
  View<std::size_t*> rowStart;
  View<int*> columns;
  View<char*> fixed;
  detail::CoupledSystem coupled;
  Field value, rate, load, constantLoad;
  Field sum;                  // work
  Field last;                 // U of the order completed last
  double lastLambda = 0;      // and its lambda
  double diagonal = 0;        // s of the prescribed rows
  double parameterInner = 1;  // factor of a parameter's square in inner()
  double scaleFloor = 0;
  int numFree = 0;

  explicit Impl(FeModel m) : model(std::move(m)), events(model.terms) {
    const auto comm = model.comm.is_null() ? Tpetra::getDefaultComm() : model.comm;
    if (comm->getSize() != 1)
      throw std::invalid_argument(
          "finite-element problems run on one rank so far: start without mpirun, or with -np 1");
    const int numDofs = 3 * model.numNodes;
    if (model.supports.numNodes() != model.numNodes)
      throw std::logic_error("FeModel: supports of another mesh");
    model.load.resize(numDofs, 0.0);
    model.constantLoad.resize(numDofs, 0.0);
    map = rcp(new Map(numDofs, 0, comm));
    sum = Field("sum", numDofs);
    last = Field("last", numDofs);
    if (!model.couplings.empty()) coupled = detail::CoupledSystem(model.couplings.resolved(model.supports));
    makeMatrix();
    uploadConditions();
    findScale();
  }

  void makeMatrix() {
    const auto rows = nodeGraph(model, coupled.couplings());
    const int numDofs = 3 * model.numNodes;
    std::size_t entries = 0;
    for (const auto& row : rows) entries += 9 * row.size();

    using LocalGraph = CrsGraph::local_graph_device_type;
    LocalGraph::row_map_type::non_const_type rowPtr("rowPtr", numDofs + 1);
    LocalGraph::entries_type::non_const_type indices("indices", entries);
    auto hostPtr = Kokkos::create_mirror_view(rowPtr);
    auto hostInd = Kokkos::create_mirror_view(indices);
    std::size_t at = 0;
    for (int n = 0; n < model.numNodes; ++n)
      for (int i = 0; i < 3; ++i) {
        hostPtr(3 * n + i) = at;
        for (int m : rows[n])
          for (int j = 0; j < 3; ++j) hostInd(at++) = 3 * m + j;
      }
    hostPtr(numDofs) = at;
    Kokkos::deep_copy(rowPtr, hostPtr);
    Kokkos::deep_copy(indices, hostInd);
    const auto graph = rcp(new CrsGraph(map, map, rowPtr, indices));
    graph->fillComplete(map, map);
    K = rcp(new CrsMatrix(graph));
    K->fillComplete(map, map);

    rowStart = View<std::size_t*>("rowStart", numDofs + 1);
    auto starts = Kokkos::create_mirror_view(rowStart);
    for (int i = 0; i <= numDofs; ++i) starts(i) = hostPtr(i);
    Kokkos::deep_copy(rowStart, starts);
    columns = View<int*>("columns", entries);
    Kokkos::deep_copy(columns, indices);

    for (auto& term : model.terms) {
      const int N = term->nodesPerEntity();
      const auto& nodes = term->nodes();
      std::vector<int> positions(static_cast<std::size_t>(term->numEntities()) * N * N);
      for (int e = 0; e < term->numEntities(); ++e)
        for (int a = 0; a < N; ++a) {
          const auto& row = rows[nodes[e * N + a]];
          for (int b = 0; b < N; ++b)
            positions[(static_cast<std::size_t>(e) * N + a) * N + b] =
                3 *
                static_cast<int>(std::lower_bound(row.begin(), row.end(), nodes[e * N + b]) - row.begin());
        }
      term->setPositions(positions);
    }
  }

  void uploadConditions() {
    std::vector<char> used(model.numNodes, 0);
    for (const auto& term : model.terms)
      for (int n : term->nodes()) used[n] = 1;
    for (const Coupling& c : coupled.couplings()) {
      used[c.dof / 3] = 1;
      for (const CoupledDof& m : c.masters) used[m.dof / 3] = 1;
    }
    const int numDofs = 3 * model.numNodes;
    for (int d = 0; d < numDofs; ++d)
      if (!used[d / 3] && (model.load[d] != 0 || model.constantLoad[d] != 0))
        throw std::invalid_argument("a force acts at node " + std::to_string(d / 3 + 1) +
                                    ", which no element has");
    fixed = View<char*>("fixed", numDofs);
    auto flags = Kokkos::create_mirror_view(fixed);
    std::vector<double> values(numDofs, 0.0), rates(numDofs, 0.0);
    for (int d = 0; d < numDofs; ++d) {
      flags(d) = model.supports.fixed(d) || !used[d / 3];
      numFree += !flags(d);
      values[d] = model.supports.value(d);
      rates[d] = model.supports.perLoadFactor(d);
    }
    for (const Coupling& c : coupled.couplings()) {
      --numFree;
      values[c.dof] = c.value;
      rates[c.dof] = c.perLoadFactor;
      for (const CoupledDof& m : c.masters) {
        values[c.dof] += m.factor * values[m.dof];
        rates[c.dof] += m.factor * rates[m.dof];
      }
    }
    Kokkos::deep_copy(fixed, flags);
    value = toDevice(values);
    rate = toDevice(rates);
    load = toDevice(model.load);
    constantLoad = toDevice(model.constantLoad);
  }

  /// Forces at load factor 1: dead loads, those that the driven supports alone would need, and those of terms
  /// that see lambda as their rate at the start.
  void findScale() {
    double size = std::max(norm(load), norm(constantLoad));
    if (model.supports.driven() || model.couplings.driven()) {
      double squares = 0;
      for (const auto& term : model.terms)
        if (!term->seesLoadFactor()) squares += term->addResidual(rate, 1, sum);
      size = std::max(size, std::sqrt(squares));
    }
    // Terms that see lambda count by their derivative: their force at load factor 1 in the undeformed body
    // says nothing (a tool moved through it).
    Kokkos::deep_copy(sum, 0.0);
    const TangentSink sink{rowStart, K->getLocalMatrixDevice().values, sum};
    for (const auto& term : model.terms)
      if (term->seesLoadFactor()) term->addTangent(value, 0, sink);
    const double driving = norm(sum);
    if (std::isfinite(driving)) size = std::max(size, driving);
    scaleFloor = std::max(1e-6 * size, 1e-300);
  }

  /// sum = sum of the terms - F_0 - lambda F_1 on all rows; returns the scale.
  double imbalance(const ConstField& u, double lambda) {
    const Field total = sum, F1 = load, F0 = constantLoad;
    Kokkos::parallel_for(
        "loads", Kokkos::RangePolicy<Execution>(0, total.size()),
        KOKKOS_LAMBDA(int i) { total(i) = -F0(i) - lambda * F1(i); });
    const double external = norm(total);
    double squares = 0;
    for (const auto& term : model.terms) squares += term->addResidual(u, lambda, total);
    return std::max({scaleFloor, external, std::sqrt(squares)});
  }

  double ofParameters(const Vector& x, const Vector& y) const {
    if (model.parameters.empty()) return 0;
    const auto a = x.getLocalViewHost(Tpetra::Access::ReadOnly),
               b = y.getLocalViewHost(Tpetra::Access::ReadOnly);
    double sum = 0;
    for (const int d : model.parameters) sum += a(d, 0) * b(d, 0);
    return sum;
  }

  /// The smallest diagonal entry of the tangent among the free dofs of a node; 0 where there is none.
  std::vector<double> nodalStiffness() const {
    const auto onHost = [](const auto& view) {
      return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
    };
    const auto values = onHost(K->getLocalMatrixDevice().values);
    const auto start = onHost(rowStart);
    const auto column = onHost(columns);
    const auto isFixed = onHost(fixed);
    std::vector<double> stiffness(model.numNodes, 0.0);
    for (int d = 0; d < 3 * model.numNodes; ++d)
      for (std::size_t e = start(d); e < start(d + 1); ++e)
        if (column(e) == d && !isFixed(d) && values(e) > 0) {
          double& least = stiffness[d / 3];
          least = least > 0 ? std::min(least, values(e)) : values(e);
        }
    return stiffness;
  }

  /// The size of the free dofs' diagonal.
  void findDiagonal() {
    const auto values = K->getLocalMatrixDevice().values;
    const auto start = rowStart;
    const auto column = columns;
    const auto isFixed = fixed;
    const int numDofs = 3 * model.numNodes;
    double largest = 0;
    Kokkos::parallel_reduce(
        "diagonal", Kokkos::RangePolicy<Execution>(0, numDofs),
        KOKKOS_LAMBDA(int d, double& m) {
          for (std::size_t e = start(d); e < start(d + 1); ++e)
            if (column(e) == d && !isFixed(d))
              m = Kokkos::Experimental::fmax(m, Kokkos::Experimental::fabs(values(e)));
        },
        Kokkos::Max<double>(largest));
    diagonal = largest > 0 && std::isfinite(largest) ? largest : 1.0;
  }

  /// Turns the rows of prescribed dofs into s u_d and carries their columns to F.
  void applySupports(const Field& F) {
    const auto values = K->getLocalMatrixDevice().values;
    const auto start = rowStart;
    const auto column = columns;
    const auto isFixed = fixed;
    const auto rates = rate;
    const int numDofs = static_cast<int>(F.size());
    const double s = diagonal;
    Kokkos::parallel_for(
        "supports", Kokkos::RangePolicy<Execution>(0, numDofs), KOKKOS_LAMBDA(int d) {
          if (isFixed(d)) {
            for (std::size_t e = start(d); e < start(d + 1); ++e) values(e) = column(e) == d ? s : 0.0;
            F(d) = s * rates(d);
            return;
          }
          double carried = 0;
          for (std::size_t e = start(d); e < start(d + 1); ++e)
            if (isFixed(column(e))) {
              carried += values(e) * rates(column(e));
              values(e) = 0;
            }
          F(d) -= carried;
        });
  }
};

FeProblem::FeProblem(FeModel model) : impl_(std::make_unique<Impl>(std::move(model))) {
  Vector F(impl_->map);
  tangent(*initialState(0.0), 0.0, F);  // gives the prescribed rows their size
  impl_->pieces =
      PieceTerms(impl_->model.terms, impl_->events.count(),
                 [this](const Vector& u, double lambda, Vector& r) { return residual(u, lambda, r); });
  if (impl_->events.empty()) return;
  auto& events = impl_->events;
  events.setStiffness(impl_->nodalStiffness());
  // A tool that moves drives the body through the points that it touches.
  const auto free = events.conditions();
  events.setConditions(std::vector<int>(free.size(), 1));
  impl_->findScale();
  events.setConditions(free);
}
FeProblem::~FeProblem() = default;

RCP<const Map> FeProblem::map() const { return impl_->map; }

bool FeProblem::symmetric() const {
  return std::all_of(impl_->model.terms.begin(), impl_->model.terms.end(),
                     [](const auto& term) { return term->symmetric(); });
}

path::ResidualNorm FeProblem::residual(const Vector& u, double lambda, Vector& r) {
  const ConstField state = field(u);
  path::ResidualNorm result;
  result.scale = impl_->imbalance(state, lambda);
  const Field out = writable(r), total = impl_->sum, value = impl_->value, rate = impl_->rate;
  const auto fixed = impl_->fixed;
  const double s = impl_->diagonal;
  impl_->coupled.gatherForces(total);
  impl_->coupled.addGaps(state, lambda, s, total);
  Kokkos::parallel_for(
      "residual", Kokkos::RangePolicy<Execution>(0, out.size()), KOKKOS_LAMBDA(int d) {
        if (fixed(d)) total(d) = s * (state(d) - value(d) - lambda * rate(d));  // not the reaction
        out(d) = total(d);
      });
  result.norm = norm(total);
  return result;
}

RCP<const CrsMatrix> FeProblem::tangent(const Vector& u, double lambda, Vector& F) {
  impl_->K->resumeFill();
  const auto values = impl_->K->getLocalMatrixDevice().values;
  const Field direction = writable(F);
  Kokkos::deep_copy(values, 0.0);
  Kokkos::deep_copy(direction, impl_->load);
  for (const auto& term : impl_->model.terms)
    term->addTangent(field(u), lambda, TangentSink{impl_->rowStart, values, direction});
  // Once: were it that of the last tangent, the rounding of prescribed rows would tell what came before.
  if (impl_->diagonal == 0) impl_->findDiagonal();
  impl_->coupled.transform(impl_->rowStart, impl_->columns, values, impl_->diagonal, direction);
  impl_->applySupports(direction);
  impl_->K->fillComplete(impl_->map, impl_->map);
  return impl_->K;
}

void FeProblem::beginSeries(const Vector& u, double lambda, int maxOrder) {
  for (const auto& term : impl_->model.terms) term->beginSeries(field(u), lambda, maxOrder);
}

void FeProblem::orderRhs(int k, Vector& Fk) {
  const Field total = impl_->sum, out = writable(Fk);
  const auto fixed = impl_->fixed;
  Kokkos::deep_copy(total, 0.0);
  for (const auto& term : impl_->model.terms) term->addOrder(k, impl_->last, impl_->lastLambda, total);
  impl_->coupled.gatherForces(total);
  Kokkos::parallel_for(
      "orderRhs", Kokkos::RangePolicy<Execution>(0, out.size()),
      KOKKOS_LAMBDA(int d) { out(d) = fixed(d) ? 0.0 : -total(d); });
}

void FeProblem::completeOrder(int, const Vector& Uk, double lambdaK) {
  Kokkos::deep_copy(impl_->last, field(Uk));
  impl_->lastLambda = lambdaK;
}

double FeProblem::inner(const path::Increment& x, const path::Increment& y) const {
  return Problem::inner(x, y) + (impl_->parameterInner - 1) * impl_->ofParameters(*x.u, *y.u);
}

double FeProblem::weight(const path::Increment& Xhat, std::optional<double> given) {
  const double displacements = Problem::inner(Xhat, Xhat) - impl_->ofParameters(*Xhat.u, *Xhat.u);
  const double w = given ? *given : 1 / displacements;
  impl_->parameterInner = impl_->model.parameterWeight / w;
  return w;
}

int FeProblem::eventCount() const { return impl_->events.count(); }

void FeProblem::eventOrder(int k, std::vector<double>& g) const {
  impl_->events.order(k, impl_->last, impl_->lastLambda, g);
}

std::vector<int> FeProblem::eventsAt(const Vector& u, double lambda) const {
  return impl_->events.at(field(u), lambda);
}

void FeProblem::applyEvent(const std::vector<int>& indices, const Vector& u, double lambda) {
  impl_->events.apply(indices);
  impl_->pieces.apply(indices, u, lambda);
}

path::Pieces* FeProblem::pieces() { return impl_->pieces.empty() ? nullptr : &impl_->pieces; }

int FeProblem::constraintPivots() const {
  return impl_->model.numMultipliers + impl_->events.constraintPivots() +
         static_cast<int>(impl_->model.parameters.size());
}
std::vector<int> FeProblem::conditions() const {
  std::vector<int> all = impl_->events.conditions();
  const auto preferred = impl_->pieces.conditions();
  all.insert(all.end(), preferred.begin(), preferred.end());
  return all;
}

void FeProblem::setConditions(const std::vector<int>& conditions) {
  const std::size_t events = impl_->events.count(), pieces = impl_->pieces.numPoints();
  if (conditions.size() != events + pieces)
    throw std::invalid_argument("conditions of " + std::to_string(conditions.size()) +
                                " contact points, but there are " + std::to_string(events + pieces));
  impl_->events.setConditions({conditions.begin(), conditions.begin() + events});
  impl_->pieces.setConditions({conditions.begin() + events, conditions.end()});
}

RCP<Vector> FeProblem::initialState(double lambda) const {
  auto u = rcp(new Vector(impl_->map));
  const Field out = writable(*u), value = impl_->value, rate = impl_->rate;
  Kokkos::parallel_for(
      "initialState", Kokkos::RangePolicy<Execution>(0, out.size()),
      KOKKOS_LAMBDA(int d) { out(d) = value(d) + lambda * rate(d); });
  return u;
}

std::vector<double> FeProblem::reactions(const Vector& u, double lambda) const {
  impl_->imbalance(field(u), lambda);
  impl_->coupled.gatherForces(impl_->sum);
  std::vector<double> r = toHost(impl_->sum);
  for (std::size_t d = 0; d < r.size(); ++d)
    if (!impl_->model.supports.fixed(static_cast<int>(d))) r[d] = 0;
  return r;
}

std::vector<double> FeProblem::forces(const Term& term, const Vector& u, double lambda) const {
  Kokkos::deep_copy(impl_->sum, 0.0);
  term.addResidual(field(u), lambda, impl_->sum);
  return toHost(impl_->sum);
}

std::vector<double> FeProblem::values(const Vector& u) { return toHost(field(u)); }

const FeModel& FeProblem::model() const { return impl_->model; }
const Term& FeProblem::term(int i) const { return *impl_->model.terms.at(i); }
int FeProblem::numTerms() const { return static_cast<int>(impl_->model.terms.size()); }
int FeProblem::numFreeDofs() const { return impl_->numFree; }

std::size_t FeProblem::historyBytes(int maxOrder) const {
  std::size_t bytes = 0;
  for (const auto& term : impl_->model.terms) bytes += term->historyBytes(maxOrder);
  return bytes;
}

}  // namespace atrapos::fem
