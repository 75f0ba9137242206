#include "atrapos/contact/PatchSet.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

namespace atrapos::contact {
namespace {

constexpr int kMaxSamples = 13;  ///< of a patch each way

/// The law's data of a point that is over no patch.
constexpr std::array<double, 3> overNothing{-1, 0, 0};

double length(const double* a) { return std::sqrt(a[0] * a[0] + a[1] * a[1] + a[2] * a[2]); }
double distance(const PatchPoint& s, const double* x) { return std::sqrt(2 * SquaredDistance(s, x).value); }

}  // namespace

PatchSet::PatchSet(std::vector<BezierPatch> patches, bool reversed, double thickness)
    : thickness_(thickness) {
  if (!(thickness > 0))
    detail::refuse("patch surface", "thickness must be > 0, got " + detail::shown(thickness));
  if (patches.empty()) detail::refuse("patch surface", "needs at least one patch, got none");
  for (const BezierPatch& patch : patches) {
    patch.validate();
    for (int d = 0; d < 2; ++d) degree_[d] = std::max(degree_[d], patch.degree[d]);
    for (const double w : patch.weights) rational_ = rational_ || w != 1;
  }
  numSamples_ = std::min(2 * std::max(degree_[0], degree_[1]) + 3, kMaxSamples);
  double low[3], high[3];
  std::fill_n(low, 3, std::numeric_limits<double>::infinity());
  std::fill_n(high, 3, -std::numeric_limits<double>::infinity());
  for (const BezierPatch& source : patches) {
    Patch patch;
    patch.coefficients = source.coefficients(degree_);
    for (int c = 0; c < 3; ++c) {
      patch.low[c] = patch.high[c] = source.points[0][c];
      for (const auto& point : source.points) {
        patch.low[c] = std::min(patch.low[c], point[c]);
        patch.high[c] = std::max(patch.high[c], point[c]);
      }
      low[c] = std::min(low[c], patch.low[c]);
      high[c] = std::max(high[c], patch.high[c]);
    }
    patches_.push_back(std::move(patch));
  }
  for (int c = 0; c < 3; ++c) size_ = std::max(size_, high[c] - low[c]);
  sample();
  findSharedEdges();
  makeTool(reversed);
}

PatchPoint PatchSet::point(int patch, const double* t) const {
  return PatchPoint::of(patches_[patch].coefficients.data(), degree_[0], degree_[1], t[0], t[1]);
}

void PatchSet::sample() {
  for (int n = 0; n < numPatches(); ++n) {
    Patch& patch = patches_[n];
    std::vector<PatchPoint> points;
    double slope[2] = {0, 0};
    for (int a = 0; a < numSamples_; ++a)
      for (int b = 0; b < numSamples_; ++b) {
        const double t[2] = {-1 + 2.0 * a / (numSamples_ - 1), -1 + 2.0 * b / (numSamples_ - 1)};
        const PatchPoint& s = points.emplace_back(point(n, t));
        patch.samples.push_back({s.S[0], s.S[1], s.S[2]});
        slope[0] = std::max(slope[0], length(s.S1));
        slope[1] = std::max(slope[1], length(s.S2));
      }
    requireNormal(n, points);
    // Half the way between samples, with slopes between them that are half as large again.
    patch.reach = 1.5 * (slope[0] + slope[1]) / (numSamples_ - 1);
  }
}

void PatchSet::requireNormal(int patch, const std::vector<PatchPoint>& samples) const {
  double largest = 0;
  for (const PatchPoint& s : samples)
    for (int c = 0; c < 3; ++c) largest = std::max({largest, std::fabs(s.S1[c]), std::fabs(s.S2[c])});
  for (const PatchPoint& s : samples) {
    double N[3];
    s.cross(N);
    // Relative to the longest tangent of the patch: a side that shrinks to a point has none.
    if (!(length(N) > 1e-9 * largest * largest))
      detail::refuse("patch surface", "the normal of patch " + std::to_string(patch + 1) + " vanishes at (" +
                                          detail::shown(s.S[0]) + ", " + detail::shown(s.S[1]) + ", " +
                                          detail::shown(s.S[2]) +
                                          "): cut the surface there or move control points that coincide");
  }
}

/// Projected Newton's method from (t1, t2) inside [-1, 1]^2.
Foot PatchSet::descend(int patch, double t1, double t2, const double* x) const {
  Foot foot{patch, {t1, t2}, 0};
  PatchPoint s = point(patch, foot.t);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const SquaredDistance f(s, x);
    bool held[2];
    for (int d = 0; d < 2; ++d) held[d] = (foot.t[d] <= -1 && f.g[d] > 0) || (foot.t[d] >= 1 && f.g[d] < 0);
    double dt[2], moved = 0;
    f.step(held, dt);
    const auto moves = [&](double share, const auto& nearer) {
      double t[2];
      for (int d = 0; d < 2; ++d) t[d] = std::clamp(foot.t[d] + share * dt[d], -1.0, 1.0);
      const PatchPoint trial = point(patch, t);
      if (!nearer(SquaredDistance(trial, x))) return false;
      moved = std::fabs(t[0] - foot.t[0]) + std::fabs(t[1] - foot.t[1]);
      std::copy_n(t, 2, foot.t);
      s = trial;
      return true;
    };
    const auto falls = [&](const SquaredDistance& at) { return at.value < f.value; };
    // Around the foot the distance is flat: half of its digits tell where it is least, all of the slope's do.
    const auto slope = [&](const SquaredDistance& at) {
      return (held[0] ? 0 : std::fabs(at.g[0])) + (held[1] ? 0 : std::fabs(at.g[1]));
    };
    const auto levels = [&](const SquaredDistance& at) { return slope(at) < slope(f); };
    constexpr double close = 1e-4, there = 1e-13;
    const double asked = std::fabs(dt[0]) + std::fabs(dt[1]);
    bool found = f.convex() && asked < close && moves(1, levels);
    if (asked < there) break;
    for (double share = 1; share > 1e-6 && !found; share /= 2) found = moves(share, falls);
    if (moved < there) break;
  }
  foot.distance = distance(s, x);
  const SquaredDistance f(s, x);
  for (int d = 0; d < 2; ++d)
    if (std::fabs(foot.t[d]) >= 1)
      foot.beyond = std::max(foot.beyond, -f.g[d] * foot.t[d] / std::sqrt(f.metric[2 * d]));
  return foot;
}

