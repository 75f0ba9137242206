#include "Distribution.hpp"

#include <Teuchos_ArrayRCP.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <algorithm>
#include <exception>
#include <numeric>
#include <stdexcept>

#include "NodeGraph.hpp"

namespace atrapos::fem::detail {
namespace {

/// Sends and receives one message a neighbour; the receivers know the lengths.
template <class T>
void exchange(const Comm& comm, const std::vector<int>& ranks, const std::vector<std::vector<T>>& send,
              std::vector<std::vector<T>>& receive) {
  constexpr int tag = 7001;
  std::vector<linear::RCP<Teuchos::CommRequest<int>>> requests;
  for (std::size_t i = 0; i < ranks.size(); ++i)
    if (!receive[i].empty())
      requests.push_back(Teuchos::ireceive(
          Teuchos::arcp(receive[i].data(), 0, static_cast<Teuchos::Ordinal>(receive[i].size()), false),
          ranks[i], tag, comm));
  for (std::size_t i = 0; i < ranks.size(); ++i)
    if (!send[i].empty())
      requests.push_back(
          Teuchos::isend(Teuchos::ArrayRCP<const T>(Teuchos::arcp(
                             send[i].data(), 0, static_cast<Teuchos::Ordinal>(send[i].size()), false)),
                         ranks[i], tag, comm));
  Teuchos::waitAll(comm, Teuchos::arrayViewFromVector(requests));
}

/// Adds the rank where it is not yet.
void note(std::vector<int>& ranks, int rank) {
  if (std::find(ranks.begin(), ranks.end(), rank) == ranks.end()) ranks.push_back(rank);
}

}  // namespace

Distribution::Distribution(const FeModel& model, const std::vector<Coupling>& couplings,
                           linear::RCP<const Comm> comm)
    : comm_(std::move(comm)) {
  if (alone()) {
    for (const auto& term : model.terms) ranksOf_.emplace_back(term->numEntities(), 0);
    numOwned_ = numLocal_ = model.dofs.numNodes();
    dofs_ = model.dofs;
    nodes_.resize(numOwned_);
    std::iota(nodes_.begin(), nodes_.end(), 0);
    localOf_ = nodes_;
    couplings_ = couplings;
    rows_ = nodeGraph(model, couplings, std::vector<Rows>(numOwned_, Rows::all), {});
    return;
  }
  Partition p;
  together([&] { p = partition(model, couplings, comm_->getSize()); });
  cutRows(model, couplings, p);
  ranksOf_ = std::move(p.entities);
}

void Distribution::cutRows(const FeModel& model, const std::vector<Coupling>& couplings, const Partition& p) {
  const int numNodes = model.dofs.numNodes();
  std::vector<std::vector<int>> ranksAt(numNodes);
  Share share;
  share.ofTerm.resize(model.terms.size());
  entities_.resize(model.terms.size());
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const Term& term = *model.terms[t];
    const int N = term.nodesPerEntity();
    share.ofTerm[t].assign(term.numEntities(), 0);
    for (int e = 0; e < term.numEntities(); ++e) {
      for (int n = 0; n < N; ++n)
        note(ranksAt[term.nodes()[static_cast<std::size_t>(e) * N + n]], p.entities[t][e]);
      if (p.entities[t][e] != rank()) continue;
      entities_[t].push_back(e);
      share.ofTerm[t][e] = 1;
    }
  }
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    note(ranksAt[model.dofs.nodeOf(couplings[c].dof)], p.couplings[c]);
    for (const CoupledDof& m : couplings[c].masters) note(ranksAt[model.dofs.nodeOf(m.dof)], p.couplings[c]);
    share.ofCouplings.push_back(p.couplings[c] == rank());
  }

  std::vector<Rows> wanted(numNodes, Rows::none);
  localOf_.assign(numNodes, -1);
  const auto add = [&](int node) {
    localOf_[node] = static_cast<int>(nodes_.size());
    nodes_.push_back(node);
  };
  for (int n = 0; n < numNodes; ++n)
    if (p.nodes[n] == rank()) {
      wanted[n] = Rows::all;
      add(n);
    }
  numOwned_ = static_cast<int>(nodes_.size());
  for (int n = 0; n < numNodes; ++n)
    if (wanted[n] == Rows::none &&
        std::find(ranksAt[n].begin(), ranksAt[n].end(), rank()) != ranksAt[n].end()) {
      wanted[n] = Rows::share;
      add(n);
    }
  numLocal_ = static_cast<int>(nodes_.size());

  auto rows = nodeGraph(model, couplings, wanted, share);
  std::vector<int> beyond;
  for (const auto& row : rows)
    for (const int n : row)
      if (localOf_[n] < 0) beyond.push_back(n);
  std::sort(beyond.begin(), beyond.end());
  beyond.erase(std::unique(beyond.begin(), beyond.end()), beyond.end());
  for (const int n : beyond) add(n);
  dofs_ = model.dofs.part(nodes_);
  for (int l = 0; l < numLocal_; ++l) {
    rows_.push_back(std::move(rows[nodes_[l]]));
    for (int& column : rows_.back()) column = localOf_[column];
    std::sort(rows_.back().begin(), rows_.back().end());
  }

  const auto local = [&](int dof) {
    const int node = model.dofs.nodeOf(dof);
    return dofs_.firstDof(localOf_[node]) + dof - model.dofs.firstDof(node);
  };
  for (std::size_t c = 0; c < couplings.size(); ++c) {
    if (p.couplings[c] != rank()) continue;
    Coupling own = couplings[c];
    own.dof = local(own.dof);
    for (CoupledDof& m : own.masters) m.dof = local(m.dof);
    couplings_.push_back(std::move(own));
  }
  findNeighbours(ranksAt, p);
  matchRows();
}

