#pragma once

#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "support/Command.hpp"
#include "support/Folder.hpp"
#include "support/Table.hpp"

namespace atrapos::test {

using Edits = std::vector<std::pair<std::string, std::string>>;

/// A folder with the deck examples/<name>, some of its text edited, and its mesh, generated or from the .inp
/// beside the deck. Residuals are evaluated at
/// all points (output/residuals), unless the text says something else. Throws std::runtime_error where the
/// mesh cannot be made, std::logic_error where an edit does not fit.
class ExampleFolder {
 public:
  explicit ExampleFolder(const std::string& name, const Edits& edits = {});

  const std::filesystem::path& path() const { return folder_.path(); }
  std::filesystem::path deck() const { return folder_ / "deck.yaml"; }
  std::filesystem::path results(const std::string& file) const { return folder_.path() / "results" / file; }

  /// Arguments of a run of the deck into results().
  static std::vector<std::string> run(const std::vector<std::string>& more = {});

 private:
  TemporaryFolder folder_;
};

/// A run of such a deck to its end, which must be a stop of the deck: throws std::runtime_error where it is
/// not.
struct ExampleRun {
  explicit ExampleRun(const std::string& name, const Edits& edits = {},
                      const std::vector<std::string>& arguments = {});

  std::vector<double> column(const std::string& name) const { return path->column(name); }

  ExampleFolder folder;
  std::unique_ptr<Table> path;
  nlohmann::json summary;
};

}  // namespace atrapos::test