/// The nearest point of the patch; one at an infinite distance where it is farther than the limit.
Foot PatchSet::nearestOn(int patch, const double* x, double limit) const {
  // From the best sample and from the best one that is not its neighbour.
  const Patch& own = patches_[patch];
  const int n = numSamples_;
  std::array<double, kMaxSamples * kMaxSamples> squares;
  for (int i = 0; i < n * n; ++i) {
    squares[i] = 0;
    for (int c = 0; c < 3; ++c) squares[i] += (x[c] - own.samples[i][c]) * (x[c] - own.samples[i][c]);
  }
  const int best =
      static_cast<int>(std::min_element(squares.begin(), squares.begin() + n * n) - squares.begin());
  if (std::sqrt(squares[best]) - own.reach > limit) {
    Foot far;
    far.distance = std::numeric_limits<double>::infinity();
    return far;
  }
  int other = -1;
  for (int i = 0; i < n * n; ++i) {
    const bool neighbour = std::abs(i / n - best / n) <= 1 && std::abs(i % n - best % n) <= 1;
    if (!neighbour && (other < 0 || squares[i] < squares[other])) other = i;
  }
  const auto from = [&](int i) {
    return descend(patch, -1 + 2.0 * (i / n) / (n - 1), -1 + 2.0 * (i % n) / (n - 1), x);
  };
  const Foot first = from(best);
  // What is not around the best sample is too far.
  if (other < 0 || first.distance < std::sqrt(squares[other]) - own.reach) return first;
  const Foot second = from(other);
  return second.distance < first.distance ? second : first;
}

double PatchSet::boxDistance(const Patch& patch, const double* x) const {
  double square = 0;
  for (int c = 0; c < 3; ++c) {
    const double d = std::max({patch.low[c] - x[c], x[c] - patch.high[c], 0.0});
    square += d * d;
  }
  return std::sqrt(square);
}

/// Whether x pulls the foot over an edge that no patch continues.
bool PatchSet::beyondEdge(const Foot& foot, const double* x) const {
  if (foot.distance <= 1e-12 * size_) return false;
  const PatchPoint s = point(foot.patch, foot.t);
  const SquaredDistance f(s, x);
  for (int d = 0; d < 2; ++d) {
    const double tangent = std::sqrt(f.metric[2 * d]);
    // Cosine of the angle to the tangent; Newton's method leaves it at about 1e-8 or less at a true foot.
    const double pull = -f.g[d] / (foot.distance * tangent);
    if (foot.t[d] <= -1 && pull < -1e-7 && !patches_[foot.patch].shared[2 * d]) return true;
    if (foot.t[d] >= 1 && pull > 1e-7 && !patches_[foot.patch].shared[2 * d + 1]) return true;
  }
  return false;
}