void Distribution::findNeighbours(const std::vector<std::vector<int>>& ranksAt, const Partition& p) {
  const int numRanks = comm_->getSize();
  std::vector<Neighbour> all(numRanks);
  for (int l = numOwned_; l < numLocal_; ++l) all[p.nodes[nodes_[l]]].theirs.push_back(l);
  for (int l = 0; l < numOwned_; ++l)
    for (const int r : ranksAt[nodes_[l]])
      if (r != rank()) all[r].ours.push_back(l);
  for (int r = 0; r < numRanks; ++r) {
    all[r].rank = r;
    if (!all[r].theirs.empty() || !all[r].ours.empty()) neighbours_.push_back(std::move(all[r]));
  }
}

int Distribution::rowLength(int node) const {
  int length = 0;
  for (const int column : rows_[node]) length += dofs_.numDofs(column);
  return length;
}

int Distribution::positionInRow(int node, int column) const {
  int position = 0;
  for (const int other : rows_[node]) {
    if (other == column) return position;
    position += dofs_.numDofs(other);
  }
  throw std::logic_error("Distribution: a row lacks an entry");
}

/// Where the entries of the neighbours' rows belong in ours.
void Distribution::matchRows() {
  const std::size_t count = neighbours_.size();
  std::vector<int> ranks;
  std::vector<std::vector<int>> lengths(count), columns(count), theirLengths(count), theirColumns(count);
  for (std::size_t i = 0; i < count; ++i) {
    Neighbour& n = neighbours_[i];
    ranks.push_back(n.rank);
    for (const int l : n.theirs) {
      lengths[i].push_back(static_cast<int>(rows_[l].size()));
      for (const int column : rows_[l]) columns[i].push_back(nodes_[column]);
      n.sent += static_cast<std::size_t>(dofs_.numDofs(l)) * rowLength(l);
    }
    theirLengths[i].resize(n.ours.size());
  }
  exchange(*comm_, ranks, lengths, theirLengths);
  for (std::size_t i = 0; i < count; ++i)
    theirColumns[i].resize(std::accumulate(theirLengths[i].begin(), theirLengths[i].end(), std::size_t{0}));
  exchange(*comm_, ranks, columns, theirColumns);
  together([&] {
    for (std::size_t i = 0; i < count; ++i) {
      Neighbour& n = neighbours_[i];
      n.columnStart.push_back(0);
      std::size_t at = 0;
      for (std::size_t r = 0; r < n.ours.size(); ++r) {
        const auto& row = rows_[n.ours[r]];
        for (int c = 0; c < theirLengths[i][r]; ++c) {
          const int column = localOf_[theirColumns[i][at++]];
          const auto place = std::lower_bound(row.begin(), row.end(), column);
          if (column < 0 || place == row.end() || *place != column)
            throw std::logic_error("Distribution: a row lacks an entry that another rank has");
          n.columns.push_back(positionInRow(n.ours[r], column));
          n.columnSizes.push_back(dofs_.numDofs(column));
          n.received += static_cast<std::size_t>(dofs_.numDofs(n.ours[r])) * dofs_.numDofs(column);
        }
        n.columnStart.push_back(static_cast<int>(n.columns.size()));
      }
    }
  });
}

