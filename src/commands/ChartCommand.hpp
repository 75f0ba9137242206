#pragma once

#include <iosfwd>
#include <string>

namespace atrapos {

/// `atrapos chart`: makes the runs of a chart, each a process of its own, one of every curve in turn, and
/// writes chart.csv, chart.png, chart.svg and chart.gp into a folder, runs below `runs`. Rows that chart.csv
/// has already are not made again. Throws DeckError or std::invalid_argument, one line, where the chart, one
/// of its decks or the reference is not as it must be.
void writeChart(const std::string& file, const std::string& folder, std::ostream* progress);

}  // namespace atrapos
