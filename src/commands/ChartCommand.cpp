#include "commands/ChartCommand.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <ostream>
#include <set>
#include <stdexcept>

#include "Version.hpp"
#include "chart/Chart.hpp"
#include "chart/ChartPlot.hpp"
#include "chart/ChartTable.hpp"
#include "chart/DeckEdits.hpp"
#include "chart/PathError.hpp"
#include "deck/Deck.hpp"
#include "machine/ChildProcess.hpp"
#include "machine/Digest.hpp"
#include "machine/OutputFile.hpp"
#include "output/Files.hpp"
#include "output/TableFile.hpp"

namespace atrapos {
namespace {

using namespace chart;
namespace fs = std::filesystem;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// The deck of a run.
struct RunDeck {
  std::string text;
  bool makesMesh = false;
};

/// The runs of a chart and their folders.
class Runs {
 public:
  Runs(const Chart& chart, std::string folder)
      : chart_(chart),
        folder_(std::move(folder)),
        root_(deck::readYaml(deck::readText(chart.deck), chart.deck).root) {
    // Its runs are processes that a launcher of ranks knows nothing of.
    for (const char* const size : {"OMPI_COMM_WORLD_SIZE", "PMI_SIZE"})
      if (const char* const ranks = std::getenv(size); ranks != nullptr && ranks != std::string("1"))
        throw std::invalid_argument("a chart is made by one rank; expected no mpirun");
    prepareFolder(folder_, {chart.file, chart.deck});
    lock_ = std::make_unique<FolderLock>(folder_, FolderLock::For::writing);
    requireOwn(table(), Made::chart, {chart.file, chart.deck});
    requireOwnPicture(folder_ + "/chart");
    const std::string runs = folder_ + "/runs";
    if (fs::exists(runs) && !fs::exists(table()))
      throw std::invalid_argument(fmt::format(
          "{} is there, but no {}; expected another folder, or that it is removed", runs, table()));
  }

  std::string table() const { return folder_ + "/chart.csv"; }

  /// The deck with these values, as it is run in a folder of its own: files that it reads are named from the
  /// root.
  RunDeck deckOf(const Edits& edits) const {
    deck::YamlTree root = root_;
    for (const auto& [keys, value] : edits) try {
        root = replaced(root, keys, value);
      } catch (const std::invalid_argument& error) {
        throw std::invalid_argument(fmt::format("{}: {}: {}", chart_.file, keys, error.what()));
      }
    const fs::path beside = fs::absolute(chart_.deck).parent_path();
    const auto fromRoot = [&](const std::string& keys) {
      const deck::YamlTree file = valueAt(root, keys);
      if (file && file->kind == deck::YamlNode::Kind::Scalar)
        root = replaced(root, keys, textValue((beside / file->text).lexically_normal().string()));
    };
    const bool makesMesh = valueAt(root, "mesh/generate") != nullptr;
    if (makesMesh)
      root = replaced(root, "mesh/file", textValue("mesh.exo"));
    else
      fromRoot("mesh/file");
    if (const deck::YamlTree tools = valueAt(root, "tools");
        tools && tools->kind == deck::YamlNode::Kind::Map)
      for (const auto& tool : tools->keys) fromRoot("tools/" + tool.name + "/file");
    return {yamlText(root), makesMesh};
  }

