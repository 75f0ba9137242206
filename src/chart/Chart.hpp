#pragma once

#include <optional>
#include <string>
#include <vector>

#include "chart/DeckEdits.hpp"

/// What `atrapos chart` is asked for: a deck, runs of it with other values, and what their error is
/// (docs/chart.md).
namespace atrapos::chart {

/// One line of the picture.
struct Curve {
  std::string name;
  std::vector<Edits> runs;  ///< of a deck
  /// A table of what another program took, with the columns `seconds` and `error` and perhaps
  /// `factorizations`.
  std::string table;
};

/// What the paths are held against.
struct Reference {
  std::string file, x;         ///< a table and its column of the quantity `over`
  std::vector<std::string> y;  ///< and those of the monitors
  std::string formula;         ///< of the quantity `over`; of one monitor
  std::optional<Edits> own;    ///< a run of the deck
};

struct Chart {
  std::string file;  ///< of the chart
  std::string title;
  std::string deck;  ///< file
  /// Whose largest error over the path counts; of several each over the range of its values on the path.
  std::vector<std::string> monitors;
  std::string over = "load_factor";
  Reference reference;
  /// Equal parts of the range of `over`, at whose ends the curve through the rows counts too; 0: rows alone.
  int between = 0;
  int repeat = 1;  ///< times that each run is made; the least time counts
  std::vector<Curve> curves;
  std::string about;  ///< what the errors depend on beside the decks of the runs
};

/// Throws DeckError, one line with its place, for what makes no chart.
Chart readChart(const std::string& file);

}  // namespace atrapos::chart
