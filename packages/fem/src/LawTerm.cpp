#include "atrapos/fem/LawTerm.hpp"

#include <stdexcept>
#include <utility>

#include "LawTermOf.hpp"
#include "SwitchedTerm.hpp"

namespace atrapos::fem {

std::unique_ptr<Term> lawTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                              const std::vector<double>& data, DataUpdate update) {
  if (law->shape().events > 0) {
    if (update) throw std::logic_error("lawTerm: a law with events whose data are brought up to date");
    return std::make_unique<SwitchedTerm>(std::move(law), points, data);
  }
  auto term = std::make_unique<LawTermOf<Term>>(std::move(law), points, data);
  term->setUpdate(std::move(update), data);
  return term;
}

std::unique_ptr<Term> storingTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                                  const std::vector<double>& data, Capacity capacity) {
  auto term = std::make_unique<LawTermOf<Term>>(std::move(law), points, data);
  term->setCapacity(std::move(capacity));
  return term;
}

std::unique_ptr<Term> lawTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                              const std::vector<double>& data, PieceSearch search) {
  auto term = std::make_unique<LawTermOf<Term>>(std::move(law), points, data);
  term->setPieces(std::move(search), data);
  return term;
}

std::unique_ptr<Term> symmetricSumTerm(std::unique_ptr<PointLaw> law, const PointSet& points,
                                       const std::vector<double>& data) {
  auto term = std::make_unique<LawTermOf<Term>>(std::move(law), points, data);
  term->setSymmetricSum();
  return term;
}

}  // namespace atrapos::fem
