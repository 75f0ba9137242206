#include "report/ReportTools.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>

#include "atrapos/exodus/MeshFile.hpp"
#include "report/ReportShape.hpp"
#include "scene/Vectors.hpp"

namespace atrapos {
namespace {

using namespace vectors;

/// The place that is farthest by this measure.
template <class Measure>
std::size_t farthest(const std::vector<Vector3>& places, const Measure& measure) {
  std::size_t best = 0;
  for (std::size_t i = 1; i < places.size(); ++i)
    if (measure(places[i]) > measure(places[best])) best = i;
  return best;
}

std::array<std::size_t, 3> farFromOneLine(const std::vector<Vector3>& x) {
  const std::size_t b = farthest(x, [&](const Vector3& p) { return length(sum(p, -1, x[0])); });
  const Vector3 line = sum(x[b], -1, x[0]);
  return {0, b, farthest(x, [&](const Vector3& p) { return length(cross(line, sum(p, -1, x[0]))); })};
}

/// Orthonormal, and moves with three places.
std::array<Vector3, 3> frameOf(const std::array<Vector3, 3>& x) {
  const Vector3 e1 = unit(sum(x[1], -1, x[0])), e3 = unit(cross(e1, sum(x[2], -1, x[0])));
  return {e1, cross(e3, e1), e3};
}

/// Appends [R00, R01, R02, R10, ..., R22, shift] of the motion that takes three places to others.
void appendMotion(const std::array<Vector3, 3>& rest, const std::array<Vector3, 3>& moved,
                  std::vector<float>& motions) {
  const auto from = frameOf(rest), to = frameOf(moved);
  Vector3 shift = moved[0];
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) {
      double turn = 0;
      for (int k = 0; k < 3; ++k) turn += to[k][i] * from[k][j];
      motions.push_back(static_cast<float>(turn));
      shift[i] -= turn * rest[0][j];
    }
  for (const double c : shift) motions.push_back(static_cast<float>(c));
}

}  // namespace

std::unique_ptr<ReportTools> ReportTools::of(const std::string& file, int states) {
  if (!std::filesystem::exists(file)) return nullptr;
  std::unique_ptr<ReportTools> tools(new ReportTools(file));
  return tools->results_.numSteps() == states ? std::move(tools) : nullptr;
}

ReportTools::ReportTools(const std::string& file) : results_(file) {
  fem::Mesh mesh = exodus::readMesh(file);
  const std::vector<fem::Block> blocks = std::move(mesh.blocks);
  for (const fem::Block& block : blocks) {
    mesh.blocks = {block};
    Tool tool{block.name, surfaceOf(mesh), {}, {}};
    for (const int node : tool.surface.nodes) {
      const double* const x = &mesh.coordinates[3 * static_cast<std::size_t>(node)];
      tool.rest.push_back({x[0], x[1], x[2]});
    }
    tool.three = farFromOneLine(tool.rest);
    tools_.push_back(std::move(tool));
  }
}

nlohmann::json ReportTools::surfaces() const {
  auto surfaces = nlohmann::json::array();
  for (const Tool& tool : tools_) {
    std::vector<float> positions;
    for (const Vector3& x : tool.rest)
      for (const double c : x) positions.push_back(static_cast<float>(c));
    surfaces.push_back({{"name", tool.name},
                        {"positions", base64(positions)},
                        {"triangles", base64(tool.surface.triangles)}});
  }
  return surfaces;
}

std::string ReportTools::motions(int step) const {
  const std::array<std::vector<double>, 3> u{results_.nodal(step, "displ_x"), results_.nodal(step, "displ_y"),
                                             results_.nodal(step, "displ_z")};
  std::vector<float> motions;
  for (const Tool& tool : tools_) {
    std::array<Vector3, 3> rest, moved;
    for (int i = 0; i < 3; ++i) {
      const auto node = static_cast<std::size_t>(tool.surface.nodes[tool.three[i]]);
      rest[i] = tool.rest[tool.three[i]];
      moved[i] = sum(rest[i], 1, {u[0][node], u[1][node], u[2][node]});
    }
    appendMotion(rest, moved, motions);
  }
  return base64(motions);
}

}  // namespace atrapos
