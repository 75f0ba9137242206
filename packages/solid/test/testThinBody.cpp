// Membranes and bars: closed forms of their laws, objectivity, derivatives, metals, stress at rest.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "MetalPath.hpp"
#include "atrapos/fem/LawTerm.hpp"
#include "atrapos/fem/Loads.hpp"
#include "atrapos/fem/ReferenceCell.hpp"
#include "atrapos/fem/StructuredShell.hpp"
#include "atrapos/fem/TrussMesh.hpp"
#include "atrapos/solid/Gent.hpp"
#include "atrapos/solid/MooneyRivlin.hpp"
#include "atrapos/solid/NeoHookean.hpp"
#include "atrapos/solid/Ogden.hpp"
#include "atrapos/solid/SaintVenantKirchhoff.hpp"
#include "atrapos/solid/ThinBody.hpp"
#include "atrapos/solid/Yeoh.hpp"
#include "support/Checks.hpp"
#include "support/Meshes.hpp"
#include "support/Vectors.hpp"

using namespace atrapos;
using namespace atrapos::solid;
using namespace atrapos::fem::test;
using namespace atrapos::solid::test;
using fem::kLanes;

namespace {

template <class Material>
std::unique_ptr<fem::PointLaw> stageOf(const Material& material) {
  return fem::pointLaw(ShellMaterialStage<Material>{material});
}

/// A rotation without a special axis, [i][j].
using Rotation = std::array<std::array<double, 3>, 3>;
Rotation rotation(double a, double b) {
  const double ca = std::cos(a), sa = std::sin(a), cb = std::cos(b), sb = std::sin(b);
  return {{{ca * cb, -sa, ca * sb}, {sa * cb, ca, sa * sb}, {-sb, 0, cb}}};
}
const Rotation atRest = rotation(0.4, 1.1), turned = rotation(-0.9, 0.3);

/// What a law says and shows at one point.
struct Answer {
  Numbers out, shown;
};
Answer answer(const fem::PointLaw& law, const Numbers& in, const Numbers& data) {
  const fem::LawShape s = law.shape();
  const auto inLanes = [](const Numbers& numbers) {
    Numbers all(numbers.size() * kLanes);
    for (std::size_t i = 0; i < all.size(); ++i) all[i] = numbers[i / kLanes];
    return all;
  };
  const auto firstLane = [](const Numbers& all) {
    Numbers numbers;
    for (std::size_t i = 0; i < all.size(); i += kLanes) numbers.push_back(all[i]);
    return numbers;
  };
  const Numbers x = inLanes(in), d = inLanes(data);
  Numbers out(s.outputs * kLanes), shown(s.observed * kLanes), memory(law.historyDoubles(0));
  const fem::PointBatch point{1, kLanes, d.data(), memory.data()};
  law.value(point, x.data(), out.data());
  law.observe(point, x.data(), shown.data());
  return {firstLane(out), firstLane(shown)};
}

/// A bar along the first column of `atRest`, stretched and turned with `turned`.
Answer stretchedBar(const fem::PointLaw& law, double stretch, double stress = 0) {
  Numbers in, data;
  for (int i = 0; i < 3; ++i) {
    data.push_back(atRest[i][0]);
    in.push_back(stretch * turned[i][0] - atRest[i][0]);
  }
  data.push_back(stress);
  return answer(law, in, data);
}
/// Its force along itself; there is no other.
double barForce(const fem::PointLaw& law, double stretch, double stress = 0) {
  const Numbers f = stretchedBar(law, stretch, stress).out;
  double along = 0, square = 0;
  for (int i = 0; i < 3; ++i) {
    along += f[i] * turned[i][0];
    square += f[i] * f[i];
  }
  EXPECT_NEAR(square, along * along, 1e-14 * square);
  return along;
}

/// A membrane in the plane of the first two columns of `atRest`, with the gradient f (2 x 2 by rows) between
/// these axes and those of `turned`.
Answer stretchedMembrane(const fem::PointLaw& law, const std::array<double, 4>& f, double stress = 0) {
  Numbers in, data;
  for (int i = 0; i < 3; ++i)
    for (int b = 0; b < 2; ++b) {
      data.push_back(atRest[i][b]);
      in.push_back(turned[i][0] * f[b] + turned[i][1] * f[2 + b] - atRest[i][b]);
    }
  data.push_back(stress);
  return answer(law, in, data);
}
/// P, 2 x 2 by rows, in these axes.
std::array<double, 4> membraneForces(const fem::PointLaw& law, const std::array<double, 4>& f,
                                     double stress = 0) {
  const Numbers out = stretchedMembrane(law, f, stress).out;
  std::array<double, 4> P{};
  double off = 0, size = 0;
  for (int b = 0; b < 2; ++b) {
    double across = 0;
    for (int i = 0; i < 3; ++i) {
      for (int a = 0; a < 2; ++a) P[2 * a + b] += turned[i][a] * out[2 * i + b];
      across += turned[i][2] * out[2 * i + b];
      size = std::max(size, std::abs(out[2 * i + b]));
    }
    off = std::max(off, std::abs(across));
  }
  EXPECT_LE(off, 1e-14 * size);
  return P;
}

/// Nearly incompressible rubbers, and the slopes of their energies by I_1 and I_2 at the invariants.
constexpr double bulk = 1e7;
struct Rubber {
  std::string name;
  std::unique_ptr<fem::PointLaw> stage;
  /// dW/dl_1 of the stretches l_1, l_2 with l_1 l_2 l_3 = 1 and no stress along l_3.
  std::function<double(double, double)> force;
};
std::vector<Rubber> rubbers() {
  const auto ofSlopes = [](auto slope1, auto slope2) {
    return [=](double a, double b) {
      const double c = 1 / (a * b), x = a * a + b * b + c * c - 3;
      return 2 * (a * a - c * c) * (slope1(x) + b * b * slope2(x)) / a;
    };
  };
  const auto zero = [](double) { return 0.0; };
  std::vector<Rubber> all;
  all.push_back({"neo-Hookean", stageOf(NeoHookean::fromModuli(1.3, bulk)),
                 ofSlopes([](double) { return 0.65; }, zero)});
  all.push_back({"Mooney-Rivlin", stageOf(MooneyRivlin::fromModuli(0.4, 0.1, bulk)),
                 ofSlopes([](double) { return 0.4; }, [](double) { return 0.1; })});
  all.push_back({"Yeoh", stageOf(Yeoh::fromModuli(0.5, -0.02, 0.004, bulk)),
                 ofSlopes([](double x) { return 0.5 - 0.04 * x + 0.012 * x * x; }, zero)});
  all.push_back({"Gent", stageOf(Gent::fromModuli(1.2, 40, bulk)),
                 ofSlopes([](double x) { return 0.6 * 40 / (40 - x); }, zero)});
  all.push_back({"Ogden", stageOf(Ogden::fromModuli({0.6, -0.2}, {1.7, -2.5}, bulk)), [](double a, double b) {
                   const double c = 1 / (a * b);
                   const auto term = [&](double mu, double alpha) {
                     return mu * (std::pow(a, alpha) - std::pow(c, alpha)) / a;
                   };
                   return term(0.6, 1.7) + term(-0.2, -2.5);
                 }});
  return all;
}

// A bulk modulus 1e7 times the shear modulus leaves volumes that are off by 1e-7 of a stress of order 1 to
// 10, and forces by some times as much.
constexpr double incompressible = 1e-5;

}  // namespace

