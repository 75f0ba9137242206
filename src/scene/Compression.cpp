#include "scene/Compression.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include "scene/Sets.hpp"

namespace atrapos {
namespace {

// Under uniaxial stress the law's tangent at the stretch s is (3 s^2 - 1)/2 of Young's modulus: 28 % too soft
// at 0.9.
constexpr double large = 0.1;

/// Nodes of the blocks of Saint Venant-Kirchhoff, and the smallest of their moduli.
struct Body {
  std::set<int> nodes;
  double youngsModulus = 0;
};

Body bodyOf(const deck::Deck& deck, const fem::Mesh& mesh) {
  Body body;
  for (const deck::Material& material : deck.materials) {
    const auto* law = std::get_if<deck::SaintVenantKirchhoff>(&material.law);
    if (law == nullptr) continue;
    body.youngsModulus =
        body.nodes.empty() ? law->youngsModulus : std::min(body.youngsModulus, law->youngsModulus);
    for (const std::string& name : material.blocks) {
      const auto& nodes = mesh.blocks[fem::findBlock(mesh, name)].nodes;
      body.nodes.insert(nodes.begin(), nodes.end());
    }
  }
  return body;
}

/// A support's plane across an axis, and where the load factor takes it.
struct Plane {
  std::string support;
  double place = 0, displacement = 0;
};

/// The supports that prescribe a component all over a plane across it, on the body.
std::vector<Plane> planesAcross(int axis, const deck::Deck& deck, const fem::Mesh& mesh, const Body& body,
                                double loadFactor) {
  std::vector<Plane> planes;
  for (const deck::Support& support : deck.supports) {
    const auto& prescribed = support.components[static_cast<std::size_t>(axis)];
    if (!prescribed) continue;
    const std::vector<int> nodes = nodesOf(mesh, support.set);
    const auto place = [&](int n) { return mesh.coordinates[3 * static_cast<std::size_t>(n) + axis]; };
    const double first = place(nodes.front());
    const bool flat = std::all_of(nodes.begin(), nodes.end(), [&](int n) {
      return body.nodes.count(n) > 0 && std::abs(place(n) - first) <= 1e-9 * (std::abs(first) + 1);
    });
    if (flat)
      planes.push_back({support.name, first, prescribed->value + loadFactor * prescribed->perLoadFactor});
  }
  return planes;
}

}  // namespace

std::vector<std::string> largeCompression(const deck::Deck& deck, const fem::Mesh& mesh) {
  const Body body = bodyOf(deck, mesh);
  if (body.nodes.empty()) return {};
  std::vector<double> factors = deck.path.stop.loadFactors;
  if (factors.empty()) factors = {1};
  constexpr const char* advice =
      "where saint_venant_kirchhoff is more than a quarter too soft, and collapses at 42 %; neo_hookean does "
      "not";
  std::vector<std::string> lines;
  for (int axis = 0; axis < mesh.dimension; ++axis)
    for (const double factor : factors) {
      const auto planes = planesAcross(axis, deck, mesh, body, factor);
      for (const Plane& a : planes)
        for (const Plane& b : planes) {
          const double length = b.place - a.place, change = b.displacement - a.displacement;
          if (!(length > 0) || !(change < -large * length)) continue;
          lines.push_back(
              fmt::format("supports/{}: comes nearer to supports/{} by {:.0f} % at load factor {:g}, {}",
                          b.support, a.support, -100 * change / length, factor, advice));
        }
    }
  for (const deck::Load& load : deck.loads) {
    const auto* surface = std::get_if<deck::SurfaceLoad>(&load.load);
    if (surface == nullptr || surface->kind != deck::SurfaceLoad::Kind::Pressure) continue;
    const std::vector<int> nodes = nodesOf(mesh, surface->set);
    if (std::none_of(nodes.begin(), nodes.end(), [&](int n) { return body.nodes.count(n) > 0; })) continue;
    double most = 0;
    for (const double factor : factors)
      most = std::max(most, load.constant ? surface->pressure : factor * surface->pressure);
    if (most > large * body.youngsModulus)
      lines.push_back(fmt::format("loads/{}: a pressure of {:g} is {:.0f} % of Young's modulus, {}",
                                  load.name, most, 100 * most / body.youngsModulus, advice));
  }
  return lines;
}

}  // namespace atrapos
