#include "output/ToolShapes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <limits>

#include "atrapos/exodus/MeshFile.hpp"
#include "atrapos/exodus/MeshPart.hpp"
#include "atrapos/exodus/ResultReader.hpp"
#include "atrapos/exodus/ResultWriter.hpp"
#include "deck/Stages.hpp"
#include "machine/OutputFile.hpp"
#include "machine/Ranks.hpp"
#include "output/FieldFiles.hpp"
#include "output/Files.hpp"
#include "scene/DeckTool.hpp"
#include "scene/Vectors.hpp"

namespace atrapos {
namespace {

using namespace vectors;
using PointOf = std::function<Vector3(double, double)>;  ///< of two parameters in [0, 1]

const double kPi = std::acos(-1.0);
constexpr int kRound = 64;   // quadrilaterals around a circle
constexpr int kAlong = 24;   // along an axis, a tube, from pole to pole
constexpr int kOfPatch = 8;  // along each direction of a patch

/// A right-handed frame whose third direction is that of an axis.
struct Frame {
  Vector3 e1{}, e2{}, axis{};
  explicit Frame(const Vector3& along) : axis(unit(along)) {
    int least = 0;
    for (int i = 1; i < 3; ++i)
      if (std::abs(axis[i]) < std::abs(axis[least])) least = i;
    Vector3 other{};
    other[least] = 1;
    e1 = unit(cross(other, axis));
    e2 = cross(axis, e1);
  }
  Vector3 around(double turn) const {
    return sum(sum({}, std::cos(2 * kPi * turn), e1), std::sin(2 * kPi * turn), e2);
  }
};

double diagonal(const Box& box) { return length(sum(box.high, -1, box.low)); }

/// Places along an axis through a point that the box reaches, and a little beyond.
std::pair<double, double> drawnAlong(const Vector3& axis, const Vector3& point, const Box& box) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (int corner = 0; corner < 8; ++corner) {
    Vector3 x{};
    for (int i = 0; i < 3; ++i) x[i] = (corner >> i & 1 ? box.high : box.low)[i] - point[i];
    low = std::min(low, dot(x, axis));
    high = std::max(high, dot(x, axis));
  }
  const double beyond = 0.05 * diagonal(box);
  return {low - beyond, high + beyond};
}

/// n x m quadrilaterals of a surface.
void appendGrid(const PointOf& point, int n, int m, fem::Mesh& mesh) {
  const int first = mesh.numNodes();
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= m; ++j) {
      const Vector3 x = point(i / double(n), j / double(m));
      mesh.coordinates.insert(mesh.coordinates.end(), x.begin(), x.end());
    }
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < m; ++j) {
      const int a = first + i * (m + 1) + j, b = a + m + 1;
      auto& nodes = mesh.blocks.back().nodes;
      nodes.insert(nodes.end(), {a, b, b + 1, a + 1});
    }
}

/// Around an axis, with the radius at each place along it.
void appendRevolved(const Vector3& center, const Vector3& axis, std::pair<double, double> range,
                    const std::function<Vector3(const Vector3&, const Vector3&)>& onto, double radius,
                    fem::Mesh& mesh) {
  const Frame frame(axis);
  appendGrid(
      [&](double s, double turn) {
        const Vector3 foot = sum(center, range.first + s * (range.second - range.first), frame.axis);
        return onto(foot, sum(foot, radius, frame.around(turn)));
      },
      kAlong, kRound, mesh);
}

struct Appender {
  const deck::Tool& tool;
  const Box& box;
  fem::Mesh& mesh;

