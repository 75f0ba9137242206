#include "restart/RestartRecord.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <type_traits>

#include "atrapos/linear/OnAllRanks.hpp"

namespace atrapos {
namespace {

class Packer {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_arithmetic_v<T> || std::is_enum_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put(static_cast<std::uint64_t>(values.size()));
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  void put(const std::string& text) { put(std::vector<char>(text.begin(), text.end())); }
  void put(const path::Vector& u) { put(linear::onAllRanks(u)); }
  void put(const path::State& s) {
    put(s.u != Teuchos::null);
    if (s.u == Teuchos::null) return;
    put(s.lambda);
    put(*s.u);
    const path::Memory none, &memory = s.memory ? *s.memory : none;
    put(memory.conditions);
    putShares(memory.variables, *s.u->getMap()->getComm());
  }
  /// What every rank has of its own, with how much that is.
  void putShares(const std::vector<double>& own, const Teuchos::Comm<int>& comm) {
    const int ranks = comm.getSize(), rank = comm.getRank();
    std::vector<std::uint64_t> counts(ranks, 0), mine(ranks, 0);
    mine[rank] = own.size();
    Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, ranks, mine.data(), counts.data());
    put(counts);
    const auto before = std::accumulate(counts.begin(), counts.begin() + rank, std::uint64_t{0});
    const auto total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    std::vector<double> all(total, 0.0), share(total, 0.0);
    std::copy(own.begin(), own.end(), share.begin() + static_cast<std::ptrdiff_t>(before));
    if (total > 0)
      Teuchos::reduceAll(comm, Teuchos::REDUCE_SUM, static_cast<int>(total), share.data(), all.data());
    put(all);
  }
  void put(const path::PathTangent& t) {
    put(t.x.u != Teuchos::null);
    if (t.x.u == Teuchos::null) return;
    put(t.lambda);
    put(*t.x.u);
    put(t.x.internal);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a Packer wrote; the check sum has said that it is whole.
class Unpacker {
 public:
  Unpacker(const std::string& bytes, const std::string& file, const path::RCP<const path::Map>& map)
      : bytes_(bytes), file_(file), map_(map) {}

  template <class T>
  void get(T& value) {
    std::memcpy(&value, take(sizeof value), sizeof value);
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(count());
    if (!values.empty())
      std::memcpy(values.data(), take(values.size() * sizeof(T)), values.size() * sizeof(T));
  }
  void get(std::string& text) {
    std::vector<char> letters;
    get(letters);
    text.assign(letters.begin(), letters.end());
  }
  void get(path::RCP<path::Vector>& v) {
    std::vector<double> values;
    get(values);
    if (values.size() != map_->getGlobalNumElements())
      throw std::invalid_argument(fmt::format("{}: its states have {} unknowns, the deck's problem has {}",
                                              file_, values.size(), map_->getGlobalNumElements()));
    v = Teuchos::rcp(new path::Vector(map_));
    const auto data = v->getDataNonConst();
    for (int i = 0; i < data.size(); ++i) data[i] = values[map_->getGlobalElement(i)];
  }
  void get(path::State& s) {
    if (!yes()) return;
    get(s.lambda);
    get(s.u);
    auto memory = std::make_shared<path::Memory>();
    get(memory->conditions);
    getShare(memory->variables);
    if (memory->conditions.empty() && memory->variables.empty()) return;
    if (!memory->variables.empty()) {
      memory->u = Teuchos::rcp(new path::Vector(*s.u, Teuchos::Copy));
      memory->lambda = s.lambda;
    }
    s.memory = std::move(memory);
  }
  /// This rank's part of what Packer::putShares wrote.
  void getShare(std::vector<double>& own) {
    std::vector<std::uint64_t> counts;
    std::vector<double> all;
    get(counts);
    get(all);
    if (all.empty()) return;
    const auto& comm = *map_->getComm();
    const std::size_t ranks = comm.getSize(), rank = comm.getRank();
    if (counts.size() != ranks ||
        std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}) != all.size())
      throw std::invalid_argument(
          fmt::format("{}: internal variables of {} rank(s) go on with as many, not with {}", file_,
                      counts.size(), ranks));
    const auto first = all.begin() + static_cast<std::ptrdiff_t>(std::accumulate(
                                         counts.begin(), counts.begin() + rank, std::uint64_t{0}));
    own.assign(first, first + static_cast<std::ptrdiff_t>(counts[rank]));
  }
  void get(path::PathTangent& t) {
    if (!yes()) return;
    get(t.lambda);
    get(t.x.u);
    get(t.x.internal);
  }
  bool yes() {
    bool value = false;
    get(value);
    return value;
  }
  std::uint64_t count() {
    std::uint64_t value = 0;
    get(value);
    return value;
  }

