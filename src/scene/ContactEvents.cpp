#include "scene/ContactEvents.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/taylor/Implicit.hpp"
#include "commands/SceneCase.hpp"

namespace atrapos {
namespace {

/// Series coefficients of all nodes' vectors on the host: [order][3 node + component].
std::vector<std::vector<double>> coefficients(const fem::DofMap& dofs, const path::Series& series) {
  std::vector<std::vector<double>> all;
  for (int k = 0; k <= series.order(); ++k)
    all.push_back(dofs.vectors(fem::FeProblem::values(*series.coefficient(k).u)));
  return all;
}

/// [node] How far nodes go up to a, at most: by the polynomial, or at the samples of a rational form, where
/// `samples` has the factors of U_0, U_1, ... instead of powers of a.
std::vector<double> longestWays(const std::vector<std::vector<double>>& u, double a,
                                const std::vector<std::vector<double>>& samples) {
  const std::size_t numNodes = u[0].size() / 3;
  const auto length = [](const double* x) { return std::sqrt(x[0] * x[0] + x[1] * x[1] + x[2] * x[2]); };
  std::vector<double> ways(numNodes, 0.0);
  double power = 1;
  for (std::size_t k = 1; samples.empty() && k < u.size(); ++k) {
    power *= a;
    for (std::size_t n = 0; n < numNodes; ++n) ways[n] += power * length(&u[k][3 * n]);
  }
  // Some nodes after the others, so that their coefficients stay in the caches for all samples.
  constexpr std::size_t together = 64;
  for (std::size_t first = 0; !samples.empty() && first < numNodes; first += together) {
    const std::size_t count = std::min(together, numNodes - first);
    for (const std::vector<double>& factors : samples) {
      double moved[3 * together] = {};
      for (std::size_t k = 1; k < factors.size(); ++k)
        for (std::size_t d = 0; d < 3 * count; ++d) moved[d] += factors[k] * u[k][3 * first + d];
      for (std::size_t n = 0; n < count; ++n)
        ways[first + n] = std::max(ways[first + n], length(&moved[3 * n]));
    }
  }
  return ways;
}

/// What all points of a step are looked at with; its parts outlive the points.
struct Motion {
  const path::Series& series;
  const path::Rational& lambda;
  const std::vector<std::vector<double>>& u;  ///< [order][3 node + component]
  const std::vector<double>& ways;            ///< longestWays
};

/// One point of a contact along a step.
class PointOnSeries {
 public:
  PointOnSeries(const ContactPoints& contact, std::size_t term, int point, const Motion& motion)
      : tool_(*contact.tool),
        closedGap_(contact.closedGaps[term][point]),
        motion_(motion),
        N_(contact.points[term].nodesPerEntity) {
    const fem::PointSet& points = contact.points[term];
    const std::size_t e = point / points.pointsPerEntity;
    shape_ = &points.shape[static_cast<std::size_t>(point) * N_];
    nodes_ = &points.nodes[e * N_];
    reference_ = &points.positions[3 * static_cast<std::size_t>(point)];
  }

  /// Most points never ask beyond the start: their functions are not made before.
  void place(double a, double* x) {
    if (position_.empty())
      for (int i = 0; i < 3; ++i) {
        std::vector<double> coefficients;
        for (const auto& field : motion_.u) coefficients.push_back(component(field, i));
        coefficients[0] += reference_[i];
        position_.push_back(motion_.series.scalar(coefficients));
      }
    for (int i = 0; i < 3; ++i) x[i] = position_[i](a);
    x[3] = motion_.lambda(a);
  }

  contact::ToolProjection atStart() const {
    double x[4];
    for (int i = 0; i < 3; ++i) x[i] = component(motion_.u[0], i) + reference_[i];
    x[3] = motion_.lambda(0);
    return tool_.project(x);
  }

  double gap(double a) {
    double x[4];
    place(a, x);
    return tool_.project(x).gap;
  }

  bool closed(double a) { return gap(a) <= closedGap_; }