  /// Makes a run `repeat` times; the least seconds count. What is measured but for the error; the path is in
  /// results/path.csv of the folder.
  Measured make(const RunDeck& deck, const std::string& name, int repeat) const {
    const std::string own = folder_ + "/runs/" + name;
    fs::create_directories(own);
    replaceFile(own + "/deck.yaml", deck.text);
    const auto child = [&](const std::vector<std::string>& words) {
      const ChildResult result = runProgram(programBeside(""), words, false, own);
      if (result.exitCode != 0 && result.exitCode != 3)
        throw std::invalid_argument(fmt::format(
            "{}: {}", own, result.message.empty() ? "the run ended without a message" : result.message));
      return result;
    };
    if (deck.makesMesh) child({"mesh", "-q", "deck.yaml"});
    Measured measured;
    measured.seconds = std::numeric_limits<double>::infinity();
    for (int i = 0; i < repeat; ++i) {
      const ChildResult result = child({"run", "-q", "deck.yaml", "-o", "results"});
      std::ifstream in(own + "/results/summary.json");
      const auto summary = nlohmann::json::parse(in, nullptr, false);
      if (summary.is_discarded()) throw std::invalid_argument(fmt::format("{}: {}", own, result.message));
      const auto seconds = [&](const char* key) { return summary.at("seconds").value(key, 0.0); };
      // A limit of steps is a stop for who asked for it, but not the end of the path.
      measured.outcome =
          summary.value("ended", "") == "stopReached" ? "stop" : summary.value("why", result.message);
      measured.worstResidual =
          summary.at("worst_residual").is_number() ? summary.at("worst_residual").get<double>() : kUnknown;
      measured.steps = summary.value("steps", 0);
      measured.factorizations = summary.value("factorizations", 0);
      measured.orders = summary.value("orders_computed", 0);
      measured.solves = summary.value("solves", 0);
      measured.seconds = std::min(measured.seconds, seconds("total") - seconds("output"));
    }
    return measured;
  }
  std::string path(const std::string& name) const { return folder_ + "/runs/" + name + "/results/path.csv"; }

 private:
  const Chart& chart_;
  std::string folder_;
  std::unique_ptr<FolderLock> lock_;
  deck::YamlTree root_;
};

using References = std::vector<std::unique_ptr<ReferenceCurve>>;

/// Of every monitor.
References referencesOf(const Chart& chart, const Runs& runs, std::ostream* progress) {
  std::string path;
  if (const auto& set = chart.reference.own) {
    if (progress) *progress << "the reference is a run of the deck's own: " << settingsOf(*set) << std::endl;
    const Measured own = runs.make(runs.deckOf(*set), "reference", 1);
    if (own.outcome != "stop")
      throw std::invalid_argument(
          fmt::format("error/reference: the run does not reach a stop: {}", own.outcome));
    path = runs.path("reference");
  }
  References references;
  for (std::size_t m = 0; m < chart.monitors.size(); ++m)
    references.push_back(ReferenceCurve::of(chart, path, m));
  return references;
}

/// The curve of another program.
PlottedCurve readTable(const Curve& curve) {
  const TableFile table(curve.table);
  PlottedCurve plotted{curve.name, table.numbers("seconds"), {}, table.numbers("error")};
  if (table.has("factorizations")) plotted.factorizations = table.numbers("factorizations");
  return plotted;
}

std::string joined(const std::vector<std::string>& names) {
  return fmt::format("{}", fmt::join(names, ", "));
}

/// Of the picture's axis.
std::string whatErrors(const Chart& chart) {
  return "largest error of " + joined(chart.monitors) +
         (chart.monitors.size() > 1 ? " over the path, each over its range" : " over the path");
}

/// Which build of the program this is.
std::string program() {
  std::error_code unknown;
  const auto changed = fs::last_write_time("/proc/self/exe", unknown);
  return fmt::format("{} {}", kVersion, unknown ? 0 : changed.time_since_epoch().count());
}

/// The rows of a chart, as they are made, in chart.csv.
class Rows {
 public:
  Rows(const Chart& chart, const Runs& runs) : chart_(chart), runs_(runs), known_(readRows(runs.table())) {
    write();  // tells whose folder it is
  }

  /// What an earlier chart has measured in the same way.
  const Measured* known(const std::string& digest) const {
    const auto at = known_.find(digest);
    return at == known_.end() ? nullptr : &at->second;
  }
  std::string digestOf(const std::string& deckText) const {
    Digest digest;
    for (const std::string& part : {program(), deckText, joined(chart_.monitors), chart_.over, chart_.about,
                                    std::to_string(chart_.repeat)})
      digest.add(part + '\0');
    return fmt::format("{:016x}", digest.value());
  }
  void add(const Measured& row) {
    rows_.push_back(row);
    write();
  }
  const std::vector<Measured>& all() const { return rows_; }

