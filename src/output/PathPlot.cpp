#include "output/PathPlot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>

#include "machine/Ranks.hpp"
#include "output/Files.hpp"
#include "output/Gnuplot.hpp"
#include "output/PathCurves.hpp"

namespace atrapos {
namespace {

const char* lineOf(Stability s) {
  switch (s) {
    case Stability::stable:
      return "dt 1 lw 2.2";
    case Stability::unstable:
      return "dt '.' lw 2.2";
    case Stability::unknown:
      return "dt 1 lw 1";
  }
  return "";
}

constexpr Stability kAll[] = {Stability::stable, Stability::unstable, Stability::unknown};

/// One coordinate system.
struct Panel {
  std::size_t x = 0;
  std::vector<std::size_t> y;
};

/// The part of the plane that a panel shows.
struct Frame {
  double x0 = std::numeric_limits<double>::infinity(), x1 = -x0, y0 = x0, y1 = -x0;
  void take(double x, double y) {
    if (!std::isfinite(x) || !std::isfinite(y)) return;
    x0 = std::min(x0, x), x1 = std::max(x1, x), y0 = std::min(y0, y), y1 = std::max(y1, y);
  }
  /// Distance of two points in widths and heights of the frame.
  double distance(double ax, double ay, double bx, double by) const {
    const double dx = x1 > x0 ? (bx - ax) / (x1 - x0) : 0, dy = y1 > y0 ? (by - ay) / (y1 - y0) : 0;
    return std::hypot(dx, dy);
  }
};

std::vector<Panel> panelsOf(const PathCurves& curves, const PlotRequest& request) {
  const auto& all = curves.quantities;
  std::vector<std::size_t> forces, displacements, y;
  for (std::size_t q = 2; q < all.size(); ++q) {
    if (all[q].kind == QuantityKind::force) forces.push_back(q);
    if (all[q].kind == QuantityKind::displacement) displacements.push_back(q);
  }
  for (const std::string& name : request.y) y.push_back(curves.find(name));
  const bool measured = curves.drivenByDisplacement && !forces.empty() && !displacements.empty();
  if (y.empty() && measured) y = forces;
  if (y.empty()) y = {0};
  if (!request.x.empty()) return {{curves.find(request.x), y}};
  std::vector<Panel> panels;
  for (std::size_t q = 2; q < all.size(); ++q) {
    const bool isForce = all[q].kind == QuantityKind::force;
    if (!(measured && isForce) && std::find(y.begin(), y.end(), q) == y.end()) panels.push_back({q, y});
  }
  if (panels.empty()) panels.push_back({1, y});
  return panels;
}

/// The stretches of one stability of a curve as data of gnuplot, and whether there are any. What is closer
/// than can be seen is left out.
class Data {
 public:
  Data(const BranchCurve& branch, const Panel& panel, std::size_t y, const Frame& frame)
      : x_(branch.values[panel.x]), y_(branch.values[y]), stability_(branch.stability), frame_(frame) {}

  std::string of(Stability wanted) {
    std::string text;
    constexpr double visible = 1.0 / 4000;
    for (std::size_t i = 0; i + 1 < x_.size(); ++i) {
      if (stability_[i] != wanted || !isPoint(i) || !isPoint(i + 1)) continue;
      const bool begins = i == 0 || stability_[i - 1] != wanted || !isPoint(i - 1);
      const bool ends = i + 2 == x_.size() || stability_[i + 1] != wanted || !isPoint(i + 2);
      if (begins) put(text, i);
      if (begins || ends || frame_.distance(x_[last_], y_[last_], x_[i + 1], y_[i + 1]) > visible)
        put(text, i + 1);
      if (ends) text += '\n';
    }
    return text;
  }

 private:
  bool isPoint(std::size_t i) const { return std::isfinite(x_[i]) && std::isfinite(y_[i]); }
  void put(std::string& text, std::size_t i) {
    text += fmt::format("{:.10g} {:.10g}\n", x_[i], y_[i]);
    last_ = i;
  }

  const std::vector<double>&x_, &y_;
  const std::vector<Stability>& stability_;
  const Frame& frame_;
  std::size_t last_ = 0;
};

/// What a legend has to explain.
struct Legend {
  std::vector<std::pair<std::string, std::size_t>> colours;  ///< words and number
  bool stability[3] = {false, false, false};
  bool marks[3] = {};  ///< [MarkType]
};

/// Where the load factors of points stand, so that none hides another one.
class Labels {
 public:
  explicit Labels(const Frame& frame) : frame_(frame) {}

