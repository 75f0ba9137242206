#include "RowNumbering.hpp"

#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Import.hpp>
#include <Tpetra_Vector.hpp>

namespace atrapos::linear {

RowNumbering::RowNumbering(const CrsMatrix& K) {
  const GlobalIndex localRows = static_cast<GlobalIndex>(K.getRowMap()->getNodeNumElements());
  Teuchos::scan(*K.getRowMap()->getComm(), Teuchos::REDUCE_SUM, 1, &localRows, &first);
  first -= localRows;

  using Numbers = Tpetra::Vector<GlobalIndex, LocalIndex, GlobalIndex>;
  Numbers ofRows(K.getRowMap()), ofColumns(K.getColMap());
  {
    const auto view = ofRows.getLocalViewHost(Tpetra::Access::OverwriteAll);
    for (std::size_t i = 0; i < view.extent(0); ++i) view(i, 0) = first + static_cast<GlobalIndex>(i);
  }
  const Tpetra::Import<LocalIndex, GlobalIndex> import(K.getRowMap(), K.getColMap());
  ofColumns.doImport(ofRows, import, Tpetra::REPLACE);
  const auto view = ofColumns.getLocalViewHost(Tpetra::Access::ReadOnly);
  columns.assign(view.data(), view.data() + view.extent(0));
}

}  // namespace atrapos::linear
