#include "atrapos/fem/FeProblem.hpp"

#include <Tpetra_Core.hpp>
#include <Tpetra_CrsGraph.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Map.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <stdexcept>
#include <string>

#include "CoupledSystem.hpp"
#include "Distribution.hpp"
#include "EventTerms.hpp"
#include "PieceTerms.hpp"
#include "Upload.hpp"
#include "atrapos/linear/NoMemory.hpp"
#include "atrapos/linear/OnAllRanks.hpp"

namespace atrapos::fem {

using linear::CrsGraph;
using linear::CrsMatrix;
using linear::Map;
using linear::RCP;
using linear::rcp;
using linear::Vector;

namespace {

DofView writable(Vector& u) {
  auto view = u.getLocalViewDevice(Tpetra::Access::ReadWrite);
  return Kokkos::subview(view, Kokkos::ALL(), 0);
}

DofView toDevice(const std::vector<double>& host) {
  DofView f(Kokkos::view_alloc("field", Kokkos::WithoutInitializing), host.size());
  auto mirror = Kokkos::create_mirror_view(f);
  std::copy(host.begin(), host.end(), mirror.data());
  Kokkos::deep_copy(f, mirror);
  return f;
}

std::vector<double> toHost(const ConstDofView& f) {
  auto mirror = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), f);
  return {mirror.data(), mirror.data() + mirror.size()};
}

/// A number for each balance of the model (DofMap::balances).
using Sizes = std::vector<double>;

/// Sums of products of the first entries, as many as `balances` says which balance each belongs to, in one
/// order: the numbers are the same for any number of threads.
Sizes sumsOfProducts(const ConstDofView& f, const ConstDofView& g, const std::vector<int>& balances,
                     std::size_t count) {
  const auto x = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), f);
  const auto y = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), g);
  Sizes sums(count, 0.0);
  for (std::size_t i = 0; i < balances.size(); ++i) sums[balances[i]] += x(i) * y(i);
  return sums;
}
Sizes squares(const ConstDofView& f, const std::vector<int>& balances, std::size_t count) {
  return sumsOfProducts(f, f, balances, count);
}

Sizes largest(Sizes a, const Sizes& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] = std::max(a[i], b[i]);
  return a;
}

/// Entries of the first `count` nodes of a rank, from those of the whole model.
template <class T>
std::vector<T> ofNodes(const std::vector<T>& whole, const DofMap& dofs, const std::vector<int>& nodes,
                       int count) {
  std::vector<T> part;
  for (int l = 0; l < count; ++l)
    part.insert(part.end(), whole.begin() + dofs.firstDof(nodes[l]),
                whole.begin() + dofs.firstDof(nodes[l]) + dofs.numDofs(nodes[l]));
  return part;
}

}  // namespace

ConstDofView field(const Vector& u) {
  auto view = u.getLocalViewDevice(Tpetra::Access::ReadOnly);
  return Kokkos::subview(view, Kokkos::ALL(), 0);
}

struct FeProblem::Impl {
  FeModel model;
  RCP<const Map> map;
  std::unique_ptr<detail::Distribution> ranks;
  std::optional<EventTerms> events;
  std::optional<PieceTerms> pieces;
  RCP<CrsMatrix> K, M;  // M: null until it is asked for
  /// What the terms fill: K's own values, then the rows of shared nodes, which go to their owners.
  View<double*> entries;
  View<std::size_t*> rowStart;
  View<int*> columns;
  View<char*> fixed;
  detail::CoupledSystem coupled;
  DofView initial, value, rate, load, constantLoad;
  DofView shared;                   // state of the last call with the values at shared nodes (several ranks)
  DofView sum;                      // work
  DofView last;                     // U of the order completed last
  double lastLambda = 0;            // and its lambda
  std::vector<char> prescribedRow;  // [own dof] whether its row is a support's or a coupling's
  DofView prescribed;               // s of the prescribed rows, by field
  bool hasPrescribed = false;       // since the first tangent
  std::vector<int> parameters;      // dofs of this rank that are parameters of laws
  std::vector<int> wholeCounts;     // [term] entities on all ranks (several ranks)
  int numParameters = 0, numMultipliers = 0;  // of the whole model
  double parameterInner = 1;                  // factor of a parameter's square in inner()
  double internalInner = 0;                   // and of an internal variable's
  std::vector<double> fieldFactors;           // [balance] of the other unknowns; empty: 1
  bool hasInternal = false;                   // on some rank
  Sizes scaleFloor, initialForces;            // least scale of each balance
  std::vector<int> balances;                  // [own dof] number of its balance
  std::vector<std::size_t> unitGroups;        // [balance] whose eigenvalues compare; empty: not known yet
  int numFree = 0;
  int pivots = 0;                                  // constraintPivots() of the last tangent
  std::vector<int> startConditions;                // events, then pieces
  std::vector<std::size_t> numVariables;           // [term] of this rank
  std::vector<double> startVariables;              // of all terms
  bool anyVariables = false;                       // on any rank
  std::shared_ptr<const path::Memory> remembered;  // what the terms have now; null: not known
  DofView variablesAt;                             // the state that the terms' variables are those of

  explicit Impl(FeModel m) : model(std::move(m)) {
    const auto comm = model.comm.is_null() ? Tpetra::getDefaultComm() : model.comm;
    const int numDofs = model.dofs.numDofs();
    if (model.supports.last() >= numDofs) throw std::logic_error("FeModel: supports of another mesh");
    if (static_cast<int>(std::max({model.load.size(), model.constantLoad.size(), model.initial.size()})) >
        numDofs)
      throw std::logic_error("FeModel: loads or initial values of another mesh");
    model.load.resize(numDofs, 0.0);
    model.constantLoad.resize(numDofs, 0.0);
    model.initial.resize(numDofs, 0.0);
    numParameters = static_cast<int>(model.dofs.dofsWith(Role::parameter).size());
    std::vector<Coupling> couplings;
    if (!model.couplings.empty()) couplings = model.couplings.resolved(model.dofs, model.supports);
    for (const int d : model.dofs.dofsWith(Role::multiplier)) numMultipliers += !model.supports.fixed(d);
    for (const Coupling& c : couplings)  // which has a row of its own
      numMultipliers -= model.dofs.fields()[model.dofs.addressOf(c.dof).field].role == Role::multiplier;
    ranks = std::make_unique<detail::Distribution>(model, couplings, comm);
    map = mapOf(ranks->nodes(), ranks->numOwned());
    sum = DofView("sum", numLocal());
    last = DofView("last", numLocal());
    if (!ranks->alone()) shared = DofView("shared", numLocal());
    coupled = detail::CoupledSystem(ranks->couplings());
    uploadConditions(couplings);
    findPrescribedRows();
    share();
    events.emplace(model.terms, *ranks);
    for (std::size_t d = 0; d < numOwned(); ++d)
      balances.push_back(ranks->dofs().balanceOf(ranks->dofs().addressOf(static_cast<int>(d)).field));
    makeMatrix();
  }