  /// Beside a point, above or below it; left out where both are taken.
  void add(double x, double y, double load, bool below) {
    const double right = frame_.x1 > frame_.x0 ? (x - frame_.x0) / (frame_.x1 - frame_.x0) : 0.5;
    const double height = frame_.y1 > frame_.y0 ? (y - frame_.y0) / (frame_.y1 - frame_.y0) : 0.5;
    const bool onLeft = right > 0.8;
    for (const bool down : {below, !below}) {
      const double at[2] = {right + (onLeft ? -kWidth / 2 : kWidth / 2),
                            height + (down ? -kHeight : kHeight)};
      const auto hides = [&](const std::array<double, 2>& other) {
        return std::abs(other[0] - at[0]) < kWidth && std::abs(other[1] - at[1]) < kHeight;
      };
      if (std::any_of(taken_.begin(), taken_.end(), hides)) continue;
      taken_.push_back({at[0], at[1]});
      rows_[2 * (onLeft ? 1 : 0) + (down ? 1 : 0)] += fmt::format("{:.10g} {:.10g} \"{:.4g}\"\n", x, y, load);
      return;
    }
  }

  /// Data blocks and what draws them.
  void write(std::size_t panel, std::string& data, std::string& plots) const {
    for (int g = 0; g < 4; ++g) {
      if (rows_[g].empty()) continue;
      const std::string name = fmt::format("$labels_{}_{}", panel, g);
      data += fmt::format("{} << EOD\n{}EOD\n", name, rows_[g]);
      plots += fmt::format(", \\\n  {} using 1:2:3 notitle with labels {} offset {},{} font ',9'", name,
                           g / 2 == 0 ? "left" : "right", g / 2 == 0 ? 0.8 : -0.8, g % 2 == 0 ? 0.6 : -0.7);
    }
  }

 private:
  static constexpr double kWidth = 0.16, kHeight = 0.045;  // of a label, as parts of the frame
  const Frame& frame_;
  std::vector<std::array<double, 2>> taken_;
  std::string rows_[4];
};

/// The script of a picture: data once, panels for each terminal.
class Script {
 public:
  Script(const PathCurves& curves, std::vector<Panel> panels) : curves_(curves), panels_(std::move(panels)) {
    for (std::size_t p = 0; p < panels_.size(); ++p) addPanel(p);
    columns_ = static_cast<int>(std::ceil(std::sqrt(static_cast<double>(panels_.size()))));
    rows_ = static_cast<int>(panels_.size() + columns_ - 1) / columns_;
    const bool alone = panels_.size() == 1;
    width_ = (alone ? 640 : 460) * columns_;
    panelHeight_ = alone ? 460 : 380;
    constexpr int entryWidth = 250, entryHeight = 24;
    const int beside = std::max(1, width_ / entryWidth);
    legendRows_ = (static_cast<int>(legendEntries().size()) + beside - 1) / beside;
    legendHeight_ = entryHeight * legendRows_ + 12;
    height_ = kTitleHeight + panelHeight_ * rows_ + legendHeight_;
  }

  std::string text(const std::string& name) const {
    return pictureScript(name, width_, height_, data_,
                         [this](const std::string& file) { return drawing(file); });
  }

 private:
  static constexpr int kTitleHeight = 30;

  struct Mark {
    double x, y, load;
    bool minimum;
  };

  /// The point that a path without steps has: gnuplot draws nothing, and fails, where there is nothing.
  std::string startOnly(const Panel& panel) const {
    for (const BranchCurve& b : curves_.branches)
      if (b.numPoints() > 0)
        return fmt::format("'+' every ::0::0 using ({:.10g}):({:.10g}) with points notitle",
                           b.values[panel.x][0], b.values[panel.y[0]][0]);
    return "1/0 notitle";
  }