Foot PatchSet::nearest(const double* x) const {
  Foot best = nearestPoint(x);
  if (best.patch >= 0 && beyondEdge(best, x)) best.patch = -1;
  return best;
}

/// The patch that comes behind `last` in the order of distances to boxes, and its distance; -1: none.
std::pair<int, double> PatchSet::nextByBox(const double* x, std::pair<int, double> last) const {
  std::pair<int, double> next{-1, std::numeric_limits<double>::infinity()};
  for (int n = 0; n < numPatches(); ++n) {
    const double bound = boxDistance(patches_[n], x);
    const bool behind = bound > last.second || (bound == last.second && n > last.first);
    if (behind && bound < next.second) next = {n, bound};
  }
  return next;
}

/// The nearest point of all patches, edges included; `known`: that of one of them.
Foot PatchSet::nearestPoint(const double* x, const Foot* known) const {
  const double same = 1e-12 * size_;
  Foot best;
  best.distance = std::numeric_limits<double>::infinity();
  for (auto [n, bound] = nextByBox(x, {-1, 0}); n >= 0; std::tie(n, bound) = nextByBox(x, {n, bound})) {
    const double limit = known ? std::min(known->distance, best.distance) : best.distance;
    if (bound > limit) break;
    const Foot foot = known && known->patch == n ? *known : nearestOn(n, x, limit + 2 * same);
    // Beside a border the feet on both of its patches are equally near but for the square of the way to it:
    // the one that x does not pull over its border. On it, the first.
    const double nearer = best.distance - foot.distance;
    const bool equal = std::fabs(nearer) <= same;
    if (equal ? foot.beyond < best.beyond - 1e-14 * size_ : nearer > 0) best = foot;
  }
  return best;
}

/// Parameters this far beyond a border count as on it: the corrections of states on a border are of this size
/// at most, and the gaps of patches that continue each other differ by its square.
constexpr double kOnBorder = 1e-4;

bool PatchSet::onEdge(const Foot& foot) const {
  for (int d = 0; d < 2; ++d)
    for (const int side : {0, 1})
      if ((side == 0 ? -foot.t[d] : foot.t[d]) >= 1 - kOnBorder && !patches_[foot.patch].shared[2 * d + side])
        return true;
  return false;
}

std::array<double, 3> PatchSet::locate(const double* x, int preferred) const {
  if (preferred < 0 || preferred >= numPatches()) {
    const Foot any = nearestPoint(x);
    return any.patch >= 0 && preferred == -1 && onEdge(any) ? overNothing : dataOf(any, x);
  }
  const Foot own = nearestOn(preferred, x), any = nearestPoint(x, &own);
  const double trial[3] = {static_cast<double>(preferred), own.t[0], own.t[1]};
  double y[6];
  tool_.start(x, trial, y);
  const bool near = std::max(std::fabs(y[4]), std::fabs(y[5])) <= 1 + kOnBorder &&
                    own.distance <= any.distance + kOnBorder * size_ && gapAt(own, x) >= -thickness_;
  if (!near) return dataOf(any, x);
  return {trial[0], y[4], y[5]};
}

std::array<double, 3> PatchSet::locate(const double* x) const { return dataOf(nearestPoint(x), x); }

/// Of a point at x whose nearest point of all is this.
std::array<double, 3> PatchSet::dataOf(const Foot& foot, const double* x) const {
  if (foot.patch < 0 || beyondEdge(foot, x) || gapAt(foot, x) < -thickness_) return overNothing;
  return {static_cast<double>(foot.patch), foot.t[0], foot.t[1]};
}

double PatchSet::gapAt(const Foot& foot, const double* x) const {
  const PatchPoint s = point(foot.patch, foot.t);
  double N[3], side = 0;
  s.cross(N);
  for (int c = 0; c < 3; ++c) side += (x[c] - s.S[c]) * N[c];
  return side * tool_.orientation < 0 ? -foot.distance : foot.distance;
}