  /// Whether the way that the point goes within the step is too short to close or open it: gaps change by no
  /// more.
  bool staysFrom(const contact::ToolProjection& start) const {
    if (tool_.moves()) return false;
    double way = 0;
    for (int n = 0; n < N_; ++n) way += std::abs(shape_[n]) * motion_.ways[nodes_[n]];
    return way < (std::isfinite(start.gap) ? std::abs(start.gap - closedGap_) : start.distance - closedGap_);
  }

  /// Where it changes between two places, one closed and one open.
  double change(double from, double to) {
    const bool closedAtStart = closed(from);
    // Bisection down to rounding: the gap may jump at a tool's edge.
    const double tolerance = 4e-16 * to;
    while (to - from > tolerance) {
      const double middle = 0.5 * (from + to);
      if (middle <= from || middle >= to) break;
      (closed(middle) == closedAtStart ? from : to) = middle;
    }
    return to;
  }

 private:
  double component(const std::vector<double>& field, int i) const {
    double sum = 0;
    for (int n = 0; n < N_; ++n) sum += shape_[n] * field[3 * static_cast<std::size_t>(nodes_[n]) + i];
    return sum;
  }

  const contact::RigidTool& tool_;
  double closedGap_;
  const Motion& motion_;
  int N_;
  const double *shape_, *reference_;
  const int* nodes_;
  std::vector<path::Rational> position_;
};

/// Of the mesh's nodes; those beyond are directors of shells.
int nearestNode(const fem::PointSet& points, int point, int numMeshNodes) {
  const int N = points.nodesPerEntity, e = point / points.pointsPerEntity;
  const double* shape = &points.shape[static_cast<std::size_t>(point) * N];
  const int* nodes = &points.nodes[static_cast<std::size_t>(e) * N];
  int best = -1;
  for (int n = 0; n < N; ++n)
    if (nodes[n] < numMeshNodes && (best < 0 || shape[n] > shape[best])) best = n;
  return nodes[best];
}

}  // namespace

ContactEvents::ContactEvents(const Scene& scene, const std::string& file, bool append)
    : scene_(scene),
      table_(file, "step,branch,path_length,load_factor,contact,event,point,node,x,y,z,force", append) {}

void ContactEvents::onStep(int branch, int step, double pathLengthStart, double length,
                           const path::Series& series, const CaseState& end,
                           const std::vector<int>& changes) {
  constexpr int samples = 16;
  if (branch != branch_) closed_.clear();
  branch_ = branch;
  const auto u = coefficients(scene_.problem().model().dofs, series);
  const path::Rational lambda = series.lambdaFunction();
  std::vector<std::vector<double>> factors;  // of the coefficients at the samples
  if (series.form())
    for (int i = 1; i <= samples; ++i) factors.push_back(series.form()->weights(length * i / samples));
  const auto ways = longestWays(u, length, factors);
  const Motion motion{series, lambda, u, ways};
  const bool first = closed_.empty();
  // Most steps start from the state at which the last one has ended.
  const bool goesOn = known_.lambda == series.lambdaCoefficient(0) && known_.u == u[0];
  closed_.resize(scene_.contacts().size());
  std::vector<ContactEvent> events;
  for (std::size_t c = 0; c < scene_.contacts().size(); ++c) {
    const ContactPoints& contact = scene_.contacts()[c];
    if (contact.hardFaces || !contact.lines.empty()) {
      findConditions(c, series, length, changes, events);
      continue;
    }
    closed_[c].resize(contact.count);
    int number = -1;
    for (std::size_t t = 0; t < contact.points.size(); ++t)
      for (int p = 0; p < contact.points[t].numPoints(); ++p) {
        ++number;
        char& wasClosed = closed_[c][number];
        PointOnSeries point(contact, t, p, motion);
        contact::ToolProjection start;
        if (goesOn && !known_.gaps[c].empty()) start.gap = known_.gaps[c][number];
        if (!std::isfinite(start.gap)) start = point.atStart();
        const auto note = [&](double a, bool closes) {
          ContactEvent event;
          double x[4], R[1] = {0};
          point.place(a, x);
          const double gap[1] = {contact.tool->project(x).gap};
          if (std::isfinite(gap[0]) && !contact.pressure.hard)  // hard: zero where it closes or opens
            taylor::solveImplicit<1, 1, 1>(contact.pressure.law, gap, &contact.references[t][p], R);
          event.a = a;
          event.loadFactor = x[3];
          event.closes = closes;
          event.contact = static_cast<int>(c);
          event.point = number;
          event.node = nearestNode(contact.points[t], p, scene_.mesh().numNodes());
          std::copy_n(x, 3, event.place);
          event.force = contact.points[t].weights[p] * R[0];
          events.push_back(event);
        };
        bool before = start.gap <= contact.closedGaps[t][p];
        // A correction at the end of the last step may have moved it.
        if (!first && before != (wasClosed != 0)) note(0, before);
        double from = 0;
        if (!point.staysFrom(start))
          for (int i = 1; i <= samples; ++i) {
            const double to = length * i / samples;
            const bool now = point.closed(to);
            if (now != before) note(point.change(from, to), now);
            before = now;
            from = to;
          }
        wasClosed = before;
      }
  }
  std::stable_sort(events.begin(), events.end(),
                   [](const ContactEvent& l, const ContactEvent& r) { return l.a < r.a; });
  for (const ContactEvent& e : events) {
    const fem::Mesh& mesh = scene_.mesh();
    const long long node = mesh.nodeNumber(e.node);
    table_.append(fmt::format("{},{},{:.17g},{:.17g},{},{},{},{},{:.10g},{:.10g},{:.10g},{:.10g}", step,
                              branch, pathLengthStart + e.a, e.loadFactor, scene_.contacts()[e.contact].name,
                              e.closes ? "closes" : "opens", e.point + 1, node, e.place[0], e.place[1],
                              e.place[2], e.force));
  }
  count_ += static_cast<int>(events.size());
  remember(end);
}

void ContactEvents::remember(const CaseState& end) {
  const SceneState& state = dynamic_cast<const SceneCaseState&>(end).state();
  known_ = {state.displacements(), state.lambda(), {}};
  for (const ContactPoints& contact : scene_.contacts()) {
    std::vector<double>& gaps = known_.gaps.emplace_back();
    // Hard contact closes where the gap is zero, which is rounding: its gaps are all found in the same way.
    if (contact.pressure.hard) continue;
    for (const int term : contact.terms) {
      const fem::PointValues& observed = state.observed(term);
      for (std::size_t i = 0; i < observed.values.size(); i += observed.names.size())
        gaps.push_back(observed.values[i]);
    }
  }
}

void ContactEvents::findConditions(std::size_t c, const path::Series& series, double length,
                                   const std::vector<int>& changes, std::vector<ContactEvent>& events) const {
  if (changes.empty()) return;
  const ContactPoints& contact = scene_.contacts()[c];
  const fem::FeProblem& problem = scene_.problem();
  const path::State state = series.state(length);
  const auto u = problem.model().dofs.vectors(fem::FeProblem::values(*state.u));
  const std::vector<int> active = problem.conditionsAt(state);
  int number = 0;  // of the term's first corner
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    std::vector<fem::ZoneCondition> conditions;
    if (contact.hardFaces)
      for (const int corner : fem::cornersOf(contact.points[t])) conditions.push_back({corner, false});
    else
      conditions = fem::zoneConditions(contact.lines[t]);
    const int count = static_cast<int>(conditions.size()), first = problem.firstEvent(contact.terms[t]);
    for (const int change : changes) {
      const int i = change - first;
      if (i < 0 || i >= count) continue;
      ContactEvent event;
      event.a = length;
      event.loadFactor = state.lambda;
      event.closes = (active[change] == 0) != conditions[i].opens;
      event.contact = static_cast<int>(c);
      event.point = number + i;
      event.node = conditions[i].node;
      for (int d = 0; d < 3; ++d) {
        const std::size_t dof = 3 * static_cast<std::size_t>(conditions[i].node) + d;
        event.place[d] = scene_.mesh().coordinates[dof] + u[dof];
      }
      events.push_back(event);
    }
    number += count;
  }
}

}  // namespace atrapos
