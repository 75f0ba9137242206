#include "report/ReportTools.hpp"

#include <array>
#include <cmath>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <vector>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "report/ReportShape.hpp"
#include "report/Surface.hpp"

namespace atrapos {
namespace {

using Vector3 = std::array<double, 3>;
using Places = std::vector<Vector3>;

Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Vector3 unit(const Vector3& v) {
  const double size = std::sqrt(dot(v, v));
  return {v[0] / size, v[1] / size, v[2] / size};
}

/// The place that is farthest by this measure.
template <class Measure>
std::size_t farthest(const Places& places, const Measure& measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (measure(places[i]) > measure(places[best])) best = i;
  return best;
}

/// Three places far from one line, by which a rigid motion is known.
struct Three {
  std::size_t a = 0, b = 0, c = 0;

  explicit Three(const Places& x) {
    b = farthest(x, [&](const Vector3& p) { return dot(minus(p, x[a]), minus(p, x[a])); });
    c = farthest(x, [&](const Vector3& p) {
      const Vector3 area = cross(minus(x[b], x[a]), minus(p, x[a]));
      return dot(area, area);
    });
  }
  std::array<Vector3, 3> frame(const Places& x) const {
    const Vector3 e1 = unit(minus(x[b], x[a])), e3 = unit(cross(e1, minus(x[c], x[a])));
    return {e1, cross(e3, e1), e3};
  }
};

/// [R00, R01, R02, R10, ..., R22, shift]: takes places at rest to others.
std::vector<float> motionOf(const Places& rest, const Places& moved) {
  const Three three(rest);
  const auto from = three.frame(rest), to = three.frame(moved);
  double turn[3][3];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      turn[i][j] = 0;
      for (int k = 0; k < 3; ++k) turn[i][j] += to[k][i] * from[k][j];
    }
  std::vector<float> motion;
  for (const auto& row : turn)
    for (const double entry : row) motion.push_back(static_cast<float>(entry));
  for (int i = 0; i < 3; ++i)
    motion.push_back(static_cast<float>(moved[three.a][i] - turn[i][0] * rest[three.a][0] -
                                        turn[i][1] * rest[three.a][1] - turn[i][2] * rest[three.a][2]));
  return motion;
}

/// One tool's surface: that of a block.
struct Part {
  std::string name;
  Surface surface;
  Places rest;
};

std::vector<Part> partsOf(const fem::Mesh& mesh) {
  std::vector<Part> parts;
  for (const fem::Block& block : mesh.blocks) {
    fem::Mesh own;
    own.dimension = mesh.dimension;
    own.coordinates = mesh.coordinates;
    own.blocks = {block};
    Part part{block.name, surfaceOf(own), {}};
    for (const int node : part.surface.nodes) {
      const double* const x = &mesh.coordinates[3 * static_cast<std::size_t>(node)];
      part.rest.push_back({x[0], x[1], x[2]});
    }
    parts.push_back(std::move(part));
  }
  return parts;
}

Places movedOf(const Part& part, const std::array<std::vector<double>, 3>& u) {
  Places moved = part.rest;
  for (std::size_t i = 0; i < moved.size(); ++i)
    for (int c = 0; c < 3; ++c) moved[i][c] += u[c][part.surface.nodes[i]];
  return moved;
}

}  // namespace

nlohmann::json toolsOf(const std::string& file, int states) {
  if (!std::filesystem::exists(file)) return nullptr;
  const exodus::ResultReader results(file);
  if (results.numSteps() != states) return nullptr;  // of an earlier part of the run
  const std::vector<Part> parts = partsOf(exodus::readMesh(file));
  nlohmann::json tools{{"surfaces", nlohmann::json::array()}, {"motions", nlohmann::json::array()}};
  for (const Part& part : parts) {
    std::vector<float> positions;
    for (const Vector3& x : part.rest)
      for (const double c : x) positions.push_back(static_cast<float>(c));
    tools["surfaces"].push_back({{"name", part.name},
                                 {"positions", base64(positions)},
                                 {"triangles", base64(part.surface.triangles)}});
  }
  for (int step = 0; step < states; ++step) {
    const std::array<std::vector<double>, 3> u{results.nodal(step, "displ_x"), results.nodal(step, "displ_y"),
                                               results.nodal(step, "displ_z")};
    std::vector<float> motions;
    for (const Part& part : parts) {
      const auto motion = motionOf(part.rest, movedOf(part, u));
      motions.insert(motions.end(), motion.begin(), motion.end());
    }
    tools["motions"].push_back(base64(motions));
  }
  return tools;
}

}  // namespace atrapos
