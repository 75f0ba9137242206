#pragma once

#include <string>
#include <vector>

#include "scene/Scene.hpp"

namespace atrapos {

/// What the result file holds of a scene's states, as its deck asks: variables of nodes and of elements of
/// Scene::resultMesh. Refers to the scene.
class ResultFields {
 public:
  explicit ResultFields(const Scene& scene)
      : scene_(scene),
        deck_(scene.deck()),
        mesh_(scene.mesh()),
        shells_(scene.shells()),
        body_(scene.shellBody()) {}

  std::vector<std::string> nodalNames() const;
  std::vector<std::string> elementNames() const;
  /// [variable][node of the result mesh]; collective.
  std::vector<std::vector<double>> nodalValues(const SceneState& state) const;
  /// [variable][element over all blocks]; collective.
  std::vector<std::vector<double>> elementValues(const SceneState& state) const;

 private:
  bool writes(deck::OutputField field) const;
  /// Whether a material has plastic strains to show.
  bool yields() const;
  /// Values of a field that is the pressure of a flow at the nodes between corners, [node].
  void fillPressures(const std::string& field, std::vector<double>& nodes) const;
  std::vector<std::vector<double>> nodalContact(const SceneState& state) const;
  std::vector<std::vector<double>> nodalStress(const SceneState& state) const;
  std::vector<double> onResultNodes(std::vector<double> ofMesh) const;

  const Scene& scene_;
  const deck::Deck& deck_;
  const fem::Mesh& mesh_;
  const SceneShells& shells_;
  const fem::ShellBody* body_;
};

}  // namespace atrapos
