#pragma once

#include <memory>
#include <vector>

#include "atrapos/contact/RigidTool.hpp"
#include "atrapos/fem/DofMap.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos::contact {

/// The contact of those faces or nodes that are near a tool; the others carry no law until they get there.
///
/// An entity is near where the gap of one of its points is below half of its reference gap. What is left out
/// is the law beyond Delta/2: with (15) less than eta a point. Entities join by `grow`, between steps, and
/// stay; somebody looks along every step whether others have come near, and takes the step back where they
/// have.
class NearContact final : public fem::Term {
 public:
  /// No entity carries the law yet. The tool outlives the term.
  NearContact(const RigidTool& tool, const AnyPressure& pressure, const fem::PointSet& points,
              const std::vector<double>& referenceGaps);

  /// Points of this rank that carry the law.
  int numCarried() const;

  /// Whether an entity that carries no law is near in the state (u, lambda).
  bool othersAreNear(const fem::ConstDofView& u, double lambda) const { return search(u, lambda, nullptr); }
  /// Those that are near there join. Not while a series is under way.
  void grow(const fem::ConstDofView& u, double lambda);

  int numEntities() const override { return all_->numEntities(); }
  int nodesPerEntity() const override { return all_->nodesPerEntity(); }
  const std::vector<int>& nodes() const override { return all_->nodes(); }
  bool symmetric() const override { return all_->symmetric(); }
  bool seesLoadFactor() const override { return all_->seesLoadFactor(); }
  void keep(const fem::TermPart& part) override;
  void connect(const fem::DofMap& dofs, const std::vector<int>& positions) override;
  fem::OwnForces addResidual(const fem::ConstDofView& u, double lambda, const fem::DofView& f) const override;
  void addTangent(const fem::ConstDofView& u, double lambda, const fem::TangentSink& sink) const override;
  void beginSeries(const fem::ConstDofView& u, double lambda, int maxOrder) override;
  void addOrder(int k, const fem::ConstDofView& last, double lastLambda, const fem::DofView& f) override;
  /// Of all points; those that carry no law are on no piece of a series.
  fem::PointPieces* pieces() override { return all_->pieces(); }
  std::vector<double> places(const fem::ConstDofView& u, double lambda) const override;
  /// Of all points, with the law's pressure also where it is not carried.
  fem::PointValues observe(const fem::ConstDofView& u, double lambda) const override;
  std::size_t historyBytes(int maxOrder) const override;

 private:
  bool search(const fem::ConstDofView& u, double lambda, std::vector<char>* joining) const;
  void make();
  void lendPieces() const;
  fem::PointSet pointsOf(const std::vector<int>& entities) const;

  const RigidTool& tool_;
  AnyPressure pressure_;
  fem::PointSet points_;
  std::vector<double> referenceGaps_;
  std::unique_ptr<fem::Term> all_;
  fem::DofMap dofs_;
  std::vector<int> positions_;
  std::vector<char> carried_;        ///< [entity]
  std::vector<int> carriedPoints_;   ///< numbers of the points of near_, in its order
  std::unique_ptr<fem::Term> near_;  ///< null: none
};

}  // namespace atrapos::contact
