// How a model is shared out over ranks: everything once, balanced, what belongs together on one rank.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "atrapos/fem/Partition.hpp"
#include "support/Model.hpp"

using namespace atrapos::fem;
using namespace atrapos::fem::test;

namespace {

FeModel boxModel(const Mesh& mesh) {
  FeModel model;
  model.dofs = DofMap::displacements(mesh.numNodes());
  model.terms = solidTerms(mesh);
  return model;
}

std::vector<int> countOf(const std::vector<int>& ranks, int numRanks) {
  std::vector<int> count(numRanks, 0);
  for (const int r : ranks) ++count.at(r);
  return count;
}

/// Pairs of an entity and a node of it that another rank owns.
int sharedPlaces(const FeModel& model, const Partition& p) {
  int shared = 0;
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    const int N = model.terms[t]->nodesPerEntity();
    for (int e = 0; e < model.terms[t]->numEntities(); ++e)
      for (int n = 0; n < N; ++n) shared += p.nodes[model.terms[t]->nodes()[e * N + n]] != p.entities[t][e];
  }
  return shared;
}

}  // namespace

TEST(Partition, LongBoxIsCutAcrossIntoEqualParts) {
  const FeModel model = boxModel(box(Topology::Hex20, {12, 2, 2}, {12, 2, 2}));
  for (const int numRanks : {2, 3}) {
    const Partition p = partition(model, {}, numRanks);
    for (const int count : countOf(p.entities[0], numRanks)) EXPECT_EQ(count, 48 / numRanks);
    // Owned at each cut are the 21 nodes of its 4 faces, one side's; the 4 elements of the other side have 32
    // places there.
    EXPECT_EQ(sharedPlaces(model, p), 32 * (numRanks - 1));
  }
}

TEST(Partition, EveryNodeBelongsToARankThatHasItsElements) {
  const FeModel model = busyModel(mixedMesh());
  const int numRanks = 4;
  const Partition p = partition(model, {}, numRanks);
  std::vector<std::vector<char>> has(numRanks, std::vector<char>(model.dofs.numNodes(), 0));
  std::vector<char> any(model.dofs.numNodes(), 0);
  for (std::size_t t = 0; t < model.terms.size(); ++t) {
    ASSERT_EQ(p.entities[t].size(), static_cast<std::size_t>(model.terms[t]->numEntities()));
    const int N = model.terms[t]->nodesPerEntity();
    for (std::size_t i = 0; i < model.terms[t]->nodes().size(); ++i)
      has[p.entities[t][i / N]][model.terms[t]->nodes()[i]] = any[model.terms[t]->nodes()[i]] = 1;
  }
  for (int n = 0; n < model.dofs.numNodes(); ++n) {
    if (any[n]) {
      EXPECT_TRUE(has[p.nodes[n]][n]) << n;
    } else {
      EXPECT_EQ(p.nodes[n], 0) << n;
    }
  }
}

TEST(Partition, FacesGoWithTheirElementsAndCount) {
  const Mesh mesh = box(Topology::Hex8, {16, 1, 1}, {16, 1, 1});
  FeModel model = boxModel(mesh);
  for (const PointSet& points : facePoints(mesh, sideSet(mesh, "z_min"), 2)) {
    PointSet some = points;  // the faces of the first quarter, each many times as costly as an element
    some.numEntities = 4;
    const std::size_t Q = some.pointsPerEntity, N = some.nodesPerEntity;
    some.nodes.resize(4 * N);
    some.shape.resize(4 * Q * N);
    some.weights.resize(4 * Q);
    some.positions.resize(4 * Q * 3);
    some.normals.resize(4 * Q * 3);
    for (int i = 0; i < 40; ++i) model.terms.push_back(lawTerm(pointLaw(CentralForce{}), some));
  }
  const Partition p = partition(model, {}, 2);
  for (std::size_t t = 1; t < model.terms.size(); ++t)
    for (int e = 0; e < 4; ++e) EXPECT_EQ(p.entities[t][e], p.entities[0][e]);
  // Elements with faces do more than the others together: their rank has few more than those.
  const int rank = p.entities[0][0];
  EXPECT_LT(countOf(p.entities[0], 2)[rank], 6);
}

