#include "ContactEvents.hpp"

#include <fmt/format.h>

#include <Tpetra_Vector.hpp>
#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "atrapos/fem/Multipliers.hpp"
#include "atrapos/taylor/Implicit.hpp"

namespace atrapos {
namespace {

/// Series coefficients of the nodal fields on the host: [order][dof].
std::vector<std::vector<double>> coefficients(const path::Series& series) {
  std::vector<std::vector<double>> all;
  for (int k = 0; k <= series.order(); ++k) all.push_back(fem::FeProblem::values(*series.coefficient(k).u));
  return all;
}

/// One point of a contact along a step.
class PointOnSeries {
 public:
  /// `lambda` is the series' and outlives this.
  PointOnSeries(const ContactPoints& contact, std::size_t term, int point, const path::Series& series,
                const path::Rational& lambda, const std::vector<std::vector<double>>& u)
      : tool_(*contact.tool), closedGap_(contact.closedGaps[term][point]), series_(series), lambda_(lambda) {
    const fem::PointSet& points = contact.points[term];
    const int N = points.nodesPerEntity, e = point / points.pointsPerEntity;
    const double* shape = &points.shape[static_cast<std::size_t>(point) * N];
    const int* nodes = &points.nodes[static_cast<std::size_t>(e) * N];
    for (int i = 0; i < 3; ++i) {
      std::vector<double>& x = x_[i];
      x.reserve(u.size());
      for (const auto& field : u) {
        double sum = 0;
        for (int n = 0; n < N; ++n) sum += shape[n] * field[3 * static_cast<std::size_t>(nodes[n]) + i];
        x.push_back(sum);
      }
      x[0] += points.positions[3 * static_cast<std::size_t>(point) + i];
    }
  }

  /// Most points never ask beyond the start: their functions are not made before.
  void place(double a, double* x) {
    if (position_.empty())
      for (const auto& coefficients : x_) position_.push_back(series_.scalar(coefficients));
    for (int i = 0; i < 3; ++i) x[i] = position_[i](a);
    x[3] = lambda_(a);
  }

  ToolProjection atStart() const {
    const double x[4] = {x_[0][0], x_[1][0], x_[2][0], lambda_(0)};
    return tool_.project(x);
  }

  double gap(double a) {
    double x[4];
    place(a, x);
    return tool_.project(x).gap;
  }

  bool closed(double a) { return gap(a) <= closedGap_; }

  /// Whether the way that the point goes up to a is too short to close or open it: gaps change by no more.
  /// `samples`: the factors of X_0, X_1, ... where a rational form is looked at, instead of a.
  bool staysFrom(const ToolProjection& start, double a,
                 const std::vector<std::vector<double>>& samples) const {
    if (tool_.moves()) return false;
    const double room =
        std::isfinite(start.gap) ? std::abs(start.gap - closedGap_) : start.distance - closedGap_;
    if (series_.form() == nullptr) {
      double way = 0, power = 1;
      for (std::size_t k = 1; k < x_[0].size(); ++k) {
        power *= a;
        way += power * std::sqrt(x_[0][k] * x_[0][k] + x_[1][k] * x_[1][k] + x_[2][k] * x_[2][k]);
      }
      return room > way;
    }
    return std::all_of(samples.begin(), samples.end(), [&](const std::vector<double>& factors) {
      double way[3] = {0, 0, 0};
      for (std::size_t k = 1; k < factors.size(); ++k)
        for (int i = 0; i < 3; ++i) way[i] += factors[k] * x_[i][k];
      return room > std::hypot(way[0], way[1], way[2]);
    });
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
  const RigidTool& tool_;
  double closedGap_;
  const path::Series& series_;
  const path::Rational& lambda_;
  std::vector<double> x_[3];  ///< coefficients
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
                           const path::Series& series, const std::vector<int>& changes) {
  constexpr int samples = 16;
  if (branch != branch_) closed_.clear();
  branch_ = branch;
  const auto u = coefficients(series);
  const path::Rational lambda = series.lambdaFunction();
  std::vector<std::vector<double>> factors;  // of the coefficients at the samples
  if (series.form())
    for (int i = 1; i <= samples; ++i) factors.push_back(series.form()->weights(length * i / samples));
  const bool first = closed_.empty();
  closed_.resize(scene_.contacts().size());
  std::vector<ContactEvent> events;
  for (std::size_t c = 0; c < scene_.contacts().size(); ++c) {
    const ContactPoints& contact = scene_.contacts()[c];
    if (contact.hardFaces) {
      findCorners(c, series, length, changes, events);
      continue;
    }
    closed_[c].resize(contact.count);
    int number = -1;
    for (std::size_t t = 0; t < contact.points.size(); ++t)
      for (int p = 0; p < contact.points[t].numPoints(); ++p) {
        ++number;
        char& wasClosed = closed_[c][number];
        PointOnSeries point(contact, t, p, series, lambda, u);
        const ToolProjection start = point.atStart();
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
        if (!point.staysFrom(start, length, factors))
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
    const long long node = mesh.nodeIds.empty() ? e.node + 1 : mesh.nodeIds[e.node];
    table_.append(fmt::format("{},{},{:.17g},{:.17g},{},{},{},{},{:.10g},{:.10g},{:.10g},{:.10g}", step,
                              branch, pathLengthStart + e.a, e.loadFactor, scene_.contacts()[e.contact].name,
                              e.closes ? "closes" : "opens", e.point + 1, node, e.place[0], e.place[1],
                              e.place[2], e.force));
  }
  count_ += static_cast<int>(events.size());
}

void ContactEvents::findCorners(std::size_t c, const path::Series& series, double length,
                                const std::vector<int>& changes, std::vector<ContactEvent>& events) const {
  if (changes.empty()) return;
  const ContactPoints& contact = scene_.contacts()[c];
  const fem::FeProblem& problem = scene_.problem();
  path::Vector state(problem.map());
  const double lambda = series.evaluate(length, state);
  const auto u = fem::FeProblem::values(state);
  const std::vector<int> active = problem.conditions();
  int number = 0;  // of the term's first corner
  for (std::size_t t = 0; t < contact.terms.size(); ++t) {
    const std::vector<int> corners = fem::cornersOf(contact.points[t]);
    const int count = static_cast<int>(corners.size()), first = problem.firstEvent(contact.terms[t]);
    for (const int change : changes) {
      const int i = change - first;
      if (i < 0 || i >= count) continue;
      ContactEvent event;
      event.a = length;
      event.loadFactor = lambda;
      event.closes = active[change] == 0;
      event.contact = static_cast<int>(c);
      event.point = number + i;
      event.node = corners[i];
      for (int d = 0; d < 3; ++d) {
        const std::size_t dof = 3 * static_cast<std::size_t>(corners[i]) + d;
        event.place[d] = scene_.mesh().coordinates[dof] + u[dof];
      }
      events.push_back(event);
    }
    number += count;
  }
}

}  // namespace atrapos
