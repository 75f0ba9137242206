#include "atrapos/fem/Loads.hpp"

namespace atrapos::fem {
namespace {

/// force += sum over points of weight N^T density(entity, point).
template <class Density>
void integrate(const PointSet& p, const Density& density, std::vector<double>& force) {
  for (int e = 0; e < p.numEntities; ++e)
    for (int q = 0; q < p.pointsPerEntity; ++q) {
      const std::size_t point = static_cast<std::size_t>(e) * p.pointsPerEntity + q;
      const std::array<double, 3> f = density(point);
      for (int n = 0; n < p.nodesPerEntity; ++n)
        for (int i = 0; i < 3; ++i)
          force[3 * p.nodes[static_cast<std::size_t>(e) * p.nodesPerEntity + n] + i] +=
              p.weights[point] * p.shape[point * p.nodesPerEntity + n] * f[i];
    }
}

}  // namespace

void addNodalLoad(const std::vector<int>& nodes, const std::array<double, 3>& perNode,
                  std::vector<double>& force) {
  for (int n : nodes)
    for (int i = 0; i < 3; ++i) force[3 * n + i] += perNode[i];
}

void addTraction(const Mesh& mesh, const SideSet& set, const std::array<double, 3>& traction,
                 std::vector<double>& force) {
  addTraction(facePoints(mesh, set, loadDegree), traction, force);
}

void addTraction(const std::vector<PointSet>& faces, const std::array<double, 3>& traction,
                 std::vector<double>& force) {
  for (const PointSet& p : faces)
    integrate(
        p, [&](std::size_t) { return traction; }, force);
}

void addSurfaceForce(const Mesh& mesh, const SideSet& set, const std::array<double, 3>& total,
                     std::vector<double>& force) {
  const double area = areaOf(mesh, set);
  addTraction(mesh, set, {total[0] / area, total[1] / area, total[2] / area}, force);
}

void addPressure(const Mesh& mesh, const SideSet& set, double pressure, std::vector<double>& force) {
  addPressure(facePoints(mesh, set, loadDegree), pressure, force);
}

void addPressure(const std::vector<PointSet>& faces, double pressure, std::vector<double>& force) {
  for (const PointSet& p : faces)
    integrate(
        p,
        [&](std::size_t point) {
          const double* n = &p.normals[3 * point];
          return std::array<double, 3>{-pressure * n[0], -pressure * n[1], -pressure * n[2]};
        },
        force);
}

void addBodyForce(const Mesh& mesh, const Block& block, const std::array<double, 3>& perVolume,
                  std::vector<double>& force) {
  // Degree 4 integrates the quadratic shape functions exactly on elements with straight edges.
  integrate(
      volumeValuePoints(mesh, block, tabulate(block.topology, 4)), [&](std::size_t) { return perVolume; },
      force);
}

double areaOf(const Mesh& mesh, const SideSet& set) { return areaOf(facePoints(mesh, set, loadDegree)); }

double areaOf(const std::vector<PointSet>& faces) {
  double area = 0;
  for (const PointSet& p : faces)
    for (double w : p.weights) area += w;
  return area;
}

}  // namespace atrapos::fem