 private:
  void write() const {
    std::string text = chartHeader() + '\n';
    std::set<std::string> written;
    for (const Measured& row : rows_) {
      text += rowOf(row) + '\n';
      written.insert(row.digest);
    }
    // What was measured earlier and is not asked for this time stays, for another time.
    for (const auto& known : known_)
      if (written.count(known.first) == 0) text += rowOf(known.second) + '\n';
    replaceFile(runs_.table(), text);
  }

  const Chart& chart_;
  const Runs& runs_;
  std::map<std::string, Measured> known_;
  std::vector<Measured> rows_;
};

/// Makes a run and measures its error.
Measured measure(const Chart& chart, const Runs& runs, const References& references, const Edits& edits,
                 const RunDeck& deck, const std::string& name) {
  Measured row = runs.make(deck, name, chart.repeat);
  row.settings = settingsOf(edits);
  row.error = row.at = kUnknown;
  if (row.outcome == "stop") {
    const PathError error = errorOf(runs.path(name), chart, references);
    row.error = error.largest;
    row.at = error.at;
  }
  return row;
}

/// Lines on the screen: what came out, and how long the rest will take.
class Progress {
 public:
  Progress(const Chart& chart, std::ostream* out) : out_(out), start_(std::chrono::steady_clock::now()) {
    for (const Curve& curve : chart.curves) count_ += curve.runs.size();
  }
  void tell(const Measured& row, bool known) {
    ++done_;
    made_ += known ? 0 : 1;
    if (out_ == nullptr) return;
    const double passed = std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    const std::size_t left = count_ - done_;
    *out_ << fmt::format("{}/{} {} {}: {}, error {:.3g}, {} factorizations, {:.3g} s", done_, count_,
                         row.curve, row.run, known ? "known" : row.outcome, row.error, row.factorizations,
                         row.seconds);
    if (made_ > 0 && left > 0) *out_ << fmt::format("; about {:.0f} s left", passed / made_ * left);
    *out_ << std::endl;
  }

 private:
  std::ostream* out_;
  std::chrono::steady_clock::time_point start_;
  std::size_t count_ = 0, done_ = 0;
  int made_ = 0;
};

}  // namespace

void writeChart(const std::string& file, const std::string& folder, std::ostream* progress) {
  const Chart chart = readChart(file);
  const Runs runs(chart, folder);
  std::vector<PlottedCurve> lines;
  std::size_t most = 0;
  for (const Curve& curve : chart.curves) {
    lines.push_back(curve.table.empty() ? PlottedCurve{curve.name, {}, {}, {}} : readTable(curve));
    most = std::max(most, curve.runs.size());
  }
  Rows rows(chart, runs);
  const References references = referencesOf(chart, runs, progress);
  Progress lineByLine(chart, progress);
  for (std::size_t i = 0; i < most; ++i)
    for (std::size_t c = 0; c < chart.curves.size(); ++c) {
      const Curve& curve = chart.curves[c];
      if (i >= curve.runs.size()) continue;
      const RunDeck deck = runs.deckOf(curve.runs[i]);
      const std::string digest = rows.digestOf(deck.text);
      const Measured* const known = rows.known(digest);
      Measured row = known != nullptr ? *known
                                      : measure(chart, runs, references, curve.runs[i], deck,
                                                fmt::format("{}-{}", c + 1, i + 1));
      row.digest = digest;
      row.curve = curve.name;
      row.run = static_cast<int>(i) + 1;
      rows.add(row);
      lineByLine.tell(row, known != nullptr);
      if (!(row.error > 0) || !(row.seconds > 0)) continue;  // no logarithm
      lines[c].seconds.push_back(row.seconds);
      lines[c].factorizations.push_back(row.factorizations);
      lines[c].errors.push_back(row.error);
    }
  const std::string why = plotChart(chart.title, whatErrors(chart), lines, folder, "chart");
  if (progress == nullptr) return;
  *progress << fmt::format(
      "{}{}\n", runs.table(),
      why.empty() ? fmt::format(", {0}/chart.png, {0}/chart.svg", folder) : "; chart.png not drawn: " + why);
  for (const Measured& row : rows.all())
    if (row.outcome != "stop")
      *progress << fmt::format("not in the picture: {} {}: {}\n", row.curve, row.run, row.outcome);
}

}  // namespace atrapos