  /// The map of the first nodes of the rank.
  RCP<const Map> mapOf(const std::vector<int>& nodes, int count) const {
    if (ranks->alone()) return rcp(new Map(model.dofs.numDofs(), 0, ranks->comm()));
    std::vector<linear::GlobalIndex> dofs;
    for (int l = 0; l < count; ++l)
      for (int i = 0; i < model.dofs.numDofs(nodes[l]); ++i)
        dofs.push_back(model.dofs.firstDof(nodes[l]) + i);
    return rcp(new Map(Teuchos::OrdinalTraits<Tpetra::global_size_t>::invalid(),
                       Teuchos::arrayViewFromVector(dofs), 0, ranks->comm()));
  }

  /// Terms keep this rank's entities, with its nodes.
  void share() {
    if (ranks->alone()) return;
    ranks->together([&] {
      for (std::size_t t = 0; t < model.terms.size(); ++t) {
        Term& term = *model.terms[t];
        wholeCounts.push_back(term.numEntities());
        TermPart part{ranks->entities()[t], {}};
        const int N = term.nodesPerEntity();
        for (const int e : part.entities)
          for (int n = 0; n < N; ++n)
            part.nodes.push_back(ranks->localOf(term.nodes()[static_cast<std::size_t>(e) * N + n]));
        term.keep(part);
      }
    });
  }

  std::size_t numOwned() const { return ranks->dofs().firstDof(ranks->numOwned()); }
  std::size_t numLocal() const { return ranks->dofs().firstDof(ranks->numLocal()); }

  std::size_t numBalances() const { return model.dofs.balances().size(); }
  /// Norms over all ranks of their own entries.
  Sizes norms(const ConstDofView& f) const { return overRanks(squares(f, balances, numBalances())); }
  /// Products of this rank's own entries.
  Sizes products(const ConstDofView& f, const ConstDofView& g) const {
    return sumsOfProducts(f, g, balances, numBalances());
  }
  /// Roots of sums over all ranks.
  Sizes overRanks(Sizes sums) const {
    sums.resize(numBalances(), 0.0);
    for (double& s : sums) s = std::sqrt(ranks->sum(s));
    return sums;
  }

  /// A state as the terms read it, in `to` where there are several ranks.
  ConstDofView local(const Vector& u, const DofView& to) const {
    if (ranks->alone()) return field(u);
    copyOwned(field(u), to);
    ranks->fetch(to);
    return to;
  }
  ConstDofView local(const Vector& u) const { return local(u, shared); }

  /// This rank's own entries of a field, with those of all others.
  std::vector<double> onAllRanks(const DofView& f) const {
    return linear::onAllRanks(*map, toHost(Kokkos::subview(f, std::make_pair(std::size_t{0}, numOwned()))));
  }

  void copyOwned(const ConstDofView& from, const DofView& to) const {
    const auto range = std::make_pair(std::size_t{0}, numOwned());
    Kokkos::deep_copy(Kokkos::subview(to, range), Kokkos::subview(from, range));
  }

  /// rowStart and columns; the number of entries in rows that this rank owns.
  std::size_t makeRows() {
    const DofMap& dofs = ranks->dofs();
    std::size_t count = 0;
    for (int l = 0; l < ranks->numLocal(); ++l) count += dofs.numDofs(l) * ranks->rowLength(l);
    std::vector<std::size_t> starts{0};
    std::vector<int> indices;
    indices.reserve(count);
    for (int l = 0; l < ranks->numLocal(); ++l)
      for (int i = 0; i < dofs.numDofs(l); ++i) {
        for (int m : ranks->rows()[l])
          for (int j = 0; j < dofs.numDofs(m); ++j) indices.push_back(dofs.firstDof(m) + j);
        starts.push_back(indices.size());
      }
    rowStart = upload("rowStart", starts);
    columns = upload("columns", indices);
    return starts[numOwned()];
  }

  void makeMatrix() {
    const DofMap& dofs = ranks->dofs();
    const std::size_t ownCount = makeRows();
    // The matrix of the rows that this rank owns is the front part of what the terms fill, not a copy.
    using LocalGraph = CrsGraph::local_graph_device_type;
    LocalGraph::row_map_type::non_const_type ownRows("rowPtr", numOwned() + 1);
    Kokkos::deep_copy(ownRows, Kokkos::subview(rowStart, std::make_pair(std::size_t{0}, numOwned() + 1)));
    const auto own = std::make_pair(std::size_t{0}, ownCount);
    const LocalGraph::entries_type::non_const_type ownColumns = Kokkos::subview(columns, own);
    const auto columnMap = ranks->alone() ? map : mapOf(ranks->nodes(), ranks->numColumns());
    const auto graph = rcp(new CrsGraph(map, columnMap, ownRows, ownColumns));
    graph->fillComplete(map, map);
    entries = View<double*>("entries", columns.size());
    const CrsMatrix::local_matrix_device_type::values_type ownEntries = Kokkos::subview(entries, own);
    K = rcp(new CrsMatrix(graph, ownEntries));
    K->fillComplete(map, map);

    for (auto& term : model.terms) {
      const int N = term->nodesPerEntity();
      const auto& nodes = term->nodes();
      std::vector<int> positions(static_cast<std::size_t>(term->numEntities()) * N * N);
      for (int e = 0; e < term->numEntities(); ++e)
        for (int a = 0; a < N; ++a)
          for (int b = 0; b < N; ++b)
            positions[(static_cast<std::size_t>(e) * N + a) * N + b] =
                ranks->positionInRow(nodes[e * N + a], nodes[e * N + b]);
      term->connect(dofs, positions);
    }
  }