  void operator()(const deck::PlaneTool& t) const {
    const Frame frame(t.normal);
    const Vector3 middle = sum(sum({}, 0.5, box.low), 0.5, box.high);
    const Vector3 foot = sum(middle, dot(sum(t.point, -1, middle), frame.axis), frame.axis);
    const auto [u0, u1] = drawnAlong(frame.e1, foot, box);
    const auto [v0, v1] = drawnAlong(frame.e2, foot, box);
    appendGrid(
        [&, u0 = u0, u1 = u1, v0 = v0, v1 = v1](double s, double r) {
          return sum(sum(foot, u0 + s * (u1 - u0), frame.e1), v0 + r * (v1 - v0), frame.e2);
        },
        1, 1, mesh);
  }
  void operator()(const deck::CylinderTool& t) const {
    const auto same = [](const Vector3&, const Vector3& x) { return x; };
    appendRevolved(t.center, t.axis, drawnAlong(unit(t.axis), t.center, box), same, t.radius, mesh);
  }
  void operator()(const deck::SphereTool& t) const {
    const Frame frame({0, 0, 1});
    appendGrid(
        [&](double s, double turn) {
          const double polar = kPi * s;
          return sum(sum(t.center, t.radius * std::sin(polar), frame.around(turn)),
                     -t.radius * std::cos(polar), frame.axis);
        },
        kAlong, kRound, mesh);
  }
  void operator()(const deck::ConeTool& t) const {
    const Frame frame(t.axis);
    const double end = std::max(drawnAlong(frame.axis, t.apex, box).second, 0.05 * diagonal(box));
    const double slope = std::tan(t.halfAngle * kPi / 180);
    appendGrid(
        [&](double s, double turn) {
          return sum(sum(t.apex, s * end, frame.axis), slope * s * end, frame.around(turn));
        },
        kAlong, kRound, mesh);
  }
  void operator()(const deck::TorusTool& t) const {
    const Frame frame(t.axis);
    appendGrid(
        [&](double tube, double turn) {
          const double out = t.radius + t.tubeRadius * std::cos(2 * kPi * tube);
          return sum(sum(t.center, out, frame.around(turn)), t.tubeRadius * std::sin(2 * kPi * tube),
                     frame.axis);
        },
        kAlong, kRound, mesh);
  }
  void operator()(const deck::TaperedRollTool& t) const { appendRoll(t.center, t.axis, t.radius); }
  void operator()(const deck::CrownedRollTool& t) const {
    appendRoll(t.center, t.axis, t.coefficients.empty() ? t.radii.front() : t.coefficients.front());
  }
  void operator()(const deck::PatchesTool& t) const {
    for (const contact::BezierPatch& patch : bezierPatches(t)) {
      const std::vector<double> k = patch.coefficients(patch.degree);
      appendGrid(
          [&](double s, double r) {
            const auto [p, q] = patch.degree;
            double x[4] = {0, 0, 0, 0};
            for (int c = 0; c < 4; ++c)
              for (int i = p; i >= 0; --i) {  // Horner's rule in either direction
                double row = 0;
                for (int j = q; j >= 0; --j) row = row * (2 * r - 1) + k[4 * (i * (q + 1) + j) + c];
                x[c] = x[c] * (2 * s - 1) + row;
              }
            return Vector3{x[0] / x[3], x[1] / x[3], x[2] / x[3]};
          },
          kOfPatch, kOfPatch, mesh);
    }
  }

 private:
  /// Of a profile of its own: along rays from the axis to where the gap vanishes.
  void appendRoll(const Vector3& center, const Vector3& axis, double radius) const {
    deck::Tool still = tool;
    still.motion = {};
    const auto rigid = makeTool(still);
    const auto onto = [&](const Vector3& foot, const Vector3& guess) {
      const Vector3 ray = unit(sum(guess, -1, foot));
      double r = radius;
      for (int i = 0; i < 50; ++i) {  // by the gap, which along the ray changes at most like the place
        const Vector3 x = sum(foot, r, ray);
        const double place[4] = {x[0], x[1], x[2], 0};
        const double gap = rigid->project(place).gap;
        if (!std::isfinite(gap)) break;
        r -= gap;
        if (std::abs(gap) < 1e-9 * radius) break;
      }
      return sum(foot, r, ray);
    };
    appendRevolved(center, axis, drawnAlong(unit(axis), center, box), onto, radius, mesh);
  }
};

/// A branch's result file, or its parts.
struct Results {
  std::string whole;
  int parts = 0;

  std::string part(int p) const { return parts == 0 ? whole : exodus::partName(whole, parts, p); }
};

Box boxOf(const Results& results) {
  Box box;
  box.low.fill(std::numeric_limits<double>::infinity());
  box.high.fill(-std::numeric_limits<double>::infinity());
  for (int p = 0; p < std::max(results.parts, 1); ++p) {
    const fem::Mesh mesh =
        results.parts == 0 ? exodus::readMesh(results.whole) : exodus::readPart(results.part(p)).mesh;
    for (std::size_t d = 0; d < mesh.coordinates.size(); ++d) {
      box.low[d % 3] = std::min(box.low[d % 3], mesh.coordinates[d]);
      box.high[d % 3] = std::max(box.high[d % 3], mesh.coordinates[d]);
    }
  }
  return box;
}

