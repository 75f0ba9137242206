#pragma once

#include <memory>

#include "Preconditioner.hpp"
#include "atrapos/linear/KrylovOptions.hpp"

namespace atrapos::linear {

/// Ifpack2's incomplete L U with thresholds (ILUT; Saad, Numer. Linear Algebra Appl. 1 (1994) 387), on
/// several ranks one factor of each rank's own block (additive Schwarz). For bodies that are about as thick
/// as wide; it does not pivot, so that it is poor for thin bodies and fails on saddle points.
class IncompleteFactor final : public Preconditioner {
 public:
  explicit IncompleteFactor(const KrylovOptions& options);
  ~IncompleteFactor() override;

  void analyze(const RCP<const CrsMatrix>& K) override;
  void factor(const RCP<const CrsMatrix>& K) override;
  void apply(const Vector& x, Vector& y, bool transposed) const override;
  std::string name() const override;
  std::optional<FactorCost> estimate() const override { return estimate_; }
  std::optional<FactorCost> spent() const override { return estimate_; }

 private:
  struct Factor;

  KrylovOptions options_;
  std::unique_ptr<Factor> factor_;
  std::optional<FactorCost> estimate_;
};

}  // namespace atrapos::linear