  /// Of a field of the whole model what this rank has.
  DofView here(const std::vector<double>& whole) const {
    const std::vector<int>& nodes = ranks->nodes();
    return toDevice(ofNodes(whole, model.dofs, nodes, static_cast<int>(nodes.size())));
  }

  /// What is prescribed, of the whole model, and of it what this rank has.
  void uploadConditions(const std::vector<Coupling>& couplings) {
    const DofMap& dofs = model.dofs;
    std::vector<char> used(dofs.numNodes(), 0);
    for (const auto& term : model.terms)
      for (int n : term->nodes()) used[n] = 1;
    for (const Coupling& c : couplings) {
      used[dofs.nodeOf(c.dof)] = 1;
      for (const CoupledDof& m : c.masters) used[dofs.nodeOf(m.dof)] = 1;
    }
    const int numDofs = dofs.numDofs();
    std::vector<char> isUsed;
    for (int n = 0; n < dofs.numNodes(); ++n) isUsed.resize(isUsed.size() + dofs.numDofs(n), used[n]);
    for (int d = 0; d < numDofs; ++d)
      if (!isUsed[d] && (model.load[d] != 0 || model.constantLoad[d] != 0))
        throw std::invalid_argument("a force acts at node " + std::to_string(dofs.nodeOf(d) + 1) +
                                    ", which no element has");
    std::vector<char> flags(numDofs);
    std::vector<double> values(numDofs, 0.0), rates(numDofs, 0.0), free = model.initial;
    for (int d = 0; d < numDofs; ++d) {
      flags[d] = model.supports.fixed(d) || !isUsed[d];
      numFree += !flags[d];
      if (flags[d]) free[d] = 0;
      values[d] = model.supports.value(d);
      rates[d] = model.supports.perLoadFactor(d);
    }
    for (const Coupling& c : couplings) {
      --numFree;
      free[c.dof] = 0;
      values[c.dof] = c.value;
      rates[c.dof] = c.perLoadFactor;
      for (const CoupledDof& m : c.masters) {
        values[c.dof] += m.factor * values[m.dof];
        rates[c.dof] += m.factor * rates[m.dof];
      }
    }
    const std::vector<int>& nodes = ranks->nodes();
    fixed = upload("fixed", ofNodes(flags, dofs, nodes, static_cast<int>(nodes.size())));
    initial = here(free);
    value = here(values);
    rate = here(rates);
    // Dead loads act at their owners'.
    const auto loads = [&](const std::vector<double>& whole) {
      auto part = ofNodes(whole, dofs, nodes, ranks->numOwned());
      part.resize(numLocal(), 0.0);
      return toDevice(part);
    };
    load = loads(model.load);
    constantLoad = loads(model.constantLoad);
    for (const int d : ranks->dofs().dofsWith(Role::parameter))
      if (d < static_cast<int>(numOwned())) parameters.push_back(d);
  }

  /// Forces at load factor 1: dead loads, and as their rates at the start those that the driven supports
  /// alone would need and those of terms that see lambda. What they are at load factor 1 itself says nothing:
  /// supports may have crushed the body there, or a tool moved through it.
  void findScale() {
    Sizes size = largest(norms(load), norms(constantLoad));
    if (model.supports.driven() || model.couplings.driven()) {
      const Sizes driving = drivingForces();
      // Ten times: a body that they move as a whole has no forces, but the rounding of those that it would
      // have.
      for (std::size_t b = 0; b < size.size(); ++b)
        if (std::isfinite(driving[b])) size[b] = std::max(size[b], 10 * driving[b]);
    }
    const bool loaded = *std::min_element(size.begin(), size.end()) > 0;
    Kokkos::deep_copy(sum, 0.0);
    const DofView start("start", value.extent(0));
    setStart(0, start);
    const TangentSink sink{rowStart, entries, sum};
    ranks->together([&] {
      for (const auto& term : model.terms)
        if (term->seesLoadFactor()) term->addTangent(start, 0, sink);
    });
    ranks->collect(sum);
    const Sizes driving = norms(sum);
    scaleFloor.assign(size.size(), 0.0);
    initialForces.resize(size.size(), 0.0);
    for (std::size_t b = 0; b < size.size(); ++b) {
      if (std::isfinite(driving[b])) size[b] = std::max(size[b], driving[b]);
      scaleFloor[b] = std::max(1e-6 * size[b], 1e-300);
    }
    if (loaded) return;
    // Tools that come from afar and may go again: without them there are no forces but those of rounding,
    // below which laws that fall off are as good as zero.
    const Sizes rounding = forcesOfRounding();
    for (std::size_t b = 0; b < size.size(); ++b)
      if (std::isfinite(rounding[b]) && (numBalances() == 1 ? size[b] < rounding[b] : size[b] == 0))
        scaleFloor[b] = std::max(scaleFloor[b], rounding[b]);
  }

  /// The unknowns before any load acts, the first out.size() of this rank's.
  void setStart(double lambda, const DofView& out) const {
    const DofView first = initial, held = value, per = rate;
    Kokkos::parallel_for(
        "start", Kokkos::RangePolicy<Execution>(0, out.size()),
        KOKKOS_LAMBDA(int d) { out(d) = first(d) + held(d) + lambda * per(d); });
  }

  /// Sizes of the forces of terms that do not see lambda where places are off by their rounding, from node to
  /// node to and fro; zero where it is not known.
  Sizes forcesOfRounding() {
    constexpr double part = 1e-5;  // of gaps that count as none
    double off = 0;
    if (!events->empty())
      off = part * events->touching(DofView("rest", rate.extent(0)));
    else if (numBalances() == 1)  // the unknowns are places
      off = 1e-16 * model.size;
    if (off == 0) return Sizes(numBalances(), 0.0);
    std::vector<double> whole(model.dofs.numDofs());
    for (std::size_t d = 0; d < whole.size(); ++d) whole[d] = d % 2 == 0 ? off : -off;
    return forcesAt(here(whole), 0);
  }

  /// By load factor, what driven supports alone would need; zero where laws have no value next to the start.
  Sizes drivingForces() {
    // Far above rounding, and what is not linear counts a thousandth; less where so much of it crushes a
    // cell.
    for (const double part : {1e-3, 1e-6, 1e-9}) try {
        Sizes driving = forcesAt(part);
        const Sizes start = forcesAt(0);
        for (std::size_t b = 0; b < driving.size(); ++b) driving[b] = (driving[b] - start[b]) / part;
        return driving;
      } catch (const std::runtime_error& error) {
        if (linear::isNoMemory(error)) throw;
      }
    return Sizes(numBalances(), 0.0);
  }