TEST(ThinBody, BarsOfRubberFollowClosedForms) {
  for (Rubber& rubber : rubbers()) {
    const auto law = barLaw(std::move(rubber.stage));
    EXPECT_NEAR(barForce(*law, 1), 0, 1e-14) << rubber.name;
    for (const double stretch : {0.5, 0.8, 1.001, 1.5, 3.0}) {
      const double exact = rubber.force(stretch, 1 / std::sqrt(stretch));
      EXPECT_NEAR(barForce(*law, stretch), exact, incompressible * std::max(1.0, std::abs(exact)))
          << rubber.name << ' ' << stretch;
    }
  }
}

TEST(ThinBody, MembranesOfRubberFollowClosedForms) {
  for (Rubber& rubber : rubbers()) {
    const auto law = membraneLaw(std::move(rubber.stage));
    const std::pair<double, double> stretches[] = {{1, 1}, {1.4, 1.4}, {3, 3},
                                                   {2, 1}, {2.5, 0.7}, {0.9, 0.8}};
    for (const auto& [a, b] : stretches) {
      const auto P = membraneForces(*law, {a, 0, 0, b});
      const double exact[4] = {rubber.force(a, b), 0, 0, rubber.force(b, a)};
      const double size = std::max({1.0, std::abs(exact[0]), std::abs(exact[3])});
      for (int k = 0; k < 4; ++k)
        EXPECT_NEAR(P[k], exact[k], incompressible * size) << rubber.name << ' ' << a << ' ' << b;
    }
  }
}

