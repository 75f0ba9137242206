#pragma once

#include <vector>

namespace atrapos::linear {

/// Fill-reducing ordering of a sparse matrix by nested dissection with METIS' separators.
///
/// rows and columns are the entries' indices, from 1; entries of one triangle are enough, duplicates do no
/// harm. Returns the place of every row in the pivot sequence, from 1. The same input gives the same
/// ordering. Throws SolverError where METIS fails or its indices are too short.
///
/// METIS_NodeND stops dissecting at 120 vertices, be they nodes of six rows each: 14 % more entries of
/// shells' factors (docs/theory/tangent_solvers.md).
std::vector<int> nestedDissection(int n, const std::vector<int>& rows, const std::vector<int>& columns);

}  // namespace atrapos::linear