 private:
  const char* take(std::size_t count) {
    const char* at = bytes_.data() + place_;
    place_ += count;
    return at;
  }
  const std::string& bytes_;
  const std::string& file_;
  path::RCP<const path::Map> map_;
  std::size_t place_ = 0;
};

/// Calls f(member) for all of an object's that are single numbers or lists of them, in one order for both
/// ways.
template <class Start, class F>
void plainMembers(Start& s, path::Start*, const F& f) {
  f(s.steps), f(s.pathLength), f(s.length), f(s.events), f(s.due);
  f(s.order), f(s.padeFailures), f(s.padeWait), f(s.expectedNegative), f(s.stop);
}
template <class Point, class F>
void plainMembers(Point& p, path::CriticalPoint*, const F& f) {
  f(p.a), f(p.stepLength), f(p.kind), f(p.residual), f(p.uncertainty);
  f(p.negativeChange), f(p.nullity);
}
template <class Outcome, class F>
void plainMembers(Outcome& o, path::Outcome*, const F& f) {
  f(o.factorizations), f(o.solves), f(o.orders), f(o.reason), f(o.text), f(o.steps), f(o.startIterations);
  f(o.corrections), f(o.restarts), f(o.retreats), f(o.criticalFactorizations), f(o.events), f(o.eventTrials);
  f(o.closings), f(o.cutBacks), f(o.worstResidual), f(o.weight), f(o.pathLength), f(o.jumps), f(o.worstJump);
}
template <class Branch, class F>
void plainMembers(Branch& b, path::Branch*, const F& f) {
  f(b.parent), f(b.point), f(b.depth), f(b.imperfection), f(b.end);
}
template <class Owner>
void putPlain(const Owner& owner, Packer& p) {
  plainMembers(owner, static_cast<Owner*>(nullptr), [&](const auto& member) { p.put(member); });
}
template <class Owner>
void getPlain(Owner& owner, Unpacker& u) {
  plainMembers(owner, static_cast<Owner*>(nullptr), [&](auto& member) { u.get(member); });
}

void put(const path::Start& s, Packer& p) {
  putPlain(s, p);
  p.put(s.state);
  p.put(s.weight.has_value());
  if (s.weight) p.put(*s.weight);
  p.put(s.tangent.has_value());
  if (s.tangent) p.put(*s.tangent);
  p.put(static_cast<std::uint64_t>(s.eigenvalues.size()));
  for (const auto& e : s.eigenvalues) {
    p.put(e.value);
    p.put(e.rate);
    p.put(*e.vector);
  }
}

path::Start startOf(Unpacker& u) {
  path::Start s;
  getPlain(s, u);
  u.get(s.state);
  if (u.yes()) u.get(s.weight.emplace());
  if (u.yes()) u.get(s.tangent.emplace());
  s.eigenvalues.resize(u.count());
  for (auto& e : s.eigenvalues) {
    u.get(e.value);
    u.get(e.rate);
    u.get(e.vector);
  }
  return s;
}

void put(const path::Outcome& o, Packer& p) {
  putPlain(o, p);
  p.put(o.final);
}

void get(path::Outcome& o, Unpacker& u) {
  getPlain(o, u);
  u.get(o.final);
}

void put(const path::BranchPoint& found, Packer& p) {
  const path::CriticalPoint& point = found.point;
  p.put(found.branch);
  p.put(found.step);
  putPlain(point, p);
  p.put(point.state);
  p.put(static_cast<std::uint64_t>(point.tangents.size()));
  for (const auto& t : point.tangents) p.put(t);
  p.put(static_cast<std::uint64_t>(point.nullVectors.size()));
  for (const auto& v : point.nullVectors) p.put(*v);
}

path::BranchPoint pointOf(Unpacker& u) {
  path::BranchPoint found;
  path::CriticalPoint& point = found.point;
  u.get(found.branch);
  u.get(found.step);
  getPlain(point, u);
  u.get(point.state);
  point.tangents.resize(u.count());
  for (auto& t : point.tangents) u.get(t);
  point.nullVectors.resize(u.count());
  for (auto& v : point.nullVectors) u.get(v);
  return found;
}

void get(RestartHead& head, Unpacker& u) {
  u.get(head.place.branch);
  u.get(head.place.step);
  u.get(head.over);
  u.get(head.tree);
}

}  // namespace