/// The tools where they stand at each of the results' states.
void writeStates(const std::string& file, const exodus::ResultReader& results,
                 const std::vector<deck::Tool>& tools, const Box& box) {
  fem::Mesh mesh;
  mesh.title = "rigid tools";
  std::vector<int> firstNode;
  for (const deck::Tool& tool : tools) {
    firstNode.push_back(mesh.numNodes());
    appendToolShape(tool, box, mesh);
  }
  firstNode.push_back(mesh.numNodes());
  exodus::ResultNames names;
  names.nodal = {"displ_x", "displ_y", "displ_z"};
  names.global = {"load_factor"};
  exodus::ResultWriter writer(file, mesh, names);
  const auto times = results.times();
  const auto n = static_cast<std::size_t>(mesh.numNodes());
  std::vector<double> displacement(3 * n);
  for (int step = 0; step < results.numSteps(); ++step) {
    const double lambda = results.global(step, "load_factor");
    for (std::size_t t = 0; t < tools.size(); ++t)
      for (int a = firstNode[t]; a < firstNode[t + 1]; ++a) {
        const double* x = &mesh.coordinates[3 * static_cast<std::size_t>(a)];
        const Vector3 there = moved(tools[t].motion, lambda, {x[0], x[1], x[2]});
        for (int i = 0; i < 3; ++i) displacement[i * n + a] = there[i] - x[i];
      }
    writer.writeStep(times[step], displacement, std::vector<double>(), std::vector<double>{lambda});
  }
}

/// `ends`: the load factors at which the branches, or stages, before ended; this one's is appended.
void writeBeside(const Results& files, const deck::Deck& deck, const std::string& target,
                 std::vector<double>& ends) {
  const exodus::ResultReader results(files.part(0));
  if (results.numSteps() == 0) return;
  const deck::Deck own = deck.path.stages.empty() ? deck : deck::stageDeck(deck, ends.size(), ends);
  const std::string beside = target + ".new";
  try {
    writeStates(beside, results, own.tools, boxOf(files));
    renameFile(beside, target);
  } catch (...) {
    std::remove(beside.c_str());
    throw;
  }
  ends.push_back(results.global(results.numSteps() - 1, "load_factor"));
}

}  // namespace

Vector3 moved(const deck::ToolMotion& motion, double loadFactor, const Vector3& place) {
  const contact::Motion m = toolMotion(motion);
  double shift[3], sine, cosine, x[3], turned[3];
  m.at(loadFactor, shift, sine, cosine);
  for (int i = 0; i < 3; ++i) x[i] = place[i] - m.pivot[i];
  m.turn(x, sine, cosine, turned);
  return {m.pivot[0] + shift[0] + turned[0], m.pivot[1] + shift[1] + turned[1],
          m.pivot[2] + shift[2] + turned[2]};
}

void appendToolShape(const deck::Tool& tool, const Box& box, fem::Mesh& mesh) {
  fem::Block block;
  block.name = tool.name;
  block.id = static_cast<long long>(mesh.blocks.size()) + 1;
  block.topology = fem::Topology::Shell4;
  mesh.blocks.push_back(std::move(block));
  std::visit(Appender{tool, box, mesh}, tool.surface);
}

void removeToolShapes(const std::string& folder) {
  std::vector<std::string> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (isToolsName(entry.path().filename().string())) files.push_back(entry.path().string());
  for (const std::string& file : files) removeFile(file);
}

void writeToolShapes(const std::string& folder, const deck::Deck& deck) {
  if (!ranks::isFirst()) return;
  removeToolShapes(folder);
  if (deck.tools.empty()) return;
  std::vector<double> ends;
  for (int branch = 0;; ++branch) {
    Results results{folder + "/" + fieldsName(branch)};
    if (const auto counts = exodus::findParts(results.whole); !counts.empty()) results.parts = counts.back();
    if (!std::filesystem::exists(results.part(0))) break;
    writeBeside(results, deck, folder + "/" + toolsName(branch), ends);
  }
}

}  // namespace atrapos
