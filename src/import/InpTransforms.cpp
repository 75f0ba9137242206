#include "import/InpTransforms.hpp"

#include <fmt/format.h>

#include <cmath>

#include "deck/Characters.hpp"

namespace atrapos::importer {
namespace {

using Vector = InpTransforms::Vector;

Vector minus(const Vector& a, const Vector& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector cross(const Vector& a, const Vector& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

/// Of length 1, without what it has along `axis`; what it is without that is less than rounding: nothing
/// left.
Vector unitAcross(Vector v, const Vector& axis, const InpPlace& place, const char* what) {
  const double whole = std::sqrt(dot(v, v)), along = dot(v, axis);
  for (std::size_t d = 0; d < 3; ++d) v[d] -= along * axis[d];
  const double length = std::sqrt(dot(v, v));
  if (!(length > 1e-9 * whole)) place.fail(fmt::format("*TRANSFORM: {}", what));
  for (double& x : v) x /= length;
  return v;
}

/// Components of 1e-15 are rounding of cosines.
Vector plain(Vector v) {
  for (double& x : v)
    if (std::abs(x) < 1e-12) x = 0;
  return v;
}

}  // namespace

InpTransforms::InpTransforms(const InpModel& model) {
  constexpr std::size_t most = 1000;  // each goes through its nodes
  if (model.transforms.size() > most)
    model.transforms[most]->place.fail(fmt::format("*TRANSFORM: more than {}, which is the most", most));
  for (const InpCard* card : model.transforms) add(model, *card);
}

Vector InpTransforms::inModel(int node, const Vector& v) const {
  const Axes* const axes = find(node);
  if (axes == nullptr) return v;
  Vector sum{};
  for (std::size_t k = 0; k < 3; ++k)
    for (std::size_t d = 0; d < 3; ++d) sum[d] += v[k] * (*axes)[k][d];
  return sum;
}

void InpTransforms::add(const InpModel& model, const InpCard& card) {
  const std::string* const set = card.find("NSET");
  if (set == nullptr) card.place.fail("*TRANSFORM: has no NSET");
  const std::string type = card.word("TYPE", "R");
  if (type != "R" && type != "C")
    card.place.fail(fmt::format("*TRANSFORM, TYPE={}: expected R or C", deck::shortened(type)));
  InpLine line;
  if (!InpLines(card).next(line)) card.place.fail("*TRANSFORM: has no line with two points");
  Vector points[2];
  for (std::size_t i = 0; i < 6; ++i)
    points[i / 3][i % 3] = line.at(i).empty() ? 0 : inpNumber(line.at(i), line.place, "coordinate");
  const auto [a, b] = std::pair(points[0], points[1]);
  const std::vector<int> nodes = inpNodes(model, *set, card.place);
  if (nodes.empty()) return;
  if (type == "R") {  // a on the x axis, b in the plane of x and y
    const Vector x = unitAcross(a, {}, line.place, "its first point is the origin");
    const Vector y = unitAcross(b, x, line.place, "its points and the origin are on one line");
    for (const int node : nodes) axes_[node] = {plain(x), plain(y), plain(cross(x, y))};
    return;
  }
  const Vector axis = unitAcross(minus(b, a), {}, line.place, "its points are the same");
  std::size_t across = 0;  // the coordinate axis that is most so
  for (std::size_t d = 1; d < 3; ++d)
    if (std::abs(axis[d]) < std::abs(axis[across])) across = d;
  Vector other{};
  other[across] = 1;
  for (const int node : nodes) {
    const double* const X = &model.coordinates[3 * static_cast<std::size_t>(node)];
    const Vector away = minus({X[0], X[1], X[2]}, a);
    const double along = dot(away, axis);
    const Vector off = minus(away, {along * axis[0], along * axis[1], along * axis[2]});
    // On the axis any two directions across it.
    const bool onAxis = dot(off, off) <= 1e-18 * dot(away, away);
    const Vector radial = unitAcross(onAxis ? other : off, axis, line.place, "a node has no radius");
    axes_[node] = {plain(radial), plain(cross(axis, radial)), plain(axis)};
  }
}

}  // namespace atrapos::importer
