#pragma once

#include <memory>
#include <vector>

#include "RigidTool.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos {

/// The contact of those faces or nodes that are near a tool; the others carry no law until they get there.
///
/// Whenever a residual, a tangent or a series is evaluated, an entity with a point whose gap is below half of
/// its reference gap joins, and stays: a step that brings a point to the tool is measured with that point's
/// force, and cut back. What is left out is the law beyond Delta/2: with (15) less than eta a point.
/// Distances change by no more than points move, so the search is made only where something can have come
/// near.
class NearContact final : public fem::Term {
 public:
  /// `all`: every entity joins at once. The tool outlives the term.
  NearContact(const RigidTool& tool, const contact::AnyPressure& pressure, const fem::PointSet& points,
              const std::vector<double>& referenceGaps, bool all);

  /// Points that carry the law.
  int numCarried() const;

  int numEntities() const override { return all_->numEntities(); }
  int nodesPerEntity() const override { return all_->nodesPerEntity(); }
  const std::vector<int>& nodes() const override { return all_->nodes(); }
  bool symmetric() const override { return all_->symmetric(); }
  bool seesLoadFactor() const override { return all_->seesLoadFactor(); }
  void setPositions(const std::vector<int>& positions) override;
  double addResidual(const fem::ConstField& u, double lambda, const fem::Field& f) const override;
  void addTangent(const fem::ConstField& u, double lambda, const fem::TangentSink& sink) const override;
  void beginSeries(const fem::ConstField& u, double lambda, int maxOrder) override;
  void addOrder(int k, const fem::ConstField& last, double lastLambda, const fem::Field& f) override;
  /// Of all points, with the law's pressure also where it is not carried.
  fem::PointValues observe(const fem::ConstField& u, double lambda) const override;
  std::size_t historyBytes(int maxOrder) const override;

 private:
  void grow(const fem::ConstField& u, double lambda) const;
  void make() const;

  const RigidTool& tool_;
  contact::AnyPressure pressure_;
  fem::PointSet points_;
  std::vector<double> referenceGaps_;
  double largestShapeSum_ = 1;  ///< sum of |N| at a point: how much farther a point moves than its nodes
  std::unique_ptr<fem::Term> all_;
  std::vector<int> positions_;

  // What grows while states are evaluated.
  mutable std::vector<char> carried_;        ///< [entity]
  mutable std::shared_ptr<fem::Term> near_;  ///< null: none
  std::shared_ptr<fem::Term> series_;        ///< that of the series under way
  mutable std::vector<double> searchedAt_;   ///< u at the term's nodes when it was searched last
  mutable double slack_ = -1;                ///< how far points may move until the next search
};

}  // namespace atrapos