  /// Sizes of the forces of terms that do not see lambda, where supports alone leave the initial values, by
  /// their rate.
  Sizes forcesAt(double lambda) {
    const DofView u = here(model.initial), per = rate;
    Kokkos::parallel_for(
        "supports", Kokkos::RangePolicy<Execution>(0, u.size()),
        KOKKOS_LAMBDA(int d) { u(d) += lambda * per(d); });
    return forcesAt(u, lambda);
  }
  Sizes forcesAt(const ConstDofView& u, double lambda) {
    Sizes own(numBalances(), 0.0);
    ranks->together([&] {
      for (const auto& term : model.terms)
        if (!term->seesLoadFactor()) add(own, term->addResidual(u, lambda, sum));
    });
    return overRanks(std::move(own));
  }

  static void add(Sizes& sums, const OwnForces& own) {
    for (std::size_t b = 0; b < own.size(); ++b) sums[b] += own[b];
  }

  /// sum = this rank's part of the terms - F_0 - lambda F_1 on all rows; returns the scales.
  Sizes imbalance(const ConstDofView& u, double lambda) {
    const DofView total = sum, F1 = load, F0 = constantLoad;
    Kokkos::parallel_for(
        "loads", Kokkos::RangePolicy<Execution>(0, total.size()),
        KOKKOS_LAMBDA(int i) { total(i) = -F0(i) - lambda * F1(i); });
    const Sizes external = norms(total);
    Sizes own(numBalances(), 0.0);
    ranks->together([&] {
      for (const auto& term : model.terms) add(own, term->addResidual(u, lambda, total));
    });
    return largest(largest(largest(scaleFloor, initialForces), external), overRanks(std::move(own)));
  }

  /// What a path starts from.
  void findStart() {
    startConditions = conditions();
    ranks->together([&] {
      for (const auto& term : model.terms) {
        const auto own = term->startVariables();
        numVariables.push_back(own.size());
        startVariables.insert(startVariables.end(), own.begin(), own.end());
      }
    });
    anyVariables = ranks->max(static_cast<double>(startVariables.size())) > 0;
    if (anyVariables) variablesAt = DofView("state of the variables", numLocal());
  }

  std::vector<int> conditions() const {
    std::vector<int> all = events->conditions();
    const auto preferred = pieces->conditions();
    all.insert(all.end(), preferred.begin(), preferred.end());
    return all;
  }
  void checkNumber(const std::vector<int>& conditions) const {
    if (conditions.size() != startConditions.size())
      throw std::invalid_argument("conditions of " + std::to_string(conditions.size()) +
                                  " contact points, but there are " + std::to_string(startConditions.size()));
  }
  void setConditions(const std::vector<int>& conditions) {
    checkNumber(conditions);
    const auto pieceBegin = conditions.begin() + events->count();
    events->setConditions({conditions.begin(), pieceBegin});
    if (!pieces->empty()) pieces->setConditions({pieceBegin, conditions.end()});
  }
  const std::vector<int>& conditionsOf(const path::Memory* memory) const {
    return memory != nullptr && !memory->conditions.empty() ? memory->conditions : startConditions;
  }

  /// The terms become those of a state.
  void remember(const path::State& state) {
    if (state.memory && state.memory == remembered) return;
    if (!startConditions.empty()) setConditions(conditionsOf(state.memory.get()));
    if (anyVariables) rememberVariables(state);
    remembered = state.memory;
  }
  void rememberVariables(const path::State& state) {
    const path::Memory* memory = state.memory.get();
    const bool own = memory != nullptr && !memory->u.is_null();
    const std::vector<double>& variables = own ? memory->variables : startVariables;
    if (variables.size() != startVariables.size())
      throw std::invalid_argument("a state with " + std::to_string(variables.size()) +
                                  " internal variables, but there are " +
                                  std::to_string(startVariables.size()));
    const ConstDofView there = local(own ? *memory->u : *state.u, variablesAt);
    const double* next = variables.data();
    ranks->together([&] {
      for (std::size_t t = 0; t < model.terms.size(); next += numVariables[t++])
        if (numVariables[t] > 0) model.terms[t]->remember(next, there, own ? memory->lambda : state.lambda);
    });
  }

  double ofParameters(const Vector& x, const Vector& y) const {
    if (numParameters == 0) return 0;
    const auto a = x.getLocalViewHost(Tpetra::Access::ReadOnly),
               b = y.getLocalViewHost(Tpetra::Access::ReadOnly);
    double sum = 0;
    for (const int d : parameters) sum += a(d, 0) * b(d, 0);
    return ranks->sum(sum);
  }

  double ofInternal(const path::Increment& x, const path::Increment& y) const {
    if (!hasInternal) return 0;
    double sum = 0;
    for (std::size_t i = 0; i < std::min(x.internal.size(), y.internal.size()); ++i)
      sum += x.internal[i] * y.internal[i];
    return ranks->sum(sum);
  }

  /// The smallest diagonal entry of the tangent among the free dofs of a node of the rank; 0 where there is
  /// none.
  std::vector<double> nodalStiffness() const {
    const auto onHost = [](const auto& view) {
      return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
    };
    const auto values = onHost(K->getLocalMatrixDevice().values);
    const auto start = onHost(rowStart);
    const auto column = onHost(columns);
    const auto isFixed = onHost(fixed);
    const DofMap& dofs = ranks->dofs();
    std::vector<double> least(numLocal(), 0.0);  // first unknown of each node
    for (int l = 0; l < ranks->numOwned(); ++l)
      for (int d = dofs.firstDof(l); d < dofs.firstDof(l + 1); ++d)
        for (std::size_t e = start(d); e < start(d + 1); ++e)
          if (column(e) == d && !isFixed(d) && values(e) > 0) {
            double& of = least[dofs.firstDof(l)];
            of = of > 0 ? std::min(of, values(e)) : values(e);
          }
    const DofView all = toDevice(least);
    ranks->fetch(all);
    least = toHost(all);
    std::vector<double> stiffness(ranks->numLocal(), 0.0);
    for (int l = 0; l < ranks->numLocal(); ++l)
      if (dofs.numDofs(l) > 0) stiffness[l] = least[dofs.firstDof(l)];
    return stiffness;
  }

