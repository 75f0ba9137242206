#include "output/RunLog.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <ostream>
#include <utility>

namespace atrapos {
namespace {

constexpr const char* kIndent = "      ";

/// Of the table of steps.
struct Column {
  const char *name, *meaning;
};

constexpr Column kColumns[] = {
    {"step", "number of the step on its path or branch"},
    {"order", "terms of its Taylor series (none with Newton steps)"},
    {"radius", "how far the series is good to the accuracy asked for, in the path parameter"},
    {"", "(with Newton steps `tried`, the first length tried)"},
    {"load factor", "at the end of the step"},
    {"length", "of the step: shorter than the radius at stops, events and where the residual asks for it"},
    {"residual",
     "forces out of balance at its end, relative to those of the elements (bound: path/residual)"},
    {"cut", "lengths rejected because the residual was over its bound"},
    {"corr", "Newton iterations at its end"},
    {"closed", "contact points that are closed at its end"},
    {"changes", "contact points that closed, opened or went over to another surface in it (events.csv)"},
    {"time s", "seconds since the run began"}};

constexpr const char* kBelow =
    R"(Below a step: its limit points (the load factor turns), bifurcation and Hopf points with
the load factor and the first monitors there, eigenvalues whose change of sign was not located,
jumps of contact forces. Where a run takes long: the time left at the rate of the last steps.
)";

}  // namespace

RunLog::RunLog(std::ostream* out, deck::Path settings, std::vector<std::string> monitors)
    : out_(out), settings_(std::move(settings)), monitors_(std::move(monitors)) {}

std::string RunLog::columns() {
  std::string text = "Columns of the table of steps:\n";
  for (const Column& c : kColumns) text += fmt::format("  {:<12} {}\n", c.name, c.meaning);
  return text + kBelow;
}

void RunLog::line(const std::string& text) {
  if (out_) *out_ << text << std::endl;
}

void RunLog::head() {
  last_.clear();
  const bool series = settings_.series();
  line(fmt::format("{:>5} {:>5} {:>10} {:>13} {:>10} {:>10} {:>4} {:>4} {:>7} {:>7} {:>8}", "step",
                   series ? "order" : "", series ? "radius" : "tried", "load factor", "length", "residual",
                   "cut", "corr", "closed", "changes", "time s"));
}

std::string describe(const PointRow& point, const std::vector<std::string>& monitors) {
  std::string text;
  if (point.nullity > 0) {
    text = fmt::format("bifurcation point ({}) at load factor {:.10g}", point.kind, point.loadFactor);
    if (point.nullity > 1) text += fmt::format(", {} null vectors", point.nullity);
  } else if (point.kind == hopfKind) {
    text = fmt::format("Hopf point at load factor {:.10g}, angular frequency {:.8g}", point.loadFactor,
                       point.frequency);
    if (std::abs(point.negativeChange) > 2)
      text += fmt::format(", {} pairs of eigenvalues", std::abs(point.negativeChange) / 2);
  } else if (point.kind == "maximum" || point.kind == "minimum") {
    text = fmt::format("limit point ({}) at load factor {:.8g}", point.kind, point.loadFactor);
  } else {
    return text;
  }
  constexpr std::size_t most = 3;
  for (std::size_t m = 0; m < std::min(most, point.monitors.size()); ++m)
    text += fmt::format("{} {} = {:.6g}", m == 0 ? ":" : ",", monitors[m], point.monitors[m]);
  return text;
}

std::string inWords(double seconds) {
  constexpr double minute = 60, hour = 3600;
  if (seconds < 2 * minute) return fmt::format("{:.0f} s", seconds);
  if (seconds < 2 * hour) return fmt::format("{:.0f} min", seconds / minute);
  return fmt::format("{:.1f} h", seconds / hour);
}

