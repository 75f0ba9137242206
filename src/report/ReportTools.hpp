#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "atrapos/exodus/ResultReader.hpp"
#include "deck/Deck.hpp"
#include "report/Surface.hpp"

namespace atrapos {

/// The rigid tools that a run wrote beside a result file (writeToolShapes). Throws exodus::Error on files
/// that are damaged.
class ReportTools {
 public:
  /// Null where there is no such file, or it has other states than the result file: it is of an earlier part
  /// of the run.
  static std::unique_ptr<ReportTools> of(const std::string& file, int states);

  /// Surfaces where they stand before they move, as shapeOf has those of the body.
  nlohmann::json surfaces() const;
  /// Where they are at a state of the file: of every tool a rigid motion of its places, a turn R, row by row,
  /// and a shift, as base64.
  std::string motions(int step) const;

 private:
  using Places = std::vector<deck::Vector3>;

  /// One tool: a block's surface, and three of its places far from one line, by which motions are known.
  struct Tool {
    std::string name;
    Surface surface;
    Places rest;
    std::array<std::size_t, 3> three{};
  };

  explicit ReportTools(const std::string& file);

  exodus::ResultReader results_;
  std::vector<Tool> tools_;
};

}  // namespace atrapos