// Saint Venant-Kirchhoff's: linear elasticity of the strains, in plane and uniaxial stress, at any gradient;
// with a stress at rest.
TEST(ThinBody, ElasticLawsAreThoseOfTheStrains) {
  const double E = 3, nu = 0.3, rest = 0.02;
  const auto material = SaintVenantKirchhoff::fromYoung(E, nu);
  const auto bar = barLaw(stageOf(material)), membrane = membraneLaw(stageOf(material));
  for (const double s : {0.6, 1.0, 1.3}) {
    const double strain = (s * s - 1) / 2, S = E * strain + rest;
    EXPECT_NEAR(barForce(*bar, s, rest), S * s, 1e-14 * E);
    const Numbers sigma = stretchedBar(*bar, s, rest).shown;  // along the bar, by the area that is left
    for (int i = 0; i < 3; ++i)
      for (int j = i; j < 3; ++j)
        EXPECT_NEAR(sigma[taylor::symmetricIndex(i, j)],
                    S * s / (1 - 2 * nu * strain) * turned[i][0] * turned[j][0], 1e-13 * E);
  }
  const std::array<double, 4> f{1.2, 0.3, -0.1, 0.8};
  const double E11 = (f[0] * f[0] + f[2] * f[2] - 1) / 2, E22 = (f[1] * f[1] + f[3] * f[3] - 1) / 2,
               E12 = (f[0] * f[1] + f[2] * f[3]) / 2;
  const double modulus = E / (1 - nu * nu), S11 = modulus * (E11 + nu * E22) + rest,
               S22 = modulus * (E22 + nu * E11) + rest, S12 = E / (1 + nu) * E12;
  const double exact[4] = {f[0] * S11 + f[1] * S12, f[0] * S12 + f[1] * S22, f[2] * S11 + f[3] * S12,
                           f[2] * S12 + f[3] * S22};
  const auto P = membraneForces(*membrane, f, rest);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(P[k], exact[k], 1e-14 * E) << k;
  const Numbers sigma = stretchedMembrane(*membrane, f, rest).shown;
  const double thickness = std::sqrt(1 - 2 * nu / (1 - nu) * (E11 + E22)),
               J = (f[0] * f[3] - f[1] * f[2]) * thickness;
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j) {
      double expected = 0;
      for (int a = 0; a < 2; ++a)
        for (int b = 0; b < 2; ++b)
          expected +=
              (exact[2 * a] * f[2 * b] + exact[2 * a + 1] * f[2 * b + 1]) / J * turned[i][a] * turned[j][b];
      EXPECT_NEAR(sigma[taylor::symmetricIndex(i, j)], expected, 1e-13 * E);
    }
}

namespace {

template <class Material>
std::unique_ptr<fem::Term> termOf(const fem::Mesh& mesh, const Material& material,
                                  const ThinSection& section) {
  const fem::Block& block = mesh.blocks[0];
  auto stage = stageOf(material);
  return thinTerm(fem::isBar(block.topology) ? barLaw(std::move(stage)) : membraneLaw(std::move(stage)),
                  thinPoints(mesh, block, thinTabulation(block.topology), section), section);
}

/// A curved membrane, or a tetrahedron of bars, with nodes held, driven and loaded.
fem::Mesh thinMesh(fem::Topology topology) {
  if (fem::isBar(topology)) {
    fem::TrussOptions truss;
    truss.nodes = {{0, 0, 0}, {1, 0.1, 0}, {0.2, 1, 0.1}, {0.3, 0.4, 1}, {1, 1, 1}};
    truss.bars = {{1, 2}, {2, 3}, {3, 1}, {1, 4}, {2, 4}, {3, 4}, {2, 5}, {3, 5}, {4, 5}, {1, 5}};
    fem::Mesh mesh = fem::trussMesh(truss);
    if (topology == fem::Topology::Bar2) return mesh;
    fem::Block& block = mesh.blocks[0];  // with nodes beside their middles
    std::vector<int> nodes;
    for (std::size_t b = 0; b < block.nodes.size(); b += 2) {
      nodes.insert(nodes.end(), {block.nodes[b], block.nodes[b + 1], mesh.numNodes()});
      for (int i = 0; i < 3; ++i)
        mesh.coordinates.push_back(
            0.5 * (mesh.coordinates[3 * block.nodes[b] + i] + mesh.coordinates[3 * block.nodes[b + 1] + i]) +
            0.02 * (i + 1));
    }
    block.nodes = nodes;
    block.topology = topology;
    return mesh;
  }
  fem::ShellCylinderOptions cylinder;
  cylinder.radius = 1;
  cylinder.thetaMin = -40;
  cylinder.thetaMax = 50;
  cylinder.length = 1;
  cylinder.divisions = {2, 2};
  cylinder.topology = topology;
  fem::Mesh mesh = fem::shellCylinderMesh(cylinder);
  mesh.blocks[0].membrane = true;
  return mesh;
}

template <class Material>
fem::FeModel thinModel(const fem::Mesh& mesh, const Material& material) {
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  const bool bars = fem::isBar(mesh.blocks[0].topology);
  model.terms.push_back(termOf(mesh, material, {0.1, 0.3}));
  for (int i = 0; i < 3; ++i) {
    model.prescribe(0, i, 0, 0);
    model.prescribe(1, i, 0.01 * i, bars ? 0.03 : 0.1);  // trusses are soft
  }

  model.load = randomNumbers(model.dofs.numDofs(), 0.01, 22);
  model.constantLoad = randomNumbers(model.dofs.numDofs(), 0.002, 23);
  return model;
}

const std::vector<fem::Topology> thinCells{
    fem::Topology::Shell3, fem::Topology::Shell4, fem::Topology::Shell6, fem::Topology::Shell8,
    fem::Topology::Shell9, fem::Topology::Bar2,   fem::Topology::Bar3};

}  // namespace

