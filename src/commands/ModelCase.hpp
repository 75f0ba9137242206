#pragma once

#include "atrapos/models/Models.hpp"
#include "commands/PathCase.hpp"

namespace atrapos {

/// A model problem as something that a run follows. The stops of the deck, where it has any besides the
/// number of steps, stand in for the model's own.
class ModelCase final : public PathCase {
 public:
  /// Throws deck::DeckError on parameters that make no sense and on monitors that the model does not have.
  explicit ModelCase(const deck::Deck& deck);

  const deck::Deck& deck() const override { return deck_; }
  path::Problem& problem() override { return *problem_; }
  path::State start() const override { return setup_.start; }
  path::Stops stops() const override { return setup_.stops; }
  double direction() const override { return setup_.direction; }
  std::vector<std::string> monitorNames() const override;
  std::unique_ptr<CaseState> at(const path::State& state) const override;
  std::vector<path::Monitor> functionals() const override { return setup_.monitors; }
  std::vector<std::pair<std::string, long long>> sizes() const override;

  const std::string& about() const { return setup_.about; }

 private:
  void takeStops();

  deck::Deck deck_;
  std::unique_ptr<path::Problem> problem_;
  models::Setup setup_;
};

}  // namespace atrapos