TEST(Partition, ElementsAtASlaveStayTogether) {
  const Mesh mesh = box(Topology::Hex8, {4, 4, 4});
  FeModel model = boxModel(mesh);
  Couplings couplings;
  couplePlane(couplings, model.dofs, nodesOfSet(mesh, "x_max"), {1, 0, 0});
  const auto resolved = couplings.resolved(model.dofs, model.supports);
  const Partition p = partition(model, resolved, 3);
  for (std::size_t c = 0; c < resolved.size(); ++c) {
    const int slave = resolved[c].dof / 3;
    EXPECT_EQ(p.couplings[c], p.nodes[slave]);
    const Term& term = *model.terms[0];
    for (std::size_t i = 0; i < term.nodes().size(); ++i)
      if (term.nodes()[i] == slave) {
        EXPECT_EQ(p.entities[0][i / term.nodesPerEntity()], p.couplings[c]);
      }
  }
  const auto count = countOf(p.entities[0], 3);
  EXPECT_GT(*std::min_element(count.begin(), count.end()), 0);
}

TEST(Partition, MoreRanksThanElements) {
  const FeModel model = boxModel(box(Topology::Hex8, {2, 1, 1}));
  const Partition p = partition(model, {}, 5);
  EXPECT_NE(p.entities[0][0], p.entities[0][1]);
}

TEST(Partition, KeepsTheRanksThatTheModelGives) {
  const Mesh mesh = box(Topology::Hex8, {6, 1, 1});
  FeModel model = boxModel(mesh);
  for (const PointSet& points : facePoints(mesh, sideSet(mesh, "z_min"), 2))
    model.terms.push_back(lawTerm(pointLaw(CentralForce{}), points));
  model.ranks = {{2, 0, 1, 1, 0, 2}};  // faces follow their elements
  const Partition p = partition(model, {}, 3);
  EXPECT_EQ(p.entities[0], model.ranks[0]);
  EXPECT_EQ(p.entities[1], model.ranks[0]);
  model.ranks[0][3] = 3;
  EXPECT_THROW(partition(model, {}, 3), std::invalid_argument);
  model.ranks[0].pop_back();
  EXPECT_THROW(partition(model, {}, 3), std::invalid_argument);
}

TEST(Partition, GivenRanksYieldWhereASlaveNeedsItsElementsTogether) {
  const Mesh mesh = box(Topology::Hex8, {2, 2, 1});
  FeModel model = boxModel(mesh);
  Couplings couplings;
  couplePlane(couplings, model.dofs, nodesOfSet(mesh, "x_max"), {1, 0, 0});
  const auto resolved = couplings.resolved(model.dofs, model.supports);
  model.ranks = {{0, 1, 0, 1}};
  const Partition p = partition(model, resolved, 2);
  const Term& term = *model.terms[0];
  int moved = 0;
  for (int e = 0; e < term.numEntities(); ++e) {
    const auto slave = [&](int node) {
      return std::any_of(resolved.begin(), resolved.end(), [&](const auto& c) { return c.dof / 3 == node; });
    };
    const int* nodes = &term.nodes()[e * 8];
    if (std::none_of(nodes, nodes + 8, slave)) {
      EXPECT_EQ(p.entities[0][e], model.ranks[0][e]);
    } else {
      EXPECT_EQ(p.entities[0][e], p.couplings[0]);
    }
    moved += p.entities[0][e] != model.ranks[0][e];
  }
  EXPECT_LE(moved, 1);
}

TEST(Partition, MeshIsCutIntoEqualParts) {
  const Mesh mesh = box(Topology::Hex20, {12, 2, 2}, {12, 2, 2});
  for (const int parts : {2, 3, 4})
    for (const int count : countOf(partition(mesh, parts), parts)) EXPECT_EQ(count, 48 / parts);
  const auto mixed = countOf(partition(mixedMesh(), 2), 2);
  EXPECT_GT(*std::min_element(mixed.begin(), mixed.end()), 0);
  EXPECT_EQ(partition(mesh, 1), std::vector<int>(48, 0));
}
