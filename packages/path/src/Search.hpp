#pragma once

#include <vector>

#include "Critical.hpp"

namespace atrapos::path {

/// One search for the bifurcation points of a step: what is left to be found, what the solver holds, what has
/// been spent.
class Search {
 public:
  Search(Calls& calls, const CriticalSearch& search);

  /// A state off the path that the problem or the solver refuses ends the search; what is found stays.
  CriticalFound run();

 private:
  /// Where a point may be, and its null vector, roughly.
  struct Guess {
    double a;
    RCP<Vector> direction;
  };
  /// A place of the step at which the negative eigenvalues have been counted.
  struct Place {
    CountedPlace count;
    double speed = 1;  ///< |X'| there
    std::vector<Mode> modes;
  };
  /// Where an eigenvalue seen from a place vanishes by a straight line.
  struct Zero {
    double a;
    const Mode* mode;
    bool alongPath = false;  ///< that of a limit point, at which the path's direction is the null vector
  };

  // Critical.cpp: one thing after the other.
  void search();
  void guess(bool many);
  void countLeft();
  void lookAtLimitPoints();
  void look(const std::vector<Guess>& guesses);
  void lookAgain();
  std::vector<Guess> guessesOf(const ResponsePoles& poles, double origin) const;
  int numberFound() const;
  int budget() const;
  bool known(const CriticalPoint& point) const;
  void keep(CriticalPoint point);
  void simple(double guess, const RCP<Vector>& direction, Held held);
  void simple(double guess, const RCP<Vector>& direction, Held held, int most);

  // SearchZeros.cpp: by the eigenvalues followed.
  void followZeros();
  void sample(double a, std::vector<ModeSample>& samples);
  bool cluster(double guess, const RCP<Vector>& direction);

  // SearchCounts.cpp: by the number of negative eigenvalues, or by the determinant's sign.
  void followCounts();
  void followSign();
  bool oddLeft(const CountedPlace& first, const CountedPlace& second) const;
  int owed(std::size_t i) const;
  double placeBetween(const Place& p, const Place& q, bool halve) const;
  std::vector<Zero> zerosSeenFrom(const Place& place, double from, double to) const;
  bool isFound(double a, const Mode& mode, double accuracy) const;
  bool count(double a, int modes, Place& place);
  void refineFrom(const Place& place, double from, double to);
  void closeIn(std::size_t i);

  /// At the very point a tangent cannot be factored: this part of the step before it.
  static constexpr double aside() { return 5e-5; }
  /// Poles are looked for so far beyond the step: its ends are where eigenvalues were counted.
  static constexpr double beyond() { return 0.03; }

  Calls& calls_;
  const CriticalSearch& search_;
  int left_;
  double factoredAt_;  ///< where on the series the solver's factorization belongs
  CriticalFound found_;
  std::vector<Place> places_;  ///< ascending in a; the ends of the step first
};

}  // namespace atrapos::path
