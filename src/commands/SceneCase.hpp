#pragma once

#include "commands/PathCase.hpp"
#include "scene/Scene.hpp"

namespace atrapos {

/// A state of a scene.
class SceneCaseState final : public CaseState {
 public:
  SceneCaseState(const Scene& scene, const path::State& state) : scene_(scene), state_(scene.at(state)) {}

  const SceneState& state() const { return state_; }
  std::vector<double> monitors() const override { return scene_.monitors(state_); }
  int activeContacts() const override;
  void strikeUsed(Costs& costs) const override;

 private:
  const Scene& scene_;
  SceneState state_;
};

/// A scene as something that a run follows; its states go into Exodus files. A scene given by reference must
/// outlive it.
class SceneCase final : public PathCase {
 public:
  explicit SceneCase(Scene& scene) : scene_(scene) {}
  explicit SceneCase(std::unique_ptr<Scene> scene) : own_(std::move(scene)), scene_(*own_) {}

  const deck::Deck& deck() const override { return scene_.deck(); }
  path::Problem& problem() override { return scene_.problem(); }
  path::State start() const override;
  path::Stops stops() const override { return scene_.stops(); }
  MeshDigest meshDigest() const override;
  std::vector<std::string> monitorNames() const override { return scene_.monitorNames(); }
  std::unique_ptr<CaseState> at(const path::State& state) const override {
    return std::make_unique<SceneCaseState>(scene_, state);
  }
  std::vector<path::Monitor> functionals() const override { return scene_.functionals(); }
  std::unique_ptr<FieldFile> makeFieldFile(const std::string& file) const override;
  std::unique_ptr<StepWatch> makeWatch(const std::string& file, bool append) const override;
  std::unique_ptr<PathCase> moved(const path::Vector& shape, double size) const override;
  std::unique_ptr<PathCase> under(const deck::Deck& deck, const path::State& start) const override;
  Costs costs() const override;  ///< contacts, and materials that yield
  std::vector<std::string> remarks() const override;
  /// Points without a contact law that come near their tool on the step get it.
  bool changedOn(double length, const path::Series& series) override;
  void summarize(nlohmann::ordered_json& summary) const override;
  /// Sharpens the contacts where the deck says so.
  std::string finish(const path::State& end, const path::Options& options, linear::TangentSolver& solver,
                     const std::string& directory, nlohmann::ordered_json& summary) override;
  double historyBytes() override;
  std::vector<std::pair<std::string, long long>> sizes() const override;

 private:
  std::unique_ptr<Scene> own_;  ///< null where another owns it
  Scene& scene_;
  int takenBack_ = 0;
};

}  // namespace atrapos