PatchSet::Following PatchSet::follow(const double* x, double* data) const {
  Following result;
  if (data[0] < 0) {
    const Foot foot = nearest(x);
    if (foot.patch < 0) return result;
    const double trial[3] = {static_cast<double>(foot.patch), foot.t[0], foot.t[1]};
    double y[6];
    tool_.start(x, trial, y);
    if (y[0] < 0)
      return result;  // from behind: the point went round the edge, it has not been pushed through
    std::copy_n(trial, 3, data);
    result.event = Event::Reaches;
    return result;
  }
  double y[6];
  tool_.start(x, data, y);
  const double gap = y[0];
  for (int crossing = 0; crossing < 4; ++crossing) {
    const double beyond = std::max(std::fabs(y[4]), std::fabs(y[5])) - 1;
    if (beyond <= 1e-9) break;  // on the patch, or on its border up to the accuracy of the search
    const double place[3] = {x[0] - y[0] * y[1], x[1] - y[0] * y[2], x[2] - y[0] * y[3]};
    const Foot foot = nearest(place);
    if (foot.patch < 0) {
      data[0] = -1;
      data[1] = data[2] = 0;
      result.event = Event::Leaves;
      return result;
    }
    const bool same = foot.patch == static_cast<int>(data[0]) &&
                      std::fabs(foot.t[0] - y[4]) + std::fabs(foot.t[1] - y[5]) < 0.5;
    if (same) break;  // nothing else continues it better: a ridge, or beyond the border by rounding
    data[0] = foot.patch;
    data[1] = foot.t[0];
    data[2] = foot.t[1];
    result.event = Event::Crosses;
    tool_.start(x, data, y);
  }
  data[1] = y[4];
  data[2] = y[5];
  result.mismatch = std::fabs(y[0] - gap);
  return result;
}

std::string PatchSet::ambiguity(const double* x) const {
  const Foot foot = nearest(x);
  if (foot.patch < 0) return {};
  const SquaredDistance f(point(foot.patch, foot.t), x);
  const double metric = f.metric[0] * f.metric[2] - f.metric[1] * f.metric[1];
  if (f.H[0] * f.H[2] - f.H[1] * f.H[1] < 1e-8 * metric)
    return "lies at or beyond a centre of curvature of the surface";
  const PatchPoint s = point(foot.patch, foot.t);
  for (int n = 0; n < numPatches(); ++n) {
    if (boxDistance(patches_[n], x) > foot.distance * (1 + 1e-9)) continue;
    const Foot other = nearestOn(n, x);
    if (other.distance <= foot.distance * (1 + 1e-9) &&
        distance(point(n, other.t), s.S) > 1e-3 * foot.distance)
      return "is equally near to two places of the surface";
  }
  return {};
}

void PatchSet::findSharedEdges() {
  const double tolerance = 1e-5 * size_;  // modellers leave gaps of 1e-6 or so between faces that meet
  for (int n = 0; n < numPatches(); ++n)
    for (int edge = 0; edge < 4; ++edge) {
      bool shared = true;
      for (const double place : {-0.6, 0.1, 0.7}) {
        double t[2];
        t[edge / 2] = edge % 2 == 0 ? -1 : 1;
        t[1 - edge / 2] = place;
        const PatchPoint s = point(n, t);
        bool met = false;
        for (int m = 0; m < numPatches() && !met; ++m)
          met =
              m != n && boxDistance(patches_[m], s.S) <= tolerance && nearestOn(m, s.S).distance <= tolerance;
        for (const double sign : {1.0, -1.0}) {  // a patch that closes on itself
          double opposite[2];
          opposite[edge / 2] = -t[edge / 2];
          opposite[1 - edge / 2] = sign * place;
          met = met || distance(point(n, opposite), s.S) <= tolerance;
        }
        shared = shared && met;
      }
      patches_[n].shared[edge] = shared;
    }
}

void PatchSet::makeTool(bool reversed) {
  const std::size_t stride = patches_[0].coefficients.size();
  Kokkos::View<double*> all("patches", stride * (patches_.size() + 1));
  auto host = Kokkos::create_mirror_view(all);
  for (std::size_t n = 0; n < patches_.size(); ++n)
    for (std::size_t i = 0; i < stride; ++i) host(n * stride + i) = patches_[n].coefficients[i];
  double* plane = &host(patches_.size() * stride);
  std::fill_n(plane, stride, 0.0);
  plane[3] = 1;
  plane[(degree_[1] + 1) * 4] = size_;  // t1 along x
  plane[4 + 1] = size_;                 // t2 along y
  Kokkos::deep_copy(all, host);
  tool_.numPatches = numPatches();
  tool_.scale = 0;
  std::copy(degree_.begin(), degree_.end(), tool_.degree);
  tool_.rational = rational_;
  tool_.orientation = reversed ? -1 : 1;
  for (const Patch& patch : patches_)
    for (int c = 0; c < 3; ++c) tool_.scale = std::max(tool_.scale, patch.high[c] - patch.low[c]);
  tool_.coefficients = all;
}

}  // namespace atrapos::contact
