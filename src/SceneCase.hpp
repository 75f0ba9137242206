#pragma once

#include "PathCase.hpp"
#include "Scene.hpp"

namespace atrapos {

/// A scene as something that a run follows; its states go into Exodus files. The scene must outlive it.
class SceneCase final : public PathCase {
 public:
  explicit SceneCase(Scene& scene) : scene_(scene) {}

  const deck::Deck& deck() const override { return scene_.deck(); }
  path::Problem& problem() override { return scene_.problem(); }
  path::State start() const override;
  path::Stops stops() const override { return scene_.stops(); }
  std::vector<std::string> monitorNames() const override { return scene_.monitorNames(); }
  std::vector<double> monitors(const path::Vector& u, double lambda) const override {
    return scene_.monitors(u, lambda);
  }
  std::vector<path::Monitor> functionals() const override { return scene_.functionals(); }
  int activeContacts(const path::Vector& u, double lambda) const override;
  std::unique_ptr<FieldFile> makeFieldFile(const std::string& file) const override;
  std::vector<std::pair<std::string, long long>> sizes() const override;

 private:
  Scene& scene_;
};

}  // namespace atrapos
