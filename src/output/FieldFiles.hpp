#pragma once

#include <memory>
#include <string>

#include "commands/PathCase.hpp"
#include "commands/SceneCase.hpp"

namespace atrapos {

/// The name of a branch's result file, without a part's numbers.
std::string fieldsName(int branch);

/// Whether a run of this deck writes a result file on each of several ranks.
bool writesParts(const deck::Deck& deck);

/// The result file of a scene's states (SceneCaseState): one, by the first rank, or a part on each
/// (writesParts). The scene must outlive it. Collective, with all its members.
std::unique_ptr<FieldFile> makeSceneFields(const Scene& scene, const std::string& file);

/// Removes the result files in a folder of branches beyond `last`, and of that one those that this run does
/// not write: parts or the whole.
void removeOtherFields(const std::string& folder, int last, const deck::Deck& deck);

/// Copies the result files, whole or in parts, of the branches up to `last`.
void copyFields(const std::string& from, const std::string& to, int last);

}  // namespace atrapos
