#pragma once
/// Tpetra names used throughout: double values, 32-bit local and 64-bit global indices, Kokkos' default node.

#include <Teuchos_RCP.hpp>
#include <Tpetra_CrsGraph_fwd.hpp>
#include <Tpetra_CrsMatrix_fwd.hpp>
#include <Tpetra_Map_fwd.hpp>
#include <Tpetra_MultiVector_fwd.hpp>
#include <Tpetra_Vector_fwd.hpp>

namespace atrapos::linear {

using LocalIndex = int;
using GlobalIndex = long long;
using Map = Tpetra::Map<LocalIndex, GlobalIndex>;
using Vector = Tpetra::Vector<double, LocalIndex, GlobalIndex>;
using MultiVector = Tpetra::MultiVector<double, LocalIndex, GlobalIndex>;
using CrsGraph = Tpetra::CrsGraph<LocalIndex, GlobalIndex>;
using CrsMatrix = Tpetra::CrsMatrix<double, LocalIndex, GlobalIndex>;
using Teuchos::RCP;
using Teuchos::rcp;

}  // namespace atrapos::linear