TEST(ThinBody, TangentsAndOrders) {
  for (const fem::Topology topology : thinCells) {
    SCOPED_TRACE(fem::topologyName(topology));
    const fem::Mesh mesh = thinMesh(topology);
    checkTangent(thinModel(mesh, MooneyRivlin::fromModuli(0.4, 0.1, 5)));
    checkOrders(thinModel(mesh, SaintVenantKirchhoff::fromYoung(3, 0.3)));
    checkOrders(thinModel(mesh, MooneyRivlin::fromModuli(0.4, 0.1, 5)));
  }
}

// A homogeneous gradient of displacements in space strains straight bars and flat membranes alike, whatever
// their cells: forces between nodes cancel inside, and the weights are the volume.
TEST(ThinBody, PatchesOfMembranes) {
  for (const fem::Topology topology : thinCells) {
    if (fem::isBar(topology)) continue;
    fem::ShellPlateOptions plate;
    plate.length = 2;
    plate.width = 1;
    plate.angle = 70;
    plate.divisions = {3, 2};
    plate.topology = topology;
    fem::Mesh mesh = fem::shellPlateMesh(plate);
    mesh.blocks[0].membrane = true;
    const ThinSection section{0.1, 0.3};
    const auto made = thinPoints(mesh, mesh.blocks[0], thinTabulation(topology), section);
    double volume = 0;
    for (const double w : made.points.weights) volume += w;
    EXPECT_NEAR(volume, 0.2 * std::sin(70 * std::acos(-1.0) / 180), 1e-14) << fem::topologyName(topology);
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(mesh.numNodes());
    model.terms.push_back(termOf(mesh, MooneyRivlin::fromModuli(0.4, 0.1, 5), section));
    std::vector<char> inside(mesh.numNodes(), 1);
    for (const char* edge : {"x_min", "x_max", "y_min", "y_max"})
      for (const int n : nodesOfSet(mesh, edge)) inside[n] = 0;
    fem::FeProblem problem(std::move(model));
    const double H[3][2] = {{0.2, 0.1}, {-0.05, 0.3}, {0.4, -0.2}};
    Numbers u;
    for (int n = 0; n < mesh.numNodes(); ++n)
      for (const auto& row : H)
        u.push_back(row[0] * mesh.coordinates[3 * n] + row[1] * mesh.coordinates[3 * n + 1]);
    const Residual result = residual(problem, u, 0);
    for (std::size_t d = 0; d < u.size(); ++d)
      EXPECT_NEAR(inside[d / 3] != 0 ? result.r[d] : 0.0, 0, 1e-15) << fem::topologyName(topology);
    EXPECT_GT(largest(result.r), 1e-3);  // of the edges
  }
}

TEST(ThinBody, WeightIsThatOfTheVolume) {
  for (const fem::Topology topology : thinCells) {
    const fem::Mesh mesh = thinMesh(topology);
    const ThinSection section{0.1, 0};
    const auto made = thinPoints(mesh, mesh.blocks[0], fem::tabulate(mesh.blocks[0].topology, 4), section);
    double volume = 0;
    for (const double w : made.points.weights) volume += w;
    std::vector<double> force(mesh.coordinates.size());
    fem::addTraction(
        {thinValuePoints(mesh, mesh.blocks[0], fem::tabulate(mesh.blocks[0].topology, 4), section)},
        {1, 2, -3}, force);
    double sum[3] = {};
    for (std::size_t d = 0; d < force.size(); ++d) sum[d % 3] += force[d];
    const double expected[3] = {volume, 2 * volume, -3 * volume};
    for (int i = 0; i < 3; ++i) EXPECT_NEAR(sum[i], expected[i], 1e-14) << fem::topologyName(topology);
  }
}