namespace {

/// The numbers of a view on the host; `back` brings changes to the device. No copies where both are one.
template <class V>
auto onHost(const V& view) {
  return Kokkos::create_mirror_view_and_copy(Kokkos::HostSpace(), view);
}

}  // namespace

template <class Put>
void Distribution::trade(const DofView& f, Nodes given, Nodes taken, const Put& put) const {
  if (alone()) return;
  const auto host = onHost(f);
  std::vector<int> ranks;
  std::vector<std::vector<double>> send, receive;
  for (const Neighbour& n : neighbours_) {
    ranks.push_back(n.rank);
    send.emplace_back();
    for (const int l : n.*given)
      for (int d = dofs_.firstDof(l); d < dofs_.firstDof(l + 1); ++d) send.back().push_back(host(d));
    std::size_t count = 0;
    for (const int l : n.*taken) count += dofs_.numDofs(l);
    receive.emplace_back(count);
  }
  exchange(*comm_, ranks, send, receive);
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    const double* from = receive[k].data();
    for (const int l : neighbours_[k].*taken)
      for (int d = dofs_.firstDof(l); d < dofs_.firstDof(l + 1); ++d) put(host(d), *from++);
  }
  Kokkos::deep_copy(f, host);
}

void Distribution::fetch(const DofView& f) const {
  trade(f, &Neighbour::ours, &Neighbour::theirs, [](double& own, double owners) { own = owners; });
}

void Distribution::collect(const DofView& f) const {
  trade(f, &Neighbour::theirs, &Neighbour::ours, [](double& own, double part) { own += part; });
}

void Distribution::collectRows(const View<std::size_t*>& rowStart, const View<double*>& values) const {
  if (alone()) return;
  const auto start = onHost(rowStart);
  const auto host = onHost(values);
  std::vector<int> ranks;
  std::vector<std::vector<double>> send, receive;
  for (const Neighbour& n : neighbours_) {
    ranks.push_back(n.rank);
    send.emplace_back();
    send.back().reserve(n.sent);
    for (const int l : n.theirs)
      for (int d = dofs_.firstDof(l); d < dofs_.firstDof(l + 1); ++d)
        send.back().insert(send.back().end(), &host(start(d)), &host(start(d)) + (start(d + 1) - start(d)));
    receive.emplace_back(n.received);
  }
  exchange(*comm_, ranks, send, receive);
  for (std::size_t k = 0; k < neighbours_.size(); ++k) {
    const Neighbour& n = neighbours_[k];
    const double* from = receive[k].data();
    for (std::size_t r = 0; r < n.ours.size(); ++r)
      for (int d = dofs_.firstDof(n.ours[r]); d < dofs_.firstDof(n.ours[r] + 1); ++d)
        for (int c = n.columnStart[r]; c < n.columnStart[r + 1]; ++c)
          for (int j = 0; j < n.columnSizes[c]; ++j) host(start(d) + n.columns[c] + j) += *from++;
  }
  Kokkos::deep_copy(values, host);
}

double Distribution::sum(double x) const {
  if (alone()) return x;
  double all = 0;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_SUM, x, Teuchos::outArg(all));
  return all;
}

double Distribution::max(double x) const {
  if (alone()) return x;
  double all = 0;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MAX, x, Teuchos::outArg(all));
  return all;
}

void Distribution::sum(std::vector<double>& x) const { reduce(Teuchos::REDUCE_SUM, x); }
void Distribution::min(std::vector<double>& x) const { reduce(Teuchos::REDUCE_MIN, x); }

void Distribution::reduce(Teuchos::EReductionType how, std::vector<double>& x) const {
  if (alone() || x.empty()) return;
  const std::vector<double> own = x;
  Teuchos::reduceAll(*comm_, how, static_cast<int>(x.size()), own.data(), x.data());
}

void Distribution::agree(const std::string& what, const std::exception_ptr& own, bool ofInput) const {
  const int mine = own ? rank() : comm_->getSize();
  int first = 0;
  Teuchos::reduceAll(*comm_, Teuchos::REDUCE_MIN, mine, Teuchos::outArg(first));
  if (first == comm_->getSize()) return;
  int about[2] = {static_cast<int>(what.size()), ofInput};
  Teuchos::broadcast(*comm_, first, 2, about);
  std::string text = first == rank() ? what : std::string(about[0], ' ');
  Teuchos::broadcast(*comm_, first, about[0], text.data());
  if (first == rank()) std::rethrow_exception(own);
  if (about[1] != 0) throw std::invalid_argument(text);
  throw std::runtime_error(text);
}

}  // namespace atrapos::fem::detail