  void addPanel(std::size_t p) {
    const Panel& panel = panels_[p];
    Frame frame;
    for (const BranchCurve& b : curves_.branches)
      for (const std::size_t y : panel.y)
        for (std::size_t i = 0; i < b.numPoints(); ++i) frame.take(b.values[panel.x][i], b.values[y][i]);
    std::string plots;
    for (std::size_t b = 0; b < curves_.branches.size(); ++b)
      for (std::size_t y = 0; y < panel.y.size(); ++y) addCurve(p, b, y, frame, plots);
    if (plots.empty()) plots = startOnly(panel);
    Labels labels(frame);
    for (const MarkType type : {MarkType::hopf, MarkType::bifurcation, MarkType::limit})
      addMarks(p, type, frame, labels, plots);
    labels.write(p, data_, plots);
    plots_.push_back(plots);
  }

  void addCurve(std::size_t p, std::size_t b, std::size_t y, const Frame& frame, std::string& plots) {
    const Panel& panel = panels_[p];
    const BranchCurve& branch = curves_.branches[b];
    const std::size_t number = b * panel.y.size() + y;
    const std::string quantity = curves_.quantities[panel.y[y]].name;
    if (p == 0)
      legend_.colours.emplace_back(panel.y.size() == 1            ? branch.name
                                   : curves_.branches.size() == 1 ? quantity
                                                                  : quantity + ", " + branch.name,
                                   number);
    Data data(branch, panel, panel.y[y], frame);
    for (const Stability s : kAll) {
      const std::string rows = data.of(s);
      if (rows.empty()) continue;
      const std::string name = fmt::format("$curve_{}_{}_{}", p, number, static_cast<int>(s));
      data_ += fmt::format("{} << EOD\n{}EOD\n", name, rows);
      plots += fmt::format("{}{} using 1:2 notitle with lines {} lc rgb '{}'",
                           plots.empty() ? "" : ", \\\n  ", name, lineOf(s), plotColour(number));
      legend_.stability[static_cast<int>(s)] = true;
    }
  }

  /// Points of one type, each once whatever the number of branches that pass it, with the load factor where
  /// they are few enough to be read. A branch turns where it meets another one: that is no limit point more.
  void addMarks(std::size_t p, MarkType type, const Frame& frame, Labels& labels, std::string& plots) {
    const Panel& panel = panels_[p];
    std::vector<Mark>& all = marks_[p];
    const std::size_t before = all.size();
    for (const BranchCurve& b : curves_.branches)
      for (const CurveMark& mark : b.marks) {
        if (mark.type != type) continue;
        for (const std::size_t q : panel.y) {
          const double x = b.values[panel.x][mark.point], y = b.values[q][mark.point];
          constexpr double same = 1e-4;
          const auto isHere = [&](const Mark& at) { return frame.distance(at.x, at.y, x, y) < same; };
          if (!std::isfinite(x) || !std::isfinite(y) || std::any_of(all.begin(), all.end(), isHere)) continue;
          all.push_back({x, y, b.values[0][mark.point], mark.kind == "minimum"});
        }
      }
    const std::vector<Mark> marks(all.begin() + static_cast<std::ptrdiff_t>(before), all.end());
    if (marks.empty()) return;
    legend_.marks[static_cast<int>(type)] = true;
    const std::string name = fmt::format("$marks_{}_{}", p, static_cast<int>(type));
    data_ += name + " << EOD\n";
    constexpr std::size_t readable = 12;
    for (const Mark& m : marks) {
      data_ += fmt::format("{:.10g} {:.10g}\n", m.x, m.y);
      if (marks.size() <= readable) labels.add(m.x, m.y, m.load, m.minimum);
    }
    data_ += "EOD\n";
    plots += fmt::format(", \\\n  {} using 1:2 notitle with points {}", name, markStyle(type));
  }

  /// A circle, a square, a diamond.
  static const char* markStyle(MarkType type) {
    static const char* const styles[] = {"pt 6 ps 1 lw 1.6 lc rgb '#111111'", "pt 5 ps 0.7 lc rgb '#111111'",
                                         "pt 13 ps 1.1 lc rgb '#111111'"};
    return styles[static_cast<int>(type)];
  }

