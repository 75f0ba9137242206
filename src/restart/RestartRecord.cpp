#include "restart/RestartRecord.hpp"

#include <fmt/format.h>

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <memory>
#include <numeric>
#include <stdexcept>
#include <type_traits>

#include "atrapos/linear/OnAllRanks.hpp"

namespace atrapos {
namespace {

/// Decks may ask for less (deck/PathTables.cpp).
constexpr int mostOrder = 1000;

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
  template <class T, std::size_t N>
  void put(const std::array<T, N>& values) {
    for (const T& value : values) put(value);
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

// Enumerators from a file: those that there are.
int numberOf(path::CriticalKind) { return static_cast<int>(path::CriticalKind::hilltop) + 1; }
int numberOf(path::EndReason) { return static_cast<int>(path::EndReason::pathClosed) + 1; }
int numberOf(path::BranchEnd) { return static_cast<int>(path::BranchEnd::noStart) + 1; }

/// Reads what a Packer wrote. The check sum has told damage; nothing is taken from beyond the record or
/// without bounds where it is forged.
class Unpacker {
 public:
  Unpacker(const std::string& bytes, const std::string& file, const path::RCP<const path::Map>& map)
      : bytes_(bytes), file_(file), map_(map) {}

  template <class T>
  void get(T& value) {
    if constexpr (std::is_same_v<T, bool>) {
      value = *take(1) != 0;
    } else {
      std::memcpy(&value, take(sizeof value), sizeof value);
      if constexpr (std::is_enum_v<T>)
        require(static_cast<int>(value) >= 0 && static_cast<int>(value) < numberOf(value));
    }
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.resize(count(sizeof(T)));
    if (!values.empty())
      std::memcpy(values.data(), take(values.size() * sizeof(T)), values.size() * sizeof(T));
  }
  template <class T, std::size_t N>
  void get(std::array<T, N>& values) {
    for (T& value : values) get(value);
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
    for (const std::uint64_t count : counts) require(count <= all.size());
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
  /// Of things that take at least so many bytes each.
  std::size_t count(std::size_t bytes = 1) {
    std::uint64_t value = 0;
    get(value);
    require(value <= (bytes_.size() - place_) / bytes);
    return value;
  }
  void require(bool sense) const {
    if (!sense) throw std::invalid_argument(fmt::format("{}: holds a record that no run writes", file_));
  }
  /// An index of one of `size` things, or from `least` on.
  void requireIndex(int index, std::size_t size, int least = 0) const {
    require(index >= least && (index < 0 || static_cast<std::size_t>(index) < size));
  }
  void requireEnd() const { require(place_ == bytes_.size()); }

 private:
  const char* take(std::size_t count) {
    require(count <= bytes_.size() - place_);
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
  f(s.steps), f(s.pathLength), f(s.limitPoints), f(s.bifurcations), f(s.length), f(s.relaxLength),
      f(s.fieldSizes), f(s.events), f(s.due);
  f(s.order), f(s.padeFailures), f(s.padeWait), f(s.expectedNegative), f(s.stop);
}
template <class Landmark, class F>
void plainMembers(Landmark& m, path::Landmark*, const F& f) {
  f(m.step), f(m.place), f(m.direction), f(m.end);
}
template <class Point, class F>
void plainMembers(Point& p, path::CriticalPoint*, const F& f) {
  f(p.a), f(p.stepLength), f(p.fieldSizes), f(p.kind), f(p.residual), f(p.uncertainty);
  f(p.negativeChange), f(p.nullity);
}
template <class Outcome, class F>
void plainMembers(Outcome& o, path::Outcome*, const F& f) {
  f(o.factorizations), f(o.solves), f(o.orders), f(o.reason), f(o.text), f(o.steps), f(o.startIterations);
  f(o.corrections), f(o.restarts), f(o.retreats), f(o.criticalFactorizations), f(o.events), f(o.eventTrials);
  f(o.closings), f(o.cutBacks), f(o.worstResidual), f(o.weight), f(o.pathLength), f(o.jumps), f(o.worstJump);
  f(o.hopfFactorizations);
}
template <class Branch, class F>
void plainMembers(Branch& b, path::Branch*, const F& f) {
  f(b.parent), f(b.point), f(b.depth), f(b.imperfection), f(b.stage), f(b.end);
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
  u.require(s.state.u != Teuchos::null && std::isfinite(s.state.lambda) && std::isfinite(s.pathLength));
  u.require(s.limitPoints >= 0 && s.bifurcations >= 0);
  for (const double size : s.fieldSizes) u.require(size >= 0 && std::isfinite(size));
  u.require(s.steps >= 0 && s.order >= 0 && s.order <= mostOrder);
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
  u.require(point.state.u != Teuchos::null && found.step >= 0);
  point.tangents.resize(u.count());
  for (auto& t : point.tangents) u.get(t);
  point.nullVectors.resize(u.count());
  for (auto& v : point.nullVectors) u.get(v);
  return found;
}

template <class F>
void eachMark(RunMarks& marks, const F& f) {
  for (Mark* const mark : {&marks.path, &marks.points, &marks.steps, &marks.events, &marks.fields}) {
    f(mark->count);
    f(mark->digest);
  }
}

template <class F>
void eachNumber(MeshDigest& mesh, const F& f) {
  for (std::uint64_t* const number : {&mesh.nodes, &mesh.elements, &mesh.places, &mesh.blocks, &mesh.sets})
    f(*number);
}

void get(RestartHead& head, Unpacker& u) {
  u.get(head.place.branch);
  u.get(head.place.step);
  u.get(head.over);
  u.get(head.tree);
  eachMark(head.marks, [&](std::uint64_t& number) { u.get(number); });
  u.require(head.place.branch >= 0 && head.place.step >= 0);
}

}  // namespace

std::string packed(const RunProblem& problem) {
  Packer p;
  MeshDigest mesh = problem.mesh;
  eachNumber(mesh, [&](std::uint64_t number) { p.put(number); });
  p.put(static_cast<std::uint64_t>(problem.deck.size()));
  for (const std::string& line : problem.deck) p.put(line);
  return p.bytes();
}

RunProblem problemOf(const std::string& record, const std::string& file) {
  Unpacker u(record, file, Teuchos::null);
  RunProblem problem;
  eachNumber(problem.mesh, [&](std::uint64_t& number) { u.get(number); });
  problem.deck.resize(u.count(sizeof(std::uint64_t)));
  for (std::string& line : problem.deck) u.get(line);
  u.requireEnd();
  return problem;
}

std::string packed(const path::BranchProgress& progress, std::size_t branches, std::size_t points, bool tree,
                   const RunMarks& marks) {
  const path::BranchDiagram& diagram = progress.diagram;
  Packer p;
  const path::Branch& current = diagram.branches.at(progress.current);
  p.put(progress.current);
  p.put(progress.path ? progress.path->steps : current.outcome.steps);
  p.put(!progress.path);
  p.put(tree);
  RunMarks numbers = marks;
  eachMark(numbers, [&](std::uint64_t number) { p.put(number); });
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
  p.put(diagram.unexplained);
  p.put(diagram.uncounted);
  p.put(current.end);
  // Of the landmarks the last one: those before are in the records of their steps.
  const bool marked = progress.path && !progress.path->landmarks.empty();
  p.put(marked);
  if (marked) putPlain(progress.path->landmarks.last(), p);
  if (progress.path)
    put(*progress.path, p);
  else
    put(current.outcome, p);
  return p.bytes();
}

RestartHead headOf(const std::string& record, const std::string& file) {
  Unpacker u(record, file, Teuchos::null);
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
  for (std::size_t n = u.count(); n > 0; --n) {
    path::Branch& b = diagram.branches.emplace_back();
    getPlain(b, u);
    u.get(b.direction);
    u.get(b.start);
    u.requireIndex(b.parent, diagram.branches.size() - 1, -1);
    u.require(b.start.u != Teuchos::null || b.end != path::BranchEnd::path);
  }
  const int known = static_cast<int>(diagram.points.size());
  for (std::size_t n = u.count(); n > 0; --n) {
    diagram.points.push_back(pointOf(u));
    u.requireIndex(diagram.points.back().branch, diagram.branches.size());
  }
  u.requireIndex(progress.current, diagram.branches.size());
  for (const path::Branch& b : diagram.branches)
    u.requireIndex(b.point, diagram.points.size(), b.parent < 0 ? -1 : 0);
  progress.addHalves(known);
  std::vector<char> taken;
  u.get(taken);
  u.require(taken.size() <= progress.halves.size());  // without branches none
  for (std::size_t i = 0; i < taken.size(); ++i) progress.halves[i].taken = taken[i] != 0;
  u.get(progress.next);
  u.get(progress.followed);
  u.requireIndex(progress.next, progress.halves.size() + 1);
  u.require(progress.followed >= 0);
  u.get(diagram.switchFactorizations);
  u.get(diagram.complete);
  u.get(diagram.unexplained);
  u.get(diagram.uncounted);
  u.require(diagram.unexplained >= 0 && diagram.uncounted >= 0);
  u.get(diagram.branches[progress.current].end);
  path::Trail landmarks;
  if (progress.path) landmarks = std::move(progress.path->landmarks);
  if (u.yes()) {
    path::Landmark mark;
    getPlain(mark, u);
    for (const auto& place : {mark.place, mark.direction, mark.end})
      u.require(std::all_of(place.begin(), place.end(), [](double x) { return std::isfinite(x); }));
    landmarks.add(mark);
  }
  progress.path.reset();
  if (head.over) {
    get(diagram.branches[progress.current].outcome, u);
  } else {
    progress.path = last ? startOf(u) : path::Start();
    progress.path->landmarks = std::move(landmarks);
  }
  if (head.over || last) u.requireEnd();
}

}  // namespace atrapos
