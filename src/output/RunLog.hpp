#pragma once

#include <deque>
#include <iosfwd>
#include <optional>
#include <string>
#include <vector>

#include "atrapos/path/Report.hpp"
#include "deck/Deck.hpp"
#include "output/PathTable.hpp"

namespace atrapos {

/// What a run tells its user while it goes on: a table of steps, the limit and bifurcation points as they are
/// found, what takes long, and when it may be over. Lines are seen at once.
class RunLog {
 public:
  /// `out` may be null: nothing is told. It must outlive the log.
  RunLog(std::ostream* out, deck::Path settings, std::vector<std::string> monitors);

  /// What the columns of the table mean, as help and documentation have it.
  static std::string columns();

  bool tells() const { return out_ != nullptr; }
  void line(const std::string& text);
  /// The settings from here on.
  void follow(const deck::Path& settings) { settings_ = settings; }
  /// A path begins: the table's head.
  void head();

  /// Numbers of a step that its report does not have.
  struct Step {
    int contacts = 0;  ///< closed contact points at its end
    int changes = 0;   ///< contact points that closed, opened or went on to another surface in it
    double seconds = 0;
    std::vector<double> monitors;  ///< at its end
  };
  /// `points`: the rows of points.csv of this step, along the path.
  void step(const path::StepReport& report, const Step& step, const std::vector<PointRow>& points);
  /// While bifurcation points are located: `found` of `wanted` eigenvalues have their place.
  void search(int found, int wanted, double seconds);

 private:
  /// How far along a step's end is, in each quantity that a stop names.
  struct Place {
    double seconds;
    std::vector<double> values;  ///< load factor, path length, monitors
  };

  std::string timeLeft() const;
  void tellTimeLeft(const path::StepReport& report, const Step& step);

  std::ostream* out_;
  deck::Path settings_;
  std::vector<std::string> monitors_;
  std::deque<Place> last_;  ///< of the path under way
  double printed_ = 0;      ///< seconds of the last line
  bool uncounted_ = false;  ///< the last step was (StepReport::uncounted)
  double estimated_ = 0;    ///< seconds of the last line on the time left
};

/// A point in words, e.g. "limit point (maximum) at load factor 1.25: tip = -3"; empty where it is an
/// extremum of a monitor.
std::string describe(const PointRow& point, const std::vector<std::string>& monitors);

/// Seconds as a person says them: "40 s", "3 min", "2.5 h".
std::string inWords(double seconds);

}  // namespace atrapos
