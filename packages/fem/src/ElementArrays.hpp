#pragma once

#include <cstddef>
#include <vector>

#include "ElementKernels.hpp"
#include "atrapos/fem/Batches.hpp"
#include "atrapos/fem/PointSet.hpp"
#include "atrapos/fem/Term.hpp"

namespace atrapos::fem {

/// The entities of a term as its loops read them: nodes, weights, shape functions, in batches of kLanes, and
/// the kernels that work on them.
class ElementArrays {
 public:
  explicit ElementArrays(const PointSet& points);

  const ElementView& view() const { return view_; }
  const ElementKernels& kernels() const { return kernels_; }
  const Batches& batches() const { return batches_; }
  const std::vector<int>& nodes() const { return entityNodes_; }  ///< [entity][node]
  /// Entities of the whole term, where this is a part; empty where all are there.
  const std::vector<int>& kept() const { return kept_; }
  int components() const { return components_; }  ///< of a shape function
  int inputs() const { return 3 * components_; }  ///< of B u at a point

  /// Number of an entity, from 0, in the whole term.
  int numberInTerm(int entity) const { return kept_.empty() ? entity : kept_[entity]; }

  /// Drops all entities but these.
  void keep(const TermPart& part);
  void setPositions(const std::vector<int>& positions);

  /// in += the constant part of the inputs: X where they are the current place, nothing otherwise.
  void addOffset(int b, int stride, double* in) const;
  /// Sum of squares of a batch's nodal forces, [dof < count][lane].
  double squares(int b, int count, const double* force) const;
  /// The weights of a batch, [q][lane].
  const double* weights(int b) const { return view_.weight + static_cast<std::size_t>(b) * view_.Q * kLanes; }
  /// The value of node n's shape function at point q of a batch (components() = 1), [lane].
  double value(int b, int q, int n, int lane) const {
    return view_.shared
               ? view_.shape[q * view_.N + n]
               : view_.shape[((static_cast<std::size_t>(b) * view_.Q + q) * view_.N + n) * kLanes + lane];
  }

  /// [entity][m] -> [batch][m][lane], m < count; lanes beyond the last entity copy it.
  std::vector<double> packed(const std::vector<double>& from, std::size_t count) const;
  /// [batch][m][lane] of the whole term -> of a part; before `keep`.
  static std::vector<double> packedOf(const TermPart& part, const double* from, std::size_t count);

 private:
  void setView();
  std::vector<int> padded(const std::vector<int>& of, int count) const;
  std::vector<double> withoutPadding(std::vector<double> weights) const;

  int components_ = 0;
  std::vector<int> entityNodes_, kept_;
  Batches batches_;
  ElementKernels kernels_;
  ElementView view_;
  View<int*> nodes_, positions_;
  View<double*> shape_, map_, weight_, offset_;
};

}  // namespace atrapos::fem