std::string packed(const path::BranchProgress& progress, std::size_t branches, std::size_t points,
                   bool tree) {
  const path::BranchDiagram& diagram = progress.diagram;
  Packer p;
  const path::Branch& current = diagram.branches.at(progress.current);
  p.put(progress.current);
  p.put(progress.path ? progress.path->steps : current.outcome.steps);
  p.put(!progress.path);
  p.put(tree);
  p.put(static_cast<std::uint64_t>(diagram.branches.size() - branches));
  for (std::size_t b = branches; b < diagram.branches.size(); ++b) {
    putPlain(diagram.branches[b], p);
    p.put(diagram.branches[b].direction);
    p.put(diagram.branches[b].start);
  }
  p.put(static_cast<std::uint64_t>(diagram.points.size() - points));
  for (std::size_t i = points; i < diagram.points.size(); ++i) put(diagram.points[i], p);
  std::vector<char> taken;
  for (const auto& half : progress.halves) taken.push_back(half.taken);
  p.put(taken);
  p.put(progress.next);
  p.put(progress.followed);
  p.put(diagram.switchFactorizations);
  p.put(diagram.complete);
  p.put(current.end);
  if (progress.path)
    put(*progress.path, p);
  else
    put(current.outcome, p);
  return p.bytes();
}

RestartHead headOf(const std::string& record) {
  Unpacker u(record, record, Teuchos::null);
  RestartHead head;
  get(head, u);
  return head;
}

void apply(const std::string& record, bool last, const std::string& file,
           const path::RCP<const path::Map>& map, path::BranchProgress& progress) {
  path::BranchDiagram& diagram = progress.diagram;
  Unpacker u(record, file, map);
  RestartHead head;
  get(head, u);
  progress.current = head.place.branch;
  for (std::uint64_t n = u.count(); n > 0; --n) {
    path::Branch& b = diagram.branches.emplace_back();
    getPlain(b, u);
    u.get(b.direction);
    u.get(b.start);
  }
  const int known = static_cast<int>(diagram.points.size());
  for (std::uint64_t n = u.count(); n > 0; --n) diagram.points.push_back(pointOf(u));
  progress.addHalves(known);
  std::vector<char> taken;
  u.get(taken);
  for (std::size_t i = 0; i < taken.size(); ++i) progress.halves.at(i).taken = taken[i] != 0;
  u.get(progress.next);
  u.get(progress.followed);
  u.get(diagram.switchFactorizations);
  u.get(diagram.complete);
  u.get(diagram.branches.at(progress.current).end);
  progress.path.reset();
  if (head.over)
    get(diagram.branches.at(progress.current).outcome, u);
  else if (last)
    progress.path = startOf(u);
}

}  // namespace atrapos