  /// Words and style of what stands for all that the panels have.
  std::vector<std::pair<std::string, std::string>> legendEntries() const {
    std::vector<std::pair<std::string, std::string>> entries;
    constexpr std::size_t most = 14;
    if (legend_.colours.size() > 1)
      for (std::size_t i = 0; i < std::min(most, legend_.colours.size()); ++i)
        entries.emplace_back(legend_.colours[i].first, fmt::format("with lines lw 2.2 lc rgb '{}'",
                                                                   plotColour(legend_.colours[i].second)));
    static const char* const words[] = {"stable", "unstable", "stability not counted"};
    for (const Stability s : kAll)
      if (legend_.stability[static_cast<int>(s)])
        entries.emplace_back(words[static_cast<int>(s)],
                             fmt::format("with lines {} lc rgb '#111111'", lineOf(s)));
    static const std::pair<MarkType, const char*> marked[] = {{MarkType::limit, "limit point"},
                                                              {MarkType::bifurcation, "bifurcation point"},
                                                              {MarkType::hopf, "Hopf point"}};
    for (const auto& [type, name] : marked)
      if (legend_.marks[static_cast<int>(type)])
        entries.emplace_back(name, fmt::format("with points {}", markStyle(type)));
    return entries;
  }

  std::string panel(std::size_t p) const {
    const int row = static_cast<int>(p) / columns_, column = static_cast<int>(p) % columns_;
    std::string y;
    for (const std::size_t q : panels_[p].y) y += (y.empty() ? "" : ", ") + curves_.quantities[q].name;
    return fmt::format(
        "set size {:.6f},{:.6f}\nset origin {:.6f},{:.6f}\nset xlabel {}\nset ylabel {}\nplot {}\n",
        1.0 / columns_, double(panelHeight_) / height_, double(column) / columns_,
        double(legendHeight_ + panelHeight_ * (rows_ - 1 - row)) / height_,
        gnuplotText(curves_.quantities[panels_[p].x].name), gnuplotText(y), plots_[p]);
  }

  /// Empty curves in a strip below the panels.
  std::string legend() const {
    std::string plots;
    for (const auto& [words, style] : legendEntries())
      plots += fmt::format("{}1/0 title {} {}", plots.empty() ? "" : ", \\\n  ", gnuplotText(words), style);
    if (plots.empty()) return "";
    return fmt::format(
        "set size 1,{:.6f}\nset origin 0,0\nset lmargin 0\nset rmargin 0\nset tmargin 0\nset bmargin 0\n"
        "unset border\nunset tics\nunset grid\nunset xlabel\nunset ylabel\nset xrange [0:1]\nset yrange "
        "[0:1]\n"
        "set key center center horizontal maxrows {} Left reverse samplen 2.5\nplot {}\n",
        double(legendHeight_) / height_, legendRows_, plots);
  }

  std::string drawing(const std::string& file) const {
    std::string text = pictureHead(file, curves_.title);
    for (std::size_t p = 0; p < panels_.size(); ++p) text += panel(p);
    return text + legend() + "unset multiplot\nset output\n";
  }

  const PathCurves& curves_;
  std::vector<Panel> panels_;
  std::vector<std::string> plots_;
  std::map<std::size_t, std::vector<Mark>> marks_;  ///< of panels
  std::string data_;
  Legend legend_;
  int columns_ = 1, rows_ = 1, legendRows_ = 1;
  int width_ = 0, height_ = 0, panelHeight_ = 0,
      legendHeight_ = 0;  ///< of the SVG; the PNG has twice as many pixels
};

}  // namespace

std::string plotPath(const PlotRequest& request) {
  if (!ranks::isFirst()) return "";
  PathCurves curves = readCurves(request.folder);
  for (BranchCurve& branch : curves.branches) branch = refined(branch);
  std::vector<Panel> panels = panelsOf(curves, request);
  constexpr std::size_t most = 36;  // more are neither seen nor drawn in a second
  const std::size_t all = panels.size();
  if (all > most) panels.resize(most);
  const std::filesystem::path output = request.output.empty() ? std::filesystem::path(request.folder) / "path"
                                                              : std::filesystem::path(request.output);
  const std::string folder = output.has_parent_path() ? output.parent_path().string() : ".";
  const std::string name = output.filename().string();
  replaceFile(output.string() + ".gp", Script(curves, std::move(panels)).text(name));
  const std::string why = runGnuplot(folder, name + ".gp");
  if (!why.empty()) return fmt::format("{}.png not drawn: {}", name, why);
  return all <= most ? "" : fmt::format("{}.png shows the first {} of {} monitors", name, most, all);
}

}  // namespace atrapos
