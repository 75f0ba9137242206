#include "IncompleteFactor.hpp"

#include <fmt/format.h>

#include <Ifpack2_AdditiveSchwarz.hpp>
#include <Ifpack2_ILUT.hpp>
#include <Teuchos_CommHelpers.hpp>
#include <Tpetra_CrsMatrix.hpp>
#include <Tpetra_Vector.hpp>

#include "Collectively.hpp"
#include "atrapos/linear/Error.hpp"

namespace atrapos::linear {

using RowMatrix = Tpetra::RowMatrix<double, LocalIndex, GlobalIndex>;

struct IncompleteFactor::Factor {
  RCP<Ifpack2::Preconditioner<double, LocalIndex, GlobalIndex, Vector::node_type>> of;
};

IncompleteFactor::IncompleteFactor(const KrylovOptions& options) : options_(options) {}
IncompleteFactor::~IncompleteFactor() = default;

std::string IncompleteFactor::name() const {
  return fmt::format("ILUT of Ifpack2, fill {:g}, drop {:g}", options_.fill, options_.drop);
}

void IncompleteFactor::analyze(const RCP<const CrsMatrix>& K) {
  factor_.reset();
  // Values and indices of both factors, of at most `fill` times as many entries as K has.
  const double entries = options_.fill * static_cast<double>(K->getGlobalNumEntries());
  estimate_ = FactorCost{entries, entries * (sizeof(double) + sizeof(LocalIndex)), 0};
}

void IncompleteFactor::factor(const RCP<const CrsMatrix>& K) {
  Teuchos::ParameterList list;
  list.set("fact: ilut level-of-fill", options_.fill);
  list.set("fact: drop tolerance", options_.drop);
  list.set("fact: absolute threshold", 0.0);
  list.set("fact: relative threshold", 1.0);
  const RCP<const RowMatrix> rows = K;
  factor_ = std::make_unique<Factor>();
  auto& of = factor_->of;
  collectively(*K->getRowMap()->getComm(), name(), "factorization", [&] {
    if (K->getRowMap()->getComm()->getSize() > 1) {
      using Schwarz = Ifpack2::AdditiveSchwarz<RowMatrix>;
      Teuchos::ParameterList outer;
      outer.set("schwarz: overlap level", 0);
      outer.set("schwarz: subdomain solver name", "ILUT");
      outer.set("schwarz: subdomain solver parameters", list);
      of = rcp(new Schwarz(rows));
      of->setParameters(outer);
    } else {
      of = rcp(new Ifpack2::ILUT<RowMatrix>(rows));
      of->setParameters(list);
    }
    of->initialize();
    of->compute();
  });
}

void IncompleteFactor::apply(const Vector& x, Vector& y, bool transposed) const {
  collectively(*x.getMap()->getComm(), name(), "solve",
               [&] { factor_->of->apply(x, y, transposed ? Teuchos::TRANS : Teuchos::NO_TRANS); });
}

}  // namespace atrapos::linear