void RunLog::step(const path::StepReport& r, const Step& step, const std::vector<PointRow>& points) {
  if (!out_) return;
  line(fmt::format("{:>5} {:>5} {:>10.3e} {:>13.6g} {:>10.3e} {:>10.2e} {:>4} {:>4} {:>7} {:>7} {:>8.2f}",
                   r.step, settings_.series() ? fmt::format("{}", r.order) : "", r.radius, r.lambdaEnd,
                   r.length, r.residual, r.cutBacks, r.corrections, step.contacts, step.changes,
                   step.seconds));
  for (const PointRow& point : points)
    if (const std::string text = describe(point, monitors_); !text.empty()) line(kIndent + text);
  if (settings_.branches != path::Follow::none)
    for (const path::CriticalPoint& p : r.criticalPoints)
      if (p.tangents.empty())
        line(fmt::format(
            "{}the directions of the branches at load factor {:.10g} are not known, none is followed",
            kIndent, p.state.lambda));
  if (r.jump > 0) line(fmt::format("{}forces jump by {:.2g} at a border of patches", kIndent, r.jump));
  if (r.unexplained > 0)
    line(fmt::format("{}{} eigenvalue(s) changed sign at a place not found", kIndent, r.unexplained));
  if (r.uncounted && !uncounted_)
    line(fmt::format(
        "{}the number of unstable eigenvalues at its end is not known: {} are not seen from this "
        "step on, until it is",
        kIndent, settings_.hopf ? "Hopf points (hopf_eigenvalues)" : "points of two eigenvalues"));
  uncounted_ = r.uncounted;
  printed_ = step.seconds;
  tellTimeLeft(r, step);
}

void RunLog::search(int found, int wanted, double seconds) {
  constexpr double patience = 5;  // s
  if (!out_ || seconds - printed_ < patience) return;
  printed_ = seconds;
  line(fmt::format(
      "{}locating bifurcation points: {} eigenvalue(s) changed sign, the places of {} are found, {:.2f} s",
      kIndent, wanted, found, seconds));
}

void RunLog::tellTimeLeft(const path::StepReport& report, const Step& step) {
  constexpr std::size_t rateOf = 6;  // places: five steps
  constexpr double often = 10;       // s
  Place here{step.seconds, {report.lambdaEnd, report.pathLengthEnd}};
  here.values.insert(here.values.end(), step.monitors.begin(), step.monitors.end());
  last_.push_back(std::move(here));
  if (last_.size() > rateOf) last_.pop_front();
  if (last_.size() < rateOf || step.seconds - estimated_ < often || !report.next.stop.empty()) return;
  if (const std::string text = timeLeft(); !text.empty()) {
    estimated_ = step.seconds;
    line(kIndent + text);
  }
}

/// At the rate of the last steps, to the stop that would be reached first; empty where none is approached
/// steadily. Numbers of limit or bifurcation points say nothing of when.
std::string RunLog::timeLeft() const {
  double least = std::numeric_limits<double>::infinity();
  std::string what;
  const auto offer = [&](std::size_t quantity, double target, const std::string& name) {
    const bool grows = last_.back().values[quantity] > last_.front().values[quantity];
    for (std::size_t i = 1; i < last_.size(); ++i)
      if ((last_[i].values[quantity] > last_[i - 1].values[quantity]) != grows) return;
    const double gone = last_.back().values[quantity] - last_.front().values[quantity];
    const double left =
        (target - last_.back().values[quantity]) / gone * (last_.back().seconds - last_.front().seconds);
    if (!(left > 0) || left >= least) return;
    least = left;
    what = fmt::format("{} {:g}", name, target);
  };
  const deck::Stop& stop = settings_.stop;
  for (const double value : stop.loadFactors) offer(0, value, "load factor");
  if (stop.pathLength) offer(1, *stop.pathLength, "path length");
  for (const auto& [name, values] : stop.monitors) {
    const auto at = std::find(monitors_.begin(), monitors_.end(), name);
    if (at == monitors_.end()) continue;
    for (const double value : values) offer(2 + (at - monitors_.begin()), value, name);
  }
  if (what.empty()) return {};
  return fmt::format("about {} to {} at the rate of the last {} steps{}", inWords(least), what,
                     last_.size() - 1, settings_.branches == path::Follow::none ? "" : ", on this branch");
}

}  // namespace atrapos