  /// The free dofs' largest diagonal entry in each field, or in its balance where the field has none, from
  /// the ranks' parts of the matrix: a support whose row had another size (that of a stiffness for a
  /// temperature, or of a director for a displacement, which is 1e4 times that in a thin shell) would have a
  /// residual of rounding beyond all that acts there.
  void findDiagonal() {
    const auto values = entries;
    const auto start = rowStart;
    const auto column = columns;
    const DofView own = sum;
    Kokkos::parallel_for(
        "diagonal", Kokkos::RangePolicy<Execution>(0, own.size()), KOKKOS_LAMBDA(int d) {
          own(d) = 0;
          for (std::size_t e = start(d); e < start(d + 1); ++e)
            if (column(e) == d) own(d) = values(e);
        });
    ranks->collect(own);
    const auto isFixed = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), fixed);
    const std::vector<double> diagonal = toHost(own);
    const DofMap& dofs = ranks->dofs();
    const auto fieldOf = [&](std::size_t d) { return dofs.addressOf(static_cast<int>(d)).field; };
    Sizes inField(dofs.fields().size(), 0.0), inBalance(numBalances(), 0.0);
    for (std::size_t d = 0; d < numOwned(); ++d)
      if (!isFixed(d)) inField[fieldOf(d)] = std::max(inField[fieldOf(d)], std::abs(diagonal[d]));
    for (std::size_t f = 0; f < inField.size(); ++f) {
      inField[f] = ranks->max(inField[f]);
      double& largest = inBalance[dofs.balanceOf(static_cast<int>(f))];
      largest = std::max(largest, inField[f]);
    }
    const auto size = [](double x) { return x > 0 && std::isfinite(x); };
    std::vector<double> s(numLocal());
    for (std::size_t d = 0; d < s.size(); ++d) {
      const int f = fieldOf(d);
      const double whole = inBalance[dofs.balanceOf(f)];
      s[d] = size(inField[f]) ? inField[f] : size(whole) ? whole : 1;
    }
    prescribed = toDevice(s);
    hasPrescribed = true;
    // Where all forces vanish at first, what remains is the rounding of those that initial values have from
    // node to node.
    const DofView first = initial;
    Kokkos::parallel_for(
        "initial forces", Kokkos::RangePolicy<Execution>(0, own.size()),
        KOKKOS_LAMBDA(int d) { own(d) *= first(d); });
    initialForces = norms(own);
    for (double& size : initialForces) size = std::isfinite(size) ? 1e-6 * size : 0;
  }

  void findPrescribedRows() {
    const auto isFixed = Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), fixed);
    prescribedRow.resize(numOwned());
    for (std::size_t d = 0; d < prescribedRow.size(); ++d) prescribedRow[d] = isFixed(d);
    for (const Coupling& c : coupled.couplings())
      if (static_cast<std::size_t>(c.dof) < prescribedRow.size()) prescribedRow[c.dof] = 1;
  }

  /// [balance] the mean of |diagonal entry| in rows that are not prescribed.
  Sizes meanDiagonals(const CrsMatrix& matrix) const {
    Vector diagonal(map);
    matrix.getLocalDiagCopy(diagonal);
    const std::vector<double> entry = toHost(writable(diagonal));
    Sizes sum(numBalances(), 0.0), count(numBalances(), 0.0);
    for (std::size_t d = 0; d < entry.size(); ++d) {
      if (prescribedRow[d]) continue;
      sum[balances[d]] += std::abs(entry[d]);
      ++count[balances[d]];
    }
    for (std::size_t b = 0; b < sum.size(); ++b) {
      const double rows = ranks->sum(count[b]);
      sum[b] = rows > 0 ? ranks->sum(sum[b]) / rows : 0;
    }
    return sum;
  }

  /// Balances that store something are one group, every other is one of its own.
  void findUnitGroups(const Sizes& capacities) {
    std::optional<std::size_t> first;
    for (std::size_t b = 0; b < numBalances(); ++b) {
      const bool stores = b < capacities.size() && capacities[b] > 0;
      if (stores && !first) first = b;
      unitGroups.push_back(stores ? *first : b);
    }
  }

  /// Of the last tangent; null where one group only has entries on its diagonal (the rows of div v have
  /// none).
  RCP<const Vector> unitWeights() const {
    const Sizes means = meanDiagonals(*K);
    Sizes sum(numBalances(), 0.0), members(numBalances(), 0.0);
    for (std::size_t b = 0; b < means.size(); ++b) {
      if (!(means[b] > 0 && std::isfinite(means[b]))) continue;
      sum[unitGroups[b]] += means[b];
      ++members[unitGroups[b]];
    }
    const auto hasSize = [](double s) { return s > 0; };
    if (std::count_if(sum.begin(), sum.end(), hasSize) < 2) return Teuchos::null;
    const std::size_t first = std::find_if(sum.begin(), sum.end(), hasSize) - sum.begin();
    const std::vector<double> s = toHost(prescribed);
    const auto weights = rcp(new Vector(map));
    const auto to = weights->getDataNonConst();
    for (std::size_t d = 0; d < numOwned(); ++d) {
      const std::size_t own = unitGroups[balances[d]], group = sum[own] > 0 ? own : first;
      to[d] = prescribedRow[d] ? s[d] : sum[group] / members[group];
    }
    return weights;
  }

  /// Nothing in the rows and columns of prescribed dofs.
  void clearSupports(const View<double*>& values) const {
    const auto start = rowStart;
    const auto column = columns;
    const auto isFixed = fixed;
    Kokkos::parallel_for(
        "no supports", Kokkos::RangePolicy<Execution>(0, numOwned()), KOKKOS_LAMBDA(int d) {
          for (std::size_t e = start(d); e < start(d + 1); ++e)
            if (isFixed(d) || isFixed(column(e))) values(e) = 0;
        });
  }

  /// Turns the rows of prescribed dofs into s u_d and carries their columns to F.
  void applySupports(const DofView& F) {
    const auto values = K->getLocalMatrixDevice().values;
    const auto start = rowStart;
    const auto column = columns;
    const auto isFixed = fixed;
    const auto rates = rate;
    const int numDofs = static_cast<int>(F.size());
    const DofView s = prescribed;
    Kokkos::parallel_for(
        "supports", Kokkos::RangePolicy<Execution>(0, numDofs), KOKKOS_LAMBDA(int d) {
          if (isFixed(d)) {
            for (std::size_t e = start(d); e < start(d + 1); ++e) values(e) = column(e) == d ? s(d) : 0.0;
            F(d) = s(d) * rates(d);
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
  try {
    evaluateStart();
  } catch (const std::runtime_error& error) {  // what a law tells, of another rank too
    if (linear::isNoMemory(error)) throw;
    throw std::invalid_argument(std::string("the start cannot be evaluated: ") + error.what());
  }
}

void FeProblem::evaluateStart() {
  impl_->findScale();
  auto& events = *impl_->events;
  impl_->pieces.emplace(
      impl_->model.terms, events, *impl_->ranks, [this](const path::State& s) { return onRank(s); },
      [this](const path::State& s, Vector& r) { return residual(s, r); });
  impl_->findStart();
  Vector F(impl_->map);
  tangent({initialState(0.0), 0.0}, F);  // gives the prescribed rows their size
  impl_->hasInternal = impl_->ranks->max(internalCount()) > 0;
  if (events.empty()) return;
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

void FeProblem::beginAt(const path::State& start) {
  impl_->initialForces.assign(impl_->scaleFloor.size(), 0.0);  // those at another state
  Sizes sizes = impl_->imbalance(onRank(start), start.lambda);
  if (start.memory && !start.memory->variables.empty()) {
    auto conditions = std::make_shared<path::Memory>();
    conditions->conditions = start.memory->conditions;
    sizes = largest(sizes, impl_->imbalance(onRank({start.u, start.lambda, conditions}), start.lambda));
  }
  for (double& size : sizes) size = std::isfinite(size) ? 1e-3 * size : 0;
  impl_->scaleFloor = largest(impl_->scaleFloor, sizes);
}

path::ResidualNorm FeProblem::residual(const path::State& at, Vector& r) {
  const ConstDofView state = onRank(at);
  const double lambda = at.lambda;
  const Sizes scales = impl_->imbalance(state, lambda);
  const DofView out = writable(r), total = impl_->sum, value = impl_->value, rate = impl_->rate;
  const auto fixed = impl_->fixed;
  const DofView s = impl_->prescribed;
  impl_->coupled.gatherForces(total);
  impl_->coupled.addGaps(state, lambda, s, total);
  impl_->ranks->collect(total);
  Kokkos::parallel_for(
      "residual", Kokkos::RangePolicy<Execution>(0, out.size()), KOKKOS_LAMBDA(int d) {
        if (fixed(d)) total(d) = s(d) * (state(d) - value(d) - lambda * rate(d));  // not the reaction
        out(d) = total(d);
      });
  // The balance that is furthest off counts.
  const Sizes norms = impl_->norms(total);
  path::ResidualNorm worst{norms[0], scales[0]};
  for (std::size_t b = 1; b < norms.size(); ++b)
    if (path::ResidualNorm other{norms[b], scales[b]}; !(other.relative() <= worst.relative())) worst = other;
  return worst;
}

double FeProblem::scaleAlong(const Vector& v, const path::State& state) {
  const Sizes scales = impl_->imbalance(onRank(state), state.lambda);
  if (scales.size() == 1) return scales[0];  // |v| = 1
  const Sizes parts = impl_->norms(field(v));
  return std::inner_product(scales.begin(), scales.end(), parts.begin(), 0.0);
}

RCP<const CrsMatrix> FeProblem::tangent(const path::State& at, Vector& F) {
  const auto& ranks = *impl_->ranks;
  impl_->K->resumeFill();
  const auto values = impl_->K->getLocalMatrixDevice().values;
  const auto entries = impl_->entries;
  if (values.data() != entries.data()) throw std::logic_error("FeProblem: Tpetra has moved the matrix");
  const DofView direction = ranks.alone() ? writable(F) : DofView("direction", impl_->load.size());
  Kokkos::deep_copy(entries, 0.0);
  Kokkos::deep_copy(direction, impl_->load);
  const ConstDofView state = onRank(at);
  impl_->pivots = impl_->numMultipliers + impl_->events->constraintPivots() + impl_->numParameters;
  ranks.together([&] {
    for (const auto& term : impl_->model.terms)
      term->addTangent(state, at.lambda, TangentSink{impl_->rowStart, entries, direction});
  });
  // Once: were it that of the last tangent, the rounding of prescribed rows would tell what came before.
  if (!impl_->hasPrescribed) impl_->findDiagonal();
  ranks.together([&] {
    impl_->coupled.transform(impl_->rowStart, impl_->columns, entries, impl_->prescribed, direction);
  });
  const DofView own = writable(F);
  if (!ranks.alone()) {
    ranks.collectRows(impl_->rowStart, entries);
    ranks.collect(direction);
    impl_->copyOwned(direction, own);
  }
  impl_->applySupports(own);
  impl_->K->fillComplete(impl_->map, impl_->map);
  return impl_->K;
}

RCP<const CrsMatrix> FeProblem::mass(const path::State& at) {
  const auto& ranks = *impl_->ranks;
  if (impl_->M.is_null()) impl_->M = rcp(new CrsMatrix(impl_->K->getCrsGraph()));
  impl_->M->resumeFill();
  const auto values = impl_->M->getLocalMatrixDevice().values;
  const View<double*> entries =
      ranks.alone() ? View<double*>(values) : View<double*>("capacities", impl_->columns.size());
  Kokkos::deep_copy(entries, 0.0);
  const DofView none("none", impl_->load.size()), noSize("no size", impl_->load.size());
  const ConstDofView state = onRank(at);
  bool stores = false;
  ranks.together([&] {
    for (const auto& term : impl_->model.terms)
      stores = term->addCapacity(state, at.lambda, TangentSink{impl_->rowStart, entries, none}) || stores;
    impl_->coupled.transform(impl_->rowStart, impl_->columns, entries, noSize, none);
  });
  if (!ranks.alone()) {
    ranks.collectRows(impl_->rowStart, entries);
    Kokkos::deep_copy(values, Kokkos::subview(entries, std::make_pair(std::size_t{0}, values.extent(0))));
  }
  impl_->clearSupports(values);
  impl_->M->fillComplete(impl_->map, impl_->map);
  return stores ? impl_->M : Teuchos::null;
}

RCP<const Vector> FeProblem::eigenvalueWeights(const path::State& at) {
  if (impl_->numBalances() < 2) return Teuchos::null;
  if (impl_->unitGroups.empty()) {
    const bool kept = !impl_->M.is_null();
    const auto M = mass(at);
    impl_->findUnitGroups(M.is_null() ? Sizes{} : impl_->meanDiagonals(*M));
    if (!kept) impl_->M = Teuchos::null;
  }
  return impl_->unitWeights();
}

void FeProblem::beginSeries(const path::State& at, int maxOrder) {
  const ConstDofView state = onRank(at);
  impl_->events->renew(state, at.lambda);
  impl_->ranks->together([&] {
    for (const auto& term : impl_->model.terms) term->beginSeries(state, at.lambda, maxOrder);
  });
}

void FeProblem::orderRhs(int k, Vector& Fk) {
  const DofView total = impl_->sum, out = writable(Fk);
  const auto fixed = impl_->fixed;
  Kokkos::deep_copy(total, 0.0);
  impl_->ranks->together([&] {
    for (const auto& term : impl_->model.terms) term->addOrder(k, impl_->last, impl_->lastLambda, total);
  });
  impl_->coupled.gatherForces(total);
  impl_->ranks->collect(total);
  Kokkos::parallel_for(
      "orderRhs", Kokkos::RangePolicy<Execution>(0, out.size()),
      KOKKOS_LAMBDA(int d) { out(d) = fixed(d) ? 0.0 : -total(d); });
}

void FeProblem::completeOrder(int, const Vector& Uk, double lambdaK) {
  impl_->copyOwned(field(Uk), impl_->last);
  impl_->ranks->fetch(impl_->last);
  impl_->lastLambda = lambdaK;
}

int FeProblem::internalCount() const {
  int count = 0;
  for (const auto& term : impl_->model.terms) count += term->internalCount();
  return count;
}

void FeProblem::internalOrder(int k, const Vector& v, double mu, std::vector<double>& y) const {
  const ConstDofView state = impl_->local(v);
  impl_->ranks->together([&] {
    double* own = y.data();
    for (const auto& term : impl_->model.terms) {
      term->internalOrder(k, state, mu, own);
      own += term->internalCount();
    }
  });
}

double FeProblem::inner(const path::Increment& x, const path::Increment& y) const {
  const double internal = impl_->internalInner * impl_->ofInternal(x, y);
  const auto& factors = impl_->fieldFactors;
  if (factors.empty())
    return Problem::inner(x, y) + (impl_->parameterInner - 1) * impl_->ofParameters(*x.u, *y.u) + internal;
  const Sizes products = impl_->products(field(*x.u), field(*y.u));
  double sum = 0;
  for (std::size_t b = 0; b < products.size(); ++b) sum += factors[b] * impl_->ranks->sum(products[b]);
  return sum + (impl_->parameterInner - factors[0]) * impl_->ofParameters(*x.u, *y.u) + internal;
}

std::vector<double> FeProblem::fieldChanges(const path::State& from, const path::State& to) {
  if (impl_->numBalances() < 2) return {};
  // Of the forces: a mesh leaves less of a field at rest, and rounding much less.
  constexpr double counts = 1e-3;
  Vector change(*to.u, Teuchos::Copy);
  change.update(-1, *from.u, 1);
  Sizes norms = impl_->norms(field(change));
  const Sizes scales = impl_->imbalance(onRank(to), to.lambda), at = impl_->norms(field(*to.u)),
              stiffness = impl_->meanDiagonals(*impl_->K);
  for (std::size_t b = 0; b < norms.size(); ++b) {
    // A pressure has no stiffness of its own.
    const bool moved =
        stiffness[b] > 0 ? stiffness[b] * norms[b] > counts * scales[b] : norms[b] > counts * at[b];
    if (!moved) norms[b] = 0;
  }
  return norms;
}

void FeProblem::weighFields(const std::vector<double>& factors) {
  if (!factors.empty() && factors.size() != impl_->numBalances())
    throw std::invalid_argument(std::to_string(factors.size()) + " factors of fields, but there are " +
                                std::to_string(impl_->numBalances()) + " balances");
  impl_->fieldFactors = factors;
}

double FeProblem::weight(const path::Increment& Xhat, std::optional<double> given) {
  const double displacements = Problem::inner(Xhat, Xhat) - impl_->ofParameters(*Xhat.u, *Xhat.u);
  const double w = given ? *given : 1 / displacements;
  impl_->parameterInner = impl_->model.parameterWeight / w;
  impl_->internalInner = impl_->model.internalWeight / w;
  return w;
}

bool FeProblem::isNegligible(const Vector& change) const {
  constexpr double negligible = 1e-6;
  return impl_->model.size > 0 && impl_->numBalances() < 2 &&
         change.normInf() <= negligible * impl_->model.size;
}

int FeProblem::firstEvent(int term) const { return impl_->events->first(term); }

int FeProblem::eventCount() const { return impl_->events->count(); }

void FeProblem::eventOrder(int k, std::vector<double>& g) const {
  g = impl_->events->order(k, impl_->last, impl_->lastLambda);
}

std::vector<int> FeProblem::growingAt(const path::State& state) const {
  return impl_->events->growing(impl_->conditionsOf(state.memory.get()));
}

double FeProblem::negligibleFall(int event) const { return impl_->events->negligibleFall(event); }

bool FeProblem::eventMayBeNone(int event) const { return impl_->events->mayBeNone(event); }

std::vector<int> FeProblem::eventsBeside(const std::vector<int>& indices, const path::State& state) {
  if (!impl_->events->changeTogether()) return {};
  return impl_->events->beside(indices, onRank(state), state.lambda);
}

bool FeProblem::eventGradient(int index, const path::State& state, double& value, Vector& byU,
                              double& byLambda) {
  const ConstDofView u = onRank(state);
  Kokkos::deep_copy(impl_->sum, 0.0);
  const auto own = impl_->events->gradient(index, u, state.lambda, impl_->sum);
  if (!own) return false;
  impl_->ranks->collect(impl_->sum);
  impl_->copyOwned(impl_->sum, writable(byU));
  value = own->value;
  byLambda = own->byLambda;
  return true;
}

std::vector<int> FeProblem::eventsAt(const path::State& state) {
  return impl_->events->at(onRank(state), state.lambda);
}

path::State FeProblem::afterEvent(const std::vector<int>& indices, const path::State& state) {
  const ConstDofView u = onRank(state);
  const auto before = impl_->conditions();
  auto memory =
      state.memory ? std::make_shared<path::Memory>(*state.memory) : std::make_shared<path::Memory>();
  try {
    impl_->events->apply(indices);
    impl_->pieces->apply(indices, u, state.lambda);
  } catch (...) {
    impl_->setConditions(before);
    throw;
  }
  memory->conditions = impl_->conditions();
  impl_->setConditions(before);
  return {state.u, state.lambda, memory};
}

path::Pieces* FeProblem::pieces() { return impl_->pieces->empty() ? nullptr : &*impl_->pieces; }

int FeProblem::constraintPivots() const { return impl_->pivots; }

std::string FeProblem::name(long long unknown) const {
  if (impl_->model.dofName) return impl_->model.dofName(static_cast<int>(unknown));
  return impl_->model.dofs.nameOf(static_cast<int>(unknown));
}

std::vector<int> FeProblem::conditionsAt(const path::State& state) const {
  return impl_->conditionsOf(state.memory.get());
}

std::shared_ptr<const path::Memory> FeProblem::memoryOf(std::vector<int> conditions) const {
  impl_->checkNumber(conditions);
  auto memory = std::make_shared<path::Memory>();
  memory->conditions = std::move(conditions);
  return memory;
}

bool FeProblem::remembers() const { return impl_->anyVariables; }

std::vector<std::vector<double>> FeProblem::memoryOrders() {
  if (!remembers()) return {};
  std::vector<std::vector<double>> all;
  impl_->ranks->together([&] {
    for (const auto& term : impl_->model.terms) {
      const auto own = term->variableOrders(impl_->last, impl_->lastLambda);
      all.resize(std::max(all.size(), own.size()));
      for (std::size_t k = 0; k < own.size(); ++k) all[k].insert(all[k].end(), own[k].begin(), own[k].end());
    }
  });
  return all;
}

path::State FeProblem::settled(const path::State& state) {
  if (!remembers() && !impl_->events->renews()) return state;
  const ConstDofView u = onRank(state);
  auto memory = std::make_shared<path::Memory>();
  impl_->events->renew(u, state.lambda);
  memory->conditions = impl_->conditions();
  impl_->remembered = nullptr;  // the terms may be those of another memory than `state` has
  if (!remembers()) return {state.u, state.lambda, memory};
  memory->u = rcp(new Vector(*state.u, Teuchos::Copy));
  memory->lambda = state.lambda;
  impl_->ranks->together([&] {
    for (const auto& term : impl_->model.terms) {
      const auto own = term->variablesAt(u, state.lambda);
      memory->variables.insert(memory->variables.end(), own.begin(), own.end());
    }
  });
  return {state.u, state.lambda, memory};
}

RCP<Vector> FeProblem::initialState(double lambda) const {
  auto u = rcp(new Vector(impl_->map));
  impl_->setStart(lambda, writable(*u));
  return u;
}

std::vector<double> FeProblem::reactions(const path::State& state) const {
  impl_->imbalance(onRank(state), state.lambda);
  impl_->coupled.gatherForces(impl_->sum);
  impl_->ranks->collect(impl_->sum);
  std::vector<double> r = impl_->onAllRanks(impl_->sum);
  for (std::size_t d = 0; d < r.size(); ++d)
    if (!impl_->model.supports.fixedOrReleased(static_cast<int>(d))) r[d] = 0;
  return r;
}

std::vector<double> FeProblem::slaveForces(const path::State& state) const {
  impl_->imbalance(onRank(state), state.lambda);
  impl_->ranks->collect(impl_->sum);
  const std::vector<double> all = impl_->onAllRanks(impl_->sum);
  std::vector<double> r(all.size(), 0.0);
  for (const Coupling& c : impl_->model.couplings.all()) r[c.dof] = all[c.dof];
  return r;
}

std::vector<double> FeProblem::forces(const Term& term, const path::State& state) const {
  Kokkos::deep_copy(impl_->sum, 0.0);
  const ConstDofView u = onRank(state);
  impl_->ranks->together([&] { term.addResidual(u, state.lambda, impl_->sum); });
  impl_->ranks->collect(impl_->sum);
  return impl_->onAllRanks(impl_->sum);
}

PointValues FeProblem::observe(int i, const path::State& state) const {
  const Term& term = *impl_->model.terms.at(i);
  const ConstDofView u = onRank(state);
  PointValues own;
  impl_->ranks->together([&] { own = term.observe(u, state.lambda); });
  if (impl_->ranks->alone()) return own;
  // Ranks without a part of the term learn how many numbers an entity has.
  const auto& entities = impl_->ranks->entities()[i];
  const auto each = static_cast<std::size_t>(
      impl_->ranks->max(entities.empty() ? 0.0 : static_cast<double>(own.values.size() / entities.size())));
  std::vector<double> all(impl_->wholeCounts[i] * each, 0.0);
  for (std::size_t e = 0; e < entities.size(); ++e)
    std::copy_n(&own.values[e * each], each, &all[entities[e] * each]);
  impl_->ranks->sum(all);
  own.values = std::move(all);
  return own;
}

ConstDofView FeProblem::onRank(const path::State& state) const {
  impl_->remember(state);
  return impl_->local(*state.u);
}

std::vector<double> FeProblem::values(const Vector& u) { return linear::onAllRanks(u); }

const FeModel& FeProblem::model() const { return impl_->model; }
const Term& FeProblem::term(int i) const { return *impl_->model.terms.at(i); }
const std::vector<int>& FeProblem::ranksOf(int i) const { return impl_->ranks->ranksOf(i); }

int FeProblem::numTerms() const { return static_cast<int>(impl_->model.terms.size()); }
int FeProblem::numFreeDofs() const { return impl_->numFree; }

std::size_t FeProblem::historyBytes(int maxOrder) const {
  std::size_t bytes = 0;
  for (const auto& term : impl_->model.terms) bytes += term->historyBytes(maxOrder);
  return static_cast<std::size_t>(impl_->ranks->sum(static_cast<double>(bytes)));
}

}  // namespace atrapos::fem