namespace {

/// Two bars in a row, of length 1 together, whose end is pulled by the load factor.
fem::FeProblem pulledBar(const Metal& m) {
  fem::TrussOptions truss;
  truss.nodes = {{0, 0, 0}, {1, 0, 0}, {0.4, 0, 0}};
  truss.bars = {{1, 3}, {3, 2}};
  const fem::Mesh mesh = fem::trussMesh(truss);
  const ThinSection section{2, 0};
  fem::FeModel model;
  model.dofs = fem::DofMap::displacements(mesh.numNodes());
  model.terms.push_back(thinTerm(
      barLaw(m), thinPoints(mesh, mesh.blocks[0], thinTabulation(fem::Topology::Bar2), section), section));
  for (int i = 0; i < 3; ++i) {
    model.prescribe(0, i, 0, 0);
    model.prescribe(1, i, 0, i == 0 ? 1 : 0);
    if (i > 0) model.prescribe(2, i, 0, 0);
  }
  return fem::FeProblem(std::move(model));
}

/// The closed form, and its force on an area of 2.
void expectUniaxial(const fem::FeProblem& problem, const Steps& steps, const Uniaxial& exact, double sense) {
  expectBar(problem, steps, exact, sense, [&](const path::State& state, double S, std::size_t step) {
    EXPECT_NEAR(problem.reactions(state)[3], 2 * S * (1 + state.lambda), 1e-6 * yield) << "step " << step;
  });
}

}  // namespace

TEST(ThinBody, BarsOfMetalYieldBothWays) {
  for (const Metal& m : {metal(300, 60, 150, 30e3, 250), metal(2000, 0, 0, 0, 0), metal(100, 0, 0, 5e3, 0)}) {
    fem::FeProblem problem = pulledBar(m);
    const Followed out(problem, {problem.initialState(0), 0.0}, 0.02);
    ASSERT_EQ(out.outcome.reason, path::EndReason::stopReached) << out.outcome.text;
    EXPECT_EQ(out.outcome.events, 1);
    SCOPED_TRACE(m.modulus);
    Uniaxial exact{m};
    expectUniaxial(problem, out.steps, exact, 1);
    const path::State& end = out.outcome.final;
    const double gamma = problem.observe(0, end).values.at(6);
    exact.turnBack(gamma);
    const Followed back(problem, end, -0.01, -1);
    ASSERT_EQ(back.outcome.reason, path::EndReason::stopReached) << back.outcome.text;
    expectUniaxial(problem, back.steps, exact, -1);
  }
}

// Tangents where points yield and where they do not.
TEST(ThinBody, DerivativesOfMetals) {
  const Metal m = metal(300, 60, 150, 30e3, 250);
  for (const fem::Topology topology : {fem::Topology::Bar2, fem::Topology::Shell4}) {
    const fem::Mesh mesh = thinMesh(topology);
    const ThinSection section{0.1, 0};
    const bool bar = fem::isBar(topology);
    const auto made = thinPoints(mesh, mesh.blocks[0], thinTabulation(topology), section);
    auto law = bar ? barLaw(m) : membraneLaw(m);
    const fem::LawShape shape = law->shape();
    const std::size_t count = made.points.numPoints(), axes = made.axes.size() / count;
    std::vector<double> data(count * shape.data, 0.0);
    // Every second point yields, with plastic strain and backstress.
    const std::vector<double> variables =
        bar ? std::vector<double>{0.003, 0.002, 12}
            : std::vector<double>{0.003, 0.0012, -0.0007, -0.0005, 0.0004, 0, 0, 10, -6, -4, 5, 0, 0};
    for (std::size_t p = 0; p < count; ++p) {
      double* at = &data[p * shape.data];
      at[0] = p % 2 == 0 ? 1 : 0;
      std::copy_n(&made.axes[p * axes], axes, at + 1);
      std::copy(variables.begin(), variables.end(), at + 2 + axes);
    }
    fem::FeModel model;
    model.dofs = fem::DofMap::displacements(mesh.numNodes());
    model.terms.push_back(fem::lawTerm(std::move(law), made.points, data));
    for (int i = 0; i < 3; ++i) {
      model.prescribe(0, i, 0, 0);
      model.prescribe(1, i, 1e-4 * i, 1e-3);
    }
    model.load = randomNumbers(model.dofs.numDofs(), 0.01, 22);
    checkTangent(std::move(model));
  }
}
