#pragma once

#include "atrapos/fem/PointLaw.hpp"

namespace atrapos::fem {

/// Why an element's enhanced parameters could not be found.
enum class EnhancedFailure : char {
  none = 0,
  notFinite,            ///< the law has no finite value there
  notPositiveDefinite,  ///< K_bb is not: the material is unstable in the enhanced strain
  notConverged          ///< Newton's method
};

/// One line's worth of words for a failure.
const char* describe(EnhancedFailure failure);

/// The enhanced strain of the elements of a batch.
struct EnhancedModes {
  int count = 0;                   ///< M, parameters of an element
  const double* modes = nullptr;   ///< [q][M]
  const double* weight = nullptr;  ///< [q][lane]
  const double* strain = nullptr;  ///< [q][lane] strain per unit of e
};

/// The parameters beta of each element of a batch at given h = B u (docs/theory/shell.md):
///
///     g_j(beta) = sum_q w_q m_qj s(h_q, e_q) = 0,     e_q = sum_j m_qj beta_j
///
/// s is the law's last output, e its last input. Newton's method from beta = 0, whatever states came before:
/// beta is a function of the displacements alone and the same to the last bit at every call, whatever
/// elements are beside it.
///
/// in: [q][input][lane], its e entries hold e_q afterwards: NaN in a lane that failed. out, derivative:
/// scratch, [q][output][lane].
void solveEnhanced(const PointLaw& law, const PointBatch& points, const EnhancedModes& modes, double* in,
                   double* out, double* derivative, EnhancedFailure (&failure)[kLanes]);

/// Inverse of the symmetric positive definite M x M matrix of each lane, [row][column][lane]; NaN where it is
/// not.
void invertInLanes(int M, const double* K, double* inverse);

}  // namespace atrapos::fem
